"""The paper's section on results that the note does not have."""

from __future__ import annotations

from wear.report.document import Block, Number, Section
from wear.report.material import Material, mm
from wear.report.runs import known
from wear.report.words import paragraph

#: Sections of the catalogue that belong here, each with its heading and its sentences.
_PARTS = (
    (
        "two solids",
        "Two worn solids",
        "If both solids are rough and wear, the equivalent roughness grows by $q$ and the gap "
        "opens by $g$ per wear of the bearing. The limit of $h/\\bar\\sigma$ is $g/q$, for every "
        "sign of the two slopes. With the sign of [eq:1] as printed and a pin that wears faster "
        "than the bearing $g$ is negative: the gap closes without end, an artefact of the sign.",
    ),
    (
        "first integral",
        "A first integral",
        "Closure and roughness are both linear in the wear, which leaves a relation between "
        "pressure, roughness and load that holds at every time, under any load:",
    ),
    (
        "static load",
        "Constant load: the solution in closed form",
        "Under a load that does not vary the variables separate. The time to a given wear is an "
        "exponential integral for either sign of $f_c$; for $f_c=0$ the wear itself is given by "
        "Lambert's function; on a compliant support both are given at a pressure. The scaled form "
        "is the one that is evaluated, without overflow.",
    ),
    (
        "long times",
        "Expansion for long times",
        "Under a sine load the roughness splits into a part $m$ that drifts and an oscillation "
        "within the cycle, $\\bar\\sigma=m+w_1/m+w_2/m^2+\\dots$, and the number of cycles follows "
        "as a function of $m$. The logarithmic drift is its first term.",
    ),
    (
        "compliant support",
        "A support that gives way",
        "A compliant support changes neither the asymptotic pressure nor the wear per cycle, only "
        "the drift towards them:",
    ),
    (
        "bounds",
        "Bounds that are proofs",
        "The rate increases with the load, so that the solutions under its smallest and largest "
        "value enclose the wear. Frozen within one cycle, the same argument gives an enclosure "
        "that is evaluated in ball arithmetic, where every rounding is inside the bounds; the "
        "quadrature error is bounded on a strip of the complex plane.",
    ),
    (
        "sensitivities",
        "Sensitivities and identification",
        "The wear per cycle is proportional to $K_c$, $V$, $T$ and $p_{\\max}$ and inversely "
        "proportional to $H_c$; it is far more sensitive to $f_c$. Solved for a datum, the same "
        "relations identify it from a measurement.",
    ),
    (
        "monotonicity",
        "What more wear follows from",
        "By a comparison of the rates the wear at every time is monotone in the data:",
    ),
    (
        "dimensionless groups",
        "Dimensionless groups",
        "One worn solid has four groups, two have seven, a compliant support adds one:",
    ),
)


def section(material: Material, placed: frozenset[str]) -> Section:
    """Everything in the catalogue that has no place elsewhere in the paper.

    The derivations stand in `appendix`.
    """
    rest = [e for e in material.equations if e.id not in placed]
    known = {name for name, _, _ in _PARTS}
    parts = [
        Section(
            f"sec:{name.replace(' ', '-')}",
            title,
            (
                paragraph(text),
                *material.formulas(*(e.id for e in rest if e.section == name)),
                *_remark(material, name),
            ),
        )
        for name, title, text in _PARTS
    ]
    others = [e for e in rest if e.section not in known]
    for name in dict.fromkeys(e.section for e in others):
        shown = material.formulas(*(e.id for e in others if e.section == name))
        parts.append(Section(f"sec:{name.replace(' ', '-')}", name[0].upper() + name[1:], shown))
    return Section("sec:beyond", "Beyond the note", tuple(parts))


def appendix(material: Material, placed: frozenset[str]) -> Section:
    """The derivations of these results."""
    rest = [e.id for e in material.equations if e.id not in placed]
    return Section(
        "sec:derivations",
        "Derivations of the results beyond the note",
        (
            paragraph("The steps that lead to the results of [sec:beyond], in their order."),
            *material.derivations(*rest),
        ),
    )


def _remark(material: Material, name: str) -> tuple[Block, ...]:
    """What the numbers of this run add."""
    runs = material.runs
    if name == "sensitivities":
        fate, scene = runs.fate("section4"), runs.cases["section4"].scene
        slope = scene.bearing.roughness_slope
        share = known(fate.pressure_MPa) / scene.contact.max_pressure_MPa
        return (
            paragraph(
                "With the data of the note's application a small relative change of $f_c$ changes "
                "the wear per cycle {elasticity} times as much ([eq:elasticity-slope]).",
                elasticity=Number(
                    4.0 / slope * (1.0 - share), 5, source="elasticity of u_cum in f_c, section 4"
                ),
            ),
        )
    if name == "bounds":
        loose, tight = runs.static_bounds, runs.wear_bounds
        return (
            paragraph(
                "After the number of cycles that the note names, the wear of its application is "
                "proved to lie between {low} and {high}; the extremes of the load alone give "
                "{least} and {most}.",
                low=mm(tight.low, 7, "bounds by cycle, section 4"),
                high=mm(tight.high, 7, "bounds by cycle, section 4"),
                least=mm(loose.low, 3, "bounds by extremes of the load, section 4"),
                most=mm(loose.high, 3, "bounds by extremes of the load, section 4"),
            ),
        )
    return ()
