"""The steady state, read off the last panel, which reaches to infinity.

On a panel with the coordinate x = (u - start)/(u + c) the state u is infinite where x = 1, and
e = 1/(u + c) = (1 - x)/L with L = start + c. There dn/du = (1 - A e + ...)/R, so that
u = R n + A ln n + B + o(1): R and A are the value and the slope of the series at x = 1, and B is
the rest of the integral of dn/du.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.polynomial import chebyshev

from wear.numerics.gauss import FloatArray, gauss
from wear.orbit.abel import Density

INTERVALS, NODES = 32, 24  # of the integral of the rest
SMALL, TERMS = 0.5, 14  # exponents up to SMALL are inserted into a series of TERMS terms


class SteadyState(NamedTuple):
    """u = `rate` n + `drift` ln n + `offset` + o(1) after n cycles."""

    rate: float
    drift: float
    offset: float


def steady_state(panel: Density, cycles: float) -> SteadyState:
    """Return the steady state from one `panel` that all but reaches infinity, at the start of which
    n is `cycles`."""
    grid, series = panel.grid, panel.series[0]
    start, length = float(grid.starts[0]), float(grid.starts[0] + grid.c[0])
    per_x = 2 / grid.x_ends[0]
    infinity = per_x - 1  # in t
    level = float(chebyshev.chebval(infinity, series))
    first = _divided(series, infinity)  # (S(x) - S(1))/(t - t(1))
    slope = per_x * float(chebyshev.chebval(infinity, first))
    second = _divided(first, infinity)
    rule, edges = gauss(NODES), np.arange(INTERVALS) / INTERVALS
    x = (edges[:, None] + rule.nodes / INTERVALS).ravel()
    secant = per_x * chebyshev.chebval(per_x * x - 1, first)
    curvature = per_x**2 * chebyshev.chebval(per_x * x - 1, second)
    # (exp(S(x) - S(1)) - 1 - S'(1) (x - 1))/(1 - x)^2
    rest = curvature + secant**2 * _second_remainder(secant * (x - 1))
    integral = float(np.sum(rest.reshape(INTERVALS, -1) @ rule.weights)) / INTERVALS
    rate, drift = float(np.exp(-level)), length * slope
    offset = start - rate * cycles + drift * (-level - math.log(length)) - length * integral
    return SteadyState(rate, drift, offset)


def _divided(series: FloatArray, at: float) -> FloatArray:
    """Return the Chebyshev series of (f(t) - f(at))/(t - at)."""
    less = series.copy()
    less[0] -= chebyshev.chebval(at, series)
    return np.asarray(chebyshev.chebdiv(less, np.array([-at, 1.0]))[0])


def _second_remainder(e: FloatArray) -> FloatArray:
    """Return (exp(e) - 1 - e)/e^2."""
    near = np.polynomial.Polynomial([1 / math.factorial(k + 2) for k in range(TERMS)])(e)
    far = np.where(np.abs(e) < SMALL, 1.0, e)
    return np.where(np.abs(e) < SMALL, near, (np.expm1(far) - far) / far**2)
