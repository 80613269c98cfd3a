"""The zero test says zero only of what is zero."""

import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

from derive.zero import is_zero, same

x, y = sp.symbols("x y", real=True)
a, b = sp.symbols("a b", positive=True)

IDENTITIES = [
    sp.tanh(x) - (sp.exp(x) - sp.exp(-x)) / (sp.exp(x) + sp.exp(-x)),
    (1 + sp.tanh(4 - 2 * x)) / 2 - 1 / (1 + sp.exp(4 * x - 8)),
    sp.tanh((4 * a - 2 * b) / a) - sp.tanh(4 - 2 * b / a),
    sp.sqrt((a + b) ** 2) - a - b,
    sp.sqrt(a**2 + 2 * a * b + b**2 + x**2) - sp.sqrt((a + b) ** 2 + x**2),
    sp.exp(x + y) - sp.exp(x) * sp.exp(y),
    1 / (1 + a) + a / (1 + a) - 1,
]


@pytest.mark.parametrize("expr", IDENTITIES, ids=str)
def test_identities_are_found(expr: sp.Expr) -> None:
    assert is_zero(expr)


@pytest.mark.parametrize("expr", IDENTITIES, ids=str)
@pytest.mark.parametrize("extra", [sp.Rational(1, 10**30), x, sp.exp(-b), a * sp.tanh(x)])
def test_a_little_more_is_not_zero(expr: sp.Expr, extra: sp.Expr) -> None:
    assert not is_zero(expr + extra)


def test_a_field_is_no_constant() -> None:
    f = sp.Function("f", positive=True)(x)
    assert not is_zero(sp.Integral(f, (x, 0, 1)) - f)
    assert not is_zero(sp.diff(f, x))
    assert is_zero(sp.log(f * a) - sp.log(f) - sp.log(a))


def _expressions() -> st.SearchStrategy[sp.Expr]:
    leaves = st.sampled_from([x, y, a, b, sp.Integer(2), sp.Rational(1, 3)])
    return st.recursive(
        leaves,
        lambda inner: st.one_of(
            st.builds(lambda p, q: p + q, inner, inner),
            st.builds(lambda p, q: p * q, inner, inner),
            st.builds(lambda p: sp.tanh(p), inner),
            st.builds(lambda p: 1 / (1 + p**2), inner),
        ),
        max_leaves=5,
    )


@given(_expressions(), _expressions())
def test_zero_is_never_claimed_of_what_has_another_value(left: sp.Expr, right: sp.Expr) -> None:
    difference = left - right
    point = {
        x: sp.Rational(3, 7),
        y: sp.Rational(-5, 11),
        a: sp.Rational(2, 9),
        b: sp.Rational(7, 5),
    }
    if abs(sp.N(difference.subs(point), 40)) > 1e-25:
        assert not is_zero(difference)
    assert is_zero(difference - difference.expand())


def test_relations_are_the_same_side_by_side() -> None:
    assert same(sp.Eq(x, a + b), sp.Eq(x, b + a))
    assert not same(sp.Eq(x, a), sp.Eq(a, x, evaluate=False))
    assert not same(sp.Lt(x, a), sp.Le(x, a))
