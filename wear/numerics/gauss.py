"""Gauss-Legendre and Radau collocation on [0, 1], and meshes of intervals with such nodes.

Overview
    Within a cycle, functions of the phase are known at Gauss nodes. A rule holds the nodes, the
    quadrature weights and the matrix that integrates the interpolant from 0 to each node.
Key results
    gauss, radau        rules; Radau's last node is the end, which damps stiff transients
    Mesh                a span of time cut into intervals, each with the nodes of one rule
    running, integral   integrals over a mesh, up to each node or over all of it
References
    E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, Springer 1996, IV.5.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
IntArray = NDArray[np.intp]

ONE_THREAD = 250_000  # multiplications that OpenBLAS leaves to one thread


class Gauss(NamedTuple):
    """Collocation with m nodes on [0, 1], Gauss-Legendre or Radau.

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
    """Return the m-point Gauss-Legendre rule of [0, 1] and its integration matrix.

    >>> rule = gauss(8)
    >>> bool(np.allclose(rule.integrate @ rule.nodes**3, rule.nodes**4 / 4, rtol=1e-14))
    True
    """
    return _with_matrices(np.polynomial.legendre.leggauss(m)[0])


@lru_cache(maxsize=32)
def radau(m: int) -> Gauss:
    """Return the m-point Radau rule, whose last node is the end.

    Collocation with it damps what decays within less than the interval, however fast: E. Hairer,
    G. Wanner, *Solving Ordinary Differential Equations II*, Springer 1996, section IV.5.

    >>> rule = radau(8)
    >>> bool(np.allclose(rule.integrate @ rule.nodes**3, rule.nodes**4 / 4, rtol=1e-14))
    True
    """
    series = np.zeros(m + 1)
    series[-2:] = -1.0, 1.0
    x = np.sort(np.polynomial.legendre.legroots(series).real)
    slope = np.polynomial.legendre.legder(series)
    for _ in range(2):
        x -= np.polynomial.legendre.legval(x, series) / np.polynomial.legendre.legval(x, slope)
    x[-1] = 1.0
    return _with_matrices(x)


def _with_matrices(x: FloatArray) -> Gauss:
    """Return the rule with nodes x in [-1, 1], exact to degree 2 m - 2 at least."""
    m = len(x)
    values = np.polynomial.legendre.legvander(x, m).T  # (m + 1, m): P_k at the nodes
    order = np.arange(m)
    # By the weights of NumPy, 7e-15 off at the ends, an interpolated constant would not be one.
    coefficients = np.asarray(np.linalg.inv(values[:m].T), dtype=float)
    # The integral of P_k from -1 is (P_{k+1} - P_{k-1}) / (2 k + 1), and x + 1 for k = 0.
    below = np.vstack([-np.ones(m), values[: m - 1]])
    primitives = (values[1:] - below) / (2 * order[:, None] + 1)
    integrate = 0.5 * primitives.T @ coefficients
    rule = Gauss((x + 1) / 2, coefficients[0], integrate, coefficients)
    for array in rule:
        array.setflags(write=False)
    return rule


class Mesh(NamedTuple):
    """A cycle cut into intervals of phase, each with the nodes of one Gauss-Legendre rule.

    `edges` has shape (q + 1,), rising from the first phase to the last; `lengths` (q,);
    `phases` (q, m): all nodes. Leading axes, if any, are those of many scenes.
    """

    edges: FloatArray
    lengths: FloatArray
    phases: FloatArray
    rule: Gauss

    def interval(self, i: int) -> "Mesh":
        """Return one interval alone."""
        return Mesh(
            self.edges[..., i : i + 2],
            self.lengths[..., i : i + 1],
            self.phases[..., i : i + 1, :],
            self.rule,
        )


def mesh(edges: FloatArray, m: int) -> Mesh:
    """Return the mesh with these edges and m nodes on each interval."""
    rule = gauss(m)
    lengths = np.diff(edges)
    return Mesh(edges, lengths, edges[..., :-1, None] + lengths[..., None] * rule.nodes, rule)


def product(values: FloatArray, matrix: FloatArray) -> FloatArray:
    """Return `values` (..., m) times a `matrix` (m, n) or a vector (m,): (..., n) or (...).

    Computed in pieces that BLAS leaves to one thread: several would wait for each other longer than
    they work.
    """
    flat, most = values.reshape(-1, len(matrix)), max(1, ONE_THREAD // matrix.size)
    if len(flat) <= most:
        return np.asarray((flat @ matrix).reshape(*values.shape[:-1], *matrix.shape[1:]))
    result = np.empty((len(flat), *matrix.shape[1:]))
    for at in range(0, len(flat), most):
        np.matmul(flat[at : at + most], matrix, out=result[at : at + most])
    return result.reshape(*values.shape[:-1], *matrix.shape[1:])


def coefficients(matrix: FloatArray, values: FloatArray) -> FloatArray:
    """Return a `matrix` (n, m) times `values` (..., m), the coefficients first: (n, ...)."""
    flat, most = values.reshape(-1, matrix.shape[1]), max(1, ONE_THREAD // matrix.size)
    result = np.empty((len(matrix), len(flat)))
    for at in range(0, len(flat), most):
        np.matmul(matrix, flat[at : at + most].T, out=result[:, at : at + most])
    return result.reshape(len(matrix), *values.shape[:-1])


def running(values: FloatArray) -> FloatArray:
    """Return the integral of `values` (..., q, m), per interval of a mesh, from the first edge to
    each node, in the same shape."""
    rule = gauss(values.shape[-1])
    within = product(values, rule.integrate.T)
    within[..., 1:, :] += np.cumsum(product(values, rule.weights)[..., :-1], axis=-1)[..., None]
    return within


def running_integral(values: FloatArray, over: Mesh) -> FloatArray:
    """Return the integral of `values` (..., q, m) from the first edge to each node, same shape."""
    return running(values * over.lengths[..., None])


def integral(values: FloatArray, over: Mesh) -> FloatArray:
    """Return the integral of `values` (..., q, m) over the whole mesh, shape (...)."""
    total: FloatArray = np.sum(product(values, over.rule.weights) * over.lengths, axis=-1)
    return total


@lru_cache(maxsize=32)
def between_nodes(m: int, finer: int) -> FloatArray:
    """Return the matrix (m, finer) from values at m nodes of an interval to `finer` nodes of it."""
    basis = np.polynomial.legendre.legvander(2 * gauss(finer).nodes - 1, m - 1)
    matrix: FloatArray = (basis @ gauss(m).coefficients).T
    return matrix
