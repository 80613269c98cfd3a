"""What a script or a notebook has of the packages: names, short forms, pictures.

`typed_script.py` is checked by mypy along with the packages (`make test`).
"""

import re
import runpy
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas
import pytest
import xarray

import derive
import wear

DOCS = Path(__file__).parents[2] / "docs"


def test_a_script_needs_no_deep_import(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.chdir(tmp_path)
    made = runpy.run_path(str(Path(__file__).with_name("typed_script.py")))
    assert made["deepest"] > made["many"].u_c[0, 0] > 0.0
    assert made["regime"] == "steady"
    assert (tmp_path / "wear.svg").stat().st_size > 1000


def test_everything_that_the_reference_names_is_in_the_package_itself() -> None:
    page = (DOCS / "reference" / "python.md").read_text()
    named = re.findall(
        r"auto(?:function|class|exception):: (?:wear)\.[\w.]*?(\w+)(?:\(\))?\n", page
    )
    assert len(named) > 30
    assert not [name for name in named if name not in dir(wear)]


def test_an_equation_shows_itself_in_short_and_typeset() -> None:
    found = derive.equation("21")
    assert repr(found) == f"<Equation 21: {found.title}>"
    assert found._repr_latex_() == f"$\\displaystyle {found.latex}$"


def test_a_scene_is_short_in_a_script_and_a_file_in_a_notebook() -> None:
    scene = wear.load_scene("section4")
    assert repr(scene) == f"<Scene {scene.title!r}: rigid_bearing, {scene.load!r}>"
    assert "roughness_growth = 0.25" in scene._repr_html_()


@pytest.mark.parametrize("of", [np.array, pandas.Series, xarray.DataArray])
def test_numbers_of_cycles_come_from_any_array(of: Callable[[list[int]], Any]) -> None:
    assert wear.solve("section4", of([10, 1]), rtol=1e-6).cycles.tolist() == [10, 1]
    assert wear.solve("section4", of([10])[0], rtol=1e-6).cycles.tolist() == [10]


def test_a_history_draws_wear_roughness_and_pressure() -> None:
    figure = wear.solve("section4", [1, 10, 100], rtol=1e-6).plot()
    labels = " ".join(axes.get_ylabel().lower() for axes in figure.axes)
    assert all(word in labels for word in ("wear", "roughness", "pressure"))


def test_a_history_of_no_cycle_is_drawn_on_linear_axes() -> None:
    assert wear.solve("section4", [0], rtol=1e-6).plot().axes[-1].get_xscale() == "linear"


def test_what_takes_long_says_how_far_it_is(monkeypatch: pytest.MonkeyPatch) -> None:
    """As if two seconds had passed at once."""
    monkeypatch.setattr("wear.progress.SILENT", 0.0)
    monkeypatch.setattr("wear.progress.APART", 0.0)
    scenes = [wear.load_scene("section4"), wear.load_scene("section4-cutoff")]
    told: list[str] = []
    wear.sweep(scenes, np.array([1.0, 10.0]), 1e-6, told.append)
    assert [text.partition(",")[0] for text in told] == ["scene 1 of 2", "scene 2 of 2"]
    wear.sensitivity("section4", 10, 1e-6, told.append)
    assert told[2:] == ["cycle 0 of 10"]
    read = np.array([10.0, 100.0, 1000.0])
    specimen = wear.Specimen("", read, wear.solve("section4", read).u_c, None, {})
    free = ["bearing.wear_coefficient"]
    wear.fit([specimen], "section4", free, intervals=False, progress=told.append)
    assert told[3].startswith("least sum of squares: ")
