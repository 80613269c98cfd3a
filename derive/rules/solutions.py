"""Solutions of the differential equation, found by insight and proved by differentiating back.

Key results
    Solution      t(u) under a constant load: dF/du = 1/Q and F(u(0)) = 0
    Inverted      u(t), the inverse of an increasing t(u)
    Parametric    t(p), where wear and rate are functions of the pressure
    FirstRoot     the first zero of what a positive factor makes quadratic
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from ..claims import Equality, FirstZero
from ..kernel import Conclusion, Judgement, Rule, RuleError
from ..symbols import symbol, t
from ..zero import is_zero
from .algebra import inserted
from .proving import continuous, facts_of, require, require_defined, sign, smooth
from .reading import (
    CONSTANT,
    LOAD,
    constant,
    equality,
    fields,
    initial_value,
    rate_law,
    require_hypothesis,
)

PRESSURE = symbol("p")


@dataclass(frozen=True)
class Solution(Rule):
    """``t = F(u)`` for ``du/dt = Q(u) > 0`` under a constant load: ``F' = 1/Q``, ``F(u(0)) = 0``.

    Premises: the rate, u(0), then names of constants, and what F needs to have a value.
    """

    claim: sp.Equality
    words = (
        "Differentiating the claim gives back the rate {0}; at t = 0 it gives the first wear, {1}."
    )
    source = "fundamental theorem of calculus"
    asks = ("the rate", "u(0)")

    def conclude(self, *premises: Judgement) -> Conclusion:
        law, start, *names = premises
        (u, rate), time = rate_law(law), self.claim.rhs
        require_hypothesis(CONSTANT.relation, *premises)
        if self.claim.lhs != t or fields(rate) - {u, LOAD}:
            raise RuleError(f"missing premise: {self.claim} gives the time")
        require_defined(time, *premises)
        require(sp.Gt(rate, 0), *premises)
        plain = {u: sp.Dummy("u", nonnegative=True), LOAD: sp.Dummy("U", real=True)}
        known = tuple(names)
        found, slope = (inserted(e, known).xreplace(plain) for e in (time, rate))
        if not constant(found) or not constant(slope) or fields(found) or not smooth(found):
            raise RuleError(f"missing premise: {time} is a smooth function of the wear alone")
        wear = plain[u]
        require(sp.Ge(initial_value(start, u), 0), *premises)
        if not is_zero(sp.diff(found, wear) - (1 / slope).rewrite(sp.tanh, sp.exp)):
            raise RuleError("missing premise: its derivative is the reciprocal of the rate")
        if not is_zero(found.subs(wear, initial_value(start, u))):
            raise RuleError("missing premise: it begins at 0")
        return Conclusion(Equality(t, time))


@dataclass(frozen=True)
class Inverted(Rule):
    """``u = G(t)``, the inverse of ``t = F(u)``: F increases, and ``F(G(t)) = t``.

    G may use the principal branch W of Lambert's function at arguments that are not negative:
    with ``x = w e^w`` exponentials of w = W(x) are rational in w.
    """

    claim: sp.Equality
    words = "Solve {0} for the wear, by Lambert's function."
    source = "Corless et al., Adv. Comput. Math. 5 (1996) 329"
    asks = ("the time",)

    def conclude(self, *premises: Judgement) -> Conclusion:
        given = equality(premises[0])
        u, inverse = self.claim.lhs, self.claim.rhs
        x = sp.Dummy(real=True)
        if given.lhs != t or u not in fields(given.rhs) or inverse.has(u):
            raise RuleError(f"missing premise: {premises[0].relation} gives the time")
        require_defined(inverse, *premises)
        if not smooth(given.rhs) or sign(sp.diff(given.rhs.subs(u, x), x)) != 1:
            raise RuleError(f"missing premise: {given.rhs} increases with {u}")
        if not is_zero(_resolved(given.rhs.subs(u, inverse) - given.lhs)):
            raise RuleError("missing premise: inserted, it gives back the time")
        return Conclusion(Equality(u, inverse))


def _resolved(expr: sp.Expr) -> sp.Expr:
    """Use e^(-W(x)) = W(x)/x, for one Lambert function on which exponentials depend linearly."""
    lambert = expr.atoms(sp.LambertW)
    if len(lambert) != 1:
        return expr
    (found,) = lambert
    w = sp.Dummy(positive=True)
    expr = expr.subs(found, w)
    exponents = {e: sp.expand(e.exp) for e in expr.atoms(sp.exp) if e.has(w)}
    powers = {
        e: sp.exp(inside.coeff(w, 0)) * (w / found.args[0]) ** -inside.coeff(w, 1)
        for e, inside in exponents.items()
    }
    return expr.xreplace(powers)


@dataclass(frozen=True)
class Parametric(Rule):
    """``t = F(p)`` where ``du/dt = Q(p)`` and ``u = G(p)``: ``F' = G'/Q``, F = 0 at p(0).

    Premises: rate, wear, u(0), the pressure, then names of constants.  The load is constant and
    the pressure is the one root of ``p = R(p, u)``, where ``p - R`` increases: it is continuous.
    """

    claim: sp.Equality
    words = "Wear and rate are known at a pressure, {0} and {1}; integrate over it."
    source = "chain rule; implicit function theorem"
    asks = ("the rate", "the wear", "u(0)", "the pressure")

    def conclude(self, *premises: Judgement) -> Conclusion:
        law, wear, start, pressure, *names = premises
        (u, rate), worn = rate_law(law), equality(wear)
        require_hypothesis(CONSTANT.relation, *premises)
        if worn.lhs != u or self.claim.lhs != t or initial_value(start, u) != 0:
            raise RuleError("missing premise: rate and wear are of the same quantity, from 0 on")
        require_defined(self.claim.rhs, *premises)
        _require_root(pressure, u, *premises)
        p = sp.Dummy("p", positive=True)
        first, load = sp.Dummy("p_0", positive=True), sp.Dummy("U", real=True)
        plain = {PRESSURE: p, PRESSURE.subs(t, 0): first, LOAD: load, LOAD.subs(t, 0): load}
        q, g, f = (
            inserted(e, tuple(names)).xreplace(plain) for e in (rate, worn.rhs, self.claim.rhs)
        )
        flat = sp.Tuple(q, g, f.replace(sp.Integral, lambda integrand, _: integrand))
        if fields(flat) or not constant(flat) or not all(map(smooth, flat)):
            raise RuleError("missing premise: wear and time are smooth functions of the pressure")
        if not is_zero(sp.diff(f, p) - sp.diff(g, p) / q):
            raise RuleError("missing premise: its derivative is that of the wear over the rate")
        f, zero = (e.subs(p, first).doit() for e in (f, g))
        if f.has(load):  # u(0) = 0 gives the load at which the pressure is p(0)
            if sp.diff(zero, load, 2) != 0:
                raise RuleError("missing premise: the wear is linear in the load")
            f = f.subs(load, load - zero / sp.diff(zero, load))
        if not is_zero(f):
            raise RuleError("missing premise: it begins at 0")
        return Conclusion(Equality(t, self.claim.rhs))


def _require_root(pressure: Judgement, u: sp.Expr, *premises: Judgement) -> None:
    """Refuse unless the pressure is the one root of ``p = R(p, u, load)``, so that it follows u."""
    given, p = equality(pressure), sp.Dummy("p", positive=True)
    value = given.rhs.xreplace({PRESSURE: p})
    moving = {unknown: unknown for unknown in (p, u, LOAD)}
    fixed = value.xreplace({unknown: sp.Dummy(real=True) for unknown in moving})
    known = given.lhs == PRESSURE and constant(fixed) and not fields(fixed) and smooth(value, p)
    increases = known and sign(1 - sp.diff(value, p), facts_of(premises)) == 1
    if not increases or not continuous(value, moving, *premises):
        raise RuleError(f"missing premise: {PRESSURE} is the one root of an equation")


@dataclass(frozen=True)
class FirstRoot(Rule):
    """The first positive zero x of f, where ``f w = a_0 + 2 a_1 x + a_2 x^2`` with w > 0.

    With ``a_0 > 0``, ``D = a_1^2 - a_2 a_0 >= 0`` and ``sqrt(D) > a_1`` it is
    ``a_0/(sqrt(D) - a_1)``: the other root is negative or lies beyond.  The premise defines x.
    """

    factor: sp.Expr
    words = "The first root of a quadratic equation, from {all}."
    source = "the quadratic formula, in the form without cancellation"
    asks = ("the definition",)

    def conclude(self, *premises: Judgement) -> Conclusion:
        meaning = equality(premises[0])
        if not isinstance(meaning.rhs, FirstZero):
            raise RuleError("missing premise: the definition of a first zero")
        function, x = meaning.rhs.args
        z = sp.Dummy("x", positive=True)
        product = sp.Poly(sp.expand(function * self.factor).subs(x, z), z)
        a_2, twice, a_0 = (product.coeff_monomial(z**n) for n in (2, 1, 0))
        a_1 = twice / 2
        inside = a_1**2 - a_2 * a_0
        if product.degree() > 2 or not all(e.is_real for e in (a_0, a_1, a_2)):
            raise RuleError(f"missing premise: {function} times {self.factor} is quadratic")
        require_defined(sp.Tuple(function, self.factor).subs(x, z), *premises)
        require(sp.Gt(self.factor.subs(x, z), 0), *premises)
        for goal in (sp.Gt(a_0, 0), sp.Ge(inside, 0), sp.Gt(inside, a_1 * sp.Abs(a_1))):
            require(goal, *premises)
        return Conclusion(Equality(meaning.lhs, a_0 / (sp.sqrt(inside) - a_1)))
