"""The paper's section on the long run: the note's argument, the sound one, validity, regimes."""

from __future__ import annotations

from wear.generated import asymptotics as formula
from wear.report import figures_of_note
from wear.report.document import Column, Number, Section, Table, Text
from wear.report.material import Material, drawn, mm
from wear.report.runs import known
from wear.report.words import paragraph, words

#: Resolutions of p/p_max: half of the 1 + tanh that an arithmetic cannot tell from zero.
_RESOLUTIONS = (
    ("ten decimal digits", 0.25e-10),
    ("single precision", 2.0**-26),
    ("double precision", 2.0**-55),
)

_REGIMES = ("tail", "logarithmic-wear", "saturating-wear", "closed-gap")
_CUTOFF = (
    "contact-condition",
    "margin",
    "arrest-depth",
    "no-contact",
    "rate-in-contact",
    "sliding-rate",
    "one-third",
    "permanent-contact",
    "always-contact",
)


def section(material: Material) -> Section:
    """Asymptotics and stabilisation."""
    return Section(
        "sec:asymptotics",
        "What becomes of the wear in the long run",
        (
            _note_route(material),
            _sound_route(material),
            _no_asymptote(material),
            _validity(material),
            _regimes(material),
        ),
    )


def _note_route(material: Material) -> Section:
    case = material.runs.cases["section4"]
    slope, start = case.scene.bearing.roughness_slope, case.scene.bearing.roughness_mm
    bracket = 2.0 * (slope * case.scene.closure - start)
    return Section(
        "sec:note-route",
        "The argument of the note, and where it breaks",
        (
            paragraph(
                "The note first defines what an asymptotic and a stabilised response are. As "
                "printed, the first definition excludes nothing: every field satisfies it with "
                "itself as its limit. The second lacks the time derivatives without which a wear "
                "that accumulates could not be called stabilised. The corrected forms are what "
                "the note uses."
            ),
            *material.show("11", "every-field", "12"),
            paragraph(
                "It then compares the argument of $\\tanh$ at $t$ and $t+T$. Both lines of the "
                "passage to the limit hold (they follow from [sec:sound-route], not from what "
                "precedes them in the note):"
            ),
            *material.show("15", "16a", "17a"),
            paragraph(
                "The step from [eq:15] to the second line of the next equation does not hold. The "
                "difference of the two arguments is a fraction, [eq:dropped-denominators], whose "
                "denominator is a product of two roughnesses; it tends to infinity and was "
                "dropped. What is left, the bracket, does not depend on the wear at all "
                "[eq:bracket]: with the data of the note's application and at $U_a=0$ it is "
                "{bracket} at every time. That $u_{cum}$ times its limit is zero is therefore "
                "false, and [eq:17b], which the note infers from it, is true for another reason.",
                bracket=mm(bracket, 3, "bracket of Eq. (16) with the data of section 4"),
            ),
            *material.show("dropped-denominators", "bracket", "16b"),
        ),
    )


def _sound_route(material: Material) -> Section:
    fate = material.runs.fate("section4")
    return Section(
        "sec:sound-route",
        "A proof from weaker hypotheses",
        (
            paragraph(
                "The limit needs neither periodicity nor [eq:16b], only $f_c>0$, "
                "$\\sigma_c^0>0$ and a bounded load. The ratio $h/\\bar\\sigma$ differs from "
                "$1/f_c$ by *exactly* a bounded quantity over the roughness:"
            ),
            *material.show("deviation"),
            paragraph(
                "So the ratio is bounded for all times, the rate has a positive lower bound, wear "
                "and roughness grow without bound, and the ratio tends to $1/f_c$. This holds for "
                "every positive, continuous and decreasing contact law $\\phi(h/\\bar\\sigma)$:"
            ),
            *material.show("growth", "closure-ratio", "general-law"),
            paragraph("For the law of the note these are its results, under the hypotheses named:"),
            *material.show("17b", "18", "14", "20", "21", "22"),
            paragraph(
                "With the data of the note's application [eq:21] gives {per_cycle} per cycle and "
                "[eq:22] a pressure of {pressure}. The distance from the limit is bounded at every "
                "time by the same quantity:",
                per_cycle=mm(known(fate.wear_per_cycle_mm), 12, "Eq. (21), data of section 4"),
                pressure=Number(
                    known(fate.pressure_MPa), 6, "MPa", source="Eq. (22), data of section 4"
                ),
            ),
            *material.show("approach"),
        ),
    )


def _no_asymptote(material: Material) -> Section:
    fate, offset = material.runs.fate("section4"), material.runs.offset
    return Section(
        "sec:drift",
        "No straight line: the logarithmic drift",
        (
            paragraph(
                "That the rate tends to a constant does not give the wear a straight asymptote: "
                "the excess of the rate falls like $1/t$ and adds up to a logarithm. In place of "
                "[eq:19], after $N$ cycles,"
                " $u_c(NT)=u_{cum}N+A\\ln N+B+o(1)$. Here $A$ follows from the data and does not "
                "depend on $K_c$, while $B$ keeps the memory of the start. With the data of the "
                "note's application $A$ is {drift}, which is {ratio} times the wear per cycle, and "
                "$B$ is {offset}.",
                drift=mm(known(fate.log_coefficient_mm), 10, "log drift, data of section 4"),
                ratio=Number(
                    known(fate.log_coefficient_mm) / known(fate.wear_per_cycle_mm),
                    4,
                    source="A/u_cum, data of section 4",
                ),
                offset=mm(offset.value, 9, "offset, section 4"),
            ),
            *material.show("19"),
        ),
    )


def _validity(material: Material) -> Section:
    eighth = float(formula.share_tanh(8.0))
    return Section(
        "sec:validity",
        "What a slope of one eighth means",
        (
            paragraph(
                "The note calls [eq:22] valid where $\\tanh(4-2/f_c)>-1$ and reads this as "
                "$f_c>1/8$. The inequality holds for every real argument; it excludes nothing:"
            ),
            *material.show("criterion", "share", "share-slope"),
            paragraph(
                "The asymptotic pressure increases with $f_c$, so that a demand on $f_c$ is a "
                "demand on how small a pressure may be before it is called zero. One eighth "
                "stands for $p_\\infty/p_{\\max}$ above {eighth}, the resolution of a calculation "
                "with some ten digits, not for a property of the model:",
                eighth=Number(eighth, 4, source="1/(1 + e^24)"),
            ),
            *material.show("threshold", "one-eighth"),
            _thresholds(),
            paragraph(
                "Without the cutoff the exact condition is $f_c>0$. With it, the closure ratio "
                "$1/f_c$ must lie within contact, $f_c\\ge 1/3$: below, wear stops "
                "([sec:regimes]). Of the note's examples, that [fig:2a] has a slope of "
                "{first} and fails every one of these conditions; that of [fig:3b], {last}, meets "
                "only the first.",
                first=Number(_slope(material, "section3"), 1, source="scene section3"),
                last=Number(_slope(material, "section5"), 1, source="scene section5"),
            ),
        ),
    )


def _slope(material: Material, name: str) -> float:
    return material.runs.cases[name].scene.bearing.roughness_slope


def _thresholds() -> Table:
    rows = tuple(
        (
            (Text(name),),
            (Number(resolution, 4, source="resolution of the arithmetic"),),
            (Number(float(formula.slope_threshold(epsilon=resolution)), 8, source="threshold"),),
        )
        for name, resolution in _RESOLUTIONS
    )
    columns = (
        Column(words("Arithmetic")),
        Column(words("$\\varepsilon$"), numeric=True),
        Column(words("Least $f_c$"), numeric=True),
    )
    caption = words(
        "The least $f_c$ whose asymptotic pressure $1+\\tanh$ does not round to zero, by "
        "[eq:threshold]. The generated code does not form $1+\\tanh$ and has no such threshold."
    )
    return Table("tab:thresholds", caption, columns, rows)


def _regimes(material: Material) -> Section:
    stop = material.runs.fate("section4.cutoff")
    return Section(
        "sec:regimes",
        "Map of regimes",
        (
            drawn(
                "fig:regimes",
                figures_of_note.regimes(),
                paragraph(
                    "Asymptotic pressure of one worn solid over the roughness slope. The note's "
                    "bound $f_c=1/8$ lies inside the regime of steady wear and parts nothing "
                    "([tab:thresholds]). With the cutoff, wear goes on for ever only from "
                    "$f_c=1/3$ on."
                ),
                "A curve of pressure on a logarithmic axis that falls steeply as the slope "
                "decreases towards zero; three shaded ranges name the regimes.",
                "regimes",
            ),
            paragraph(
                "Without the cutoff there are four regimes: steady wear for $f_c>0$; for $f_c=0$ "
                "wear grows like the logarithm of the cycles; for $f_c<0$ it saturates, "
                "logarithmically slowly, at the depth where the roughness would vanish if the gap "
                "is open there, and reaches it in finite time if not."
            ),
            *material.show(*_REGIMES),
            paragraph(
                "With the cutoff, contact at a given wear is a condition on the load. For "
                "$f_c<1/3$ the gap outgrows the roughness and wear *arrests* at a depth that is "
                "known in closed form, {depth} with the data of the note's application, where it "
                "happens in cycle {cycle}.",
                depth=mm(known(stop.arrest_wear_mm), 4, "arrest depth, section 4 with cutoff"),
                cycle=Number(known(stop.arrest_cycle), 4, source="section 4 with cutoff"),
            ),
            *material.show(*_CUTOFF[:6]),
            paragraph(
                "At $f_c=1/3$ contact lasts a fixed part of every cycle; above, it becomes "
                "permanent beyond a certain wear and [eq:21] holds again."
            ),
            *material.show(*_CUTOFF[6:]),
            paragraph("Two worn solids and a support that gives way have their own conditions."),
            *material.show(*material.others("regimes", *_REGIMES)),
            *material.show(*material.others("cutoff", *_CUTOFF)),
        ),
    )  # fmt: skip
