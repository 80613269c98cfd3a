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
from ..symbols import CLOCKS, DATA, symbol, t
from ..zero import is_zero
from .algebra import inserted
from .reading import at_an_instant, clocks, fields, functions

_HIDDEN = (Kind.MODEL, Kind.INITIAL, Kind.DEFINITION)
"""Kinds that no reader sees beside an equation: they may not hide a condition."""
_TIMES = (t, symbol("tau"), symbol("N"))


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
    if not name.is_Symbol and _solvable(relation):
        return
    if not name.is_Symbol or name.name in DATA or value.has(name):
        raise RuleError(f"missing premise: {name} is a new name")
    if name in _TIMES and found:
        raise RuleError(f"missing premise: {name} is a multiple of another time")
    rates = [sp.diff(value, f) * sp.Derivative(f, t) for f in fields(value)]
    change = inserted(sp.Add(*rates), premises).doit()
    if not clocks(name) and (clocks(relation.rhs) or not is_zero(change)):
        raise RuleError(f"missing premise: {value} is constant")


def _solvable(relation: sp.Equality) -> bool:
    """Return whether an equation, or what tends to a limit by one, is linear in fields of one's
    own, or in names, with a factor that is never zero: of data and other fields it says nothing."""
    tends = isinstance(relation.lhs, sp.Limit)
    whole = relation.lhs.args[0] if tends else relation.lhs - relation.rhs
    fields = {f for f in functions(whole) if f.func not in FIELDS}
    rates = {d for d in whole.atoms(sp.Derivative) if d.expr in fields}
    free = () if functions(whole) else whole.free_symbols
    names = {s for s in free if s.name not in DATA | CLOCKS}
    own = {part: sp.Dummy(real=True) for part in (*rates, *fields, *names)}
    slopes = [sp.diff(whole.xreplace(own), name) for name in own.values()]
    return not any(s.has(*own.values()) for s in slopes) and any(s.is_nonzero for s in slopes)


def assume(hypothesis: Hypothesis, name: str = "", remark: str = "") -> Judgement:
    """Return the judgement of a hypothesis."""
    return infer(Assume(hypothesis), name=name, remark=remark)


def defined(symbol: sp.Expr, value: sp.Expr, text: str = "", *steady: Judgement) -> Judgement:
    """Return the definition of a name; further premises say that what varies here does not."""
    relation = sp.Eq(symbol, value, evaluate=False)
    text = text or f"{symbol} by definition"
    return infer(Assume(Hypothesis(text, relation, kind=Kind.DEFINITION)), *steady)
