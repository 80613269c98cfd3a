"""Increments of cycles up to given phases, as functions of the initial state of the cycle.

They are smooth functions of that state: they are found at the nodes of the panels of an orbit and
interpolated to the requested cycles. No cycle between is integrated.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from wear.numerics.chebyshev import chebyshev_analysis, chebyshev_nodes, chebyshev_values
from wear.numerics.collocation import NOISE_IN_TAIL, CycleSolution
from wear.numerics.floating_point import ROUNDOFF, TINY
from wear.numerics.gauss import BoolArray, FloatArray, Mesh, coefficients, integral, product
from wear.numerics.initial_value import SAFETY, StoppedError
from wear.numerics.rows import stacked, take
from wear.orbit import abel
from wear.orbit.iterates import Iterates, cell_of
from wear.orbit.panels import CHECKS, SPLIT
from wear.orbit.period_map import PeriodMap, Settings, period_map, settings
from wear.orbit.problem import Problem

MOST_ROUNDS = 6  # of cutting panels

Observable = Callable[[FloatArray, FloatArray], FloatArray]
"""A positive function of states (n, m) and the forcing (m,)."""


class PhaseIncrements(NamedTuple):
    """The increments of cycles up to the phases (n, m), and their `error` (n,); the `observable`
    (n, m) there, if any, and its relative error, `observable_error` (n,)."""

    increment: FloatArray
    error: FloatArray
    observable: FloatArray | None
    observable_error: FloatArray


class _DensePanels(NamedTuple):
    """The increments of cycles from the panels of a `grid`: Chebyshev coefficients `series`
    (panels, m, columns), their `error` (panels,), and that of the observable, `observable_error`
    (panels,). A column is the increment at a phase, or the logarithm of the observable there."""

    grid: abel.Grid
    series: FloatArray
    error: FloatArray
    observable_error: FloatArray


class DenseOutput(NamedTuple):
    """The increments of one scene within cycles up to some phases, ready for interpolation.

    `first` (k, columns) are those of each of the first cycles, `first_error` (k,) their estimated
    errors; the `panels` are those of later ones, None if there are none.
    """

    first: FloatArray
    first_error: FloatArray
    panels: _DensePanels | None
    observed: bool

    def added(self, cycles: FloatArray, starts: FloatArray) -> PhaseIncrements:
        """Return the increments of the cycles with the numbers `cycles` (n,), from 0 on, and the
        initial states `starts` (n,)."""
        columns = np.zeros((len(cycles), self.first.shape[1]))
        error, observable_error = np.zeros((2, len(cycles)))
        early = cycles < len(self.first)
        index = cycles[early].astype(int)
        columns[early] = self.first[index]
        error[early] = self.first_error[index]
        if self.panels is not None:  # else no later cycle adds anything
            grid, series, of_panels, of_observable = self.panels
            panel = np.where(early, -1, cell_of(grid.starts, starts))
            for p in np.unique(panel[~early]):
                chosen = panel == p
                t = take(grid, slice(p, p + 1)).positions(starts[None, chosen])[0]
                columns[chosen] = chebyshev_values(t, series.shape[1]) @ series[p]
                error[chosen], observable_error[chosen] = of_panels[p], of_observable[p]
        if not self.observed:
            return PhaseIncrements(columns, error, None, observable_error)
        increment, logarithm = np.split(columns, 2, axis=1)
        return PhaseIncrements(increment, error, np.exp(logarithm), observable_error)


@np.errstate(all="ignore")  # of trial states far off; NaN fails the error estimate
def dense_output(
    problem: Problem,
    iterates: Iterates,
    phases: FloatArray,
    rtol: float,
    observable: Observable | None = None,
) -> DenseOutput:
    """Return the dense output of one scene with these iterates, at `phases` (m,) in [0, 1]."""
    size, states = settings(rtol, problem.breakpoints), iterates.transient[0]
    # The first cycle is not interpolated even if panels begin with it.
    first = states[: max(1, len(states) - 1)] if iterates.table else states
    maps = period_map(problem, iterates.edges, size.finer_nodes)
    maps, added = _resolved(maps, first, np.append(phases, 1.0), rtol)
    added, whole = added[:, :-1], added[:, -1]
    error = np.max(np.abs(_by_finer_map(maps, first, phases, size) - added), axis=1)
    known = np.diff(states)[: len(first)]  # two meshes that agree may both be wrong
    error[: len(known)] = np.maximum(error[: len(known)], np.abs(whole[: len(known)] - known))
    # Beyond the limit there is another solution, which has no meaning.
    limit = float(iterates.limit[0])
    sound = (first + whole < limit) & (SAFETY * error <= rtol * (first + whole))
    for i in np.flatnonzero(~sound):
        added[i], error[i] = _violent(problem, float(first[i]), limit, phases, size)
    error += problem.roundoff(first[None])[0] * np.max(added, axis=1, initial=0.0)
    columns = _with_observable(observable, first, added, problem.forcing(phases[None])[0])
    panels = None
    if iterates.density is not None:
        panels = _on_panels(maps, iterates, phases, rtol, observable)
    return DenseOutput(columns, error, panels, observable is not None)


def _on_panels(
    maps: PeriodMap,
    iterates: Iterates,
    phases: FloatArray,
    rtol: float,
    observable: Observable | None,
) -> _DensePanels:
    """Return the panels of the orbit, cut in two where the increment up to a phase depends more
    sharply on the state than that of the whole cycle."""
    assert iterates.density is not None
    size = settings(rtol, maps.equation.breakpoints)
    number, grid = len(phases), iterates.density.grid
    forcing = maps.equation.forcing(phases[None])[0]
    to_series = chebyshev_analysis(size.panel_nodes)
    to_checks = chebyshev_values(CHECKS, size.panel_nodes)
    done: list[_DensePanels] = []
    for rounds in range(MOST_ROUNDS):
        nodes = grid.states(chebyshev_nodes(size.panel_nodes))
        checks = grid.states(CHECKS)
        maps, added = _resolved(maps, nodes.ravel(), phases, rtol)
        columns = _with_observable(observable, nodes.ravel(), added, forcing)
        series = to_series @ columns.reshape(*nodes.shape, -1)
        finer = _by_finer_map(maps, checks.ravel(), phases, size)
        finer = _with_observable(observable, checks.ravel(), finer, forcing)
        difference = np.abs(finer.reshape(*checks.shape, -1) - to_checks @ series)
        error = np.max(difference[..., :number], axis=(1, 2), initial=0.0)
        of_observable = SAFETY * np.max(difference[..., number:], axis=(1, 2), initial=0.0)
        error[~np.isfinite(difference).all(axis=(1, 2))] = np.inf
        solved = _DensePanels(grid, series, error, of_observable)
        # No cycle ends below the increment of the first.
        least = np.maximum(grid.starts, iterates.first_increment)
        cut = ~(SAFETY * error <= rtol / 4 * least)
        if not cut.any() or rounds == MOST_ROUNDS - 1:
            done.append(solved)
            break
        done.append(take(solved, ~cut))
        grid = stacked(take(grid, cut).cut(SPLIT))
    panels = stacked(done)
    return take(panels, np.argsort(panels.grid.starts))


def _violent(
    problem: Problem, start: float, limit: float, phases: FloatArray, size: Settings
) -> tuple[FloatArray, float]:
    """Return the increments of one cycle from the state `start` up to each phase (m,), by the
    adaptive integrator, and their error."""
    edges = np.unique(np.concatenate([problem.breakpoints[0], phases]))
    maps = period_map(problem, edges[None], size.phase_nodes)
    try:
        reached = list(maps.integrated(start, limit, size))
    except StoppedError:
        return np.full(len(phases), np.nan), np.inf
    added = np.concatenate([np.zeros(1), *(part.increment for part in reached)])
    error = max(float(np.max(part.error)) for part in reached) / SAFETY
    return added[np.searchsorted(edges, phases)], error


def _with_observable(
    observable: Observable | None, starts: FloatArray, added: FloatArray, forcing: FloatArray
) -> FloatArray:
    """Return the columns to interpolate: the increments `added` (starts, phases), and the logarithm
    of the observable, if any."""
    if observable is None:
        return added
    values = observable(starts[:, None] + added, forcing)
    return np.concatenate([added, np.log(values + TINY)], axis=1)


def _resolved(
    maps: PeriodMap, starts: FloatArray, phases: FloatArray, rtol: float
) -> tuple[PeriodMap, FloatArray]:
    """Return a map that resolves the rate at every phase, and the increments up to each phase,
    (starts, phases), NaN where the iteration failed. The mesh is refined first by the rate without
    feedback, which costs least, then by the solution."""
    tolerance = max(rtol, ROUNDOFF)
    marked = _unresolved(maps.rate_without_feedback(starts[None]), maps.over, tolerance)
    while marked.any() and not maps.full:
        ((_, maps),) = maps.refined(marked)
        marked = _unresolved(maps.rate_without_feedback(starts[None]), maps.over, tolerance)
    while True:
        run = maps.advance(starts[None])
        marked = _unresolved(run.rate, maps.over, tolerance) | ~run.converged[:, None]
        if not marked.any() or maps.full:
            lost = 0.0 if run.converged.all() else np.nan
            return maps, _at_phases(run, maps.over, phases) + lost
        ((_, maps),) = maps.refined(marked)


def _unresolved(rate: FloatArray, over: Mesh, tolerance: float) -> BoolArray:
    """Return the intervals (1, q) on which the running integral of a rate (1, k, q, m) is not
    resolved.

    Unlike the integral over an interval, the running integral is no more accurate than the
    interpolant of the rate.
    """
    series = np.abs(coefficients(over.rule.coefficients, rate))
    tail, largest = np.max(series[-3:], axis=0), np.max(series, axis=0)
    coarse = tail * over.lengths > tolerance * integral(rate, over)[..., None]
    marked: BoolArray = np.any(coarse & (tail > NOISE_IN_TAIL * largest), axis=1)
    return marked


def _by_finer_map(
    maps: PeriodMap, starts: FloatArray, phases: FloatArray, size: Settings
) -> FloatArray:
    """Return the increments up to each phase, (starts, phases), by a finer discretisation."""
    m = 2 * size.finer_nodes - size.phase_nodes
    again = period_map(maps.equation, maps.over.edges[:, 0], m)
    return _at_phases(again.advance(starts[None]), again.over, phases)


def _at_phases(run: CycleSolution, over: Mesh, phases: FloatArray) -> FloatArray:
    """Return the increments up to each phase, (starts, phases)."""
    edges, lengths, all_rates = over.edges[0, 0], over.lengths[0, 0], run.rate[0]
    interval = np.clip(np.searchsorted(edges, phases, side="right") - 1, 0, len(lengths) - 1)
    x = (phases - edges[interval]) / lengths[interval]
    # The rate's Legendre series, integrated from the start of the interval.
    series = product(all_rates, over.rule.coefficients.T) * lengths[:, None]
    weights = np.polynomial.legendre.legvander(2 * x - 1, series.shape[-1])
    k = np.arange(series.shape[-1])
    below = np.concatenate([-np.ones((len(x), 1)), weights[:, : len(k) - 1]], axis=1)
    primitives = (weights[:, 1:] - below) / (2 * (2 * k + 1))
    within = np.einsum("spk,pk->sp", series[:, interval, :], primitives)
    before = np.cumsum(product(all_rates, over.rule.weights) * lengths, axis=-1)
    before = np.concatenate([np.zeros((len(before), 1)), before[:, :-1]], axis=1)
    result: FloatArray = before[:, interval] + within
    return result
