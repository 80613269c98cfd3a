"""Algebra at an instant, hypotheses that are met, names and their definitions."""

from __future__ import annotations

import sympy as sp

from derive.claims import Continuous, FirstZero
from derive.hypotheses import PERIODIC, SINE, Kind
from derive.laws import EXPONENTIAL, TANH
from derive.note.model import ARCHARD, CLOSURE, at_every_closure, contact
from derive.note.model import START as STARTS
from derive.reals import LAW as PHI
from derive.rules.algebra import Consequence, Insert, Solve, substitute
from derive.rules.assumption import assume, defined
from derive.rules.calculus import RIGID, SPRINGS, differentiate
from derive.rules.inequalities import Arithmetic
from derive.rules.limits import forever, later, one_period_later
from derive.rules.solutions import FirstRoot
from derive.symbols import initial, rate, symbol, symbols, t
from tests.derive.judgements import (
    ALMOST,
    APART,
    CONSTANTLY,
    CYCLING,
    GAP,
    RATE,
    ROUGHENS,
    SLOPE,
    START,
    Family,
    each,
    end,
    eq,
    equal,
    ge,
    given,
    gt,
    integral,
    le,
    logarithmic,
    lt,
    ne,
    sloped,
    supposed,
    tends,
    times,
)

u_c, u_a, U_a, h, p, G, sigma = symbols("u_c u_a U_a h p G sigma")
h_0, f_c, C, T, N, q, b, b_0, M, L = symbols("h_0 f_c C T N q b b_0 M L")
theta, x_inf, u_cum, kappa, U_mean, u_stop, tau = symbols(
    "theta x_inf u_cum kappa U_mean u_stop tau"
)
dU = rate("U_a")
x, y = sp.symbols("x y", real=True)
v = sp.Function("v", real=True)(tau)

WEARS, STEADY = eq(G, u_c), given(Continuous(p))
SIDES = eq(h, u_a)
FALLING = lt(f_c, 0)
CLOCK = sp.Function("X", nonnegative=True)(t)
NAMED = assume(supposed(equal(G, b_0), Kind.DEFINITION))
TRIVIAL = sp.Ge(h_0, 0, evaluate=False)
REPEATING = assume(PERIODIC)
ABOVE, AT_ONE, EXACTLY_ONE = gt(h, f_c), eq(f_c, 1), eq(2 * f_c, 2)
MEAN_LOAD = defined(U_mean, sp.Integral(U_a, (t, 0, T)) / T)
SPEED = Arithmetic(equal(T / q * rate("u_c"), T / q * C))(RATE)
IN_PIECES = eq(G, sp.Piecewise((q, h <= L), (0, True)))
KINKED = x_inf - sp.Piecewise((1, x_inf >= 0), (0, True))
BRANCHED = sp.LambertW(-h_0 - sp.exp(-1))
OVER_ZERO = equal((h - u_a) / (u_c - h_0), 1)


def under(body):
    return sp.Integral(body, (theta, 0, L))


def over_a_period(body):
    return sp.Integral(body, (t, 0, T))


def called(relation, kind):
    return assume(supposed(relation, kind))


def defined_as(relation):
    return called(relation, Kind.DEFINITION)


def touching(law):
    touches = given(sp.Le(h, 3 * sigma))
    return Arithmetic(at_every_closure(law))(called(contact(law), Kind.MODEL), touches)


PIN_WEARS, SMOOTH_PIN = called(ARCHARD[0], Kind.MODEL), eq(symbol("sigma_a"), 0)
AS_WORN = Insert(equal(h, h_0))(eq(h, h_0), called(STARTS[1], Kind.INITIAL), SMOOTH_PIN)


FAMILIES = (
    Family(substitute, (
        (SIDES, eq(u_a, h_0)), (integral(b_0), eq(b_0, x_inf)),
        (RATE, eq(u_c, u_a)), (MEAN_LOAD, eq(U_a, h_0 * G)),
    ), {
        "u_a >= h_0 is no equation": ("is no equality", SIDES, ge(u_a, h_0)),  # 2 >= 1
        "a value that divides": ("has no value", eq(h, 1 / b_0), eq(b_0, 0)),
        "nothing to insert": ("does not occur", SIDES, eq(b_0, q)),
        "a variable of integration": ("every value", integral(theta), eq(theta, b_0)),
        "the datum of a slope": ("every value", given(equal(SLOPE, h_0)), eq(f_c, 1)),
        # b_0 = 1/2, not 1/3, for x = q = 1
        "capture of a power by an integral": ("for every",
            eq(b_0, sp.Integral(q**2 * x, (x, 0, 1))), eq(q**2, x)),
        # h_0 = 0: G = 0
        "a root of a product": ("b_0 >= 0", eq(G, sp.sqrt(x_inf)), eq(x_inf, h_0 * b_0)),
        "a root of what is negative": ("-1 >= 0|False",
            eq(G, sp.cbrt(x_inf)), eq(x_inf, -h_0)),
        # theta = 1: G = 3, not 3/2
        "capture by an integral": ("for every", integral(b_0), eq(b_0, theta)),
        "capture by a slope": ("for every", sloped(), eq(u_cum, b_0)),  # d b_0/d f_c = 0
        # d(h_0 N)/dt is h_0/T
        "another clock under the rate": ("for every", RATE, eq(u_c, h_0 * N)),
        # G = 0, but for G(0) = h_0
        "what is so wherever wear has a rate under a rate": ("at every time",
            eq(rate("G"), C), ALMOST),
        "what is so wherever wear has a rate as continuous": ("at every time",
            given(Continuous(G)), ALMOST),
        "another clock under the mean": ("for every", MEAN_LOAD, eq(U_a, h_0 * v)),
        # G = t/T
        "N in an asymptotic relation": ("may take every value", logarithmic(), eq(N, G)),
        # G = q/N, for one N
        "a length that grows with N": ("may take every value", logarithmic(),
            eq(q, (1 + N) * G)),
    }),
    Family(lambda unknown, *known: Solve(unknown)(*known), (
        (h_0, eq(u_a, h_0)), (rate("G"), eq(T * rate("G") + G, theta)),
        (x_inf, eq(x_inf - 1, theta)),
        (u_a, eq(f_c * u_a, f_c * h_0), ROUGHENS),  # f_c = 0
    ), {
        "an inequality is not solved": ("is no equality", u_a, ge(u_a, h_0)),
        # G = 1 - e^-t
        "solved under a derivative": ("linear in G", G, eq(T * rate("G") + G, theta)),
        "solved across a jump": ("linear in x_inf", x_inf, eq(KINKED, theta)),  # x_inf = -1/2
        # theta = x_inf = 1, b_0 = 2: the product of the roots is 1
        "solved where 0 has no value": ("linear in x_inf", x_inf,
            eq(x_inf + sp.sqrt(x_inf) * sp.sqrt(theta / x_inf), b_0)),
        # h_0 = 0: the factor is 0, though SymPy takes it for no real number
        "a factor that is 0 at a branch point": ("Ne", theta,
            eq((BRANCHED + 1) * theta, (BRANCHED + 1) * b_0, evaluate=False)),
    }),
    Family(lambda factor, claim=SIDES, *known: times(factor, claim, *known), (
        q, sp.Integral(1 / q, (q, L, 2 * L)),
        u_stop, rate("u_c"), (sp.Integral(x / theta, (x, 1, 2)), SIDES, given(theta > 0)),
        sp.log(1 + q), (1 / f_c, SIDES, ROUGHENS),
    ), {
        "an inequality times either sign": ("missing premise", f_c, ge(u_a, h_0)),  # f_c = -1
        "a factor that is no limit": ("has a value", forever(sp.sin(2 * sp.pi * t / T))),
        "a primitive": ("two ends", sp.Integral(x, x)),
        "a factor that is no zero": ("has a value", FirstZero(y**2 + 1, y)),
        "a factor that is a rate": ("Derivative", rate("h")),  # h jumps
        "1/theta over -1 to 1, for theta > 0": ("missing premise: Ne",
            sp.Integral(1 / theta, (theta, -1, 1)), SIDES, given(theta > 0)),
    }),
    Family(lambda claim, *known: Arithmetic(claim)(*known), (
        (equal(G, q), IN_PIECES, le(h, L)), (equal(G, 0), IN_PIECES, gt(h, L)),
        (equal(h, x_inf), eq(h, sp.Abs(x_inf)), ge(x_inf, 0)),
    ), {
        # 1, not 3
        "a branch under an integral": ("missing premise", equal(G, 3),
            integral(sp.Piecewise((1, theta <= 0), (0, True))), given(theta <= 0)),
        # int_-1^2 |theta|
        "a modulus under an integral": ("missing premise", equal(G, sp.Rational(3, 2)),
            integral(sp.Abs(theta)), ge(theta, 0)),
        "no branch": ("missing premise", equal(G, q), IN_PIECES, ROUGHENS),
        "a branch for less": ("missing premise", equal(G, q), IN_PIECES, le(h, 2 * L)),
        "a modulus for f_c < 0": ("missing premise", equal(h, f_c), eq(h, sp.Abs(f_c)), FALLING),
    }),
    Family(lambda claim, *known: Insert(claim)(*known), (
        (equal(u_a, h_0), eq(u_a, h_0)), (equal(theta * forever(G), theta * b_0), tends(G, b_0)),
        (equal(h * forever(G), u_a * forever(G)), SIDES, tends(G, theta)),
        (OVER_ZERO, eq(u_c, h_0 + h - u_a), ne(u_c, h_0)),  # h = u_a
    ), {
        "a bound inserted as an equation": ("no identity", equal(u_a, h_0), le(u_a, h_0)),
    }),
    Family(lambda claim, *known: Insert(claim)(*known), (
        equal(sp.Abs(f_c) ** 2, f_c**2), equal(sp.log(2 * q), sp.log(2) + sp.log(q)),
        equal(theta * sp.exp(theta) * sp.exp(-theta), theta),
        equal(sp.besseli(0, y) + 0, sp.besseli(0, y)),
        (sp.Eq((f_c**2 - 1) / (f_c - 1), f_c + 1), ne(f_c, 1)),  # f_c = 1
    ), {
        "|f_c| = f_c": ("no identity", sp.Eq(sp.Abs(f_c), f_c)),
        "log(x^2) = 2 log(x)": ("x_inf.* > 0", sp.Eq(sp.log(x_inf**2), 2 * sp.log(x_inf))),
        "W(x e^x) = x": ("no identity", sp.Eq(sp.LambertW(theta * sp.exp(theta)), theta)),
        # SymPy's subs makes it q^(3/2): q = exp(b_0)
        "a power of e by another": ("no identity",
            equal(sp.exp(3 * b_0), sp.exp(b_0) * q), eq(sp.exp(b_0), q)),
        "zero is not one": ("no identity", equal(sp.log(f_c**2) - sp.log(f_c**2), 1)),
        "no equation": ("is an equality", sp.Ge(f_c, q)),
    }),
    Family(lambda inside, value, *known: Insert(equal(sp.log(inside), value))(*known), (
        (kappa, f_c, eq(kappa, sp.exp(f_c))), (f_c, sp.log(f_c), ROUGHENS),
        (kappa, h, eq(sp.log(kappa), h)),
    ), {
        "the logarithm of a bound": ("no identity", kappa, f_c, ge(kappa, sp.exp(f_c))),
        "the logarithm of what may be negative": ("h.* > 0", h, sp.log(h_0), eq(h, h_0)),
    }),
    Family(lambda claim, *known: Consequence(claim)(*known), (
        (sp.Le(-G, h_0), le(-G, L), eq(L, h_0)), (sp.Eq(rate("u_c") * T / q, C * T / q), SPEED),
        (end(G + GAP, theta), tends(G, theta), APART),
        (end((h**2 - u_a**2) / (h - u_a), q), tends(h + u_a, q), ne(h, u_a)),  # h = u_a
        (end(2 * h_0 / u_c / 2, 0), tends(h_0 / u_c, sp.S.Zero)),
    ), {
        # u_a = 2, L = 1
        "more parts than the premise": ("is an equality", sp.And(sp.Le(-G, h_0), sp.Lt(u_a, L)),
            le(-G, L), eq(L, h_0)),
        # theta = 0
        "an angle that is the scaled rate": ("does not become", sp.Eq(theta, C * T / q), SPEED),
        # U_a jumps
        "another form of a limit, with a rate": ("Derivative",
            end(G + (dU + 1) * (dU - 1) - dU**2, q), tends(G, q + 1)),
        "another form of a limit, with 0/0": ("Ne", end(G + GAP, theta), tends(G, theta)),
        "divided by what may vanish": ("become", sp.Eq(h / f_c, u_a / f_c), SIDES),
    }),
    # ---- names
    Family(lambda claim, *said: Arithmetic(claim)(*said), (
        (equal(h_0, 0), defined(b_0, h_0), eq(b_0, 2 * h_0)),
        (equal(u_c, u_a), defined_as(equal(G, u_c)), eq(G, u_a)),
        (equal(h_0, 0), defined(b_0, theta + h_0), eq(theta, b_0)),
        (equal(u_c, C * T * tau), eq(u_c, C * t), CYCLING),
    ), {
        # h_0 = 1
        "two definitions of one name": ("two definitions", equal(h_0, 0), defined(b_0, h_0),
            defined(b_0, 2 * h_0)),
        # u_c = 1, u_a = 2
        "two names for one field": ("two definitions", equal(u_c, u_a), defined_as(equal(G, u_c)),
            defined_as(equal(G - u_a, 0))),
        # h_0 = 1
        "definitions in a circle": ("circle", equal(h_0, 0), defined(b_0, theta + h_0),
            defined(theta, b_0 + 0)),
    }),
    Family(each, (), {
        "a circle that closes one period later": ("a new name",
            lambda: defined(b_0, later(G) + 1, one_period_later(NAMED))),
    }),
    # ---- equations of the model that contradict each other, of which no reader is told
    Family(lambda claim, *known: Arithmetic(claim)(*known), (
        (equal(u_a, 0), called(CLOSURE[True], Kind.MODEL), given(CLOSURE[False])),
        (sp.Ge(rate("u_a"), 0), PIN_WEARS),
    ), {
        # u_a = 1 under one of them
        "both signs of pin wear": ("contradict", equal(u_a, 0),
            called(CLOSURE[True], Kind.MODEL), called(CLOSURE[False], Kind.MODEL)),
        "a pin that wears and does not": ("contradict", TRIVIAL, PIN_WEARS,
            differentiate(eq(u_a, 0))),
        # the load begins at U_a(0) = 1: it need not be U_a = 0
        "a first closure, and the closure": ("more is said of h", equal(initial("h"), h_0),
            called(STARTS[0], Kind.INITIAL), eq(h, h_0 - U_a)),
        "a wear without bound, and its limit": ("contradict", TRIVIAL, tends(u_c, sp.oo),
            tends(u_c, h_0)),
        "a wear without bound, and a bound": ("contradict", TRIVIAL, tends(u_c, sp.oo),
            le(sp.Abs(u_c), h_0)),
        "a wear that grows at a rate, and a bound": ("contradict", TRIVIAL,
            given(sp.Ge(rate("u_c"), C)), given(sp.Le(u_c, h_0))),
        "a wear above a multiple of time, and a bound": ("contradict", TRIVIAL,
            ge(u_c, h_0 + C * t), le(u_c, q)),
        "a multiple of time, and a bound": ("contradict", TRIVIAL, eq(u_c, C * t), le(u_c, q)),
        "a periodic load without bound": ("contradict", TRIVIAL, REPEATING, tends(U_a, sp.oo)),
        "two limits": ("contradict", TRIVIAL, tends(G, q), tends(G, 2 * q)),
        "a limit above a bound": ("contradict", TRIVIAL, tends(G, q), lt(G, 0)),
        "a limit above what falls": ("contradict", TRIVIAL, tends(G, sp.oo), tends(-G, h_0)),
        "a constant load that rises with time": ("contradict", TRIVIAL, CONSTANTLY, eq(U_a, C * t)),
        "a constant sine": ("contradict", TRIVIAL, CONSTANTLY, assume(SINE)),
        "a sine above zero": ("contradict", TRIVIAL, ge(U_a, 0), assume(SINE)),
        "a rough pin that is smooth": ("contradict", equal(h, h_0),
            called(STARTS[3], Kind.INITIAL), SMOOTH_PIN, eq(h, h_0)),
    }),
    Family(each, (lambda: Solve(p)(assume(SPRINGS)), lambda: times(q, AS_WORN)), {
        # p > 0
        "a rigid support of finite stiffness": ("contradict",
            lambda: substitute(assume(SPRINGS), assume(RIGID))),
        # one of them alone
        "two laws": ("two contact laws", lambda: substitute(touching(TANH), touching(EXPONENTIAL))),
    }),
    Family(lambda claim, *known: Arithmetic(claim)(*known), (
        (equal(u_c + initial("u_c"), h_0 * N), eq(u_c, h_0 * N), START),
        (equal(symbol("U_c"), 0), eq(2 * symbol("U_c"), 0)), (sp.Ge(u_c, -h_0), gt(u_c, 0)),
        (sp.Gt(f_c, 0), eq(G, sp.log(f_c))),
        (sp.Ge(p, 0, evaluate=False),),
    ), {
        # p = 0 out of contact
        "a pressure at every time": (r"p\(t\) > 0", sp.Gt(p, 0)),
        # no p is k U_c while there is contact
        "a rigid support in another spelling": ("contradict", TRIVIAL, assume(SPRINGS),
            eq(2 * symbol("U_c"), 0)),
        "a wear that does not begin at 0": ("contradict", TRIVIAL, START,
            ge(u_c, h_0 + L)),
        "one over what is zero": ("contradict", TRIVIAL, eq(G, 1 / f_c), eq(f_c, 0)),
        "the logarithm of what is negative": ("contradict", TRIVIAL, ge(G, sp.log(f_c)), FALLING),
        "a wear above its start, at the start": ("contradict", TRIVIAL, START, gt(u_c, 0)),
        "a wear that stays below what it reaches": ("contradict", TRIVIAL, lt(u_a, L),
            eq(u_a.subs(t, N * T), L)),
        "a phase that stands still": ("contradict", TRIVIAL, eq(tau, G), eq(G, L)),
        "a number of cycles of two values": ("contradict", TRIVIAL, eq(N, G),
            eq(G**2, 3 * G - 2)),
        "a constant load that grows": ("contradict", TRIVIAL, eq(U_a, b_0),
            eq(b_0, later(U_a) - L)),
        # f_c = -1/10
        "W has a value above zero alone": ("f_c", sp.Ge(f_c, 0), eq(G, sp.LambertW(f_c))),
        # h_0 = 0, f_c = 1
        "a pin that wears and is as it was": ("contradict", TRIVIAL, PIN_WEARS,
            eq(2 * u_a - h_0, h_0)),
        "data of which there are none": ("contradict", TRIVIAL, gt(f_c**2, 1),
            lt(sp.Abs(f_c), 1)),
    }),
    # ---- what a definition supposes
    Family(defined, (
        (b_0, U_a, CONSTANTLY), (b_0, 1 / f_c), (u_cum, f_c * h_0),
        (u_stop, FirstZero(q - y, y), FirstRoot(FirstZero(q - y, y), sp.S.One)()),
        (b_0, forever(u_a), tends(u_a, h_0)), (b_0, sp.Integral(u_c, (t, 0, T))),
        (U_mean, sp.Integral(U_a, (t, 0, T)) / T),
        (b_0, sp.Integral(h, (t, 0, T)) / T, eq(h, h_0 - u_c)),
    ), {
        "t = 5, by definition": ("t is T", t, sp.Integer(5)),  # t = 4
        # u_c = h_0 t/T
        "a constant that goes with another clock": ("is constant", b_0, u_c, eq(u_c, h_0 * N)),
        # u_cum > 0
        "a positive name for what is negative": ("contradict", u_cum, -h_0),
        "the first zero of what has none": ("has a value", u_stop, FirstZero(q + y, y)),
        "a limit that need not exist": ("has a value", b_0, forever(U_a)),  # sin t
        "a limit at infinity": ("has a value", b_0, forever(u_c), tends(u_c, sp.oo)),
        # U_a jumps from 0 to 2 L
        "the sign of a field that jumps": ("is constant", b_0,
            (U_a - L) / sp.sqrt(U_a**2 - 2 * L * U_a + L**2)),
        # h = 0, u_c = t: the root has no slope there
        "what is constant as long as a root has a slope": ("is constant", theta,
            u_c + sp.sqrt(L * h), eq(rate("h"), -2 * sp.sqrt(h / L) * rate("u_c")), ge(h, 0)),
        "what is constant wherever wear has a rate": ("at every time", b_0, G, ALMOST,
            eq(u_c, h_0)),
        "the mean over all cycles so far": ("is constant", b_0,  # N h_0 under U_a = h_0
            sp.Integral(U_a, (t, 0, N * T)) / T),
        "the contact law at a time": ("is constant", theta, PHI(t / T)),
        "what is constant as it is called so": ("a new name", b_0, u_c, eq(u_c, b_0)),
        "a positive name for what is as large as that": ("a new name", u_cum, -q * f_c,
            ge(-q * f_c, u_cum)),
        "a mean that is there as it is called so": ("a new name", U_mean,
            sp.Integral(U_a, (t, 0, T)) / T, eq(U_mean, sp.Integral(U_a, (t, 0, T)) / T)),
        "what steps": ("is constant", b_0, sp.Piecewise((h_0, u_c <= h_0), (0, True))),
    }),
    Family(defined_as, (
        equal(G * q, -f_c), equal(later(rate("u_inf")), rate("u_inf")),
    ), {
        # with G = 1 it would hide h = u_a
        "what is zero unless something else is": ("a new name", equal(G * (h - u_a), 0)),
        "what is constant": ("a new name", equal(rate("G"), 0)),
        # a square load
        "what has the rate of the load": ("a new name", equal(rate("G"), rate("U_a"))),
        "what is -1 where it is not negative, else 1": ("a new name",
            equal(G + 2 * sp.Piecewise((1, sp.Ge(G, 0)), (0, True)), 1)),
        "what has a rate that jumps": ("a new name", equal(rate("G"), U_a / T)),
    }),
)  # fmt: skip
