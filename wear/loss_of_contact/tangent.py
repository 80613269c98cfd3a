"""Derivatives of the wear with loss of contact, after any numbers of cycles."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from wear.loss_of_contact.arrest import TabulatedIterates
from wear.loss_of_contact.cycle_derivatives import (
    CycleDerivatives,
    derivatives_of_grazing_wears,
    derivatives_of_origins,
    map_derivatives,
)
from wear.loss_of_contact.increments import step
from wear.loss_of_contact.period_map import switched_period_map
from wear.loss_of_contact.switching import Edge
from wear.numerics.chebyshev import chebyshev_nodes
from wear.numerics.floating_point import ROUNDOFF
from wear.numerics.gauss import FloatArray, IntArray
from wear.numerics.rows import take
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

    The cycles of all segments are linearised at once.
    """
    size, scene = settings(rtol), ([equation.model], equation.loads, [edge])
    cycle = switched_period_map(*scene, size.phase_nodes, size.endpoint_tolerance)
    segments = [segment.iterates for segment in solution.orbit.segments]
    starts = [_starts(iterates) for iterates in segments]
    run_of_all = map_derivatives(cycle, equation, np.concatenate(starts))
    ends = np.cumsum([0, *(len(each) for each in starts)]).tolist()
    runs = [take(run_of_all, slice(*pair)) for pair in pairwise(ends)]

    def in_segment(number: int, wanted: FloatArray, before: Known) -> tuple[Known, FloatArray]:
        iterates, run = segments[number], runs[number]
        if isinstance(iterates, Iterates):
            return _one_by_one(iterates, run, wanted, before)
        if isinstance(iterates, TabulatedIterates):
            (limit,) = derivatives_of_origins(equation, [iterates.series.coordinate])
            return _tabulated(iterates, run, limit, wanted, before)
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
    tangents, beside = np.split(run.tangent, [iterates.integrated_cycles])
    difference, abrupt = np.zeros_like(tangents), _abrupt(iterates)
    difference[abrupt] += np.abs(tangents[abrupt] - beside)
    tangents = tangents + np.eye(tangents.shape[1])[0]
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
    change = (run.tangent[:, 1:] + limit * run.tangent[:, :1]).reshape(*z.shape, -1)
    return increment, into_z * change, multiplier
