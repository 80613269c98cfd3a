"""`wear reproduce`, `wear asymptote`, `wear figure`."""

import dataclasses
import hashlib
import json
from contextlib import nullcontext
from pathlib import Path

import pytest

from derive import verification
from derive.check import Check
from derive.note import claims as note_claims
from tests.wear.report import quick
from wear import processes, regime
from wear.report import claims, paper, publish, runs
from wear.scene import load_scene

PAPERS = Path(__file__).parents[2] / "docs" / "papers"
ALWAYS = {
    "report.html", "report.tex", "equations.tex", "claims.json", "manifest.json",
    *(f"figure-{n}.{kind}" for n in ("2a", "2b", "3a", "3b") for kind in ("svg", "pdf")),
}  # fmt: skip


@pytest.fixture
def shortened(monkeypatch):
    """Have the main job use quick runs, trust the derivations, and find no TeX."""
    monkeypatch.setattr(runs, "run", lambda _: quick.runs())
    monkeypatch.setattr(verification, "verification_of", lambda found, _: quick.trusted(found))
    alone = nullcontext(lambda task, *given: lambda: task(*given))
    monkeypatch.setattr(processes, "assistant", lambda: alone)
    few = {entry.claim.id: entry for entry in quick.few_claims()}
    monkeypatch.setattr(claims, "decided", few.__getitem__)
    monkeypatch.setattr(note_claims, "CLAIMS", few)
    monkeypatch.setattr(paper, "paper", lambda *_: quick.paper())
    monkeypatch.setattr(paper, "drawings", lambda _: {})
    monkeypatch.setattr(publish.shutil, "which", lambda _: None)


@pytest.mark.usefixtures("shortened")
def test_the_main_job_writes_every_file(call, tmp_path):
    folder = tmp_path / "report"
    status, shown, messages = call("reproduce", "-o", str(folder), "--json")
    summary = json.loads(shown)
    assert status == 0
    assert ALWAYS <= {path.name for path in folder.iterdir()} == set(summary["files"])
    assert "texlive" in messages
    assert not any(path.name.startswith(".") for path in folder.iterdir())
    _check_manifest(folder)
    entries = json.loads((folder / "claims.json").read_text())
    assert [entry["id"] for entry in entries] == list(quick.CLAIMS)
    assert set(entries[0]) == {"id", "where", "statement", "verdict", "evidence"}
    papers = json.loads((PAPERS / "claims.json").read_text(encoding="utf-8"))
    derived = [entry for entry in entries if "checks hold" in entry["evidence"]]
    assert derived
    assert all(entry in papers for entry in derived), "see docs/papers/build.py"


def _check_manifest(folder: Path) -> None:
    """Every other file has its checksum there, and no path of this machine is."""
    manifest = json.loads((folder / "manifest.json").read_text())
    found = {path.name for path in folder.iterdir()} - {"manifest.json"}
    assert set(manifest["sha256"]) == found
    for name, digest in manifest["sha256"].items():
        assert hashlib.sha256((folder / name).read_bytes()).hexdigest() == digest
    assert {"python", "numpy", "sympy"} <= set(manifest["versions"])
    assert str(folder.parent) not in json.dumps(manifest)


@pytest.mark.usefixtures("shortened")
def test_a_step_that_does_not_hold_is_told(call, tmp_path, monkeypatch):
    failure = ("21", Check("proof", False, "the move gives something else"))

    def failing(found, _):
        return dataclasses.replace(quick.trusted(found), failures=(failure,))

    monkeypatch.setattr(verification, "verification_of", failing)
    status, shown, messages = call("reproduce", "-o", str(tmp_path))
    assert status == 1
    assert "1 FAILED" in shown
    assert "(21) proof fails: the move gives something else" in messages


@pytest.mark.usefixtures("shortened")
def test_an_interrupt_leaves_nothing_behind(call, tmp_path, monkeypatch):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(claims, "decided", interrupted)
    folder = tmp_path / "report"
    assert call("reproduce", "-o", str(folder))[0] == 130
    assert not folder.exists()


KEYS = {
    "scene", "regime", "tanh_argument", "wear_per_cycle_mm", "pressure_MPa", "log_coefficient_mm",
    "offset_mm", "arrest_wear_mm", "arrest_cycle", "cycles_to_stabilise", "notices",
}  # fmt: skip


@pytest.mark.parametrize("name", ["section4", "f-zero", "roughness-vanishing", "chatter"])
def test_the_asymptote_has_the_keys_of_the_contract(call, name):
    status, shown, messages = call("asymptote", name, "--json")
    found = json.loads(shown)
    assert (status, messages) == (0, "")
    assert set(found) >= KEYS
    assert found["scene"] == load_scene(name).title  # as `wear run` has it
    assert found["regime"] == regime.asymptote(load_scene(name)).regime


def test_a_logarithmic_figure_begins_with_the_first_cycle(call, tmp_path):
    file = tmp_path / "wear.svg"
    shown = call("figure", "section4", "-o", str(file), "--cycles", "1e8", "--log", "--json")[1]
    assert json.loads(shown)["cycles"] == [1, 10**8]


def test_a_figure_of_the_pressure_inside_cycles(call, tmp_path):
    file = tmp_path / "pulses.svg"
    request = ("figure", "section4-cutoff", "-o", str(file), "--inside", "10,0", "--json")
    status, shown, _ = call(*request)
    assert status == 0
    assert json.loads(shown)["cycles"] == [0, 10]
    assert file.read_text().startswith("<?xml")
    blocks = str(Path(__file__).parents[2] / "docs" / "examples" / "blocks.toml")
    status, _, messages = call("figure", blocks, "-o", str(file), "--inside", "0:9")
    assert status == 2
    assert "10 cycles in one figure" in messages
    assert "the load does not repeat" in messages


def test_a_figure_of_several_scenes_with_readings_and_a_limit(call, tmp_path):
    data, file = tmp_path / "read.csv", tmp_path / "both.svg"
    data.write_text("cycles,wear_um\n10,0.3\n50,0.7\n")
    request = ("figure", "section4", "section4-cutoff", "-o", str(file), "--data", str(data))
    shown = json.loads(call(*request, "--until-wear", "5e-3", "--axis", "distance", "--json")[1])
    assert (shown["scenes"], shown["cycles"]) == (["section4", "section4-cutoff"], [0, 50])
    assert shown["reached"] == ["counted", "never"]
    assert shown["cycles_until"][1] is None
    assert ": 1 cycle\n" in call(*request, "--until-wear", "1e-5")[1]
    data.write_text("cycles,wear_um,motion.radius_mm\n10,0.3,-1\n20,1,-1\n")
    status, _, messages = call(*request, "--axis", "days")
    assert status == 2
    assert all(word in messages for word in ("--axis", "radius_mm", "negative"))


def test_readings_of_two_specimens_have_a_run_each(call, tmp_path):
    data, file = tmp_path / "read.csv", tmp_path / "both.svg"
    data.write_text(
        "specimen,cycles,wear_um,motion.radius_mm\nA,10,0.3,22\nA,20,0.4,22\nB,10,0.5,40\n"
    )
    shown = call("figure", "section4", "-o", str(file), "--data", str(data), "--json")[1]
    assert json.loads(shown)["scenes"] == ["A", "B"]


def test_all_faults_of_a_figure_are_told_at_once(call):
    status, _, messages = call("figure", "nowhere", "-o", "wear.gif", "--cycles", "1,2")
    assert status == 2
    assert all(word in messages for word in ("nowhere", ".gif", "one number of cycles"))
