"""Assumption: a hypothesis is a judgement that rests on itself."""

from __future__ import annotations

import operator
import re
from collections.abc import Callable

import sympy as sp

from ..claims import Equality, HasValue, Limit, Oscillation, Property, Term, claim_of, landau_o
from ..hypotheses import LOAD, Hypothesis, Kind
from ..kernel import Conclusion, Judgement, Rule, RuleError, domain, infer, listed, plain
from ..language import defined_by
from ..note.model import START, WORDS, law_of
from ..parts import bound, nonzero
from ..reals import holds
from ..symbols import DATA, EXTREMES, rate, symbol, t
from ..zero import is_zero
from .algebra import inserted
from .averages import EXPANSION, require_expansion
from .limits import later
from .proving import (
    coefficients,
    in_words,
    is_contact_law,
    lasting_facts,
    lasts,
    smooth,
    undefined,
)
from .reading import at_an_instant, clocks, constant, fields, functions

_HIDDEN = (Kind.MODEL, Kind.INITIAL, Kind.DEFINITION)
"""Kinds that are not shown beside an equation, and so must not hide a condition."""
_MEANT = {
    t: symbol("T") * symbol("tau"),
    symbol("N"): t / symbol("T"),
    symbol("f_aa"): symbol("f_a"),
    symbol("f_cc"): symbol("f_c"),
    symbol("rho"): symbol("f_c") * symbol("u_cum"),
    symbol("U_mean"): sp.Integral(LOAD, (t, 0, symbol("T"))) / symbol("T"),
}
"""Names of the model, its load and the expansion with the only definitions that they may have."""
RESPONSE = sp.Eq(later(rate("u_inf")), rate("u_inf"))
"""What (12) says of the asymptotic response in wear: all that this name of the vocabulary means."""
_GIVEN = DATA | EXTREMES | {"tau", "omega", "m", "s_0", "p_s", "u_s", "sigma_s"}
"""Names that have a meaning already: data, and names that rules use."""
_AT_EVERY_TIME = ((t,), (symbol("tau"),))


class Assume(Rule):
    """``H |- H``."""

    hypothesis: Hypothesis

    def conclude(self, *premises: Judgement) -> Conclusion:
        given, relation, kind = self.hypothesis, self.hypothesis.relation, self.hypothesis.kind
        named = kind is Kind.DEFINITION
        if (
            relation in (sp.true, sp.false)
            or relation.has(landau_o)
            or (not named and (_of_an_instant(relation) or premises))
        ):
            raise RuleError(f"{given.text}: cannot be assumed")
        law = law_of(relation) if kind is Kind.MODEL else None
        known = {Kind.MODEL: WORDS, Kind.INITIAL: START}.get(kind, (relation,))
        if law is None and relation not in known:
            raise RuleError(f"{given.text}: no equation of the model")
        if law is not None and not is_contact_law(law):
            raise RuleError(f"missing premise: {law} is positive and smooth and decreases")
        claim = claim_of(relation)
        if not named and relation.has(sp.Limit) and not isinstance(claim, Limit):
            raise RuleError(f"missing premise: a value of the limit in {given.text}")
        equation = isinstance(claim, (Equality, Limit)) or relation == EXPANSION.relation
        if kind in _HIDDEN and not equation:
            raise RuleError(f"{given.text}: no equation")
        supposes = named and not isinstance(claim, Property) and relation != RESPONSE
        adds = _supposed(claim.relation, premises) if supposes else ()
        return Conclusion(claim, adds=(given, *adds))

    def sentence(self, *labels: str, write: Callable[[sp.Basic], str] = plain) -> str:
        opening = "" if self.hypothesis.kind is Kind.DEFINITION else "Hypothesis: "
        return f"{opening}{self.hypothesis.text}."


def _of_an_instant(relation: sp.Basic) -> bool:
    """Return whether a part of a relation is of time alone, so that it does not hold at every
    time."""
    parts = sp.And.make_args(at_an_instant(relation))
    return any(clocks(part) and all(map(constant, functions(part))) for part in parts)


def _supposed(relation: sp.Equality, premises: tuple[Judgement, ...]) -> tuple[Hypothesis, ...]:
    """Return the conditions of a definition that the premises do not prove.

    The defined expression must have a value, of the sign of its name.  Then the definition itself
    restricts no other quantity, and need not be shown.  RuleError if no relation expresses the
    condition, or if the name is not new.
    """
    _require_own_terms(relation)
    name, value = relation.args
    slope: sp.Expr = sp.S.One
    if not name.is_Symbol:
        name, value, slope = _solved(relation) or (name, value, slope)
    implicit, sign = None if name.is_Symbol else _solvable(relation), domain(name)
    _require_unsaid(
        {name} if name.is_Symbol else _new_fields(relation, relation), relation, premises
    )
    if implicit is None:
        _require_name(name, value, premises)
    new = {name: sp.Dummy(**name.assumptions0)}
    whole = implicit or sp.Tuple(value, 1 / slope, *(side.xreplace(new) for side in relation.args))
    terms = {term: sp.Dummy() for term in whole.atoms(Term)}
    for term in terms:
        require_expansion(term, *premises)
        if isinstance(term, Oscillation) and name.args != (symbol("tau"),):
            raise RuleError(f"missing premise: {name} is a name for a function of tau")
    facts = lasting_facts(premises)
    goals = [*undefined(whole.xreplace(terms), *premises, always=True)]
    if implicit is None and sign is not None:
        known = inserted(value, tuple(filter(lasts, premises)))
        if not holds(sign.func(known, 0, evaluate=False), facts):
            goals.append(sign.func(value, 0, evaluate=False))
    for goal in goals:
        unsaid = goal == sp.false or goal.has(HasValue, sp.Dummy) or _of_an_instant(goal)
        if unsaid or _new_fields(goal, relation):
            raise RuleError(f"missing premise: {in_words(goal)}")
    return tuple(map(Hypothesis, goals))


def _require_own_terms(relation: sp.Equality) -> None:
    """Refuse to define c_n or w_n as anything but the term of the expansion with this name."""
    left, right = relation.args
    for name in defined_by(relation):
        own = str(left.func if left.args else left) == name == getattr(right, "name", "")
        if re.fullmatch("[cw]_[1-9]", name) and not (own and isinstance(right, Term)):
            raise RuleError(f"missing premise: {name} is a term of the expansion")


def _require_unsaid(
    names: set[sp.Expr], relation: sp.Equality, premises: tuple[Judgement, ...]
) -> None:
    """Refuse to define names of which premises speak: these would prove what they suppose."""
    known = Hypothesis(relation, Kind.DEFINITION)
    for premise in premises:
        said = (premise.relation, *(h.relation for h in premise.hypotheses))
        bearers = {name for expr in said for name in (*expr.free_symbols, *functions(expr))}
        if names & bearers and known not in premise.hypotheses:
            raise RuleError(f"missing premise: {listed(map(str, names))} is a new name")


def _require_name(name: sp.Expr, value: sp.Expr, premises: tuple[Judgement, ...]) -> None:
    """Refuse to define a given name, or a constant by an expression that varies."""
    now = at_an_instant(value)
    if not name.is_Symbol or name.name in _GIVEN or now.has(name):
        raise RuleError(f"missing premise: {name} is a new name")
    if value != _MEANT.get(name, value):
        raise RuleError(f"missing premise: {name} is {_MEANT[name]}")
    expr = inserted(now, tuple(filter(lasts, premises)))
    rates = {field: sp.Derivative(field, t) for field in fields(expr)}
    slopes = sp.Tuple(*(sp.diff(expr, field) for field in rates))
    change = inserted(sp.Add(*map(operator.mul, slopes, rates.values())), premises)
    varies = clocks(expr) or any(d.has(t) for d in expr.atoms(sp.Derivative))
    unknown = [*undefined(sp.Tuple(*rates.values()), *premises)]
    unknown += undefined(slopes, *premises, always=True)
    jumps = bool(rates) and not smooth(expr, *rates)
    if not clocks(name) and (varies or unknown or jumps or not is_zero(change)):
        raise RuleError(f"missing premise: {now} is constant")


def _solved(relation: sp.Equality) -> tuple[sp.Symbol, sp.Expr, sp.Expr] | None:
    """Return the only new name in an equation between constants that is linear in it, the value
    that solves it, and the factor of the name; None for any other equation."""
    whole = relation.lhs - relation.rhs
    new = {s for s in whole.free_symbols if s.name not in _GIVEN and s not in _MEANT}
    if len(new) != 1 or not constant(whole) or functions(whole):
        return None
    (name,) = new
    parts = coefficients(whole, name)
    return (name, -parts[1] / parts[0], parts[0]) if parts else None


def _solvable(relation: sp.Equality) -> sp.Tuple | None:
    """Return the sides of an equation that determines one new field for all data and others, else
    None.

    The equation must be linear in the field, which is of any sign and occurs in it at one time,
    with a factor that is never zero.  In what is returned a variable stands for it.
    """
    sides, unknowns = sp.Tuple(*relation.args), _new_fields(relation, relation)
    if len(unknowns) != 1 or _is_bound(sides, relation):
        return None
    (unknown,) = unknowns
    parts = coefficients(relation.lhs - relation.rhs, unknown)
    if not parts or not holds(nonzero(parts[0])):
        return None
    free = unknown.args in _AT_EVERY_TIME and not unknown.is_nonnegative
    return sides.xreplace({unknown: sp.Dummy(real=True)}) if free else None


def _new_fields(expr: sp.Basic, relation: sp.Equality) -> set[sp.Expr]:
    """Return the fields in an expression to which a definition gives a meaning."""
    return {f for f in functions(expr) if f.func.__name__ in defined_by(relation)}


def _is_bound(sides: sp.Tuple, relation: sp.Equality) -> bool:
    """Return whether a new field is in an integral or the like: one that need not exist."""
    return any(_new_fields(e, relation) for e in sp.preorder_traversal(sides) if bound(e))


def is_hypothesis(judgement: Judgement) -> bool:
    """Return whether a judgement is assumed, not inferred."""
    return isinstance(judgement.rule, Assume)


def assume(hypothesis: Hypothesis, name: str = "", remark: str = "") -> Judgement:
    """Return the judgement of a hypothesis."""
    return infer(Assume(hypothesis), name=name, remark=remark)


def define(relation: sp.Basic, *steady: Judgement) -> Judgement:
    """Return the definition of the new name in a relation.

    Premises prove that the value exists, has the sign of the name and, for a constant, does not
    vary.
    """
    return infer(Assume(Hypothesis(relation, Kind.DEFINITION)), *steady)


def defined(symbol: sp.Expr, value: sp.Expr, *steady: Judgement) -> Judgement:
    """Return the definition of a name as an expression, with premises as ``define``."""
    return define(sp.Eq(symbol, value, evaluate=False), *steady)
