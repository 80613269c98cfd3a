"""What may be said at all: in expressions, by names, as a definition or an equation of the model.

A comment names the model in which what is refused would be false.
"""

from __future__ import annotations

import warnings

import pytest
import sympy as sp
from sympy.core.function import AppliedUndef, UndefinedFunction

from derive.claims import Continuous, Drift, FirstZero, SlowEquation, landau_o
from derive.hypotheses import Kind
from derive.kernel import RuleError, replay_fault
from derive.laws import TANH, ContactLaw, r
from derive.note.model import contact
from derive.reals import LAW
from derive.rules.algebra import Insert
from derive.rules.assumption import assume
from derive.rules.limits import forever, later
from derive.symbols import initial, rate, symbol, symbols, t
from tests.derive.judgements import end, equal, supposed

u_c, U_a, U_c, h, p, sigma = symbols("u_c U_a U_c h p sigma")
h_0, f_c, C, T, N, q, k, b_0, U = symbols("h_0 f_c C T N q k b_0 U")
theta, kappa, tau, p_max = symbols("theta kappa tau p_max")
x, y = sp.symbols("x y", real=True)
HIDDEN, ALIKE = sp.Dummy("x", real=True), sp.Dummy("x", real=True)
OTHER = sp.Symbol("x", positive=True)
WIGGLE = sp.Function("wiggle", real=True)(t)
WOBBLE = sp.Function("wobble", real=True)(t)
SWAYS, POSITIVE = sp.Derivative(WIGGLE, t), sp.Function("wiggle", positive=True)(t)
PHASED = sp.Function("v", real=True)(tau)
CUT = sp.Piecewise((1, x <= 0), (0, True))
SUMMED, LATER = (sp.Integral(e, (t, 0, T)) for e in (WIGGLE, WIGGLE.subs(t, t + T)))
MEAN = sp.Integral(U_a, (t, 0, T))
STEPPED = b_0 + sp.Piecewise((1, b_0 >= 0), (0, True))


class Lie(sp.Expr):  # type: ignore[misc]
    """Something that says it is zero."""

    is_zero = is_commutative = True


class Between(sp.Expr):  # type: ignore[misc]
    """Something that says it is SymPy's."""

    is_commutative = is_real = is_zero = True
    __module__ = "sympy.core.numbers"


class Positive(sp.Symbol):  # type: ignore[misc]
    """A symbol that says it is positive, and f_c."""

    is_positive = True

    def __eq__(self, other: object) -> bool:
        return True

    def __hash__(self) -> int:
        return hash(f_c)


def with_a_slope_of_its_own() -> sp.Expr:
    """Return an unspecified function of y that is said to fall."""
    kind = type("Lying", (AppliedUndef,), {"fdiff": lambda *_: -sp.S.Half})
    return UndefinedFunction("lie", bases=(kind,), real=True)(y)


def unreduced() -> sp.Rational:
    """Return 0/2, which SymPy does not take for zero."""
    with warnings.catch_warnings(action="ignore"):  # a deprecated argument
        return sp.Rational(0, 2, 1)


def kinked(inside: sp.Expr) -> sp.Expr:
    return sp.exp(-r - sp.sqrt(inside) / (2 + 2 * r**2))


def touching(factor: sp.Expr) -> sp.Basic:
    """Return the contact law with its cutoff, times a factor."""
    law = factor * p_max * TANH.ratio(h / sigma)
    return sp.Eq(p, sp.Piecewise((law, sp.Le(h, 3 * sigma)), (0, True)))


NOTHING = sp.Mul(0, 1 / f_c, evaluate=False)
UNSPEAKABLE: tuple[tuple[sp.Expr, str], ...] = (
    # SymPy has no right signs for what it would not make by itself
    (h_0 + sp.tanh(0, evaluate=False), "not evaluated"),
    (h_0 + sp.log(1, evaluate=False), "not evaluated"),
    (sp.Abs(NOTHING, evaluate=False), "not evaluated"),
    (sp.Abs(sp.Mul(b_0, b_0, evaluate=False), evaluate=False), "not evaluated"),
    (sp.exp(sp.Add(b_0, b_0, evaluate=False)), "not evaluated"),
    (sp.Mul(unreduced(), WIGGLE, evaluate=False), "not evaluated"),
    (LAW(CUT), "not in a sum"),
    (sp.Derivative(u_c.subs(t, h_0), h_0), "rate and no slope"),
    (sp.Derivative(u_c.subs(t, t + T), T), "rate and no slope"),
    (sp.floor(2 - 1 / N), "of no kind"),
    (sp.tan(y), "of no kind"),
    (sp.asin(kappa - 1), "of no kind"),  # of the sine of 2 it is pi - 2
    (sp.atan(sp.tan(theta)), "of no kind"),
    (sp.oo, "of no kind"),  # 0 times oo
    (sp.Float(1e-20), "of no kind"),  # 1 + 1e-20
    (sp.Order(t), "of no kind"),  # t and 2 t
    (sp.MatrixSymbol("A", 2, 2) * sp.MatrixSymbol("B", 2, 2), "of no kind"),
    (h_0 + Lie(), "of no kind"),
    (h_0 + Between(), "of no kind"),
    (Positive("f_c", real=True), "of no kind"),
    (with_a_slope_of_its_own(), "of no kind"),
    (sp.log(h_0 / q, 2, evaluate=False), "no 1 parts"),
    (sp.Pow(sp.E, f_c, evaluate=False), "rational exponent"),
    (sp.Pow(0, f_c), "rational exponent"),
    (h_0**f_c, "rational exponent"),
    (2**b_0, "rational exponent"),
    (Drift(sp.S.One, sp.sin(2 * sp.pi * tau) / x, x, tau, N), "the pace rho"),
    (Drift(sp.S.One, 2 + N * h_0 / y, y, tau, symbol("rho")), "the pace rho"),
    (Drift(sp.S.One, 2 + h_0 / y, y, x, symbol("rho")), "the phase tau"),
    (Drift(sp.S.One, 2 + h_0, U_a, tau, symbol("rho")), "the phase tau"),
    (sp.Limit(WIGGLE, t, 0), "no limit for t"),  # nothing of the end follows
    (sp.Limit(f_c / k, k, sp.oo), "no limit for t"),
    (sp.sign(theta), "of no kind"),
    (sp.Integral(x * U_a, (t, 0, T), (x, 0, 1)), "two ends"),  # U_a jumps at every time
    (WIGGLE.subs(t, t - T), "at no time"),
    (sp.Symbol("f_c", positive=True), "not the f_c of the vocabulary"),
    (sp.Function("u_c", positive=True)(t), "not the u_c of the vocabulary"),
    (sp.Symbol("x") ** 2, "no real quantity"),  # i
    (sp.Symbol("x", zero=True), "no real quantity"),
    (sp.Symbol("f_c ", positive=True), "no real quantity"),
    (sp.Symbol("U_a(t)", positive=True), "no real quantity"),
    (sp.Dummy("x", real=True), "a name that others may have"),
    (x + sp.Symbol("x", positive=True), "one name"),
    (sp.Symbol("x1", real=True) + sp.Symbol("x_1", real=True), "one name"),
    (sp.Integral(x + HIDDEN, (HIDDEN, 0, 1)), "a name that others may have"),  # looks like 2 x
    (FirstZero(ALIKE - q, ALIKE), "a name that others may have"),
    (sp.Integral(x + OTHER, (OTHER, 0, 1)), "two variables of one name"),
    (sp.Lambda(x, 2 * x), "another type"),
    (FirstZero(q), "no 2 parts"),
    (sp.Symbol("pi", positive=True), "no real quantity"),
    (sp.Symbol("oo", real=True), "no real quantity"),
    (sp.Symbol("f_c_", positive=True), "no real quantity"),  # looks like f_c
    (sp.Symbol("sigmabar", real=True), "no real quantity"),  # looks like sigma
    (sp.Symbol("lamda", real=True), "no real quantity"),  # looks like lambda
    (sp.Symbol("xabs", real=True), "no real quantity"),  # looks like |x|, and may be -1
    (sp.Symbol("hprime", real=True), "no real quantity"),  # looks like the rate of h
    (sp.Symbol("phi", real=True), "no real quantity"),
    (sp.Symbol("h0", real=True), "no real quantity"),  # looks like h_0
    (sp.Symbol("e", real=True), "no real quantity"),
    (sp.Function("cosh", real=True)(t), "no real quantity"),
    (sp.Function("I_0", real=True)(t), "no real quantity"),
    (sp.Derivative(b_0, f_c, h_0), "no rate"),
    (sp.Symbol("o", real=True), "no real quantity"),
    (sp.Symbol("true", real=True), "no real quantity"),
    (sp.Function("exp", real=True)(t), "no real quantity"),
    (sp.Function("count", integer=True)(t), "no real quantity"),  # 1/2
    (sp.Function("w", negative=True)(t), "no real quantity"),  # 1
    (sp.Function("u_c", real=True)(t, x), "of no kind"),
    (sp.Derivative(u_c, f_c), "no rate"),
    (sp.Derivative(h, T), "no rate"),  # one period later, T is captured
    (sp.Derivative(h, u_c), "no rate"),
    (sp.Integral(u_c, (f_c, 0, 1)), "fixed"),
    (sp.Integral(b_0, (f_c, 0, 1)), "fixed"),  # b_0 = L f_c
    (sp.Integral(u_c * T, (T, 1, 2)), "fixed"),
    (FirstZero(b_0 - h_0, h_0), "fixed"),
    # as a name for theta, u_c would make it an integral over theta
    (sp.Integral(theta * u_c, (u_c, 0, q)), "no variable"),
    (sp.Integral(theta * initial("u_c"), (initial("u_c"), 0, q)), "no variable"),
    (sp.Derivative(LAW(h), h), "no variable"),  # no rate
    (sp.Derivative(LAW(SWAYS), SWAYS), "no variable"),  # that of no field
    (sp.Subs(sp.Derivative(LAW(U_a), U_a), t, -q), "no slope"),  # before the start
    (sp.Derivative(LAW(t), t), "no rate"),
    (sp.Subs(sp.Derivative(LAW(x), x), y, q), "no slope"),
    # the law of no number
    (LAW(sp.true), "another type"),
    (LAW(U_a <= q), "another type"),
    (LAW(Continuous(U_a)), "another type"),
    (sp.Subs(sp.Derivative(LAW(x), x), x, U_a <= q), "another type"),
    (sp.exp(sp.Lambda(x, x**2)), "another type"),
    (sp.Integral(sp.Tuple(x, q), (x, 0, q)), "another type"),
    (FirstZero(sp.Tuple(x, q), x), "another type"),
    (FirstZero(x <= q, x), "another type"),
    (sp.Limit(U_a <= q, t, sp.oo), "another type"),
    (sp.Piecewise((x <= q, x <= f_c), (0, True)), "another type"),
    (sp.exp(landau_o(q, t, sp.oo)), "not in a sum"),
    (sp.Subs(b_0, f_c, 1), "no slope"),
    (sp.Subs(rate("u_c"), t, T), "no slope"),  # of that no premise speaks
    (sp.Integral(N, (t, 0, T)), "fixed"),  # T/2, not N T
    (sp.Integral(PHASED, (t, 0, T)), "fixed"),
    (sp.Integral(U_a, (tau, 0, 1)), "fixed"),
    (sp.Limit(u_c * N, t, sp.oo), "fixed"),
    (sp.Integral(sp.Piecewise((1, N * U_a >= h_0), (0, True)), (t, 0, T)), "fixed"),
    (sp.Integral(1 / (q - k) ** 2, (q, 2 * q, 3 * q)), "own ends"),  # infinite for k = 5 q/2
    (sp.Integral(U_a, (t, 0, t + T)), "own ends"),
    (x + sp.Integral(x, (x, 0, q)), "free and bound"),
    (x - sp.Derivative(LAW(x), x), "free and bound"),
    (sp.Integral(1 / q, (q, 0, k)), "q is never 0"),  # infinite
    (sp.Integral(U_a, (t, -T, T)), "t is never -T"),  # nobody says what the load was
    (U_a.subs(t, t - T), "at no time"),
    # one form for each head
    (u_c.subs(t, sigma), "at no time"),
    (u_c.subs(t, 2 * t), "at no time"),
    (u_c.subs(t, h_0), "at no time"),
    (PHASED.subs(tau, 1), "at no time"),
    (sp.Derivative(u_c, (t, 2)), "no rate"),
    (sp.Piecewise((q, b_0 < 0), (0, True)), "0 beyond a bound"),
    (sp.Piecewise((q, b_0 <= 0)), "0 beyond a bound"),
    (sp.Piecewise((q, b_0 <= 0), (h_0, True)), "0 beyond a bound"),
    (sp.sin(f_c), "no wave"),
    (sp.cos(sp.pi * tau), "no wave"),
    (sp.besseli(sp.S.Half, x), "order 0"),  # imaginary for x = -1
    (FirstZero(U_a - h_0, t), "function of data"),
    (FirstZero(q, U_a), "function of data"),
    (sp.tanh(sp.LambertW(q)), "not in a sum"),
    (sp.exp(CUT), "not in a sum"),
    (sp.log(2 + CUT), "not in a sum"),
    (sp.Limit(CUT, t, sp.oo), "not in a sum"),
    (sp.Integral(rate("U_a") ** 2, (t, 0, T)), "not in a sum"),  # of sqrt(t/T) it has no value
    (sp.Piecewise((rate("u_c"), h <= 0), (0, True)), "not in a sum"),
    (FirstZero(q - x + CUT, x), "not in a sum"),
    (sp.Integral(1 + theta * MEAN, (theta, 0, q)), "not in a sum"),
    (sp.Limit(U_a + MEAN, t, sp.oo), "not in a sum"),
    (sp.Piecewise((q, MEAN >= 0), (0, True)), "not in a sum"),
)
SPEAKABLE: tuple[sp.Expr, ...] = (
    2 - 1 / k,
    sp.tanh(y),
    sp.log(1 + kappa),
    sp.Rational(1, 10**20),
    sp.Integral(f_c * h_0, (f_c, 0, 1)),
    sp.Derivative(b_0, f_c),
    sp.Derivative(PHASED, tau),
    sp.Integral(U_a * b_0, (t, 0, T)),
    sp.Integral(x * u_c, (x, 0, 1)),
    sp.Symbol("f_x", positive=True) + sp.Symbol("U_x", positive=True),
    sp.Symbol("lambda", real=True) * sp.Symbol("x_bar", real=True),
    LAW(r),
    x * y,
    U_a.subs(t, t + T),
    -sp.diff(LAW(y), y).subs(y, h / sigma),
    u_c.subs(t, N * T) + u_c.subs(t, 0),
    q * CUT + MEAN / T,
    U_a * sp.sin(4 * sp.pi * t / T) ** 2,
    sp.Integral(q * CUT, (q, 1, 2)),
)


@pytest.mark.parametrize(("expr", "said"), UNSPEAKABLE, ids=lambda part: str(part))
def test_what_is_not_of_the_language_is_refused(expr: sp.Expr, said: str) -> None:
    claim = equal(expr, h_0)
    for door in (Insert(claim), lambda: assume(supposed(claim))):
        with pytest.raises(RuleError, match=said):
            door()


@pytest.mark.parametrize("expr", SPEAKABLE, ids=str)
def test_what_is_of_the_language_can_be_said(expr: sp.Expr) -> None:
    assert replay_fault(assume(supposed(equal(expr, h_0)))) is None


MISCALLED: tuple[tuple[Kind, sp.Basic, str], ...] = (
    (Kind.CONDITION, sp.Eq(t, 5), "cannot be assumed"),  # t = 4
    (Kind.CONDITION, sp.Lt(t, T * WIGGLE.subs(t, 0)), "cannot be assumed"),  # later
    (Kind.CONDITION, sp.Lt(t, sp.Integral(U_a, (t, 0, T))), "cannot be assumed"),  # later
    (Kind.CONDITION, sp.And(sp.Gt(u_c, -h_0), sp.Lt(t, T)), "cannot be assumed"),  # later
    (Kind.CONDITION, sp.Ne(forever(u_c), h_0), "a value of the limit"),  # u_c = C t: none
    (Kind.CONDITION, sp.Eq(theta * forever(u_c), 0), "a value of the limit"),  # theta = 0
    (Kind.CONDITION, sp.Ge(forever(u_c), h_0), "a value of the limit"),
    (
        Kind.CONDITION,
        sp.Eq(u_c, h + landau_o(sp.S.One, t, sp.oo)),
        "cannot be assumed",
    ),  # 1/t and 2/t
    (Kind.DEFINITION, SlowEquation(f_c, h_0), "no equation"),  # it says what f_c is
    (Kind.CONDITION, Continuous(U_a, h), "no 1 parts"),
    (Kind.CONDITION, Continuous(initial("U_a")), "no property of a field"),  # it jumps afterwards
    (Kind.MODEL, sp.Le(sp.Abs(U_a), U), "no equation of the model"),  # under no k as U_a + p/k
    (Kind.MODEL, sp.Eq(f_c, 5), "no equation of the model"),  # f_c = 1
    (Kind.MODEL, touching(1 + f_c), "no equation of the model"),  # f_c = 1
    (Kind.MODEL, touching(1 + initial("sigma_c")), "no equation of the model"),
    (Kind.DEFINITION, equal(b_0, sp.Integral(sp.sqrt(PHASED), (tau, 0, 1))), "missing premise"),
    (Kind.CONDITION, equal(forever(u_c), C * t), "cannot be a limit"),
    (Kind.CONDITION, equal(forever(u_c), C * PHASED), "cannot be a limit"),
    (Kind.CONDITION, sp.Eq(f_c > 0, sp.true, evaluate=False), "another type"),
    (Kind.MODEL, touching(-sp.S.One), "no equation of the model"),  # p > 0
    (Kind.MODEL, contact(ContactLaw("", sp.exp(r), sp.S.Zero, "")), "decreases"),
    (Kind.MODEL, contact(ContactLaw("", sp.exp(-r - sp.Abs(r) / 2), sp.S.Zero, "")), "smooth"),
    (Kind.INITIAL, sp.Eq(initial("u_c"), h_0), "no equation of the model"),  # u_c(0) = 0
    (Kind.DEFINITION, sp.Gt(f_c, 0), "no equation"),  # f_c = -1
    (Kind.DEFINITION, sp.Eq(u_c, h_0), "is a new name"),  # u_c = 1
    (Kind.DEFINITION, sp.Eq(f_c, 5), "is a new name"),  # f_c = 1
    (Kind.DEFINITION, sp.Eq(f_c * h_0, 3), "is a new name"),  # f_c = 1
    (Kind.DEFINITION, equal(b_0, b_0 + 1), "is a new name"),
    (Kind.DEFINITION, equal(POSITIVE, WOBBLE), "is a new name"),  # wobble = U_a
    (Kind.DEFINITION, equal(WIGGLE.subs(t, 0), WOBBLE), "is a new name"),  # wobble = U_a
    (Kind.DEFINITION, equal(STEPPED, f_c), "is a new name"),  # f_c = 1/2
    (Kind.DEFINITION, equal(sp.log(f_c), sp.log(f_c)), "is a new name"),  # f_c = -1
    (Kind.DEFINITION, equal(rate("U_a"), rate("U_a")), "is a new name"),  # U_a jumps
    (Kind.DEFINITION, equal(f_c**2 + b_0**2, 0), "is a new name"),  # f_c = 1
    (Kind.DEFINITION, equal(sp.exp(b_0), f_c), "is a new name"),  # f_c = -1
    (Kind.DEFINITION, equal(WIGGLE**2, -f_c), "is a new name"),  # f_c = 1
    (Kind.DEFINITION, end(u_c, sp.oo), "is a new name"),  # u_c = h_0
    (Kind.DEFINITION, equal(forever(WIGGLE * u_c), 1), "is a new name"),  # u_c = 0
    (Kind.DEFINITION, equal(b_0, PHASED), "is constant"),
    (Kind.DEFINITION, equal(b_0, T * rate("u_c")), "is constant"),  # u_c = t^2
    (Kind.DEFINITION, equal(b_0, sp.Integral(x * u_c, (x, 0, 1))), "is constant"),  # u_c/2
    (Kind.DEFINITION, equal(WIGGLE.subs(t, 0), u_c), "is a new name"),  # u_c = t
    (Kind.DEFINITION, equal(WIGGLE.subs(t, 0) - WIGGLE, h_0), "is a new name"),  # t = 0
    (Kind.MODEL, contact(ContactLaw("", kinked(r**4 + r**2), sp.S.Zero, "")), "smooth"),
    (Kind.DEFINITION, equal(kappa * f_c, 0), "contradict"),  # f_c = 1
    (Kind.DEFINITION, equal(f_c * POSITIVE, 0), "is a new name"),  # f_c = 1
    (Kind.DEFINITION, equal(kappa + p_max, 0), "contradict"),
    (Kind.DEFINITION, equal(kappa + b_0, 0), "is a new name"),  # of which b_0 is negative
    (Kind.DEFINITION, equal(symbol("U_max"), h_0), "is a new name"),  # U_a = 2 h_0
    (Kind.DEFINITION, equal(symbol("U_mean"), h_0), "U_mean is"),  # U_a = 2 h_0
    (Kind.DEFINITION, equal(SWAYS, (1 + WIGGLE**2) / T), "is a new name"),  # tan(t/T)
    (Kind.DEFINITION, equal(SWAYS, C), "is a new name"),  # of a rate no solution is asked for
    (Kind.DEFINITION, equal(sp.Derivative(POSITIVE, t), -C), "is a new name"),
    (Kind.DEFINITION, equal(forever(WIGGLE - u_c), 1), "is a new name"),
    (Kind.DEFINITION, equal(T * b_0, t), "is a new name"),  # b_0 is constant
    (Kind.DEFINITION, equal(2 * b_0, h_0 * tau), "is a new name"),
    (Kind.DEFINITION, equal(N, t / (2 * T)), "N is t/T"),  # u_c = C t
    (Kind.DEFINITION, equal(symbol("omega"), C / T), "is a new name"),  # it is pi n/30
    (Kind.DEFINITION, equal(symbol("f_cc"), 0), "f_cc is f_c"),  # the roughness grows
    (Kind.DEFINITION, equal(symbol("rho"), h_0), "rho is f_c"),  # of the slow time
    (Kind.DEFINITION, equal(symbol("p_s"), p_max / 2), "is a new name"),  # int 1/(p_s - p_max)
    (Kind.DEFINITION, equal(sp.Function("w", positive=True)(t), u_c), "is a new name"),
    # a condition on the field that is meant: it is 0
    (Kind.DEFINITION, equal(WIGGLE + 1 / later(WIGGLE), 1 / later(WIGGLE)), "is a new name"),
    (Kind.DEFINITION, equal(f_c * later(WIGGLE) / WIGGLE + k * SWAYS, 0), "is a new name"),
    # which have many solutions: with a value for the field they would hide what else is said
    (Kind.DEFINITION, equal(forever(WIGGLE - WOBBLE), 0), "is a new name"),
    (Kind.DEFINITION, equal(f_c * WIGGLE, 0), "is a new name"),
    (Kind.DEFINITION, equal(SWAYS, later(SWAYS)), "is a new name"),
    (Kind.DEFINITION, equal(WIGGLE + SUMMED, SUMMED + U_a), "is a new name"),  # of any load
    (Kind.DEFINITION, equal(WIGGLE + LATER, LATER + U_a), "is a new name"),
    # that ends
    (Kind.DEFINITION, equal(WIGGLE, sp.log(1 - t / T)), "missing premise: 1 - t/T > 0"),
    (Kind.DEFINITION, equal(t, 5), "t is T"),  # t = 4
    (Kind.DEFINITION, equal(N, u_c / h_0), "N is t/T"),  # u_c = -h_0 t/T
)
CALLED: tuple[tuple[Kind, sp.Basic], ...] = (
    (Kind.CONDITION, sp.Eq(u_c, C * t)),
    (Kind.CONDITION, end(u_c, sp.oo)),
    (Kind.MODEL, sp.Eq(k * U_c - p, 0)),
    (Kind.MODEL, touching(sp.S.One)),
    (Kind.INITIAL, sp.Eq(initial("u_c"), 0)),
    (Kind.DEFINITION, sp.Eq(T * b_0, 3)),
    (Kind.DEFINITION, equal(f_c**2 + b_0, 0)),
    (Kind.DEFINITION, equal(b_0, sp.exp(f_c))),
    (Kind.DEFINITION, equal(WIGGLE * q, -f_c)),
    (Kind.DEFINITION, equal(N, t / T)),
    (Kind.MODEL, contact(ContactLaw("", kinked(1 + r**2), sp.S.Zero, ""))),
    (Kind.DEFINITION, equal(f_c * b_0, 0)),
    (Kind.DEFINITION, equal(symbol("f_cc"), f_c)),
    (Kind.DEFINITION, equal(symbol("U_max") + kappa, h_0)),
    (Kind.DEFINITION, equal(later(rate("u_inf")), rate("u_inf"))),
)


@pytest.mark.parametrize(("kind", "relation", "said"), MISCALLED, ids=str)
def test_a_hypothesis_is_of_the_kind_that_it_is_called(
    kind: Kind, relation: sp.Basic, said: str
) -> None:
    with pytest.raises(RuleError, match=said):
        assume(supposed(relation, kind))


@pytest.mark.parametrize(
    ("relation", "conditions"),
    [
        (equal(f_c * b_0, 3), [sp.Ne(f_c, 0)]),
        (equal(b_0 + sp.log(f_c), sp.log(f_c) + h_0), [sp.Gt(f_c, 0)]),
        (equal(b_0 * (f_c - h_0), 0), [sp.Ne(f_c - h_0, 0)]),
        (equal(b_0 * sp.log(f_c), 0), [sp.Gt(f_c, 0), sp.Ne(sp.log(f_c), 0)]),
        (equal(WIGGLE + sp.log(f_c), sp.log(f_c)), [sp.Gt(f_c, 0)]),
        (equal(2 * C, f_c * h_0), [sp.Gt(f_c * h_0 / 2, 0, evaluate=False)]),
        (
            equal(q - symbol("U_max") / p_max, 0),
            [sp.Gt(symbol("U_max") / p_max, 0, evaluate=False)],
        ),
    ],
    ids=str,
)
def test_a_definition_shows_what_its_value_supposes(
    relation: sp.Equality, conditions: list[sp.Basic]
) -> None:
    shown = assume(supposed(relation, Kind.DEFINITION)).conditions
    assert [hypothesis.relation for hypothesis in shown] == conditions


@pytest.mark.parametrize(("kind", "relation"), CALLED, ids=str)
def test_what_is_called_by_its_kind_can_be_assumed(kind: Kind, relation: sp.Basic) -> None:
    assert replay_fault(assume(supposed(relation, kind))) is None
