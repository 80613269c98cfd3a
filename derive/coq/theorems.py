"""Steps that cite one general theorem of the library: what is inserted into it.

Key results
    proof    the lines of a proof, none where no theorem is known for the step
"""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp
from sympy.core.function import AppliedUndef

from ..symbols import t
from .printer import field, term
from .steps import Step


def proof(step: Step) -> list[str]:
    """Return the lines of a proof by a general theorem."""
    for way in (_discharges, _grows, _integrates):
        if lines := list(way(step)):
            return lines
    return []


def _discharges(step: Step) -> Iterator[str]:
    """A hypothesis of the first parent that the others imply."""
    if step.rule != "Discharge":
        return
    (first, premises), *_ = step.missing
    usable = [s for s in step.frontier if s in step.parents and not s.relation.has(sp.Limit)]
    for premise in premises:
        facts = "".join(f"pose proof ({step.cited(s)}{' t Ht' if s.timed else ''}) as P{i}; " for i, s in enumerate(usable))
        fixed = "intros t Ht; " if premise.timed else ""
        yield f"assert ({premise.label}_met : {premise.said}) by ({fixed}{facts}arithmetic)."
    labels = step.labels | {p.said: f"{p.label}_met" for p in premises}
    yield "exact (" + " ".join((first.name, *(labels[p.said] for p in first.statement.premises))) + ")."


def _grows(step: Step) -> Iterator[str]:
    """A rate of at least c, from 0: u >= c t."""
    relation = step.relation
    if not isinstance(relation, (sp.Ge, sp.Le)) or not _atom(relation.gts):
        return
    for other in step.frontier:
        bound = other.relation
        if isinstance(bound, (sp.Ge, sp.Le)) and bound.gts == sp.Derivative(relation.gts, t):
            name = field(relation.gts)
            start = next(s for s in step.frontier if s.relation.lhs == relation.gts.subs(t, 0))
            yield f"intros t Ht; pose proof (grows {name} _ smooth_{name} ({step.cited(other)}) t Ht) as P0."
            yield f"rewrite ({step.cited(start)}) in P0; same_inequality P0."


def _atom(expr: sp.Expr) -> bool:
    return isinstance(expr, AppliedUndef)


def _integrates(step: Step) -> Iterator[str]:
    """y' = c x' with constant c: y = y(0) + c (x - x(0))."""
    relation = step.relation
    if not isinstance(relation, sp.Equality):
        return
    for other in step.frontier:
        rate = other.relation
        if isinstance(rate, sp.Equality) and _atom(relation.lhs) and rate.lhs == sp.Derivative(relation.lhs, t):
            driving = list(rate.rhs.atoms(sp.Derivative))
            factor = sp.cancel(rate.rhs / driving[0]) if len(driving) == 1 else t
            if factor.has(t):
                return
            y, x = field(relation.lhs), field(driving[0].expr)
            values = [step.cited(s) for s in step.frontier if not s.timed]
            yield "intros t Ht."
            yield f"rewrite (integrates {y} {x} ({term(factor)}) smooth_{y} smooth_{x}); [| | exact Ht]."
            yield "- " + "; ".join((*(f"rewrite ?({v})" for v in values), "identity."))
            yield f"- intros s Hs; rewrite ({step.cited(other)} s Hs); identity."
