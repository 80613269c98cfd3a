"""The parts of a count: cycles one by one, and panels on which Abel's equation is solved."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from wear.loss_of_contact.arrest import LimitWear, TabulatedCount
from wear.loss_of_contact.increments import EASED, Increments, cut
from wear.loss_of_contact.plan import Problem
from wear.loss_of_contact.roundoff import Roundoff
from wear.numerics.chebyshev import chebyshev_nodes
from wear.numerics.gauss import FloatArray
from wear.numerics.rows import stacked, take
from wear.numerics.tolerances import ROUNDOFF, TINY
from wear.orbit import abel
from wear.orbit.iterates import Cells, Iterates, cells
from wear.orbit.jobs import count_error
from wear.orbit.panels import CHECKS
from wear.orbit.period_map import Settings
from wear.orbit.transient import SAFETY

MOST_CUTS = 16  # rounds of cutting panels in two
ENOUGH = 1.5  # cycles per coefficient of a panel


class OneByOne(NamedTuple):
    """Cycles one by one: the `wear` (mm) before and after each, what each has `added` and may have
    `missed` (mm), and its derivative `growth`, dP/du; no number where those are not known yet."""

    wear: list[float]
    added: list[float]
    missed: list[float]
    growth: list[float]

    @property
    def ends(self) -> FloatArray:
        """Return the wear (mm) where cycles begin and end."""
        return np.array(self.wear)

    def judged(self, problem: Problem, rounding: Roundoff) -> Iterates:
        """Return the cycles with their estimated error, by `rounding` at their ends, too."""
        wear, added, missed, growth = map(np.array, self)
        # The response to a relative error of the rate: what is made early grows, but once the wear
        # exceeds the roughness the rate hardly grows any more.
        response = added + np.minimum(added, 4 * problem.scale) * growth
        lost = SAFETY * missed + rounding.of_cycles * response
        error = [0.0]
        for more, factor in zip(lost.tolist(), self.growth, strict=True):
            error.append(error[-1] * factor + more)
        estimate = np.array(error) + ROUNDOFF * wear
        one, limit = np.zeros((1, 1)), np.array([problem.end])
        return Iterates(wear[None], estimate[None], None, None, one, limit, one)


def walked(series: Increments, wear: float, end: float, most: float) -> OneByOne:
    """Return the cycles on a series from a `wear` (mm) until z passes `end`, or until there are
    `most`."""
    at = series.walk(wear, end, most)
    added = np.diff(at)
    missed = series.missed(series.coordinate.at(np.array(at[:-1]))) * added
    growth = np.abs(1 + np.diff(added, append=added[-1:]) / (added + TINY))
    return OneByOne(at, added.tolist(), missed.tolist(), growth.tolist())


class OnPanels(NamedTuple):
    """A count by Abel's equation on `panels` of z, with its `residual` on each and the `series` of
    the increments; to the `limit_wear`, if it goes so far."""

    table: Cells
    panels: abel.Panels
    residual: FloatArray
    series: Increments
    limit_wear: LimitWear | None

    @property
    def ran(self) -> float:
        """Return how many whole cycles."""
        last = self.table.last_cycles
        return float(np.ceil(last) if self.limit_wear else np.floor(last))

    @property
    def first(self) -> float:
        """Return the z at which it begins."""
        return float(self.panels.frame.starts[0])

    @property
    def last(self) -> float:
        """Return the z at which it ends."""
        return float(self.table.ends[-1])

    def beginning_at(self, z: float) -> OnPanels:
        """Return the count from z on."""
        return self._replace(table=cells(self.panels, start=z))

    def passed(self, z: float) -> tuple[float, float]:
        """Return how many whole cycles it counts from z on, and the z after them."""
        begin = self.table.cycles_until(np.array([z]))
        ran = np.floor(self.table.last_cycles - begin)
        after, _ = self.table.state_after(begin + ran)
        return float(ran[0]), float(after[0])

    @property
    def ends(self) -> FloatArray:
        """Return the wear (mm) where cells begin and end."""
        return self.series.coordinate.wear(np.append(self.table.u, self.last))

    def judged(self, problem: Problem, rounding: Roundoff) -> TabulatedCount:
        """Return the count with its estimated error: of the increments, of Abel's equation, at
        junctions of panels, by `rounding` at the ends of cells."""
        table, panels = self.table, self.panels
        coordinate = self.series.coordinate
        ends = self.series.missed(np.append(table.u, self.last))
        misfit = SAFETY * np.maximum(ends[1:], ends[:-1]) * table.gain
        rounded = (rounding.rate + rounding.contact)[None]
        error = count_error(panels, self.residual, table, rounded, 1)[0]
        error += np.concatenate([[0.0], np.cumsum(misfit)])
        limit = np.array([problem.end])
        return TabulatedCount(coordinate, table, panels, error, self.limit_wear, limit)


def solved(
    series: Increments, edges: FloatArray, size: Settings
) -> tuple[abel.Panels, FloatArray, bool]:
    """Solve Abel's equation on panels between values of z, cut where that is needed; return also
    the residual off the nodes, and whether it is poor on a panel that holds too few cycles to be
    cut."""
    coordinate, m = series.coordinate, size.panel_nodes
    frame = abel.frame(coordinate.shift, edges[:-1], edges[1:])
    done: list[tuple[abel.Panels, FloatArray]] = []
    poor = False
    for rounds in range(MOST_CUTS):
        nodes, checks = np.hsplit(frame.states(np.append(chebyshev_nodes(m), CHECKS)), [m])
        steps, more = (coordinate.step(z, series.at(z)) for z in (nodes, checks))
        panels = abel.solve(frame, steps)
        residual = np.max(np.abs(abel.residual(panels, CHECKS, more)), axis=1)
        allowed = np.full(len(residual), size.residual_tolerance)
        if coordinate.ahead:
            allowed *= np.clip(coordinate.origin * frame.starts, 1.0, EASED)
        number = frame.widths / 2 * np.mean((nodes + coordinate.shift) / steps, axis=1)
        short = number <= ENOUGH * m
        poor |= bool(np.any(~(residual <= allowed) & short))
        bad = ~(residual <= allowed) & ~short & (rounds < MOST_CUTS - 1)
        done.append(take((panels, residual), ~bad))
        if not bad.any():
            break
        frame = cut(take(frame, bad))
    every = stacked(done)
    return *take(every, np.argsort(every[0].frame.starts)), poor
