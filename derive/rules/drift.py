"""The drift of wear: the approach of the rate to its limit, and its integral.

Key results
    first_order          u (x - l) - a -> 0 for du/dt = F(x) gives t (du/dt - R) - F'(l) a/R -> 0
    logarithmic_drift    t (du/dt - R) - a -> 0, a periodic, gives (u - R t)/ln t -> mean of a
    LogarithmicGrowth    e^((u - U_a)/s) du/dt -> a gives u(N T) = s ln(1 + ...) + o(1)
    LeadingTerm          ln N to leading order, as a roughness vanishes
"""

from __future__ import annotations

import sympy as sp

from ..claims import Asymptotic, Limit
from ..hypotheses import LOAD, PERIODIC, SINE
from ..kernel import Conclusion, Judgement, RuleError
from ..laws import r
from ..parts import nonnegative, nonzero, positive
from ..reals import holds
from ..symbols import symbols, t
from ..zero import is_zero
from .growth import bounds
from .limits import in_terms_of
from .proving import coefficients, continuous, facts_of, require, require_defined, smooth
from .reading import (
    T,
    clocks,
    constant,
    equality,
    field_of_rate,
    fields,
    limit_in_time,
    rate_law,
    require_hypothesis,
)
from .theorem import Theorem

N, U, U_mean = symbols("N U U_mean")
MEAN = sp.Eq(U_mean, sp.Integral(LOAD, (t, 0, T)) / T)
"""The definition of the mean of the load."""


class FirstOrder(Theorem):
    """The approach of the rate to its limit, from that of h/sigma.

    ``du/dt = F(x)``, ``u (x - l) - a -> 0`` with bounded a, ``x -> l``, ``du/dt -> R > 0``:
    ``t (du/dt - R) - F'(l) a/R -> 0``, as u/t tends to R and F is differentiable at l.
    """

    words = "Expand the rate in {0} about the limit of the ratio on which it rests, with {others}."
    source = "Taylor's theorem; u/t -> R by L'Hopital's rule"
    premise_names = ("the rate", "the deviation", "the limit of the ratio", "the limit of the rate")

    def prove(self, *premises: Judgement) -> Conclusion:
        law, deviation, ratio, speed, *_ = premises
        u, rate = rate_law(law)
        y = sp.Dummy(real=True) if rate.has(r) else r  # which readers of the slope see
        approach, x, steady = map(limit_in_time, (deviation, ratio, speed))
        function = in_terms_of(rate, x.expr, y)
        known = steady.expr == sp.Derivative(u, t) and constant(sp.Tuple(function, x.value))
        if approach.value != 0 or not known or not is_zero(function.subs(y, x.expr) - rate):
            raise RuleError("missing premise: the rate is a function of a ratio with that limit")
        first = sp.expand(u * (x.expr - x.value) - approach.expr)
        for field in fields(first):
            bounds(field, *premises)
        parts = coefficients(first, *fields(first))
        if parts is None or not constant(sp.Tuple(*parts)):
            raise RuleError(f"missing premise: {first} is linear in bounded fields")
        if not smooth(function) or not continuous(function, {y: x.value}, *premises):
            raise RuleError(f"missing premise: {function} is differentiable at the limit")
        if not is_zero(function.subs(y, x.value) - steady.value):
            raise RuleError(f"missing premise: {steady.value} is the rate at the limit")
        require(positive(steady.value), *premises)
        slope = sp.cancel(sp.diff(function, y).subs(y, x.value) / steady.value)
        return Conclusion(Limit(t * (steady.expr - steady.value) - slope * first, sp.S.Zero))


first_order = FirstOrder()


class LogarithmicDrift(Theorem):
    """``t (du/dt - R) - a(U_a) -> 0``, a linear: ``(u - R t)/ln(t/T) -> a(<U_a>)``.

    The load is periodic; <U_a> is its mean over a period, so that it is integrable.
    """

    words = "Integrate {0} over many periods: the integral of the mean is a logarithm."
    source = "a periodic function over t integrates to its mean times ln N and a bounded rest"
    premise_names = ("the approach of the rate",)

    def prove(self, *premises: Judgement) -> Conclusion:
        approach = limit_in_time(premises[0])
        for relation in (PERIODIC.relation, MEAN):
            require_hypothesis(relation, *premises)
        (rate,) = approach.expr.atoms(sp.Derivative) - _laws(approach.expr)
        u, now, load = field_of_rate(rate), sp.Dummy(), sp.Dummy()
        flat = approach.expr.xreplace({rate: now}).xreplace({LOAD: load})
        periodic = -flat.subs(t, 0)
        speed = sp.expand(now - sp.diff(flat, t))
        rest = sp.expand(flat - t * (now - speed) + periodic)
        parts = coefficients(periodic, load)
        linear = parts is not None and constant(sp.Tuple(speed, *parts))
        if approach.value != 0 or rest != 0 or speed.has(now, load) or not linear:
            raise RuleError("missing premise: t (du/dt - R) - a(t) -> 0, a linear in the load")
        drift = (u - speed * t) / sp.log(t / T)
        return Conclusion(Limit(drift, periodic.subs(load, U_mean)), gives=(1 / sp.log(t / T),))


def _laws(expr: sp.Expr) -> set[sp.Basic]:
    return {d for d in expr.atoms(sp.Derivative) if not fields(d)}


logarithmic_drift = LogarithmicDrift()


class LogarithmicGrowth(Theorem):
    """``e^((u - U_a)/s) du/dt -> a > 0`` with constant s > 0, under ``U_a = U sin(2 pi t/T)``:
    ``u(N T) = s ln(1 + a N T I_0(U/s)/s) + o(1)`` as N -> oo.

    s e^(u/s) has the derivative ``(a + o(1)) e^(U_a/s)``, whose mean over a cycle is a I_0(U/s).
    """

    scale: sp.Expr
    words = (
        "Separate the variables of {0}: in the end the exponential grows equally in every cycle."
    )
    source = "DLMF 10.32.1; Cesaro's theorem"
    premise_names = ("the limit",)

    def prove(self, *premises: Judgement) -> Conclusion:
        growth = limit_in_time(premises[0])
        require_hypothesis(SINE.relation, *premises)
        (rate,) = growth.expr.atoms(sp.Derivative)
        u, a, s = field_of_rate(rate), growth.value, self.scale
        if not is_zero(growth.expr - rate * sp.exp((u - LOAD) / s)) or not constant(s):
            raise RuleError("missing premise: the limit of exp((u - U_a)/s) du/dt")
        require_defined(s, *premises)
        for factor in (a, s):
            require(positive(factor), *premises)
        mean = sp.besseli(0, U / s)
        worn = s * sp.log(1 + a * N * T * mean / s)
        return Conclusion(Asymptotic(u.subs(t, N * T), worn, N, sp.oo), gives=(worn,))


class LeadingTerm(Theorem):
    """``c N = F(s)`` gives ``ln N = K(s) + o(1)`` as s -> 0+: ``e^K -> oo``, ``N'/(e^K)' -> 1``.

    F may have an integral up to s, whose derivative is its integrand; c is constant, not 0.
    """

    claim: sp.Equality
    words = (
        "As the field in {0} vanishes, one term exceeds all others: by L'Hôpital's rule its "
        "quotient with the left side tends to one.  Take logarithms."
    )
    source = "L'Hopital's rule"
    premise_names = ("the equation",)

    def prove(self, *premises: Judgement) -> Conclusion:
        given, (left, leading) = equality(premises[0]), self.claim.args
        s = next(iter(fields(given.rhs)), t)
        pace = sp.cancel(given.lhs / left.args[0]) if isinstance(left, sp.log) else t
        require_defined(sp.Tuple(*left.args), *premises)
        small = sp.Dummy("s", positive=True)
        worn, cycles = (e.xreplace({s: small}) for e in (leading, given.rhs / pace))
        slope, claimed = sp.diff(cycles, small), sp.diff(worn, small)
        moving = s == t or cycles.has(t) or clocks(cycles)  # other variables, absent from the slope
        rises = smooth(worn, small) and smooth(slope, small)
        if moving or not rises or not constant(sp.Tuple(pace, worn, slope)):
            raise RuleError(f"missing premise: {self.claim} is about {given.relation}")
        require(nonzero(pace), *premises)
        require(nonnegative(s), *premises)
        falls = (_at_zero(small**order * claimed, small, *premises) for order in (1, 2))
        if not any(fall and holds(positive(-fall), facts_of(premises)) for fall in falls):
            raise RuleError(f"missing premise: {leading} grows without bound, like 1/s or ln(1/s)")
        quotient = _at_zero(slope / (sp.exp(worn) * claimed), small, *premises)
        if quotient is None or not is_zero(quotient - 1):
            raise RuleError("missing premise: the quotient of the slopes tends to one")
        return Conclusion(Asymptotic(left, leading, s, sp.S.Zero), gives=(left,))


def _at_zero(expr: sp.Expr, small: sp.Dummy, *premises: Judgement) -> sp.Expr | None:
    """Return the limit of an expression for small -> 0+, if it is continuous there as a function
    of ``small`` and of e^(-a/small) with some a > 0."""
    fading: dict[sp.Expr, sp.Symbol] = {}
    facts = facts_of(premises)

    def exponential(argument: sp.Expr) -> sp.Expr:
        whole = sp.expand(sp.cancel(argument))
        pole = whole.coeff(small, -1)
        size = next((a for a in (pole, -pole) if holds(positive(a), facts)), sp.S.Zero)
        if size == 0 or pole.has(small, *fading.values()):
            return sp.exp(whole)
        fades = fading.setdefault(size, sp.Dummy(positive=True))
        return sp.exp(whole - pole / small) * fades ** (-pole / size)

    ratio = sp.cancel(sp.powsimp(sp.expand(expr)).replace(sp.exp, exponential))
    ends = dict.fromkeys((small, *fading.values()), sp.S.Zero)
    return ratio.subs(ends) if continuous(ratio, ends, *premises) else None
