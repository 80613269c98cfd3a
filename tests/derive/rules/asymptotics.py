"""Approach to a steady rate, logarithmic growth, terms of the expansion."""

from __future__ import annotations

import sympy as sp

from derive.claims import Drift, Oscillation
from derive.kernel import infer
from derive.reals import LAW as PHI
from derive.results.steady_state import steady_state
from derive.rules.algebra import Consequence, Insert, substitute
from derive.rules.assumption import assume, defined
from derive.rules.averages import (
    EXPANSION,
    ROUGHNESS,
    Averaging,
    OrderEquation,
    SlowTime,
    term_of,
)
from derive.rules.drift import LeadingTerm, first_order, logarithmic_drift
from derive.rules.inequalities import Arithmetic
from derive.symbols import rate, symbol, symbols, t
from tests.derive.judgements import (
    APART,
    APPROACH,
    BOUNDED,
    FIRST_DRIFT,
    GAP,
    RATE,
    ROUGHENS,
    SLOPE,
    SPEED,
    Family,
    averaged_as,
    drift_premises,
    drifting,
    each,
    eq,
    equal,
    expansion_premises,
    first_order_terms,
    given,
    gt,
    le,
    logarithmic,
    slow_time,
    tends,
)

u_c, u_a, U_a, h, p, G = symbols("u_c u_a U_a h p G")
h_0, sigma_c0, sigma_c, f_c, C, T, N, q, b_0 = symbols("h_0 sigma_c0 sigma_c f_c C T N q b_0")
U, L, R, A, rho, h_star, theta, tau, m = symbols("U L R A rho h_star theta tau m")
c_1, c_2, w_1, s_0 = symbols("c_1 c_2 w_1 s_0")
s, z = sp.Symbol("s", nonnegative=True), sp.Symbol("z", real=True)
du = rate("u_c")

RATIO = (h - U_a) / sigma_c0
LAW, STEADY = C * sp.exp(-RATIO), C * sp.exp(-q)
VANISHES = sp.log(sigma_c - L) - sp.log(2 * sigma_c - 2 * L) + sp.log(2)
LOG_F, WAVING = sp.log(f_c - 1), sp.cos(4 * sp.pi * tau)
FEW, LOG_N, FALLS = sp.log(-h_star / (f_c * sigma_c)), sp.log(N), sp.Lt(f_c, 0)
TIED = sp.sqrt(2 * f_c * h_0 - f_c**2 - h_0**2)  # it has a value where h_0 is f_c alone
VOID = f_c * (h_0 + 1) - f_c * h_0 - f_c  # 0, but not to SymPy
SWAYING, PACE = 2 + L * sp.sin(2 * sp.pi * tau) / ROUGHNESS, (ROUGHNESS, tau, rho)
FIRST_WAVE = -(1 - theta) * U * rho * sp.cos(2 * sp.pi * tau) / sp.pi


def ordered(rest=U_a, law=LAW, end=sp.S.Zero, speed=STEADY, ratio=RATIO, last=q):
    """Apply FirstOrder, with one thing wrong."""
    limits = tends(u_c * (ratio - last) - rest, end), tends(ratio, last), tends(du, speed)
    return first_order(eq(du, law), *limits, BOUNDED)


def by_no_load():
    """Return what FirstOrder has for a rate C + 1/(1 + U_a^2), and a ratio without U_a."""
    return (
        sp.S.Zero,
        C + 1 / (1 + (U_a / q) ** 2),
        0,
        C,
        h_0 + ((h_0 + L) ** 2 - h_0**2 - 2 * h_0 * L - L**2) * U_a / L,
        h_0,
    )


def last(cycles=FEW, of=LOG_N, sign=FALLS, beside=theta):
    """Apply LeadingTerm where N is as the reciprocal of the roughness, with one thing wrong."""
    exact = eq(f_c * N, beside - h_star / sigma_c)
    return LeadingTerm(sp.Eq(of, cycles))(exact, given(sign))


def averaged(factor):
    """Return the terms of the first order under a pressure that is a multiple of the note's."""
    known, sine, *constants, _, _ = expansion_premises()
    pressure = known.claim.rhs * factor
    drift, wave = (term_of(kind, 1, pressure) for kind in (Drift, Oscillation))
    names = defined(c_1, drift, ROUGHENS), defined(w_1, wave, ROUGHENS)
    return OrderEquation(sp.S.One)(eq(p, pressure), sine, *constants, *names)


def named_waves():
    *known, wave = expansion_premises()
    v = sp.Function("v", real=True)(tau)
    almost = Arithmetic(equal(v, w_1))(eq(v, w_1 + T * (du - C)), RATE)
    return OrderEquation(sp.S.One)(*known, substitute(almost, wave))


def second_order():
    """Return the second order of a law that may turn like r^(3/2) at q."""
    _, *known, _, _ = expansion_premises()
    pressure = PHI(q + L / (sigma_c0 + f_c * u_c))
    names = (
        given(equal(symbol(f"{kind.letter}_{n}"), term_of(kind, n, pressure)))
        for n in (1, 2)
        for kind in (Drift, Oscillation)
    )
    return OrderEquation(sp.Integer(2))(eq(p, pressure), *known, *names, gt(f_c, 0))


def wave_of_wave():
    known = Averaging(sp.Eq(w_1, FIRST_WAVE))(first_order_terms(), averaged_as(FIRST_DRIFT))
    return Averaging(sp.Eq(w_1, sp.integrate(FIRST_WAVE, tau)))(known)


def oscillation_as(name):
    return defined(
        name, term_of(Oscillation, 1, steady_state().pressure_at_wear.claim.rhs), ROUGHENS
    )


def mean_of_square():
    wave = Averaging(sp.Eq(w_1, FIRST_WAVE))(first_order_terms(), averaged_as(FIRST_DRIFT))
    law = Insert(equal(w_1, w_1 + (w_1**2 - FIRST_WAVE**2) / L))(wave)
    return Averaging(equal(L, L - ((1 - theta) * U * rho / sp.pi) ** 2 / (2 * rho * L)))(law)


def mean_of(right, mean):
    """Return c_1 from its equation, which has another right side."""
    law = equal(sp.Derivative(w_1, tau), rho * (right - c_1))
    return Averaging(equal(c_1, mean))(Consequence(law)(given(law), expansion_premises()[-1]))


def of_another_pressure():
    *premises, _, wave = expansion_premises()
    other = premises[0].claim.rhs.subs(h_0, 2 * h_0)
    return OrderEquation(sp.S.One)(
        *premises, defined(c_1, term_of(Drift, 1, other), ROUGHENS), wave
    )


def slow(added=sp.S.Zero, without=None, left=None):
    """Return the slow time, with something added to the function of m, or with a premise less."""
    known = slow_time()
    claim = equal(left or known.claim.lhs, known.claim.rhs + added)
    return infer(SlowTime(claim), *(j for i, j in enumerate(known.parents) if i != without))


def vanishing_drifts():
    names = [eq(symbol(f"c_{n}"), sp.S.Zero) for n in (1, 2, 3, 4)]
    known = slow_time()
    return known.rule(*names, known.parents[-1])


FAMILIES = (
    Family(ordered, (
        (),
        2 * U_a,  # U_a = sqrt t
    ), {
        # U_a = sin(t)/sqrt(t)
        "a deviation that grows with time": ("linear in bounded", t * U_a / T),
        "a deviation that grows like a root of the wear": ("linear in bounded|is bounded",
            U_a * sp.sqrt(1 + u_c**2 / q**2)),
        "a load and time": ("linear in bounded", U_a + h_0 * t / T),
        # U_a = 0, u_c' = C e^(-q - L sqrt(t/T)/u_c)
        "a root of time while the load is not negative": ("linear in bounded",
            L * sp.sqrt(t / T) * (U_a + sp.Abs(U_a)) / U),
        "a deviation that stays": ("with that limit", U_a, LAW, sp.S.One),
        "a rate by another field": ("with that limit", U_a, LAW * (1 + G**2)),
        # zero times U_a, a root of time
        "a rate by a load that the ratio does not have": ("with that limit", *by_no_load()),
        "a law with a kink": ("differentiable at the limit", U_a, C * sp.Abs(RATIO), 0, C * q),
        "another rate": ("at the limit", U_a, LAW, 0, C),
        "a steady rate of either sign": ("f_c", U_a, f_c * LAW, 0, f_c * STEADY),
    }),
    Family(drifting, ((), t * (du - C * q) - U_a), {
        # u_c - C t ~ int U_a/T
        "a drift that grows with N": ("N fixed", t * (du - C) - N * U_a),
        "a drift from a speed that grows": ("N fixed", t * (du - C * N) - U_a),
        "a faster approach": ("linear in the load", t**2 * (du - C) - U_a),
        "the square of the load": ("linear in the load", t * (du - C) - U_a**2 / U),
        # a sine load: its mean is U/pi
        "a ramp of the load": ("linear in the load",
            t * (du - C) - (U_a + sp.Abs(U_a)) / 2),
        "another field than the load": ("linear in the load", t * (du - C) - u_a),
    }),
    Family(each, (), {
        # u_c = C t - ln(1 + t)
        "a drift from a bound of the approach": ("is no limit",
            lambda: logarithmic_drift(le(APPROACH, 0), *drift_premises()[1:])),
    }),
    Family(logarithmic, ((), (q + sp.Abs(GAP), q, SPEED, APART)), {
        # u_a = 0
        "the tail of one solid and the wear of the other": ("the limit of exp", q, q, rate("u_a")),
        "a length with 0/0": ("Ne", q + sp.Abs(GAP)),
        "another length": ("the limit of exp", q, h_star),
        "a length of either sign": ("b_0 > 0", b_0, b_0),
    }),
    Family(last, ((),), {
        "not the logarithm": ("is about", FEW, N),
        # q ln(h_star/sigma_c) -> oo
        "a constant for the logarithm": ("is about", FEW, q),
        "a field beside it": ("is about", FEW + G**2),
        "the logarithm of 0/0": ("Ne", FEW, sp.log(N + N * GAP)),
        # G = h_star/sigma_c + 1: N = theta - 1
        "a field in the equation": ("is about", FEW, LOG_N, FALLS, G),
        "time in the equation": ("is about", FEW, LOG_N, FALLS, theta + t / T),
        "fewer cycles for more wear": ("grows without bound", -FEW),
        "another factor": ("quotient of the slopes", 2 * FEW),
        # half as many where b_0 = 0
        "a factor that differs for one value": ("grows without bound",
            FEW + sp.log((b_0**2 * L + 2 * sigma_c) / (b_0**2 * L + sigma_c))),
        "what wavers": ("is about", FEW + sp.Abs(sp.log(sigma_c) / 2)),
        "a roughness of either trend": ("f_c", FEW, LOG_N, sp.Ne(f_c, 0)),
        "a name that may be h_0": ("Ne", FEW + (b_0**2 - h_0**2) / (b_0 - h_0) - b_0 - h_0),
    }),
    # ---- averages
    Family(lambda claim, name="c_1", *known: Averaging(claim)(first_order_terms(name), *known), (
        sp.Eq(c_1, FIRST_DRIFT), (sp.Eq(A, FIRST_DRIFT), "A"),
        (sp.Eq(w_1, FIRST_WAVE), "c_1", averaged_as(FIRST_DRIFT)),
    ), {
        "the formula of A, a name for nothing": ("A = ", sp.Eq(A, FIRST_DRIFT)),
        "the formula of c_1, which is called A": ("c_1 = ", sp.Eq(c_1, FIRST_DRIFT), "A"),
        "another drift": ("by the mean", sp.Eq(c_1, 2 * FIRST_DRIFT)),
        # theta = 0: its mean is U rho
        "an oscillation beside an exponential": ("by the mean",
            sp.Eq(w_1, FIRST_WAVE + U * rho * sp.exp(-theta)), "c_1", averaged_as(FIRST_DRIFT)),
        # R L is whatever it is
        "an area that is an oscillation": ("by the mean", sp.Eq(R * L, FIRST_WAVE)),
        "a drift beside 0/0": ("Ne", equal(c_1 + GAP, FIRST_DRIFT)),
        "a drift beside the logarithm of any number": ("f_c", equal(
            c_1 + LOG_F - LOG_F * (f_c + 1) / f_c + LOG_F / f_c, FIRST_DRIFT)),
        "a drift that is 0/0 for f_c = 1": ("f_c - 1",
            sp.Eq(c_1, FIRST_DRIFT + (f_c**2 - 1) / (f_c - 1) - f_c - 1)),
    }),
    Family(mean_of, ((U * sp.cos(2 * sp.pi * tau), 0), (h_0 * q, h_0 * q)), {
        # 2 h_0/pi
        "the mean of a modulus": ("the period 1", h_0 * sp.Abs(sp.cos(4 * sp.pi * tau)), 0),
        "the mean of pieces": ("the period 1",
            h_0 * sp.Piecewise((WAVING, WAVING >= 0), (0, True)), 0),
        "the mean of a field": ("the period 1", h_0 * G, h_0 * G),  # G = tau
    }),
    Family(averaged, (1 + q,), {
        "a limit that varies with the load": ("is the limit of", 1 + U_a / (2 * U)),
        "a pressure that vanishes": ("smooth at infinity", 1 / (1 + u_c**2 / q**2)),
        "a pressure with the slope of a name": ("not in a sum", 1 + SLOPE * L / (u_c + q)),
        "a pressure that varies with the phase": ("is the limit of",
            1 + sp.sin(2 * sp.pi * tau) / 2),
    }),
    Family(each, (first_order_terms,), {
        # f_c = 0, G = 1
        "a multiple that may be zero": (r"Ne\(f_c, 0\)",
            lambda: LeadingTerm(sp.Eq(sp.log(G), sp.log(q / sigma_c)))(
                eq(f_c * G, f_c * q / sigma_c))),
        # at first, not at last
        "a rate that is infinite at first": ("is about",
            lambda: LeadingTerm(equal(sp.log(SPEED / C), -sp.log(t / T) / 2))(
                eq(SPEED / C, sp.sqrt(T / t) + 1))),
        # N = (1 + 1/e) L/sigma_c
        "an exponential that does not fade": ("quotient of the slopes",
            lambda: LeadingTerm(sp.Eq(LOG_N, -sp.log(sigma_c / L)))(
                eq(N, sp.Integral((1 + sp.exp(-sp.tanh(s) / s)) / s**2, (s, sigma_c / L, 1))),
                gt(sigma_c, 0))),
        # h = -1/10: half as many
        "what vanishes from below": (r"h\(t\) >= 0",
            lambda: LeadingTerm(sp.Eq(sp.log(G), sp.log(4 * L**2 / h**2)))(
                eq(G, L**2 * (3 + h / sp.Abs(h)) / h**2))),
        # sigma_c = |t - T| before 2 T, then 2 L
        "a limit in time for values where what vanishes does": ("-?2\\*L",
            lambda: LeadingTerm(sp.Eq(sp.log(G), sp.log(q / sigma_c) + VANISHES))(
                eq(G, q / sigma_c), tends(sp.log(sigma_c - L), sp.log(L)), gt(sigma_c, 0))),
        "half an order of a drift": ("coefficient c_n",
            lambda: defined(c_1, Drift(sp.Rational(3, 2), SWAYING, *PACE), ROUGHENS)),
        # f_c = 1, h_0 = 2
        "a root times what is 0": ("smooth at infinity",
            lambda: defined(c_1, Drift(sp.S.One, SWAYING + VOID * TIED, *PACE))),
        # from 2 to 3
        "a limit that varies with the phase": ("is the limit of",
            lambda: defined(c_1, Drift(sp.S.One, SWAYING + sp.sin(2 * sp.pi * tau) ** 2, *PACE))),
        # phi may turn like |r - 1|^(3/2)
        "a second order of any law": ("for order 2",
            lambda: defined(c_2, Drift(sp.Integer(2), PHI(SWAYING), *PACE), ROUGHENS)),
        # it is 0/0 for b_0 = 0
        "a drift at any pace": ("the pace rho",
            lambda: defined(c_1, Drift(sp.S.One, SWAYING, *PACE[:2], b_0), ROUGHENS)),
        "no term of the expansion": ("is of an oscillation",
            lambda: Averaging(sp.Eq(c_1, 0))(RATE)),
        "the wave of a wave": ("by the mean", wave_of_wave),  # w_1' is not w_1
        "the mean of the square of a wave": ("by the mean", mean_of_square),  # U^2 rho^2 > 0
        "an oscillation in time": ("a function of tau", lambda: oscillation_as(G)),
        "an oscillation for a clock": ("a function of tau", lambda: oscillation_as(z)),
        # v = w_1 + 1 at rational tau has no rate
        "a name for a wave where rates have values": ("a name of the oscillation", named_waves),
        "a second order of any law, by no definition": ("for order 2", second_order),
        "half an order": ("number of an order",
            lambda: OrderEquation(sp.Rational(3, 2))(*expansion_premises())),
        "what remembers another start": ("is a new name",
            lambda: substitute(slow_time(), defined(s_0, 5 * h_0))),
        "an averaged roughness that is another wear": ("is a new name",
            lambda: Arithmetic(equal(m, u_a))(defined(m, u_a), assume(EXPANSION))),
        "no pressure": ("at given wear",
            lambda: OrderEquation(sp.S.One)(eq(h, u_c), *expansion_premises())),
        "a second order without names": ("the drift c_2",
            lambda: OrderEquation(sp.Integer(2))(*expansion_premises())),
        "an oscillation for a drift": ("is a term of the expansion",
            lambda: defined(c_1, term_of(Oscillation, 1, U_a))),
        "the first drift as the second one": ("is a term of the expansion",
            lambda: defined(c_2, term_of(Drift, 1, U_a), ROUGHENS)),
        "the second oscillation as the first one": ("is a term of the expansion",
            lambda: defined(symbol("w_1"), term_of(Oscillation, 2, U_a), ROUGHENS)),
        "twice a drift": ("is a term of the expansion",
            lambda: defined(c_1, 2 * term_of(Drift, 1, U_a), ROUGHENS)),
        "a drift that is a datum": ("is a term of the expansion", lambda: defined(c_1, h_0)),
        "an oscillation that is the load": ("is a term of the expansion",
            lambda: defined(symbol("w_1"), U_a)),
        "a coefficient of what has no period": ("has the period",
            lambda: defined(c_1, term_of(Drift, 1, 2 + sp.exp(-tau)), ROUGHENS)),
        "the drift of another pressure": ("the drift c_1", of_another_pressure),
        "a slow time without drifts": ("c_3 and c_4", lambda: SlowTime(sp.Eq(L, m))()),
        "drifts that vanish": ("c_3 and c_4", vanishing_drifts),
    }),
    Family(slow, (h_0**5 / m**4,), {
        "another constant of integration": ("powers of m", h_0),  # s_0 is one of them
        "a constant from one roughness on": ("powers of m",
            sp.Piecewise((h_0, sp.Ge(m, L)), (0, True))),
        # h_0^3 u_c/m^4 is no o(m^-3)
        "a wear that goes like m": ("powers of m", h_0**4 * u_c / m**4),
        "a slow time with 0/0": ("powers of m", GAP * h_0**5 / m**5),
        "a slow time with a drift less": ("the drifts", 0, 0),
        "a slow time of any roughness": ("Definition of s_0", 0, 4),
        "another time": ("dtau/dm", 0, None, h_0),
    }),
)  # fmt: skip
