"""Separation of variables, primitives, roots."""

from __future__ import annotations

import sympy as sp

from derive.claims import Continuous, FirstZero
from derive.hypotheses import CONTINUOUS
from derive.rules.algebra import Insert
from derive.rules.assumption import assume, defined
from derive.rules.calculus import differentiate
from derive.rules.inequalities import Arithmetic
from derive.rules.solutions import ByParts, FirstRoot, Lambert, Separate, follows
from derive.symbols import initial, rate, symbols, t
from tests.derive.judgements import (
    APART,
    CONSTANTLY,
    GAP,
    PIN_START,
    RATE,
    ROUGHENS,
    START,
    Family,
    each,
    eq,
    equal,
    ge,
    given,
    gt,
    le,
    lt,
    ne,
    timed,
)

u_c, u_a, U_a, p, h, G = symbols("u_c u_a U_a p h G")
h_0, f_c, C, L, T, q, b_0, U, h_star = symbols("h_0 f_c C L T q b_0 U h_star")
p_max, theta, x_inf, tau, u_stop = symbols("p_max theta x_inf tau u_stop")
p_s, u_s, N = symbols("p_s u_s N")
Q, w_0 = sp.Rational(3, 2), sp.Symbol("w_0", real=True)
x, z = sp.Symbol("x", positive=True), sp.Symbol("z", real=True)
v, w = sp.Function("v", real=True)(tau), sp.Function("w", positive=True)(tau)
du = rate("u_c")

SQUARE, TURNS = eq(G, u_c**2 / L**2), ne(rate("G"), 0)
RESTS, JUMPS = 1 / (C * sp.sqrt(1 - u_s / L)), sp.tanh(1 / u_s)
WORN = equal(t, sp.Integral(1 / C, (u_s, 0, u_c)))


def by_pressure(g=-h_0 / (C * p_s), wear=U_a - h_0 * p / p_max):
    """Return the time at which the pressure has a value, with one thing wrong."""
    claim = equal(t, sp.Integral(g, (p_s, initial("p"), p)))
    root = eq(p, p_max * (U_a - u_c) / h_0)
    return Separate(claim)(eq(du, C * p / p_max), eq(u_c, wear), root, CONSTANTLY, gt(p, 0))


def by_size(field, size):
    """Return the time at which a field has a value, where wear is a multiple of its size."""
    root = eq(p, p_max * u_c / h_0) if field == p else START
    claim = equal(t, sp.Integral(h_0 / (C * p_max), (p_s, field.subs(t, 0), field)))
    return Separate(claim)(RATE, eq(u_c, h_0 * size / p_max), root, CONSTANTLY)


def bent(bend):
    """Return the time at which the pressure has a value, where wear bends as it grows."""
    s, first = p / p_max, initial("p") / p_max
    begin = first + bend * first**2
    wear, root = h_0 * (s + bend * s**2 - begin), p_max * (u_c / h_0 + begin - bend * s**2)
    slope = h_0 / (C * p_s) * (1 + 2 * bend * p_s / p_max)
    claim = equal(t, sp.Integral(slope, (p_s, initial("p"), p)))
    moving = follows(eq(p, root), CONSTANTLY)
    return Separate(claim)(eq(du, C * s), eq(u_c, wear), moving, gt(p, 0))


def by_pin(speed, wear, *facts):
    """Return the time as an integral over the wear of the pin, which that of the bearing is of."""
    claim = equal(C * t, sp.Integral(1, (u_s, 0, u_a)))
    law = Insert(equal(du, speed))(eq(du, speed), *facts)
    return Separate(claim)(law, eq(u_c, wear), PIN_START, CONSTANTLY)


def by_another_clock(now, size):
    """Return the time by an integral from a field at another clock to itself."""
    claim = equal(t, sp.Integral(size / C, (u_s, now, now)))
    return Separate(claim)(RATE, eq(u_c, size * now), CONSTANTLY, given(Continuous(now)))


FAMILIES = (
    Family(by_another_clock, (), {
        # u_c = C t, and v = tau at tau = t/T, L = C T
        "a wear by the phase": ("is continuous", v, L),
        # N = t/T
        "a wear by the number of cycles": ("is continuous", u_c.subs(t, N * T), sp.S.One),
    }),
    Family(by_pin, (
        (C, u_a), (f_c * C, f_c * u_a, ne(f_c, 0)),
        (2 * C * (u_a / h_0 + q), u_a**2 / h_0 + 2 * q * u_a, ge(u_a, 0)),
    ), {
        # u_a = 0
        "a wear that does not change": ("moves with", sp.S.Zero, h_0),
        # u_a = u_c = 0
        "a wear that rests where it begins": ("moves with", 2 * C * u_a / h_0, u_a**2 / h_0),
        # f_c = 0, u_a = 0
        "a growth that may vanish": ("moves with", f_c * C, f_c * u_a),
    }),
    Family(lambda law, claim=WORN: Separate(claim)(law, START, CONSTANTLY), (RATE,), {
        "a multiple of the rate": ("no rate", eq(2 * du, C)),  # u_c = C t/2
        "a rate bounded below": ("no equality", ge(du, C)),
        "the rate of the other solid": ("alone", eq(rate("u_a"), C)),
        "no integral": ("one integral", RATE, sp.Eq(t, u_c)),
    }),
    Family(lambda g, speed, start=START, *facts: timed(g, speed, start, *facts), (
        (1 / (C * b_0), C * b_0, START, given(b_0 > 0)),
        (h_star / (C * U), C * U / h_star),  # U_a = t
        (h_0 / (C * U_a), C * U_a / h_0, START, given(U_a > 0)),  # U_a = t: u_c = t^2/2
    ), {
        # u_c = 2
        "a time that jumps": ("smooth function", sp.Piecewise((1 / C, u_s <= 1), (0, True)), C),
        # u_c = int C w
        "the time of a rate with w(tau)": (r"of u_c\(t\) alone", 1 / (C * w), C * w),
        "a rate of either sign": ("Ne", 1 / f_c, f_c),
        # u_c = L from t = 2 L/C on, where G is 2 L/C
        "a wear that may rest, where the integral has a value": ("L", RESTS,
            1 / RESTS.subs(u_s, u_c), START, eq(G, sp.Integral(RESTS, (u_s, 0, u_c)))),
        "twice the time": ("separates", 2 / C, C),
        "another start": ("is continuous", 1 / C, C, eq(initial("u_c"), 1)),
    }),
    Family(lambda *facts: ByParts(sp.log(u_s - C * T * tau + q))(
        eq(G, sp.Integral(1 / (u_s - C * T * tau + q), (u_s, 0, u_c))), *facts), (
        (ge(u_c, 0), lt(C * T * tau, h), le(h, q)),
    ), {
        # from 0 on it need not be above C T tau
        "above what grows with tau": ("missing premise", ge(u_c, C * T * tau), START),
    }),
    Family(each, (lambda: timed(1 / C, C, eq(initial("u_c"), 1), low=1),), {
        # x_inf = -1, theta = 2: tanh(1/2) + tanh(1) - 2
        "a primitive that jumps, whose integral has a value": ("Ne", lambda: ByParts(JUMPS)(
            eq(G, sp.Integral(sp.diff(JUMPS, u_s), (u_s, x_inf, theta))),
            eq(h, sp.Integral(JUMPS, (u_s, x_inf, theta))))),
        # h_0 = 0, b_0 = -1: 0
        "a root of a product at an end": ("b_0 >= 0", lambda: ByParts((u_s - theta) ** Q)(
            eq(G, sp.Integral(Q * sp.sqrt(u_s - theta), (u_s, theta, theta + b_0 * h_0))),
            ge(b_0 * h_0, 0))),
        # p jumps from 0 to p_max
        "a pressure that may be zero": ("only root",
            lambda: follows(eq(p, sp.Piecewise((p_max, p >= p_max / 2), (0, True))))),
        "an integral over time by parts": ("over time", lambda: ByParts(t**2 / 2)(
            eq(G, sp.Integral(t, (t, 0, T))))),
        # u_c = -1/2
        "a start below zero": ("missing premise",
            lambda: timed(u_s / (C * q), C * q / sp.Abs(u_c), eq(initial("u_c"), -1), low=-1)),
    }),
    Family(by_pressure, ((),), {
        "a wear with a kink": ("smooth functions", -h_0 / (C * p_s), U_a - sp.Abs(b_0 - p)),
        "twice the time, by pressure": ("separates", -2 * h_0 / (C * p_s)),
    }),
    Family(by_size, ((p, sp.sqrt(p**2)),), {
        # G = -sqrt(C t/h_0) from some time on
        "a field of either sign": ("p_s is never", G, sp.sqrt(G**2)),
    }),
    Family(bent, (1,), {
        # from p to p_max - p, where the wear is the same
        "a pressure that may jump": ("the only root", -1),
    }),
    Family(follows, (
        (eq(p, p_max * (U_a - u_c) / h_0), CONSTANTLY), (eq(p, q * U_a), assume(CONTINUOUS)),
    ), {
        # p = p_max at t = 0 alone
        "the pressure wherever wear has a rate": ("the only root", Arithmetic(equal(p, q * u_c))(
            eq(p, q * u_c + h_0 * (du - C)), RATE)),
        # p = 2 p_max at t = 1 alone, where u_c has the rate 0
        "the only root wherever wear has a rate": ("the only root",
            eq(p, p - G * (p - p_max)), given(Continuous(G)), Arithmetic(sp.Gt(G, 0))(
                eq(G, T * du / h_0), gt(du, 0))),
        "the only root by the name of a clock": ("the only root",
            eq(p, p - G * (p - p_max)), given(Continuous(G)), Arithmetic(sp.Gt(G, 0))(
                eq(G, z), defined(z, T * du / L), gt(du, 0))),
        "the only root where G has a rate": ("the only root",
            eq(p, p - G * (p - p_max)), SQUARE, Arithmetic(sp.Gt(G, 0))(
                differentiate(SQUARE), SQUARE, TURNS)),
        # 0^0 at the start of u_c = exp(-1/t), u_a = t
        "a pressure that jumps with tau": ("is continuous", eq(p, q * h), eq(h, h_0 * v)),
        "a pressure that jumps with the load": ("U_a.* is continuous", eq(p, q * U_a)),
    }),
    Family(lambda *facts: ByParts(p_s - p_max * sp.log(p_max - p_s))(
        eq(G, sp.Integral(1 + p_max / (p_max - p_s), (p_s, initial("p"), p))), *facts), (
        (follows(eq(p, q * U_a), assume(CONTINUOUS)), given(p < p_max)),
    ), {
        # from p_max/2 to 2 p_max in a jump
        "between values of a pressure that jumps": ("p_max", given(p < p_max)),
        "beyond the largest pressure": ("p_max", follows(eq(p, q * U_a), assume(CONTINUOUS))),
    }),
    Family(lambda bound: ByParts(-1 / u_s)(eq(G, sp.Integral(u_s**-2, (u_s, u_c.subs(t, 0), u_c))),
        bound), (gt(u_c, 0),), {
        # u_c = L (t/T - 1)
        "over a pole where wear has no rate": ("Ne", Arithmetic(sp.Ge(u_c**-2, 0, evaluate=False))(
            eq(u_c, T * rate("u_a")), ne(rate("u_a"), 0))),
        "over a pole where the square has no rate": ("Ne",
            Arithmetic(sp.Ge(u_c**-2, 0, evaluate=False))(differentiate(SQUARE), TURNS)),
    }),
    Family(lambda apart: ByParts(-1 / (t - T))(
        eq(G, sp.Integral((t - T) ** -2, (t, 0, 2 * T))), apart), (), {
        "over a pole where another wear has no rate": ("no integral over time",
            ne(rate("u_a") * (t - T), 0)),
        # u_c = C (t - T)
        "over a pole at an instant without a rate": ("no integral", Arithmetic(sp.Ne(t - T, 0))(
            eq(u_c, C * (t - T)), differentiate(SQUARE), TURNS)),
    }),
    Family(lambda primitive, body, s=p_s, low=1,
        *facts: ByParts(primitive)(eq(G, sp.Integral(body, (s, low * L, q))), *facts), (
        (p_s**2 / 2, p_s), (-1 / p_s, p_s**-2),
        (-1 / u_s, u_s**-2, u_s, f_c, ROUGHENS),  # across 0
    ), {
        "the primitive of another function": ("has the derivative", p_s**2, p_s),
        "a primitive that jumps": ("Ne|without", -1 / u_s, u_s**-2, u_s, -1),  # from -1 to 1
        "a primitive that may have no value": ("Ne", 1 / b_0, p_s),
    }),
    Family(lambda value, known, *facts: Lambert(value)(known, *facts), (
        (q, eq(q * sp.exp(q), theta)), (q + sp.Abs(GAP), eq(q * sp.exp(q), theta), APART),
        (f_c, eq(f_c * sp.exp(f_c), theta), ROUGHENS),  # f_c < 0
    ), {
        # u_c = q/3
        "the other branch of W": ("/q >= 0", -u_c / q, eq(-u_c / q * sp.exp(-u_c / q), -t / T)),
        "W with 0/0": ("Ne", q + sp.Abs(GAP), eq(q * sp.exp(q), theta)),
        "an exponential of another": ("w e", q, eq(q * sp.exp(h), theta)),
    }),
    Family(lambda function, factor=sp.S.One, *facts: FirstRoot(FirstZero(function, x),
        factor)(*facts), (
        h_star - x, (f_c - x, sp.S.One, ROUGHENS),
    ), {
        "a cubic": ("is quadratic", h_star - x**3),
        "a pole before the root": ("Ne", (h_star - x) / (x - 1), x - 1),
        "a factor of either sign": ("f_c > 0", h_star - x, f_c),
        "a start below the root": ("f_c > 0", f_c - x),
        "a factor that vanishes there": ("missing premise", h_star - x, h_star - x),
    }),
    Family(lambda zero: FirstRoot(zero, sp.S.One)(), (FirstZero(1 - w_0, w_0),), {
        "no first zero": ("is a first zero", h_star),
        # no value for f_c = -1
        "a logarithm times what is 0 from 0 on": ("f_c > 0",
            FirstZero((sp.Abs(w_0) - w_0) * sp.log(f_c) + 1 - w_0, w_0)),
    }),
)  # fmt: skip
