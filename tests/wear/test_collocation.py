"""Nodes and matrices: exact for polynomials, spectral for smooth functions."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from wear.numerics import chebyshev
from wear.numerics import gauss as c


@pytest.mark.parametrize("m", [4, 14, 24, 30])
def test_gauss_integrates_polynomials_exactly(m):
    rule = c.gauss(m)
    for degree in (0, 1, m - 1):
        values = rule.nodes**degree
        assert_allclose(
            rule.integrate @ values, rule.nodes ** (degree + 1) / (degree + 1), atol=3e-16
        )
    for degree in (m, 2 * m - 1):  # the quadrature goes on to twice the order
        assert_allclose(rule.weights @ rule.nodes**degree, 1 / (degree + 1), rtol=1e-13)


def test_legendre_coefficients_give_the_values_back():
    rule = c.gauss(9)
    values = np.exp(rule.nodes)
    series = rule.coefficients @ values
    assert_allclose(np.polynomial.legendre.legval(2 * rule.nodes - 1, series), values, rtol=1e-14)


def test_running_integral_goes_on_across_intervals():
    over = c.mesh(np.array([0.0, 0.3, 0.35, 1.0]), 16)
    got = c.running_integral(np.cos(5 * over.phases), over)
    assert_allclose(got, np.sin(5 * over.phases) / 5, atol=1e-15)
    assert_allclose(c.integral(np.cos(5 * over.phases), over), np.sin(5.0) / 5, rtol=1e-14)


def test_a_product_in_pieces_is_the_product(monkeypatch):
    left, right = np.arange(21.0).reshape(7, 3), np.arange(12.0).reshape(3, 4)
    monkeypatch.setattr(c, "ONE_THREAD", 24)  # two rows at once
    assert_allclose(c.product(left, right), left @ right, rtol=1e-15)
    assert_allclose(c.product(left, right[:, 0]), left @ right[:, 0], rtol=1e-15)
    assert_allclose(c.coefficients(right.T, left), (left @ right).T, rtol=1e-15)


def test_many_meshes_at_once_are_each_its_own():
    edges = np.array([[[0.0, 0.3, 1.0]], [[0.0, 0.6, 1.0]]])
    together = c.mesh(edges, 7)
    values = np.cos(together.phases)
    for i in range(2):
        alone = c.mesh(edges[i, 0], 7)
        assert_allclose(together.phases[i, 0], alone.phases)
        got = c.running_integral(values, together)[i, 0]
        assert_allclose(got, c.running_integral(values[i, 0], alone), rtol=1e-15)
        assert_allclose(c.integral(values, together)[i, 0], c.integral(values[i, 0], alone))


def test_values_at_finer_nodes():
    coarse, fine = c.gauss(5).nodes, c.gauss(8).nodes
    assert_allclose(coarse**4 @ c.between_nodes(5, 8), fine**4, atol=1e-15)


@pytest.mark.parametrize("m", [24, 48])
def test_a_constant_has_no_chebyshev_tail(m):
    """Errors of n^2 roundoffs in T_n made one, and cost pressures their last three digits."""
    series = chebyshev.chebyshev_analysis(m) @ np.ones(m)
    assert_allclose(series, np.eye(m)[0], atol=1e-15)


def test_chebyshev_analysis_inverts_evaluation_and_extrapolates():
    m = 11
    series = np.linspace(1.0, -2.0, m)
    nodes = chebyshev.chebyshev_nodes(m)
    assert_allclose(
        chebyshev.chebyshev_analysis(m) @ (chebyshev.chebyshev_values(nodes, m) @ series),
        series,
        atol=1e-14,
    )
    at = np.array([[-1.1, 0.2], [1.05, 1.0]])
    want = np.polynomial.chebyshev.chebval(at, series)
    assert_allclose(chebyshev.chebyshev_values(at, m) @ series, want, rtol=1e-12)
