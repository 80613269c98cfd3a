"""Assumption: a hypothesis is a judgement that rests on itself."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import sympy as sp
from sympy.core.function import AppliedUndef

from ..claims import Equality, Limit, Property, claim_of, landau_o
from ..hypotheses import Hypothesis, Kind
from ..kernel import Conclusion, Judgement, Rule, RuleError, infer, plain
from ..note.model import FIELDS, belongs
from ..symbols import CLOCKS, DATA, t
from ..zero import is_zero
from .algebra import inserted
from .reading import at_an_instant, clocks, fields, functions

_HIDDEN = (Kind.MODEL, Kind.INITIAL, Kind.DEFINITION)
"""Kinds that no reader sees beside an equation: they may not hide a condition."""


@dataclass(frozen=True)
class Assume(Rule):
    """``H |- H``."""

    hypothesis: Hypothesis

    def conclude(self, *premises: Judgement) -> Conclusion:
        said, relation, kind = self.hypothesis, self.hypothesis.relation, self.hypothesis.kind
        instant = bool(clocks(relation)) and not relation.atoms(AppliedUndef)
        named = kind is Kind.DEFINITION
        if (
            relation == sp.false
            or kind is Kind.DOMAIN
            or relation.has(landau_o)
            or (not named and (instant or premises))
        ):
            raise RuleError(f"{said.text}: cannot be assumed")
        if not belongs(kind, relation):
            raise RuleError(f"{said.text}: no equation of the model")
        claim = Property(said.text) if relation is sp.true else claim_of(relation)
        if kind in _HIDDEN and not isinstance(claim, (Equality, Limit, Property)):
            raise RuleError(f"{said.text}: no equation")
        if named and isinstance(claim, (Equality, Limit)):
            _require_name(claim.relation, premises)
        return Conclusion(claim, adds=(said,))

    def sentence(self, *labels: str, write: Callable[[sp.Basic], str] = plain) -> str:
        return f"Hypothesis: {self.hypothesis.text}."


def _require_name(relation: sp.Equality, premises: tuple[Judgement, ...]) -> None:
    """Refuse to define what is given, or a constant by what varies."""
    name, value = relation.lhs, at_an_instant(relation.rhs)
    found = {field.func for field in functions(relation)}
    if not name.is_Symbol and (found - FIELDS or (not found and _linear(relation))):
        return  # an equation for a field of one's own, or for a name
    if not name.is_Symbol or name.name in DATA or value.has(name):
        raise RuleError(f"missing premise: {name} is a new name")
    rates = [sp.diff(value, f) * sp.Derivative(f, t) for f in fields(value)]
    change = inserted(sp.Add(*rates), premises).doit()
    if not clocks(name) and (clocks(relation.rhs) or not is_zero(change)):
        raise RuleError(f"missing premise: {value} is constant")


def _linear(relation: sp.Equality) -> bool:
    """Return whether an equation is linear in a name, and so has a solution for most data."""
    names = (s for s in relation.free_symbols if s.name not in DATA | CLOCKS)
    slopes = ((name, sp.diff(relation.lhs - relation.rhs, name)) for name in names)
    return any(not slope.has(name) and not is_zero(slope) for name, slope in slopes)


def assume(hypothesis: Hypothesis, name: str = "", remark: str = "") -> Judgement:
    """Return the judgement of a hypothesis."""
    return infer(Assume(hypothesis), name=name, remark=remark)


def defined(symbol: sp.Expr, value: sp.Expr, text: str = "", *steady: Judgement) -> Judgement:
    """Return the definition of a name; further premises say that what varies here does not."""
    relation = sp.Eq(symbol, value, evaluate=False)
    text = text or f"{symbol} by definition"
    return infer(Assume(Hypothesis(text, relation, kind=Kind.DEFINITION)), *steady)
