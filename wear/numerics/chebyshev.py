"""Chebyshev series: nodes, values and coefficients.

References
    L. N. Trefethen, *Approximation Theory and Approximation Practice*, SIAM 2013, chapters 2-4.
"""

from functools import lru_cache

import numpy as np

from wear.numerics.gauss import FloatArray


@lru_cache(maxsize=32)
def chebyshev_nodes(m: int) -> FloatArray:
    """Return the m roots of the Chebyshev polynomial T_m, rising."""
    nodes: FloatArray = -np.cos(np.pi * (np.arange(m) + 0.5) / m)
    nodes.setflags(write=False)
    return nodes


def chebyshev_values(t: FloatArray, m: int) -> FloatArray:
    """Return T_0 ... T_{m-1} at `t` (...), shape (..., m); by recurrence, which also holds outside
    [-1, 1]."""
    values = np.empty((m, *t.shape))
    values[0] = 1.0
    values[1:2] = t
    n = 1
    while n + 1 < m:  # T_{n + j} = 2 T_n T_j - T_{n - j} for j = 1 ... n
        more = min(n, m - 1 - n)
        fresh = values[n + 1 : n + 1 + more]
        np.multiply(2 * values[n], values[1 : more + 1], out=fresh)
        fresh -= values[n - more : n][::-1]
        n += more
    return np.moveaxis(values, 0, -1)


@lru_cache(maxsize=32)
def chebyshev_analysis(m: int) -> FloatArray:
    """Return the matrix (m, m) from values at `chebyshev_nodes(m)` to Chebyshev coefficients.

    By cosines of exactly reduced angles: a recurrence would lose n^2 roundoffs in T_n near the
    ends, and a large constant would seem to have a tail.
    """
    n, k = np.arange(m)[:, None], np.arange(m)
    quarters = (n * (2 * k + 1 + 2 * m)) % (4 * m)  # of the angle n (pi + (k + 1/2) pi/m)
    matrix: FloatArray = np.cos(np.pi / (2 * m) * quarters) * (2.0 / m)
    matrix[0] /= 2
    return matrix
