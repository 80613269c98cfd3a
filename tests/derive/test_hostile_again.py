"""What a second hostile reading got through the public rules, and a true neighbour of each.

Every false statement follows a comment with the model in which it fails, or what is wrong with it.
"""

from __future__ import annotations

from collections.abc import Callable

import pytest
import sympy as sp

from derive.claims import Drift, FirstZero, Oscillation
from derive.kernel import Judgement, RuleError, replayed
from derive.rules.algebra import (
    Consequence,
    Identity,
    Insert,
    Multiply,
    forget,
    restrict,
)
from derive.rules.assumption import assume, defined
from derive.rules.averages import OrderEquation, SlowTime, term_of
from derive.rules.calculus import (
    ParameterLimit,
    change_clock,
    differentiate,
    grows,
    integrate,
)
from derive.rules.data import Differentiated
from derive.rules.drift import logarithmic_drift
from derive.rules.inequalities import Arithmetic
from derive.rules.limits import (
    AtInfinity,
    Diverges,
    accumulates,
    forever,
    intermittent,
    one_period_later,
    unbounded,
    vanishes,
)
from derive.rules.proving import DIFFERENTIABLE
from derive.rules.reading import CONTINUOUS, PERIODIC
from derive.rules.solutions import Separate
from derive.symbols import initial, rate, symbols, t
from tests.derive.judgements import (
    BOUNDED,
    CONSTANTLY,
    DEEP,
    ROUGHENS,
    START,
    drift_premises,
    equal,
    expansion_premises,
    given,
    slow_time,
    tends,
    timed,
)

u_c, u_a, U_a, h, p, G = symbols("u_c u_a U_a h p G")
h_0, f_c, C, T, N, q, b_0, d, M = symbols("h_0 f_c C T N q b_0 d M")
p_max, theta, u_cum, U_mean, tau = symbols("p_max theta u_cum U_mean tau")
u_stop, c_1, m, p_s, w_1 = symbols("u_stop c_1 m p_s w_1")
y = sp.Symbol("y", real=True)
v, w = sp.Function("v", real=True)(tau), sp.Function("w", positive=True)(tau)
du, CLOCK = rate("u_c"), defined(t, T * tau)
FALLING, STEADY = C / (1 + tau) ** 2, C / (1 + f_c**2) ** 2


def integral(body: sp.Expr, low: sp.Expr, high: sp.Expr) -> sp.Integral:
    return sp.Integral(body, (q, low, high))


def squeezed(bound: sp.Expr) -> Judgement:
    return vanishes(given(sp.And(sp.Le(G, bound / u_c), sp.Ge(G, -bound / u_c))), DEEP)


def at_times(level: sp.Expr, on: sp.Expr = C) -> Judgement:
    """Wear at a rate ``on`` while the load is above a level."""
    touching = sp.Ge(U_a, level)
    law = given(sp.Eq(du, sp.Piecewise((on, touching), (0, True))))
    part = sp.Integral(sp.Piecewise((1, touching), (0, True)), (t, 0, T)) / T
    loads = assume(PERIODIC), assume(CONTINUOUS), BOUNDED
    return intermittent(law, defined(d, part), given(sp.Ge(u_c, 0)), *loads)


def drifting(approach: sp.Expr) -> Judgement:
    return logarithmic_drift(*drift_premises(approach=approach))


def scaled(value: sp.Expr) -> Judgement:
    return change_clock(given(equal(u_c, value)), CLOCK)


def sloped(value: sp.Expr, slope: sp.Expr) -> Judgement:
    claim = equal(sp.Derivative(u_cum, h_0, evaluate=False), slope)
    return Differentiated(claim, h_0)(defined(u_cum, value))


def by_value(first: sp.Expr, claim: sp.Expr, value: sp.Expr) -> Judgement:
    """Write ``lim first = 0`` for M -> oo with another form of ``first``, for f_c = value."""
    known = ParameterLimit(first, M)(), given(equal(f_c, value))
    return Consequence(equal(sp.Limit(claim, M, sp.oo), 0))(*known)


def by_pressure(field: sp.Expr, size: sp.Expr) -> Judgement:
    """The time at which a field has a value, where wear is a multiple of its size."""
    root = given(equal(p, p_max * u_c / h_0)) if field == p else START
    law, wear = given(equal(du, C)), given(equal(u_c, h_0 * size / p_max))
    claim = equal(t, sp.Integral(h_0 / (C * p_max), (p_s, field.subs(t, 0), field)))
    return Separate(claim)(law, wear, root, CONSTANTLY)


def bent(bend: int) -> Judgement:
    """The time at which the pressure has a value, where wear bends as it grows."""
    s, first = p / p_max, initial("p") / p_max
    begin = first + bend * first**2
    wear, root = h_0 * (s + bend * s**2 - begin), p_max * (u_c / h_0 + begin - bend * s**2)
    known = given(equal(du, C * s)), given(equal(u_c, wear)), given(equal(p, root))
    slope = h_0 / (C * p_s) * (1 + 2 * bend * p_s / p_max)
    return Separate(equal(t, sp.Integral(slope, (p_s, initial("p"), p))))(*known, CONSTANTLY)


def within(low: sp.Expr, level: sp.Expr) -> Judgement:
    """The fraction of a period in which a wear is below a level that it never falls below."""
    share = sp.Integral(sp.Piecewise((1, u_a >= level), (0, True)), (t, low, T))
    return restrict(given(equal(theta, share / T)), given(sp.Ge(u_a, level)))


def averaged(factor: sp.Expr) -> Judgement:
    """The terms of the first order under a pressure that is a multiple of the note's."""
    known, sine, *constants, _, _ = expansion_premises()
    pressure = known.claim.rhs * factor
    drift, wave = (term_of(kind, 1, pressure) for kind in (Drift, Oscillation))
    names = defined(c_1, drift), defined(w_1, wave)
    facts = given(equal(p, pressure)), sine, *constants, *names, ROUGHENS
    return OrderEquation(sp.S.One)(*facts)


def slow(added: sp.Expr) -> Judgement:
    """The slow time, with something added to the function of m."""
    known = slow_time()
    claim = equal(known.claim.lhs, known.claim.rhs + added)
    return SlowTime(claim)(*known.parents)


SMOOTH = assume(DIFFERENTIABLE)
HEIGHT = initial("h")
Case = tuple[Callable[[], Judgement], Callable[[], Judgement], str]

CASES: dict[str, Case] = {
    # ---- another clock held fixed: tau = t/T, N = t/T, m grows with them
    "integrated, with a factor v(tau)": (  # v = tau: u_c = int tau du_a
        lambda: integrate(
            given(equal(du, v * rate("u_a"))), START, given(equal(u_a.subs(t, 0), 0))
        ),
        lambda: integrate(
            given(equal(du, q * rate("u_a"))), START, given(equal(u_a.subs(t, 0), 0))
        ),
        "is constant",
    ),
    "a bound v(tau) of the rate": (  # v = e^-tau
        lambda: grows(given(sp.Ge(du, C * v)), START),
        lambda: grows(given(sp.Ge(du, C * b_0)), START),
        "is constant",
    ),
    "the rate of v(tau) is not zero": (
        lambda: differentiate(given(equal(u_c, h_0 * v))),
        lambda: differentiate(given(equal(u_c, h_0 * b_0))),
        "is differentiable",
    ),
    "growth times v(tau)": (  # v = e^-tau
        lambda: Diverges(w * u_c)(given(sp.Ge(u_c, C * t))),
        lambda: Diverges(q * u_c)(given(sp.Ge(u_c, C * t))),
        "is linear in what grows",
    ),
    "a rate that fades with tau": (  # u_c < C T
        lambda: unbounded(given(equal(du, FALLING))),
        lambda: unbounded(given(equal(du, STEADY))),
        "positive and continuous",
    ),
    "a rate that fades with w(tau)": (
        lambda: unbounded(given(equal(du, C * w))),
        lambda: unbounded(given(equal(du, C * q))),
        "positive and continuous",
    ),
    "a squeeze that widens": (  # w = 1 + tau = u_c/h_0, G = 1
        lambda: squeezed(w),
        lambda: squeezed(h_0),
        "is a constant over",
    ),
    "a limit that is v(tau)": (
        lambda: accumulates(tends(du, C * v)),
        lambda: accumulates(tends(du, C * b_0)),
        "cannot be a limit",
    ),
    "v(tau) over what grows": (  # v = u_c/h_0
        lambda: AtInfinity(equal(forever(h_0 * v / u_c), 0), 1 / u_c)(DEEP),
        lambda: AtInfinity(equal(forever(h_0 * b_0 / u_c), 0), 1 / u_c)(DEEP),
        "bounded fields alone",
    ),
    "the time of a rate with w(tau)": (  # u_c = int C w
        lambda: timed(1 / (C * w), C * w, START),
        lambda: timed(1 / (C * b_0), C * b_0, START, given(sp.Gt(b_0, 0))),
        r"of u_c\(t\) alone",
    ),
    "a drift that grows with N": (  # u_c - C t ~ int U_a/T
        lambda: drifting(t * (du - C) - N * U_a),
        lambda: drifting(t * (du - C) - f_c * U_a),
        "linear in the load",
    ),
    "a drift from a speed that grows": (
        lambda: drifting(t * (du - C * N) - U_a),
        lambda: drifting(t * (du - C * q) - U_a),
        "linear in the load",
    ),
    "time in periods, with a factor N": (  # u_c = h_0 tau v
        lambda: scaled(N * h_0 * v),
        lambda: scaled(h_0 * v),
        "is constant",
    ),
    "contact while the load exceeds what grows": (  # never after t = T U/h_0
        lambda: at_times(h_0 * t / T),
        lambda: at_times(b_0),
        "the load alone",
    ),
    "a rate in contact that fades": (  # u_c < C T
        lambda: at_times(b_0, C / (1 + N) ** 2),
        lambda: at_times(b_0, C / (1 + q) ** 2),
        "positive and continuous",
    ),
    "a fraction that depends on the cycle": (
        lambda: at_times(b_0 * N),
        lambda: at_times(b_0 * q),
        "is constant",
    ),
    # ---- one period later
    "u_c = C t, one period later": (  # C (t + T)
        lambda: one_period_later(given(equal(u_c, C * t))),
        lambda: one_period_later(given(equal(u_c, C * b_0))),
        "at one time",
    ),
    "a mean over the first period": (  # U_a = t
        lambda: one_period_later(defined(U_mean, sp.Integral(U_a, (t, 0, T)) / T)),
        lambda: one_period_later(given(equal(h, h_0 - U_a))),
        "at one time",
    ),
    "a limit at the start": (  # G = t: lim_{t->0} G(t + T) = T
        lambda: one_period_later(tends(G, theta, sp.S.Zero)),
        lambda: one_period_later(given(equal(G, theta))),
        "at one time",
    ),
    # ---- what only words say
    "a differentiable load, forgotten": (  # a square load
        lambda: forget(differentiate(given(equal(h, h_0 - U_a)), SMOOTH), DIFFERENTIABLE),
        lambda: differentiate(given(equal(h, h_0 - U_a)), SMOOTH),
        "the value of a symbol",
    ),
    # ---- initial values depend on data
    "h(0) held fixed while h_0 grows": (  # h(0) = h_0: the limit is 1
        lambda: ParameterLimit(HEIGHT / h_0, h_0)(),
        lambda: ParameterLimit(q.subs(q, f_c) / h_0, h_0)(),
        "data alone",
    ),
    "h(0) held fixed as h_0 varies": (  # h(0) = h_0: the slope is f_c
        lambda: sloped(HEIGHT * f_c, sp.S.Zero),
        lambda: sloped(h_0 * f_c, f_c),
        "data alone",
    ),
    # ---- bound variables
    "capture by the limit of another form": (  # lim M/M = 1
        lambda: by_value(f_c / M, sp.S.One, M),
        lambda: by_value(f_c / M, h_0 / M, h_0),
        "for every M",
    ),
    "a limit inserted under an integral": (  # theta = 1: 1/2, not 1/3
        lambda: Insert(
            equal(
                sp.Integral(theta * forever(G), (theta, 0, 1)), sp.Integral(theta**2, (theta, 0, 1))
            )
        )(tends(G, theta)),
        lambda: Insert(equal(theta * forever(G), theta * b_0))(tends(G, b_0)),
        "for every|no identity|zoo",
    ),
    # ---- what has no value
    "a logarithm of what is negative, integrated": (
        lambda: Identity(equal(integral(sp.log(q**2), -2, -1), integral(2 * sp.log(q), -2, -1)))(),
        lambda: Identity(equal(integral(sp.log(q**2), 1, 2), integral(2 * sp.log(q), 1, 2)))(),
        "q is never",
    ),
    "a factor that is an infinite integral": (
        lambda: Multiply(integral(1 / q, 0, 1))(given(equal(h, u_a))),
        lambda: Multiply(integral(1 / q, 1, 2))(given(equal(h, u_a))),
        "q is never",
    ),
    "a factor that is no limit": (
        lambda: Multiply(sp.Limit(sp.sin(y), y, sp.oo))(given(equal(h, u_a))),
        lambda: Multiply(forever(G))(given(equal(h, u_a)), tends(G, theta)),
        "zoo",
    ),
    "a factor that is no zero": (
        lambda: Multiply(FirstZero(y**2 + 1, y))(given(equal(h, u_a))),
        lambda: Multiply(u_stop)(given(equal(h, u_a))),
        "zoo",
    ),
    "a Bessel function of half an order": (  # y = -1: imaginary
        lambda: Identity(equal(sp.besseli(sp.S.Half, y) + 0, sp.besseli(sp.S.Half, y)))(),
        lambda: Identity(equal(sp.besseli(0, y) + 0, sp.besseli(0, y)))(),
        "zoo",
    ),
    # ---- two wears at one pressure
    "a field of either sign, for a pressure": (  # G = -sqrt(C t/h_0) from some time on
        lambda: by_pressure(G, sp.sqrt(G**2)),
        lambda: by_pressure(p, sp.sqrt(p**2)),
        "p_s is never",
    ),
    "a pressure that may jump": (  # from p to p_max - p, where the wear is the same
        lambda: bent(-1),
        lambda: bent(1),
        "the one root",
    ),
    # ---- rates that do not exist, times before 0
    "the square of a rate": (  # a square load
        lambda: Arithmetic(sp.Ge(rate("U_a") ** 2, 0))(),
        lambda: Arithmetic(sp.Ge(rate("U_a") ** 2, 0))(SMOOTH),
        "Derivative",
    ),
    "a factor that is a rate": (  # h jumps
        lambda: Multiply(rate("h"))(given(equal(u_a, q))),
        lambda: Multiply(rate("u_c"))(given(equal(u_a, q))),
        "Derivative",
    ),
    "the rate of a quantity that jumps, in periods": (  # h = h_0 v, a square wave
        lambda: change_clock(given(equal(h, h_0 * v)), CLOCK),
        lambda: change_clock(given(equal(u_c, h_0 * v)), CLOCK),
        "Derivative",
    ),
    "a branch before the start": (  # u_a < h_0 for t < 0
        lambda: within(-T, h_0),
        lambda: within(sp.S.Zero, h_0),
        "t is never -T",
    ),
    "a load before the start": (  # U_a = e^-t: nobody says what it was
        lambda: given(equal(U_a.subs(t, t - T), U_a)),
        lambda: given(equal(U_a.subs(t, t + T), U_a)),
        "t is never -T",
    ),
    "a rate before the start": (
        lambda: given(equal(sp.Subs(rate("U_a"), t, -T), C)),
        lambda: given(equal(sp.Subs(rate("U_a"), t, T), C)),
        "t is never -T",
    ),
    # ---- averages
    "the average of a pressure that varies with the phase": (
        lambda: averaged(1 + sp.sin(2 * sp.pi * tau) / 2),
        lambda: averaged(1 + q),
        "at given wear and load",
    ),
    "another constant of integration": (  # s_0 is one of them
        lambda: slow(h_0),
        lambda: slow(h_0**6 / m**5),
        "a function of m",
    ),
    "the slow time, with a wear that goes like m": (  # h_0^3 u_c/m^4 is no o(m^-3)
        lambda: slow(h_0**4 * u_c / m**4),
        lambda: slow(h_0**5 / m**4),
        "a function of m",
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_what_got_through_is_refused_and_its_true_neighbour_is_not(name: str) -> None:
    false, true, said = CASES[name]
    with pytest.raises(RuleError, match=said):
        false()
    assert replayed(true()) is None
