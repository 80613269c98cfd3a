"""Abel's equation on panels that adapt: solved with one period map, checked by a finer one.

The error of the series is largest between the nodes, at the extrema of the last polynomials. The
error of the mesh of phase changes its sign with the state, so it is estimated at all nodes. Where
the residual exceeds the tolerance and the two maps differ, the phase is refined; else the panel is
cut in two.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from wear.numerics.chebyshev import chebyshev_analysis, chebyshev_nodes, chebyshev_values
from wear.numerics.collocation import CycleSolution, InitialGuess, unresolved
from wear.numerics.gauss import BoolArray, FloatArray, IntArray
from wear.numerics.rows import stacked, take
from wear.orbit import abel
from wear.orbit.period_map import TAIL_SHARE, PeriodMap, Settings
from wear.orbit.problem import Cost

CHECKS = -np.cos(np.pi * np.array([0, 1 / 6, 3 / 8, 5 / 8, 7 / 8, 1]))  # extrema of T_24 and T_48
FAR_OUT = 10.0  # times the residual elsewhere: a larger one at the end of a panel lies there alone
SPLIT = 0.4  # of a panel, in its coordinate: the density is sharper at low states
FASTER = 2.0  # the rate at the end of a panel over its mean, at most
MOST_ROUNDS = 12  # of refinement
MOST_PANELS = 200  # of a scene


class Layout(NamedTuple):
    """Panels, each of a `scene` (panels,), and the `rate` (panels, k, q, m) without feedback in
    cycles from their nodes, if it is known."""

    scene: IntArray
    grid: abel.Grid
    rate: FloatArray | None = None


class PanelCycles(NamedTuple):
    """Cycles from some positions of panels: the `increment` (panels, k), and the increment since
    the start at the nodes of phase, `inside` (panels, k, q, m)."""

    increment: FloatArray
    inside: FloatArray


class PanelSolution(NamedTuple):
    """The solution of Abel's equation on panels of many scenes, in rising order scene by scene: the
    `scene` (panels,) of each, its density, the largest `residual` (panels,) off the nodes, and
    whether it is `short` (panels,): cut in two it would hold too few cycles, and might hide an
    oscillation. If they are kept, the `cycles` from the nodes, and those from the CHECKS."""

    scene: IntArray
    density: abel.Density
    residual: FloatArray
    short: BoolArray
    cycles: tuple[PanelCycles, ...] = ()


def adapt(
    coarse: PeriodMap,
    fine: PeriodMap,
    layout: Layout,
    size: Settings,
    tolerance: FloatArray,
    keep: bool,
) -> tuple[PanelSolution, BoolArray, Cost]:
    """Solve Abel's equation on panels, and cut those with a residual above the `tolerance`
    (scenes,); `keep` the cycles of panels or not. Return the solution, the intervals of phase
    (scenes, q) that must be refined before it is of use, and the cost."""
    done: list[PanelSolution] = []
    marked = np.zeros((len(tolerance), coarse.over.lengths.shape[-1]), dtype=bool)
    cost = Cost(0, 0)
    for rounds in range(MOST_ROUNDS):
        fresh, share, coarse_phase, added = _solve_and_check(
            coarse, fine, layout, size, tolerance, keep
        )
        scene, grid, _ = layout
        cost = cost.plus(*added)
        np.logical_or.at(marked, scene, coarse_phase)
        bad = ~(fresh.residual <= tolerance[scene])
        # Beyond a panel that cannot be cut nothing is wanted; the phase is to be refined first.
        end = np.full(len(marked), np.inf)
        for part in [*done, fresh]:
            stuck = part.short & ~(part.residual <= tolerance[part.scene])
            np.minimum.at(end, part.scene[stuck], part.density.grid.starts[stuck])
        cut = bad & ~fresh.short & (grid.starts < end[scene]) & ~np.any(marked, axis=1)[scene]
        number = sum(len(part.scene) for part in done) + len(scene)
        if rounds == MOST_ROUNDS - 1 or number > MOST_PANELS * len(marked) or not cut.any():
            done.append(fresh)
            break
        done.append(take(fresh, ~cut))
        layout = Layout(np.tile(scene[cut], 2), stacked(take(grid, cut).cut(share[cut])))
    panels = stacked(done)
    order = np.lexsort((panels.density.grid.starts, panels.scene))
    return take(panels, order), marked, cost


def _solve_and_check(
    coarse: PeriodMap,
    fine: PeriodMap,
    layout: Layout,
    size: Settings,
    tolerance: FloatArray,
    keep: bool,
) -> tuple[PanelSolution, FloatArray, BoolArray, Cost]:
    """Solve Abel's equation with the coarse map, and check it off the nodes with the fine one.
    Return the solution, the share (panels,) of each panel at which to cut it, the intervals of
    phase (panels, q) to be refined instead, and the cost."""
    scene, grid, frozen = layout
    coarse, fine, allowed = coarse.take(scene), fine.take(scene), tolerance[scene]
    nodes, checks = chebyshev_nodes(size.panel_nodes), grid.states(CHECKS)
    ahead = coarse.advance(grid.states(nodes), frozen=frozen)
    density = abel.solve(grid, ahead.increment)
    judge = fine.advance(checks, at_checks(ahead, size.finer_nodes))
    residuals = np.abs(abel.residual(density, CHECKS, judge.increment))
    far = np.max(residuals[:, -2:], axis=1) > FAR_OUT * np.max(residuals[:, :-2], axis=1)
    far &= grid.c > 0.0
    iteration = judge.iteration_error.max(axis=1) + ahead.iteration_error.max(axis=1)
    by_phase = np.max(coarse.phase_error(ahead), axis=1)
    residual = np.maximum(np.max(residuals, axis=1) + iteration, by_phase)
    taken = 2 / grid.step(nodes, ahead.increment)[..., 0]
    share = np.where(far, grid.x_of(grid.widths[:, None] / 2)[:, 0] / grid.x_ends, SPLIT)
    short = _cycles_if_cut(taken, share) < size.panel_nodes
    cost = Cost(ahead.increment.size, ahead.evaluations)
    cost = cost.plus(judge.increment.size, judge.evaluations)
    marked = np.repeat(~ahead.converged[:, None], coarse.over.lengths.shape[-1], axis=1)
    rows = np.flatnonzero(by_phase > allowed)
    if len(rows):
        shares = allowed[rows, None, None] / (TAIL_SHARE * marked.shape[1])
        marked[rows] |= unresolved(ahead.rate[rows], coarse.take(rows).over, shares)
    rows = np.flatnonzero(~(residual <= allowed))
    if len(rows):
        maps = coarse.take(rows)
        again = maps.advance(checks[rows])
        cost = cost.plus(again.increment.size, again.evaluations)
        difference = np.max(np.abs(again.increment / judge.increment[rows] - 1.0), axis=1)
        # Only a difference of the two maps is an error of the phase.
        agree = np.less(difference, np.maximum(allowed[rows] / 4, residual[rows] / 10))
        by_mesh = ~agree[:, None]  # also where one of them is no number
        marked[rows] |= by_mesh & unresolved(again.rate, maps.over, size.phase_tolerance)
        marked[rows] |= by_mesh & ~np.any(marked[rows], axis=1, keepdims=True)
    kept = tuple(PanelCycles(run.increment, run.inside) for run in (ahead, judge)) if keep else ()
    return PanelSolution(scene, density, residual, short, kept), share, marked, cost


def near_checks(error: FloatArray, t: FloatArray) -> FloatArray:
    """Return the error (k, n, ...) at the positions `t` (k, n) of panels: the larger `error`
    (k, checks, ...) at the two CHECKS next to each."""
    after = np.clip(np.searchsorted(CHECKS, t), 1, len(CHECKS) - 1)
    rows = np.arange(len(t))[:, None]
    return np.asarray(np.maximum(error[rows, after], error[rows, after - 1]))


def at_checks(ahead: CycleSolution, m: int) -> InitialGuess:
    """Return the cycles from the CHECKS as a guess for m nodes on each interval: interpolated
    between those `ahead` from the nodes of panels."""
    nodes = ahead.increment.shape[1]
    to_checks = chebyshev_values(CHECKS, nodes) @ chebyshev_analysis(nodes)
    inside, rate = (
        (to_checks @ x.reshape(*x.shape[:2], -1)).reshape(len(x), -1, *x.shape[2:])
        for x in (ahead.inside, ahead.rate)
    )
    return ahead._replace(inside=inside, rate=rate).guess(m)


def _cycles_if_cut(taken: FloatArray, share: FloatArray) -> FloatArray:
    """Return the approximate number of cycles on the first part of each panel, a `share` (panels,)
    of it, from the numbers `taken` (panels, m) on the whole panel at the rate of each node; at most
    FASTER times the number at the rate of its end."""
    rows, m = np.arange(len(taken)), taken.shape[1]
    inside = np.minimum(np.searchsorted(chebyshev_nodes(m), 2 * share - 1), m - 1)
    mean = np.cumsum(taken, axis=1)[rows, inside - 1] / inside
    fewer: FloatArray = share * np.minimum(mean, FASTER * taken[rows, inside])
    return fewer
