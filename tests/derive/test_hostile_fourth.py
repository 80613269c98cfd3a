"""What a fourth hostile reading got through the public rules, and a true neighbour of each.

Every false statement follows a comment with the model in which it fails, or what is wrong with it.
"""

from __future__ import annotations

from collections.abc import Callable

import pytest
import sympy as sp

from derive.faults import UsageError
from derive.hypotheses import Kind
from derive.kernel import Judgement, RuleError, replayed
from derive.laws import EXPONENTIAL, TANH, ContactLaw, r
from derive.note.model import ARCHARD, CLOSURE, SLIP, START, contact
from derive.own_law import own_law
from derive.rules.algebra import Alike, Consequence, Insert, Multiply, Solve, restrict, substitute
from derive.rules.assumption import assume, defined
from derive.rules.averages import EXPANSION, Averaging, OrderEquation
from derive.rules.calculus import RIGID, SPRINGS, differentiate, rigid
from derive.rules.data import Differentiated
from derive.rules.drift import LogarithmicGrowth
from derive.rules.inequalities import Arithmetic
from derive.rules.limits import AtInfinity, Diverges, Passes, later, one_period_later
from derive.rules.proving import LAW
from derive.rules.reading import CONSTANT, SINE
from derive.rules.solutions import Lambert, Separate
from derive.symbols import rate, symbols, t
from tests.derive.judgements import (
    DEEP,
    FIRST_DRIFT,
    PIN_START,
    averaged_as,
    end,
    equal,
    expansion_premises,
    first_order_terms,
    given,
    logarithmic,
    opened,
    slow_time,
    supposed,
    tends,
)
from tests.derive.rules import asymptotics

u_c, u_a, U_a, h, p, G, sigma = symbols("u_c u_a U_a h p G sigma")
h_0, f_c, C, T, N, q, b_0, L, U = symbols("h_0 f_c C T N q b_0 L U")
theta, u_cum, tau, m, p_max, kappa, s_0, rho = symbols("theta u_cum tau m p_max kappa s_0 rho")
sigma_a, w_1, d, u_s, p_s, c_1, U_c, k, n, omega, f_cc = symbols(
    "sigma_a w_1 d u_s p_s c_1 U_c k n omega f_cc"
)
x, y = sp.symbols("x y", real=True)
WIGGLE, WOBBLE = (sp.Function(name, real=True)(t) for name in ("wiggle", "wobble"))
POSITIVE = sp.Function("wiggle", positive=True)(t)
du = rate("u_c")
GAP = (h_0**2 - L**2) / (h_0 - L) - h_0 - L
"""Zero, but where h_0 = L."""
NOUGHT = sp.Abs(GAP)
APART = given(sp.Ne(h_0, L))
MEAN = sp.Integral(U_a, (t, 0, T)) / (T * h_0)
STEEP = sp.diff(LAW(y), y).subs(y, 0)
SMOOTH, HELD = given(equal(sigma_a, 0)), given(equal(h, h_0))
PIN_WORN = given(sp.Ge(u_a, 0))
OPENED = opened()
averaged: Callable[[sp.Expr], Judgement] = asymptotics.averaged


def called(relation: sp.Basic, kind: Kind) -> Judgement:
    return assume(supposed(relation, kind))


def of_model(*relations: sp.Basic) -> tuple[Judgement, ...]:
    return tuple(called(relation, Kind.MODEL) for relation in relations)


def known_start(relation: sp.Basic) -> Judgement:
    return called(relation, Kind.INITIAL)


def named(relation: sp.Basic) -> Judgement:
    return called(relation, Kind.DEFINITION)


FACTORS = defined(theta, f_c), defined(b_0, h_0 / L)
FIELDS = named(equal(WIGGLE, f_c)), named(equal(WOBBLE, h_0 / L))


def alike(join: Callable[..., sp.Basic]) -> Judgement:
    return Alike(join(sp.Le(h, L), sp.Le(h + q, L + q), evaluate=False))()


def anything(*premises: Judgement) -> Judgement:
    return Arithmetic(equal(h_0, 5 * L))(*premises)


def touching(*laws: ContactLaw) -> list[Judgement]:
    contact_now = given(sp.Le(h, 3 * sigma))
    return [restrict(*of_model(contact(law)), contact_now) for law in laws]


def pressed(closure: Judgement) -> Judgement:
    """Return that what lies between the solids is positive: it is p/k."""
    inside = closure.claim.lhs - h_0 + later(U_a)
    return Insert(equal(sp.Abs(inside) / inside, 1))(closure, Arithmetic(sp.Ne(inside, 0))(closure))


def shifted(added: sp.Expr) -> Judgement:
    return Passes(end(later(G) + later(added), theta))(tends(G + added, theta))


def tied(*ties: Judgement) -> Judgement:
    """The slope of u_cum = f_c h_0, after h_0 = f_c L was inserted: it is h_0."""
    value = Arithmetic(equal(h_0, f_c * L))(*ties)
    known = Insert(equal(u_cum, f_c**2 * L))(defined(u_cum, f_c * h_0), value)
    slope = sp.Derivative(u_cum, f_c, evaluate=False)
    return Differentiated(equal(slope, 2 * f_c * L), f_c)(known)


def untied(*facts: Judgement) -> Judgement:
    slope = sp.Derivative(u_cum, f_c, evaluate=False)
    return Differentiated(equal(slope, h_0), f_c)(defined(u_cum, f_c * h_0), *facts)


def moved(rate_of_wear: sp.Expr, wear: sp.Expr, *facts: Judgement) -> Judgement:
    """The time as an integral over the wear of the pin, of which the bearing's is a function."""
    claim = equal(C * t, sp.Integral(1, (u_s, 0, u_a)))
    law = given(equal(du, rate_of_wear)), given(equal(u_c, wear))
    return Separate(claim)(*law, PIN_START, assume(CONSTANT), *facts)


def wave() -> Judgement:
    claim = (1 - theta) * U * rho * sp.cos(2 * sp.pi * tau) / sp.pi
    return Averaging(equal(w_1, -claim))(first_order_terms(), averaged_as(FIRST_DRIFT))


def wave_of_wave() -> Judgement:
    known = wave()
    return Averaging(equal(w_1, sp.integrate(known.claim.rhs, tau)))(known)


def curved() -> Judgement:
    """Return the limit of an odd part of the law behind its tangent, times u_c^2."""
    odd = LAW(q / u_c) - LAW(-q / u_c) - 2 * q / u_c * STEEP
    return AtInfinity(end(u_c**2 * odd, 0), 1 / u_c)(DEEP)


def deflected(ratio: sp.Expr) -> Judgement:
    """Return that the support is deflected one period later, as it always is."""
    known = one_period_later(Solve(U_c)(assume(SPRINGS)))
    return Insert(equal(ratio, 1))(known, Arithmetic(sp.Ne(later(U_c), 0))(known))


def mean_of(right: sp.Expr, mean: sp.Expr) -> Judgement:
    law = equal(sp.Derivative(w_1, tau), rho * (right - c_1))
    return Averaging(equal(c_1, mean))(Consequence(law)(given(law), expansion_premises()[-1]))


def over_pressures(most: sp.Expr, known: Judgement) -> Judgement:
    part = sp.Integral(1 / (p_s - p_max), (p_s, p_max / 4, most))
    return Multiply(part)(HELD, known)


def grown(scale: sp.Expr, *facts: Judgement) -> Judgement:
    limit = tends(du * sp.exp((u_c - U_a) / q), C)
    return LogarithmicGrowth(scale)(limit, assume(SINE), *facts)


def linear(expr: sp.Expr, *facts: Judgement) -> Judgement:
    return Diverges(expr)(given(sp.Ge(u_c, C * t)), *facts)


def lambert(w: sp.Expr, *facts: Judgement) -> Judgement:
    return Lambert(w)(given(equal(q * sp.exp(q), x)), *facts)


def passed(*facts: Judgement) -> Judgement:
    nothing = b_0 / (h_0 - L)
    return Passes(end(G + nothing, theta))(tends(G, theta), given(equal(b_0, 0)), *facts)


def rewritten(*facts: Judgement) -> Judgement:
    return Consequence(end(G + GAP, theta))(tends(G, theta), *facts)


def kinked(inside: sp.Expr) -> Judgement:
    """The contact law exp(-r - sqrt(inside)/(2 + 2 r^2))."""
    phi = sp.exp(-r - sp.sqrt(inside) / (2 + 2 * r**2))
    (law,) = of_model(contact(ContactLaw("", phi, sp.S.Zero, "")))
    return law


Case = tuple[Callable[[], Judgement], Callable[[], Judgement], str]

CASES: dict[str, Case] = {
    # ---- a claim of another type than the theorem's
    "two inequalities of equal difference, both": (  # h = 2 L
        lambda: alike(sp.And),
        lambda: alike(sp.Equivalent),
        "is an equivalence",
    ),
    "the wave of a wave": (wave_of_wave, wave, "by the mean"),  # w_1' is not w_1
    "half an order": (
        lambda: OrderEquation(sp.Rational(3, 2))(*expansion_premises()),
        first_order_terms,
        "the number of an order",
    ),
    # ---- equations of the model that contradict each other, of which no reader is told
    "both signs of pin wear": (  # u_a = 1 under one of them
        lambda: Arithmetic(equal(u_a, 0))(*of_model(CLOSURE[True], CLOSURE[False])),
        lambda: Arithmetic(equal(u_a, 0))(*of_model(CLOSURE[True]), given(CLOSURE[False])),
        "contradict",
    ),
    "two laws": (  # one of them alone
        lambda: substitute(*touching(TANH, EXPONENTIAL)),
        lambda: substitute(*touching(TANH), given(equal(h, h_0))),
        "contradict",
    ),
    "a rigid support of finite stiffness": (  # p > 0
        lambda: Solve(p)(substitute(assume(SPRINGS), assume(RIGID))),
        lambda: Solve(p)(assume(SPRINGS)),
        "contradict",
    ),
    "a pin that wears and does not": (
        lambda: anything(*of_model(ARCHARD[0]), differentiate(given(equal(u_a, 0)))),
        lambda: Arithmetic(sp.Gt(rate("u_a"), 0))(*of_model(ARCHARD[0])),
        "contradict",
    ),
    "a rough pin that is smooth": (
        lambda: Arithmetic(equal(h, h_0))(known_start(START[3]), SMOOTH, HELD),
        lambda: Arithmetic(equal(h, h_0))(known_start(START[1]), SMOOTH, HELD),
        "contradict",
    ),
    # ---- the load at another time, under which the support is made rigid
    "what is pressed one period later": (  # 0/0
        lambda: rigid(pressed(one_period_later(OPENED))),
        lambda: rigid(OPENED),
        "nothing else is said of the load",
    ),
    "a deflection one period later": (  # 0 = 1
        lambda: rigid(deflected(later(p) / (k * later(U_c)))),
        lambda: rigid(OPENED),
        "nothing else is said of",
    ),
    # ---- what an asymptotic relation is about, on the right of what is inserted
    "a scale that grows with the number of cycles": (  # G = q/N, for one N
        lambda: substitute(logarithmic(), given(equal(q, N * G))),
        lambda: substitute(logarithmic(), given(equal(q, b_0 * G))),
        "may take every value",
    ),
    # ---- averages
    "a pressure whose limit varies with the load": (
        lambda: averaged(1 + U_a / (2 * U)),
        lambda: averaged(1 + q),
        "is the limit of",
    ),
    "a pressure that vanishes": (
        lambda: averaged(1 / (1 + u_c**2 / q**2)),
        lambda: averaged(1 + f_c**2),
        "smooth at infinity",
    ),
    "the mean over half a wave": (  # c_1 is no constant
        lambda: mean_of(U * sp.cos(sp.pi * tau), sp.S.Zero),
        lambda: mean_of(U * sp.cos(2 * sp.pi * tau), sp.S.Zero),
        "the period 1",
    ),
    "the mean of a field": (  # G = tau
        lambda: mean_of(h_0 * G, h_0 * G),
        lambda: mean_of(h_0 * q, h_0 * q),
        "the period 1",
    ),
    # ---- one period later, with time that is bound
    "a mean in a limit": (lambda: shifted(MEAN), lambda: shifted(h_0 / T), "all that varies"),
    "a first value in a limit": (  # G = t e^(-t/T)
        lambda: shifted(sp.Limit(G, t, 0)),
        lambda: shifted(q * sp.tanh(u_c)),
        "all that varies",
    ),
    # ---- data that definitions tie
    "a name for f_c that is h_0/L": (  # the slope is h_0
        lambda: tied(defined(q, f_c), given(equal(q, h_0 / L))),
        lambda: untied(defined(q, f_c)),
        "may vary",
    ),
    "two names that are equal": (
        lambda: tied(defined(theta, f_c), defined(b_0, h_0 / L), given(equal(theta, b_0))),
        lambda: untied(defined(theta, f_c), defined(b_0, h_0 / L)),
        "may vary",
    ),
    "two names of one pressure": (
        lambda: tied(*FACTORS, *(given(equal(p, p_max * name)) for name in (theta, b_0))),
        lambda: untied(*FACTORS, given(equal(p, p_max * sp.tanh(h / sigma)))),
        "may vary",
    ),
    "two fields that are equal": (
        lambda: tied(*FIELDS, given(equal(WIGGLE, WOBBLE))),
        lambda: untied(*FIELDS),
        "may vary",
    ),
    "a load below what is negative": (
        lambda: tied(called(sp.Le(sp.Abs(U_a), -L * (f_c - h_0 / L) ** 2), Kind.LOAD)),
        lambda: untied(called(sp.Le(sp.Abs(U_a), U), Kind.LOAD)),
        "may vary",
    ),
    # ---- variables separated, though the wear does not move with the other
    "a wear that does not change": (  # u_a = 0
        lambda: moved(sp.S.Zero, h_0),
        lambda: moved(C, u_a),
        "moves with",
    ),
    "a wear that rests where it begins": (  # u_a = u_c = 0
        lambda: moved(2 * C * u_a / h_0, u_a**2 / h_0),
        lambda: moved(2 * C * (u_a / h_0 + q), u_a**2 / h_0 + 2 * q * u_a, PIN_WORN),
        "moves with",
    ),
    "a growth that may vanish": (  # f_c = 0, u_a = 0
        lambda: moved(f_c * C, f_c * u_a),
        lambda: moved(f_c * C, f_c * u_a, given(sp.Ne(f_c, 0))),
        "moves with",
    ),
    # ---- definitions that nothing satisfies
    "f_c times something positive is 0": (  # f_c = 1
        lambda: Arithmetic(equal(f_c, 0))(named(equal(kappa * f_c, 0))),
        lambda: Arithmetic(equal(f_c * b_0, 0))(named(equal(f_c * b_0, 0))),
        "is a new name",
    ),
    "f_c times a positive field is 0": (
        lambda: Arithmetic(equal(f_c, 0))(named(equal(f_c * POSITIVE, 0))),
        lambda: Arithmetic(equal(f_c * WIGGLE, 0))(named(equal(f_c * WIGGLE, 0))),
        "is a new name",
    ),
    "two positive names that add to 0": (
        lambda: anything(named(equal(kappa + d, 0))),
        lambda: Arithmetic(sp.Lt(b_0, 0))(named(equal(kappa + b_0, 0))),
        "is a new name",
    ),
    "a field that blows up": (  # tan(t/T)
        lambda: named(equal(sp.Derivative(WIGGLE, t), (1 + WIGGLE**2) / T)),
        lambda: named(equal(sp.Derivative(WIGGLE, t), (1 + u_c**2) / T)),
        "is a new name",
    ),
    "half of the number of cycles": (  # u_c = C t
        lambda: defined(N, t / (2 * T)),
        lambda: defined(N, t / T),
        "N is t/T",
    ),
    "an averaged roughness that is another wear": (
        lambda: Arithmetic(equal(m, u_a))(defined(m, u_a), assume(EXPANSION)),
        lambda: Arithmetic(equal(b_0, h_0))(defined(b_0, h_0), assume(EXPANSION)),
        "is a new name",
    ),
    "what remembers another start": (
        lambda: substitute(slow_time(), defined(s_0, 5 * h_0)),
        lambda: substitute(slow_time(), given(equal(s_0, 5 * h_0))),
        "is a new name",
    ),
    "an angular speed that is C/L": (  # n is whatever it is
        lambda: Arithmetic(equal(sp.pi * n / 30, C / L))(*of_model(SLIP[1]), defined(omega, C / L)),
        lambda: Arithmetic(equal(omega, sp.pi * n / 30))(*of_model(SLIP[1])),
        "is a new name",
    ),
    "a roughness that does not grow": (  # f_c = 1
        lambda: substitute(*of_model(ARCHARD[3]), defined(f_cc, sp.S.Zero)),
        lambda: substitute(*of_model(ARCHARD[3]), defined(f_cc, f_c)),
        "f_cc is f_c",
    ),
    "another growth of the averaged roughness": (
        lambda: substitute(slow_time(), defined(rho, 5 * h_0)),
        lambda: substitute(slow_time(), defined(rho, f_c * u_cum)),
        "rho is f_c",
    ),
    "a variable of integration that is p_max/2": (  # 1/0 at p_max
        lambda: over_pressures(2 * p_max, defined(p_s, p_max / 2)),
        lambda: over_pressures(p_max / 2, given(sp.Lt(p_s, p_max))),
        "is a new name",
    ),
    # ---- 0/0 where h_0 = L, in what an author writes
    "another form of what tends to a limit": (
        lambda: rewritten(),
        lambda: rewritten(APART),
        "Ne",
    ),
    "what grows times 1 + |0/0|": (
        lambda: linear(u_c * (1 + NOUGHT)),
        lambda: linear(u_c * (1 + NOUGHT), APART),
        "Ne",
    ),
    "Lambert's function and 0/0": (
        lambda: lambert(q + NOUGHT),
        lambda: lambert(q + NOUGHT, APART),
        "Ne",
    ),
    "a scale with 0/0": (lambda: grown(q + NOUGHT), lambda: grown(q + NOUGHT, APART), "Ne"),
    "a limit that passes, with b_0/0": (passed, lambda: passed(APART), "Ne"),
    # ---- laws that are less smooth than they look
    "a kink under a root": (lambda: kinked(r**4 + r**2), lambda: kinked(1 + r**2), "smooth"),
    "the second slope of a law, cancelled": (  # phi is differentiable once
        curved,
        lambda: AtInfinity(end(u_c * (LAW(q / u_c) - LAW(0)), q * STEEP), 1 / u_c)(DEEP),
        "is smooth",
    ),
    # ---- what is no number
    "a primitive": (
        lambda: Multiply(sp.Integral(x, x))(HELD),
        lambda: Multiply(sp.Integral(x, (x, 1, 2)))(HELD),
        "two ends",
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_what_got_through_is_refused_and_its_true_neighbour_is_not(name: str) -> None:
    false, true, said = CASES[name]
    with pytest.raises(RuleError, match=said):
        false()
    assert replayed(true()) is None


def test_a_law_with_a_kink_under_a_root_is_refused() -> None:
    with pytest.raises(UsageError, match="kink"):
        own_law("exp(-r - sqrt(r^4 + r^2)/(2 + 2*r^2))")
