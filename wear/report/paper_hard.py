"""The paper's section on hard scenes."""

from __future__ import annotations

from wear.report.document import Code, Column, Number, Section, Table
from wear.report.material import Material, count
from wear.report.runs import HARD_RTOL
from wear.report.words import paragraph, words


def section(material: Material) -> Section:
    """The scenes on which solvers break down."""
    return Section(
        "sec:hard",
        "Hard scenes",
        (
            paragraph(
                "Scenes at the edges of the model, each built to break a method: slopes next to "
                "the limits between regimes, contact that only grazes, states that slide along the "
                "edge of contact, pressures below the smallest double of $1+\\tanh$, lengths "
                "scaled by a million. All are solved to the requested relative error {rtol}.",
                rtol=Number(HARD_RTOL, 1, source="request"),
            ),
            _table(material),
        ),
    )


def _table(material: Material) -> Table:
    rows = tuple(
        (
            words(f"`{case.name}`"),
            (Code(case.history.method),),
            (Number(float(case.history.u_c[-1]), 6, source=f"scene {case.name}"),),
            (Number(float(case.history.error[-1]), 1, source=f"scene {case.name}"),),
            (count(case.history.cost["rhs_evaluations"], f"scene {case.name}"),),
        )
        for case in material.runs.hard
    )
    columns = (
        Column(words("Scene")),
        Column(words("Method")),
        Column(words("Wear (mm)"), numeric=True),
        Column(words("Estimated error"), numeric=True),
        Column(words("Right-hand sides"), numeric=True),
    )
    cycles = material.runs.hard[0].history.cycles[-1]
    caption = words(
        "Bearing wear after {cycles} cycles, the estimate of its relative error, and the number "
        "of evaluations of the right-hand side that both took.",
        cycles=count(cycles, "hard scenes"),
    )
    return Table("tab:hard", caption, columns, rows, long=True)
