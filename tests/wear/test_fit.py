"""Identification: what the data say of the parameters, how surely, and what they leave open."""

from __future__ import annotations

from pathlib import Path

import pytest

from wear.faults import UsageError
from wear.fitting.readings import read_readings

# Readings


def test_readings_are_those_of_the_file_in_mm(tmp_path: Path) -> None:
    file = tmp_path / "wear.csv"
    file.write_text("specimen,load_g,load.value_mm,cycles,wear_um\n"
                    "b,10,-1e-4,5,2.5\nb,10,-1e-4,5,2\n\na,20,0,7,1\n")  # fmt: skip
    b, a = read_readings(file, ["load_g"])
    assert (b.name, b.cycles.tolist(), b.wear_mm.tolist()) == ("b", [5.0, 5.0], [2.5e-3, 2e-3])
    assert (b.changes, a.changes) == ({"load.value_mm": -1e-4}, {"load.value_mm": 0.0})
    assert b.standard_error_mm is None
    assert b.first(1).wear_mm.tolist() == [2.5e-3]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", ["no column cycles", "wear_mm or wear_um"]),
        ("cycles,wear_mm,wear_um,\x1b\n", ["in one column", r"\x1b: unknown"]),
        ("cycles,wear_in\n1,2\n", ["in one column", "wear_in: unknown", "--ignore wear_in"]),
        ("cycles,wear_mm\n1,2,3\n", ["line 2: 3 entries", "the header has 2"]),
        ("cycles,wear_mm\n\n1,-2\n0.5,nan\n", ["line 3: wear_mm", "line 4: wear_mm",
                                              "line 4: cycles", "must ascend"]),
        ("cycles,wear_mm,standard_error_mm\n1,2,0\n", ["line 2: standard_error_mm", "one reading"]),
        ("cycles,wear_mm,load.value_mm,specimen\n1,2,0,a\n2,2,1,a\n", ["value_mm of specimen a"]),
    ],
)  # fmt: skip
def test_everything_that_is_wrong_with_a_file_is_said_at_once(
    tmp_path: Path, text: str, words: list[str]
) -> None:
    file = tmp_path / "wear.csv"
    file.write_text(text)
    with pytest.raises(UsageError) as caught:
        read_readings(file)
    for word in words:
        assert word in str(caught.value)


def test_a_file_that_cannot_be_read_is_named(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="is a folder"):
        read_readings(tmp_path)
    (tmp_path / "wear.csv").write_bytes(b"cycles,wear_mm\n1,\xff\n")
    with pytest.raises(UsageError, match="no CSV file in UTF-8"):
        read_readings(tmp_path / "wear.csv")
