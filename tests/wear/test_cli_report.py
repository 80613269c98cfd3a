"""`wear report`: the report of a scene of one's own."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest

from wear import solve
from wear.cli import main
from wear.report import own, typeset
from wear.scene import load_scene


def test_the_files_and_what_they_say(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(typeset.shutil, "which", lambda _: None)
    scene = tmp_path / "mine.toml"
    text = load_scene("section4-cutoff").to_toml()
    scene.write_text(re.sub(r'title = ".*"', 'title = "A *bearing* of mine, 50 %"', text))
    folder = tmp_path / "out"
    assert main(["report", str(scene), "-o", str(folder), "--json"]) == 0
    shown = json.loads(capsys.readouterr().out)
    assert {"report.html", "report.tex", "equations.tex", "history.svg"} <= set(shown["files"])
    page = (folder / "report.html").read_text(encoding="utf-8")
    assert "A *bearing* of mine, 50 %" in page
    assert "<em>arrest</em>" in page
    assert "wear report" in page
    assert ">never</td>" in page  # a depth beyond that of arrest


def test_the_numbers_are_those_of_the_solver_and_the_equations_those_of_the_variant() -> None:
    scene = load_scene("section4")
    document = own.report(scene, "wear report section4")
    wear = solve(scene, [1, 10**8], rtol=1e-10).u_c
    values = np.array([number.value for number in document.text.numbers])
    for value in wear:
        assert np.min(np.abs(values / value - 1.0)) < 1e-7
    assert [e.id for e in document.shown] == ["1", "7e", "7f", "13", "21", "22", "log-drift"]
    assert len(document.marks) > 10


def test_a_scene_with_faults_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["report", "section4", "--set", "bearing.hardness_MPa=0", "-o", str(tmp_path)]) == 2
    assert "hardness" in capsys.readouterr().err
