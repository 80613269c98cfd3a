"""Readers: the parts of a claim in the form that a theorem needs, or a refusal.

Key results
    equality, inequality, between               sides of relations
    rate_law, initial_value, limit_in_time      parts of claims about time
    one_integral                                the only integral in an expression
    constant                                    whether an expression is independent of time
"""

from __future__ import annotations

from collections import Counter
from typing import TypeVar

import sympy as sp
from sympy.core.function import AppliedUndef

from ..claims import Claim, Conjunction, Drift, Equality, FirstZero, Inequality, Limit, Term
from ..hypotheses import Hypothesis
from ..kernel import Judgement, RuleError, listed
from ..memory import cache
from ..parts import bound, certain, needs
from ..reals import LAW, holds
from ..symbols import CLOCKS, symbol, t

C = TypeVar("C", bound=Claim)
T = symbol("T")


def _read(judgement: Judgement, kind: type[C]) -> C:
    if not isinstance(judgement.claim, kind):
        raise RuleError(f"missing premise: {judgement.relation} is no {kind.__name__.lower()}")
    return judgement.claim


def equality(judgement: Judgement) -> Equality:
    """Return the parts of an equality."""
    return _read(judgement, Equality)


def inequality(judgement: Judgement) -> Inequality:
    """Return the parts of an inequality."""
    return _read(judgement, Inequality)


def between(judgement: Judgement) -> tuple[sp.Expr, sp.Expr, sp.Expr]:
    """Return low, middle and high of ``low <= middle <= high``."""
    both = _read(judgement, Conjunction)
    for below, above in ((both.first, both.second), (both.second, both.first)):
        if below.greater == above.lesser:
            return below.lesser, below.greater, above.greater
    raise RuleError(f"missing premise: {judgement.relation} encloses an expression")


def limit_in_time(judgement: Judgement) -> Limit:
    """Return the parts of a limit for t -> oo; there are no others."""
    return _read(judgement, Limit)


def growing(judgement: Judgement) -> sp.Expr:
    """Return the quantity that tends to infinity in time."""
    found = limit_in_time(judgement)
    if found.value != sp.oo:
        raise RuleError(f"missing premise: {found.expr} -> oo")
    return found.expr


def field_of_rate(expr: sp.Expr) -> sp.Expr:
    """Return the field whose first derivative with respect to time an expression is."""
    rate = isinstance(expr, sp.Derivative) and expr.variables == (t,)
    if not rate or not isinstance(expr.expr, AppliedUndef) or expr.expr.args != (t,):
        raise RuleError(f"missing premise: {expr} is no rate")
    return expr.expr


def rate_law(judgement: Judgement) -> tuple[sp.Expr, sp.Expr]:
    """Return u and Q of ``du/dt = Q``, where Q has no rates."""
    law = equality(judgement)
    if law.rhs.has(sp.Derivative):
        raise RuleError(f"missing premise: {judgement.relation} is not solved for the rate")
    return field_of_rate(law.lhs), law.rhs


def initial_value(judgement: Judgement, field: sp.Expr) -> sp.Expr:
    """Return ``field(0)``."""
    start = equality(judgement)
    if start.lhs != field.subs(t, 0):
        raise RuleError(f"missing premise: the value of {field.func} at t = 0")
    return start.rhs


def one_integral(expr: sp.Expr) -> sp.Integral:
    """Return the only integral in an expression."""
    found: set[sp.Integral] = expr.atoms(sp.Integral)
    if len(found) != 1:
        raise RuleError(f"missing premise: {expr} has one integral")
    return found.pop()


def fields(expr: sp.Basic) -> set[sp.Expr]:
    """Return the functions of time in an expression."""
    return {f for f in functions(expr) if f.has(t)}


def functions(expr: sp.Basic) -> set[sp.Expr]:
    """Return the unspecified functions in an expression, also at one time, but the contact law."""
    return {f for f in expr.atoms(AppliedUndef) if not isinstance(f, LAW)}


@cache
def constant(expr: sp.Basic) -> bool:
    """Return whether an expression is independent of time, without integrals and limits."""
    moving = expr.has(t) or clocks(expr)
    return not moving and not expr.atoms(sp.Derivative, sp.Integral, sp.Limit) - _slopes(expr)


@cache
def clocks(expr: sp.Basic) -> frozenset[sp.Basic]:
    """Return the symbols in an expression that vary in time, and time itself outside of fields."""
    if CLOCKS.isdisjoint(s.name for s in expr.free_symbols):
        return frozenset()
    parts = functions(expr) | expr.atoms(Drift)
    still = {part: sp.Dummy() for part in parts if not _by_clock(part)}
    free = expr.xreplace(still).free_symbols
    return frozenset(s for s in free if s.name in CLOCKS and not isinstance(s, sp.Dummy))


def _by_clock(expr: sp.Expr) -> bool:
    """Return whether an expression varies with another clock than time; a drift does not."""
    named = {s.name for s in expr.free_symbols - {t} if not isinstance(s, sp.Dummy)}
    return not isinstance(expr, Drift) and not CLOCKS.isdisjoint(named)


def at_an_instant(expr: sp.Basic) -> sp.Basic:
    """Return an expression with a constant for each integral and limit in it that no clock moves,
    and each drift."""
    found = expr.atoms(sp.Integral, sp.Limit)
    moving = {e for e in found if not CLOCKS.isdisjoint(s.name for s in e.free_symbols)}
    return expr.xreplace({e: sp.Dummy() for e in found - moving | expr.atoms(Drift)})


def replaced(expr: sp.Basic, old: sp.Expr, new: sp.Expr, always: bool = True) -> sp.Basic:
    """Return an expression with a part replaced by another that is equal: ``always``, or wherever
    rates have a value.

    RuleError if the part is in the scope of a bound variable that occurs in one of them, or inside
    a derivative with respect to a datum, for which the equality need not hold; or, unless it always
    holds, inside a rate or a first zero.
    """
    binders = [node for node in sp.preorder_traversal(expr) if bound(node) and node != old]
    touched = [node for node in binders if node.has(old) or exchanged(node, old, new) != node]
    if not always and any(isinstance(node, (sp.Derivative, FirstZero, Term)) for node in touched):
        raise RuleError(f"missing premise: {old} = {new} at every time")
    taken = {v for node in touched for v in bound(node)}
    if old not in taken and not (clocks(old) | clocks(new)) - {t}:
        taken -= {t}
    of_data = any(isinstance(node, sp.Derivative) and bound(node) != {t} for node in touched)
    if of_data or taken & (old.free_symbols | new.free_symbols):
        raise RuleError(f"missing premise: {old} = {new} for every {sp.Tuple(*taken)}")
    return exchanged(expr, old, new)


def exchanged(expr: sp.Basic, old: sp.Expr, new: sp.Expr) -> sp.Basic:
    """Return an expression with another in all places of a part; of a sum or product, the part may
    be some of its terms.  What is put in is left as it is.

    SymPy's ``subs`` is not used, as it does arithmetic with powers, for instance ``exp(3)`` in
    ``2**x``, that is wrong.

    >>> a, b, c = sp.symbols("a b c", real=True)
    >>> exchanged(a * b * c + sp.exp(a + b), a * b, c), exchanged(2**a, sp.exp(a), b)
    (c**2 + exp(a + b), 2**a)
    """
    if expr == old:
        return new
    found, others = tuple[sp.Basic, ...](), expr.args
    if isinstance(expr, (sp.Add, sp.Mul)) and isinstance(old, expr.func):
        rest = Counter(expr.args)
        rest.subtract(old.args)
        if min(rest.values()) >= 0:
            found, others = (new,), tuple(rest.elements())
    parts = *found, *(exchanged(part, old, new) for part in others)
    return _rebuilt(expr, parts) if parts != expr.args else expr


def _rebuilt(expr: sp.Basic, parts: tuple[sp.Basic, ...]) -> sp.Basic:
    """Return an expression with other parts, which has a value where it needs one.

    RuleError if SymPy writes a root of a product as roots of its factors that need not exist.
    """
    whole = expr.func(*parts)
    if isinstance(expr, sp.Pow) and not parts[1].is_Integer and whole.args != parts:
        needed = frozenset(needs(sp.Pow(*parts, evaluate=False)))
        goals = {goal for part in certain(whole) for goal in needs(part)}
        goals -= {goal for known in parts for part in certain(known) for goal in needs(part)}
        if not all(holds(goal, needed) for goal in goals):
            raise RuleError(f"missing premise: {listed(map(str, goals))}, as a part of {whole}")
    return whole


def _slopes(expr: sp.Expr) -> set[sp.Basic]:
    return {d for d in expr.atoms(sp.Derivative) if isinstance(d.expr, LAW)}


def require_hypothesis(needed: sp.Basic | Hypothesis, *premises: Judgement) -> None:
    """Raise RuleError unless premises have a hypothesis, or one with this relation."""
    known = {h for premise in premises for h in premise.hypotheses}
    if needed not in known | {h.relation for h in known}:
        raise RuleError(f"missing premise: {getattr(needed, 'text', needed)}")
