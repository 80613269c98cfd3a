"""The paper's section on hard scenes."""

from __future__ import annotations

from wear.benchmark.methods import cases
from wear.report.document import Column, Number, Section, Table
from wear.report.material import ROUNDOFF, Material, count
from wear.report.plain import plain
from wear.report.runs import HARD_RTOL, HardCase
from wear.report.words import paragraph, words


def section(material: Material) -> Section:
    """The scenes on which solvers break down."""
    return Section(
        "sec:hard",
        "Hard scenes",
        (
            paragraph(
                "Scenes at the edges of the model, each built to break a method: slopes next to "
                "the limits between regimes, contact that only grazes, states that slide along "
                "the edge of contact, pressures so small that $1+\\tanh$ rounds to zero, lengths "
                "scaled up and down. The cycle count solves all of [tab:hard] to the requested "
                "relative error {rtol}; the true error is known from references of far higher "
                "precision. The documentation of the software tells how every method fares there.",
                rtol=Number(HARD_RTOL, 1, source="request"),
            ),
            _table(material),
        ),
    )


def _table(material: Material) -> Table:
    cycles = int(material.runs.hard[0].history.cycles[-1])
    names = [case.name for case in material.runs.hard]
    true = {case.name: case.wear for case in cases("hard", names, (cycles,))}
    rows = tuple(
        (
            plain(case.title, f"scene {case.name}"),
            (Number(float(case.history.u_c[-1]), 6, source=f"scene {case.name}"),),
            (Number(_error(case, true[case.name]), 1, source=f"{case.name} against reference"),),
            (Number(float(case.history.error[-1]), 1, source=f"scene {case.name}"),),
            (count(case.history.cost["rhs_evaluations"], f"scene {case.name}"),),
        )
        for case in material.runs.hard
    )
    columns = (
        Column(words("Scene"), width=0.36),
        Column(words("Wear (mm)"), numeric=True),
        Column(words("True error"), numeric=True),
        Column(words("Estimate"), numeric=True),
        Column(words("Evaluations"), numeric=True),
    )
    caption = words(
        "Bearing wear after {cycles} cycles, its relative error and the estimate of it, and the "
        "number of evaluations of the rate that solution and estimate took together. An error "
        "below the roundoff of a double is shown as that.",
        cycles=count(cycles, "hard scenes"),
    )
    return Table("tab:hard", caption, columns, rows, long=True)


def _error(case: HardCase, true: float) -> float:
    """Relative error of the wear, or the roundoff of a double."""
    return max(abs(float(case.history.u_c[-1]) / true - 1.0), ROUNDOFF)
