"""The values of the paper's text by name: numbers with their sources, rows of its tables."""

from __future__ import annotations

import sys
from bisect import bisect_right
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from derive.kernel import listed
from derive.results.regime_map import REGIMES
from derive.results.validity import RESOLUTIONS
from derive.symbols import QUANTITIES
from derive.typeset.display import inline
from derive.typeset.nomenclature import occurring, unit
from derive.typeset.present import presentable
from wear.benchmark.machine import footer
from wear.benchmark.methods import cases
from wear.benchmark.results import DIGITS, READER, committed, sentences, speed_table
from wear.generated import asymptotics as formula
from wear.report import note
from wear.report.derivations import Derivations
from wear.report.equations import capital
from wear.report.manifest import versions
from wear.report.markup import markup
from wear.report.number import Number, significant
from wear.report.runs import STATIC_CYCLES, Runs
from wear.report.text import escaped

if TYPE_CHECKING:
    import sympy as sp

    from derive.equations import Equation
    from derive.verification import Verification
    from wear.report.claims import Entry
    from wear.report.document import Equation as Shown
    from wear.scene import Scene

ROUNDOFF = sys.float_info.epsilon
"""The relative resolution of a double: a smaller error cannot be seen."""

#: The quantities of the model, in the order of the table: fields, then data.
_MODEL = (
    "t", "h", "U_a", "U_c", "u_a", "u_c", "sigma_a", "sigma_c", "sigma", "p", "R_a",
    "h_0", "sigma_a0", "sigma_c0", "f_a", "f_c", "f_aa", "f_ac", "f_cc", "f_ca", "K_a", "K_c",
    "H_a", "H_c", "p_max", "k", "b", "L", "R", "omega", "V", "U", "T",
)  # fmt: skip
_DATA = (
    ("K_c", ""), ("K_a", ""), ("H_c", "MPa"), ("H_a", "MPa"), ("f_c", ""), ("f_a", ""),
    ("sigma_c0", "mm"), ("sigma_a0", "mm"), ("h_0", "mm"), ("p_max", "MPa"), ("R", "mm"),
    ("T", "s"),
)  # fmt: skip
_LEDGER = (
    (1, "the model"),
    (9, "the condensed problem"),
    (14, "the rigid support and the first example"),
    (18, "what a stabilised response is"),
    (22, "the passage to the limit"),
    (28, "wear and pressure of a stabilised response"),
    (33, "the application"),
    (38, "the wear coefficient and the data"),
)
VERDICTS = (
    "confirmed", "confirmed-with-conditions", "not-reproducible", "inconsistent", "refuted",
)  # fmt: skip


@dataclass(frozen=True)
class Material:
    """All that was computed for the report."""

    equations: Sequence[Equation]
    shown: Mapping[str, Shown]
    verification: Verification
    runs: Runs
    ledger: Sequence[Entry]


def values(material: Material) -> dict[str, Any]:
    """Return the values of the paper by name."""
    derivations = Derivations(material.equations)
    runs = material.runs
    return {
        **_verification(material),
        **_limits(runs),
        **_note(runs),
        **_figures(runs),
        **_agreement(runs),
        **_speed(),
        "elasticity": _elasticity(material),
        "conditions": list(_conditions()),
        "data": [_data_row(runs, name, of) for name, of in _DATA] + [_amplitudes(runs)],
        "p_max": _datum(runs, "p_max"),
        "hardness": _datum(runs, "H_c"),
        "speed_rpm": Number(runs.cases["section3"].scene.motion.speed_rpm, "scene section3", 4),
        "symbols": [_symbol(name) for name in _MODEL],
        "further_symbols": [_symbol(name) for name in _further(material.equations)],
        "thresholds": list(_thresholds()),
        "regimes": list(_regimes()),
        "approach": list(_approach(runs)),
        "decay": list(_decay(runs)),
        "hard": list(_hard(runs)),
        "ledger": list(_ledger(material)),
        "versions": list(versions().items()),
        "derivations": derivations.full,
        "origins": derivations.origins,
        "derived": [e.id for e in material.equations if derivations.origins(e.id)],
        "sections": _by_section(material),
        "hard_cycles": _count(runs.hard[0].cycles[-1], "hard scenes"),
    }


def _mm(value: float, digits: int, source: str) -> Number:
    return Number(float(value), source, digits, "mm")


def _count(value: float, source: str) -> Number:
    return Number(int(value), source)


def _verification(material: Material) -> dict[str, Any]:
    """Return how much was checked, and what came of the claims."""
    checked = material.verification
    counts = {
        verdict.replace("-", "_"): _count(
            sum(str(e.finding.verdict) == verdict for e in material.ledger), "ledger"
        )
        for verdict in VERDICTS
    }
    return {
        **counts,
        "claims": _count(len(material.ledger), "ledger"),
        "equations": _count(checked.equations, "catalogue of equations"),
        "steps": _count(checked.steps, "verification"),
        "checks": _count(checked.checks, "verification"),
        "proofs": _count(checked.of_kind("proof"), "verification"),
        "dimensions": _count(checked.of_kind("dimensions"), "verification"),
        "on_models": _count(checked.of_kind("falsifier"), "verification"),
        "by_coq": _count(checked.of_kind("coq"), "verification"),
        "failed": _count(len(checked.failures), "verification"),
    }


def _conditions() -> Iterator[dict[str, str]]:
    """Yield the conditions of the equations of the note, with what fails without them."""
    from derive.reasons import table

    for row in table():
        if row.model:
            said = markup(row.condition) if row.latex.startswith(r"\text") else f"${row.latex}$"
            model = ", ".join(f"${part}$" for part in row.model)
            yield {"id": row.equation, "said": said, "model": f"{model}: {row.where}"}


def _limits(runs: Runs) -> dict[str, Any]:
    """Return the constants of the application of the note."""
    limit, stop = runs.asymptote("section4"), runs.asymptote("section4" + note.CUTOFF)
    per_cycle = note.required(limit.wear_per_cycle_mm)
    drift = note.required(limit.log_coefficient_mm)
    scene = runs.cases["section4"].scene
    bracket = 2.0 * (scene.bearing.roughness_growth * scene.closure - scene.bearing.roughness_mm)
    needed = limit.cycles_to_stabilise
    return {
        "per_cycle": _mm(per_cycle, 5, "Eq. (21) with the data of section 4"),
        "pressure": Number(
            note.required(limit.pressure_MPa), "Eq. (22), data of section 4", 6, "MPa"
        ),
        "drift": _mm(drift, 5, "logarithmic coefficient, data of section 4"),
        "drift_ratio": Number(drift / per_cycle, "A/u_cum, data of section 4", 4),
        "offset": _mm(note.required(limit.offset_mm), 9, "offset, section 4"),
        "needed": Number(note.required(needed["mean_rate_within_1e-6"]), "A/u_cum", 2),
        "needed_instant": Number(
            note.required(needed["rate_within_1e-6"]), "extremes of the load", 2
        ),
        "stop": _count(note.required(stop.arrest_cycle), "section 4 with loss of contact"),
        "depth": _mm(note.required(stop.arrest_wear_mm), 4, "section 4 with loss of contact"),
        "jump": Number(100.0 * float(formula.share_tanh(3.0)), "Eq. (4) at h = 3 sigma", 3, "%"),
        "bracket": _mm(bracket, 3, "bracket of Eq. (16) with the data of section 4"),
        "eighth": Number(float(formula.share_tanh(8.0)), "1/(1 + e^24)", 4),
        "first_slope": Number(_slope(runs, "section3"), "scene section3", 1),
        "middle_slope": Number(_slope(runs, "section4"), "scene section4", 2),
        "last_slope": Number(_slope(runs, "section5"), "scene section5", 1),
    }


def _slope(runs: Runs, name: str) -> float:
    return runs.cases[name].scene.bearing.roughness_growth


def _note(runs: Runs) -> dict[str, Any]:
    """Return the printed numbers of the note, and what the solution has in their place."""
    per_cycle = note.required(runs.asymptote("section4").wear_per_cycle_mm)
    increment = runs.printed_increment
    return {
        "printed": _mm(note.PRINTED.formula_mm, 3, "printed in the note after (21)"),
        "simulated": _mm(note.PRINTED.simulated_mm, 3, "printed in the note before (21)"),
        "note_cycle": _count(note.PRINTED.cycles, "the note"),
        "criterion": Number(note.PRINTED.criterion, "the note's criterion", 1),
        "increment": _mm(increment, 5, "section 4, increment at the note's cycle"),
        "ratio": Number(increment / per_cycle, "section 4, increment over limit", 3),
        "early": Number(increment / per_cycle - 1.0, "section 4 at the note's cycle", 3),
        "excess": Number(runs.threshold_excess, "section 4 at the predicted cycle", 6),
        "factor": Number(note.PRINTED.formula_mm / per_cycle, "printed value over Eq. (21)", 3),
        "changed_slope": Number(runs.reconciliation.value, "inverse of (21)", 7),
        "altered": _mm(runs.reconciliation.simulated_mm, 4, "section 4 with that slope"),
        "two_solids_limit": _mm(
            note.required(runs.asymptote("section3").wear_per_cycle_mm), 2, "section 3, limit"
        ),
    }


def _figures(runs: Runs) -> dict[str, Any]:
    """Return what the sentences on the figures of the note quote."""
    plain, cut = runs.history("section3"), runs.asymptote("section3" + note.CUTOFF)
    lowest, highest = (runs.history(name) for name in (note.SECTION_5[0], note.SECTION_5[-1]))
    coefficients = [runs.cases[name].scene.bearing.wear_coefficient for name in note.SECTION_5]
    end = note.required(runs.asymptote("section5" + note.CUTOFF).arrest_wear_mm)
    loose, tight = runs.static_bounds, runs.wear_bounds
    return {
        "wear_3": _mm(plain.u_c[-1], 5, "section 3, last cycle of the figure"),
        "cycles_3": _count(plain.cycles[-1], "section 3"),
        "stop_3": _count(note.required(cut.arrest_cycle), "section 3 with loss of contact"),
        "depth_3": _mm(note.required(cut.arrest_wear_mm), 5, "section 3 with loss of contact"),
        "before_3": _mm(plain.sigma_c[0], 3, "section 3, start"),
        "after_3": _mm(plain.sigma_c[-1], 4, "section 3, last cycle of the figure"),
        "more_5": _count(round(coefficients[-1] / coefficients[0]), "scenes of section 5"),
        "factor_5": Number(float(highest.u_c[-1] / lowest.u_c[-1]), "section 5", 3),
        "cycles_5": _count(highest.cycles[-1], "section 5"),
        "depth_5": _mm(end, 5, "section 5 with loss of contact"),
        "low": _mm(tight.low, 7, "bounds by cycle, section 4"),
        "high": _mm(tight.high, 7, "bounds by cycle, section 4"),
        "least": _mm(loose.low, 3, "bounds by extremes of the load, section 4"),
        "most": _mm(loose.high, 3, "bounds by extremes of the load, section 4"),
    }


def _agreement(runs: Runs) -> dict[str, Any]:
    """Return how far formulas and solutions are apart."""
    bounds = runs.wear_bounds
    wear = float(runs.history("section4").u_c[-1])
    arrests = {}
    for name in note.EXAMPLES:
        case = runs.cases[name + note.CUTOFF]
        off = abs(float(case.history.u_c[-1]) / note.required(case.asymptote.arrest_wear_mm) - 1.0)
        arrests[name] = Number(max(off, ROUNDOFF), f"{name} with loss of contact", 2)
    return {
        "static_distance": Number(runs.static_distance, "section 4, constant load", 2),
        "static_cycles": Number(float(STATIC_CYCLES[-1]), "request", 1),
        "phase_distance": Number(runs.phases.distance, "section 4, phases of the steady rate", 2),
        "drift_distance": Number(_drift_distance(runs), "drift against solver, section 4", 2),
        "bounds_width": Number((bounds.high - bounds.low) / wear, "bounds by cycle", 2),
        "integrated": {
            name.partition(".")[0]: Number(value, f"{name}, two solvers", 2)
            for name, value in runs.integrated.items()
        },
        "arrests": arrests,
    }


def _drift_distance(runs: Runs) -> float:
    """Relative difference of the wear from its asymptotic law at the last cycle solved."""
    limit = runs.asymptote("section4")
    cycle, wear = float(runs.approach.cycles[-1]), float(runs.approach.wear[-1])
    law = note.required(limit.wear_per_cycle_mm) * cycle + note.required(limit.offset_mm)
    law += note.required(limit.log_coefficient_mm) * float(np.log(cycle))
    return abs(law / wear - 1.0)


def _elasticity(material: Material) -> Number:
    """Return the elasticity of the wear per cycle in f_c, by its equation."""
    limit, scene = material.runs.asymptote("section4"), material.runs.cases["section4"].scene
    data = {
        "f_c": scene.bearing.roughness_growth,
        "p_inf": note.required(limit.pressure_MPa),
        "p_max": scene.contact.max_pressure_MPa,
    }
    found = next(e for e in material.equations if e.id == "elasticity-slope").relation.rhs
    value = float(found.subs({symbol: data[symbol.name] for symbol in found.free_symbols}))
    return Number(value, "elasticity of u_cum in f_c, section 4", 5)


def _speed() -> dict[str, Any]:
    """Return the benchmark as the documentation has it."""
    measured, digits = committed(), DIGITS[0]
    found = speed_table(measured.runs, READER, digits)
    signs = str.maketrans({"x": "\u00d7", "~": "\u2248"})
    return {
        "speed_header": [escaped(heading.capitalize()) for heading in found.header],
        "speed_rows": [
            [escaped(method), *(escaped(cell.translate(signs)) for cell in cells)]
            for method, *cells in found.rows
        ],
        "speed_sentences": [escaped(s) for s in sentences(measured.runs, READER, digits)],
        "speed_digits": Number(digits, "request"),
        "machine": escaped(footer(measured.facts)),
    }


# Rows of tables


def _data_row(runs: Runs, name: str, of: str) -> tuple[str, list[Number | str]]:
    scenes = [runs.cases[example].scene for example in note.EXAMPLES]
    label = f"${QUANTITIES[name].latex}$" + (f" ({of})" if of else "")
    return label, [_entry(scene, name) for scene in scenes]


def _entry(scene: Scene, name: str) -> Number | str:
    value = scene.parameters().get(name)
    return "–" if value is None else Number(value, f"scene {scene.name}", significant(value, 6))


def _amplitudes(runs: Runs) -> tuple[str, list[Number | str]]:
    scenes = [runs.cases[example].scene for example in note.EXAMPLES]
    return "$U$ (mm)", [
        Number(scene.periodic_load.maximum, f"scene {scene.name}", 1) for scene in scenes
    ]


def _symbol(name: str) -> tuple[str, str, str]:
    """Return symbol, meaning and unit of a quantity."""
    quantity = QUANTITIES[name]
    shown = unit(quantity)
    return f"${quantity.latex}$", markup(quantity.meaning), f"${shown}$" if shown else "–"


def _further(equations: Sequence[Equation]) -> list[str]:
    """Return the symbols that the results add to those of the model."""
    names = [quantity.name for quantity in occurring(_expressions(equations))]
    return [name for name in names if name not in _MODEL]


def _expressions(equations: Sequence[Equation]) -> Iterator[sp.Basic]:
    """Yield what the paper shows: equations, the printed forms of those corrected, hypotheses,
    steps."""
    for equation in equations:
        yield from (*equation.shown, *equation.where)
        if not equation.agrees:
            yield from equation.printed
        yield from (condition.relation for condition in equation.conditions)
        yield from (step.relation for step in equation.steps)


def _datum(runs: Runs, name: str) -> Number:
    """A number of the application in MPa."""
    value = runs.cases["section4"].scene.parameters()[name]
    return Number(round(value), "scene section4", 3, "MPa")


def _thresholds() -> Iterator[tuple[str, Number, Number]]:
    for name, resolution in RESOLUTIONS.items():
        least = float(formula.slope_threshold(epsilon=float(resolution)))
        yield (
            name,
            Number(float(resolution), "resolution of the arithmetic", 4),
            Number(least, "threshold", 8),
        )


def _regimes() -> Iterator[tuple[str, str, str, str]]:
    """Yield the rows of the map by which the software decides."""
    for regime in REGIMES:
        where = listed([f"${_hypothesis(c.relation)}$" for c in regime.conditions])
        equations = listed([f"[(eq:{name})]" for name in regime.equations])
        yield "with" if regime.cutoff else "without", where, regime.name, equations


def _hypothesis(relation: sp.Basic) -> str:
    """Return a hypothesis of the map, with the gap at the vanishing roughness by its name."""
    import sympy as sp

    from derive.results.regime_map import OPEN

    gap = sp.Symbol("h_star", real=True)  # of either sign here
    return inline(presentable(relation.xreplace({OPEN.relation.lhs: gap})))


def _approach(runs: Runs) -> Iterator[list[Number]]:
    found, source = runs.approach, "approach, section 4"
    for cycle, step, excess, pressure, predicted in zip(
        found.cycles, found.increment, found.excess, found.pressure_excess, found.predicted,
        strict=True,
    ):  # fmt: skip
        if cycle >= 1e3:
            shown = ((cycle, 1), (step, 5), (excess, 4), (pressure, 4), (predicted, 4),
                     (excess / predicted, 5))  # fmt: skip
            yield [Number(float(value), source, digits) for value, digits in shown]


def _decay(runs: Runs) -> Iterator[tuple[Number, Number, Number]]:
    """Yield the wear of one cycle of the two worn solids, and N times it."""
    for cycle, step in zip(runs.decay.cycles, runs.decay.increment, strict=True):
        yield (
            Number(float(cycle), "approach, section 3", 1),
            Number(float(step), "section 3, wear of a cycle", 4),
            Number(float(cycle * step), "section 3, N times the wear of a cycle", 4),
        )


def _hard(runs: Runs) -> Iterator[list[Any]]:
    names, cycles = [each.definition.name for each in runs.hard], int(runs.hard[0].cycles[-1])
    true = {case.name: case.wear for case in cases("hard", names, (cycles,))}
    for name, found in zip(names, runs.hard, strict=True):
        wear, source = float(found.u_c[-1]), f"scene {name}"
        error = max(abs(wear / true[name] - 1.0), ROUNDOFF)
        yield [
            markup(found.scene),
            Number(wear, source, 6),
            Number(error, f"{name} against reference", 1),
            Number(float(found.error[-1]), source, 1),
            _count(found.cost["rhs_evaluations"], source),
        ]


def _ledger(material: Material) -> Iterator[dict[str, Any]]:
    """Yield the parts of the ledger, each with its claims."""
    labels = {f"eq:{equation.id}" for equation in material.equations}
    labels |= {f"claim:{entry.claim.id}" for entry in material.ledger}
    starts = [first for first, _ in _LEDGER]
    for place, (first, what) in enumerate(_LEDGER, 1):
        claims = [
            {
                "id": claim.id,
                "where": markup(_place(claim.where), labels),
                "statement": markup(capital(claim.statement), labels),
                "verdict": str(finding.verdict),
                "evidence": markup(finding.evidence, labels),
            }
            for claim, finding in material.ledger
            if bisect_right(starts, int(claim.id[1:])) == place
        ]
        yield {"what": what, "label": f"tab:claims-{first}", "claims": claims}


def _place(where: str) -> str:
    """Return where a claim stands in the note; a section is called one.

    >>> _place("2.5, (6)"), _place("3, 5"), _place("after (21)")
    ('section 2.5, (6)', 'sections 3, 5', 'after (21)')
    """
    if not where[0].isdigit():
        return where
    several = all(part.strip().replace(".", "").isdigit() for part in where.split(",")) and (
        "," in where
    )
    return f"{'sections' if several else 'section'} {where}"


def _by_section(material: Material) -> dict[str, list[str]]:
    """Return the ids of the equations by section of the catalogue, each that says the same once."""
    found: dict[str, list[str]] = {}
    seen: set[str] = set()
    for equation in material.equations:
        if equation.id not in seen:
            found.setdefault(equation.section, []).append(equation.id)
        seen |= {equation.id, *material.shown[equation.id].also}
    return found
