"""The paper's section on the long run: the note's argument, the sound one, the drift."""

from __future__ import annotations

from wear.report import paper_regimes
from wear.report.document import Number, Section
from wear.report.material import Material, mm
from wear.report.runs import known
from wear.report.words import paragraph


def section(material: Material) -> Section:
    """Asymptotics and stabilisation."""
    return Section(
        "sec:asymptotics",
        "What becomes of the wear in the long run",
        (
            _note_route(material),
            _sound_route(material),
            _no_asymptote(material),
            paper_regimes.validity(material),
            paper_regimes.regimes(material),
        ),
    )


def _note_route(material: Material) -> Section:
    case = material.runs.cases["section4"]
    slope, start = case.scene.bearing.roughness_growth, case.scene.bearing.roughness_mm
    bracket = 2.0 * (slope * case.scene.closure - start)
    return Section(
        "sec:note-route",
        "The argument of the note, and where it breaks",
        (
            paragraph(
                "The note first defines what an asymptotic and a stabilised response are. As "
                "printed, [eq:11] excludes nothing: every field $G$ satisfies it with "
                "$G_\\infty=G$ ([eq:every-field]). It says something if the limit does not vary in "
                "time. [eq:12] lacks the time derivatives that its text speaks of; without them a "
                "wear that accumulates could not be called stabilised."
            ),
            *material.show("11", "every-field", "12"),
            paragraph(
                "The note then compares the argument of $\\tanh$ at $t$ and $t+T$. Both lines of "
                "the passage to the limit hold; they follow from [sec:sound-route], not from what "
                "precedes them in the note. The first is repeated in [(eq:16a)] and [(eq:17a)]:"
            ),
            *material.show("15", "16a", "17a"),
            paragraph(
                "The step from [eq:15] to [eq:16b] does not hold. The difference of the two "
                "arguments is a fraction, [eq:dropped-denominators], whose denominator is a "
                "product of two roughnesses; it tends to infinity and was dropped. What is left, "
                "the bracket, does not depend on the wear at all [(eq:bracket)]: with the data of "
                "the note's application it is {bracket} whenever $U_a=0$, and under a load that "
                "varies it has no limit. That $u_{\\mathrm{cum}}$ times its limit is zero is "
                "therefore false, and [eq:17b], which the note infers from it, is true for "
                "another reason.",
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
                "The limit needs neither periodicity nor [eq:16b], only $f_c>0$, $\\sigma_c^0>0$ "
                "and a bounded load, $|U_a|\\le U$. The ratio $h/\\bar\\sigma$ differs from "
                "$1/f_c$ by *exactly* a bounded quantity over the roughness:"
            ),
            *material.show("deviation"),
            paragraph(
                "So the ratio is bounded from above for all times, and the rate from below by a "
                "positive number; wear and roughness grow without bound ([eq:growth]), and the "
                "ratio tends to $1/f_c$. Nothing in this is special to $\\tanh$: it holds for "
                "every law $p=p_{\\max}\\,\\phi(h/\\bar\\sigma)$ with a positive, continuous and "
                "decreasing $\\phi$, such as the exponential law of rough surfaces "
                "[ref:greenwood1966]."
            ),
            *material.show("growth", "general-rate", "closure-ratio", "general-law"),
            paragraph(
                "With the law of the note, $\\phi(r)=\\bigl(1+\\tanh(4-2r)\\bigr)/2$, these are "
                "the note's results, under the hypotheses named:"
            ),
            *material.show("17b", "18", "14", "20", "21", "22"),
            paragraph(
                "With the data of the note's application [eq:21] gives {per_cycle} per cycle and "
                "[eq:22] a pressure of {pressure}. The distance from the limit is bounded at "
                "every time by the same quantity:",
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
                "[eq:19], after $N$ cycles, $u_c(NT)=u_{\\mathrm{cum}}N+A\\ln N+B+o(1)$, of which "
                "[eq:expansion] has more terms. Here $A$ follows from the data, does not depend "
                "on $K_c$, and vanishes for one slope only, $f_c=\\sigma_c^0/(h_0-\\langle "
                "U_a\\rangle)$; $B$ keeps the memory of the start. With the data of the note's "
                "application $A$ is {drift}, which is {ratio} times the wear per cycle, and $B$ "
                "is {offset}.",
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
