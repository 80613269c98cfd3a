"""Repairs of SymPy: what it takes for 0, or for equal, would prove false claims."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable

import pytest
import sympy as sp
from flint import arb, ctx
from hypothesis import given
from hypothesis import strategies as st

from derive.kernel import Judgement, RuleError
from derive.language import fault
from derive.reals import LAW, holds
from derive.repairs import ball, sign_of
from derive.rules.algebra import Insert, Solve, substitute
from derive.rules.growth import Diverges, unbounded
from derive.rules.inequalities import Arithmetic, Lipschitz, LogarithmicSlope, Monotone
from derive.symbols import rate, symbols, t
from tests.derive.judgements import defined, eq, equal, ge

u_c, G, h, h_0, x_inf, theta, q, kappa, C, f_c = symbols("u_c G h h_0 x_inf theta q kappa C f_c")
x, y = sp.symbols("x y", real=True)
LITTLE = sp.log(1 + sp.exp(-30))
LESS = sp.log(1 + sp.Rational(1, 10**20)) - sp.Rational(1, 10**30)
NEXT_TO_NOTHING = sp.sqrt(1 + sp.exp(-300)) - 1
ZERO = sp.pi * LITTLE - sp.pi * (sp.log(sp.exp(30) + 1) - 30)
DISGUISED = (1 + 1 / (1 + sp.sqrt(2))) ** 2 - 2
BEYOND = sp.sqrt(1 + sp.exp(-(10**6))) - 1
BALANCED = sp.Integral(1 - 2 * sp.Piecewise((1, x >= 0), (0, True)), (x, -1, 1))  # 0
SPIKE = sp.Integral(10**6 * (1 - sp.tanh(10**6 * x - 10**6 / 3) ** 2), (x, 0, 1))  # 2
SUMMED = sp.Integral(x - theta, (x, 0, q))  # 0 for q = 2 theta
GROWN = Arithmetic(sp.Ge(t, t, evaluate=False))


def signs(number: sp.Expr) -> tuple[object, ...]:
    """Return what SymPy says about a sign in all ways."""
    order = number > 0, number >= 0, number < 0, number <= 0, sp.Eq(number, 0)
    return *order, number.is_positive, number.is_negative


POSITIVE = (True, True, False, False, False, True, False)
NEGATIVE = (False, False, True, True, False, False, True)


@pytest.mark.parametrize("k", [1, 9, 15, 16, 20, 33, 60, 300])
def test_signs_are_those_of_what_is_left_beside_one(k: int) -> None:
    small = sp.Rational(1, 10**k)
    for above in (sp.log(1 + small), sp.log(1 + sp.exp(-k)), -sp.log(sp.tanh(k))):
        assert signs(above) == POSITIVE
        assert signs(small**3 - above) == NEGATIVE
    assert signs(sp.log(1 - small)) == NEGATIVE


@pytest.mark.parametrize(
    "function",
    [sp.tanh, sp.sin, sp.LambertW, sp.sqrt, sp.cbrt, sp.Abs, abs, lambda x: 1 / x,
     lambda x: sp.besseli(0, x) - 1, lambda x: 1 - sp.cos(x), lambda x: -sp.Ei(x)],
)  # fmt: skip
def test_functions_of_a_difference_that_nearly_vanishes(
    function: Callable[[sp.Expr], sp.Expr],
) -> None:
    number = function(NEXT_TO_NOTHING)
    assert signs(number)[:5] == POSITIVE[:5]
    assert signs(-number)[:5] == NEGATIVE[:5]
    assert number.is_positive in (True, None)  # SymPy does not know that Ei and I_0 are real


def test_a_sign_that_no_ball_decides_is_left_open() -> None:
    for above in (BEYOND, sp.tanh(BEYOND), ZERO):
        assert sign_of(above) is None
        assert signs(above - above * sp.pi)[-2:] == (None, None)
        assert sp.Le(above, 0) not in (sp.true, sp.false)
    assert ZERO.is_nonzero is None
    assert sp.log(1) == 0


@pytest.mark.parametrize("zero", [ZERO, DISGUISED, sp.log(DISGUISED / 2 + 1)])
def test_a_zero_in_disguise_is_not_told_to_be_another_number(zero: sp.Expr) -> None:
    for sign in ("zero", "nonzero", "positive", "negative", "extended_nonzero"):
        assert getattr(zero, f"is_{sign}") is None
    assert sp.Ne(zero, 0) not in (sp.true, sp.false)
    assert (zero * f_c).is_nonzero is None


def test_roots_of_a_number_without_a_sign_stay_roots() -> None:
    """SymPy would take log(1 + e) for 0, and so a root of 1/b for -1/sqrt(b)."""
    e = sp.Rational(1, 2**10000) * sp.exp(-6000)
    b = sp.log(1 + e) - e / 2
    for whole in (1 / b, b**2, b**3, b**-3):
        assert sp.sqrt(whole) == sp.Pow(whole, sp.S.Half, evaluate=False)
    assert sp.sqrt((4 - sp.pi) ** -3) == (4 - sp.pi) ** sp.Rational(-3, 2)


def test_no_quadrature_decides_a_sign() -> None:
    for area in (BALANCED, SPIKE):
        assert {sp.Gt(area, 0), sp.Lt(area, 1), sp.Ne(area, 0)}.isdisjoint({sp.true, sp.false})
        assert (area.is_positive, area.is_zero) == (None, None)


def test_numbers_outside_of_claims_have_signs_too() -> None:
    assert 2**sp.pi > 8
    assert (-sp.pi) ** 3 < -31
    assert sp.Le(sp.LambertW(-sp.S.Half / 2, -1), 0) is not sp.false
    assert sp.gamma(sp.Rational(1, 3)) > 2
    assert sp.Float("1.5") + sp.pi > 4
    assert sp.pi < sp.oo
    assert not sp.I.is_positive


rationals = st.builds(sp.Rational, st.integers(-9, 9), st.integers(1, 9))
numbers = st.recursive(
    rationals | st.just(sp.pi) | st.just(sp.E),
    lambda n: st.one_of(
        *(st.builds(head, n) for head in (sp.exp, sp.tanh, sp.sin, sp.cos, sp.Abs)),
        *(st.builds(head, n, n) for head in (sp.Add, sp.Mul)),
        st.builds(lambda x, e: (1 + x**2) ** e, n, rationals),
        st.builds(lambda x: sp.log(1 + x**2), n),
    ),
    max_leaves=6,
)


@given(numbers)
def test_balls_contain_the_values_of_sympy(number: sp.Expr) -> None:
    found = ball(number)
    with ctx.workprec(200):
        value = arb(str(sp.N(number, 60)))
        nearest = found is None or found.overlaps(value + arb(0, 1) * abs(value) * arb(10) ** -50)
        assert nearest or abs(found - value) < arb(10) ** -50


def test_constants_are_known_by_their_balls() -> None:
    assert holds(sp.Gt(h * sp.besseli(0, 1), h, evaluate=False), frozenset([sp.Gt(h, 0)]))
    assert not holds(sp.Gt(h * ZERO, h, evaluate=False), frozenset([sp.Gt(h, 0)]))


def test_signs_from_before_are_refused() -> None:
    script = (
        "import sympy as sp; e = sp.log(1 + sp.exp(-30)) - sp.exp(-60); print(e.is_positive);"
        "from derive.language import fault; print(fault(e), e.is_positive, (3 * e).is_positive)"
    )
    done = subprocess.check_output([sys.executable, "-c", script], text=True)
    first, second = done.splitlines()
    assert first == "False"
    assert second.endswith("has a sign without proof False True")
    assert fault(LITTLE - sp.exp(-60)) is None


FALSE: dict[str, Callable[[], Judgement]] = {
    "a slope beyond 1": lambda: Lipschitz(
        sp.Lambda(y, -(1 + LITTLE) * y), sp.S.Zero, sp.S.One, sp.S.One)(),
    "a step back": lambda: Lipschitz(sp.Lambda(y, -sp.tanh(y)), sp.S.Zero, -LESS, sp.S.One)(),
    "a slope of 1 below 1": lambda: LogarithmicSlope(
        sp.Lambda(y, sp.exp(y)), sp.S.One, sp.S.Zero, 1 - LESS)(),
    "growth downwards": lambda: Diverges(-LESS * t)(GROWN()),
    "a tiny growth downwards": lambda: Diverges(-sp.tanh(NEXT_TO_NOTHING) * t)(GROWN()),
    "a negative rate": lambda: unbounded(eq(rate("u_c"), -LESS * C)),
    "division by 0": lambda: Solve(G)(eq(ZERO * G, ZERO * h)),
    "division by a zero in disguise": lambda: Solve(G)(eq(DISGUISED * G, DISGUISED * h)),
    "division by the integral of what has both signs": lambda: Solve(G)(
        eq(SUMMED * G, SUMMED * h)),
    "1 < 0": lambda: Arithmetic(sp.Le(sp.tanh(NEXT_TO_NOTHING), 0, evaluate=False))(),
}  # fmt: skip
"""What would follow from a wrong sign."""


@pytest.mark.parametrize("build", FALSE.values(), ids=FALSE)
def test_no_rule_takes_the_wrong_sign(build: Callable[[], Judgement]) -> None:
    with pytest.raises(RuleError, match="missing premise"):
        build()


def test_conclusions_have_the_right_sign() -> None:
    pieces = eq(G, sp.Piecewise((q, sp.Le(sp.log(x_inf), 0)), (0, True)))
    assert substitute(pieces, eq(x_inf, 1 + sp.exp(-30))).relation == sp.Eq(G, 0)
    for positive in (LITTLE - sp.exp(-60), sp.tanh(NEXT_TO_NOTHING)):
        moved = substitute(eq(G, sp.Abs(x_inf)), eq(x_inf, positive))
        assert moved.relation.rhs == positive
    falls = Monotone(sp.Lambda(y, -LESS * y))(ge(x_inf, theta))
    assert falls.relation == sp.Le(-LESS * x_inf, -LESS * theta)
    with pytest.raises(RuleError, match="contradict"):
        defined(kappa, -LESS)


def test_slopes_of_the_law_are_one_only_at_one_point():
    """SymPy compares how points print: e like a quantity E."""

    def slope(variable: sp.Symbol, point: sp.Expr) -> sp.Subs:
        return sp.Subs(sp.Derivative(LAW(variable), variable), variable, point)

    named = sp.Symbol("E", real=True)
    assert slope(x, sp.E) != slope(x, named)
    assert slope(x, q) == slope(y, q)
    assert hash(slope(x, q)) == hash(slope(y, q))
    with pytest.raises(RuleError, match="no real quantity"):
        Insert(equal(slope(x, sp.E), slope(x, named)))()
