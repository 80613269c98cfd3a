"""Special functions that SciPy has not in the form needed: no overflow, no cancellation.

The closed solution for a constant load needs 1 - z exp(-z) Ei(z) (DLMF 6.2.5) from z = -1e300 to
1e300. For z < 0 it equals exp(w) E_2(w) with w = -z, a continued fraction without subtractions
(DLMF 8.9.2); for large z the asymptotic series of Ei (DLMF 6.12.2), less its first term, which
cancels.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from wear.numerics.gauss import FloatArray

FRACTION_TERMS = 150  # of the continued fraction: 1e-16 from w = 1 on
SERIES_FROM, SERIES_TERMS = 40.0, 40  # cut at its smallest term: 3e-15 at 40, rounding from 45 on


def ei_remainder(z: ArrayLike) -> FloatArray:
    """Return the function 1 - z exp(-z) Ei(z) for real z of either sign; 1 at z = 0.

    Relative error: a few units of roundoff for z < 0 and z > 45, z units in between, where
    z exp(-z) Ei(z) is nearly 1.

    >>> float(ei_remainder(-1.0)), float(ei_remainder(0.0))
    (0.4036526376768059, 1.0)
    """
    from scipy.special import exp1, expi

    shape = np.shape(z)
    z = np.atleast_1d(np.asarray(z, dtype=np.float64))
    found = np.ones_like(z)
    far, low = z <= -1.0, (z > -1.0) & (z < 0.0)
    middle, high = (z > 0.0) & (z < SERIES_FROM), z >= SERIES_FROM
    found[far] = _fraction(-z[far])
    found[low] = 1.0 + z[low] * np.exp(-z[low]) * exp1(-z[low])
    found[middle] = 1.0 - z[middle] * np.exp(-z[middle]) * expi(z[middle])
    found[high] = _series(z[high])
    return found.reshape(shape)


def _fraction(w: FloatArray) -> FloatArray:
    """Return exp(w) E_2(w) for w >= 1, from its continued fraction, last term first."""
    tail = np.zeros_like(w)
    for n in range(FRACTION_TERMS, 0, -1):
        tail = n * (n + 1) / (w + 2 + 2 * n - tail)
    return 1.0 / (w + 2.0 - tail)


def _series(z: FloatArray) -> FloatArray:
    """Return the series -1/z - 2!/z^2 - 3!/z^3 - ..."""
    total = np.ones_like(z)
    for n in range(SERIES_TERMS, 1, -1):
        total = 1.0 + n / z * total
    return -total / z
