"""The command `wear`: what all its commands share, and those that need no solver."""

import json
import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from tests.programs import run
from wear import cli
from wear.cite import REFERENCES
from wear.faults import Interrupted
from wear.scene import builtin_names, load_scene, parse_scene

ROOT = Path(__file__).parents[2]
COMMANDS = cli.COMMANDS.split()


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_teaches_by_an_example(call, name):
    status, shown, messages = call(name, "--help")
    assert (status, messages) == (0, "")
    assert re.search(rf"examples:\n +wear {name}", shown)


def test_the_help_lists_every_command(call):
    status, shown, _ = call("--help")
    assert status == 0
    assert all(re.search(rf"^ +{name} +\w", shown, re.MULTILINE) for name in COMMANDS)


def test_the_version_is_shown(call):
    assert re.fullmatch(r"wear \d+\.\d+\.\d+\n", call("--version")[1])


@pytest.mark.parametrize("arguments", [[], ["fly"], ["cite", "--fly"]])
def test_bad_usage_is_told_on_standard_error(call, arguments):
    status, shown, messages = call(*arguments)
    assert (status, shown) == (2, "")
    assert "usage:" in messages


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["rnu", "section4"], "wear: error: rnu: there is no such command; did you mean run?"),
        (["xyz"], "wear: error: xyz: there is no such command; `wear --help` lists the commands"),
        (["--vesrion"], "--vesrion: there is no such command; did you mean --version?"),
        (["run", "section4", "--cylces", "3"], "run: error: --cylces: not understood; did you "),
        (
            ["run", "section4", "section5"],
            "run: error: section5: more than this command takes",
        ),
        (["cite", "hairer93"], 'wear cite: KEY: "hairer93" is unknown; did you mean hairer1993?'),
        (["run", "section4", "--method", "foo"], '"foo" is unknown; choose one of auto, '),
        (["explore", "-o", "nowhere/x.html"], "wear explore: --output: nowhere: no such folder"),
        (["run", "section4", "--cycles", "9,000"], 'wear run: --cycles: "000": not a number of'),
        (["bench", "-o", f"{__file__}/speed"], "test_cli.py: is not a folder"),
        (["reproduce", "-o", f"{__file__}/report"], "test_cli.py: is not a folder"),
    ],
)
def test_a_slip_is_met_with_what_was_meant(call, arguments, told):
    status, shown, messages = call(*arguments)
    assert (status, shown) == (2, "")
    assert told in messages


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="/dev/full is Linux's")
@pytest.mark.parametrize("arguments", [["--version"], ["scenes"]])
def test_a_full_disk_is_told_whatever_is_printed(arguments):
    with Path("/dev/full").open("wb") as full:
        done = subprocess.run(
            [sys.executable, "-m", "wear", *arguments],
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            check=False,
        )
    assert done.stderr == f"wear {arguments[0]}: No space left on device\n"
    assert done.returncode == 2


@pytest.mark.parametrize(
    "line",
    [
        "run section4 --cycles 0:2000 -o wear.csv",
        "run section4 --cycles 0:2000 -o wear.nc",
        "run section4 --cycles 0:2000 --phases 9 -o wear.nc",
        "figure section4 -o wear.svg",
    ],
)
def test_a_disk_that_fills_up_is_told_and_nothing_is_left(call, line, tmp_path, monkeypatch):
    """A limit on the size of files stands for the disk; what was there before stays."""
    resource = pytest.importorskip("resource", reason="limits on files are those of Unix")
    monkeypatch.chdir(tmp_path)
    command, *_, name = line.split()
    file = tmp_path / name
    file.write_text("before")
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (4096, limits[1]))
    try:
        status, _, messages = call(*line.split())
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    assert (status, messages) == (2, f"wear {command}: {name}: File too large\n")
    assert [path.name for path in tmp_path.iterdir()] == [name]
    assert file.read_text() == "before"


def interrupted(*_, **__):
    """Stands for `solve` when Ctrl-C is pressed."""
    raise Interrupted("DOP853: interrupted; no requested cycle was reached", None)


def test_ctrl_c_ends_any_command_that_solves(call, monkeypatch, tmp_path):
    monkeypatch.setattr("wear.solver.solve", interrupted)
    status, shown, messages = call("figure", "section4", "-o", str(tmp_path / "wear.svg"))
    assert (status, shown) == (130, "")
    assert messages.startswith("wear figure: DOP853: interrupted")
    assert list(tmp_path.iterdir()) == []


def test_ctrl_c_ends_a_benchmark_and_not_one_run_of_it(call, monkeypatch, tmp_path):
    monkeypatch.setattr("wear.benchmark.methods.solve", interrupted)
    folder = tmp_path / "hard"
    status, shown, messages = call("bench", "--hard", "--quick", "-o", str(folder))
    assert (status, shown, messages) == (130, "", "wear bench: interrupted\n")
    assert not folder.exists()


def test_the_installed_command_is_this_one():
    command = Path(sys.executable).with_name("wear")
    if not command.exists():
        pytest.skip("wear is not installed beside this interpreter")
    assert "@misc{note," in run(command, "cite", "note")


def test_scenes_lists_all_with_titles(call):
    status, shown, _ = call("scenes")
    assert status == 0
    listed = dict(line.split(maxsplit=1) for line in shown.splitlines())
    assert listed == {name: load_scene(name).title for name in builtin_names()}


def test_scenes_json_has_the_same(call):
    documents = json.loads(call("scenes", "--json")[1])
    assert [document["name"] for document in documents] == list(builtin_names())
    assert set(documents[0]) == {"name", "title", "description"}


@pytest.mark.parametrize("name", ["section3", "section4"])
def test_a_described_scene_is_a_scene_file(call, name):
    described = call("scenes", "--describe", name)[1]
    assert parse_scene(described, name) == load_scene(name)
    [document] = json.loads(call("scenes", "--describe", name, "--json")[1])
    tables = tomllib.loads(described)
    assert document["tables"]["bearing"] == tables["bearing"]


def test_a_scene_that_is_not_there_is_told_with_a_guess(call):
    status, shown, messages = call("scenes", "secton4", "fly")
    assert (status, shown) == (2, "")
    assert "did you mean section4?" in messages
    assert '"fly"' in messages


def test_cite_gives_every_entry_once(call):
    entries = re.findall(r"^@\w+\{(.+),$", call("cite")[1], re.MULTILINE)
    assert entries == list(REFERENCES)
    assert [entry["key"] for entry in json.loads(call("cite", "--json")[1])] == entries


def test_cite_has_this_version_and_every_method():
    from wear.request import METHODS

    version = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["version"]
    assert REFERENCES["derive-wear"].fields["note"] == f"Version {version}"
    purposes = " ".join(reference.purpose for reference in REFERENCES.values())
    assert all(method in purposes for method in METHODS if method != "auto")


def test_cite_is_bibtex_that_latex_takes(call, need_tool, tmp_path):
    need_tool("bibtex")
    (tmp_path / "all.bib").write_text(call("cite")[1])
    (tmp_path / "all.aux").write_text("\\citation{*}\n\\bibdata{all}\n\\bibstyle{plain}\n")
    run("bibtex", "all", cwd=tmp_path)
    written = (tmp_path / "all.bbl").read_text()
    assert all(f"\\bibitem{{{key}}}" in written for key in REFERENCES)


def test_the_completion_knows_commands_scenes_and_options(call, need_tool):
    need_tool("bash")
    script = call("--print-completion")[1]
    ask = "COMP_WORDS=(wear scenes section4); COMP_CWORD=2; _wear_complete; echo ${COMPREPLY[@]}"
    offered = run("bash", "-c", f"{script}\n{ask}", env={"PATH": os.environ["PATH"]}).split()
    assert offered == [name for name in builtin_names() if name.startswith("section4")]
