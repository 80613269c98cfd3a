"""`wear run`: the state after given numbers of cycles, and what goes wrong with the request."""

import csv
import json
import re
import signal
import subprocess
import sys
import time
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
import pytest

from tests import programs
from wear.commands.run_output import text
from wear.faults import AccuracyError, Interrupted
from wear.load.spans import most_cycles
from wear.scene import load_scene
from wear.solver import solve

EXAMPLES = Path(__file__).parents[2] / "docs" / "examples"


@pytest.fixture
def run(call):
    """Run `wear run`; give status, output and messages."""
    return partial(call, "run")


@pytest.fixture
def solver(monkeypatch):
    """Have `wear run` call another function in place of the solver."""

    def put(function):
        monkeypatch.setattr("wear.solver.solve", function)

    return put


@pytest.fixture(scope="module")
def history():
    return solve(load_scene("section4"), (1, 10), rtol=1e-6)


def test_json_is_that_of_the_history(run):
    status, shown, _ = run("section4", "--cycles", "1,10", "--rtol", "1e-8", "--json")
    document = json.loads(shown, parse_constant=pytest.fail)
    history = solve(load_scene("section4"), (1, 10), rtol=1e-8)
    assert status == 0
    assert set(document) == set(history.as_json())
    assert document["cycles"] == [1, 10]
    for name, values in history.columns().items():
        assert document[name] == values.tolist()


def test_all_faults_are_told_at_once(run, tmp_path):
    status, shown, messages = run(
        *("secton4", "--set", "bearing.hardness_MPa=-1", "--cycles", "1.5,nan,abc,1e400,-3,7"),
        *("--rtol", "2", "--method", "DOP85", "--time-limit", "-1"),
        *("-o", str(tmp_path / "missing" / "wear.csv")),
    )
    assert (status, shown) == (2, "")
    told = [
        "did you mean the built-in scene section4",
        '"1.5", "nan", "abc", "1e400", "-3": not a number of cycles',
        '--rtol: "2"',
        "did you mean DOP853?",
        '--time-limit: "-1"',
        "missing: no such folder",
    ]
    assert [phrase for phrase in told if phrase not in messages] == []


@pytest.mark.parametrize("cycles", ["", ",", "1,", "1;2", "2e12", "inf", "0x10", "1" * 5000,
                                    "4:2", "1:2:3", ":3", "3:", "0:1e7", "1.5:3"])  # fmt: skip
def test_what_is_no_list_or_range_of_cycles_is_refused(run, cycles):
    status, shown, messages = run("section4", "--cycles", cycles)
    assert (status, shown) == (2, "")
    assert "--cycles" in messages
    assert ":" not in cycles or f'"{cycles}": not a number of cycles' in messages
    assert len(messages) < 400


@pytest.mark.parametrize("name", ["wear", "wear.xlsx", "wear.CSV.gz"])
def test_an_unknown_form_of_file_is_refused_before_solving(run, solver, tmp_path, name):
    solver(pytest.fail)
    status, _, messages = run("section4", "-o", str(tmp_path / name))
    assert status == 2
    assert ".csv, .nc, .tex" in messages


def test_the_latex_table_compiles(run, need_tool, tmp_path):
    need_tool("latexmk")
    assert run("section3", "--cycles", "1,1e4", "-o", str(tmp_path / "wear.tex"))[0] == 0
    (tmp_path / "main.tex").write_text(
        "\\documentclass{article}\\usepackage{booktabs}\\usepackage[landscape]{geometry}\n"
        "\\begin{document}\\small\\input{wear}\\end{document}\n"
    )
    command = ("latexmk", "-pdf", "-interaction=nonstopmode", "-halt-on-error", "main.tex")
    programs.run(*command, cwd=tmp_path)
    assert "Overfull" not in (tmp_path / "main.log").read_text()


@pytest.mark.parametrize(("fault", "status"), [("interrupted", 130), ("accuracy", 3)])
def test_what_was_computed_is_kept(run, solver, history, tmp_path, fault, status):
    def stop(*_, **__):
        if fault == "interrupted":
            raise Interrupted("interrupted after 10 cycles", history)
        raise AccuracyError("only 1e-4 was reached", history)

    solver(stop)
    file = tmp_path / "wear.csv"
    done, shown, messages = run("section4", "--json", "-o", str(file))
    assert done == status
    assert json.loads(shown)["bearing_wear_mm"] == history.u_c.tolist()
    assert fault in messages or "1e-4" in messages
    assert len(file.read_text().splitlines()) > len(history.cycles)


def test_no_number_that_json_lacks_is_printed(run, solver, history):
    from dataclasses import replace

    solver(lambda *_, **__: replace(history, error=np.array([np.nan, np.inf])))
    document = json.loads(run("section4", "--json")[1], parse_constant=pytest.fail)
    assert document["error_estimate"] == [None, None]


def test_notices_go_to_standard_error(run):
    _, shown, messages = run("section3", "--cycles", "1", "--json")
    notices = json.loads(shown)["notices"]
    usual = "auto: abel, because the load repeats"
    assert [notice for notice in notices if notice not in messages] == [usual]
    _, table, same = run("section3", "--cycles", "1")
    assert ("method abel" in table, same) == (True, messages)


def test_an_unusual_choice_of_a_method_is_told(run, tmp_path):
    (tmp_path / "rows.csv").write_text("t_s,U_a_mm\n0,0\n1,1e-4\n4,0\n")
    own = tmp_path / "own.toml"
    own.write_text(load_scene("section4").to_toml().partition("[load]")[0])
    with own.open("a") as file:
        file.write('[load]\nkind = "history"\nfile = "rows.csv"\nperiod_s = 1.0\n')
    assert "auto: collocation, because" in run(str(own), "--cycles", "1", "--rtol", "1e-6")[2]


def test_no_state_at_all_is_told_in_words(history):
    fields = ("cycles", "u_c", "sigma_c", "h", "p", "error")
    nothing = replace(history, **{name: getattr(history, name)[:0] for name in fields})
    shown = text(nothing)
    assert "No requested cycle was reached." in shown
    assert "(mm)" not in shown


def test_states_inside_the_cycles_are_written(run, tmp_path):
    from scipy.io import netcdf_file

    path = tmp_path / "inside.nc"
    request = ("section4", "--cycles", "0,10,9000", "--phases", "4", "-o", str(path))
    request += ("--set", "title=Ω, µm")  # more than ASCII, which NetCDF-3 does not have
    status, shown, messages = run(*request, "--json")
    document = json.loads(shown)
    assert (status, messages) == (0, "")
    assert (document["cycles"], document["phases"], document["file"]) == (3, 4, str(path))
    assert document["largest_error_estimate"] <= document["rtol"]
    whole = solve(load_scene("section4"), (0, 10, 9000))
    with netcdf_file(path, mmap=False) as file:
        wear = file.variables["bearing_wear_mm"][:]
        assert file.variables["phase"][:].tolist() == [0.0, 0.25, 0.5, 0.75]
    np.testing.assert_allclose(wear[:, 0], whole.u_c, rtol=1e-12)
    assert np.all(np.diff(wear, axis=1) > 0.0)


def test_everything_against_states_inside_the_cycles_is_told_at_once(run):
    arguments = ("--phases", "2", "--method", "DOP853", "--time-limit", "3")
    scene = str(Path(__file__).parents[2] / "docs" / "examples" / "history.toml")
    status, _, messages = run(scene, *arguments)
    assert status == 2
    for phrase in ("--output", "--method", "--time-limit"):
        assert phrase in messages
    status, _, messages = run(scene, "--phases", "2", "--cycles", "2", "-o", "a.csv")
    assert (status, "the load ends" in messages) == (2, True)
    status, _, messages = run("section4", *arguments, "--cycles", "many")
    assert (status, '"many": not a number of cycles' in messages) == (2, True)


def test_states_inside_the_cycles_are_the_same_in_both_kinds_of_file(run, tmp_path):
    from scipy.io import netcdf_file

    paths = [tmp_path / "inside.csv", tmp_path / "inside.nc"]
    for path in paths:
        request = ("section4-cutoff", "--cycles", "30,0:9", "--phases", "7", "-o", str(path))
        assert run(*request)[0] == 0
    lines = (line for line in paths[0].read_text().splitlines() if not line.startswith("#"))
    rows = list(csv.DictReader(lines))
    assert [int(row["cycle"]) for row in rows[::7]] == [*range(10), 30]
    with netcdf_file(paths[1], mmap=False) as file:
        for name, variable in file.variables.items():
            if variable.dimensions == ("cycle", "phase"):
                assert [float(row[name]) for row in rows] == variable[:].ravel().tolist()
        assert [float(row["phase"]) for row in rows[:7]] == file.variables["phase"][:].tolist()


def test_states_inside_the_cycles_of_blocks(run, tmp_path):
    scene = str(EXAMPLES / "blocks.toml")
    path = tmp_path / "inside.csv"
    most = most_cycles(load_scene(scene).load)
    request = ("--phases", "2", "-o", str(path))
    assert run(scene, "--cycles", f"0,{most - 1}", *request)[0] == 0
    last = list(csv.reader(path.read_text().splitlines()))[-2]
    assert float(last[2]) == pytest.approx(solve(load_scene(scene), [most - 1]).u_c[0], rel=1e-9)
    status, _, messages = run(scene, "--cycles", f"0,{most}", *request)
    assert status == 2
    assert f"begins after {most - 1}" in messages


def test_the_usual_cycles_go_to_the_end_of_the_load(call, tmp_path):
    scene = tmp_path / "short.toml"
    scene.write_text((EXAMPLES / "blocks.toml").read_text().replace("repeat = 10", "repeat = 1"))
    for command, cycles in (("run", [1, 10, 100, 1000, 2000]), ("sensitivity", [1, 2000])):
        assert json.loads(call(command, str(scene), "--json")[1])["cycles"] == cycles
        status, _, messages = call(command, str(scene), "--cycles", "1,9000")
        assert (status, "is 2000; name cycles up to that" in messages) == (2, True)
    path = tmp_path / "inside.csv"
    assert call("run", str(scene), "--phases", "1", "-o", str(path))[0] == 0
    assert path.read_text().splitlines()[-1].startswith("1999,0.0,")


@pytest.mark.parametrize("suffix", [".nc", ".csv"])
def test_ctrl_c_while_states_are_written_leaves_what_was_there(suffix, tmp_path):
    """The signal itself, as soon as there is a draft beside the file."""
    path = tmp_path / f"inside{suffix}"
    path.write_text("before")
    request = ("section4", "--cycles", "0:50000", "--phases", "100", "-o", str(path))
    process = subprocess.Popen(
        [sys.executable, "-c", LISTENING, "run", *request], stderr=subprocess.PIPE, text=True
    )
    while process.poll() is None and len(list(tmp_path.iterdir())) == 1:
        time.sleep(0.01)
    process.send_signal(signal.SIGINT)
    messages = process.communicate()[1]
    assert process.returncode == 130
    assert re.fullmatch(
        r"wear run: interrupted after \d+ of 50001 cycles; .* was not written\n", messages
    )
    assert list(tmp_path.iterdir()) == [path]
    assert path.read_text() == "before"


# A process that was started in the background ignores the signal.
LISTENING = """\
import signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)
from wear import cli
sys.exit(cli.main(sys.argv[1:]))
"""


def test_an_accuracy_that_is_missed_inside_the_cycles_is_told(run, tmp_path):
    path = str(tmp_path / "inside.nc")
    request = ("section3", "--cycles", "10", "--phases", "2", "--rtol", "1e-15", "-o", path)
    status, _, messages = run(*request)
    assert status == 3
    assert "1.0e-15 was requested" in messages
    assert Path(path).exists()


def test_until_wear_is_the_inverse_of_the_count(run):
    """Wear that the references give after 1000 and after 9000 cycles, and one never reached."""
    wears = "2.0235737896319597e-03,4.4133292056883764e-03"
    status, shown, _ = run("section4", "--until-wear", wears, "--rtol", "1e-10", "--json")
    found = json.loads(shown)["cycles_until"]
    assert status == 0
    assert found["cycles"] == [1000, 9000]
    assert max(found["error_estimate"]) < 1e-9
    status, shown, _ = run("roughness-vanishing", "--until-wear", "1.0", "--rtol", "1e-8", "--json")
    assert json.loads(shown)["cycles_until"]["cycles"] == [None]
    _, shown, _ = run("section4", "--until-wear", "1e-3")
    assert re.search(r"1e-3|0\.001", shown)
