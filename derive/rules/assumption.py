"""Assumption: a hypothesis is a judgement that rests on itself."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import sympy as sp
from sympy.core.function import AppliedUndef

from ..claims import Equality, Limit, Property, claim_of, landau_o
from ..hypotheses import Hypothesis, Kind
from ..kernel import Conclusion, Judgement, Rule, RuleError, infer, plain
from ..note.model import FIELDS, belongs, law_of
from ..symbols import CLOCKS, DATA, symbol, t
from ..zero import is_zero
from .algebra import inserted
from .proving import falls
from .reading import at_an_instant, clocks, fields, functions

_HIDDEN = (Kind.MODEL, Kind.INITIAL, Kind.DEFINITION)
"""Kinds that no reader sees beside an equation: they may not hide a condition."""
_MEANT = {
    t: symbol("T") * symbol("tau"),
    symbol("N"): t / symbol("T"),
    symbol("f_aa"): symbol("f_a"),
    symbol("f_cc"): symbol("f_c"),
    symbol("rho"): symbol("f_c") * symbol("u_cum"),
}
"""What the model and the expansion speak of, where it may be defined, and as what."""
_GIVEN = DATA | {"tau", "omega", "m", "s_0", "p_s", "u_s", "sigma_s"}
"""What has a meaning already: data, and what rules speak of or integrate over."""


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
        law = law_of(relation) if kind is Kind.MODEL else None
        if law is not None and not falls(law):
            raise RuleError(f"missing premise: {law} is positive and smooth and decreases")
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
    if not name.is_Symbol and _solvable(relation):
        return
    if not name.is_Symbol or name.name in _GIVEN or value.has(name):
        raise RuleError(f"missing premise: {name} is a new name")
    if value != _MEANT.get(name, value):
        raise RuleError(f"missing premise: {name} is {_MEANT[name]}")
    rates = [sp.diff(value, f) * sp.Derivative(f, t) for f in fields(value)]
    change = inserted(sp.Add(*rates), premises).doit()
    varies = clocks(relation.rhs) or any(d.has(t) for d in value.atoms(sp.Derivative))
    if not clocks(name) and (varies or not is_zero(change)):
        raise RuleError(f"missing premise: {value} is constant")


def _solvable(relation: sp.Equality) -> bool:
    """Return whether an equation, or what tends to a limit by one, has a solution whatever the
    data and the other fields: of these it says nothing.

    It is linear in fields of one's own, or in names.  Either zero solves it, or one of them, of
    any sign, has a factor that is never zero, and the equation has it at no other time.
    """
    tends = isinstance(relation.lhs, sp.Limit)
    if tends and relation.lhs.args[1:3] != (t, sp.oo):
        return False
    whole = relation.lhs.args[0] - relation.rhs if tends else relation.lhs - relation.rhs
    fields = {f for f in functions(whole) if f.func not in FIELDS}
    rates = {d for d in whole.atoms(sp.Derivative) if d.expr in fields}
    free = () if functions(whole) or tends else whole.free_symbols
    names = {s for s in free if s.name not in _GIVEN | CLOCKS and s not in _MEANT}
    own = {
        part: sp.Dummy(real=True) for part in (*rates, *fields - {d.expr for d in rates}, *names)
    }
    flat = whole.xreplace(own)
    slopes = {part: sp.diff(flat, name) for part, name in own.items()}
    beside = any(flat.has(d.expr.func) for d in rates)  # the solution may not last
    if beside or any(slope.has(*own.values()) for slope in slopes.values()):
        return False
    heads = [getattr(part, "expr", part).func for part in own]
    rests = not any(part.is_positive for part in own)
    return (rests and flat.xreplace(dict.fromkeys(own.values(), sp.S.Zero)) == 0) or any(
        slope.is_nonzero
        and (part.is_Symbol or heads.count(getattr(part, "expr", part).func) == 1)
        and getattr(part, "expr", part).args in ((), (t,), (symbol("tau"),))
        and not part.is_nonnegative
        for part, slope in slopes.items()
    )


def assume(hypothesis: Hypothesis, name: str = "", remark: str = "") -> Judgement:
    """Return the judgement of a hypothesis."""
    return infer(Assume(hypothesis), name=name, remark=remark)


def defined(symbol: sp.Expr, value: sp.Expr, text: str = "", *steady: Judgement) -> Judgement:
    """Return the definition of a name; further premises say that what varies here does not."""
    relation = sp.Eq(symbol, value, evaluate=False)
    text = text or f"{symbol} by definition"
    return infer(Assume(Hypothesis(text, relation, kind=Kind.DEFINITION)), *steady)
