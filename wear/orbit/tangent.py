"""Derivatives of an orbit with respect to the parameters of its equation.

Overview
    A cycle turns the derivative s = du/dp into E s + D, where E = dP/du and D = dP/dp follow from
    the equation linearised along the cycle. With g = dn/du, which satisfies E = g(u)/g(P(u)), a
    cycle adds g(P(u)) D to S = g s: S is a sum over the orbit. On panels it is the integral of
    dS/dn over n, which Abel's equation gives with the matrix of Newton's method; the cost does not
    depend on the number of cycles.
Key results
    tangents    du/dp after any numbers of cycles, for all parameters p at once
References
    E. Hairer, S. P. Norsett, G. Wanner, *Solving Ordinary Differential Equations I*, Springer 1993,
    I.14 (the derivative with respect to parameters); M. Kuczma, B. Choczewski, R. Ger, *Iterative
    Functional Equations*, Cambridge University Press 1990, chapter 3.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple, Protocol, cast

import numpy as np

from wear.numerics.chebyshev import chebyshev_nodes, chebyshev_values
from wear.numerics.collocation import CycleSolution
from wear.numerics.floating_point import ROUNDOFF, TINY
from wear.numerics.gauss import FloatArray, IntArray, gauss, integral, running_integral
from wear.numerics.initial_value import StoppedError
from wear.numerics.rows import take
from wear.orbit import abel
from wear.orbit.iterates import NODES, CountTable, Iterates, cell_of
from wear.orbit.panels import CHECKS, PanelCycles, near_checks
from wear.orbit.period_map import PeriodMap, Selection, Settings, period_map, settings
from wear.orbit.problem import Problem
from wear.orbit.segments import TIGHT, Orbit
from wear.orbit.transient import SAFETY

BESIDE = 0.1  # of a cell: distance for the logarithmic derivative of the density
ITERATION_TOLERANCE = 1e-13  # of the period map: its derivatives have no more digits


class ParametrisedProblem(Problem, Protocol):
    """An equation whose rate depends on parameters."""

    @property
    def parameters(self) -> int:
        """Return the number of parameters."""

    def take(self, rows: Selection) -> ParametrisedProblem: ...

    def by_parameters(
        self, u: FloatArray, phases: FloatArray, forcing: FloatArray, weights: FloatArray
    ) -> FloatArray:
        """Return the sum (scenes, starts, parameters) over all nodes of `weights` times the
        derivative of the rate with respect to each parameter; the arrays are (scenes, starts,
        intervals, nodes)."""


class Tangents(NamedTuple):
    """Of some scenes (s,) after some cycles (c,): the states `u` (s, c) and their relative `error`,
    the `derivative` du/dp (s, parameters, c) and its estimated absolute `derivative_error`, and
    the `increment` (s, c) of the last cycle."""

    u: FloatArray
    error: FloatArray
    derivative: FloatArray
    derivative_error: FloatArray
    increment: FloatArray


class MapDerivatives(NamedTuple):
    """Cycles from some starts: `multiplier` (scenes, starts) dP/du, and `by_parameters` (scenes,
    starts, parameters) dP/dp; or the errors of these."""

    multiplier: FloatArray
    by_parameters: FloatArray


def map_derivatives(
    maps: PeriodMap, starts: FloatArray, run: CycleSolution | PanelCycles
) -> MapDerivatives:
    """Return the derivatives of the period map, from the cycles `run` from the `starts`.

    A change of the rate at a phase is carried to the end of the cycle by the exponential of the
    integral of the rate's slope from there on.
    """
    u, over = starts[..., None, None] + run.inside, maps.over
    slope = maps.slope(u)
    growth = integral(slope, over)
    ahead = growth[..., None, None] - running_integral(slope, over)
    weights = np.exp(ahead) * (over.lengths[..., None] * over.rule.weights)
    equation = cast(ParametrisedProblem, maps.equation)
    by_parameters = equation.by_parameters(u, over.phases, maps.forcing, weights)
    return MapDerivatives(np.exp(growth), by_parameters)


class OrbitSums(NamedTuple):
    """S = (dn/du) (du/dp) on the cells of a count table: its value at the start of each cell (s,
    cells, parameters), its estimated error there and where the last one ends (s, cells + 1,
    parameters), and the coefficients `series` (panels, m, parameters) of dS/dn."""

    start: FloatArray
    error: FloatArray
    series: FloatArray


class Known(NamedTuple):
    """Derivatives du/dp (s, ..., parameters) of some scenes, and their estimated `error`."""

    derivative: FloatArray
    error: FloatArray


InSegment = Callable[[int, FloatArray, Known], tuple[Known, FloatArray]]
"""The derivatives (s, c, parameters) after `cycles` (s, c) since the start of the segment with a
number, where they are those of the scenes (s,) at its start; and the increments (s, c) of the last
cycles."""


def tangents(
    problem: ParametrisedProblem, orbit: Orbit, cycles: FloatArray, rtol: float, start: Known
) -> Tangents:
    """Return the derivatives of the states of an `orbit` after `cycles` (s, c), if those of the
    first state are known. The orbit was computed to `rtol`, with its cycles kept."""

    def in_segment(number: int, wanted: FloatArray, before: Known) -> tuple[Known, FloatArray]:
        segment = orbit.segments[number]
        own = problem.take(segment.which)
        return _in_segment(own, cast(Iterates, segment.iterates), wanted, rtol, before)

    return tangents_by_segment(orbit, cycles, start, in_segment)


def tangents_by_segment(
    orbit: Orbit, cycles: FloatArray, start: Known, in_segment: InSegment
) -> Tangents:
    """Return the derivatives of the states of an `orbit` after `cycles` (s, c), segment by segment,
    from those at its `start`."""
    u, error = orbit.after(cycles)
    derivative = np.full((*cycles.shape, start.derivative.shape[1]), np.nan)
    bound, increment = np.full(derivative.shape, np.inf), np.zeros(cycles.shape)
    now = Known(start.derivative.copy(), start.error.copy())
    for number, (which, iterates, begins, *_) in enumerate(orbit.segments):
        since, last = cycles[which] - begins[:, None], iterates.whole_cycles[:, None]
        wanted = np.concatenate([np.clip(since, 0.0, last), last], axis=1)
        own, added = in_segment(number, wanted, take(now, which))
        for array, part in zip((derivative, bound, increment), (*own, added), strict=True):
            here = since >= 0.0 if part.ndim == 2 else (since >= 0.0)[..., None]
            array[which] = np.where(here, part[:, :-1], array[which])
        now.derivative[which], now.error[which] = (values[:, -1] for values in own)
    bound[~np.isfinite(error)] = np.inf
    derivative, bound = np.moveaxis(derivative, 2, 1), np.moveaxis(bound, 2, 1)
    return Tangents(u, error, derivative, bound, increment)


def _in_segment(
    problem: ParametrisedProblem,
    iterates: Iterates,
    cycles: FloatArray,
    rtol: float,
    start: Known,
) -> tuple[Known, FloatArray]:
    """Return the derivatives after `cycles` (s, c) since the start of a segment, see `InSegment`,
    and the increments of the last cycles (s, c)."""
    size = settings(rtol, problem.breakpoints)
    if iterates.cycles and iterates.cycles[0].inside.shape[-1] > size.phase_nodes:
        size = settings(TIGHT, problem.breakpoints)  # of the second try
    maps = period_map(problem, iterates.edges, size.phase_nodes, ITERATION_TOLERANCE)
    early = _in_transient(maps, iterates, size, start)
    number = iterates.integrated_cycles
    index = np.minimum(cycles, number).astype(int)
    rows = np.arange(len(cycles))[:, None]
    found = Known(early.derivative[rows, index], early.error[rows, index])
    added = np.diff(iterates.transient, axis=1)
    increment = added[rows, np.maximum(index - 1, 0)] if number else np.empty(cycles.shape)
    if iterates.table is not None:
        sums = _on_panels(maps, iterates, size, Known(*(x[:, -1] for x in early)))
        late = cycles > number if number else np.full(cycles.shape, True)
        counted = np.maximum(cycles, number)
        far, far_increment = after_on_cells(iterates, sums, counted, iterates.after(counted)[0])
        found = Known(*(np.where(late[..., None], *pair) for pair in zip(far, found, strict=True)))
        increment = np.where(late, far_increment, increment)
    return found, increment


def _in_transient(maps: PeriodMap, iterates: Iterates, size: Settings, start: Known) -> Known:
    """Return du/dp (s, k + 1, parameters) after 0, 1, ... k integrated cycles."""
    scenes, k = len(start.derivative), iterates.integrated_cycles
    if k == 0:
        return Known(*(values[:, None] for values in start))
    starts = iterates.transient[:, :-1].reshape(-1, 1)
    each = np.repeat(np.arange(scenes), k)
    coarse, fine = _of_cycles(maps.take(each), starts, iterates.limit[each], size)
    E, D = (values.reshape(scenes, k, -1) for values in fine)
    off = [np.abs(x - y.reshape(x.shape)) for x, y in zip((E, D), coarse, strict=True)]
    of_state = iterates.transient_error[:, 1:] / (iterates.transient[:, 1:] + TINY)
    return after_each_cycle(start, MapDerivatives(E, D), MapDerivatives(*off), of_state)


def after_each_cycle(
    start: Known, cycles: MapDerivatives, error: MapDerivatives, relative: FloatArray
) -> Known:
    """Return du/dp (s, k + 1, parameters) after 0, 1, ... k cycles, of which the derivatives,
    `multiplier` (s, k, 1) and `by_parameters` (s, k, parameters), have an absolute `error` and a
    `relative` one (s, k)."""
    derivative, bound = [start.derivative], [start.error]
    for i in range(relative.shape[1]):
        (E, D), (of_E, of_D) = (tuple(x[:, i] for x in each) for each in (cycles, error))
        grown = E * derivative[-1]
        local = of_E * np.abs(derivative[-1]) + of_D
        local += relative[:, i, None] * (np.abs(grown) + np.abs(D))
        derivative.append(grown + D)
        bound.append(np.abs(E) * bound[-1] + SAFETY * local)
    return Known(np.stack(derivative, axis=1), np.stack(bound, axis=1))


def _of_cycles(
    maps: PeriodMap, starts: FloatArray, limit: FloatArray, size: Settings
) -> tuple[MapDerivatives, MapDerivatives]:
    """Return the derivatives of the period map at each start (rows, 1), by the mesh and by a finer
    one; states stay below the `limit` (rows,). A cycle that the mesh does not resolve gets its own
    mesh, NaN if none resolves it."""
    run = maps.advance(starts)
    arrays = _linearised_twice(maps, starts, run, size)
    for row in np.flatnonzero(maps.unresolved(starts, run, size).any(axis=1))[:, None]:
        try:
            better = maps.take(row).cut_for(starts[row].item(), limit[row].item(), size)
        except StoppedError:
            again: Sequence[FloatArray] = [np.array(np.nan)] * len(arrays)
        else:
            again = _linearised_twice(better, starts[row], better.advance(starts[row]), size)
        for array, corrected in zip(arrays, again, strict=True):
            array[row] = corrected
    return MapDerivatives(*arrays[:2]), MapDerivatives(*arrays[2:])


def _linearised_twice(
    maps: PeriodMap, starts: FloatArray, run: CycleSolution, size: Settings
) -> list[FloatArray]:
    """Return both derivatives by the cycles `run` from the `starts`, and both by a finer map."""
    fine = maps.finer(size)
    judge = fine.advance(starts, run.guess(size.finer_nodes))
    return [*map_derivatives(maps, starts, run), *map_derivatives(fine, starts, judge)]


def _on_panels(maps: PeriodMap, iterates: Iterates, size: Settings, start: Known) -> OrbitSums:
    """Return S on the cells of a count table, from du/dp (s, parameters) where the first of each
    scene starts."""
    panels = iterates.density
    assert panels is not None
    scenes = len(start.derivative)
    own = maps.take(np.repeat(np.arange(scenes), len(panels.series) // scenes))
    at = chebyshev_nodes(panels.series.shape[1]), CHECKS
    nodes, checks = (
        _added(each, panels, t, run)
        for each, t, run in zip((own, own.finer(size)), at, iterates.cycles, strict=True)
    )
    return sums_on_cells(iterates, nodes, checks, start)


def sums_on_cells(
    iterates: Iterates, nodes: abel.SumIncrements, checks: abel.SumIncrements, start: Known
) -> OrbitSums:
    """Return S on the cells of a count table, from du/dp (s, parameters) where the first of each
    scene starts, and the cycles from the `nodes` of panels. Those from the CHECKS, by a finer map,
    give the error."""
    panels, table = iterates.density, iterates.table
    assert panels is not None
    assert table is not None
    series = abel.sum_per_cycle(panels, nodes)
    residual, of_density = abel.sum_residual(panels, CHECKS, checks, series)

    density, rates = _at_cells(panels, table, series, gauss(NODES).nodes)
    density = density * gauss(NODES).weights
    gain = np.einsum("cg,cgk->ck", density, rates)
    absolute = np.einsum("cg,cgk->ck", density, np.abs(rates))
    panel = np.repeat(np.arange(len(residual)), len(gain) // len(residual))
    grid, ends = take(panels.grid, panel), np.column_stack([table.u, table.ends])
    t = grid.positions(ends)
    worst = near_checks(residual[panel], t).max(axis=1)
    # The derivative of a residual along the orbit: small like that if summed over many cycles.
    of_density = near_checks(of_density[panel], t).max(axis=1) * np.minimum(table.number, 1.0)
    of_count = np.diff(iterates.count_error, axis=1).reshape(-1, 1) / table.number[:, None]
    error = SAFETY * (worst * table.number[:, None] + of_count * absolute)
    scenes, parameters = start.derivative.shape
    rate = table.first_rate.reshape(scenes, -1)[:, 0, None, None]
    first, first_error = (values[:, None] / rate for values in start)
    shape = (scenes, -1, parameters)
    sums = np.concatenate([first, gain.reshape(shape)], axis=1).cumsum(axis=1)
    terms = np.concatenate([np.abs(first), absolute.reshape(shape)], axis=1)
    error = error.reshape(shape) + of_density.reshape(*shape[:2], 1) * terms.cumsum(axis=1)[:, :-1]
    errors = np.concatenate([first_error, error], axis=1)
    return OrbitSums(sums[:, :-1], errors.cumsum(axis=1), series)


def _added(
    maps: PeriodMap, panels: abel.Density, t: FloatArray, run: PanelCycles
) -> abel.SumIncrements:
    """Return the increments of the cycles `run` from the positions `t` (n,) of each panel."""
    derivatives = map_derivatives(maps, panels.grid.states(t), run)
    return abel.SumIncrements(run.increment, derivatives.by_parameters, derivatives.multiplier)


def _at_cells(
    panels: abel.Density,
    table: CountTable,
    series: FloatArray,
    x: FloatArray,
    cell: IntArray | None = None,
) -> tuple[FloatArray, FloatArray]:
    """Return dn/dx (k, nodes) and dS/dn (k, nodes, parameters) at `x` (nodes,) or (k, nodes) from 0
    to 1 of each `cell` (k,), or of all."""
    of_panel = len(table.u) // len(panels.series)
    if cell is None:
        cell = np.arange(len(table.u))
    panel = cell // of_panel
    offset, length = table.offset[cell, None], table.length[cell, None]
    y = length * x
    own = take(panels, panel)
    t = own.grid.positions(table.u[cell, None] + offset * np.expm1(y))
    basis = chebyshev_values(t, panels.series.shape[1])
    level, shape = abel.level_and_shape(own.series)
    density = level * offset * length * np.exp((basis @ shape[..., None])[..., 0] + y)
    return density, basis @ series[panel]


def after_on_cells(
    iterates: Iterates, sums: OrbitSums, cycles: FloatArray, states: FloatArray
) -> tuple[Known, FloatArray]:
    """Return du/dp (s, c, parameters) after `cycles` (s, c) on the count table, which lead to the
    `states` (s, c), and du/dn."""
    table, panels = iterates.table, iterates.density
    assert table is not None
    assert panels is not None
    scenes, of_scene = len(cycles), len(table.u) // len(cycles)
    begins = table.cycles.reshape(scenes, -1)
    cell = np.stack([cell_of(*pair) for pair in zip(begins, cycles, strict=True)])
    flat = (cell + of_scene * np.arange(scenes)[:, None]).ravel()
    first = table.u.reshape(scenes, -1)[:, :1]  # rounding may lead below it
    u = np.maximum(states, first).ravel()
    x = np.log1p((u - table.u[flat]) / table.offset[flat]) / table.length[flat]
    rule = gauss(NODES)
    beside = np.where(x < 0.5, x + BESIDE, x - BESIDE)
    nodes = np.column_stack([x[:, None] * rule.nodes, x, beside])
    density, rates = _at_cells(panels, table, sums.series, nodes, flat)
    # du/dn from the density itself: Newton's last step may be larger than rounding.
    du_dn = table.length[flat] * (table.offset[flat] + u - table.u[flat]) / density[:, -2]
    growth = np.abs(np.log(density[:, -1] / density[:, -2])) / (BESIDE * density[:, -2])
    growth = growth.reshape(*cycles.shape, 1)
    dS_dn = np.abs(rates[:, -2]).reshape(*cycles.shape, -1)
    density, rates = density[:, :-2] * (x[:, None] * rule.weights), rates[:, :-2]
    rows = np.arange(scenes)[:, None]
    within = np.einsum("cg,cgk->ck", density, rates).reshape(*cycles.shape, -1)
    total = sums.start[rows, cell] + within
    share = x.reshape(cycles.shape)[..., None]
    error = (1 - share) * sums.error[rows, cell] + share * sums.error[rows, cell + 1]
    # The errors of the density and of the count shift the place where S is evaluated.
    steps = np.diff(iterates.count_error, axis=1)
    own = SAFETY * (steps.reshape(-1)[flat] / table.number[flat]).reshape(*cycles.shape, 1)
    count = iterates.count_error[rows, cell + 1][..., None]
    error = error + (own + growth * count + ROUNDOFF) * np.abs(total) + dS_dn * count
    du_dn = du_dn.reshape(*cycles.shape, 1)
    return Known(du_dn * total, du_dn * error), du_dn[..., 0]
