"""CSV files of loads as instruments write them."""

from pathlib import Path

import numpy as np
import pytest

from wear.faults import SceneError
from wear.load import Table, csv_file
from wear.load.csv_file import TableFile, read_rows
from wear.scene import Scene, load_scene
from wear.validation import EntryError

HEAD = "t_s,U_a_mm\n"


@pytest.mark.parametrize(
    ("cell", "number"),
    [("-0", 0.0), ("+2", 2.0), (" 3 ", 3.0), ("4E0", 4.0), ('"6"', 6.0), ("8\r", 8.0),
     *((wrong, None) for wrong in ("nan", "inf", "1e-31", "1e31", "x", "", "5#", "0x7", "1d2",
                                   "1j", "1 2", "1,2", "1_0"))],
)  # fmt: skip
def test_a_cell_is_a_number_of_sane_size(tmp_path, cell, number):
    (tmp_path / "a.csv").write_bytes(f"{HEAD}0,5\n1,{cell}\n".encode())
    if number is None:
        with pytest.raises(EntryError) as caught:
            read_rows(TableFile("a.csv"), tmp_path)
        ((_, problem, _),) = caught.value.findings
        wrong = f'"1,{cell}" has 3 cells, the header 2' if "," in cell else f'U_a_mm is "{cell}"'
        assert problem == f"a.csv line 3: {wrong}"
    else:
        assert read_rows(TableFile("a.csv"), tmp_path).values.tolist() == [5.0, number]


def test_a_point_beside_decimal_commas_may_separate_thousands(tmp_path):
    (tmp_path / "a.csv").write_text("t_s;U_a_mm\n0;1,5\n1;1.250\n")
    with pytest.raises(EntryError, match=r'line 3: U_a_mm is "1\.250"'):
        read_rows(TableFile("a.csv", delimiter=";", decimal=","), tmp_path)


def test_as_many_rows_as_may_be_are_read(tmp_path, monkeypatch):
    monkeypatch.setattr(csv_file, "MOST_ROWS", 20_000)  # of a million
    times = np.arange(20_000) / 1024
    level = 5e-4 * np.sin(times)
    lines = [f"{t!r},{U!r}" for t, U in zip(times.tolist(), level.tolist(), strict=True)]
    (tmp_path / "a.csv").write_text(HEAD + "\n".join(lines))
    read = read_rows(TableFile("a.csv"), tmp_path)
    assert read.times.tolist() == times.tolist()
    assert read.values.tolist() == level.tolist()


# Files as instruments write them


def scene(tmp_path: Path, **load: object) -> Scene:
    tables = load_scene("section4").to_tables() | {"load": {"kind": "table"} | load}
    return Scene.from_dict(tables, folder=tmp_path)


def load(tmp_path: Path, **entries: object) -> Table:
    made = scene(tmp_path, **entries).load
    assert isinstance(made, Table)
    return made


INSTRUMENT = {
    "file": "log.csv", "columns": ["Zeit (ms)", "Weg (µm)"], "time_unit": "ms", "unit": "um",
    "delimiter": ";", "decimal": ",", "encoding": "latin-1",
}  # fmt: skip


def test_an_instrument_s_file(tmp_path):
    """Lines before the header, a column too many, decimal commas, another encoding."""
    text = 'Messung Prüfstand 3\n\n"Zeit (ms)";Kanal 2;"Weg (µm)"\n0,0;1;-0,1\n15,0;2;0,5\n'
    (tmp_path / "log.csv").write_bytes((text + "60,0;3;-0,1\n").encode("latin-1"))
    made = load(tmp_path, **INSTRUMENT)
    assert made.times_s == pytest.approx((0.0, 0.015, 0.06), rel=1e-15)
    assert made.values_mm == pytest.approx((-1e-4, 5e-4, -1e-4), rel=1e-15)
    original = scene(tmp_path, **INSTRUMENT)
    assert Scene.from_dict(original.to_tables(), folder=tmp_path) == original


def test_a_byte_order_mark_does_no_harm(tmp_path):
    (tmp_path / "a.csv").write_text("\ufeff" + HEAD + "0,0\n1,0\n", encoding="utf-8")
    assert load(tmp_path, file="a.csv").period == 1.0


def test_rows_may_stand_in_the_scene_itself(tmp_path):
    made = scene(tmp_path, times_s=[0.0, 0.01, 0.06], values_mm=[0.0, 5e-4, 0.0])
    assert made.load == Table((0.0, 0.01, 0.06), (0.0, 5e-4, 0.0))
    assert Scene.from_dict(made.to_tables()) == made


@pytest.mark.parametrize(
    ("entries", "problem", "remedy"),
    [
        ({"columns": ["Zeit", "Weg (µm)"]}, 'the columns are "Messung"', "begin with Zeit;Weg"),
        ({"columns": ["Zeit (ms)"]}, "is not a pair of names", "columns = ["),
        ({"columns": [0, 1]}, "is not a pair of names", "columns = ["),
        ({"columns": ["Zeit (ms)", "Zeit (ms)"]}, "names one column twice", "that of the values"),
        ({"time_unit": "sec"}, '"sec" is unknown', "choose one of s, ms"),
        ({"unit": "micron"}, '"micron" is unknown', "choose one of mm, um"),
        ({"unit": "mm"}, '"Weg (µm)" is named in µm', 'unit = "µm", or rename'),
        ({"time_unit": "s"}, '"Zeit (ms)" is named in ms', 'time_unit = "ms"'),
        ({"delimiter": ";;"}, "is not a delimiter", "one character"),
        ({"delimiter": ",", "decimal": ","}, "is the delimiter too", 'delimiter = ";"'),
        ({"encoding": "martian"}, '"martian" is unknown', "latin-1"),
        ({"encoding": "hex"}, '"hex" is unknown', "latin-1"),
        ({"encoding": "utf-8"}, "is not UTF-8 text", 'encoding = "latin-1"'),
        ({"encoding": "punycode"}, "is not PUNYCODE text", 'encoding = "latin-1"'),
        ({"repeat": 1}, "is a number", "true or false"),
        ({"decimal": "."}, 'Zeit (ms) is "0,0"', "such as 0.5"),
    ],
)
def test_an_instrument_s_file_that_is_described_wrongly(entries, problem, remedy, tmp_path):
    text = '"Messung"\nZeit (ms);Weg (µm)\n0,0;0,1\n15,0;0,5\n60,0;0,1\n'
    (tmp_path / "log.csv").write_bytes(text.encode("latin-1"))
    with pytest.raises(SceneError) as caught:
        scene(tmp_path, **(INSTRUMENT | entries))
    assert problem in caught.value.faults[0].problem
    assert remedy in caught.value.faults[0].remedy


def test_units_in_a_header_of_another_name_are_no_contradiction(tmp_path):
    """Default names of columns were taken for those of the file."""
    (tmp_path / "log.csv").write_text("t_ms,U_a_um\n0,0\n30,0.5\n60,0\n")
    with pytest.raises(SceneError) as caught:
        scene(tmp_path, file="log.csv", unit="um")
    (fault,) = caught.value.faults
    assert fault.remedy.endswith('columns = ["t_ms", "U_a_um"], time_unit = "ms", unit = "um"')
    (tmp_path / "log.csv").write_text("t_s,U_a_mm\n0,0\n30,0.5\n60,0\n")
    with pytest.raises(SceneError, match='column "U_a_mm" is named in mm'):
        scene(tmp_path, file="log.csv", unit="um")


@pytest.mark.parametrize(
    ("entries", "keys"),
    [
        ({"perod_s": 1.0, "resample": 3}, ["perod_s", "resample", "file", "file"]),
        ({"period_s": -1.0, "unit": "mile"}, ["period_s", "unit", "file", "file"]),
        ({"delimeter": ";"}, ["delimeter"]),  # the rows are not known to be written otherwise
        ({"encoding": 1}, ["encoding"]),
        ({"repeet": True}, ["repeet"]),
    ],
)
def test_a_bad_key_hides_no_bad_row(entries, keys, tmp_path):
    (tmp_path / "a.csv").write_text(HEAD + "0,0\n1,x\n2,y\n")
    with pytest.raises(SceneError) as caught:
        scene(tmp_path, file="a.csv", **entries)
    assert [fault.key for fault in caught.value.faults] == keys


def test_a_fault_of_the_load_of_a_file_is_the_file_s(tmp_path):
    (tmp_path / "a.csv").write_text("t_s,R_a_N\n0,-1\n1,-1\n")
    for kind, entries, problem in (
        ("force", {}, "the force goes from -1 to -1 N"),
        ("history", {"columns": ["t_s", "R_a_N"], "period_s": 2.0}, "is longer than the rows"),
    ):
        with pytest.raises(SceneError) as caught:
            scene(tmp_path, kind=kind, file="a.csv", **entries)
        assert problem in caught.value.faults[0].problem


# One period out of a record


def record(tmp_path: Path, count: int, start: float = 0.0) -> None:
    """A sine of period 60 ms, a row a millisecond, with a drift of 1e-5 mm a period."""
    at = np.arange(count) * 1e-3
    level = 5e-4 * np.sin(2 * np.pi * at / 0.06) + 1e-5 * at / 0.06
    lines = (f"{t + start!r},{u!r}\n" for t, u in zip(at.tolist(), level.tolist(), strict=True))
    (tmp_path / "a.csv").write_text(HEAD + "".join(lines))


def test_one_period_of_a_record(tmp_path):
    record(tmp_path, 200)
    made = load(tmp_path, file="a.csv", period_s=0.06, repeat=True)
    assert (made.period, len(made.times_s)) == (0.06, 61)
    assert made.values_mm[-1] == made.values_mm[0] == 0.0
    assert made.values_mm[15] == pytest.approx(5e-4 + 0.25e-5)


def test_the_period_is_the_last_time_plus_one_step(tmp_path):
    record(tmp_path, 60)
    made = load(tmp_path, file="a.csv", repeat=True)
    assert made.period == pytest.approx(0.06, rel=1e-14)
    assert len(made.times_s) == 61


def test_a_record_may_start_at_any_time(tmp_path):
    record(tmp_path, 60)
    whole = load(tmp_path, file="a.csv", period_s=0.06, repeat=True)
    record(tmp_path, 60, start=12.5)
    late = load(tmp_path, file="a.csv", period_s=0.06, repeat=True)
    np.testing.assert_allclose(late.times_s, whole.times_s, atol=1e-14)
    assert late.values_mm == whole.values_mm


def test_a_record_that_is_shorter_than_the_period_is_refused(tmp_path):
    record(tmp_path, 30)
    with pytest.raises(SceneError, match="before the period does"):
        load(tmp_path, file="a.csv", period_s=0.06, repeat=True)


def test_a_period_of_a_single_row_is_refused(tmp_path):
    """It would be a constant load."""
    record(tmp_path, 30)
    with pytest.raises(SceneError, match="is not longer than the time from row to row"):
        load(tmp_path, file="a.csv", period_s=0.0006, repeat=True)


def test_the_period_of_rows_is_looked_at_as_any_other():
    rows = {"kind": "table", "times_s": [0.0, 1e9, 3e9], "values_mm": [0.0, 1e-4, 0.0]}
    slow = load_scene("section4").with_({"load": rows})
    assert any("period_s = 3e+09 is outside" in notice for notice in slow.notices)


def test_the_seam_and_the_drift_of_a_record_are_told(tmp_path):
    record(tmp_path, 200)
    told = " ".join(scene(tmp_path, file="a.csv", period_s=0.06, repeat=True).notices)
    assert "61 rows" in told
    assert "mean" in told
    assert "there U_a changes by" in told
    assert "ends where it began" not in told


def test_a_record_that_is_whole_without_its_seam_is_told(tmp_path):
    (tmp_path / "a.csv").write_text("t_s,U_a_mm\n0,0\n0.03,1e-4\n0.06,0\n")
    told = " ".join(scene(tmp_path, file="a.csv", repeat=True).notices)
    assert "ends where it began" in told
