"""Which intervals of phase resolve the wear rate, and which are to be cut in two.

Gauss collocation converges at twice the order of its interpolant: the square of the last Legendre
coefficients counts.
"""

from itertools import pairwise

import numpy as np

from wear.count.arithmetic import ROUNDOFF, TINY
from wear.count.collocation import BoolArray, FloatArray, Mesh, integral, mesh
from wear.load import Load

NOISE_AT_ENDS = 1e-12  # of a series extrapolated to the ends of its interval


def first_edges(load: Load) -> FloatArray:
    """Ends of intervals that no node may straddle (kinks), should cluster at (peaks), or where a
    smooth pulse ends, about: a quarter of the way to the next peak."""
    inner = {*load.kinks, *load.peaks}
    if not load.kinks and load.minimum < load.maximum:
        for peak, after in pairwise([*load.peaks, load.peaks[0] + 1.0]):
            quarter = (after - peak) / 4
            inner |= {(peak + quarter) % 1.0, (after - quarter) % 1.0}
    return np.array([0.0, *sorted(x for x in inner if 1e-9 < x < 1.0 - 1e-9), 1.0])


def truncated(rate: FloatArray, over: Mesh) -> FloatArray:
    """What intervals may miss (..., k, q) of the integral of the rate (..., k, q, m).

    Gauss quadrature leaves what two truncated series have in common: on an interval, the square of
    its last Legendre coefficients over its largest.
    """
    flat = rate.reshape(-1, rate.shape[-1])
    series = np.abs(flat @ over.rule.coefficients.T).reshape(rate.shape)
    largest = np.max(series, axis=-1) + TINY
    last = np.max(series[..., -2:], axis=-1)
    left: FloatArray = last**2 / largest * over.lengths
    # Rounding of the largest coefficients looks like a tail: it is none.
    left[largest * ROUNDOFF * 100 > last] = 0.0
    return left


def unresolved(rate: FloatArray, over: Mesh, tolerance: float) -> BoolArray:
    """Which intervals (..., q) do not resolve the rate (..., k, q, m) of every start."""
    missed = truncated(rate, over)
    rough: BoolArray = np.any(missed > tolerance * integral(rate, over)[..., None], axis=-2)
    return rough


def concealed(rate: FloatArray, left: FloatArray, right: FloatArray, over: Mesh) -> FloatArray:
    """What intervals (..., q) may miss of the integral of the rate (..., k, q, m) by a change of it
    between an end and the nodes, (..., k, q); `left` and `right` (..., k, q) are the rates at their
    ends.

    Fast wear may have opened the gap before the first node: then nothing but the rate at the start
    of the interval tells. The measure is that of `unresolved`.
    """
    m = rate.shape[-1]
    series = (rate.reshape(-1, m) @ over.rule.coefficients.T).reshape(rate.shape)
    apart = np.maximum(
        np.abs(series @ (-1.0) ** np.arange(m) - left), np.abs(np.sum(series, axis=-1) - right)
    )
    largest = np.max(np.abs(series), axis=-1) + TINY
    missed: FloatArray = apart * (apart / largest) * over.lengths
    missed[apart < NOISE_AT_ENDS * largest] = 0.0
    return missed


def hidden(
    rate: FloatArray, left: FloatArray, right: FloatArray, over: Mesh, tolerance: float
) -> BoolArray:
    """Which intervals (..., q) conceal more than the tolerance permits."""
    missed = concealed(rate, left, right, over)
    rough: BoolArray = np.any(missed > tolerance * integral(rate, over)[..., None], axis=-2)
    return rough


def refined(over: Mesh, rough: BoolArray) -> Mesh:
    """The mesh with the intervals `rough` (q,) cut in two."""
    middles = (over.edges[:-1] + over.edges[1:])[rough] / 2
    return mesh(np.sort(np.concatenate([over.edges, middles])), len(over.rule.nodes))
