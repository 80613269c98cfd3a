"""The note's figures, and those of this report, from solved histories.

Contents
    wear_of_both            Fig. 2a: wear of bearing and pin, section 3
    roughness_of_both       Fig. 2b: their roughness
    wear_and_asymptote      Fig. 3a: section 4 with a line of the slope (21)
    wear_coefficients       Fig. 3b: section 5 for four wear coefficients
    approach                how rate and pressure approach (21) and (22)
    wear_curve              section 4 over all decades, with what the note has for it
    regimes                 the map of regimes with the examples of the note
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import sympy as sp
from matplotlib.figure import Figure
from numpy.typing import NDArray

from derive.results.regime_map import REGIMES
from wear import figures
from wear.figure_data import BEARING_WEAR, ROUGHNESS, WEAR, Example, Line, Panel
from wear.figure_style import COLUMN, COLUMN_AND_HALF, GREY, INK, canvas, stroke, styled
from wear.history import FloatArray
from wear.report import note
from wear.report.runs import Approach, Runs


def wear_of_both(runs: Runs) -> Figure:
    """Fig. 2a, with and without loss of contact."""
    return figures.history([Panel(WEAR, _both(runs, "u_c", "u_a"))])


def roughness_of_both(runs: Runs) -> Figure:
    """Fig. 2b, with and without loss of contact."""
    return figures.history([Panel(ROUGHNESS, _both(runs, "sigma_c", "sigma_a"))])


def _both(runs: Runs, bearing: str, pin: str) -> tuple[Line, ...]:
    """A field of both solids of section 3; loss of contact is dashed."""
    lines = []
    for variant, name in enumerate(("section3", "section3" + note.CUTOFF)):
        history = runs.history(name)
        cycles = history.cycles.astype(float)
        said = ", loss of contact" * variant
        lines.append(Line(f"bearing{said}", cycles, getattr(history, bearing), 0, variant))
        lines.append(Line(f"pin{said}", cycles, getattr(history, pin), 1, variant))
    return tuple(lines)


def wear_and_asymptote(runs: Runs) -> Figure:
    """Fig. 3a: the solution, with and without loss of contact, and a line of the slope (21)."""
    wear = [
        _wear(runs, "section4", "solution", 0, 0),
        _wear(runs, "section4" + note.CUTOFF, "loss of contact", 0, 1),
    ]
    last = wear[0]
    per_cycle = note.required(runs.asymptote("section4").wear_per_cycle_mm)
    line = last.y[-1] + per_cycle * (last.x - last.x[-1])
    return figures.wear_with_asymptote(wear, [Line("slope (21)", last.x, line, 1, 2)], width=COLUMN)


def wear_coefficients(runs: Runs) -> Figure:
    """Fig. 3b: four wear coefficients, on an axis of ln N, one with loss of contact."""
    lines = []
    for family, name in enumerate(note.SECTION_5):
        power = round(np.log10(runs.cases[name].scene.bearing.wear_coefficient))
        lines.append(_wear(runs, name, rf"$K = 10^{{{power}}}$", family, 0))
    lines.append(_wear(runs, note.SECTION_5[1] + note.CUTOFF, r"$10^{-6}$, loss of contact", 1, 1))
    return figures.history([Panel(BEARING_WEAR, tuple(lines))], logarithmic=True)


def _wear(runs: Runs, case: str, name: str, family: int, variant: int) -> Line:
    history = runs.history(case)
    return Line(name, history.cycles.astype(float), history.u_c, family, variant)


def approach(found: Approach) -> Figure:
    """Relative excess of wear per cycle and of pressure over (21) and (22) against cycles."""
    with styled():
        figure, axes = canvas(COLUMN_AND_HALF, 0.55 * COLUMN_AND_HALF)
        law = r"$A/(N u_{\mathrm{cum}})$"
        axes.loglog(found.cycles, found.predicted, color=GREY, linewidth=0.9, label=law)
        for family, (excess, name) in enumerate(
            ((found.excess, "wear per cycle"), (found.pressure_excess, "pressure"))
        ):
            look = stroke(family, family)
            axes.loglog(
                found.cycles, excess, color=look.colour, linestyle="", marker=look.marker,
                markerfacecolor=look.face, markersize=5.5 - family, label=name,
            )  # fmt: skip
        axes.axvline(note.PRINTED.cycles, color=INK, linewidth=0.7, linestyle=(0, (4.0, 2.0)))
        axes.axhline(note.PRINTED.criterion, color=INK, linewidth=0.7, linestyle=(0, (1.0, 1.5)))
        axes.text(
            note.PRINTED.cycles,
            0.97,
            " the note's cycle",
            transform=axes.get_xaxis_transform(),
            va="top",
        )
        axes.text(
            0.02, note.PRINTED.criterion, "the note's criterion",
            transform=axes.get_yaxis_transform(), va="bottom",
        )  # fmt: skip
        axes.set(xlabel=r"Cycles  $N$", ylabel="Relative excess over the limit")
        axes.legend(loc="upper right")
    return figure


def wear_curve(runs: Runs) -> Figure:
    """Wear over all decades with what the note has for it: the curve of the first page."""
    found, limit = runs.approach, runs.asymptote("section4")
    stopped = runs.history("section4" + note.CUTOFF)
    cycles = np.geomspace(1.0, found.cycles[-1], 200)
    held = np.interp(np.log(cycles), np.log(stopped.cycles[1:]), stopped.u_c[1:])
    wear = [
        Line("solution", np.r_[1.0, found.cycles], np.r_[stopped.u_c[1], found.wear]),
        Line("loss of contact", cycles, held, 0, 1),
    ]
    lines = [
        Line("slope (21)", cycles, note.required(limit.wear_per_cycle_mm) * cycles, 1, 1),
        Line("as printed", cycles, note.PRINTED.formula_mm * cycles, 4, 2),
    ]
    return figures.wear_by_decades(wear, lines, mark=(note.PRINTED.cycles, "the note's cycle"))


def regimes(runs: Runs) -> Figure:
    """The map of regimes with the examples of the note."""
    points = []
    for name in ("section3", "section4", "section5"):
        scene = runs.cases[name].scene
        gap = (scene.closure - scene.periodic_load.maximum) / scene.initial_roughness
        slope = scene.bearing.roughness_growth
        points.append(Example(f"§ {name[-1]}", slope, gap, one_solid=scene.pin is None))
    return figures.regime_map(_regime, ("without loss of contact", "with loss of contact"), points)


def _regime(slope: FloatArray, gap: FloatArray, cutoff: bool) -> NDArray[np.str_]:
    """The names of the regimes by the map of the derivation; lengths in the initial roughness."""
    values = {"f_c": slope, "h_0": gap, "sigma_c0": 1.0, "U_max": 0.0}
    named = np.full(slope.shape, "", dtype="<U32")
    for row in REGIMES:
        if row.cutoff == cutoff:
            holds = np.ones(slope.shape, dtype=bool)
            for condition in row.conditions:
                holds &= _holds(condition.relation, values)
            named[holds] = row.name
    return named


def _holds(relation: sp.Basic, values: Mapping[str, object]) -> NDArray[np.bool_]:
    """Where a relation between data holds."""
    symbols = sorted(relation.free_symbols, key=str)
    found = sp.lambdify(symbols, relation, "numpy")(*(values[s.name] for s in symbols))
    return np.asarray(found, dtype=bool)
