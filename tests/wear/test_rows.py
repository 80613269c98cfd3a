"""CSV files of loads: all rows at once are read as rows one by one are."""

from pathlib import Path
from unittest import mock

import numpy as np
from hypothesis import example, given
from hypothesis import strategies as st

from wear.scene import rows
from wear.scene.rows import Rows, read_rows

HEAD = "t_s,U_a_mm\n"
NUMBERS = st.one_of(
    st.floats(-1e3, 1e3).map(repr),
    st.sampled_from(
        ["0", "-0", "1e-4", "+2", " 3 ", "1_0", "4E0", "nan", "inf", "1e-31", "1e31", "x", "", "5#",
         '"6"', "0x7", "\u0663", "8\r", "\r9", "1d2", "1j", "1 2"]
    ),
)  # fmt: skip


@given(st.lists(st.lists(NUMBERS, min_size=1, max_size=3).map(",".join), min_size=1, max_size=6))
@example(["0,1e-4", "1_0,2e-4"])
@example(["0,1e-4\r", "1,2e-4\r", "\r"])
@example(["0,1\r1,2", "2,3"])
@example(["1e-40,1e-4", "1,1e-4"])
@example(["0,1", "1,2", "1.0000000000000002,3"])
def test_the_quick_way_says_the_same(lines: list[str]) -> None:
    timed = [f"{place}{',' if line else ''}{line}" for place, line in enumerate(lines)]
    for some in (lines, timed):
        text = HEAD + "\n".join(some)
        quick = rows._parse(text)
        with mock.patch.object(rows, "_sound_columns", return_value=None):
            assert repr(quick) == repr(rows._parse(text))


def test_a_million_rows_are_read(tmp_path: Path) -> None:
    times = np.arange(1_000_000) / 1024
    level = 5e-4 * np.sin(times)
    lines = [f"{t!r},{U!r}" for t, U in zip(times.tolist(), level.tolist(), strict=True)]
    (tmp_path / "record.csv").write_text(HEAD + "\n".join(lines))
    read = read_rows("record.csv", tmp_path)
    assert isinstance(read, Rows)
    assert read.times == times.tolist()
    assert read.displacements == level.tolist()


def test_one_wrong_row_among_many_is_told_with_its_line(tmp_path: Path) -> None:
    lines = [f"{n},1e-4" for n in range(1000)]
    lines[700] = "700;1e-4"
    (tmp_path / "record.csv").write_text(HEAD + "\n".join(lines))
    read = read_rows("record.csv", tmp_path)
    assert isinstance(read, list)
    assert [wrong.problem for wrong in read] == ['record.csv line 702: "700;1e-4" is no row']
