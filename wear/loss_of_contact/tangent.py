"""Derivatives of the wear with loss of contact, after any numbers of cycles."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from wear.loss_of_contact.arrest import TabulatedIterates
from wear.loss_of_contact.cycle_derivatives import (
    CycleDerivatives,
    Response,
    derivatives_of_grazing_wears,
    derivatives_of_origins,
    map_derivatives,
    sample_wears,
)
from wear.loss_of_contact.increments import IncrementSeries, step
from wear.loss_of_contact.period_map import SwitchedPeriodMap, switched_period_map
from wear.loss_of_contact.switching import Edge
from wear.numerics.chebyshev import chebyshev_nodes
from wear.numerics.floating_point import ROUNDOFF
from wear.numerics.gauss import BoolArray, FloatArray, IntArray
from wear.numerics.rows import stacked, take
from wear.orbit import abel
from wear.orbit.iterates import Iterates
from wear.orbit.panels import CHECKS
from wear.orbit.period_map import settings
from wear.orbit.segments import AnyIterates
from wear.orbit.tangent import (
    Known,
    MapDerivatives,
    Tangents,
    after_each_cycle,
    after_on_cells,
    sums_on_cells,
    tangents_by_segment,
)
from wear.orbit.transient import SAFETY
from wear.parameters import ParametrisedEquation
from wear.scene_orbit import SceneOrbit

LIMIT_DIGITS = 1e12  # of the derivative of a limit wear, which follows from the margin alone
SMOOTH = 1e-3  # share of an increment in its second difference, at most


@np.errstate(all="ignore")
def stage_tangents(
    solution: SceneOrbit,
    equation: ParametrisedEquation,
    edge: Edge,
    cycles: FloatArray,
    rtol: float,
    start: Known,
) -> Tangents:
    """Return the derivatives of the wear of one scene after `cycles` (1, n) by its `solution` to
    `rtol`, from those (1, parameters) of the first wear.

    The cycles of all segments are linearised at once; where many of them lie along a series of
    increments, their derivatives are a series, too.
    """
    size, scene = settings(rtol), ([equation.model], equation.loads, [edge])
    cycle = switched_period_map(*scene, size.phase_nodes, size.endpoint_tolerance)
    segments = [segment.iterates for segment in solution.orbit.segments]
    tables = [iterates for iterates in segments if isinstance(iterates, TabulatedIterates)]
    series = list({id(table.series): table.series for table in tables}.values())
    origins = derivatives_of_origins(equation, [each.coordinate for each in series])
    runs = _of_each(cycle, equation, segments, list(zip(series, origins, strict=True)))
    of_series = {id(each): origin for each, origin in zip(series, origins, strict=True)}

    def in_segment(number: int, wanted: FloatArray, before: Known) -> tuple[Known, FloatArray]:
        iterates, run = segments[number], runs[number]
        if isinstance(iterates, Iterates):
            return _one_by_one(iterates, run, wanted, before)
        if isinstance(iterates, TabulatedIterates):
            return _tabulated(iterates, run, of_series[id(iterates.series)], wanted, before)
        # In an unresolved segment no cycle is known.
        limit = np.full(equation.parameters, np.inf)
        if iterates.at_rest[0]:
            (limit,) = derivatives_of_grazing_wears(equation, np.array([solution.last_wear]))
        found = np.broadcast_to(limit, (*wanted.shape, len(limit)))
        return Known(found, np.abs(found) / LIMIT_DIGITS), np.zeros_like(wanted)

    found = tangents_by_segment(solution.orbit, cycles, start, in_segment)
    # Errors by rounding and by the mesh of phase are relatively as large as those of the wear.
    error = found.derivative_error + found.error[:, None] * np.abs(found.derivative)
    return found._replace(derivative_error=np.where(np.isfinite(error), error, np.inf))


def _starts(iterates: AnyIterates) -> FloatArray:
    """Return the wears (mm) from which cycles of a segment are linearised: those of single cycles,
    some of them also moved by their error; the nodes and the CHECKS of panels."""
    if isinstance(iterates, Iterates):
        wear, beside = iterates.transient[0], iterates.transient[0] + iterates.transient_error[0]
        return np.concatenate([wear[:-1], beside[_abrupt(iterates)]])
    if isinstance(iterates, TabulatedIterates):
        return iterates.coordinate.wear(_resolved(iterates, _positions(iterates))).ravel()
    return np.empty(0)


def _abrupt(iterates: Iterates) -> IntArray:
    """Return the single cycles whose increments change abruptly, as next to a grazing wear: there
    the derivatives are sensitive to errors of the wear."""
    added = np.diff(iterates.transient[0])
    change = np.abs(added[2:] - 2 * added[1:-1] + added[:-2])
    abrupt = np.full(len(added), True)
    abrupt[1:-1] = ~(change <= SMOOTH * added[1:-1])
    return np.flatnonzero(abrupt)


def _positions(iterates: TabulatedIterates) -> FloatArray:
    """Return the nodes of panels, and then the CHECKS."""
    return np.append(chebyshev_nodes(iterates.density.series.shape[1]), CHECKS)


def _resolved(iterates: TabulatedIterates, t: FloatArray) -> FloatArray:
    """Return z (panels, n) at the positions `t` (n,) of panels, no nearer to the limit wear than
    rounding permits."""
    z = iterates.density.grid.states(t)
    limit_wear = iterates.limit_wear
    return z if limit_wear is None else np.minimum(z, 1.0 / limit_wear.nearest)


def _one_by_one(
    iterates: Iterates, run: CycleDerivatives, cycles: FloatArray, start: Known
) -> tuple[Known, FloatArray]:
    """Return the derivatives after some of the single cycles (1, n), and the last increments."""
    derivatives, derivatives_error = run.along(0.0)
    tangents, beside = np.split(derivatives, [iterates.integrated_cycles])
    difference, abrupt = derivatives_error[: len(tangents)], _abrupt(iterates)
    difference[abrupt] += np.abs(tangents[abrupt] - beside)
    tangents[:, 0] += 1.0
    of_cycles, error = (MapDerivatives(x[None, :, :1], x[None, :, 1:])
                        for x in (tangents, difference))  # fmt: skip
    found = after_each_cycle(start, of_cycles, error, np.full((1, len(tangents)), ROUNDOFF))
    index = cycles.astype(int)
    added = np.concatenate([[0.0], np.diff(iterates.transient[0])])
    return Known(*(values[:, index[0]] for values in found)), added[index]


def _tabulated(
    iterates: TabulatedIterates,
    run: CycleDerivatives,
    limit: FloatArray,
    cycles: FloatArray,
    start: Known,
) -> tuple[Known, FloatArray]:
    """Return the derivatives after `cycles` (1, n) in a table between two grazing wears, and the
    last increments.

    The sums are those of the difference to `limit` (parameters,), the derivative of the grazing
    wear: that is smooth in the distance. At a limit wear the last cycles hardly change it.
    """
    count, z = iterates.in_z, iterates.coordinate
    added = _added(iterates, run, limit)
    nodes, checks = (
        abel.SumIncrements(*(x[:, columns] for x in added))
        for columns in (slice(None, -len(CHECKS)), slice(-len(CHECKS), None))
    )
    into_z = 1.0 / z.rate(iterates.table.u[:1], np.ones(1))
    from_limit = Known(into_z * (start.derivative - limit), into_z * start.error)
    sums = sums_on_cells(count, nodes, checks, from_limit)
    wanted = np.minimum(cycles, iterates.reach)
    at, _ = count.after(wanted)
    by_z, rate = after_on_cells(count, sums, wanted, at)
    from_z = z.rate(at, np.ones(1))[..., None]
    error = from_z * by_z.error + SAFETY * ROUNDOFF * np.abs(limit)
    return Known(limit + from_z * by_z.derivative, error), from_z[..., 0] * rate


def _added(
    iterates: TabulatedIterates, run: CycleDerivatives, limit: FloatArray
) -> tuple[FloatArray, ...]:
    """Return the fields of `SumIncrements` for cycles from the nodes and the CHECKS of each panel:
    for z, and for dz/dp less its value for du/dp = `limit` (parameters,)."""
    density, coordinate, t = iterates.density, iterates.coordinate, _positions(iterates)
    z, at = density.grid.states(t), _resolved(iterates, t)
    near = np.where(at < z, at / z, 1.0)  # nearer, the difference shrinks with the distance
    increment = step(coordinate.ahead, at, run.increment.reshape(z.shape)) / near
    one, after = np.ones(1), coordinate.rate(z + increment, np.ones(1))
    into_z = (near / after)[..., None]
    multiplier = (1.0 + run.tangent[:, 0].reshape(z.shape)) * coordinate.rate(z, one) / after
    change, error = (x[:, 1:].reshape(*z.shape, -1) for x in run.along(limit))
    return increment, into_z * change, multiplier, SAFETY * into_z * error


def _of_each(
    cycle: SwitchedPeriodMap,
    equation: ParametrisedEquation,
    segments: Sequence[AnyIterates],
    known: Sequence[tuple[IncrementSeries, FloatArray]],
) -> list[CycleDerivatives]:
    """Return the derivatives of the cycles that each segment needs, all at once: by the response
    along a `known` series of increments, with the derivatives (parameters,) of its origin, where
    that takes fewer cycles."""
    starts = [_starts(iterates) for iterates in segments]
    wear = np.concatenate(starts)
    alone = np.full(len(wear), True)
    sampled: list[tuple[IncrementSeries, FloatArray, FloatArray, BoolArray]] = []
    for series, origin in known:
        along = alone & (series.domain.start <= wear) & (wear < series.domain.end)
        if np.count_nonzero(along) > len(own := sample_wears(series)) > 0:
            sampled.append((series, origin, own, along))
            alone &= ~along
    parts = [wear[alone], *(own for _, _, own, _ in sampled)]
    first, *others = _split(map_derivatives(cycle, equation, np.concatenate(parts)), parts)
    runs, order = [first], [np.flatnonzero(alone)]
    for (series, origin, own, along), run in zip(sampled, others, strict=True):
        runs.append(Response.of(series, origin, own, run).map_derivatives(wear[along]))
        order.append(np.flatnonzero(along))
    back = np.argsort(np.concatenate(order))
    return _split(take(stacked(runs), back), starts)


def _split(run: CycleDerivatives, starts: Sequence[FloatArray]) -> list[CycleDerivatives]:
    """Return the cycles from each of several `starts`, which follow each other."""
    ends = np.cumsum([0, *(len(each) for each in starts)]).tolist()
    return [take(run, slice(*pair)) for pair in pairwise(ends)]
