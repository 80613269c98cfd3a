"""Nodes and matrices of the two discretisations: Gauss-Legendre in phase, Chebyshev in wear.

Inside a cycle functions of phase are known at Gauss-Legendre nodes; `gauss` holds the nodes of
[0, 1], the quadrature weights and the matrix that integrates from 0 to each node. Over many
cycles functions of wear are Chebyshev series on panels.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
IntArray = NDArray[np.intp]


class Gauss(NamedTuple):
    """Gauss-Legendre collocation with m nodes on [0, 1].

    `nodes` and `weights` have shape (m,). `integrate` (m, m) maps values at the nodes to the
    integrals of their interpolant from 0 to each node; `coefficients` (m, m) maps them to the
    interpolant's coefficients in Legendre polynomials of 2 x - 1, each scaled to maximum 1.
    """

    nodes: FloatArray
    weights: FloatArray
    integrate: FloatArray
    coefficients: FloatArray


@lru_cache(maxsize=32)
def gauss(m: int) -> Gauss:
    """The m-point Gauss-Legendre rule of [0, 1] and its integration matrix.

    >>> rule = gauss(8)
    >>> bool(np.allclose(rule.integrate @ rule.nodes**3, rule.nodes**4 / 4, rtol=1e-14))
    True
    """
    x, w = np.polynomial.legendre.leggauss(m)
    values = np.polynomial.legendre.legvander(x, m).T  # (m + 1, m): P_k at the nodes
    order = np.arange(m)
    coefficients = (order[:, None] + 0.5) * values[:m] * w
    # The integral of P_k from -1 is (P_{k+1} - P_{k-1}) / (2 k + 1), and x + 1 for k = 0.
    below = np.vstack([-np.ones(m), values[: m - 1]])
    primitives = (values[1:] - below) / (2 * order[:, None] + 1)
    integrate = 0.5 * primitives.T @ coefficients
    rule = Gauss((x + 1) / 2, w / 2, integrate, coefficients)
    for array in rule:
        array.setflags(write=False)
    return rule


class Mesh(NamedTuple):
    """A cycle cut into intervals of phase, each with the nodes of one Gauss-Legendre rule.

    `edges` has shape (q + 1,), rising from the first phase to the last; `lengths` (q,);
    `phases` (q, m): all nodes.
    """

    edges: FloatArray
    lengths: FloatArray
    phases: FloatArray
    rule: Gauss

    def interval(self, i: int) -> "Mesh":
        """One interval alone."""
        return Mesh(
            self.edges[i : i + 2], self.lengths[i : i + 1], self.phases[i : i + 1], self.rule
        )


def mesh(edges: FloatArray, m: int) -> Mesh:
    """The mesh with these edges and m nodes on each interval."""
    rule = gauss(m)
    lengths = np.diff(edges)
    return Mesh(edges, lengths, edges[:-1, None] + lengths[:, None] * rule.nodes, rule)


def running_integral(values: FloatArray, over: Mesh) -> FloatArray:
    """Integral of `values` (..., q, m) from the first edge to each node, in the same shape."""
    scaled = values * over.lengths[:, None]
    local = scaled @ over.rule.integrate.T
    if len(over.lengths) == 1:
        return local
    before = np.zeros(scaled.shape[:-1])
    np.cumsum((scaled @ over.rule.weights)[..., :-1], axis=-1, out=before[..., 1:])
    return local + before[..., None]


def integral(values: FloatArray, over: Mesh) -> FloatArray:
    """Integral of `values` (..., q, m) over the whole mesh, shape (...)."""
    return (values @ over.rule.weights) @ over.lengths


def chebyshev_nodes(m: int) -> FloatArray:
    """The m roots of the Chebyshev polynomial T_m, rising."""
    nodes: FloatArray = -np.cos(np.pi * (np.arange(m) + 0.5) / m)
    return nodes


def chebyshev_values(t: FloatArray, m: int) -> FloatArray:
    """T_0 ... T_{m-1} at `t` (...), shape (..., m). By recurrence: also right outside [-1, 1]."""
    values = np.empty((m, *t.shape))
    values[0] = 1.0
    if m > 1:
        values[1] = t
    double = 2 * t
    for k in range(2, m):
        np.multiply(double, values[k - 1], out=values[k])
        values[k] -= values[k - 2]
    return np.moveaxis(values, 0, -1)


@lru_cache(maxsize=32)
def chebyshev_analysis(m: int) -> FloatArray:
    """Matrix (m, m) from values at `chebyshev_nodes(m)` to Chebyshev coefficients."""
    matrix = chebyshev_values(chebyshev_nodes(m), m).T * (2.0 / m)
    matrix[0] /= 2
    return matrix
