"""`wear report`: the report of a scene of one's scene_report."""

import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from derive.symbols import symbol
from derive.variant import VARIANTS
from derive.variant_equations import equations_of
from wear import solve
from wear.load import Block, Blocks, Sine
from wear.report import publish, scene_report
from wear.report.document import FigureFiles
from wear.report.text import inline
from wear.scene import load_scene


@pytest.fixture
def undrawn(monkeypatch):
    """Figures are named, not drawn."""
    none = FigureFiles("", b"")
    monkeypatch.setattr(
        scene_report, "drawn", lambda drawings: {f"fig:{name}": none for name in drawings}
    )


def test_the_files_and_what_they_say(tmp_path, call, monkeypatch):
    monkeypatch.setattr(publish.shutil, "which", lambda _: None)
    scene = tmp_path / "mine.toml"
    text = load_scene("section4-cutoff").to_toml()
    scene.write_text(re.sub(r'title = ".*"', 'title = "A *bearing* of mine, 50 %"', text))
    folder = tmp_path / "out"
    status, shown, _ = call("report", str(scene), "-o", str(folder), "--json")
    assert status == 0
    files = set(json.loads(shown)["files"])
    assert {"report.html", "report.tex", "equations.tex", "history.svg"} <= files
    page = (folder / "report.html").read_text(encoding="utf-8")
    assert "A *bearing* of mine, 50 %" in page
    assert "<em>arrest</em>" in page
    assert "wear report" in page
    assert ">never</td>" in page  # a depth beyond that of arrest


@pytest.mark.usefixtures("undrawn")
def test_the_numbers_are_those_of_the_solver_and_the_equations_those_of_the_variant():
    scene = load_scene("section4")
    document = scene_report.report(scene, "wear report section4")
    wear = solve(scene, [1, 10**6], rtol=1e-10).u_c * 1e3  # the wear after 1e7 cycles is absurd
    numbers = [t.meta["number"].value for t in inline(document.tokens) if t.type == "number"]
    values = np.array(numbers)
    for value in wear:
        assert np.min(np.abs(values / value - 1.0)) < 1e-7
    assert "tab:forces" not in document.marks
    shown = {e.id: e.latex for e in document.shown}
    names = ("closure", "roughness", "pressure", "wear", "slip", "whole")
    assert list(shown) == [*(f"scene-{name}" for name in names), "21", "22", "log-drift"]
    assert shown["scene-closure"] == "h = h_0 + u_c - U_a"
    assert {"sec:long", "sec:life", "sec:sensitivities", "fig:inside"} <= set(document.marks)


@pytest.mark.parametrize("opening", [False, True])
@pytest.mark.parametrize("variant", VARIANTS, ids=lambda each: f"{each.law.name}-{each.name}")
def test_every_variant_has_its_equations_and_the_one_for_all(variant, opening):
    shown = {each.id: each for each in equations_of(variant, opening=opening)}
    assert shown["scene-closure"].relation.has(symbol("u_a")) == variant.pin.wears
    if not variant.ends_at_3_sigma:
        assert not shown["scene-whole"].relation.has(symbol("u_a"), symbol("U_c"), symbol("p"))


EDGES = {
    "grazing": "arrest-depth", "deep-tail": "log-drift", "f-one-third": "one-third",
    "f-zero": "logarithmic-wear", "equal-wear": "two-solids-log-drift",
}  # fmt: skip


@pytest.mark.usefixtures("undrawn")
@pytest.mark.parametrize("name", EDGES)
def test_hard_scenes_have_a_report_with_the_equations_of_their_regime(name):
    """The first two also where the requested accuracy, or the offset, cannot be had."""
    document = scene_report.report(load_scene(name), f"wear report {name}")
    assert next(reversed(document.equations)) == EDGES[name]
    assert "sec:life" in document.marks


@pytest.mark.usefixtures("undrawn")
def test_blocks_have_no_long_run():
    """Nor pressure inside a cycle; what a cycle is differs from block to block."""
    hard, soft = Block(Sine(5e-4, 0.06), 3), Block(Sine(1e-4, 0.02), 2)
    scene = replace(load_scene("section4"), load=Blocks((hard, soft), repeat=10))
    document = scene_report.report(scene, "wear report mine.toml")
    assert set(document.figures) == {"fig:scene", "fig:history", "fig:sensitivities"}
    assert "sec:long" not in document.marks
    assert "sec:life" in document.marks


@pytest.mark.usefixtures("undrawn")
def test_forces_and_friction_of_the_cycles_stand_in_the_report(monkeypatch):
    known = ("friction_coefficient=0.12", "width_mm=20", "length_mm=30")
    scene = load_scene("section4", [f"contact.{entry}" for entry in known])
    history = solve(scene, [1, 10], rtol=1e-8)
    monkeypatch.setattr(scene_report, "_solved", lambda _: history)
    document = scene_report.report(scene, "wear report mine.toml")
    assert "tab:forces" in document.marks
    texts = [token.content for token in document.tokens]
    for head in ("Peak (N)", "Mean (N)", "Sliding (mm)", "Work (mJ/mm²)", "Work (mJ)"):
        assert any(head in text for text in texts)
    numbers = {t.meta["number"].value for t in inline(document.tokens) if t.type == "number"}
    columns = history.columns()
    assert {columns[name][-1] for name in ("friction_work_mJ", "mean_pin_reaction_N")} <= numbers


@pytest.mark.usefixtures("undrawn")
def test_a_law_of_the_scenes_own_stands_in_its_report(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    scene = load_scene("section4", ['contact.law={phi = "1/(1 + exp(r - 1))"}'])
    monkeypatch.setattr(scene_report, "_solved", lambda _: solve(scene, [1, 10], rtol=1e-6))
    shown = {e.id: e.latex for e in scene_report.report(scene, "wear report mine.toml").shown}
    assert r"\tanh" not in shown["scene-pressure"]
    assert "general-law" in shown


RECORD = """
[load]
kind = "table"
file = "pruefstand.csv"
columns = ["Zeit (ms)", "Weg (µm)"]
time_unit = "ms"
unit = "um"
delimiter = ";"
decimal = ","
encoding = "latin-1"
repeat = true
"""


def test_an_engineers_way_from_a_record_and_readings_to_a_report(tmp_path, call, monkeypatch):
    """401 noisy rows as LabVIEW writes them, fifteen readings; and the report."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(publish.shutil, "which", lambda _: None)
    noise = 0.010 * np.random.default_rng(3).standard_normal(401)
    times = np.arange(401) * 0.15
    path = 0.5 * np.sin(2.0 * np.pi * times / 60.03) + 0.2 + noise
    rows = [f"{t:.4f};{120.0 + x:.2f};{x:.4f}" for t, x in zip(times, path, strict=True)]
    record = "\n".join(["Zeit (ms);Kraft (N);Weg (µm)", *(row.replace(".", ",") for row in rows)])
    Path("pruefstand.csv").write_bytes(record.encode("latin-1"))
    text = load_scene("section4").to_toml().partition("[load]")[0]
    Path("mine.toml").write_text(text + RECORD, encoding="utf-8")
    cycles = np.rint(np.geomspace(10, 2e4, 15)).astype(int)
    measured = [1.1 * wear * 1e3 for wear in solve("mine.toml", cycles.tolist(), rtol=1e-6).u_c]
    readings = [f"{n},{wear:.4f}" for n, wear in zip(cycles, measured, strict=True)]
    Path("readings.csv").write_text("\n".join(["cycles,wear_um", *readings]), encoding="utf-8")
    assert call("report", "mine.toml", "--data", "readings.csv")[0] == 0
    page = Path("mine-report/report.html").read_text(encoding="utf-8")
    assert "wear report mine.toml --data readings.csv" in page
    assert "402 rows with the seam" in re.sub("<[^>]*>", "", page)
    assert re.search(r"The measured wear is <data[^>]*>1.10</data> times the predicted", page)
    assert Path("mine-report/readings.svg").exists()
    Path("readings.csv").write_text("cycles,wear_um\n0,many\n", encoding="utf-8")
    status, _, messages = call("report", "mine.toml", "--data", "readings.csv")
    assert (status, "--data: readings.csv" in messages) == (2, True)
