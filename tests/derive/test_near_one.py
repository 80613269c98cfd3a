"""Logarithms of numbers near 1: what SymPy takes for 0 would prove false claims."""

from __future__ import annotations

from collections.abc import Callable

import pytest
import sympy as sp

from derive.kernel import Judgement, RuleError
from derive.rules.algebra import Solve, substitute
from derive.rules.growth import Diverges, unbounded
from derive.rules.inequalities import Arithmetic, Lipschitz, LogarithmicSlope, Monotone
from derive.symbols import rate, symbols, t
from tests.derive.judgements import defined, eq, ge

u_c, G, h, h_0, x_inf, theta, q, kappa, C = symbols("u_c G h h_0 x_inf theta q kappa C")
y = sp.Symbol("y", real=True)
LITTLE = sp.log(1 + sp.exp(-30))
LESS = sp.log(1 + sp.Rational(1, 10**20)) - sp.Rational(1, 10**30)
ZERO = sp.pi * LITTLE - sp.pi * (sp.log(sp.exp(30) + 1) - 30)
GROWN = Arithmetic(sp.Ge(t, t, evaluate=False))


@pytest.mark.parametrize("k", [1, 9, 15, 16, 20, 33, 60])
def test_signs_are_those_of_what_is_left_beside_one(k: int) -> None:
    small = sp.Rational(1, 10**k)
    for above in (sp.log(1 + small), sp.log(1 + sp.exp(-k)), -sp.log(sp.tanh(k))):
        assert (above > 0, above <= 0, above.is_positive) == (True, False, True)
        assert (above - small**3 > 0, (small**3 - above).is_negative) == (True, True)
    below = sp.log(1 - small)
    assert (below < 0, below.is_nonnegative) == (True, False)


@pytest.mark.parametrize("k", [12, 20, 45])
def test_values_are_those_of_the_series(k: int) -> None:
    small = sp.Rational(1, 10**k)
    series = small - small**2 / 2 + small**3 / 3
    assert sp.log(1 + small).evalf(30) == sp.Float(series, 30)


def test_a_sign_beyond_the_digits_of_sympy_is_left_open() -> None:
    for above in (sp.log(1 + sp.exp(-300)), -sp.log(sp.tanh(300)), LITTLE + sp.exp(-900) - LITTLE):
        assert above.is_nonpositive is not True
        assert sp.Le(above, 0) != sp.true


def test_zero_stays_zero() -> None:
    assert sp.log(1) == 0
    assert ZERO.is_nonzero is None
    assert sp.log(sp.sin(1) ** 2 + sp.cos(1) ** 2).is_positive is None


FALSE: dict[str, Callable[[], Judgement]] = {
    "a slope beyond 1": lambda: Lipschitz(
        sp.Lambda(y, -(1 + LITTLE) * y), sp.S.Zero, sp.S.One, sp.S.One)(),
    "a step back": lambda: Lipschitz(sp.Lambda(y, -sp.tanh(y)), sp.S.Zero, -LESS, sp.S.One)(),
    "a slope of 1 below 1": lambda: LogarithmicSlope(
        sp.Lambda(y, sp.exp(y)), sp.S.One, sp.S.Zero, 1 - LESS)(),
    "growth downwards": lambda: Diverges(-LESS * t)(GROWN()),
    "a negative rate": lambda: unbounded(eq(rate("u_c"), -LESS * C)),
    "division by 0": lambda: Solve(G)(eq(ZERO * G, ZERO * h)),
}  # fmt: skip
"""What would follow from a wrong sign."""


@pytest.mark.parametrize("build", FALSE.values(), ids=FALSE)
def test_no_rule_takes_the_wrong_sign(build: Callable[[], Judgement]) -> None:
    with pytest.raises(RuleError, match="missing premise"):
        build()


def test_conclusions_have_the_right_sign() -> None:
    pieces = eq(G, sp.Piecewise((q, sp.Le(sp.log(x_inf), 0)), (0, True)))
    assert substitute(pieces, eq(x_inf, 1 + sp.exp(-30))).relation == sp.Eq(G, 0)
    positive = LITTLE - sp.exp(-60)
    moved = substitute(eq(G, sp.Abs(x_inf)), eq(x_inf, positive))
    assert moved.relation.rhs == positive
    falls = Monotone(sp.Lambda(y, -LESS * y))(ge(x_inf, theta))
    assert falls.relation == sp.Le(-LESS * x_inf, -LESS * theta)
    named = defined(kappa, -LESS)
    assert any(h.shown for h in named.hypotheses)
