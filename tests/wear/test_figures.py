"""Figures: what is drawn is what was given, in every run the same, legible without colour."""

import re
from dataclasses import replace
from typing import Any

import matplotlib as mpl
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure

from wear import figure_style, figures
from wear.figure_data import (
    PRESSURE,
    ROUGHNESS,
    WEAR,
    Abscissa,
    Line,
    Panel,
    TimingCurve,
    panels_of,
    pressure_inside,
)
from wear.fitting.figures import profiles
from wear.fitting.fit import fit
from wear.load import Block, Blocks, Constant
from wear.report import figures_of_note, schematic
from wear.scene import load_scene
from wear.solver import solve

CYCLES = np.linspace(0.0, 100.0, 201)
DEPTH = 1e-4 * np.log1p(CYCLES)


def _lines() -> tuple[Line, ...]:
    return (
        Line("bearing", CYCLES, DEPTH),
        Line("bearing, cutoff", CYCLES, 0.9 * DEPTH, 0, 1),
        Line("pin", CYCLES, DEPTH / 3.0, 1),
    )


def _wear(**options: Any) -> Figure:
    return figures.history([Panel(WEAR, _lines())], **options)


def _methods() -> list[TimingCurve]:
    error = np.array([1e-3, 1e-9, 1e-16])
    missed = np.array([True, False, False])
    return [
        TimingCurve(f"method {i}", error * (i + 1), np.array([1.0, 2.0, 3.0]) * 2.0**i, missed)
        for i in range(9)
    ]


def _all() -> dict[str, Figure]:
    return {
        "history": figures.history(
            [Panel(WEAR, _lines()), Panel(ROUGHNESS, _lines()), Panel(PRESSURE, _lines()[:1])],
            logarithmic=True,
        ),
        "wear": _wear(),
        "logarithmic": _wear(logarithmic=True),
        "asymptote": figures.history([Panel(WEAR, _lines()[:1], behind=_lines()[2:])]),
        "pressure": figures.pressure_in_cycles([Line("first", CYCLES / 100.0, DEPTH)]),
        "speed": figures.speed_against_error(_methods()),
        "cycles": figures.speed_against_cycles(_methods()),
        "map": figures_of_note.regimes(
            {name: load_scene(name) for name in ("section3", "section4")}
        ),
        "system": schematic.system(),
    }


@pytest.fixture(scope="module")
def drawn():
    return _all()


@pytest.fixture(scope="module")
def written(drawn):
    return {name: figure_style.encoded(figure, ".svg").decode() for name, figure in drawn.items()}


def test_files_are_the_same_in_every_run(written):
    first, second = (_wear() for _ in range(2))
    for figure in (first, second, first):  # writing a figure does not change it
        assert figure_style.encoded(figure, ".svg").decode() == written["wear"]
    assert figure_style.encoded(first, ".pdf") == figure_style.encoded(second, ".pdf")


def test_files_hold_no_date_and_need_no_font(drawn, written):
    assert b"CreationDate" not in figure_style.encoded(drawn["wear"], ".pdf")
    for content in written.values():
        assert "<text" not in content
        assert "dc:date" not in content


def test_width_is_the_width_of_a_column(written):
    for name, millimetres in (("wear", 90.0), ("speed", 190.0), ("system", 90.0)):
        width = re.search(r'width="([\d.]+)pt"', written[name])
        assert width is not None
        assert float(width[1]) == pytest.approx(millimetres / 25.4 * 72.0, rel=1e-5)


@pytest.mark.usefixtures("written")
def test_nothing_sticks_out_of_a_figure_that_was_laid_out(drawn):
    for figure in drawn.values():
        (left, low), (right, high) = figure.get_tightbbox().get_points()
        width, height = figure.get_size_inches()
        assert min(left, low, width - right, height - high) > 0.0


def test_curves_are_the_data_in_micrometres(drawn):
    curves = [line for line in drawn["wear"].axes[0].lines if len(line.get_xdata()) == 201]
    for curve, line in zip(curves, _lines(), strict=True):
        np.testing.assert_array_equal(curve.get_xdata(), line.x)
        np.testing.assert_allclose(curve.get_ydata(), line.y * 1e3, rtol=1e-15)


def test_a_logarithmic_axis_leaves_out_the_start(drawn):
    axes = drawn["logarithmic"].axes[0]
    assert axes.get_xscale() == "log"
    assert axes.get_xlim() == (0.5, 100.0)


def test_the_map_names_the_regimes_and_the_examples(drawn):
    """Dots lie at their scenes; those with two worn solids are hollow."""
    for axes, regimes in zip(
        drawn["map"].axes, ({"saturating", "finite-time"}, {"arrest", "finite-time"}), strict=True
    ):
        names = {"section3", "section4", "steady"} | regimes
        assert {text.get_text() for text in axes.texts} == names
        (hollow, first), (full, second) = (
            (line.get_markerfacecolor(), line.get_xydata()[0]) for line in axes.lines
        )
        assert (hollow, full) == (figure_style.PAPER, figure_style.INK)
        np.testing.assert_allclose([first, second], [(-0.05, 1.633), (0.25, 1.611)], atol=1e-3)


def test_failures_and_exact_results_are_shown(drawn):
    axes = drawn["speed"].axes[0]
    hollow = [line for line in axes.lines if line.get_markerfacecolor() == figure_style.PAPER]
    assert sum(len(line.get_xdata()) for line in hollow) == 9
    shown = np.concatenate([np.asarray(line.get_xdata(), dtype=float) for line in axes.lines])
    assert shown.min() > 0.0


def test_every_line_is_named(drawn):
    names = [text.get_text() for text in drawn["wear"].axes[0].texts]
    assert sorted(names) == sorted(line.name for line in _lines())


def test_lines_differ_without_colour():
    looks = [figure_style.stroke(family, variant) for family in range(7) for variant in range(2)]
    hollow = [look["markerfacecolor"] != look["color"] for look in looks]
    marked = [(look["marker"], look["linestyle"]) for look in looks]
    assert len(set(zip(marked, hollow, strict=True))) == 14


def test_neighbouring_families_differ_in_lightness():
    def lightness(family: int) -> float:
        red, green, blue = to_rgb(figure_style.stroke(family)["color"])
        return 0.2126 * red + 0.7152 * green + 0.0722 * blue

    assert abs(lightness(0) - lightness(1)) > 0.05


def test_drawing_changes_no_settings():
    before = dict(mpl.rcParams)
    figure_style.encoded(_wear(), ".png")
    assert dict(mpl.rcParams) == before


@pytest.mark.parametrize(
    ("suffix", "start"), [(".svg", b"<?xml"), (".PDF", b"%PDF"), (".png", b"\x89PNG")]
)
def test_the_suffix_names_the_kind_of_file(drawn, suffix, start):
    assert figure_style.encoded(drawn["wear"], suffix).startswith(start)


def test_an_unknown_suffix_is_told_with_the_known_ones(drawn):
    with pytest.raises(ValueError, match=r"\.bmp.*\.svg, \.pdf, \.png"):
        figure_style.encoded(drawn["wear"], ".bmp")


@given(heights=st.lists(st.floats(0.0, 1.0), min_size=1, max_size=10), gap=st.floats(0.01, 0.1))
def test_names_stay_apart_in_order_and_inside(heights, gap):
    ends = np.sort(np.array(heights))
    placed = figure_style.spread(ends, gap)
    assert np.all(np.diff(placed) >= gap * (1.0 - 1e-9))
    assert placed[0] >= -1e-12
    assert placed[-1] <= 1.0 + 1e-12
    if np.all(np.diff(ends) >= gap):
        np.testing.assert_allclose(placed, ends, atol=1e-12)


@pytest.mark.parametrize("name", ["section4", "section4-cutoff"])
def test_the_pressure_inside_cycles_is_that_of_the_equations(name):
    """At phase 0 the state of `solve`, and at the peak of the first cycle the law at its wear."""
    scene, cycles = load_scene(name), [50, 0, 10]
    lines = pressure_inside(scene, cycles)
    assert [line.name for line in lines] == ["$N = 0$", "$N = 10$", "$N = 50$"]
    starts = solve(scene, sorted(cycles), 1e-8).p
    np.testing.assert_allclose([line.y[0] for line in lines], starts, rtol=1e-4)
    for line in lines:
        assert line.x[np.argmax(line.y)] == pytest.approx(0.25, abs=0.01)
        assert line.y[-1] <= line.y[0] < line.y.max()  # wear has opened the gap
    assert (lines[-1].y == 0.0).any() == scene.contact.ends_at_3_sigma


def test_many_cycles_have_a_line_each():
    """More than fit a chunk of the history."""
    lines = pressure_inside(load_scene("section4"), range(100))
    assert [line.family for line in lines] == list(range(100))
    assert np.all(np.diff([line.y.max() for line in lines]) < 0.0)


def test_what_grows_by_decades_has_a_logarithmic_axis():
    cycles = np.array([0.0, 1.0, 1e2, 1e4])
    wear, level = (
        Line("bearing", cycles, 1e-7 * cycles),
        Line("bearing", cycles, 1.0 + 0.0 * cycles),
    )
    arrested = Line("peak", cycles, np.array([300.0, 300.0, 1.0, 0.0]))
    panels = [Panel(WEAR, (wear,)), Panel(ROUGHNESS, (level,)), Panel(PRESSURE, (arrested,))]
    for logarithmic, scale in ((True, "log"), (False, "linear")):
        drawn = figures.history(panels, logarithmic=logarithmic)
        assert [axes.get_yscale() for axes in drawn.axes] == [scale, "linear", "log"]


def test_a_pressure_that_only_the_fresh_state_has_is_left_out_of_decades():
    cycles = np.array([0.0, 1.0, 1e2, 1e4])
    falling = Line("peak", cycles, np.array([300.0, 300.0, 1.0, 0.0]))
    first = Line("start", cycles, np.array([5.0, 0.0, 0.0, 0.0]))
    (axes,) = figures.history([Panel(PRESSURE, (falling, first))]).axes
    assert (axes.get_yscale(), [text.get_text() for text in axes.texts]) == ("log", ["peak"])


def test_readings_and_the_limit_stand_beside_the_wear():
    read = Line("measured", np.array([10.0, 120.0]), np.array([1e-4, 7e-4]), 6)
    axes = figures.history([Panel(WEAR, _lines(), (read,), limit=9e-4)]).axes[0]
    np.testing.assert_allclose(axes.lines[3].get_xydata(), [[10.0, 0.1], [120.0, 0.7]])
    assert axes.get_xlim()[1] == 120.0
    assert axes.get_ylim()[1] > 0.9
    assert {"measured", "limit"} <= {text.get_text() for text in axes.texts}


def test_one_run_has_a_colour_a_quantity_and_several_a_colour_each():
    runs = [solve(name, [1, 100, 5000], 1e-6) for name in ("section3", "section4-cutoff")]
    wear, _, pressure = panels_of(runs[:1])
    assert [line.name for line in wear.lines] == ["bearing", "pin"]
    assert [line.name for line in pressure.lines] == ["peak", "mean", "start of cycle"]
    np.testing.assert_array_equal(pressure.lines[1].y, runs[0].pressures.mean)
    wear, _, pressure, contact = panels_of(runs, ("A", "B"), Abscissa.HOURS)
    assert [(line.name, line.family) for line in wear.lines] == [("A", 0), ("A, pin", 0), ("B", 1)]
    assert [line.name for line in pressure.lines] == ["A, peak", "A, mean", "B, peak", "B, mean"]
    assert [line.name for line in contact.lines] == ["B"]
    np.testing.assert_allclose(contact.lines[0].x * 3600.0, [0.06, 6.0, 300.0])


def test_a_name_with_dollars_is_no_formula():
    run, name = solve("section4", [1, 100], 1e-6), r"$\bad{$"
    drawn = figures.plot({name: run, "b": run})
    figure_style.encoded(drawn, ".svg")
    assert drawn.axes[0].texts[0].get_text() == r"\$\bad{\$"


def test_a_specimen_with_dollars_is_no_formula():
    cycles, wear_um = [10, 1000, 10, 1000], [0.23, 2.1, 0.24, 2.2]
    readings = {"specimen": [*"aa", *[r"$\bad{$"] * 2], "cycles": cycles, "wear_um": wear_um}
    each, growth = "bearing.roughness_mm", "bearing.roughness_growth"
    found = fit(readings, "section4", free=growth, free_each=each)
    for drawn in (found.plot(), profiles(found)):
        assert figure_style.encoded(drawn, ".svg")


def test_sliding_distance_is_that_of_the_speed():
    """22 mm at 2000 rpm: two turns in a cycle of 0.06 s."""
    slid = Abscissa.DISTANCE.of(load_scene("section4"), np.array([1.0, 1e6]))
    np.testing.assert_allclose(slid, 2.0 * 2.0 * np.pi * 0.022 * np.array([1.0, 1e6]), rtol=1e-12)


def test_hours_of_blocks_are_those_of_their_periods():
    blocks = Blocks((Block(Constant(0.0, 3600.0), 2), Block(Constant(0.0, 1800.0), 2)))
    scene = replace(load_scene("section4"), load=blocks)
    np.testing.assert_allclose(Abscissa.HOURS.of(scene, np.array([1.0, 3.0, 4.0])), [1.0, 2.5, 3.0])
