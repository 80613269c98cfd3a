"""The rules of analysis refuse what their theorems do not cover."""

from __future__ import annotations

import pytest
import sympy as sp

from derive.laws import ContactLaw, r
from derive.results.steady_state import steady_state
from derive.rules import Given, RuleError
from derive.rules.bounds import Consequence, Grows, LogarithmicSlope, Monotone
from derive.rules.drift import LogarithmicDrift
from derive.rules.limits import (
    Accumulates,
    AtInfinity,
    Diverges,
    Passes,
    Unbounded,
    Vanishes,
    forever,
    in_terms_of,
    later,
)
from derive.rules.sign import sign
from derive.statement import Statement, given
from derive.symbols import initial, rate, symbol, symbols, t
from derive.zero import is_zero

u_c, U_a, U, h_0, sigma_c0, f_c, C = symbols("u_c U_a U h_0 sigma_c0 f_c C")
START = sp.Eq(initial("u_c"), 0)
y = sp.Symbol("y", real=True)


def passes(claim: sp.Basic, *known: sp.Basic) -> bool:
    parents = tuple(given(k, "known") for k in known)
    return Statement(claim, Passes(), parents).checks[1].passed


@pytest.mark.parametrize(
    ("expr", "found"),
    [
        (sp.exp(y), 1),
        (1 + sp.tanh(y), 1),
        (sp.tanh(y) - 2, -1),
        (sp.tanh(y), None),
        (y, None),
        (1 - sp.tanh(y) ** 2, 1),
    ],
)
def test_sign_is_told_only_where_it_is_manifest(expr: sp.Expr, found: int | None) -> None:
    assert sign(expr) == found


def test_a_function_that_is_not_monotone_is_refused() -> None:
    with pytest.raises(RuleError, match="not manifestly monotone"):
        Monotone(sp.Lambda(y, y**2)).apply((sp.Ge(u_c, h_0),))


def test_a_decreasing_function_turns_the_bound() -> None:
    claim = Monotone(sp.Lambda(y, sp.exp(-y))).apply((sp.Ge(u_c / h_0, 1),))
    assert claim == sp.Le(sp.exp(-u_c / h_0), sp.exp(-1))


@pytest.mark.parametrize("least", [-C, sp.Integer(0), C * u_c, C * t, f_c * C])
def test_growth_needs_a_positive_constant(least: sp.Expr) -> None:
    with pytest.raises(RuleError):
        Grows().apply((sp.Ge(rate("u_c"), least, evaluate=False), START))


def test_growth_needs_the_start_of_the_same_field() -> None:
    with pytest.raises(RuleError):
        Grows().apply((sp.Ge(rate("u_c"), C), sp.Eq(initial("u_a"), 0)))


@pytest.mark.parametrize("expr", [sigma_c0 - C * u_c, sigma_c0 + f_c * u_c, 1 - 1 / (1 + u_c)])
def test_what_need_not_increase_beyond_all_bounds_does_not_diverge(expr: sp.Expr) -> None:
    with pytest.raises(RuleError):
        Diverges(expr).apply((sp.Ge(u_c, C * t),))


def test_only_a_squeeze_vanishes() -> None:
    divergence = sp.Eq(forever(sigma_c0 + u_c), sp.oo)
    size, bounded = sigma_c0 + u_c, U_a / (sigma_c0 + u_c)
    squeeze = sp.And(sp.Le(bounded, U / size), sp.Ge(bounded, -U / size))
    assert Vanishes().apply((squeeze, divergence)) == sp.Eq(forever(bounded), 0)
    for wrong in (
        sp.And(sp.Le(bounded, U), sp.Ge(bounded, -U)),
        sp.And(sp.Le(bounded, U / size), sp.Ge(bounded, -u_c / size)),
        sp.And(sp.Le(bounded, U / size), sp.Ge(U_a, -U / size)),
    ):
        with pytest.raises(RuleError):
            Vanishes().apply((wrong, divergence))


def test_limits_pass_through_continuous_functions_only() -> None:
    known = sp.Eq(forever(rate("u_c")), C)
    assert passes(sp.Eq(forever(later(rate("u_c")) - rate("u_c")), 0), known)
    assert not passes(sp.Eq(forever(sp.sign(rate("u_c") - C)), 0), known)
    assert not passes(sp.Eq(forever(u_c), 0), known)
    assert not passes(sp.Eq(forever(rate("u_c")), 2 * C), known)


def test_a_quantity_is_written_in_terms_of_another() -> None:
    ratio = (h_0 + u_c - U_a) / (sigma_c0 + f_c * u_c)
    assert in_terms_of(sp.tanh(4 - 2 * ratio), ratio, y) == sp.tanh(4 - 2 * y)
    assert later(ratio).has(u_c.subs(t, t + symbols("T")[0]))


def test_wear_of_a_period_needs_a_limit_of_the_rate() -> None:
    assert Accumulates().apply((sp.Eq(forever(rate("u_c")), C),)).rhs == C * symbols("T")[0]


def test_wear_is_unbounded_only_if_the_rate_is_positive() -> None:
    positive = sp.Eq(rate("u_c"), C * sp.exp(U_a / U - u_c / U))
    assert Unbounded().apply((positive,)) == sp.Eq(forever(u_c), sp.oo)
    for wrong in (C * U_a, C - C * u_c / U, C * rate("U_a")):
        with pytest.raises(RuleError):
            Unbounded().apply((sp.Eq(rate("u_c"), wrong),))


def test_a_limit_at_infinity_is_taken_again() -> None:
    divergence = Statement(sp.Eq(forever(u_c), sp.oo), Given("growth"))
    right = sp.Eq(forever((u_c - U_a) / (2 * u_c + h_0)), sp.Rational(1, 2))
    wrong = sp.Eq(right.lhs, sp.Rational(1, 3))
    assert all(c.passed for c in Statement(right, AtInfinity(), (divergence,)).checks[1:])
    assert not any(c.passed for c in Statement(wrong, AtInfinity(), (divergence,)).checks[1:])


@pytest.mark.parametrize(("bound", "held"), [(2, True), (1, False)])
def test_the_slope_of_a_logarithm_is_bounded(bound: int, held: bool) -> None:
    function = sp.Lambda(y, 1 + sp.tanh(y))
    a, b = U_a / U, h_0 / U
    rule = LogarithmicSlope(function, a, b, sp.Integer(bound))
    claim = sp.Le(sp.Abs(sp.log(function(a) / function(b))), bound * sp.Abs(a - b))
    assert Statement(claim, rule).checks[1].passed is held


def test_a_drift_needs_its_form() -> None:
    T, mean = symbols("T U_mean")
    right = sp.Eq(forever(t * (rate("u_c") - C) - f_c * U_a), 0)
    made = LogarithmicDrift((U_a, mean)).apply((right,))
    assert made == sp.Eq(forever((u_c - C * t) / sp.log(t / T)), f_c * mean)
    for wrong in (
        sp.Eq(right.lhs, 1),
        sp.Eq(forever(t * (rate("u_c") - C) - U_a**2 / U), 0),
        sp.Eq(forever(t**2 * (rate("u_c") - C) - f_c * U_a), 0),
    ):
        with pytest.raises(RuleError):
            LogarithmicDrift((U_a, mean)).apply((wrong,))


def test_a_consequence_must_be_its_parent_rewritten() -> None:
    parent = given(sp.Ge(u_c, h_0), "known")
    other = given(sp.Eq(h_0, 2 * sigma_c0), "definition", h_0)
    assert Statement(sp.Ge(u_c, 2 * sigma_c0), Consequence(), (parent, other)).checks[1].passed
    assert not Statement(sp.Ge(u_c, sigma_c0), Consequence(), (parent, other)).checks[1].passed


def test_a_law_of_square_roots_has_a_steady_state():
    """Its positivity is no matter of exponentials: a root outweighs what it is of."""
    law = ContactLaw("algebraic", (1 - r / sp.sqrt(1 + r**2)) / 2, sp.Integer(0), "a test")
    limit = steady_state(law)
    assert is_zero(limit.pressure.claim.rhs / symbol("p_max") - law.ratio(1 / symbol("f_c")))
    assert all(outcome.passed for outcome in limit.growth.checks)
