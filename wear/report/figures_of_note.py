"""The note's figures, and those of this report, from solved histories.

Contents
    lines_of                wear, roughness and pressure of any history, as lines
    wear_of_both            Fig. 2a: wear of bearing and pin, section 3
    roughness_of_both       Fig. 2b: their roughness
    wear_and_asymptote      Fig. 3a: section 4 with a line of the slope (21)
    wear_coefficients       Fig. 3b: section 5 for four wear coefficients
    approach                how rate and pressure approach (21) and (22)
    regimes                 the asymptotic pressure over f_c, with the regimes
"""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from wear import figures
from wear.figure_data import Line, Regime, Threshold
from wear.figure_style import COLUMN_AND_HALF, GREY, INK, PAGE, canvas, stroke, styled
from wear.generated import asymptotics as formula
from wear.history import FloatArray, History
from wear.report.reconcile import PRINTED
from wear.report.runs import CUTOFF, SECTION_5, Approach, Runs, known

WIDTH = COLUMN_AND_HALF
_ONE_EIGHTH = 1.0 / 8.0
_ONE_THIRD = 1.0 / 3.0


def lines_of(history: History) -> tuple[list[Line], list[Line], list[Line]]:
    """Wear, roughness and pressure against cycles; the pin only where it is modelled."""
    cycles = history.cycles.astype(float)
    wear = [Line("bearing", cycles, history.u_c)]
    roughness = [Line("bearing", cycles, history.sigma_c)]
    if history.u_a.any():
        wear.append(Line("pin", cycles, history.u_a, 1))
    if history.sigma_a.any():
        roughness.append(Line("pin", cycles, history.sigma_a, 1))
    return wear, roughness, [Line("contact", cycles, history.p, 2)]


def wear_of_both(runs: Runs) -> Figure:
    """Fig. 2a, with and without the cutoff."""
    return figures.wear_history(_both(runs, "u_c", "u_a"), width=WIDTH)


def roughness_of_both(runs: Runs) -> Figure:
    """Fig. 2b, with and without the cutoff."""
    return figures.roughness_history(_both(runs, "sigma_c", "sigma_a"), width=WIDTH)


def _both(runs: Runs, bearing: str, pin: str) -> list[Line]:
    """A field of both solids of section 3; the cutoff is dashed."""
    lines = []
    for variant, name in enumerate(("section3", "section3" + CUTOFF)):
        history = runs.history(name)
        cycles = history.cycles.astype(float)
        said = ", cutoff" * variant
        lines.append(Line(f"bearing{said}", cycles, getattr(history, bearing), 0, variant))
        lines.append(Line(f"pin{said}", cycles, getattr(history, pin), 1, variant))
    return lines


def wear_and_asymptote(runs: Runs) -> Figure:
    """Fig. 3a: the solution, that with the cutoff, and a line of the slope (21) through the end."""
    wear = [
        _wear(runs, "section4", "solution", 0, 0),
        _wear(runs, "section4" + CUTOFF, "with cutoff", 0, 1),
    ]
    last = wear[0]
    per_cycle = known(runs.fate("section4").wear_per_cycle_mm)
    line = last.y[-1] + per_cycle * (last.x - last.x[-1])
    return figures.wear_with_asymptote(wear, [Line("slope (21)", last.x, line, 1, 2)], width=WIDTH)


def wear_coefficients(runs: Runs) -> Figure:
    """Fig. 3b: four wear coefficients, each with and without the cutoff, on an axis of ln N."""
    lines = []
    for family, name in enumerate(SECTION_5):
        power = round(np.log10(runs.cases[name].scene.bearing.wear_coefficient))
        lines.append(_wear(runs, name, rf"$K = 10^{{{power}}}$", family, 0))
    lines.append(_wear(runs, SECTION_5[1] + CUTOFF, r"$10^{-6}$, cutoff", 1, 1))
    return figures.wear_by_coefficient(lines, logarithmic=True, width=WIDTH)


def _wear(runs: Runs, case: str, name: str, family: int, variant: int) -> Line:
    history = runs.history(case)
    return Line(name, history.cycles.astype(float), history.u_c, family, variant)


def approach(found: Approach) -> Figure:
    """Relative excess of wear per cycle and of pressure over (21) and (22) against cycles."""
    with styled():
        figure, axes = canvas(WIDTH, 0.6 * WIDTH)
        axes.loglog(
            found.cycles,
            found.predicted,
            color=GREY,
            linewidth=0.9,
            label=r"$A/(N u_{\mathrm{cum}})$",
        )
        for family, (excess, name) in enumerate(
            ((found.excess, "wear per cycle"), (found.pressure_excess, "pressure"))
        ):
            look = stroke(family, family)
            axes.loglog(
                found.cycles,
                excess,
                color=look.colour,
                linestyle="",
                marker=look.marker,
                markerfacecolor=look.face,
                markersize=5.5 - family,
                label=name,
            )
        axes.axvline(PRINTED.cycles, color=INK, linewidth=0.7, linestyle=(0, (4.0, 2.0)))
        axes.axhline(PRINTED.criterion, color=INK, linewidth=0.7, linestyle=(0, (1.0, 1.5)))
        axes.text(
            PRINTED.cycles,
            0.97,
            " the note's cycle",
            transform=axes.get_xaxis_transform(),
            va="top",
        )
        axes.text(
            0.02, PRINTED.criterion, "the note's criterion",
            transform=axes.get_yaxis_transform(), va="bottom",
        )  # fmt: skip
        axes.set(xlabel=r"Cycles  $N$", ylabel="Relative excess over the limit")
        axes.legend(loc="upper right")
    return figure


def regimes() -> Figure:
    """The asymptotic pressure over f_c, the regimes and the thresholds between them."""
    slopes = np.linspace(0.06, 0.6, 300)
    pressure = Line("pressure", slopes, share(slopes))
    return figures.regime_map(
        pressure,
        [
            Regime("wear ends", -0.12, 0.0),
            Regime("steady; with cutoff: arrest", 0.0, _ONE_THIRD),
            Regime("steady, with or without cutoff", _ONE_THIRD, 0.6),
        ],
        [
            Threshold(r"$f_c = 1/8$", _ONE_EIGHTH),
            Threshold(r"$f_c = 1/3$", _ONE_THIRD),
        ],
        width=PAGE,
    )


def share(slope: FloatArray) -> FloatArray:
    """p_inf/p_max of one solid for f_c > 0."""
    ratio = formula.closure_ratio(q=slope, g=1.0)
    return np.asarray(formula.share_tanh(ratio))
