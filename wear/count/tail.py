"""Wear that tends to its rest and never gets there: the count over the distance that is left.

At a sharp peak of the load contact lasts in proportion to the distance d = rest - u, and each cycle
takes the same part of it. On a compliant support the pressure vanishes along with the distance, and
each cycle takes a part d^(1/2) or d of it, as the peak is smooth or sharp. In all cases the
logarithm of the density dn/dy in y = -ln d tends to a straight line, of slope 0, 1/2 or 1. Abel's
equation is solved in y as far as double precision tells d; beyond, the line goes on.
"""

from typing import NamedTuple

import numpy as np

from wear.count import abel, tabulated
from wear.count.checks import CHECKS
from wear.count.cycle import Cost, OneCycle, Settings
from wear.count.panels import NONE, SAFETY, Maps, Solved
from wear.count.rounding import roundoff
from wear.load import Load
from wear.model import Model
from wear.numerics.chebyshev import (
    chebyshev_nodes,
    chebyshev_values,
)
from wear.numerics.gauss import (
    FloatArray,
)
from wear.numerics.tolerances import (
    ROUNDOFF,
)

CALM = 0.25  # of the distance that a cycle takes at most, for a panel to hold enough cycles
WIDEST = 5.0  # panel, in y: the rounding of small distances must not reach large ones
TOLD = 1e6  # times the uncertainty of the rest: the smallest distance at which cycles are counted
GRAIN = 16.0  # times its uncertainty: what rounding leaves of a distance
HALVINGS = 60
MOST_ROUNDS = 6  # of cutting panels
TO_ROUNDOFF = 0.25 * ROUNDOFF  # of the wear: the distance at which the count ends


class Rest(NamedTuple):
    """The `wear` (mm) at which the peak of the load just fails to make contact, known give or take
    `blur` (mm)."""

    wear: float
    blur: float

    @property
    def nearest(self) -> float:
        """The smallest distance (mm) from it at which a cycle tells anything."""
        return TOLD * self.blur


class Tail(NamedTuple):
    """The count n of cycles as a function of 1/d, in 1/mm, d the distance from the `rest`; its
    estimated error in cycles where each part of the `table` starts and where the last one ends."""

    rest: Rest
    table: tabulated.Count
    count_error: FloatArray
    cost: Cost

    @property
    def limit(self) -> float:
        """No wear (mm) on the way there is without meaning."""
        return np.inf

    @property
    def rests(self) -> bool:
        """Its last cycle adds nothing that can be told."""
        return True

    @property
    def pace(self) -> float:
        """The wear (mm) that its first cycle adds."""
        return float(tabulated.first_pace(self.table)[0] / self.table.wear[0] ** 2)

    @property
    def last_wear(self) -> float:
        """The wear (mm) up to which it counts."""
        return self.rest.wear

    @property
    def reach(self) -> float:
        """The cycles after which the wear is its rest, as far as double precision tells."""
        return self.table.last_cycles

    @property
    def blur(self) -> float:
        """By how many cycles that may be out."""
        return float(self.count_error[-1])

    def wear_after(self, cycles: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Wear (mm) after `cycles`, and its estimated relative error."""
        inverse, pace = tabulated.wear_after(self.table, cycles)
        ends = np.append(self.table.cycles, self.table.last_cycles)
        distance = np.where(cycles < self.reach, 1 / inverse, 0.0)
        missed = pace * np.interp(cycles, ends, self.count_error) * distance  # relative, of d
        error = self.rest.blur + np.minimum(missed, 1.0) / inverse
        wear = self.rest.wear - distance
        return wear, error / wear

    def cycles_until(self, wear: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Whole cycles after which each wear (mm) is reached, infinite from the rest on, and the
        error of the count in cycles."""
        distance = self.rest.wear - wear
        ahead = distance > TO_ROUNDOFF * self.rest.wear
        count, error = np.full(wear.shape, np.inf), np.zeros(wear.shape)
        inverse = np.minimum(1 / distance[ahead], self.table.last_wear)
        found = tabulated.cycles_until(self.table, inverse)
        _, pace = tabulated.wear_after(self.table, found)
        ends = np.append(self.table.cycles, self.table.last_cycles)
        count[ahead] = np.ceil(found)
        error[ahead] = np.interp(found, ends, self.count_error)
        error[ahead] += self.rest.blur * inverse**2 / pace
        return count, error


def begins_at(cycle: OneCycle, rest: Rest, wear: float) -> float:
    """The wear (mm) from which on a tail may be counted, `wear` or beyond: where a cycle takes a
    small part of the distance, or else where the distance is the smallest that tells anything."""
    distance: FloatArray = np.ldexp(rest.wear - wear, -np.arange(HALVINGS))
    distance = np.append(distance[distance > rest.nearest], rest.nearest)
    calm = cycle.advance(rest.wear - distance).increment < CALM * distance
    return rest.wear - float(distance[np.argmax(calm) if calm.any() else -1])


def tail(
    both: Maps, model: Model, load: Load, rest: Rest, wear: float, size: Settings
) -> Tail | None:
    """Count from `wear` (mm) towards the rest; None if a cycle could not be solved on the way."""
    distance = rest.wear - wear
    number = int(np.ceil(np.log(distance / rest.nearest) / WIDEST))
    ends = np.geomspace(1 / distance, 1 / rest.nearest, max(number, 0) + 1)
    solved, cost = _solved(both, rest, ends[:-1], ends[1:], size)
    line, bend = _line(both.coarse, rest, solved, min(distance, rest.nearest))
    if not np.isfinite(bend):
        return None
    panels = _joined(solved, line)
    table = tabulated.count(panels, 0.0)
    parts = len(table.length) // len(panels.starts)
    missed = SAFETY * np.repeat(np.append(solved.residual, bend), parts) * table.gain
    apart = abel.junctions(panels.take(slice(-1)), panels.take(slice(1, None)))
    missed[parts - 1 : -1 : parts] += SAFETY * apart
    missed += float(roundoff(model, load, np.array([wear]))[0]) * table.gain
    return Tail(rest, table, np.concatenate([[0.0], np.cumsum(missed)]), cost)


def _solved(
    both: Maps, rest: Rest, starts: FloatArray, ends: FloatArray, size: Settings
) -> tuple[Solved, Cost]:
    """Abel's equation on panels of 1/d, cut in two until it holds off the nodes as well."""
    done = Solved(NONE, NONE, np.empty((0, size.panel_nodes)), NONE, NONE, NONE)
    cost = Cost(0, 0)
    for rounds in range(MOST_ROUNDS if len(starts) else 0):
        across = np.log(ends / starts)
        nodes = abel.panel_wear(0.0, starts, across, chebyshev_nodes(size.panel_nodes))
        steps, evaluations = _steps(both.coarse, rest, nodes)
        panels = abel.solve(0.0, starts, across, steps)
        checks = abel.panel_wear(0.0, starts, across, CHECKS)
        judged, more = _steps(both.fine, rest, checks)
        cost = cost.plus(nodes.size + checks.size, evaluations + more)
        residual = np.max(np.abs(abel.residual(panels, CHECKS, judged)), axis=1)
        cycles = across * np.mean(nodes / steps, axis=1)
        fresh = Solved(starts, ends, panels.series, residual, np.full(len(starts), 0.5), cycles / 2)
        rough = ~(residual <= size.residual_tolerance + GRAIN * rest.blur * ends)
        rough &= fresh.if_cut > size.panel_nodes
        if not rough.any() or rounds == MOST_ROUNDS - 1:
            done = done.joined(fresh)
            break
        done = done.joined(fresh.where(~rough))
        middles = np.sqrt(starts * ends)[rough]
        starts, ends = np.append(starts[rough], middles), np.append(middles, ends[rough])
    return done, cost


def _steps(cycle: OneCycle, rest: Rest, inverse: FloatArray) -> tuple[FloatArray, int]:
    """By how much a cycle increases 1/d, from each `inverse` distance (1/mm)."""
    run = cycle.advance(rest.wear - 1 / inverse)
    taken = inverse * run.increment
    steps: FloatArray = inverse * taken / (1 - taken)
    return (steps if run.converged.all() else np.full_like(steps, np.nan)), run.evaluations


def _line(
    cycle: OneCycle, rest: Rest, solved: Solved, distance: float
) -> tuple[abel.Panels, float]:
    """The straight line that ln(dn/dy) follows from `distance` (mm) on, as a panel, and by how much
    the density may deviate from it: by as much as it did over the last e-fold, at most."""
    at = np.array([1.0, np.e]) / distance / np.e
    if len(solved.starts):
        last = solved.panels(0.0).take(slice(-1, None))
        t = 1 - 2 / last.widths * np.array([1.0, 0.0])
        before, level = chebyshev_values(t, last.series.shape[1]) @ last.series[0] + np.log(at)
    else:
        steps, _ = _steps(cycle, rest, at)
        before, level = -np.log(np.log1p(steps / at))
    slope = np.clip(np.round(2 * (level - before)) / 2, 0.0, 1.0)
    width = np.log(distance / (TO_ROUNDOFF * rest.wear))
    series = np.zeros((1, max(2, solved.series.shape[1])))
    # The series is that of ln(dn/dU), U = 1/d.
    series[0, :2] = level + np.log(distance) + (slope - 1) * width / 2, (slope - 1) * width / 2
    panel = abel.Panels(0.0, np.array([1 / distance]), np.array([width]), series)
    return panel, float(abs(level - before - slope))


def _joined(solved: Solved, line: abel.Panels) -> abel.Panels:
    """The panels solved, and the line beyond."""
    panels = solved.panels(0.0)
    return abel.Panels(
        0.0,
        np.append(panels.starts, line.starts),
        np.append(panels.widths, line.widths),
        np.concatenate([panels.series, line.series]),
    )
