"""What cycles add up to given phases, as a function of the state at their start.

It depends on that state alone, and smoothly: it is found once at the nodes of the panels of a count
and interpolated to the cycles wanted. No cycle between is integrated.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from wear.numerics.chebyshev import chebyshev_analysis, chebyshev_nodes, chebyshev_values
from wear.numerics.collocation import CycleSolution
from wear.numerics.gauss import BoolArray, FloatArray, Mesh, coefficients, integral, product
from wear.numerics.initial_value import SAFETY, StoppedError
from wear.numerics.rows import stacked, take
from wear.numerics.tolerances import ROUNDOFF, TINY
from wear.orbit import abel
from wear.orbit.iterates import Iterates, cell_of
from wear.orbit.panels import CHECKS, SPLIT
from wear.orbit.period_map import PeriodMap, Settings, period_map, settings
from wear.orbit.problem import Problem

MOST_ROUNDS = 6  # of cutting panels

Observable = Callable[[FloatArray, FloatArray], FloatArray]
"""A positive function of states (n, m) and the forcing (m,)."""


class Added(NamedTuple):
    """What cycles add up to the phases (n, m), and what of that is `missed` (n,); the `observable`
    (n, m) there, if any, and its relative error `off` (n,)."""

    increment: FloatArray
    missed: FloatArray
    observable: FloatArray | None
    off: FloatArray


class _Panels(NamedTuple):
    """What cycles add that start on the panels of a `frame`: Chebyshev coefficients `series`
    (panels, m, columns), what these have `missed` (panels,), and how much the observable is `off`
    (panels,).

    There is a column for the increment at each phase, and another for the logarithm of the
    observable there.
    """

    frame: abel.Frame
    series: FloatArray
    missed: FloatArray
    off: FloatArray


class DenseOutput(NamedTuple):
    """How the state of one scene grows within cycles up to some phases, ready for interpolation.

    `first` (k, columns) is what has been added in each of the first cycles, `first_missed` (k,) its
    estimated error; the `panels` are those of later ones, None if there are none.
    """

    first: FloatArray
    first_missed: FloatArray
    panels: _Panels | None
    observed: bool

    def added(self, cycles: FloatArray, starts: FloatArray) -> Added:
        """Return what each of `cycles` (n,), counted from the first, adds from its start (n,)."""
        columns = np.zeros((len(cycles), self.first.shape[1]))
        missed, off = np.zeros((2, len(cycles)))
        early = cycles < len(self.first)
        index = cycles[early].astype(int)
        columns[early] = self.first[index]
        missed[early] = self.first_missed[index]
        if self.panels is not None:  # else no cycle adds anything any more
            frame, series, of_panels, off_panels = self.panels
            panel = np.where(early, -1, cell_of(frame.starts, starts))
            for p in np.unique(panel[~early]):
                chosen = panel == p
                t = take(frame, slice(p, p + 1)).positions(starts[None, chosen])[0]
                columns[chosen] = chebyshev_values(t, series.shape[1]) @ series[p]
                missed[chosen], off[chosen] = of_panels[p], off_panels[p]
        if not self.observed:
            return Added(columns, missed, None, off)
        increment, logarithm = np.split(columns, 2, axis=1)
        return Added(increment, missed, np.exp(logarithm), off)


@np.errstate(all="ignore")  # of trial states far off; what is no number fails the estimate of error
def dense_output(
    problem: Problem,
    counted: Iterates,
    phases: FloatArray,
    rtol: float,
    observable: Observable | None = None,
) -> DenseOutput:
    """Prepare for the cycles that are `counted`, of one scene, and for `phases` (m,) in [0, 1]."""
    size, states = settings(rtol, problem.breakpoints), counted.transient[0]
    # The first cycle is not interpolated even if panels begin with it.
    first = states[: max(1, len(states) - 1)] if counted.cells else states
    maps = period_map(problem, counted.edges, size.finer_nodes)
    maps, added = _resolved(maps, first, np.append(phases, 1.0), rtol)
    added, whole = added[:, :-1], added[:, -1]
    missed = np.max(np.abs(_judged(maps, first, phases, size) - added), axis=1)
    known = np.diff(states)[: len(first)]  # two meshes that agree may both be wrong
    missed[: len(known)] = np.maximum(missed[: len(known)], np.abs(whole[: len(known)] - known))
    # Beyond the limit there is another solution, which has no meaning.
    limit = float(counted.limit[0])
    sound = (first + whole < limit) & (SAFETY * missed <= rtol * (first + whole))
    for i in np.flatnonzero(~sound):
        added[i], missed[i] = _violent(problem, float(first[i]), limit, phases, size)
    missed += problem.roundoff(first[None])[0] * np.max(added, axis=1, initial=0.0)
    columns = _with_observable(observable, first, added, problem.forcing(phases[None])[0])
    panels = None
    if counted.panels is not None:
        panels = _on_panels(maps, counted, phases, rtol, observable)
    return DenseOutput(columns, missed, panels, observable is not None)


def _on_panels(
    maps: PeriodMap,
    counted: Iterates,
    phases: FloatArray,
    rtol: float,
    observable: Observable | None,
) -> _Panels:
    """Return the panels of the count, cut in two where a phase needs it: there what a cycle adds
    depends on the state more sharply than at its end."""
    assert counted.panels is not None
    size = settings(rtol, maps.equation.breakpoints)
    number, frame = len(phases), counted.panels.frame
    forcing = maps.equation.forcing(phases[None])[0]
    to_series = chebyshev_analysis(size.panel_nodes)
    to_checks = chebyshev_values(CHECKS, size.panel_nodes)
    done: list[_Panels] = []
    for rounds in range(MOST_ROUNDS):
        nodes = frame.states(chebyshev_nodes(size.panel_nodes))
        checks = frame.states(CHECKS)
        maps, added = _resolved(maps, nodes.ravel(), phases, rtol)
        columns = _with_observable(observable, nodes.ravel(), added, forcing)
        series = to_series @ columns.reshape(*nodes.shape, -1)
        judged = _judged(maps, checks.ravel(), phases, size)
        judged = _with_observable(observable, checks.ravel(), judged, forcing)
        apart = np.abs(judged.reshape(*checks.shape, -1) - to_checks @ series)
        missed = np.max(apart[..., :number], axis=(1, 2), initial=0.0)
        off = SAFETY * np.max(apart[..., number:], axis=(1, 2), initial=0.0)
        missed[~np.isfinite(apart).all(axis=(1, 2))] = np.inf
        fresh = _Panels(frame, series, missed, off)
        # No cycle ends with a lower state than the first adds.
        least = np.maximum(frame.starts, counted.first_increment)
        cut = ~(SAFETY * missed <= rtol / 4 * least)
        if not cut.any() or rounds == MOST_ROUNDS - 1:
            done.append(fresh)
            break
        done.append(take(fresh, ~cut))
        frame = stacked(take(frame, cut).cut(SPLIT))
    panels = stacked(done)
    return take(panels, np.argsort(panels.frame.starts))


def _violent(
    problem: Problem, start: float, limit: float, phases: FloatArray, size: Settings
) -> tuple[FloatArray, float]:
    """Return what one cycle from the state `start` adds up to each phase (m,), by the adaptive
    integrator, and what that may have missed."""
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
    """Return the columns to interpolate, from what is added (starts, phases)."""
    if observable is None:
        return added
    values = observable(starts[:, None] + added, forcing)
    return np.concatenate([added, np.log(values + TINY)], axis=1)


def _resolved(
    maps: PeriodMap, starts: FloatArray, phases: FloatArray, rtol: float
) -> tuple[PeriodMap, FloatArray]:
    """Return what is added up to each phase, (starts, phases), no number where that is not found;
    and the map that resolves the rate at every phase: first as if the rate did not feel the state
    within the cycle, which costs least, then as it is."""
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
    """Return which intervals (1, q) hold a rate (1, k, q, m) whose running integral is not
    resolved.

    Unlike its integral over the interval, that is no better than its interpolant.
    """
    series = np.abs(coefficients(over.rule.coefficients, rate))
    tail, largest = np.max(series[-3:], axis=0), np.max(series, axis=0)
    left = tail * over.lengths > tolerance * integral(rate, over)[..., None]
    marked: BoolArray = np.any(left & (tail > 100 * ROUNDOFF * largest), axis=1)
    return marked


def _judged(maps: PeriodMap, starts: FloatArray, phases: FloatArray, size: Settings) -> FloatArray:
    """Return what is added up to each phase, (starts, phases), by a second discretisation."""
    m = 2 * size.finer_nodes - size.phase_nodes
    again = period_map(maps.equation, maps.over.edges[:, 0], m)
    return _at_phases(again.advance(starts[None]), again.over, phases)


def _at_phases(run: CycleSolution, over: Mesh, phases: FloatArray) -> FloatArray:
    """Return what is added up to each phase, (starts, phases)."""
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
