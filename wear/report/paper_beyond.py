"""The paper's section on results that the note does not have."""

from __future__ import annotations

from collections.abc import Hashable
from typing import TYPE_CHECKING

from wear.report.document import Block, Number, Section
from wear.report.material import Material, mm
from wear.report.paper_model import further_symbols
from wear.report.runs import known
from wear.report.words import paragraph

if TYPE_CHECKING:
    from derive.equations import Equation

#: Sections of the catalogue that belong here, each with its heading and its sentences.
_PARTS = (
    (
        "two solids",
        "Two worn solids",
        "If both solids are rough and wear, the wear of the pin is $\\kappa$ times that of the "
        "bearing, the equivalent roughness grows in the end by $q$ and the gap opens by $g$ per "
        "wear of the bearing. Unless both roughnesses vanish at the same wear, the equivalent "
        "roughness never does ([eq:two-solids-roughness]), and the limit of $h/\\bar\\sigma$ is "
        "$g/q$, for every sign of the two slopes. With the sign of [eq:1] as printed and a pin "
        "that wears faster than the bearing $g$ is negative: the gap closes without end, an "
        "artefact of the sign.",
    ),
    (
        "first integral",
        "A first integral",
        "Closure and roughness are both linear in the wear. This leaves a relation between "
        "pressure, roughness and load that holds at every time, under any load, on a rigid or a "
        "compliant support:",
    ),
    (
        "static load",
        "Constant load: the solution in closed form",
        "Under a load that does not vary the variables separate. The time to a given wear is an "
        "exponential integral, $\\operatorname{Ei}$, for either sign of $f_c$; for $f_c=0$ the "
        "wear itself is given by Lambert's function $W$ [ref:corless1996]; on a compliant support "
        "wear and time are both given at a pressure. The scaled form "
        "[(eq:static-solution-scaled)] of the primitive is the one that is evaluated.",
    ),
    (
        "long times",
        "Expansion for long times",
        "Under a sine load the roughness splits into a part $m$ that drifts and an oscillation "
        "within the cycle, $\\bar\\sigma=m+w_1/m+w_2/m^2+\\dots$ with "
        "$\\mathrm{d}m/\\mathrm{d}\\tau=\\rho\\,(1+c_1/m+c_2/m^2+\\dots)$, $\\tau=t/T$. The "
        "number of cycles follows as a function of $m$, up to terms of the order $m^{-4}$; $s_0$ "
        "keeps the memory of the start. The logarithmic drift [(eq:19)] is its first term.",
    ),
    (
        "compliant support",
        "A support that gives way",
        "The deflection of the support is bounded by $p_{\\max}/k$, so that a finite stiffness "
        "changes neither the asymptotic pressure nor the wear per cycle, only the drift towards "
        "them. Where $\\phi$ stands, any positive, continuous, decreasing law will do:",
    ),
    (
        "bounds",
        "Bounds that are proofs",
        "The rate increases with the load ([eq:wear-increases]), so that by the comparison "
        "theorem [ref:walter1998] the solutions under its smallest and its largest value enclose "
        "the wear; a compliant support acts like the load $U_a-p/k$, which lies between two loads "
        "on a rigid one [(eq:compliant-load)]. Within one cycle the same argument, with the wear "
        "frozen at its start and Gronwall's lemma for what that neglects, gives a much tighter "
        "enclosure. It is evaluated in ball arithmetic [ref:johansson2017], where every rounding "
        "is inside the bounds. Means over a cycle are taken at equidistant phases; their error is "
        "bounded by the size of the law at complex closures [ref:trefethen2014]. There "
        "$1/(1+\\mathrm{e}^{z})$ is below one in modulus as long as $c>0$: with "
        "$a=\\operatorname{Re}z$ and $c=\\cos\\operatorname{Im}z$, [eq:strip] has "
        "$|1+\\mathrm{e}^{z}|^2$ on its left.",
    ),
    (
        "sensitivities",
        "Sensitivities and identification",
        "The wear per cycle is proportional to $K_c$, $V$, $T$ and $p_{\\max}$ and inversely "
        "proportional to $H_c$; it is far more sensitive to $f_c$, and insensitive to all else. "
        "Solved for a datum, the same relations identify it from a measurement: from the wear of "
        "a cycle once that is steady, or from one pressure at any time.",
    ),
    (
        "monotonicity",
        "In which direction each datum acts",
        "Shown are the derivatives of the rate [(eq:bearing-rate)] with respect to each datum that "
        "a title names, in that order, at given wear and load.",
    ),
    (
        "dimensionless groups",
        "Dimensionless groups",
        "Lengths are measured in the initial roughness of the bearing, $v=u_c/\\sigma_c^0$, time "
        "in periods, $\\tau=t/T$, the load in amplitudes, $a=U_a/U$, and pressure in its largest "
        "value, $y=p/p_{\\max}$. Besides the slopes this leaves $\\mu$, $\\eta$ and $\\nu$ for "
        "one worn solid, four groups in all; $\\kappa$ and $\\zeta$ more for two, seven in all; "
        "and one more, $\\lambda$, for a compliant support.",
    ),
)


def section(material: Material, placed: frozenset[str]) -> Section:
    """Everything in the catalogue that has no place elsewhere in the paper, and does not repeat
    what has."""
    before = {_content(e) for e in material.equations if e.id in placed}
    rest = [e for e in material.equations if e.id not in placed and _content(e) not in before]
    known = {name for name, _, _ in _PARTS}
    parts = [
        Section(
            f"sec:{name.replace(' ', '-')}",
            title,
            (
                paragraph(text),
                *material.show(*(e.id for e in rest if e.section == name)),
                *_remark(material, name),
            ),
        )
        for name, title, text in _PARTS
    ]
    others = [e for e in rest if e.section not in known]
    for name in dict.fromkeys(e.section for e in others):
        shown = material.show(*(e.id for e in others if e.section == name))
        parts.append(Section(f"sec:{name.replace(' ', '-')}", name[0].upper() + name[1:], shown))
    parts.append(_symbols(material))
    return Section("sec:beyond", "Beyond the note", tuple(parts))


def _content(equation: Equation) -> Hashable:
    """What an equation says, and when."""
    claims = tuple(statement.claim for statement in equation.statements)
    return claims, frozenset(equation.conditions)


def _symbols(material: Material) -> Section:
    told = paragraph(
        "[tab:symbols] has the symbols that are used in several places; the others are defined "
        "where they stand."
    )
    return Section("sec:symbols", "Symbols of the results", (told, further_symbols(material)))


def _remark(material: Material, name: str) -> tuple[Block, ...]:
    """What the numbers of this run add."""
    runs = material.runs
    if name == "sensitivities":
        fate, scene = runs.fate("section4"), runs.cases["section4"].scene
        elasticity = material.value(
            "elasticity-slope",
            f_c=scene.bearing.roughness_growth,
            p_inf=known(fate.pressure_MPa),
            p_max=scene.contact.max_pressure_MPa,
        )
        return (
            paragraph(
                "With the data of the note's application a small relative change of $f_c$ changes "
                "the wear per cycle {elasticity} times as much ([eq:elasticity-slope]).",
                elasticity=Number(elasticity, 5, source="elasticity of u_cum in f_c, section 4"),
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
