"""The scaled exponential integral against mpmath at 60 digits."""

from __future__ import annotations

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from wear.special import ei_remainder

EPS = float(np.finfo(float).eps)


def _exact(z: float) -> mpmath.mpf:
    with mpmath.workdps(60):
        x = mpmath.mpf(z)
        return 1 - x * mpmath.exp(-x) * mpmath.ei(x)


@given(st.floats(-1500.0, -1e-8))
def test_negative_arguments_to_a_few_units(z: float) -> None:
    exact = _exact(z)
    assert abs(float((mpmath.mpf(float(ei_remainder(z))) - exact) / exact)) <= 8 * EPS


@given(st.floats(45.0, 1500.0))
def test_large_arguments_to_a_few_units(z: float) -> None:
    exact = _exact(z)
    assert abs(float((mpmath.mpf(float(ei_remainder(z))) - exact) / exact)) <= 8 * EPS


@given(st.floats(1e-8, 45.0))
def test_in_between_to_z_units_of_what_remains(z: float) -> None:
    """There 1 is nearly cancelled: the absolute error is that of the cancelled product."""
    error = abs(float(mpmath.mpf(float(ei_remainder(z))) - _exact(z)))
    assert error <= 16 * EPS


@pytest.mark.parametrize("z", [-1.0, 40.0])
def test_the_pieces_meet(z: float) -> None:
    below, above = ei_remainder([np.nextafter(z, -np.inf), np.nextafter(z, np.inf)])
    assert below == pytest.approx(above, rel=64 * EPS)


def test_shapes_and_limits() -> None:
    assert ei_remainder(0.0) == 1.0
    assert ei_remainder(np.zeros((2, 3))).shape == (2, 3)
    assert float(ei_remainder(-1e300)) == pytest.approx(1e-300)
    assert float(ei_remainder(1e300)) == pytest.approx(-1e-300)
