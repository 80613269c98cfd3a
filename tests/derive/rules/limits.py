"""Limits in time."""

from __future__ import annotations

import sympy as sp

from derive.hypotheses import CONTINUOUS, PERIODIC
from derive.reals import LAW
from derive.rules.assumption import assume, defined
from derive.rules.drift import LeadingTerm
from derive.rules.growth import AtInfinity, Diverges, intermittent, periodic_bound, unbounded
from derive.rules.inequalities import Arithmetic
from derive.rules.limits import (
    Passes,
    accumulates,
    forever,
    later,
    one_period_later,
    vanishes,
)
from derive.symbols import rate, symbols, t
from tests.derive.judgements import (
    APART,
    BOUNDED,
    DEEP,
    GAP,
    ROUGHENS,
    Family,
    end,
    eq,
    equal,
    ge,
    given,
    gt,
    le,
    lt,
    ne,
    tends,
)

u_c, u_a, U_a, h, G, sigma, sigma_c = symbols("u_c u_a U_a h G sigma sigma_c")
h_0, sigma_c0, f_c, C, T, N, q, b_0, L = symbols("h_0 sigma_c0 f_c C T N q b_0 L")
h_star, U, U_mean, theta, tau, d = symbols("h_star U U_mean theta tau d")
y = sp.Symbol("y", real=True)
v, w = sp.Function("v", real=True)(tau), sp.Function("w", positive=True)(tau)
du = rate("u_c")


PRODUCT = G * h + u_a * h
SQUARES = (PRODUCT**2 - 1) / (PRODUCT + 1) - PRODUCT


def leading_term():
    return LeadingTerm(sp.Eq(sp.log(G), sp.log(q / sigma_c)))(eq(G, q / sigma_c))


FADING, LATER_ON, TOUCHING = sp.exp(-u_c / sigma_c0), sp.exp(t / T), sp.Ge(U_a, b_0)
NOTHING = b_0 / (h_0 - L)
ROUGH, WORN = Arithmetic(sp.Gt(sigma, 0, evaluate=False))(), gt(u_c, 0)
WITH_G = C * (2 + sp.tanh(G * q / (u_c**2 + q**2)))
AT_LAST = Diverges(t)(Arithmetic(sp.Ge(t, t, evaluate=False))())
LOADED = BOUNDED, assume(PERIODIC), assume(CONTINUOUS)
BENDING = C / (1 + u_c**2 / h_star**2)


def some_of_the_time(contact=TOUCHING, on=C, off=sp.S.Zero, part=None, least=sp.S.Zero, *facts):
    """Wear at a rate ``on`` while the load makes contact."""
    law = eq(du, off + sp.Piecewise((on - off, contact), (0, True)))
    share = (
        sp.Integral(sp.Piecewise((1, contact if part is None else part), (0, True)), (t, 0, T)) / T
    )
    named = defined(d, share)
    return intermittent(law, named, ge(u_c, least), assume(PERIODIC), BOUNDED, *facts)


def at_infinity(inside, value=0, *facts):
    return AtInfinity(end(inside, value), 1 / u_c)(DEEP, WORN, *facts)


ODD = LAW(q / u_c) - LAW(-q / u_c) - 2 * q / u_c * sp.diff(LAW(y), y).subs(y, 0)


def curved(order):
    """Return the law's remainder behind its Taylor polynomial of lower order, and its limit."""
    known = sp.S.Zero if order == 1 else u_c / q * sp.diff(LAW(y), y).subs(y, 0)
    expr = (u_c / q) ** order * (LAW(q / u_c) - LAW(0)) - known
    return expr, (sp.diff(LAW(y), y, order) / order).subs(y, 0)


FAMILIES = (
    Family(one_period_later, (
        ge(u_c, h_0), eq(h, h_0 - U_a), eq(du, C), assume(CONTINUOUS),
    ), {
        "u_c = C t, one period later": ("at one time", eq(u_c, C * t)),  # C (t + T)
        # U_a = t
        "a mean over the first period": ("at one time",
            defined(U_mean, sp.Integral(U_a, (t, 0, T)) / T)),
        # sigma_c is small for moments, and not one period later
        "a leading term": ("at one time", leading_term()),
    }),
    Family(lambda expr, least, *facts: Diverges(expr)(ge(u_c, least), *facts), (
        (u_c, h_0 + C * t), (q * u_c - h_0, C * t), (u_c * (1 + sp.Abs(GAP)), C * t, APART),
        (sigma_c0 + f_c * u_c, C * t, ROUGHENS),  # f_c = -0.05
    ), {
        "bounded below by a constant": ("0 > 0", u_c, h_0),  # u_c = h_0
        "u_c - C t": ("linear in a growing field", u_c - C * t, C * t),  # u_c = C t
        "growth times 1 + |0/0|": ("Ne", u_c * (1 + sp.Abs(GAP)), C * t),
        "growth times w(tau)": ("linear in a growing field", w * u_c, C * t),  # w = e^-tau
    }),
    Family(lambda speed, *facts: unbounded(eq(du, speed), *facts), (
        BENDING, (C * (1 + sigma / h_star), le(sigma, h_star), ROUGH), C * q / (1 + f_c**2) ** 2,
        (C * sp.exp(-U_a / h_star), BOUNDED), (C * (1 + u_c / q), ge(u_c, 0)),
    ), {
        # u_c = -q
        "a rate that is positive for positive wear": ("positive and continuous", C * (1 + u_c / q)),
        "a rate with a bound of the wear that moves": ("positive and continuous",
            C * (1 + u_c / q), ge(u_c, -t * C)),
        # u_c < C T
        "a rate that fades with time": ("positive and continuous", C / (1 + t / T) ** 2),
        "a rate that fades with tau": ("positive and continuous", C / (1 + tau) ** 2),
        "a rate that fades with w(tau)": ("positive and continuous", C * w),
        # sigma = h_star e^(-t/T)
        "a rate that goes with a roughness that fades": ("positive and continuous",
            C * sigma / h_star, ROUGH, le(sigma, h_star)),
        "a rate that is not continuous": ("positive and continuous",
            BENDING + sp.Piecewise((C, u_c <= h_star), (0, True))),
        "a rate on both sides": ("solved for the rate", C + rate("u_a")),
    }),
    Family(at_infinity, (
        h_0 * b_0 / u_c, (U_a / u_c, 0, BOUNDED), (h_0 + U_a * h_0 / u_c, h_0, BOUNDED),
        (u_c / (u_c + U_a**2 / q), 1, BOUNDED),  # U_a^2 = q u_c
        curved(1),
    ), {
        "h/u_c with h held fixed": ("h is bounded", h / u_c),  # h = u_c
        "T u_c'/u_c": ("bounded fields alone", T * du / u_c),  # u_c = L e^(t/T)
        "time held fixed as u_c grows": ("bounded fields alone", C * t / u_c),  # u_c = C t
        # U_a = 0, G = q, u_c = L + C t: q/C
        "time times what two fields differ by": ("bounded fields alone", t * (G - U_a) / u_c, 0,
            BOUNDED, le(sp.Abs(G), q)),
        "cycles held fixed as u_c grows": ("N fixed", h_0 * N / u_c),  # u_c = h_0 t/T
        "v(tau) over what grows": ("tau fixed", h_0 * v / u_c),  # v = u_c/h_0
        "U_a has no limit": ("cannot be a limit", U_a + h_0**2 / u_c, U_a, BOUNDED),  # U sin t
        "a logarithm of what grows": ("smooth function at", sp.log(u_c) / u_c),
        "the load divides": ("U_a", 1 / (U_a + h_0 / u_c), 0, BOUNDED),
        "what grows itself": ("is bounded", u_c),
        "the second slope of a law": ("phi", *curved(2)),  # it may have none at 0
        # it is differentiable once
        "the second slope of a law, cancelled": ("is smooth", u_c**2 * ODD),
        # U_a = 0
        "a quotient by the load": ("U_a", h_0 / u_c + (1 / U_a + 1) * U_a - U_a, 1, BOUNDED),
        "a limit that is not reached": ("the limit is 0", q / u_c, 1),
        "a limit with 0/0": ("Ne", q / u_c, GAP),  # h_0 = L
    }),
    Family(lambda inside, small, growth=DEEP: AtInfinity(end(inside, 0), small)(growth), (
        (FADING, FADING),
    ), {
        "what is small is another": ("-> 0 as", FADING, 1 / u_c**2),
        "an exponential of either sign": ("f_c/q > 0", FADING, sp.exp(-f_c * u_c / q)),
        "a root of what is small": ("smooth function at", sp.sqrt(FADING), FADING),
        "a bound of the growth": ("is no limit", U_a / u_c, 1 / u_c, le(u_c, h_0)),
        "a growth that ends": ("-> oo", 1 / u_c, 1 / u_c, tends(u_c, h_0)),
    }),
    Family(lambda low, high, growth=DEEP: vanishes(given(sp.And(low, high)), growth), (
        (sp.Le(G, h_0 / u_c), sp.Ge(G, -h_0 / u_c)),
    ), {
        # u_c = h_0, G = 1
        "a squeeze between constants": ("is no limit", sp.Le(G, h_0 / u_c), sp.Ge(G, -h_0 / u_c),
            ge(u_c, h_0)),
        # w = 1 + tau = u_c/h_0, G = 1
        "a squeeze that widens": ("is a constant over", sp.Le(G, w / u_c), sp.Ge(G, -w / u_c)),
        "a squeeze by the load": ("is a constant over", sp.Le(G, U_a / u_c), sp.Ge(G, -U_a / u_c)),
        "bounds of two": ("encloses", sp.Le(G, h_0 / u_c), sp.Ge(h, 0)),
    }),
    Family(lambda expr, value, *known: Passes(equal(forever(expr), sp.S.Zero + value))(*known), (
        (du / u_c, 0, tends(du, C), DEEP),
        (G / (h_0 / u_c + G), 1, tends(G, theta), DEEP, ne(theta, 0), ne(h_0 / u_c + G, 0)),
        (sp.exp(-G), 1, tends(G, 0)),
        (later(G), theta, tends(G, theta)),
        (later(G + q * sp.tanh(u_c)), theta, tends(G + q * sp.tanh(u_c), theta)),
        (G + NOTHING, theta, tends(G, theta), eq(b_0, 0), APART),
        (2 * u_c - 2 * C * t, 2 * h_0, tends(u_c - C * t, h_0)),
        ((u_c**2 - h**2) / (u_c - h) - 2 * h, theta, tends(u_c - h, theta), ne(u_c, h)),
        (sp.log(G), sp.log(q), tends(G, q), gt(G, 0)),
        (1 / (1 + T / (f_c * t)), 1, AT_LAST, ROUGHENS),
    ), {
        "f_c N/(1 + f_c N)": ("continuous at", 1 / (1 + T / (f_c * t)), 1, AT_LAST),  # f_c = 0
        # G = h_0/u_c
        "u_c G/(h_0 + u_c G)": ("continuous at", G / (h_0 / u_c + G), 1, tends(G, 0), DEEP),
        # G = h_0/u_c
        "e^(-u_c G/h_0)": ("the limit of all", sp.exp(-u_c * G / h_0), 1, tends(G, 0), DEEP),
        "another limit": ("the limit of", 2 * G, theta, tends(G, theta)),
        "a limit that passes, with b_0/0": ("Ne", G + NOTHING, theta, tends(G, theta), eq(b_0, 0)),
        # u_c = h
        "the limit of a sum, with 0/0": ("Ne", (u_c**2 - h**2) / (u_c - h) - 2 * h, theta,
            tends(u_c - h, theta)),
        # h = -1/(G + u_a)
        "a quotient by what another field makes zero": ("Ne", SQUARES, -1, tends(G + u_a, 0)),
        "the limit of a sum of logarithms": ("continuous at", sp.log(G) + G, theta + sp.log(theta),
            tends(G, theta)),
        "a limit of -oo": ("is finite", 2 * G, -sp.oo, tends(G, -sp.oo)),
        # h_0 = L
        "a limit that passes, with 0/0": ("Ne", 2 * G, 2 * theta + GAP / L, tends(G, theta)),
        # theta/e
        "G e^(t/T), one period later": ("the limit of all", LATER_ON * later(G), theta,
            tends(LATER_ON * G, theta)),
        # h_0 + C T
        "u_c - C t, one period later": ("the limit of all", later(u_c) - C * t, h_0,
            tends(u_c - C * t, h_0)),
    }),
    Family(lambda claim, *facts: periodic_bound(Arithmetic(claim)(*facts)), (
        (sp.Lt(U_a, 2 * q), *LOADED, lt(U_a, q)),
    ), {
        "a bound of a load that is no more than periodic": ("continuous load", sp.Gt(G, 0),
            gt(G, q), *LOADED[:2]),
        "a bound of a load that is continuous": ("load of period T", sp.Gt(G, 0),
            gt(G, q), *LOADED[::2]),
        "no bound": ("bounded by U", sp.Gt(G, 0), gt(G, q), *LOADED[1:]),
        "a claim about the bound": ("said of U", sp.Le(U_a, U), *LOADED),  # U_a = 2 U
        # U_a = h_0 = U/2
        "a bound of which more is said": ("said of U", sp.Lt(U_a, h_0), *LOADED, lt(U, h_0)),
    }),
    Family(accumulates, (tends(du, 0), tends(du, C * b_0)), {
        "a limit that is only bounded": ("is no limit", ge(du, C)),  # u_c = 2 C t
        "a rate without limit": ("is finite", tends(du, sp.oo)),
    }),
    Family(some_of_the_time, (
        (), (sp.Ge(2 * U_a, b_0 * q), C / (1 + q) ** 2),
        (TOUCHING, WITH_G, 0, None, 0, le(sp.Abs(G), q)),
    ), {
        # sigma = q h_star/u_c: the rate is C (1 + 1/(1 + q))
        "a rate in contact with a field that may fade": ("the rate in contact", TOUCHING,
            C * (1 + 1 / (1 + sigma * u_c / h_star**2)), 0, None, 0, le(sigma, h_star), ROUGH),
        # never after t = T U/h_0
        "contact while the load exceeds what grows": ("the load alone", sp.Ge(U_a, h_0 * t / T)),
        "contact by the wear": ("the load alone", sp.Ge(U_a, u_c)),
        # later for half of a period
        "contact where t U_a exceeds a level": ("the load alone", sp.Ge(t * U_a, h_0 * T)),
        "a fraction that depends on the cycle": ("N fixed", sp.Ge(U_a, b_0 * N)),
        "another fraction": ("fraction of the period", TOUCHING, C, 0, sp.Ge(U_a, 2 * b_0)),
        # u_c < C T
        "a rate in contact that fades": ("positive and continuous", TOUCHING, C / (1 + N) ** 2),
        "a rate in contact of either sign": ("positive and continuous", TOUCHING, C * f_c),
        "a rate in contact with the load": ("the rate in contact", TOUCHING,
            C * (1 + U_a**2 / U**2)),
        # G = u_c^2
        "a rate in contact with a field that grows": ("G is bounded", TOUCHING, WITH_G),
        "wear out of contact": ("0 out of contact", TOUCHING, C, C / 2),
        "a wear that no constant bounds": ("above a constant", TOUCHING, C, 0, None, G),
    }),
)  # fmt: skip
