"""Limits in time: from limits to limits.

Key results
    forever, later   the limit for t -> oo; an expression one period later
    one_period_later a claim about every time, one period later
    vanishes         |e| <= B/s and s -> oo give e -> 0
    Passes           limits pass through continuous functions and through t -> t + T
    accumulates      du/dt -> R gives u(t + T) - u(t) -> R T
References
    Rudin, Principles of Mathematical Analysis, 1976, chapters 4 and 5.
"""

from __future__ import annotations

import sympy as sp
from sympy.core.function import AppliedUndef

from ..claims import Asymptotic, Limit
from ..hypotheses import LOAD
from ..kernel import Conclusion, Judgement, Rule, RuleError
from ..parts import bound
from ..reals import LAW
from ..symbols import t
from ..zero import is_zero
from .algebra import inserted
from .proving import continuous
from .reading import (
    T,
    between,
    clocks,
    constant,
    exchanged,
    field_of_rate,
    fields,
    growing,
    limit_in_time,
)
from .theorem import Theorem


def forever(expr: sp.Expr) -> sp.Limit:
    """Return the limit of ``expr`` for t -> oo, unevaluated."""
    return sp.Limit(expr, t, sp.oo)


def later(expr: sp.Basic) -> sp.Basic:
    """Return ``expr`` one period later.

    >>> from derive.symbols import symbol
    >>> later(symbol("u_c")) == symbol("u_c").subs(t, t + T)
    True
    """
    moving = {f: f.subs(t, t + T) for f in expr.atoms(AppliedUndef) if f.has(t)}
    return expr.xreplace(moving)


class OnePeriodLater(Rule):
    """A claim that holds at every time holds one period later."""

    words = "One period later, {0}."
    premise_names = ("the claim",)

    def conclude(self, *premises: Judgement) -> Conclusion:
        claim = premises[0].claim
        if isinstance(claim, Asymptotic) or not _at_one_time(claim.relation):
            raise RuleError(f"missing premise: {claim.relation} is about fields at one time")
        return Conclusion(claim.map(later))


one_period_later = OnePeriodLater()


def _at_one_time(expr: sp.Basic) -> bool:
    """Return whether an expression is about fields at one time, so that it can be shifted."""
    nodes = (node for node in sp.preorder_traversal(expr) if not isinstance(node, sp.Derivative))
    return not clocks(expr) and not any(t in bound(node) for node in nodes)


class Vanishes(Theorem):
    """``-B/s <= e <= B/s`` with constant B, and ``s -> oo``: ``e -> 0``."""

    words = "The bounds in {0} tend to zero, by {others}."
    source = "squeeze theorem"
    premise_names = ("the bounds", "the growth")

    def prove(self, *premises: Judgement) -> Conclusion:
        squeeze, divergence = premises
        (low, middle, high), size = between(squeeze), growing(divergence)
        for side in (low, high):
            if not constant(sp.cancel(side * size)):
                raise RuleError(f"missing premise: {side} is a constant over {size}")
        return Conclusion(Limit(middle, sp.S.Zero))


vanishes = Vanishes()


class Passes(Theorem):
    """Limits pass through a function that is continuous at them, and through one period.

    The premises give the limits of some expressions, and equalities; the claim is the limit of a
    combination of those expressions, now or one period later.  Of ``s -> oo`` it uses 1/s -> 0.
    """

    claim: sp.Equality
    words = (
        "Let time tend to infinity in {0}[, with {others}]: limits pass through functions that are "
        "continuous at them."
    )

    def prove(self, *premises: Judgement) -> Conclusion:
        whole = self.claim.lhs.args[0]
        ends, meaning = dict[sp.Symbol, sp.Expr](), dict[sp.Symbol, sp.Expr]()
        for given in (limit_in_time(p) for p in premises if isinstance(p.claim, Limit)):
            part, end = given.expr, given.value
            if given.value == sp.oo:
                part, end = 1 / part, sp.S.Zero
            elif given.value.is_finite is False:
                raise RuleError(f"missing premise: the limit of {given.expr} is finite")
            for quantity in (part, later(part)) if _at_one_time(part) else (part,):
                stand_in = sp.Dummy(real=True)
                ends[stand_in], meaning[stand_in] = end, quantity
        expr = rewritten = inserted(whole, premises)
        for stand_in, quantity in meaning.items():
            expr = in_terms_of(expr, quantity, stand_in)
        back = expr
        for stand_in, quantity in reversed(meaning.items()):
            back = exchanged(back, stand_in, quantity)
        if not constant(expr) or not is_zero(back - rewritten):
            raise RuleError(f"missing premise: the limit of all that varies in {whole}")
        if not continuous(expr, ends, *premises):
            raise RuleError(f"missing premise: {whole} is continuous at {(*ends.values(),)}")
        if not is_zero(expr.subs(ends) - self.claim.rhs):
            raise RuleError(f"missing premise: the limit of {whole} is {expr.subs(ends)}")
        return Conclusion(Limit(whole, self.claim.rhs), gives=(*meaning.values(),))


def in_terms_of(expr: sp.Expr, quantity: sp.Expr, name: sp.Symbol) -> sp.Expr:
    """Write ``expr`` with ``name`` for ``quantity``, by eliminating the load or a field."""
    expr = exchanged(expr, quantity, name)
    for field in sorted(fields(quantity), key=lambda f: (f.func != LOAD.func, str(f))):
        slope = sp.diff(quantity, field)
        if slope != 0 and expr.has(field) and not slope.has(field):
            solved = field + (name - quantity) / slope
            return _cancelled(expr.subs(field, sp.cancel(solved)))
    return expr


def _cancelled(expr: sp.Expr) -> sp.Expr:
    """Cancel common factors, inside the arguments of functions too."""
    field = isinstance(expr, AppliedUndef) and not isinstance(expr, LAW)
    if not expr.args or field or isinstance(expr, (sp.Derivative, sp.Subs)):
        return expr
    inner = expr.func(*map(_cancelled, expr.args))
    return inner if isinstance(inner, sp.Function) else sp.cancel(inner)


class Accumulates(Theorem):
    """``du/dt -> R``, finite: the wear of one period tends to ``R T``."""

    words = "Integrate the limit {0} over one period."
    source = "mean value theorem on [t, t + T]"
    premise_names = ("the limit of the rate",)

    def prove(self, *premises: Judgement) -> Conclusion:
        given = limit_in_time(premises[0])
        u = field_of_rate(given.expr)
        if not constant(given.value) or given.value.is_finite is False:
            raise RuleError(f"missing premise: the limit of {given.expr} is finite")
        return Conclusion(Limit(u.subs(t, t + T) - u, given.value * T))


accumulates = Accumulates()
