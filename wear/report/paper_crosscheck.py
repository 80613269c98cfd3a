"""The paper's section in which analysis and numerics meet."""

from __future__ import annotations

import numpy as np

from wear.report import figures_of_note
from wear.report.document import Block, Column, Number, Prose, Section, Table
from wear.report.material import ROUNDOFF, Material, count, drawn, mm
from wear.report.reconcile import PRINTED
from wear.report.runs import known
from wear.report.words import paragraph, words


def section(material: Material) -> Section:
    """Formulas against solutions."""
    runs = material.runs
    return Section(
        "sec:crosscheck",
        "Analysis and numerics compared",
        (
            paragraph(
                "Formulas and solver share the generated expressions of the model and nothing "
                "else. Where both say something of the same quantity, they are compared here, with "
                "the data of the note's application."
            ),
            paragraph(
                "*The approach to the limit.* By the [der:19] the wear of a cycle exceeds its "
                "limit by the share $A/(Nu_{\\mathrm{cum}})$ in the end. [fig:approach] and "
                "[tab:approach] show that it does, and the pressure at the start of a cycle "
                "likewise. At the cycle that the note calls stabilised the wear of a cycle exceeds "
                "its limit by {early} times the limit; at the cycle that the law foretells for the "
                "note's criterion, by {excess} times.",
                early=Number(
                    runs.printed_increment / known(runs.fate("section4").wear_per_cycle_mm) - 1.0,
                    3,
                    source="section 4 at the note's cycle",
                ),
                excess=Number(runs.threshold_excess, 6, source="section 4 at the foretold cycle"),
            ),
            *_approach(material),
            paragraph(
                "*Other closed forms, and a second solver.* [tab:agreement] compares four closed "
                "forms with the solver: the wear under a constant load, the rate at the phases of "
                "every cycle at which [eq:deviation] makes it exactly steady, the wear with its "
                "drift ($A$ and $B$ of [sec:drift]), and the arrest depths. It also compares the "
                "cycle count of [sec:speed] with a direct integration of every cycle."
            ),
            _agreements(material),
            paragraph(
                "*The numbers of the note* remain. [eq:21] gives {formula}, and the solution "
                "gives {step} for the cycle after cycle {cycle}; the note prints {printed} and "
                "{simulated}. Of all data that [eq:21] contains, changing $f_c$ alone, to "
                "{slope}, reconciles them best: the formula then gives the printed value and the "
                "solution {altered}, nearly the other. Any other datum would have to change "
                "{factor}-fold (claims [(claim:C35)] and [(claim:C36)]).",
                factor=Number(
                    PRINTED.formula_mm / known(runs.fate("section4").wear_per_cycle_mm),
                    3,
                    source="printed value over Eq. (21)",
                ),
                formula=mm(known(runs.fate("section4").wear_per_cycle_mm), 5, "Eq. (21)"),
                step=mm(runs.printed_increment, 5, "section 4"),
                cycle=count(PRINTED.cycles, "the note"),
                printed=mm(PRINTED.formula_mm, 3, "printed in the note after (21)"),
                simulated=mm(PRINTED.simulated_mm, 3, "printed in the note before (21)"),
                slope=Number(runs.reconciliation.value, 7, source="inverse of (21)"),
                altered=mm(runs.reconciliation.simulated_mm, 4, "section 4 with that slope"),
            ),
        ),
    )


def _approach(material: Material) -> tuple[Block, ...]:
    found = material.runs.approach
    columns = (
        Column(words("Cycles $N$"), numeric=True),
        Column(words("Wear (mm)"), numeric=True),
        Column(words("Its excess"), numeric=True),
        Column(words("Of pressure"), numeric=True),
        Column(words("$A/(Nu_{\\mathrm{cum}})$"), numeric=True),
        Column(words("Ratio"), numeric=True),
    )
    rows = tuple(
        _approach_row(*values)
        for values in zip(
            found.cycles,
            found.increment,
            found.excess,
            found.pressure_excess,
            found.predicted,
            strict=True,
        )
        if values[0] >= 1e3
    )
    caption = words(
        "Approach to [eq:21] and [eq:22]: wear of one cycle, its relative excess over its limit "
        "and that of the pressure at the start of the cycle, what the logarithmic drift predicts "
        "for both, and the ratio of the excess of the wear to that, which tends to one."
    )
    return (
        drawn(
            "fig:approach",
            figures_of_note.approach(found),
            paragraph(
                "Relative excess of the wear of a cycle and of the pressure at its start over "
                "[eq:21] and [eq:22], against cycles, with the law of approach."
            ),
            "Two rows of points that bend towards a straight line of slope minus one and follow "
            "it over five decades.",
            "approach",
        ),
        Table("tab:approach", caption, columns, rows),
    )


def _approach_row(
    cycle: float, step: float, excess: float, pressure: float, predicted: float
) -> tuple[Prose, ...]:
    source = "approach, section 4"
    return (
        (Number(cycle, 1, source=source),),
        (Number(step, 5, source=source),),
        (Number(excess, 4, source=source),),
        (Number(pressure, 4, source=source),),
        (Number(predicted, 4, source=source),),
        (Number(excess / predicted, 5, source=source),),
    )


def _agreements(material: Material) -> Table:
    runs = material.runs
    static, phases, bounds = runs.static, runs.phases, runs.wear_bounds
    history = runs.history("section4")
    at_printed = float(history.u_c[-1])
    rows: list[tuple[str, str, Number]] = [
        (
            "Closed static solution [eq:static-solution] against the solver",
            "largest relative difference of the wear",
            Number(
                static.distance, 2, source=f"section 4, constant load, N to {static.cycles[-1]:.0e}"
            ),
        ),
        (
            "Rate at the phases where the load equals $h_0-\\sigma_c^0/f_c$, every cycle",
            "largest relative distance from [eq:18]",
            Number(phases.distance, 2, source="section 4, phases of the steady rate"),
        ),
        (
            "Wear with the drift, $u_{\\mathrm{cum}}N+A\\ln N+B$, against the solver",
            "relative difference at the last cycle of [tab:approach]",
            Number(_drift_distance(material), 2, source="drift against solver, section 4"),
        ),
        (
            "Proven bounds of the wear",
            "relative width at the note's cycle",
            Number((bounds.high - bounds.low) / at_printed, 2, source="bounds by cycle"),
        ),
    ]
    for key, said in (("section4", "`section4`"), ("section3.cutoff", "`section3` to arrest")):
        rows.append(
            (
                f"Cycle count against the integration of every cycle, {said}",
                "largest relative difference of the wear",
                Number(runs.integrated[key], 2, source=f"{key}, two solvers"),
            )
        )
    for name in ("section3", "section4", "section5"):
        case = runs.cases[f"{name}.cutoff"]
        depth = known(case.fate.arrest_wear_mm)
        off = abs(float(case.history.u_c[-1]) / depth - 1.0)
        rows.append(
            (
                f"Arrest depth of `{name}` with the cutoff against the solver",
                "relative difference, or the roundoff of a double",
                Number(max(off, ROUNDOFF), 2, source=f"{name} with cutoff"),
            )
        )
    columns = (
        Column(words("Analysis against numerics"), width=0.5),
        Column(words("Measure"), width=0.27),
        Column(words("Value"), numeric=True),
    )
    cells = tuple((words(a), words(b), (value,)) for a, b, value in rows)
    caption = words(
        "Agreement of formulas with solutions, and of two solvers that share no method."
    )
    return Table("tab:agreement", caption, columns, cells)


def _drift_distance(material: Material) -> float:
    """Relative difference of the wear from its asymptotic law at the last cycle solved."""
    runs, fate = material.runs, material.runs.fate("section4")
    cycle, wear = float(runs.approach.cycles[-1]), float(runs.approach.wear[-1])
    law = known(fate.wear_per_cycle_mm) * cycle
    law += known(fate.log_coefficient_mm) * float(np.log(cycle)) + runs.offset.value
    return abs(law / wear - 1.0)
