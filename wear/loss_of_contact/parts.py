"""The parts of a count: cycles one by one, and panels on which Abel's equation is solved."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from wear.loss_of_contact.arrest import LimitWear, TabulatedCount
from wear.loss_of_contact.increments import Increments, frame_of, middle
from wear.loss_of_contact.plan import Problem
from wear.loss_of_contact.roundoff import Roundoff
from wear.numerics.chebyshev import chebyshev_nodes, chebyshev_values
from wear.numerics.gauss import FloatArray
from wear.numerics.rows import take
from wear.numerics.tolerances import ROUNDOFF, TINY
from wear.orbit import abel
from wear.orbit.iterates import Cells, Iterates, cells
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
    line: bool

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
        parts = len(table.length) // len(panels.series)
        ends = self.series.missed(np.append(table.u, self.last))
        misfit = np.maximum(ends[1:], ends[:-1])
        if self.line:
            misfit[table.u >= self.series.frame.starts[-1]] = 0.0  # there the residual says it all
        missed = SAFETY * (np.repeat(self.residual, parts) + misfit) * table.gain + table.missed
        if len(panels.series) > 1:
            apart = abel.matching_defect(take(panels, slice(-1)), take(panels, slice(1, None)))
            missed[parts - 1 : -1 : parts] += SAFETY * apart
        terms = np.sum(np.abs(panels.series), axis=1)  # of the logarithm of the density
        of_density = ROUNDOFF * np.repeat(terms, parts)
        missed += (rounding.larger + of_density) * table.gain
        error = np.concatenate([[0.0], np.cumsum(missed)])
        limit = np.array([problem.end])
        return TabulatedCount(coordinate, table, panels, error, self.limit_wear, limit)


def solved(
    series: Increments, begin: float, end: float, size: Settings
) -> tuple[abel.Panels, FloatArray, bool]:
    """Solve Abel's equation from one z to another; return also the residual off the nodes, and
    whether it is poor on a panel that holds too few cycles to be cut."""
    coordinate, m = series.coordinate, size.panel_nodes
    shift = coordinate.shift
    starts, ends = np.array([begin]), np.array([end])
    done: list[tuple[float, float, FloatArray, float]] = []
    poor = False
    for rounds in range(MOST_CUTS):
        across = np.log1p((ends - starts) / (starts + shift))
        frame = frame_of(coordinate, starts, across)
        nodes = frame.states(chebyshev_nodes(m))
        steps = coordinate.step(nodes, series.at(nodes))
        panels = abel.solve(frame, steps)
        checks = frame.states(CHECKS)
        more = coordinate.step(checks, series.at(checks))
        residual = np.max(np.abs(abel.residual(panels, CHECKS, more)), axis=1)
        allowed = np.full(len(starts), size.residual_tolerance)
        if coordinate.ahead:
            allowed *= np.clip(coordinate.origin * starts, 1.0, 10.0)
        number = across / 2 * np.mean((nodes + shift) / steps, axis=1)
        short = number <= ENOUGH * m
        poor |= bool(np.any(~(residual <= allowed) & short))
        bad = ~(residual <= allowed) & ~short & (rounds < MOST_CUTS - 1)
        done += list(
            zip(starts[~bad], across[~bad], panels.series[~bad], residual[~bad], strict=True)
        )
        if not bad.any():
            break
        middles = np.array(
            [middle(shift, *ends_of) for ends_of in zip(starts[bad], ends[bad], strict=True)]
        )
        starts, ends = np.append(starts[bad], middles), np.append(middles, ends[bad])
    done.sort(key=lambda panel: float(panel[0]))
    starts, across, coefficients, residual = map(np.array, zip(*done, strict=True))
    return abel.Panels(frame_of(coordinate, starts, across), coefficients), residual, poor


def on_a_line(
    panels: abel.Panels, residual: FloatArray, series: Increments
) -> tuple[abel.Panels, FloatArray]:
    """Return the panels with one more, to the end of the series, on which the density dn/dy in
    y = ln z goes on as a power of z: 0, 1/2 or 1, as decay is geometric or algebraic. What the last
    e-fold differs from that by is its residual."""
    start, width = float(series.frame.starts[-1]), float(series.frame.widths[-1])
    last = float(panels.frame.widths[-1])
    t = np.array([1.0 - 2.0 * min(1.0, last) / last, 1.0])
    before, level = chebyshev_values(t, panels.series.shape[1]) @ panels.series[-1]
    found = 1.0 + (level - before) / min(1.0, last)
    slope = float(np.clip(np.round(2 * found) / 2, 0.0, 1.0))
    line = np.zeros((1, panels.series.shape[1]))
    line[0, :2] = level + (slope - 1) * width / 2, (slope - 1) * width / 2
    frame = panels.frame.with_panel(start, width)
    more = abel.Panels(frame, np.concatenate([panels.series, line]))
    return more, np.append(residual, abs(found - slope))
