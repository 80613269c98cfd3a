"""The plan of panels, by a rate that is frozen over each cycle: approximate, and cheap.

It determines how far panels must reach, and cuts them until they resolve the density. The residual
of Abel's equation reveals its errors.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from wear.numerics.chebyshev import chebyshev_analysis, chebyshev_nodes
from wear.numerics.collocation import unresolved
from wear.numerics.floating_point import TINY
from wear.numerics.gauss import BoolArray, FloatArray, IntArray, integral, product
from wear.numerics.rows import stacked, take
from wear.orbit import abel
from wear.orbit.iterates import nonzero
from wear.orbit.panels import FASTER, SPLIT, Layout
from wear.orbit.period_map import IN_CACHE, PeriodMap, Settings, by_size, period_map
from wear.orbit.problem import Problem, Request

LEAST = 200.0  # the last panel reaches this count at least: panels are long against a cycle
MARGIN = 4.0  # times the requested cycles are looked ahead
LONGEST, STEPS = 36.0, 60  # of the look ahead, in ln(1 + u/scale)
AHEAD_NODES = 10  # on each interval of phase, to look ahead
COORDINATE_SCALE = 12.0  # of the coordinate of panels, over the scale: one serves to infinity
SMALL = 0.65  # of the state and its scale: a cycle that adds more changes the rate much
SHARP = 0.3  # change of the logarithm of the density within a cycle
MOST_LOG = 650.0  # logarithm of a density whose exponential is finite
MOST_PLANNED = 150  # panels of a scene


class StatesAhead(NamedTuple):
    """States `u` (s, k) from the start of scenes (s,) on, equally far apart in y = ln(u + scale),
    up to their limits; `y` (s, k) is measured from the start."""

    y: FloatArray
    u: FloatArray
    scale: FloatArray

    def after(self, added: FloatArray, cycles: FloatArray) -> FloatArray:
        """Return the approximate states after `cycles` (s,), the last ones if these lead beyond;
        a cycle has `added` (s, k) at each state."""
        density = -np.log(np.log1p(added / (self.u + self.scale[:, None])) + TINY)
        # Between two points the density is taken as exponential in y.
        rise, step, longest = nonzero(np.diff(density, axis=1)), self.y[:, 1], self.y[:, -1]
        first = np.exp(density[:, :-1]) * step[:, None] / rise
        counts = np.cumsum(first * np.expm1(rise), axis=1)
        part = np.minimum(np.sum(counts < cycles[:, None], axis=1), STEPS - 1)
        at = (np.arange(len(cycles)), part)
        missing = cycles - np.where(part > 0, counts[at[0], part - 1], 0.0)
        share = np.log1p(missing / first[at]) / rise[at]
        # Where the states end before the cycles do, the share is no number.
        y = np.fmin(self.y[at] + share * step, longest)
        end: FloatArray = self.u[:, 0] + (self.u[:, 0] + self.scale) * np.expm1(y)
        return end


def states_ahead(start: FloatArray, scale: FloatArray, limit: FloatArray) -> StatesAhead:
    """Return states ahead of the `start` (s,)."""
    longest = np.minimum(LONGEST, np.log1p((limit - start) / (start + scale)))
    y = (longest / STEPS)[:, None] * np.arange(STEPS + 1)
    return StatesAhead(y, start[:, None] + (start + scale)[:, None] * np.expm1(y), scale)


def look_ahead(problem: Problem, request: Request) -> FloatArray:
    """Return the states (s,) that panels must reach: approximately those after the requested
    cycles, with the rate frozen over each cycle."""
    ahead = states_ahead(request.start, problem.scale, problem.limit)
    added = np.empty_like(ahead.u)
    for which, edges in by_size(problem.breakpoints):
        maps = period_map(problem.take(which), edges, AHEAD_NODES)
        added[which] = maps.increment_without_feedback(ahead.u[which])
    return ahead.after(added, MARGIN * np.maximum(request.cycles, LEAST))


class PanelPlan(NamedTuple):
    """A `layout` of panels, scene by scene and rising; the approximate number of `cycles` (panels,)
    on each, zero where a cycle changes its own rate much; and the intervals of phase (panels, q)
    that do not resolve the rate without feedback."""

    layout: Layout
    cycles: FloatArray
    unresolved: BoolArray


def planned(
    maps: PeriodMap, scene: IntArray, grid: abel.Grid, size: Settings, tolerance: FloatArray
) -> PanelPlan:
    """Return a plan of panels, cut until their coefficients resolve the density without feedback,
    and until none would hold few cycles at the rate of its end: its last cycle leads beyond it.
    Phase is resolved to the `tolerance` (scenes,)."""
    m = size.panel_nodes
    nodes, analysis = chebyshev_nodes(m), chebyshev_analysis(m)[-2:].T
    done: list[PanelPlan] = []
    number = 0
    while True:
        of_panels = maps.take(scene)
        rate = of_panels.rate_without_feedback(grid.states(nodes))
        frozen = integral(rate, of_panels.over)
        violent = frozen[:, 0] > SMALL * (grid.starts + grid.c / COORDINATE_SCALE)
        density = np.minimum(-np.log(frozen + TINY), MOST_LOG)
        # Less a constant, whose rounding would look like a tail.
        tail = np.max(np.abs(product(density - density[:, :1], analysis)), axis=1)
        step = grid.step(nodes, np.exp(-density))[..., 0]
        taken = 2 / step
        cycles, at_end = np.mean(taken, axis=1), FASTER * taken[:, -1]
        sharp = abel.change_in_a_cycle(density, step) > SHARP
        cut = (tail > size.tail_tolerance) | ((cycles > 2 * m) & ((at_end < m) | sharp))
        number += len(scene)
        cut &= number < MOST_PLANNED * maps.scenes
        cycles = np.where(sharp | violent, 0.0, np.minimum(cycles, at_end))
        kept = rate if rate[0].size <= IN_CACHE else None  # else it costs more than it saves
        coarse = unresolved(rate, of_panels.over, tolerance[scene, None, None])
        done.append(take(PanelPlan(Layout(scene, grid, kept), cycles, coarse), ~cut))
        if not cut.any():
            break
        grid, scene = stacked(take(grid, cut).cut(SPLIT)), np.tile(scene[cut], 2)
    if len(done) == 1:
        return done[0]
    plan = stacked(done)
    return take(plan, np.lexsort((plan.layout.grid.starts, plan.layout.scene)))


def enough_before(share: FloatArray, scene: IntArray) -> BoolArray:
    """Return the panels that are not needed, since those before them in their scene, with their
    `share` (panels,) of the requested cycles, hold all of these."""
    before = np.concatenate([[0.0], np.cumsum(np.minimum(share, 1.0))[:-1]])
    first = np.searchsorted(scene, scene)  # the first panel of the scene of each
    return np.asarray(before - before[first] >= 1.0)


def before_the_first(bad: BoolArray, scene: IntArray) -> BoolArray:
    """Return the panels before the first `bad` one (panels,) of their scene."""
    so_far: IntArray = np.cumsum(bad)
    first = np.searchsorted(scene, scene)  # the first panel of the scene of each
    before = so_far[first] - bad[first].astype(int)
    return np.asarray(so_far == before)
