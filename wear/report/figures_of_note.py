"""The note's figures, and those of this report, from solved histories.

Contents
    wear_of_both            Fig. 2a: wear of bearing and pin, section 3
    roughness_of_both       Fig. 2b: their roughness
    wear_and_asymptote      Fig. 3a: section 4 with a line of the slope (21)
    wear_coefficients       Fig. 3b: section 5 for four wear coefficients
    approach                rate and pressure approaching (21) and (22)
    wear_curve              section 4 over all decades, with the note's asymptotes
    regimes                 the map of regimes with the examples of the note
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import sympy as sp
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from derive.results.regime_map import REGIMES
from wear import figures
from wear.figure_data import BEARING_WEAR, ROUGHNESS, WEAR, Line, Panel
from wear.figure_style import (
    COLUMN,
    COLUMN_AND_HALF,
    GREY,
    HALO,
    INK,
    PAPER,
    canvas,
    label_above,
    panels,
    stroke,
    styled,
)
from wear.numerics.gauss import FloatArray
from wear.report import note
from wear.report.runs import Approach, Runs
from wear.scene import Scene

_REGIMES = {
    "steady": "#0072B2",
    "saturating": "#009E73",
    "finite-time": "#D55E00",
    "arrest": "#CC79A7",
}


def wear_of_both(runs: Runs) -> Figure:
    """Draw Fig. 2a, with and without loss of contact."""
    return figures.history([Panel(WEAR, _both(runs, "u_c", "u_a"))])


def roughness_of_both(runs: Runs) -> Figure:
    """Draw Fig. 2b, with and without loss of contact."""
    return figures.history([Panel(ROUGHNESS, _both(runs, "sigma_c", "sigma_a"))])


def _both(runs: Runs, bearing: str, pin: str) -> tuple[Line, ...]:
    """Return the lines of a field of both solids of section 3; loss of contact is dashed."""
    lines = []
    for variant, name in enumerate(("section3", "section3" + note.CUTOFF)):
        history = runs.histories[name]
        cycles = history.cycles.astype(float)
        suffix = ", loss of contact" * variant
        lines.append(Line(f"bearing{suffix}", cycles, getattr(history, bearing), 0, variant))
        lines.append(Line(f"pin{suffix}", cycles, getattr(history, pin), 1, variant))
    return tuple(lines)


def wear_and_asymptote(runs: Runs) -> Figure:
    """Draw Fig. 3a: the solution, with and without loss of contact, and a line of slope (21)."""
    wear = _wear(runs, "section4", "solution", 0, 0)
    stopped = _wear(runs, "section4" + note.CUTOFF, "loss of contact", 0, 1)
    per_cycle = note.required(runs.asymptotes["section4"].wear_per_cycle_mm)
    line = Line("slope (21)", wear.x, wear.y[-1] + per_cycle * (wear.x - wear.x[-1]), 1, 2)
    return figures.history([Panel(BEARING_WEAR, (wear, stopped), behind=(line,))])


def wear_coefficients(runs: Runs) -> Figure:
    """Draw Fig. 3b: four wear coefficients, on an axis of ln N, one with loss of contact."""
    lines = []
    for family, name in enumerate(note.SECTION_5):
        power = round(np.log10(runs.histories[name].definition.bearing.wear_coefficient))
        lines.append(_wear(runs, name, rf"$K = 10^{{{power}}}$", family, 0))
    lines.append(_wear(runs, note.SECTION_5[1] + note.CUTOFF, r"$10^{-6}$, loss of contact", 1, 1))
    return figures.history([Panel(BEARING_WEAR, tuple(lines))], logarithmic=True)


def _wear(runs: Runs, case: str, name: str, family: int, variant: int) -> Line:
    history = runs.histories[case]
    return Line(name, history.cycles.astype(float), history.u_c, family, variant)


def approach(run: Approach) -> Figure:
    """Draw the relative excess of wear per cycle and pressure over (21) and (22) against cycles."""
    with styled():
        figure, axes = canvas(COLUMN_AND_HALF, 0.55 * COLUMN_AND_HALF)
        law = r"$A/(N u_{\mathrm{cum}})$"
        axes.loglog(run.cycles, run.predicted, color=GREY, linewidth=0.9, label=law)
        for family, (excess, name) in enumerate(
            ((run.excess, "wear per cycle"), (run.pressure_excess, "pressure"))
        ):
            look = stroke(family, family)
            dots = look | {"linestyle": "", "markersize": 5.5 - family}
            axes.loglog(run.cycles, excess, label=name, **dots)
        axes.axvline(note.PRINTED.cycles, color=INK, linewidth=0.7, linestyle=(0, (4.0, 2.0)))
        axes.axhline(note.PRINTED.criterion, color=INK, linewidth=0.7, linestyle=(0, (1.0, 1.5)))
        across, up = axes.get_xaxis_transform(), axes.get_yaxis_transform()
        axes.text(note.PRINTED.cycles, 0.97, " the note's cycle", transform=across, va="top")
        name = "the note's criterion"
        axes.text(0.02, note.PRINTED.criterion, name, transform=up, va="bottom")
        axes.set(xlabel=r"Cycles  $N$", ylabel="Relative excess over the limit")
        axes.legend(loc="upper right")
    return figure


def wear_curve(runs: Runs) -> Figure:
    """Draw the wear over all decades with the note's asymptotes: the figure of the first page."""
    solution, limit = runs.approach, runs.asymptotes["section4"]
    stopped = runs.histories["section4" + note.CUTOFF]
    cycles = np.geomspace(1.0, solution.cycles[-1], 200)
    held = np.interp(np.log(cycles), np.log(stopped.cycles[1:]), stopped.u_c[1:])
    per_cycle = note.required(limit.wear_per_cycle_mm)
    lines = (
        (0.9, Line("slope (21)", cycles, per_cycle * cycles, 1, 1)),
        (0.9, Line("as printed", cycles, note.PRINTED.formula_mm * cycles, 4, 2)),
        (1.4, Line("solution", np.r_[1.0, solution.cycles], np.r_[stopped.u_c[1], solution.wear])),
        (1.4, Line("loss of contact", cycles, held, 0, 1)),
    )
    with styled():
        figure, axes = canvas(COLUMN, 0.72 * COLUMN)
        for width, line in lines:
            look = stroke(line.family, line.variant)
            plain = look | {"marker": "", "linewidth": width}
            axes.loglog(line.x, line.y * WEAR.scale, label=line.name, **plain)
        mark = note.PRINTED.cycles
        axes.axvline(mark, color=GREY, linewidth=0.6, linestyle=(0, (4.0, 2.0)))
        across = axes.get_xaxis_transform()
        axes.text(mark, 0.98, "the note's cycle ", transform=across, va="top", ha="right")
        first, last = lines[2][1].y[[0, -1]] * WEAR.scale
        axes.set(xlabel=r"Cycles  $N$", ylabel=BEARING_WEAR.label, xlim=cycles[[0, -1]])
        axes.set_ylim(1e-3 * first, 10.0 * last)  # room for the legend
        axes.legend(loc="lower right", borderpad=0.0, handlelength=2.5)
    return figure


def regimes(scenes: Mapping[str, Scene]) -> Figure:
    """Draw regions of f_c against the gap at the peak over the roughness, without and with loss of
    contact; a dot at each of the named `scenes`, hollow where the pin wears or is rough."""
    slopes, gaps = np.meshgrid(np.linspace(-0.6, 0.6, 480), np.linspace(-3.0, 4.0, 560))
    with styled():
        figure, [left, right] = panels(1, 2, COLUMN_AND_HALF, 0.5 * COLUMN_AND_HALF)
        for axes, ends in ((left, False), (right, True)):
            named = _regime(slopes, gaps, ends)
            for name, colour in _REGIMES.items():
                _region(axes, slopes, gaps, named == name, colour, name)
            for name, scene in scenes.items():
                _dot(axes, name, scene)
            axes.set(title=f"{'with' if ends else 'without'} loss of contact")
            axes.set(xlabel=r"Change of roughness with wear  $f_c$")
            axes.set(xlim=(-0.6, 0.6), ylim=(-3.0, 4.0))
        left.set_ylabel(r"Gap at the peak over roughness  $(h_0-\max U_a)/\bar\sigma(0)$")
    return figure


def _region(
    axes: Axes, x: FloatArray, y: FloatArray, inside: NDArray[np.bool_], colour: str, name: str
) -> None:
    """Draw a region in its colour, with its name in the middle."""
    if not inside.any():
        return
    axes.contourf(x, y, inside.astype(float), levels=[0.5, 1.5], colors=[colour], alpha=0.3)
    level = np.argmax(inside.sum(axis=1))  # the row where the region is widest
    across = x[level][inside[level]]
    if np.ptp(across) > 0.05:
        middle = float(across.mean()), float(y[inside].mean())
        axes.text(*middle, name, ha="center", va="center", path_effects=[HALO])


def _dot(axes: Axes, name: str, scene: Scene) -> None:
    gap = (scene.closure - scene.periodic_load.maximum) / scene.initial_roughness
    at = scene.bearing.roughness_growth, gap
    axes.plot(*at, "o", color=INK, markerfacecolor=INK if scene.pin is None else PAPER)
    label_above(axes, name, at, 5.0)


def _regime(slope: FloatArray, gap: FloatArray, cutoff: bool) -> NDArray[np.str_]:
    """Return the names of the regimes by the map of the derivation, lengths in the initial
    roughness."""
    values = {"f_c": slope, "h_0": gap, "sigma_c0": 1.0, "U_max": 0.0}
    named = np.full(slope.shape, "", dtype="<U32")
    for row in REGIMES:
        if row.cutoff == cutoff:
            holds = np.ones(slope.shape, dtype=bool)
            for condition in row.conditions:
                names = sorted(symbol.name for symbol in condition.relation.free_symbols)
                relation = sp.lambdify(names, condition.relation, "numpy")
                holds &= relation(*(values[name] for name in names))
            named[holds] = row.name
    return named
