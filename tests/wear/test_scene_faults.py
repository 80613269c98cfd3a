"""Bad scenes: every fault at once, each with its place, its words and its remedy."""

from pathlib import Path

import pytest

from wear.faults import Fault, SceneError
from wear.scene import load_scene, parse_scene

GOOD = """title = "good"
[bearing]
hardness_MPa = 200.0
wear_coefficient = 1e-6
roughness_mm = 3.6e-4
roughness_growth = 0.25

[contact]
max_pressure_MPa = 300.0
closure_mm = 1.08e-3

[motion]
radius_mm = 22.0
speed_rpm = 2000.0

[load]
kind = "sine"
amplitude_mm = 5e-4
period_s = 0.06
"""


def faults_of(text: str | bytes, *overrides: str, folder: Path | None = None) -> list[Fault]:
    with pytest.raises(SceneError) as caught:
        parse_scene(text, "a.toml", folder, overrides)
    return list(caught.value.faults)


def only_fault(text: str | bytes, *overrides: str, folder: Path | None = None) -> Fault:
    (fault,) = faults_of(text, *overrides, folder=folder)
    return fault


def test_the_example_of_the_contract() -> None:
    fault = only_fault(GOOD + "[support]\nstifness_MPa_per_mm = 1e5\n")
    assert str(fault) == (
        "a.toml:21: [support] stifness_MPa_per_mm: unknown key; did you mean stiffness_MPa_per_mm?"
    )


def test_every_fault_at_once_each_with_its_line() -> None:
    text = """
titel = "a"
[bering]
[contact]
max_pressure_MPa = "300.0"
closure_mm = -1.0
width_mm = 1.0
[motion]
radius_mm = true
speed_rpm = inf
[load]
kind = "sine"
amplitude_mm = [1.0]
"""
    found = {(fault.line, fault.table, fault.key) for fault in faults_of(text)}
    assert found == {
        (2, "", "titel"),
        (3, "", "bering"),
        (5, "contact", "max_pressure_MPa"),
        (6, "contact", "closure_mm"),
        (4, "contact", ""),
        (9, "motion", "radius_mm"),
        (10, "motion", "speed_rpm"),
        (13, "load", "amplitude_mm"),
        (11, "load", "period_s"),
    }


@pytest.mark.parametrize(
    ("entry", "value", "problem", "remedy"),
    [
        ("bearing.hardness_MPa", "0.0", "is zero", "> 0, in MPa"),
        ("bearing.hardness_MPa", "-200.0", "negative", "> 0, in MPa"),
        ("bearing.hardness_MPa", "nan", "not a finite number", "> 0"),
        ("bearing.hardness_MPa", "-inf", "not a finite number", "> 0"),
        ("bearing.hardness_MPa", "1e999", "not a finite number", "> 0"),
        ("bearing.hardness_MPa", "1" + "0" * 400, "too large for a float", "> 0"),
        ("bearing.hardness_MPa", "1e300", "out of range", "from 1e-30 to 1e+30"),
        ("bearing.hardness_MPa", "true", "is true or false", "give a number, in MPa"),
        ("bearing.hardness_MPa", '"0.12"', "is text, not a number", "no quotes, no unit"),
        ("bearing.hardness_MPa", '"hard"', "is text", "give a number, in MPa"),
        ("bearing.hardness_MPa", "[200.0]", "is a list", "give a number"),
        ("bearing.hardness_MPa", "200,5", "is text", "a point before the decimals"),
        ("bearing.hardness_MPa", "{ a = 1 }", "is a table", "give a number"),
        ("bearing.hardness_MPa", "1979-05-27", "is a date", "give a number"),
        ("bearing.wear_coefficient", "0", "is zero", "> 0"),
        ("bearing.roughness_mm", "0", "zero on the only rough solid", "> 0"),
        ("bearing.roughness_growth", "1e-40", "out of range", "any finite number"),
        ("contact.closure_mm", "-1e-9", "negative", ">= 0, in mm"),
        ("contact.ends_at_3_sigma", "0", "is a number", "true or false"),
        ("contact.law", "tanhh", "unknown", "did you mean tanh?"),
        ("contact.law", "3", "not a name", "choose one of"),
        ("contact.width_mm", "3.0", "length_mm is missing", "drop width_mm"),
        ("contact.closure_um", "1.0", "unknown key", "did you mean closure_mm"),
        ("contact.cutoff", "true", "unknown key", "renamed to ends_at_3_sigma"),
        ("bearing.roughness_slope", "0.1", "unknown key", "renamed to roughness_growth"),
        ("contact.radius_mm", "1.0", "unknown key", "it belongs to [motion]"),
        ("load.value_mm", "1.0", "unknown key", 'it belongs to kind = "constant"'),
        ("load.kind", "sinus", "unknown", "did you mean sine?"),
        ("load.kind", "constant", "missing", "add value_mm"),
        ("motion", "3", "motion is a table with several entries", "--set motion.radius_mm=VALUE"),
        ("load", "sine", "load is a table with several entries", "--set load.kind=VALUE"),
        ("title", "3", "is a number", 'title = "..."'),
        ("title", '"a\\u0007b"', "control characters", "printable"),
        ("title", '"' + "a" * 201 + '"', "201 characters", "at most 200"),
        ("zzz.key", "3", "unknown table", "known here: bearing, contact, motion, load"),
        ("bearing.zzz", "3", "unknown key", "known here: hardness_MPa"),
        ("period_s", "0.1", "the table is missing", "did you mean load.period_s?"),
    ],
)
def test_one_bad_value(entry: str, value: str, problem: str, remedy: str) -> None:
    fault = only_fault(GOOD, f"{entry}={value}")
    assert problem in fault.problem
    assert remedy in fault.remedy
    if fault.line is None:
        assert fault.file.startswith(f"--set {entry}=")


def test_a_table_that_is_none_in_a_file() -> None:
    rest = GOOD.replace("[motion]\nradius_mm = 22.0\nspeed_rpm = 2000.0\n", "")
    fault = only_fault("motion = 3\n" + rest)
    assert (fault.line, fault.problem) == (1, "is not a table")


def test_what_is_missing() -> None:
    found = {(f.table, f.key, f.problem) for f in faults_of("[load]\n[bearing]\nhardness_MPa=1\n")}
    assert found == {
        ("bearing", "wear_coefficient", "missing"),
        ("bearing", "roughness_mm", "missing"),
        ("bearing", "roughness_growth", "missing"),
        ("contact", "", "missing"),
        ("motion", "", "missing"),
        ("load", "kind", "missing"),
    }


def test_neither_closure_and_both() -> None:
    neither = only_fault(GOOD.replace("closure_mm", "# closure_mm"))
    assert neither.problem == "closure_mm or closure_in_sigma is missing"
    assert (neither.line, neither.table) == (8, "contact")
    both = only_fault(GOOD.replace("closure_mm", "closure_in_sigma = 3.0\nclosure_mm"))
    assert both.problem == "closure_mm and closure_in_sigma are both given"


def test_roughness_zero_on_both_solids() -> None:
    pin = "[pin]\nhardness_MPa=1\nwear_coefficient=0\nroughness_mm={}\nroughness_growth=0\n"
    text = GOOD.replace("roughness_mm = 3.6e-4", "roughness_mm = 0.0")
    fault = only_fault(text + pin.format("0.0"))
    assert "both solids" in fault.problem
    parse_scene(text + pin.format("1e-4"))
    parse_scene(GOOD + pin.format("0.0"))


def test_an_option_that_cannot_be_read_hides_no_other_fault() -> None:
    found = faults_of(GOOD.replace("200.0", "-200.0"), "no equals sign", "a.b.c=3", ".x=1")
    assert [fault.file for fault in found] == [
        "--set no equals sign",
        "--set a.b.c=3",
        "--set .x=1",
        "a.toml",
    ]
    assert all("--set TABLE.KEY=VALUE" in fault.remedy for fault in found[:3])


# Files


@pytest.mark.parametrize(
    ("data", "line", "problem"),
    [
        (b"", None, "is empty"),
        (b"\n \n", None, "is empty"),
        (b"title = 'a'\n\xff\xfe", 2, "is not UTF-8 text"),
        (b"title = 'a'\n[bearing\n", 2, "is not TOML"),
        (b"title = 'a'\nx = \n", 2, "is not TOML"),
        (b"title = 'a'\ntitle = 'b'\n", 2, "is not TOML"),
        (b'title = """a\n\n', 1, "is not TOML"),
        (
            b"x = 1\ny = 180,0\nz = 3\n",
            2,
            'is not TOML: Expected newline or end of document after a statement: "y = 180,0"',
        ),
        (b"x = " + b"9" * 4090, 1, "unknown key"),
        (b"x = " + b"[" * 4000, None, "nested too deeply"),
        (b"x = " + b"[\n" * 50_000, None, "nested too deeply"),
        (b"x = 1\n# " + b"a" * 5000, 2, "more than 4096 characters"),
        (b"# a\n" * 100_000, None, "is larger than 256 KiB"),
        (b"\x00", 1, "is not TOML"),
    ],
)
def test_what_is_no_scene_at_all(data: bytes, line: int | None, problem: str) -> None:
    fault = faults_of(data)[0]
    assert problem in fault.problem
    assert fault.line == line


def test_a_byte_order_mark_and_windows_lines_do_no_harm() -> None:
    data = b"\xef\xbb\xbf" + GOOD.replace("\n", "\r\n").encode()
    assert parse_scene(data) == parse_scene(GOOD)
    assert only_fault(data.replace(b"200.0", b"-200.0")).line == 3


def test_lines_are_found_however_the_key_is_written() -> None:
    assert only_fault(GOOD.replace("200.0", "-200.0")).line == 3
    inline = GOOD.replace("[motion]\nradius_mm = 22.0\nspeed_rpm = 2000.0\n", "")
    dotted = "motion . radius_mm = -22.0\nmotion.'speed_rpm' = 0\n" + inline
    assert [fault.line for fault in faults_of(dotted)] == [1, 2]
    in_braces = "motion = { radius_mm = -22.0, speed_rpm = 2000.0 }\n" + inline
    assert only_fault(in_braces).line == 1
    text = 'description = """\n[bearing]\nhardness_MPa = 3\n"""\n' + GOOD
    assert only_fault(text.replace("200.0", "-200.0")).line == 7


def test_a_decimal_comma_is_named() -> None:
    (fault,) = faults_of(GOOD.replace("200.0", "200,0  # MPa"))
    assert fault.remedy == "write 0.5, with a point"


def test_names_that_lead_nowhere(tmp_path: Path) -> None:
    def fault(name: str | Path) -> Fault:
        with pytest.raises(SceneError) as caught:
            load_scene(name)
        (only,) = caught.value.faults
        return only

    assert "did you mean the built-in scene section4?" in fault("secton4").remedy
    assert "`wear scenes`" in fault("my-scene").remedy
    assert fault("").problem == "is a folder"
    assert fault(tmp_path / "no.toml").problem == "there is no such file"
    (tmp_path / "mine.toml").touch()
    assert fault(tmp_path / "mien.toml").remedy == "did you mean mine.toml?"
    assert fault(tmp_path).problem == "is a folder"
    assert fault("a\0b").problem
    assert "\x1b" not in str(fault("\x1b[31m"))
    assert fault("a" * 10_000).problem
    large = tmp_path / "large.toml"
    with large.open("wb") as stream:
        stream.truncate(2**30)  # a hole: no bytes on the disk
    assert fault(large).problem == "is larger than 256 KiB"
    assert fault(large).remedy == "give a smaller file"  # it is there: no other is meant


# CSV files of loads

HEAD = "t_s,U_a_mm\n"


@pytest.mark.parametrize(
    ("rows", "problem", "remedy"),
    [
        ("", "the columns are missing", "begin with t_s,U_a_mm"),
        ("t,U\n0,0\n1,0\n", "the columns are t,U", 't_s,U_a_mm, or say columns = ["t", "U"]'),
        ("0.0,0.0\n1,0\n", "the columns have no names", "put the line t_s,U_a_mm above"),
        ("t_s,x_um\n0,0\n1,0\n", "the columns are t_s,x_um", '["t_s", "x_um"], unit = "um"'),
        ("t_s;U_a_mm\n0,0;0,0\n", "the columns are t_s;U_a_mm", "commas between the columns"),
        ("t_s\tU_a_mm\n0\t0\n", "the columns are t_s\\x09U_a_mm", "points in the numbers"),
        ("\n" + HEAD, "line 2: too few rows stand below: 0", "from 2 to 1000000"),
        (HEAD + "0,0\n", "too few rows stand below: 1", "from 2 to 1000000"),
        (HEAD + "0,0\n1,a\n", 'line 3: U_a_mm is "a"', "without unit, such as 0.5"),
        (HEAD + "0,0\r\r1,0,0", 'line 4: "1,0,0" has 3 cells, the header 2', "delimiter"),
        (HEAD + "0,0\n1,nan\n", 'line 3: U_a_mm is "nan"', "give a number"),
        (HEAD + "0,0\ninf,0\n", 'line 3: t_s is "inf"', "give a number"),
        (HEAD + "0,0\n1,1e200\n", 'line 3: U_a_mm is "1e200"', "from 1e-30 to 1e+30"),
        ("t_s,U_a_mm,t_s\n0,0,0\n1,0,0\n", "two columns are called t_s", "rename one"),
        (HEAD + "1,0\n2,0\n", "t_s starts at 1.0", "subtract"),
        (HEAD + "0,0\n2,1\n1,0\n", "does not come after 2.0", "sort"),
        (HEAD + "0,0\n1,1\n1,0\n", "does not come after 1.0", "keep one of the two"),
        (HEAD + "0,0\n# a remark\n1,0\n", "is a comment below the header", "put it above"),
        (HEAD + "0,0\n1,1e-4\n", "jumps at the seam from 0.0001 to 0.0", "repeat the first"),
    ],
)
def test_bad_rows(rows: str, problem: str, remedy: str, tmp_path: Path) -> None:
    (tmp_path / "pin.csv").write_text(rows)
    fault = only_fault(table_text("pin.csv"), folder=tmp_path)
    assert problem in fault.problem
    assert remedy in fault.remedy


def table_text(file: str) -> str:
    head = GOOD[: GOOD.index("[load]")]
    return f"{head}[load]\nkind = \"table\"\nfile = '{file}'\n"


def test_bad_csv_files(tmp_path: Path) -> None:
    (tmp_path / "latin.csv").write_bytes(HEAD.encode() + b"0,\xe9\n")
    (tmp_path / "utf-16.csv").write_text(HEAD, "utf-16")
    with (tmp_path / "large.csv").open("wb") as stream:
        stream.truncate(2**30)
    (tmp_path / "ten.csv").write_text(HEAD + "x\n" * 100)
    (tmp_path / "long.csv").write_text(HEAD + "0,0\n2,0\n")
    for name, problem in (
        ("latin.csv", "is not UTF-8 text"),
        ("utf-16.csv", 'or give encoding = "utf-16"'),
        ("large.csv", "is larger than 65536 KiB"),
        ("none.csv", "there is no such file"),
        (".", "is a folder"),
        ("a" * 300, "cannot be read"),
        ("/dev/zero", "is larger than"),
    ):
        fault = only_fault(table_text(name), folder=tmp_path)
        assert problem in f"{fault.problem}; {fault.remedy}"
        assert (fault.line, fault.table, fault.key) == (18, "load", "file")
    assert len(faults_of(table_text("ten.csv"), folder=tmp_path)) == 5
    assert "no folder" in only_fault(table_text("long.csv")).problem
    shorter = only_fault(table_text("long.csv") + "period_s = 1.0\n", folder=tmp_path)
    assert "past the period" in shorter.problem


def test_a_bad_table_and_other_faults_are_told_together(tmp_path: Path) -> None:
    text = table_text("none.csv").replace("200.0", "-200.0")
    assert [fault.line for fault in faults_of(text, folder=tmp_path)] == [3, 18]


def test_faults_inside_blocks() -> None:
    block = '[[load.blocks]]\nkind = "sine"\namplitude_mm = 1e-4\nperiod_s = 1\ncycles = 3\n'
    head = GOOD[: GOOD.index("[load]")] + '[load]\nkind = "blocks"\n'
    parse_scene(head + block * 2)
    fault = only_fault(head + block + block.replace("cycles = 3", "cycles = 1.5"))
    assert str(fault) == (
        "a.toml:27: [load.blocks, block 2] cycles: "
        "1.5 is not a whole number; give a whole number from 1 to 1e+12"
    )
    assert "out of range" in only_fault(head + block.replace("= 3", "= 0")).problem
    assert "out of range" in only_fault(head + block.replace("= 3", "= 1" + "0" * 99)).problem
    assert "is true or false" in only_fault(head + block.replace("= 3", "= true")).problem
    assert "unknown" in only_fault(head + block.replace("sine", "history")).problem
    assert "unknown" in only_fault(head + block.replace("sine", "blocks")).problem
    assert only_fault(head).key == "blocks"
    assert "not a list of tables" in only_fault(head + "blocks = 3\n").problem
    assert "has 0 blocks" in only_fault(head + "blocks = []\n").problem
    total = only_fault(head + "repeat = 1000000000\n" + block.replace("= 3", "= 1000000"))
    assert "1e+15 cycles" in total.problem


def test_long_lists_are_refused() -> None:
    harmonics = "load.kind=harmonics"
    assert "101 entries" in only_fault(GOOD, harmonics, f"load.sine_mm={[1.0] * 101}").problem
    fault = only_fault(GOOD, harmonics, "load.sine_mm=[1, '2']")
    assert fault.problem == 'entry 2: "2" is text, not a number'
    assert "is a number" in only_fault(GOOD, harmonics, "load.sine_mm=1").problem


def test_a_missing_csv_file_is_told_with_the_folder(tmp_path: Path) -> None:
    problem = only_fault(table_text("none.csv"), folder=tmp_path).problem
    assert problem == f"none.csv: there is no such file (looked for in {tmp_path})"
    away = tmp_path / "none.csv"
    assert only_fault(table_text(str(away)), folder=tmp_path).problem.endswith("no such file")
