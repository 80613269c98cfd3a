"""Collocation of u' = f(t, u) at the Gauss nodes of a mesh, for many scenes and starts at once.

Overview
    With v the increment since the start, v = integral of f(t, u + v) is solved at all nodes of all
    intervals together. The increment is carried as such, so that one of 1e-12 of the state keeps
    all its digits. Arrays are (scenes, starts, intervals, nodes).
Key results
    iterate             Newton's method for all intervals at once
    solve               the same, interval by interval where this diverges
    truncation_error    quadrature error of every interval, from its Legendre coefficients
    endpoint_defect     error between the ends of an interval and its nodes
References
    E. Hairer, S. P. Norsett, G. Wanner, *Solving Ordinary Differential Equations I*, Springer 1993,
    II.7; superconvergence: II.7, theorem 7.9.
"""

from __future__ import annotations

from typing import NamedTuple, Protocol

import numpy as np

from wear.numerics.floating_point import ROUNDOFF, TINY
from wear.numerics.gauss import (
    BoolArray,
    FloatArray,
    IntArray,
    Mesh,
    between_nodes,
    coefficients,
    integral,
    product,
    running,
    running_integral,
)

NOISE = 8 * ROUNDOFF  # the change from one iteration to the next by rounding alone
GRAIN = 4 * ROUNDOFF  # of the state: the slope over a smaller step is all rounding error
MOST_ITERATIONS = 60
PATIENCE = 8  # iterations that may diverge at first
NOISE_AT_ENDS = 1e-12  # of a series extrapolated to the ends of its interval
NOISE_IN_TAIL = 100 * ROUNDOFF  # of the largest Legendre coefficient: rounding in the last ones
FEEDBACK = -1.0, 20.0  # between these a guess by an exponentially falling rate is of use


class Tangent(NamedTuple):
    """The `rate` at a state, its `slope`, and a `step` from there."""

    rate: FloatArray
    slope: FloatArray
    step: FloatArray

    @property
    def end(self) -> FloatArray:
        """Return the rate after the step, to first order."""
        return self.rate + self.slope * self.step

    def on(self, starts: slice) -> Tangent:
        """Return the tangent at some of the starts (..., k, q, m)."""
        return Tangent(*(array[..., starts, :, :] for array in self))


class Rates(Protocol):
    """The rate f on a mesh."""

    @property
    def over(self) -> Mesh: ...

    @property
    def tolerance(self) -> float:
        """Return the relative error of the increment at which the iteration may end."""

    def rate_per_interval(self, u: FloatArray, near: Tangent | None = None) -> FloatArray:
        """Return the rate times the length of each interval at states `u` (..., k, q, m), or
        (..., k, 1, 1) if frozen; a tangent that ends there may help."""


class SplittableRates(Rates, Protocol):
    """Rates of several scenes, to be taken scene by scene and interval by interval."""

    def take(self, rows: IntArray) -> SplittableRates: ...

    def interval(self, i: int) -> SplittableRates: ...


class InitialGuess(NamedTuple):
    """An approximate solution: the `increment` at the nodes (..., k, q, m); the `rate` (same shape,
    per unit of time), evaluated at states smaller than these by `shift` (broadcasts); and the
    expected `contraction` (..., k) of the error by the first step."""

    increment: FloatArray
    rate: FloatArray
    shift: FloatArray
    contraction: FloatArray


class CycleSolution(NamedTuple):
    """The `increment` (..., k) over the mesh from each start; at the nodes (..., k, q, m) the
    increment since the start, `inside`, and the `rate`; the number of right-hand sides evaluated;
    whether the iteration converged (...) from all starts; and the relative `iteration_error`
    (..., k) of the increments."""

    increment: FloatArray
    inside: FloatArray
    rate: FloatArray
    evaluations: int
    converged: BoolArray
    iteration_error: FloatArray

    def guess(self, m: int) -> InitialGuess:
        """Return this solution as a guess for `m` nodes on each interval."""
        matrix = between_nodes(self.inside.shape[-1], m)
        shift = np.zeros_like(self.inside[..., :1, :1])
        unknown = np.ones(self.inside.shape[:-2])
        return InitialGuess(
            product(self.inside, matrix), product(self.rate, matrix), shift, unknown
        )


def solve(
    rates: SplittableRates, starts: FloatArray, guess: InitialGuess | None = None
) -> CycleSolution:
    """Return the solution over the mesh from each start (scenes, k).

    All intervals are solved at once where the iteration converges, that is, where the state changes
    its own rate moderately within the mesh; else one after the other.
    """
    run = iterate(rates, starts, guess)
    rows = np.flatnonzero(~run.converged)
    if len(rows) == 0 or rates.over.lengths.shape[-1] == 1:
        return run
    rerun = _interval_by_interval(rates.take(rows), starts[rows])
    for array, corrected in zip(run, rerun, strict=True):
        if isinstance(array, np.ndarray):
            array[rows] = corrected
    return run._replace(evaluations=run.evaluations + rerun.evaluations)


def iterate(rates: Rates, starts: FloatArray, guess: InitialGuess | None = None) -> CycleSolution:
    """Solve v = integral of f(u + v) by Newton's method with the slope of the last two rates.

    The iteration ends when the next step, predicted from the last contraction, is below the
    tolerance. States that rise from start to start often change their rate less and less: the last
    starts converge first, and the iteration goes on with those before.
    """
    lengths, u = rates.over.lengths[..., None], starts[..., None, None]
    evaluations = 0
    if guess is None:
        guess = guess_without_feedback(starts, rates.rate_per_interval(u) / lengths, rates.over)
        evaluations = guess.rate.size
    v, before, shift, contraction = guess._replace(rate=guess.rate * lengths)
    inside, rate_found, error = np.empty_like(v), np.empty_like(v), np.empty(starts.shape)
    active, last, tangent = starts.shape[-1], None, Tangent(before, shift, np.zeros_like(shift))
    for iteration in range(MOST_ITERATIONS):
        state = u + v
        rate = rates.rate_per_interval(state, tangent)
        evaluations += rate.size
        slope = rate - before
        slope *= shift
        shift = shift * shift
        shift += (GRAIN * state[..., -1:, -1:]) ** 2 + TINY
        slope /= shift
        residual = running(rate)
        residual -= v
        step = _linear_solution(slope, residual)
        v = v + step
        tangent = Tangent(rate, slope, step)
        change = np.max(np.abs(step).reshape(*step.shape[:-2], -1), axis=-1)
        change /= np.abs(v[..., -1, -1]) + TINY
        # The prediction for the first step may be too good.
        contraction = np.maximum(contraction, change) if last is None else change / last
        predicted = change * np.minimum(contraction, 1.0)
        done = predicted <= rates.tolerance
        if iteration > PATIENCE:
            done |= ~(contraction < 1.0)
        more = np.nonzero(~done)[-1]
        rest = int(more.max()) + 1 if len(more) and iteration + 1 < MOST_ITERATIONS else 0
        if rest < active:
            error[..., rest:active] = predicted[..., rest:]
            inside[..., rest:active, :, :] = v[..., rest:, :, :]
            rate_found[..., rest:active, :, :] = tangent.on(slice(rest, None)).end / lengths
        if rest == 0:
            break
        tangent, v, u = tangent.on(slice(rest)), v[..., :rest, :, :], u[..., :rest, :, :]
        before, _, shift = tangent
        last, active = np.minimum(change, 1.0)[..., :rest] + TINY, rest
    converged = np.all(error <= rates.tolerance, axis=-1)
    increment = integral(rate_found, rates.over)
    return CycleSolution(increment, inside, rate_found, evaluations, converged, error)


def guess_without_feedback(starts: FloatArray, rate: FloatArray, over: Mesh) -> InitialGuess:
    """Return a guess from the `rate` (..., k, q, m) with the state frozen at the `starts` (..., k).

    Where the rate falls by a factor e over the increment 1/a, the increment is ln(1 + a frozen)/a,
    nearly frozen/(1 + a frozen/2).
    """
    frozen = running_integral(rate, over)
    ends = frozen[..., -1, -1]
    feedback = np.zeros(starts.shape)
    if starts.shape[-1] > 2:
        fall = -np.diff(np.log(ends)) / np.diff(starts)
        feedback[..., 1:-1] = (fall[..., 1:] + fall[..., :-1]) / 2
        feedback[..., 0], feedback[..., -1] = fall[..., 0], fall[..., -1]
        feedback *= ends
        feedback[~np.isfinite(feedback)] = 0.0
        np.clip(feedback, *FEEDBACK, out=feedback)
    shape = (feedback / (2 * ends + TINY))[..., None, None]
    increment = frozen / (1.0 + shape * frozen)
    return InitialGuess(increment, rate, increment, feedback**2)


def _linear_solution(slope: FloatArray, residual: FloatArray) -> FloatArray:
    """Return the solution x of x = residual + integral of slope x, all (..., q, m)."""
    factor = running(slope)
    np.exp(factor, out=factor)
    part = slope * residual
    part /= factor
    x = running(part)
    x *= factor
    x += residual
    return x


def _interval_by_interval(rates: SplittableRates, starts: FloatArray) -> CycleSolution:
    """Iterate on each interval of the mesh in its turn."""
    parts: list[CycleSolution] = []
    added, evaluations = np.zeros(starts.shape), 0
    for i in range(rates.over.lengths.shape[-1]):
        part = iterate(rates.interval(i), starts + added)
        parts.append(part._replace(inside=added[..., None, None] + part.inside))
        added = added + part.increment
        evaluations += part.evaluations
    return CycleSolution(
        added,
        np.concatenate([part.inside for part in parts], axis=-2),
        np.concatenate([part.rate for part in parts], axis=-2),
        evaluations,
        np.all([part.converged for part in parts], axis=0),
        np.sum([part.iteration_error for part in parts], axis=0),
    )


def truncation_error(rate: FloatArray, over: Mesh) -> FloatArray:
    """Return the error (..., k, q) of the integral of the rate (..., k, q, m) over each interval.

    Gauss quadrature leaves the product of two truncated series: on an interval, the square of its
    last Legendre coefficients over its largest.
    """
    series = coefficients(over.rule.coefficients, rate)
    np.abs(series, out=series)
    largest = np.max(series, axis=0) + TINY
    last = np.max(series[-2:], axis=0)
    error: FloatArray = last**2 / largest * over.lengths
    error[largest * NOISE_IN_TAIL > last] = 0.0
    return error


def unresolved(rate: FloatArray, over: Mesh, tolerance: float | FloatArray) -> BoolArray:
    """Return which intervals (..., q) do not resolve the rate (..., k, q, m) of every start to the
    `tolerance` (broadcasts against (..., k, q)), relative to its integral."""
    error = truncation_error(rate, over)
    return np.asarray(np.any(error > tolerance * integral(rate, over)[..., None], axis=-2))


def endpoint_defect(
    rate: FloatArray, left: FloatArray, right: FloatArray, over: Mesh
) -> FloatArray:
    """Return the error (..., k, q) of the integral of the rate (..., k, q, m) between the ends of
    an interval and its nodes; `left` and `right` (..., k, q) are the rates at the ends.

    A fast change of the state may be over before the first node: then only the rate at the start of
    the interval shows it. The measure is that of `truncation_error`.
    """
    series = coefficients(over.rule.coefficients, rate)
    at_left = np.sum(series[::2], axis=0) - np.sum(series[1::2], axis=0)
    defect = np.maximum(np.abs(at_left - left), np.abs(np.sum(series, axis=0) - right))
    largest = np.max(np.abs(series), axis=0) + TINY
    error: FloatArray = defect * (defect / largest) * over.lengths
    error[defect < NOISE_AT_ENDS * largest] = 0.0
    return error
