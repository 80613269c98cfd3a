"""What a hostile reader got through the public rules once, and a true neighbour of each.

Every false statement follows a comment with the model in which it fails.
"""

from __future__ import annotations

from collections.abc import Callable

import pytest
import sympy as sp

from derive.hypotheses import Kind
from derive.kernel import Judgement, RuleError, infer, replayed
from derive.laws import GENERAL, r
from derive.rules.algebra import (
    Alike,
    Consequence,
    Identity,
    Multiply,
    Solve,
    discharge,
    forget,
    restrict,
    substitute,
)
from derive.rules.assumption import assume, defined
from derive.rules.averages import Averaging
from derive.rules.calculus import ParameterLimit, differentiate, grows, rigid
from derive.rules.data import Differentiated
from derive.rules.drift import LogarithmicGrowth, first_order, logarithmic_drift
from derive.rules.inequalities import Arithmetic, LogarithmicSlope, Monotone
from derive.rules.limits import AtInfinity, forever
from derive.rules.reading import CONSTANT, SINE, replaced
from derive.rules.solutions import Lambert
from derive.symbols import initial, rate, symbol, symbols, t
from tests.derive.judgements import (
    BOUNDED,
    CONSTANTLY,
    DEEP,
    FIRST_DRIFT,
    GROWING,
    RATE,
    ROUGHENS,
    SLOPE,
    START,
    averaged_as,
    discharged,
    drift_premises,
    end,
    eq,
    equal,
    first_order_terms,
    forgotten,
    ge,
    given,
    gt,
    integral,
    le,
    lt,
    ne,
    opened,
    supposed,
    tends,
    timed,
)

u_c, u_a, U_a, h, G = symbols("u_c u_a U_a h G")
h_0, sigma_c0, f_c, C, T, N, q, b_0, u_s = symbols("h_0 sigma_c0 f_c C T N q b_0 u_s")
U, u_cum, theta, x_inf, tau, M, R, L, rho, w_1 = symbols("U u_cum theta x_inf tau M R L rho w_1")
y = sp.Symbol("y", real=True)


AT_ONE, EXACTLY_ONE = eq(f_c, 1), eq(2 * f_c, 2)
FIRST_WAVE = -(1 - theta) * U * rho * sp.cos(2 * sp.pi * tau) / sp.pi


def approach(rest: sp.Expr) -> Judgement:
    ratio = (h - U_a) / sigma_c0
    law, limit = eq(rate("u_c"), C * sp.exp(-ratio)), tends(ratio, q)
    speed = tends(rate("u_c"), C * sp.exp(-q))
    return first_order(law, tends(u_c * (ratio - q) - rest, 0), limit, speed, BOUNDED)


def sloped(*facts: Judgement) -> Judgement:
    return Differentiated(sp.Eq(SLOPE, h_0, evaluate=False), f_c)(GROWING, *facts)


def divided(*facts: Judgement) -> Judgement:
    """Return u_a = h_0, from a product with f_c = 1, which meets f_c != 0."""
    product = Solve(u_a)(eq(f_c * u_a, f_c * h_0), facts[0])
    return discharge(product, facts[0].hypotheses[0], *facts[1:])


Case = tuple[Callable[[], Judgement], Callable[[], Judgement], str]
KINKED = sp.Piecewise((x_inf, x_inf < 0), (x_inf - 1, True))
WHOLE = sp.Piecewise((1 / f_c, sp.Ne(f_c, 0)), (0, True))

CASES: dict[str, Case] = {
    # ---- what has no value
    "b_0 = ln f_c, forgotten": (  # f_c = -1
        lambda: forgotten(sp.Eq(b_0, sp.log(f_c)), sp.Gt(f_c, 0)),
        lambda: forgotten(sp.Eq(b_0, sp.log(h_0 + 1)), sp.Gt(h_0, -1, evaluate=False)),
        "f_c > 0",
    ),
    "(ln f_c)^2 >= 0 is not met where it has no value": (  # f_c = -1
        lambda: discharged(sp.Ge(sp.log(f_c) ** 2, 0, evaluate=False), sp.Gt(f_c, 0), START),
        lambda: discharged(sp.Ge(sp.log(f_c) ** 2, 0, evaluate=False), sp.Gt(f_c, 0), ROUGHENS),
        "f_c > 0",
    ),
    "a branch that is not taken": (  # f_c = 0, G = 0
        lambda: Arithmetic(sp.Ne(f_c, 0))(eq(G, WHOLE)),
        lambda: Arithmetic(sp.Ne(f_c, 0))(eq(G, 1 / f_c)),
        "Ne",
    ),
    "an integrand": (  # theta = -1
        lambda: Arithmetic(sp.Gt(theta, 0))(integral(sp.log(theta), 1)),
        lambda: Arithmetic(sp.Gt(theta, 0))(eq(G, sp.log(theta))),
        "theta > 0",
    ),
    "a bound that has no value": (  # f_c = -1
        lambda: infer(
            LogarithmicSlope(sp.Lambda(y, sp.exp(y)), theta, x_inf, 4 + sp.log(f_c) ** 2)
        ),
        lambda: infer(LogarithmicSlope(sp.Lambda(y, sp.exp(y)), theta, x_inf, 4 + f_c**2)),
        "f_c > 0",
    ),
    "the pole inside a contact law": (  # y = -1, 1
        lambda: Monotone(sp.Lambda(y, GENERAL.phi.subs(r, -1 / y)))(ge(x_inf, theta)),
        lambda: Monotone(sp.Lambda(y, GENERAL.phi.subs(r, -y)))(ge(x_inf, theta)),
        "monotone",
    ),
    # ---- bound variables
    "a branch under an integral": (  # 1, not 3
        lambda: restrict(integral(sp.Piecewise((1, theta < 0), (0, True))), given(theta < 0)),
        lambda: restrict(integral(sp.Piecewise((1, f_c < 0), (0, True))), given(f_c < 0)),
        "for every",
    ),
    "a modulus under an integral": (  # int_-1^2 |theta|
        lambda: restrict(integral(sp.Abs(theta)), ge(theta, 0)),
        lambda: restrict(integral(sp.Abs(x_inf) * theta), ge(x_inf, 0)),
        "for every",
    ),
    "capture by an integral": (  # theta = 1: G = 3, not 3/2
        lambda: substitute(integral(b_0), eq(b_0, theta)),
        lambda: substitute(integral(b_0), eq(b_0, x_inf)),
        "for every",
    ),
    "capture by a limit": (  # lim f_c/N = 0, lim N/N = 1
        lambda: substitute(ParameterLimit(f_c / M, M)(), eq(f_c, M)),
        lambda: substitute(ParameterLimit(f_c / M, M)(), eq(f_c, b_0)),
        "for every",
    ),
    "under the derivative with respect to a datum": (  # d b_0/d f_c = 0
        lambda: substitute(sloped(), eq(u_cum, b_0)),
        lambda: substitute(sloped(), eq(h_0, b_0)),
        "for every",
    ),
    # ---- time
    "the rate of the number of cycles": (  # u_c = h_0 t/T
        lambda: differentiate(eq(u_c, h_0 * N)),
        lambda: differentiate(eq(u_c, h_0 * t / T)),
        "differentiable",
    ),
    "the number of cycles held fixed": (  # u_c = C t^2/(2 T)
        lambda: grows(ge(rate("u_c"), C * N), START),
        lambda: grows(ge(rate("u_c"), C), START),
        "constant",
    ),
    "time held fixed as u_c grows": (  # u_c = C t
        lambda: AtInfinity(end(C * t / u_c, 0), 1 / u_c)(DEEP),
        lambda: AtInfinity(end(C * T / u_c, 0), 1 / u_c)(DEEP),
        "bounded fields alone",
    ),
    "cycles held fixed as u_c grows": (  # u_c = h_0 t/T
        lambda: AtInfinity(end(h_0 * N / u_c, 0), 1 / u_c)(DEEP),
        lambda: AtInfinity(end(h_0 / u_c, 0), 1 / u_c)(DEEP),
        "bounded fields alone",
    ),
    "a deviation that grows with time": (  # U_a = sin(t)/sqrt(t)
        lambda: approach(t * U_a / T),
        lambda: approach(U_a),
        "linear in bounded",
    ),
    "a field held fixed while a datum grows": (  # u_c depends on h_0
        lambda: ParameterLimit(u_c * h_0 / (1 + h_0), h_0)(),
        lambda: ParameterLimit(f_c * h_0 / (1 + h_0), h_0)(),
        "data alone",
    ),
    "a name held fixed while a datum grows": (  # b_0 = sigma_c0/f_c - h_0
        lambda: ParameterLimit(b_0 / h_0, h_0)(),
        lambda: ParameterLimit(sigma_c0 / h_0, h_0)(),
        "data alone",
    ),
    # ---- pieces
    "solved across a jump": (  # x_inf = -1/2
        lambda: Solve(x_inf)(eq(KINKED, theta)),
        lambda: Solve(x_inf)(eq(x_inf - 1, theta)),
        "linear in",
    ),
    "a time that jumps": (  # u_c = 2
        lambda: timed(sp.Piecewise((1 / C, u_s < 1), (5 / C, True)), C, START),
        lambda: timed(1 / C, C, START),
        "smooth function",
    ),
    "a start below zero": (  # u_c = -1/2
        lambda: timed(u_s / (C * q), C * q / sp.Abs(u_c), eq(initial("u_c"), -1), low=-1),
        lambda: timed(1 / C, C, eq(initial("u_c"), 1), low=1),
        "missing premise",
    ),
    # ---- of the false statements that were known, those without a case elsewhere
    "strictness in a limit": (  # h = u_a
        lambda: Arithmetic(sp.Gt(h, u_a))(gt(h + q / M, u_a)),
        lambda: Arithmetic(sp.Gt(h, u_a))(ge(h - q, u_a)),
        r"h\(t\) > u_a",
    ),
    "a part of an or": (  # u_a = 2 q
        lambda: Arithmetic(sp.Lt(u_a, q))(lt(sp.Min(u_a, h), q)),
        lambda: Arithmetic(sp.Lt(u_a, q))(lt(sp.Max(u_a, h), q)),
        "u_a",
    ),
    "the converse": (  # u_a = h = 0
        lambda: Alike(sp.Equivalent(sp.Gt(u_a, q), sp.Lt(h, q)))(),
        lambda: Alike(sp.Equivalent(sp.Gt(u_a, q), sp.Lt(q - u_a, 0)))(),
        "differences",
    ),
    "a deviation that grows like the root of the wear": (
        lambda: approach(U_a * sp.sqrt(1 + u_c**2 / q**2)),
        lambda: approach(2 * U_a),
        "linear in bounded|is bounded",
    ),
    "a drift from a bound of the limit": (  # u_c = C t - ln(1 + t)
        lambda: logarithmic_drift(
            le(forever(t * (rate("u_c") - C) - U_a), 0), *drift_premises()[1:]
        ),
        lambda: logarithmic_drift(*drift_premises()),
        "is no limit",
    ),
    "theta has f_c": (  # theta = tanh(4 - 2/f_c)
        lambda: Differentiated(equal(SLOPE, 0), f_c)(eq(u_cum, h_0 * (1 + theta) / 2)),
        lambda: sloped(),
        "data alone",
    ),
    "the other branch of Lambert's function": (  # u_c = q/3
        lambda: Lambert(-u_c / q)(eq(-u_c / q * sp.exp(-u_c / q), -t / T)),
        lambda: Lambert(q)(eq(q * sp.exp(q), theta)),
        "/q >= 0",
    ),
    "the tail of one solid and the wear of the other": (  # u_a = 0
        lambda: LogarithmicGrowth(q)(tends(rate("u_a") * sp.exp((u_c - U_a) / q), C), assume(SINE)),
        lambda: LogarithmicGrowth(q)(tends(rate("u_c") * sp.exp((u_c - U_a) / q), C), assume(SINE)),
        "the limit of exp",
    ),
    "a load that is constant under no condition": (  # sin t
        lambda: discharge(differentiate(CONSTANTLY), CONSTANT, START),
        lambda: differentiate(CONSTANTLY),
        "missing premise",
    ),
    "a special case for every f_c": (  # f_c = 1/2, u_a = 1, h = 1/2
        lambda: discharge(substitute(eq(h, f_c * u_a), AT_ONE), AT_ONE.hypotheses[0], ROUGHENS),
        lambda: discharge(substitute(eq(h, f_c * u_a), AT_ONE), AT_ONE.hypotheses[0], EXACTLY_ONE),
        r"Eq\(f_c, 1\)",
    ),
    "what was divided by f_c = 1, as a step for f_c = 0": (  # 0 = 0, 2 != 1
        lambda: forget(divided(ne(f_c, 0), AT_ONE), AT_ONE.hypotheses[0]),
        lambda: divided(ne(f_c, 0), AT_ONE),
        "f_c occurs nowhere else",
    ),
    "zero is not one": (
        lambda: Identity(equal(sp.log(f_c**2) - sp.log(f_c**2), 1))(),
        lambda: Identity(equal(sp.log(2 * q) - sp.log(q), sp.log(2)))(),
        "no identity",
    ),
    "an area that is an oscillation": (  # R L is whatever it is
        lambda: Averaging(sp.Eq(R * L, FIRST_WAVE))(first_order_terms()),
        lambda: Averaging(sp.Eq(w_1, FIRST_WAVE))(first_order_terms(), averaged_as(FIRST_DRIFT)),
        "by the mean",
    ),
    "a drift that is 0/0 for f_c = 1": (
        lambda: averaged_as(FIRST_DRIFT + (f_c**2 - 1) / (f_c - 1) - f_c - 1),
        lambda: averaged_as(FIRST_DRIFT),
        "f_c - 1",
    ),
    "an angle that is the scaled rate": (  # theta = 0
        lambda: Consequence(sp.Eq(theta, C * T / q))(Multiply(T / q)(RATE)),
        lambda: Consequence(sp.Eq(rate("u_c") * T / q, C * T / q))(Multiply(T / q)(RATE)),
        "does not become",
    ),
    # ---- what is said of the world
    "two definitions of one name": (  # h_0 = 1
        lambda: Arithmetic(sp.Eq(h_0, 0))(defined(b_0, h_0), defined(b_0, 2 * h_0)),
        lambda: Arithmetic(sp.Eq(h_0, 0))(defined(b_0, h_0), eq(b_0, 2 * h_0)),
        "two definitions",
    ),
    "two definitions that make a circle": (  # h_0 = 1
        lambda: Arithmetic(sp.Eq(h_0, 0))(defined(b_0, theta + h_0), defined(theta, b_0 + 0)),
        lambda: Arithmetic(sp.Eq(h_0, 0))(defined(b_0, theta + h_0), eq(theta, b_0)),
        "circle of definitions",
    ),
    "words about the load": (
        lambda: rigid(opened(assume(supposed(sp.true, Kind.LOAD)))),
        lambda: rigid(opened(ROUGHENS)),
        "nothing else is said",
    ),
    "a slope at a value of the datum": (  # called a property of the load
        lambda: sloped(assume(supposed(sp.Eq(f_c, 1), Kind.LOAD))),
        lambda: sloped(),
        "may vary",
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_what_got_through_once_is_refused_and_its_true_neighbour_is_not(name: str) -> None:
    false, true, said = CASES[name]
    with pytest.raises(RuleError, match=said):
        false()
    assert replayed(true()) is None


def test_what_holds_at_every_time_is_inserted_under_time() -> None:
    """t may be bound: an equality of fields holds at every time."""
    mean = sp.Integral(U_a, (t, 0, T))
    assert replaced(mean, U_a, U * sp.sin(t)) == sp.Integral(U * sp.sin(t), (t, 0, T))
    assert replaced(rate("u_c"), u_c, symbol("u_a")) == rate("u_a")
