"""What tests of the rules share: judgements to start from, and what is often made of them.

A ``Family`` holds applications of one builder: arguments with which it gives a true statement, and
those with which it would give a false one, each with what the refusal says.  In the comment of a
false one stands a model in which it fails, or what is wrong with it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import sympy as sp
from sympy.core.relational import Relational

from derive.claims import Drift, Oscillation
from derive.hypotheses import BOUNDED_LOAD, CONSTANT, PERIODIC, SINE, Hypothesis, Kind
from derive.kernel import Judgement
from derive.results.expansion import expansion
from derive.results.steady_state import steady_state
from derive.rules.algebra import Insert, Solve
from derive.rules.assumption import assume, defined
from derive.rules.averages import (
    EXPANSION,
    OFFSET,
    SATURATION,
    Averaging,
    OrderEquation,
    SlowTime,
    term_of,
)
from derive.rules.calculus import SPRINGS
from derive.rules.data import DataDerivative
from derive.rules.drift import MEAN, LogarithmicGrowth, logarithmic_drift
from derive.rules.inequalities import Arithmetic
from derive.rules.limits import forever
from derive.rules.solutions import Separate
from derive.symbols import initial, rate, symbol, symbols, t

u_c, U_a, U_c, h, p, G, u_s = symbols("u_c U_a U_c h p G u_s")
C, f_c, h_0, k, q, L, T, tau, theta, u_cum = symbols("C f_c h_0 k q L T tau theta u_cum")


@dataclass(frozen=True)
class Family:
    """Applications of a builder: an argument, or a tuple of them, for each that is true; by name,
    what the refusal says (a regular expression) and the arguments of each that is false."""

    build: Callable[..., Judgement]
    true: tuple[object, ...] = ()
    false: Mapping[str, tuple[object, ...]] = field(default_factory=dict)


def each(build: Callable[[], Judgement]) -> Judgement:
    """Build what shares no builder with others."""
    return build()


def given(relation: sp.Basic) -> Judgement:
    return assume(Hypothesis(relation))


def stated(relation: type[Relational]) -> Callable[..., Judgement]:
    return lambda left, right, evaluate=True: given(relation(left, right, evaluate=evaluate))


eq, ne, ge, gt, le, lt = map(stated, (sp.Eq, sp.Ne, sp.Ge, sp.Gt, sp.Le, sp.Lt))


def equal(left: sp.Expr, right: sp.Expr) -> sp.Equality:
    """Return an equality as it is written."""
    return sp.Eq(left, right, evaluate=False)


def end(expr: sp.Expr, value: sp.Expr) -> sp.Equality:
    return sp.Eq(forever(expr), value)


def tends(expr: sp.Expr, value: sp.Expr) -> Judgement:
    return given(equal(forever(expr), value))


START, PIN_START = eq(initial("u_c"), 0), eq(initial("u_a"), 0)
BOUNDED = assume(BOUNDED_LOAD)
DEEP = tends(u_c, sp.oo)
ROUGHENS = gt(f_c, 0)
SPEED = rate("u_c")
RATE = eq(SPEED, C)
CONSTANTLY = assume(CONSTANT)
CYCLING = defined(t, T * tau)
ALMOST = Arithmetic(equal(G, u_c))(eq(G, u_c + T * (SPEED - C)), RATE)
"""For almost every time: wherever the wear has a rate."""
SLOPE = sp.Derivative(u_cum, f_c, evaluate=False)
GROWING = defined(u_cum, h_0 * f_c)
GAP = (h_0**2 - L**2) / (h_0 - L) - h_0 - L
"""Zero, but where h_0 = L."""
APART = ne(h_0, L)
APPROACH = t * (rate("u_c") - C) - f_c * U_a
FIRST_DRIFT = 2 * (1 - theta) * symbol("b_0")


def supposed(relation: sp.Basic, kind: Kind = Kind.CONDITION) -> Hypothesis:
    return Hypothesis(relation, kind)


def times(factor: sp.Expr, known: Judgement, *facts: Judgement) -> Judgement:
    """Return a relation times a factor."""
    return Arithmetic(known.claim.map(lambda side: factor * side).relation)(known, *facts)


def integral(body: sp.Expr, low: int = -1) -> Judgement:
    return eq(G, sp.Integral(body, (theta, low * L, 2 * L)))


def timed(
    g: sp.Expr, speed: sp.Expr, start: Judgement, *facts: Judgement, low: int = 0
) -> Judgement:
    """Separate du_c/dt = speed: the time is the integral of g over u_s, from a first wear."""
    claim = equal(t, sp.Integral(g, (u_s, low, u_c)))
    return Separate(claim)(eq(rate("u_c"), speed), start, CONSTANTLY, *facts)


def opened(*facts: Judgement) -> Judgement:
    """Return the closure over a support of stiffness k."""
    closure = eq(h, h_0 + U_c - U_a)
    return Insert(sp.Eq(h, h_0 + p / k - U_a))(closure, Solve(U_c)(assume(SPRINGS)), *facts)


def sloped(*facts: Judgement) -> Judgement:
    """Return the slope of u_cum = h_0 f_c in f_c."""
    return DataDerivative(equal(SLOPE, h_0), f_c)(GROWING, *facts)


def logarithmic(
    scale: sp.Expr = q, size: sp.Expr = q, speed: sp.Expr = SPEED, *facts: Judgement
) -> Judgement:
    """Return how wear grows whose rate falls exponentially with it."""
    limit = tends(speed * sp.exp((u_c - U_a) / size), C)
    return LogarithmicGrowth(scale)(limit, assume(SINE), *facts)


def drifting(approach: sp.Expr = APPROACH) -> Judgement:
    return logarithmic_drift(*drift_premises(approach))


def drift_premises(approach: sp.Expr = APPROACH) -> tuple[Judgement, ...]:
    mean = defined(MEAN.lhs, MEAN.rhs)
    return tends(approach, sp.S.Zero), assume(PERIODIC), mean


def expansion_premises(name: str = "c_1") -> tuple[Judgement, ...]:
    """Return the pressure, the load, b_0, theta, and names for c_1 and w_1."""
    pressure = steady_state().pressure_at_wear
    names = (
        defined(symbol(called), term_of(kind, 1, pressure.claim.rhs), ROUGHENS)
        for called, kind in ((name, Drift), ("w_1", Oscillation))
    )
    return pressure, assume(SINE), defined(*OFFSET.args), defined(*SATURATION.args), *names


def first_order_terms(name: str = "c_1") -> Judgement:
    """Return what the terms with 1/m say of c_1 and w_1."""
    return OrderEquation(sp.S.One)(*expansion_premises(name))


def averaged_as(claim: sp.Expr, name: str = "c_1") -> Judgement:
    """Return c_1 from the mean of the terms with 1/m, where it has a name."""
    return Averaging(sp.Eq(symbol("c_1"), claim))(first_order_terms(name))


def slow_time() -> Judgement:
    """Return the slow time by the definitions of c_1 to c_4."""
    known, pressure = expansion.claim, steady_state().pressure_at_wear.claim.rhs
    drifts = [
        defined(symbol(f"c_{n}"), term_of(Drift, n, pressure), ROUGHENS) for n in (1, 2, 3, 4)
    ]
    return SlowTime(sp.Eq(known.lhs, known.rhs))(*drifts, assume(EXPANSION))
