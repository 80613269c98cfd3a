"""Abel's equation against maps whose count is known in closed form."""

import numpy as np
import pytest
from numpy.polynomial.chebyshev import chebval
from numpy.polynomial.legendre import leggauss
from numpy.testing import assert_allclose

from wear.numerics.chebyshev import chebyshev_nodes
from wear.numerics.gauss import FloatArray
from wear.numerics.rows import take
from wear.orbit import abel
from wear.orbit.iterates import count_table

SHIFT = 0.3


def panels(edges: FloatArray, m: int, slope: float) -> abel.Density:
    """Density for P(u) = (u + c) exp(slope) - c: n = ln(u + c)/slope."""
    grid = abel.grid(SHIFT, edges[:-1], edges[1:])
    wear = grid.states(chebyshev_nodes(m))
    return abel.solve(grid, (wear + SHIFT) * np.expm1(slope))


def square_root_panels(edges: FloatArray, m: int) -> abel.Density:
    """Density for P(u) = sqrt(u^2 + a): n = u^2/a, known for every u."""
    grid = abel.grid(SHIFT, edges[:-1], edges[1:])
    wear = grid.states(chebyshev_nodes(m))
    return abel.solve(grid, AREA / (np.sqrt(wear**2 + AREA) + wear))


AREA = 1e-2


def test_geometric_map():
    table = count_table(panels(np.array([0.0, 1.0, 5.0]), 40, 0.01), 3.0)
    wear = np.array([0.0, 0.2, 1.0, 3.0, 4.9])
    assert_allclose(table.cycles_at(wear), 3.0 + np.log1p(wear / SHIFT) / 0.01, rtol=1e-14)


def test_the_first_cycles_of_a_long_panel_keep_their_digits():
    slope = 1e-12
    table = count_table(panels(np.array([0.0, 1.0]), 40, slope), 0.0)
    at = np.array([1.0, 7.0, 1e3])
    wear, _ = table.state_after(at)
    assert_allclose(wear, SHIFT * np.expm1(at * slope), rtol=3e-14)
    assert_allclose(table.cycles_at(wear), at, rtol=1e-14)


@pytest.mark.parametrize("cycles", [101.0, 137.5, 1000.0, 9900.0])
def test_square_root_map_and_its_inverse(cycles):
    table = count_table(square_root_panels(np.array([1.0, 2.0, 4.0, 10.0]), 24), 100.0)
    at = np.array([cycles])
    wear, pace = table.state_after(at)
    assert_allclose(wear, np.sqrt(AREA * cycles), rtol=2e-13)
    assert_allclose(pace, AREA / (2 * wear), rtol=1e-8)  # enough for an error estimate
    assert_allclose(table.cycles_at(wear), at, rtol=1e-13)


def test_residual_tells_the_error_of_the_count():
    t = np.linspace(-0.95, 0.95, 7)
    errors, residuals = [], []
    for m in (4, 8, 12, 16):
        found = square_root_panels(np.array([1.0, 10.0]), m)
        wear = found.grid.states(t)
        rises = AREA / (np.sqrt(wear**2 + AREA) + wear)
        residuals.append(np.max(np.abs(abel.residual(found, t, rises))))
        end = count_table(found, 100.0).last_cycles
        errors.append(abs(end - 10000.0) / 10000.0)
    assert np.all(np.array(errors) < residuals)
    assert residuals[-1] < 1e-3 * residuals[0]  # spectral: a factor 10 for every four nodes


def test_residual_resolves_a_density_that_oscillates_within_a_cycle():
    """Better than the nodes of any solution do: a fault of theirs would be its own judge."""
    grid, t = abel.grid(SHIFT, np.zeros(1), np.ones(1)), np.array([-0.2, 0.1])
    series = np.zeros((1, 24))
    series[0, -1] = 0.3
    wear = grid.states(t)
    rises = 0.2 * (1.0 - wear)
    nodes, weights = leggauss(200)
    within = grid.positions(wear + rises * (nodes[:, None] + 1.0) / 2.0)
    exact = np.log(rises / 2.0 * (weights @ np.exp(chebval(within, series[0]))))
    assert_allclose(abel.residual(abel.Density(grid, series), t, rises), exact, rtol=0, atol=1e-10)


def test_counts_of_neighbours_agree_where_panels_are_long():
    found = square_root_panels(np.array([1.0, 3.0, 10.0]), 24)
    assert np.max(abel.matching_defect(take(found, slice(-1)), take(found, slice(1, None)))) < 1e-10


def test_counts_of_neighbours_part_where_panels_are_short():
    """Two cycles on 16 nodes leave room for an oscillation of period one cycle."""
    found = square_root_panels(np.sqrt(AREA * np.array([1.0, 3.0, 5.0])), 16)
    assert np.min(abel.matching_defect(take(found, slice(-1)), take(found, slice(1, None)))) > 1e-13
