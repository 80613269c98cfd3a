"""The paper's section with the note's figures, solved anew."""

from __future__ import annotations

from wear.report import figures_of_note
from wear.report.document import Block, Given, Number, Section
from wear.report.material import Material, count, drawn, mm
from wear.report.reconcile import PRINTED
from wear.report.runs import SECTION_5, known
from wear.report.words import paragraph

_WEAR = (
    "Wear over cycles, that of the bearing above that of the pin: both rise steeply at first and "
    "then ever more slowly; with the cutoff both become constant early, at a lower wear."
)


def section(material: Material) -> Section:
    """Figures 2a, 2b, 3a, 3b."""
    return Section(
        "sec:figures",
        "The figures of the note, solved anew",
        (
            paragraph(
                "The curves show the state after whole cycles, when the pin passes its mean "
                "position. Solid lines are without the cutoff, dashed ones with it."
            ),
            *_section_3(material),
            *_section_4(material),
            *_section_5(material),
        ),
    )


def _section_3(material: Material) -> tuple[Block, ...]:
    runs = material.runs
    plain, cut = runs.history("section3"), runs.fate("section3.cutoff")
    return (
        paragraph(
            "*Two worn solids* ([fig:2a], [fig:2b]). A fast start is followed by ever slower "
            "growth, to {wear} after {cycles} cycles. The note speaks of a transient and a "
            "stabilised evolution; no stage of constant rate appears ([claim:C17]), since the "
            "rate tends to {limit} per cycle. With the cutoff the wear stops for good in cycle "
            "{stop}, at {depth}. Both roughnesses are linear in the wear: that of the bearing "
            "falls from {before} to {after}, that of the pin rises. Continued, the model would "
            "let the roughness of the bearing change its sign, which the note excludes.",
            wear=mm(plain.u_c[-1], 5, "section 3, last cycle of the figure"),
            cycles=count(plain.cycles[-1], "section 3"),
            limit=mm(known(runs.fate("section3").wear_per_cycle_mm), 2, "section 3, limit"),
            stop=count(known(cut.arrest_cycle), "section 3 with cutoff"),
            depth=mm(known(cut.arrest_wear_mm), 5, "section 3 with cutoff"),
            before=mm(plain.sigma_c[0], 3, "section 3, start"),
            after=mm(plain.sigma_c[-1], 4, "section 3, last cycle of the figure"),
        ),
        drawn(
            "fig:2a",
            figures_of_note.wear_of_both(runs),
            paragraph(
                "The note's Fig. {a}: wear of bearing and pin, with and without the cutoff.",
                a=_printed("2a"),
            ),
            _WEAR,
            "figure-2a",
        ),
        drawn(
            "fig:2b",
            figures_of_note.roughness_of_both(runs),
            paragraph(
                "The note's Fig. {b}: roughness of bearing and pin, with and without the cutoff.",
                b=_printed("2b"),
            ),
            "Roughness over cycles: that of the bearing falls a little, that of the pin, far "
            "below, rises a little; with the cutoff both become constant early.",
            "figure-2b",
        ),
    )


def _section_4(material: Material) -> tuple[Block, ...]:
    runs = material.runs
    fate, cut = runs.fate("section4"), runs.fate("section4.cutoff")
    needed = fate.cycles_to_stabilise
    return (
        paragraph(
            "*Bearing wear alone* ([fig:3a]). The dotted line has the slope of [eq:21] and passes "
            "through the last point, where the wear of one cycle is {step}, still {ratio} times "
            "that of the line: nothing is stabilised yet (claims [(claim:C34)] and "
            "[(claim:C37)]). The note's criterion (relative distance of the rate from its limit "
            "below {criterion}) is met on average over a cycle after {mean} cycles, and all "
            "through a cycle after {instant}. At single phases it is met from the first cycle on, "
            "since the rate equals its limit whenever $\\beta=0$ ([eq:deviation]). With the "
            "cutoff wear arrests at {depth} in cycle {stop}, before the note calls it stabilised.",
            step=mm(runs.printed_increment, 5, "section 4, increment at the note's cycle"),
            ratio=Number(
                runs.printed_increment / known(fate.wear_per_cycle_mm), 3, source="section 4"
            ),
            criterion=Number(PRINTED.criterion, 1, source="the note's criterion"),
            mean=Number(known(needed["mean_rate_within_1e-6"]), 3, source="A/u_cum"),
            instant=Number(known(needed["rate_within_1e-6"]), 2, source="extremes of the load"),
            depth=mm(known(cut.arrest_wear_mm), 4, "section 4 with cutoff"),
            stop=count(known(cut.arrest_cycle), "section 4 with cutoff"),
        ),
        drawn(
            "fig:3a",
            figures_of_note.wear_and_asymptote(runs),
            paragraph(
                "The note's Fig. {a}: bearing wear, with and without the cutoff, and a line with "
                "the slope of [eq:21] through the last point.",
                a=_printed("3a"),
            ),
            "A concave curve below a nearly horizontal straight line that it reaches at the end; "
            "a dashed curve that becomes constant.",
            "figure-3a",
        ),
    )


def _section_5(material: Material) -> tuple[Block, ...]:
    runs = material.runs
    lowest, highest = (runs.history(name) for name in (SECTION_5[0], SECTION_5[-1]))
    coefficients = [runs.cases[name].scene.bearing.wear_coefficient for name in SECTION_5]
    return (
        paragraph(
            "*The wear coefficient* ([fig:3b]), the same for both solids, $K=K_a=K_c$. The text "
            "of the note does not list its values; shown are the decades around that of its other "
            "examples, on an axis that shows them all. A $K$ that is {more} times as large gives "
            "only {factor} times the wear after {cycles} cycles, and the curves become parallel: "
            "on this axis a change of $K$ shifts them sideways. By the note's criterion the "
            "higher $K$ stabilises in fewer cycles, not the lower ([claim:C38]). With the cutoff "
            "all arrest at the same depth, {depth}, which does not depend on $K$; one is shown.",
            more=count(round(coefficients[-1] / coefficients[0]), "scenes of section 5"),
            factor=Number(highest.u_c[-1] / lowest.u_c[-1], 3, source="section 5"),
            cycles=count(highest.cycles[-1], "section 5"),
            depth=mm(
                known(runs.fate("section5.cutoff").arrest_wear_mm), 5, "section 5 with cutoff"
            ),
        ),
        drawn(
            "fig:3b",
            figures_of_note.wear_coefficients(runs),
            paragraph(
                "The note's Fig. {b}: bearing wear for four wear coefficients $K=K_a=K_c$.",
                b=_printed("3b"),
            ),
            "Four rising curves, each shifted to the left of the one for a tenth of the wear "
            "coefficient; a dashed curve that becomes constant.",
            "figure-3b",
        ),
    )


def _printed(number: str) -> Given:
    return Given(number, "number of a figure in the note")
