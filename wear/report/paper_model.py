"""The paper's section on the model: drawing, governing equations, nomenclature, data."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import sympy as sp

from derive.symbols import QUANTITIES
from derive.typeset.nomenclature import occurring, unit
from wear.report import drawing
from wear.report.document import Column, Math, Number, Prose, Section, Table, Text
from wear.report.material import Material, drawn
from wear.report.plain import plain
from wear.report.words import paragraph, words
from wear.scene import Scene

#: The quantities of the model, in the order of the table: fields, then data.
_MODEL = (
    "t", "h", "U_a", "U_c", "u_a", "u_c", "sigma_a", "sigma_c", "sigma", "p", "R_a",
    "h_0", "sigma_a0", "sigma_c0", "f_a", "f_c", "f_aa", "f_ac", "f_cc", "f_ca", "K_a", "K_c",
    "H_a", "H_c", "p_max", "k", "b", "L", "R", "omega", "V", "U", "T",
)  # fmt: skip


def section(material: Material) -> Section:
    """The model on a page."""
    return Section(
        "sec:model",
        "The model",
        (
            paragraph(
                "A rotating pin (index $a$) is pressed periodically against a bearing (index $c$) "
                "that stands on springs ([fig:system]). Both are rigid; their rough surfaces "
                "touch, wear, and change their roughness as they wear. The unknowns depend on time "
                "only: the contact is taken as uniform along the circumference. Displacements are "
                "counted downwards, the sense in which those of the pin close the gap and those of "
                "the bearing open it. Lengths are in mm, pressures in MPa, times in s; "
                "[tab:nomenclature] has the symbols, [tab:symbols] those that the results add, "
                "[tab:data] the data of the note's examples."
            ),
            drawn(
                "fig:system",
                drawing.system(),
                paragraph(
                    "The system: pin, bearing and support, with the unknowns of the model. The "
                    "closure $h$ is the distance of the mean surfaces."
                ),
                drawing.DESCRIPTION,
                "system",
            ),
            paragraph(
                "Six hypotheses make up the model: kinematics [eq:1]; equilibrium of the pin under "
                "the force $R_a$ and of the bearing on its springs, [(eq:2a)] and [(eq:2b)]; the "
                "equivalent roughness [(eq:3)]; a contact law [(eq:4)] between pressure and "
                "closure over roughness; Archard's law for the wear of both solids, and "
                "roughnesses that change in proportion to it [(eq:5)]; and the state at the start "
                "[(eq:6)]. The slip rate is $V=R\\omega$. The word behind a title says what the "
                "machine found: *definition* for what is taken from the note, *derived* for what "
                "follows, *corrected* where the printed form does not hold and the form shown does."
            ),
            *material.show("1", "2a", "2b", "3", "4", "5", "6"),
            paragraph(
                "Two features decide the long run. The contact law [eq:4] is cut off at "
                "$h=3\\bar\\sigma$, where the pressure jumps by {jump} of $p_{\\max}$; from "
                "[eq:7e] on, the note works without this cutoff and does not say so, and the two "
                "readings differ in kind ([sec:regimes]). And [eq:1] lets wear of the pin *close* "
                "the gap, although wear removes material; this does not touch the case of bearing "
                "wear alone, for which the note has its formulas. The software has both readings "
                "of the contact law and both signs. Unless said otherwise the text follows the "
                "note: sign as printed, no cutoff.",
                jump=Number(_jump() * 100, 3, "%", source="Eq. (4) at h = 3 sigma"),
            ),
            _symbols("tab:nomenclature", words("Symbols of the model: fields, then data."), _MODEL),
            _data(material),
        ),
    )


def _jump() -> float:
    """The share of p_max that the cutoff drops."""
    from wear.generated import asymptotics as formula

    return float(formula.share_tanh(3.0))


def further_symbols(material: Material) -> Table:
    """The symbols that the results add to those of the model."""
    used = (quantity.name for quantity in occurring(_shown(material)))
    caption = words("Symbols of the results, besides those of [tab:nomenclature].")
    return _symbols("tab:symbols", caption, [name for name in used if name not in _MODEL])


def _shown(material: Material) -> Iterator[sp.Basic]:
    """What the paper shows: equations, the printed forms of those corrected, hypotheses, steps."""
    for equation in material.equations:
        yield from (*equation.shown, *equation.where)
        if not equation.agrees:
            yield from equation.printed
        yield from (condition.relation for condition in equation.conditions)
        yield from (step.claim for step in equation.steps)


def _symbols(label: str, caption: Prose, names: Sequence[str]) -> Table:
    rows = tuple(
        (
            (Math(QUANTITIES[name].latex),),
            plain(QUANTITIES[name].meaning, "nomenclature"),
            (Math(shown) if (shown := unit(QUANTITIES[name])) else Text("–"),),
        )
        for name in names
    )
    columns = (
        Column(words("Symbol")),
        Column(words("Meaning"), width=0.62),
        Column(words("Unit")),
    )
    return Table(label, caption, columns, rows, long=True)


_ROWS = (
    ("K_c", "K_c", ""),
    ("K_a", "K_a", ""),
    ("H_c", "H_c", "MPa"),
    ("H_a", "H_a", "MPa"),
    ("f_c", "f_c", ""),
    ("f_a", "f_a", ""),
    ("sigma_c0", "sigma_c0", "mm"),
    ("sigma_a0", "sigma_a0", "mm"),
    ("h_0", "h_0", "mm"),
    ("p_max", "p_max", "MPa"),
    ("R", "R", "mm"),
    ("T", "T", "s"),
)


def _data(material: Material) -> Table:
    scenes = [
        (name, material.runs.cases[name].scene) for name in ("section3", "section4", "section5")
    ]
    rows = tuple(
        (
            (Math(QUANTITIES[name].latex), *((Text(f" ({unit})"),) if unit else ())),
            *(_entry(scene, key, title) for title, scene in scenes),
        )
        for name, key, unit in _ROWS
    )
    amplitude = (
        (Math("U"), Text(" (mm)")),
        *((Number(s.periodic_load.maximum, 1, source=f"scene {n}"),) for n, s in scenes),
    )
    columns = (
        Column(words("Datum")),
        *(Column(words(f"`{name}`"), numeric=True) for name, _ in scenes),
    )
    caption = words(
        "Data of the note's sections, as scenes of the software. The closure is three times the "
        "initial equivalent roughness; the note prints it rounded (claims [(claim:C16)], "
        "[(claim:C33)] and [(claim:C39)]). The load is $U_a=U\\sin(2\\pi t/T)$, the speed "
        "{speed}. Without a value for the pin: it is smooth and does not wear.",
        speed=Number(scenes[0][1].motion.speed_rpm, 4, "rpm", source="scene section3"),
    )
    return Table("tab:data", caption, columns, (*rows, amplitude))


def _entry(scene: Scene, key: str, title: str) -> tuple[Number | Text, ...]:
    value = scene.parameters().get(key)
    if value is None:
        return (Text("–"),)
    return (Number(value, _digits(value), source=f"scene {title}"),)


def _digits(value: float) -> int:
    """As many digits as a datum has, six at most."""
    return len(f"{value:.5e}".partition("e")[0].replace(".", "").rstrip("0").lstrip("-")) or 1
