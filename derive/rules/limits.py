"""Limits in time: from bounds to limits, and from limits to limits.

Key results
    forever, later   the limit for t -> oo; an expression one period later
    one_period_later what holds at every time holds one period later
    Diverges         u >= c t + d with c > 0, and f > 0, give a + f u -> oo
    unbounded        du/dt = F(u, load) with F > 0 and a bounded load gives u -> oo
    AtInfinity       what a function of u and bounded fields tends to as u -> oo
    vanishes         |e| <= B/s and s -> oo give e -> 0
    Passes           limits pass through continuous functions and through t -> t + T
    accumulates      du/dt -> R gives u(t + T) - u(t) -> R T
    intermittent     a rate that is on during a fraction d of every period adds d T R
References
    Rudin, Principles of Mathematical Analysis, 1976, chapters 4 and 5.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.core.relational import Relational

from ..claims import Equality, Limit
from ..kernel import Conclusion, Judgement, Rule, RuleError
from ..language import bound
from ..symbols import t
from ..zero import is_zero
from .proving import LAW, continuity, continuous, facts_of, holds, require, require_defined
from .reading import (
    CONTINUOUS,
    LOAD,
    PERIODIC,
    T,
    between,
    clocks,
    constant,
    equality,
    field_of_rate,
    fields,
    growing,
    inequality,
    limit_in_time,
    rate_law,
    require_constants,
    require_hypothesis,
)


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


def in_time(expr: sp.Expr, value: sp.Expr) -> Limit:
    """Return the claim of a limit for t -> oo."""
    return Limit(expr, t, sp.oo, value)


@dataclass(frozen=True)
class OnePeriodLater(Rule):
    """What holds at every time holds one period later."""

    words = "One period later, {0}."
    asks = ("the claim",)

    def conclude(self, *premises: Judgement) -> Conclusion:
        claim = premises[0].claim
        if not _at_one_time(claim.relation):
            raise RuleError(f"missing premise: {claim.relation} is about fields at one time")
        return Conclusion(claim.map(later))


one_period_later = OnePeriodLater()


def _at_one_time(expr: sp.Basic) -> bool:
    """Return whether an expression is about fields at one time, which may come later."""
    nodes = (node for node in sp.preorder_traversal(expr) if not isinstance(node, sp.Derivative))
    return not clocks(expr) and not any(t in bound(node) for node in nodes)


@dataclass(frozen=True)
class Diverges(Rule):
    """``u >= c t + d`` with constants c > 0 and d: ``a + f u -> oo`` for constants f > 0 and a."""

    expr: sp.Expr
    words = "By {0}, the wear grows without bound, and with it {expr}."
    asks = ("the growth",)

    def conclude(self, *premises: Judgement) -> Conclusion:
        growth = inequality(premises[0])
        u, bound = growth.greater, growth.lesser
        speed, slope = sp.diff(bound, t), sp.diff(self.expr, u)
        steady = (speed, sp.expand(bound - speed * t), slope, sp.expand(self.expr - slope * u))
        if fields(u) != {u} or not all(constant(e) and not fields(e) for e in steady):
            raise RuleError(f"missing premise: {self.expr} is linear in what grows")
        require_defined(self.expr, *premises)
        for positive in (speed, slope):
            require(sp.Gt(positive, 0), *premises)
        return Conclusion(in_time(self.expr, sp.oo))


def bounds(field: sp.Expr, *premises: Judgement) -> tuple[sp.Basic, ...]:
    """Return relations that keep a field between two constants; RuleError where there are none."""
    parts = (p for f in facts_of(premises) for p in (f.args if isinstance(f, sp.And) else (f,)))
    found = []
    for small, large in (
        (p.lts, p.gts) for p in parts if isinstance(p, (sp.Ge, sp.Gt, sp.Le, sp.Lt))
    ):
        if small == sp.Abs(field) != field and _fixed(large):
            return (sp.Le(small, large, evaluate=False),)
        if small == field and _fixed(large):
            found.append((1, sp.Le(field, large, evaluate=False)))
        if large == field and _fixed(small):
            found.append((0, sp.Ge(field, small, evaluate=False)))
    if field.is_nonnegative:
        found.append((0, sp.Ge(field, 0, evaluate=False)))
    if {side for side, _ in found} != {0, 1}:
        raise RuleError(f"missing premise: {field.func} is bounded")
    return tuple(relation for _, relation in found)


def _require_positive(rate: sp.Expr, known: Iterable[sp.Basic], *premises: Judgement) -> None:
    """Refuse a rate that is not positive and continuous wherever its fields may be.

    They are taken for variables of which relations are known, and what is said of constants.
    """
    plain = {f: sp.Dummy(str(f.func), real=True) for f in fields(rate)}
    fixed = [h.relation for p in premises for h in p.hypotheses if _fixed(h.relation)]
    given = frozenset(r.xreplace(plain) for r in (*known, *fixed))
    flat = rate.xreplace(plain)
    goals = [sp.Gt(flat, 0), *continuity(flat, set(plain.values()))]
    if not constant(flat) or not all(holds(goal, given) for goal in goals):
        raise RuleError(f"missing premise: {rate} is positive and continuous")


def _fixed(expr: sp.Expr) -> bool:
    return constant(expr) and not fields(expr)


@dataclass(frozen=True)
class Unbounded(Rule):
    """``du/dt = F(u, a)`` with F positive and continuous, and bounded fields a: ``u -> oo``.

    Were u, which increases, bounded, then u and a would stay in a compact set, on which F has a
    positive minimum.  So F has to be positive where the bounds of a are attained, too.
    """

    words = (
        "A positive, continuous rate {0} under a bounded load: were the wear bounded, the rate "
        "would be bounded away from zero."
    )
    source = "extreme value theorem"
    asks = ("the rate",)

    def conclude(self, *premises: Judgement) -> Conclusion:
        law, *facts = premises
        u, function = rate_law(law)
        closed = [r for f in fields(function) - {u} for r in bounds(f, *premises)]
        always = (f for f in facts if all(_fixed(h.relation) for h in f.hypotheses))
        anywhere = [f.relation for f in always if fields(f.relation) <= {u}]
        _require_positive(function, (*closed, *anywhere), *premises)
        return Conclusion(in_time(u, sp.oo))


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


@dataclass(frozen=True)
class AtInfinity(Rule):
    """The limit of a function of u and bounded fields, where ``u -> oo``.

    The function is written as ``z^-n N(z, a)`` with ``z = 1/u``, or another ``small`` function of
    u that tends to 0.  N is smooth at z = 0, so that Taylor's remainder is uniform in bounded a:
    the first n coefficients must vanish, and the next is the limit, which is free of a.
    """

    claim: sp.Equality
    small: sp.Expr
    words = "By {0}, {small} tends to zero: expand in it, uniformly in bounded loads."
    source = "Taylor's theorem"
    asks = ("the growth",)

    def conclude(self, *premises: Judgement) -> Conclusion:
        u, inside = growing(premises[0]), self.claim.lhs.args[0]
        z = sp.Dummy("z", positive=True)
        deep = self._deep(u, z, premises)
        if not constant(inside.subs(dict.fromkeys(fields(inside), z))):
            raise RuleError(f"missing premise: {inside} depends on {u} and bounded fields alone")
        plain = {f: sp.Dummy(str(f.func), real=True) for f in fields(inside) if f != u}
        for field in plain:
            bounds(field, *premises)
        flat = inside.xreplace(plain).replace(sp.exp, lambda x: sp.exp(sp.expand(x.subs(u, deep))))
        order, smooth = expanded(flat.subs(u, deep), z)
        bent = (sp.Piecewise, LAW) if order > 1 else (sp.Piecewise,)
        if smooth.has(*bent) or not continuous(smooth, {z: sp.S.Zero}, *premises):
            raise RuleError(f"missing premise: {inside} is smooth at infinity")
        for n in range(max(order, 0)):
            if not is_zero(_taylor(smooth, z, n)):
                raise RuleError(f"missing premise: {inside} is bounded")
        value = sp.powsimp(_taylor(smooth, z, order)) if order >= 0 else sp.S.Zero
        if value.has(*plain.values()) or not is_zero(value - self.claim.rhs):
            raise RuleError(f"missing premise: the limit is {value}")
        require_defined(sp.Tuple(value, self.claim.rhs), *premises)
        return Conclusion(in_time(inside, self.claim.rhs))

    def _deep(self, u: sp.Expr, z: sp.Symbol, premises: tuple[Judgement, ...]) -> sp.Expr:
        """Return u in terms of what is small, for ``z = 1/u`` and for ``z = exp(-c u)``."""
        if self.small == 1 / u:
            return 1 / z
        inside = self.small.args[0] if isinstance(self.small, sp.exp) else u**2
        fall = -sp.cancel(inside / u)
        if not _fixed(fall):
            raise RuleError(f"missing premise: {self.small} -> 0 as {u} -> oo")
        require(sp.Gt(fall, 0), *premises)
        return -sp.log(z) / fall


def _taylor(expr: sp.Expr, z: sp.Symbol, n: int) -> sp.Expr:
    return (sp.diff(expr, z, n) / sp.factorial(n)).subs(z, 0).doit()


@dataclass(frozen=True)
class Vanishes(Rule):
    """``-B/s <= e <= B/s`` with constant B, and ``s -> oo``: ``e -> 0``."""

    words = "The bounds in {0} tend to zero, since the roughness grows by {others}."
    source = "squeeze theorem"
    asks = ("the bounds", "the growth")

    def conclude(self, *premises: Judgement) -> Conclusion:
        squeeze, divergence = premises
        (low, middle, high), size = between(squeeze), growing(divergence)
        for side in (low, high):
            if not _fixed(sp.cancel(side * size)):
                raise RuleError(f"missing premise: {side} is a constant over {size}")
        return Conclusion(in_time(middle, sp.S.Zero))


vanishes = Vanishes()


@dataclass(frozen=True)
class Passes(Rule):
    """Limits pass through a function that is continuous where they end, and through one period.

    The premises give the limits of some expressions, and equalities; the claim is the limit of a
    combination of those expressions, now or one period later.  Of ``s -> oo`` it uses 1/s -> 0.
    """

    claim: sp.Equality
    words = (
        "Let time tend to infinity in {0}: the limit in {others} passes through a function that "
        "is continuous where it ends."
    )

    def conclude(self, *premises: Judgement) -> Conclusion:
        whole = self.claim.lhs.args[0]
        expr, known, ends = whole, list[Equality](), dict[sp.Symbol, sp.Expr]()
        meaning: dict[sp.Symbol, sp.Expr] = {}
        for premise in premises:
            if isinstance(premise.claim, Equality):
                known.append(premise.claim)
                expr = expr.subs(premise.claim.lhs, premise.claim.rhs)
        rewritten = expr
        for premise in premises:
            if not isinstance(premise.claim, Limit):
                continue
            given = limit_in_time(premise)
            part, end = given.expr, given.value
            if given.value == sp.oo:
                part, end = 1 / part, sp.S.Zero
            elif given.value.is_finite is False:
                raise RuleError(f"missing premise: the limit of {given.expr} is finite")
            for quantity in (part, later(part)) if _at_one_time(part) else (part,):
                stand_in = sp.Dummy(real=True)
                expr = in_terms_of(expr, quantity, stand_in)
                ends[stand_in], meaning[stand_in] = end, quantity
        back = expr
        for stand_in, quantity in reversed(meaning.items()):
            back = back.subs(stand_in, quantity)
        if not constant(expr) or fields(expr) or not is_zero(back - rewritten):
            raise RuleError(f"missing premise: the limit of all that varies in {whole}")
        if not continuous(expr, ends, *premises):
            raise RuleError(f"missing premise: {whole} is continuous at {(*ends.values(),)}")
        require_constants(whole, t, *premises)
        require_defined(self.claim.rhs, *premises)
        if not is_zero(expr.subs(ends) - self.claim.rhs):
            raise RuleError(f"missing premise: the limit of {whole} is {expr.subs(ends)}")
        return Conclusion(in_time(whole, self.claim.rhs))


def in_terms_of(expr: sp.Expr, quantity: sp.Expr, name: sp.Symbol) -> sp.Expr:
    """Write ``expr`` with ``name`` for ``quantity``, by eliminating the load or a field."""
    expr = expr.subs(quantity, name)
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


@dataclass(frozen=True)
class Accumulates(Rule):
    """``du/dt -> R``, finite: the wear of one period tends to ``R T``."""

    words = "Integrate the limit {0} over one period."
    source = "mean value theorem on [t, t + T]"
    asks = ("the limit of the rate",)

    def conclude(self, *premises: Judgement) -> Conclusion:
        given = limit_in_time(premises[0])
        u = field_of_rate(given.expr)
        if not _fixed(given.value) or given.value.is_finite is False:
            raise RuleError(f"missing premise: the limit of {given.expr} is finite")
        return Conclusion(in_time(u.subs(t, t + T) - u, given.value * T))


accumulates = Accumulates()


@dataclass(frozen=True)
class Intermittent(Rule):
    """A rate ``F(u, load)`` in contact, else 0, where contact depends on the load alone.

    Premises: the rate, piecewise; the definition of d > 0, the fraction of the period in contact;
    a lower bound of u; a periodic, continuous, bounded load.  F is positive and continuous, so that
    u grows without bound, and tends to R as u -> oo: ``u(t + T) - u(t) -> d T R``.
    """

    words = "The limit of the rate in {0} holds during a fixed part of every period, by {others}."
    source = "mean value theorem on the part of the period in contact"
    asks = ("the rate", "the fraction in contact", "the least wear")

    def conclude(self, *premises: Judgement) -> Conclusion:
        law, part, start, *_ = premises
        (u, function), meaning, least = rate_law(law), equality(part), inequality(start)
        for said in (PERIODIC.relation, CONTINUOUS):
            require_hypothesis(said, *premises)
        if least.greater != u or not _fixed(least.lesser):
            raise RuleError(f"missing premise: {u} stays above a constant")
        (on, contact), *rest = sp.piecewise_fold(function).args
        if not isinstance(contact, Relational) or [e for e, _ in rest] != [0]:
            raise RuleError("missing premise: a rate that is 0 out of contact")
        room = sp.expand(contact.gts - contact.lts)
        level = room.subs(LOAD, 0)
        slope = sp.cancel((room - level) / LOAD)
        if (
            not _fixed(sp.Tuple(level, slope))
            or slope == 0
            or not isinstance(contact, (sp.Le, sp.Ge))
        ):
            raise RuleError("missing premise: contact depends on the load alone")
        shares = (
            sp.Integral(sp.Piecewise((1, c), (0, True)), (t, 0, T)) / T
            for c in meaning.rhs.atoms(sp.Le, sp.Ge)
            if sp.cancel((c.gts - c.lts) / room).is_positive
        )
        if meaning.rhs not in shares or not meaning.lhs.is_positive:
            raise RuleError("missing premise: the fraction of the period in contact")
        closed = [r for f in {LOAD, *fields(on)} - {u} for r in bounds(f, *premises)]
        _require_positive(on, (*closed, sp.Ge(u, least.lesser)), *premises)
        z = sp.Dummy("z", positive=True)
        order, smooth = expanded(on.subs(u, 1 / z), z)
        value = smooth.subs(z, 0)
        if order != 0 or not continuous(smooth, {z: sp.S.Zero}, law) or fields(value):
            raise RuleError("missing premise: the limit of the rate in contact")
        return Conclusion(in_time(u.subs(t, t + T) - u, meaning.lhs * T * value))


intermittent = Intermittent()
