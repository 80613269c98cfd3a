"""Growth: wear without bound, and the limits of functions of it.

Key results
    Diverges         u >= c t + d with c > 0, and f > 0, give a + f u -> oo
    unbounded        du/dt = F(u, load) with F > 0 and a bounded load gives u -> oo
    AtInfinity       the limit of a function of u and bounded fields as u -> oo
    periodic_bound   a continuous, periodic load needs no bound
    intermittent     a rate that acts during a fraction d of every period adds d T R
    bounds           the relations that bound a field by constants
References
    Rudin, Principles of Mathematical Analysis, 1976, chapters 4 and 5.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import sympy as sp
from sympy.core.relational import Relational

from ..claims import Limit
from ..hypotheses import BOUNDED_LOAD, CONTINUOUS, LOAD, PERIODIC
from ..kernel import Conclusion, Judgement, Rule, RuleError
from ..memory import cache
from ..parts import nonnegative, positive
from ..reals import LAW, holds
from ..symbols import symbol, t
from ..zero import is_zero
from .proving import coefficients, continuity, continuous, facts_of, require
from .reading import (
    T,
    constant,
    equality,
    fields,
    growing,
    inequality,
    rate_law,
    require_hypothesis,
)
from .theorem import Theorem

U = symbol("U")


class Diverges(Theorem):
    """``u >= c t + d`` with constants c > 0 and d: ``a + f u -> oo`` for constants f > 0 and a.

    u is a field, or time itself.
    """

    expr: sp.Expr
    words = "By {0}, {expr} grows without bound."
    premise_names = ("the growth",)

    def prove(self, *premises: Judgement) -> Conclusion:
        growth = inequality(premises[0])
        u, bound = growth.greater, growth.lesser
        speed, slope = sp.diff(bound, t), sp.diff(self.expr, u)
        steady = (speed, sp.expand(bound - speed * t), slope, sp.expand(self.expr - slope * u))
        if fields(u) | {t} != {u, t} or not all(map(constant, steady)):
            raise RuleError(f"missing premise: {self.expr} is linear in a growing field")
        for factor in (speed, slope):
            require(positive(factor), *premises)
        return Conclusion(Limit(self.expr, sp.oo))


def bounds(field: sp.Expr, *premises: Judgement) -> tuple[sp.Basic, ...]:
    """Return relations that bound a field by two constants; RuleError if there are none."""
    orders = list(_orders(premises))
    for small, large in orders:
        if small == sp.Abs(field) != field and constant(large):
            return (sp.Le(small, large, evaluate=False),)
    lower = _lower_bounds(field, orders)
    upper = (large for small, large in orders if small == field and constant(large))
    found = *lower, *(sp.Le(field, large, evaluate=False) for large in upper)
    if not len(found) > len(lower) > 0:
        raise RuleError(f"missing premise: {field.func} is bounded")
    return found


def _orders(premises: tuple[Judgement, ...]) -> Iterator[tuple[sp.Expr, sp.Expr]]:
    """Yield the smaller and the larger side of each inequality in the facts."""
    for fact in facts_of(premises):
        for part in sp.And.make_args(fact):
            if isinstance(part, (sp.Ge, sp.Gt, sp.Le, sp.Lt)):
                yield part.lts, part.gts


def _lower_bounds(field: sp.Expr, orders: Iterable[tuple[sp.Expr, sp.Expr]]) -> list[sp.Basic]:
    found = (small for small, large in orders if large == field and constant(small))
    return [sp.Ge(field, small, evaluate=False) for small in found]


class PeriodicBound(Rule):
    """A claim under ``|U_a| <= U`` and a continuous load of period T holds without the bound.

    Such a load is bounded, so that U may be chosen: nothing else may be said of it.
    """

    words = "A continuous load of period T is bounded, so that {0} needs no bound of it."
    source = "extreme value theorem"
    premise_names = ("the claim",)

    def conclude(self, *premises: Judgement) -> Conclusion:
        (first,) = premises
        for needed in (BOUNDED_LOAD, PERIODIC, CONTINUOUS):
            require_hypothesis(needed, first)
        others = (h.relation for h in first.hypotheses if h != BOUNDED_LOAD)
        if any(relation.has(U) for relation in (first.relation, *others)):
            raise RuleError(f"missing premise: nothing else is said of {U}")
        return Conclusion(first.claim, discharges=(BOUNDED_LOAD,))


periodic_bound = PeriodicBound()


def _plain(moving: Iterable[sp.Expr]) -> dict[sp.Expr, sp.Symbol]:
    """Return a variable of any value for each field.

    Relations of the field at each time are dropped, as they need not hold for its limit points.
    """
    return {field: sp.Dummy(str(field.func), real=True) for field in moving}


def _require_positive(rate: sp.Expr, known: Iterable[sp.Basic], *premises: Judgement) -> None:
    """Refuse a rate unless it is positive and continuous for all values of its fields.

    The fields are variables with the relations ``known``, beside the hypotheses on constants.
    """
    plain = _plain(fields(rate))
    of_data = [h.relation for p in premises for h in p.hypotheses if constant(h.relation)]
    given = frozenset(r.xreplace(plain) for r in (*known, *of_data))
    flat = rate.xreplace(plain)
    goals = [positive(flat), *continuity(flat, set(plain.values()))]
    if not constant(flat) or not all(holds(goal, given) for goal in goals):
        raise RuleError(f"missing premise: {rate} is positive and continuous")


class Unbounded(Theorem):
    """``du/dt = F(u, a)`` with F positive and continuous, and bounded fields a: ``u -> oo``.

    If u, which increases, were bounded, u and a would stay in a compact set, on which F has a
    positive minimum.  So F must be positive at the bounds of a and at a lower bound of u, too.
    """

    words = (
        "The rate in {0} is positive and continuous, and all else in it is bounded: if the "
        "solution were bounded, its rate would be bounded away from zero."
    )
    source = "extreme value theorem"
    premise_names = ("the rate",)

    def prove(self, *premises: Judgement) -> Conclusion:
        law, *facts = premises
        u, function = rate_law(law)
        closed = [r for f in fields(function) - {u} for r in bounds(f, *premises)]
        closed += _lower_bounds(u, _orders(premises))
        always = [f for f in facts if all(constant(h.relation) for h in f.hypotheses)]
        anywhere = [fact for fact in facts_of(always) if fields(fact) <= {u}]
        _require_positive(function, (*closed, *anywhere), *premises)
        return Conclusion(Limit(u, sp.oo))


unbounded = Unbounded()


def expanded(expr: sp.Expr, small: sp.Symbol) -> tuple[int, sp.Expr]:
    """Return n and an expression N(small), made of functions that are smooth where they have a
    value, so that ``expr = small**-n N``; infinite parts of expr are powers of small.

    >>> z = sp.Symbol("z", positive=True)
    >>> expanded(sp.sqrt(1 + 4 / z**2), z)
    (1, sqrt(z**2 + 4))
    """
    if not expr.has(small):
        return 0, expr
    if expr == small:
        return -1, sp.S.One
    if isinstance(expr, (sp.Add, sp.Mul)):
        parts = [expanded(part, small) for part in expr.args]
        if isinstance(expr, sp.Mul):
            return sum(n for n, _ in parts), sp.Mul(*(e for _, e in parts))
        order = max(n for n, _ in parts)
        return order, sp.expand(sp.Add(*(small ** (order - n) * e for n, e in parts)))
    if isinstance(expr, sp.Pow) and expr.exp.is_Rational:
        order, inside = expanded(sp.expand(expr.base), small)
        if (order * expr.exp).is_Integer:
            return int(order * expr.exp), inside**expr.exp
    if isinstance(expr, (sp.exp, sp.tanh, LAW)):
        order, inside = expanded(sp.expand(expr.args[0]), small)
        if order <= 0:
            return 0, expr.func(small**-order * inside)
    raise RuleError(f"missing premise: {expr} is a smooth function at infinity")


class AtInfinity(Theorem):
    """The limit of a function of u and bounded fields, where ``u -> oo``.

    The function is written as ``z^-n N(z, a)`` with ``z = 1/u``, or another ``small`` function of
    u that tends to 0.  N is smooth at z = 0, so that Taylor's remainder is uniform in bounded a:
    the first n coefficients must vanish, and the next is the limit, which is free of a.
    """

    claim: sp.Equality
    small: sp.Expr
    words = "By {0}, {small} tends to zero: expand in it, uniformly in bounded fields."
    source = "Taylor's theorem"
    premise_names = ("the growth",)

    def prove(self, *premises: Judgement) -> Conclusion:
        u, inside = growing(premises[0]), self.claim.lhs.args[0]
        z = sp.Dummy("z", positive=True)
        deep = self._deep(u, z, premises)
        plain = _plain(fields(inside) - {u})
        if not constant(inside.xreplace({**plain, u: z})):
            raise RuleError(f"missing premise: {inside} depends on {u} and bounded fields alone")
        for field in plain:
            bounds(field, *premises)
        flat = inside.xreplace(plain).replace(sp.exp, lambda x: sp.exp(sp.expand(x.subs(u, deep))))
        order, smooth = expanded(flat.subs(u, deep), z)
        bent = order > 1 and smooth.has(LAW)
        if bent or not continuous(smooth, {z: sp.S.Zero}, *premises):
            raise RuleError(f"missing premise: {inside} is smooth at infinity")
        for n in range(max(order, 0)):
            if not is_zero(taylor(smooth, z, n)):
                raise RuleError(f"missing premise: {inside} is bounded")
        value = sp.powsimp(taylor(smooth, z, order)) if order >= 0 else sp.S.Zero
        if value.has(*plain.values()) or not is_zero(value - self.claim.rhs):
            raise RuleError(f"missing premise: the limit is {value}")
        return Conclusion(Limit(inside, self.claim.rhs))

    def _deep(self, u: sp.Expr, z: sp.Symbol, premises: tuple[Judgement, ...]) -> sp.Expr:
        """Return u as a function of z, for ``z = 1/u`` and for ``z = exp(-c u)``."""
        if self.small == 1 / u:
            return 1 / z
        inside = self.small.args[0] if isinstance(self.small, sp.exp) else u**2
        fall = -sp.cancel(inside / u)
        if not constant(fall):
            raise RuleError(f"missing premise: {self.small} -> 0 as {u} -> oo")
        require(positive(fall), *premises)
        return -sp.log(z) / fall


def taylor(expr: sp.Expr, z: sp.Symbol, n: int) -> sp.Expr:
    """Return the coefficient of z^n in the Taylor expansion at z = 0."""
    return (_derivative(expr, z, n) / sp.factorial(n)).subs(z, 0)


@cache
def _derivative(expr: sp.Expr, z: sp.Symbol, n: int) -> sp.Expr:
    return sp.diff(_derivative(expr, z, n - 1), z) if n else expr


class Intermittent(Theorem):
    """A rate ``F(u, load)`` in contact, else 0, where contact depends on the load alone.

    Premises: the rate, piecewise; the definition of d > 0, the fraction of the period in contact;
    a lower bound of u; a periodic, bounded load.  F is positive and continuous, so that
    u grows without bound, and tends to R as u -> oo: ``u(t + T) - u(t) -> d T R``.
    """

    words = "The limit of the rate in {0} holds during a fixed part of every period, by {others}."
    source = "mean value theorem on the part of the period in contact"
    premise_names = ("the rate", "the fraction in contact", "the least wear")

    def prove(self, *premises: Judgement) -> Conclusion:
        law, part, start, *_ = premises
        (u, function), meaning, least = rate_law(law), equality(part), inequality(start)
        require_hypothesis(PERIODIC.relation, *premises)
        if least.greater != u or not constant(least.lesser):
            raise RuleError(f"missing premise: {u} stays above a constant")
        (on, contact), *rest = sp.piecewise_fold(function).args
        if not isinstance(contact, Relational) or [e for e, _ in rest] != [0]:
            raise RuleError("missing premise: a rate that is 0 out of contact")
        room = sp.expand(contact.gts - contact.lts)
        parts = coefficients(room, LOAD) or (sp.S.Zero, t)
        if (
            not constant(sp.Tuple(*parts))
            or parts[0] == 0
            or not isinstance(contact, (sp.Le, sp.Ge))
        ):
            raise RuleError("missing premise: contact depends on the load alone")
        shares = (
            sp.Integral(sp.Piecewise((1, c), (0, True)), (t, 0, T)) / T
            for c in meaning.rhs.atoms(sp.Le, sp.Ge)
            if holds(positive(sp.cancel((c.gts - c.lts) / room)))
        )
        if meaning.rhs not in shares or not meaning.lhs.is_positive:
            raise RuleError("missing premise: the fraction of the period in contact")
        closed = [r for f in {LOAD, *fields(on)} - {u} for r in bounds(f, *premises)]
        _require_positive(on, (*closed, nonnegative(u - least.lesser)), *premises)
        z = sp.Dummy("z", positive=True)
        plain = _plain(fields(on) - {u})
        order, smooth = expanded(on.xreplace(plain).subs(u, 1 / z), z)
        value = smooth.subs(z, 0)
        if order or not continuous(smooth, {z: sp.S.Zero}, law) or value.atoms(sp.Dummy):
            raise RuleError("missing premise: the limit of the rate in contact")
        return Conclusion(Limit(u.subs(t, t + T) - u, meaning.lhs * T * value))


intermittent = Intermittent()
