"""The paper: its text (``paper.md``) with the results, equations and figures of a run.

The text takes its numbers from the results where it needs them. This module has the values that
take more than an expression.
"""

from __future__ import annotations

import re
import sys
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
import sympy as sp

from derive.equations import Equation
from derive.kernel import listed
from derive.reasons import line_of, table
from derive.results.regime_map import OPEN, REGIMES
from derive.results.validity import RESOLUTIONS
from derive.symbols import QUANTITIES
from derive.typeset.derivation import Derivations
from derive.typeset.display import inline
from derive.typeset.macros import occurring, unit
from derive.typeset.present import presentable
from derive.verification import Verification
from wear.benchmark import results
from wear.benchmark.methods import cases
from wear.figures import speed_against_cycles
from wear.generated import asymptotics
from wear.report import figures_of_note, note, schematic
from wear.report.claims import Entry
from wear.report.document import DisplayedEquation, Document, FigureFiles, drawn
from wear.report.equations import capital, shown
from wear.report.publish import versions
from wear.report.runs import STATIC_CYCLES, Runs
from wear.report.text import parsed, template

ROUNDOFF = sys.float_info.epsilon
"""The relative resolution of a double: a smaller error cannot be seen."""

#: The quantities of the model, in the order of the table: fields, then data.
_MODEL = (
    "t", "h", "U_a", "U_c", "u_a", "u_c", "sigma_a", "sigma_c", "sigma", "p", "R_a",
    "h_0", "sigma_a0", "sigma_c0", "f_a", "f_c", "f_aa", "f_ac", "f_cc", "f_ca", "K_a", "K_c",
    "H_a", "H_c", "p_max", "k", "b", "L", "R", "omega", "V", "U", "T",
)  # fmt: skip
_EQUATIONS = re.compile(r"^```equations\n(.*?)^```", re.MULTILINE | re.DOTALL)


def paper(
    equations: Sequence[Equation],
    verification: Verification,
    runs: Runs,
    ledger: Sequence[Entry],
    figures: Mapping[str, FigureFiles],
) -> Document:
    """Return the paper. Equations that its text does not name are in the appendix."""
    displayed, derivations = shown(equations), Derivations(equations)
    sections = _by_section(equations, displayed)
    source = template("paper.md")
    text = source.partition("{#app:")[0]
    values = {
        "runs": runs,
        "note": note,
        "formula": asymptotics,
        "quantities": QUANTITIES,
        "roundoff": ROUNDOFF,
        "verified": verification,
        "ledger": ledger,
        "verdicts": Counter(str(entry.finding.verdict) for entry in ledger),
        "labels": {f"eq:{e.id}" for e in equations} | {f"claim:{e.claim.id}" for e in ledger},
        "section": _section,
        "capital": capital,
        "conditions": [row for row in table() if row.model],
        "line": line_of,
        "examples": [runs.histories[name].definition for name in note.EXAMPLES],
        "static_cycles": float(STATIC_CYCLES[-1]),
        "drift_distance": _drift_distance(runs),
        "elasticity": _elasticity(equations, runs),
        "resolutions": RESOLUTIONS,
        "regimes": [
            (
                "with" if regime.cutoff else "without",
                listed([f"${_hypothesis(c.relation)}$" for c in regime.conditions]),
                regime.name,
                listed([f"[(eq:{name})]" for name in regime.equations]),
            )
            for regime in REGIMES
        ],
        "hard": list(_hard(runs)),
        "speed": results,
        "measured": results.committed(),
        "unit": unit,
        "symbols": _MODEL,
        "further_symbols": [
            quantity.name
            for quantity in occurring(_expressions(equations))
            if quantity.name not in _MODEL
        ],
        "versions": versions(),
        "derivations": derivations,
        "origins": {
            name: listed(f"[(eq:{origin})]" for origin in origins)
            for names in sections.values()
            for name in names
            if (origins := derivations.origins(name))
        },
        "sections": sections,
        "in_text": [name for names in _EQUATIONS.findall(text) for name in names.split()],
    }
    return Document(parsed(source, values), displayed, figures)


def drawings(runs: Runs) -> Mapping[str, FigureFiles]:
    """Return the figures of the paper by label."""
    return drawn(
        {
            "system": schematic.system(),
            "wear-curve": figures_of_note.wear_curve(runs),
            "regimes": figures_of_note.regimes(
                {f"§\u2009{name[-1]}": runs.histories[name].definition for name in note.EXAMPLES}
            ),
            "approach": figures_of_note.approach(runs.approach),
            "speed": speed_against_cycles(
                results.curves_by_cycles(results.committed().shown, results.DIGITS[0])
            ),
            "figure-2a": figures_of_note.wear_of_both(runs),
            "figure-2b": figures_of_note.roughness_of_both(runs),
            "figure-3a": figures_of_note.wear_and_asymptote(runs),
            "figure-3b": figures_of_note.wear_coefficients(runs),
        }
    )


def _drift_distance(runs: Runs) -> float:
    """Return the relative difference of the wear from its asymptotic law at the last cycle."""
    limit = runs.asymptotes["section4"]
    cycle, wear = float(runs.approach.cycles[-1]), float(runs.approach.wear[-1])
    law = note.required(limit.wear_per_cycle_mm) * cycle + note.required(limit.offset_mm)
    law += note.required(limit.log_coefficient_mm) * float(np.log(cycle))
    return abs(law / wear - 1.0)


def _elasticity(equations: Sequence[Equation], runs: Runs) -> float:
    """Return the elasticity of the wear per cycle with respect to f_c, by its equation."""
    limit, scene = runs.asymptotes["section4"], runs.histories["section4"].definition
    data = {
        "f_c": scene.bearing.roughness_growth,
        "p_inf": note.required(limit.pressure_MPa),
        "p_max": scene.contact.max_pressure_MPa,
    }
    formula = next(e for e in equations if e.id == "elasticity-slope").relation.rhs
    return float(formula.subs({symbol: data[symbol.name] for symbol in formula.free_symbols}))


def _hypothesis(relation: sp.Basic) -> str:
    """Return a hypothesis of the map, with the gap at the vanishing roughness by its name."""
    gap = sp.Symbol("h_star", real=True)  # of either sign here
    return inline(presentable(relation.xreplace({OPEN.relation.lhs: gap})))


def _hard(runs: Runs) -> Iterator[dict[str, Any]]:
    """Yield the stress tests: history, wear (mm), and its true relative error."""
    names, cycles = [each.definition.name for each in runs.hard], int(runs.hard[0].cycles[-1])
    true = {case.name: case.wear for case in cases("hard", names, (cycles,))}
    for name, found in zip(names, runs.hard, strict=True):
        wear = float(found.u_c[-1])
        error = max(abs(wear / true[name] - 1.0), ROUNDOFF)
        yield {"name": name, "found": found, "wear": wear, "error": error}


def _expressions(equations: Sequence[Equation]) -> Iterator[sp.Basic]:
    """Yield the expressions of the paper: equations, the printed forms of corrected ones,
    hypotheses, steps."""
    for equation in equations:
        yield from (*equation.shown, *equation.where)
        if not equation.agrees:
            yield from equation.printed
        yield from (condition.relation for condition in equation.conditions)
        yield from (step.relation for step in equation.steps)


def _section(where: str) -> str:
    """Return the place of a claim in the note, with the word section before numbers.

    >>> _section("2.5, (6)"), _section("3, 5"), _section("after (21)")
    ('section 2.5, (6)', 'sections 3, 5', 'after (21)')
    """
    if not where[0].isdigit():
        return where
    several = all(part.strip().replace(".", "").isdigit() for part in where.split(",")) and (
        "," in where
    )
    return f"{'sections' if several else 'section'} {where}"


def _by_section(
    equations: Sequence[Equation], displayed: Mapping[str, DisplayedEquation]
) -> dict[str, list[str]]:
    """Return the ids of the equations by section of the catalogue, of identical ones the first."""
    sections: dict[str, list[str]] = {}
    seen: set[str] = set()
    for equation in equations:
        if equation.id not in seen:
            sections.setdefault(equation.section, []).append(equation.id)
        seen |= {equation.id, *displayed[equation.id].also}
    return sections
