"""Ranges of wear on which the increments are known, and the number of cycles on them.

The ranges of all scenes are sampled, solved and counted together, as arrays.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from wear.loss_of_contact.arrest import LimitWear
from wear.loss_of_contact.increments import EASED, IncrementSeries, cut, increments, step
from wear.loss_of_contact.plan import CountProblem
from wear.numerics.chebyshev import chebyshev_nodes
from wear.numerics.gauss import BoolArray, FloatArray, IntArray
from wear.numerics.rows import stacked, take
from wear.orbit import abel
from wear.orbit.iterates import CountTable, cell_of, count_table, joined
from wear.orbit.panels import CHECKS
from wear.orbit.period_map import Settings

WIDEST = 12.0  # panel of a count to a limit wear, in ln z: derivatives are smooth on it
CALM = 24.0  # cycles that the distance to a grazing wear would last: then Abel's equation is solved
MOST_WALKED = 120  # cycles on a series that are taken one by one
SAMPLES = 65  # of a series, to estimate its number of cycles
MOST_CUTS = 16  # rounds of cutting panels in two
ENOUGH = 1.5  # cycles per coefficient of a panel
TOGETHER = 32  # series in one set of arrays
_FIRST, _LAST = slice(None, -1), slice(1, None)


class AbelSolution(NamedTuple):
    """The solution of Abel's equation on `panels` of z, with its `residual` on each, the `table` of
    n(z) and the `series` of the increments; it reaches to the `limit_wear`, if there is one."""

    table: CountTable
    density: abel.Density
    residual: FloatArray
    series: IncrementSeries
    limit_wear: LimitWear | None

    @property
    def first(self) -> float:
        """Return the first z."""
        return float(self.density.grid.starts[0])

    @property
    def last(self) -> float:
        """Return the last z."""
        return float(self.table.ends[-1])


class WearRange(NamedTuple):
    """A range of wear on which the increments are known by their `series`, up to `end` in z; with
    the solution of Abel's equation, `abel`, if it takes many cycles."""

    series: IncrementSeries
    end: float
    abel: AbelSolution | None


def cycles_to_end(starts: Sequence[tuple[AbelSolution, float]]) -> list[tuple[float, float]]:
    """Return the number of whole cycles from each z to the end of its panels, and the z after them;
    up to rounding where wear tends to its limit there."""
    counts, z = [count for count, _ in starts], np.array([z for _, z in starts])
    tables = [count.table for count in counts]
    table, first = joined(tables), np.cumsum([0, *(len(own.u) for own in tables[:-1])])
    inside = [cell_of(own.u, at) for own, at in zip(tables, z, strict=True)]
    begin = table.cycles_at(z, first + inside)
    remaining = np.array([own.last_cycles for own in tables]) - begin
    to_limit = np.array([count.limit_wear is not None for count in counts])
    cycles = np.where(to_limit, np.ceil(remaining), np.floor(remaining))
    inside = [cell_of(own.cycles, n) for own, n in zip(tables, begin + cycles, strict=True)]
    after, _ = table.state_after(begin + cycles, first + inside)
    return list(zip(cycles.tolist(), after.tolist(), strict=True))


def alike(panels: Mapping[int, abel.Density]) -> list[list[int]]:
    """Return groups of the keys whose panels are of one kind, and equally many."""
    kinds: dict[object, list[int]] = {}
    for i, (grid, _) in panels.items():
        kinds.setdefault((grid.c.any(), len(grid.c)), []).append(i)
    return list(kinds.values())


def wear_ranges(known: Sequence[tuple[IncrementSeries, CountProblem]]) -> list[WearRange]:
    """Return the wear_ranges of some series, with their solutions of Abel's equation if cycles are
    many."""
    found: dict[int, WearRange] = {}
    for shifted in (False, True):
        kind = [i for i, (each, _) in enumerate(known) if (each.coordinate.shift > 0.0) == shifted]
        for at in range(0, len(kind), TOGETHER):
            some = kind[at : at + TOGETHER]
            found |= zip(some, _together([known[i] for i in some]), strict=True)
    return [found[i] for i in range(len(known))]


def _together(known: Sequence[tuple[IncrementSeries, CountProblem]]) -> list[WearRange]:
    """Return the wear_ranges of series of one kind, all at once."""
    every, size = [series for series, _ in known], known[0][1].size
    begin, end = np.array([series.domain.ends for series in every]).T
    samples, gains, calm = _samples(every, begin, end)
    wanted: dict[int, tuple[FloatArray, LimitWear | None]] = {}
    for i, (z, gain, at) in enumerate(zip(samples, gains, map(np.flatnonzero, calm), strict=True)):
        number = float(np.sum(gain[at[0] : at[-1]])) if len(at) else 0.0
        if number >= 2 * ENOUGH * size.panel_nodes and np.sum(gain) >= MOST_WALKED:
            wanted[i] = _edges(*known[i], float(end[i]), z, gain, at)
    found = solved([every[i] for i in wanted], [edges for edges, _ in wanted.values()], size)
    solutions, counts = dict(zip(wanted, found, strict=True)), dict[int, AbelSolution]()
    for some in alike({i: panels for i, (panels, _) in solutions.items()}):
        table = count_table(stacked([solutions[i][0] for i in some]), scenes=len(some))
        for i, own in zip(some, table.of_each(len(some)), strict=True):
            counts[i] = AbelSolution(own, *solutions[i], every[i], wanted[i][1])
    return [WearRange(series, float(end[i]), counts.get(i)) for i, series in enumerate(every)]


def _samples(
    known: Sequence[IncrementSeries], begin: FloatArray, end: FloatArray
) -> tuple[FloatArray, FloatArray, BoolArray]:
    """Return samples of z along each series (s, k), the approximate number of cycles between them
    (s, k - 1), and the samples at which the increments are small (s, k)."""
    shift = np.array([series.coordinate.shift for series in known])
    whole = abel.grid(shift, begin, end)
    t = np.linspace(-1.0, 1.0, SAMPLES)
    samples = whole.states(t)
    lasts = (samples + shift[:, None]) / _steps(known, np.arange(len(known)), samples)
    gains = (lasts[:, 1:] + lasts[:, :-1]) / 2 * np.diff(whole.y_at(t))
    return samples, gains, lasts >= CALM


def _steps(known: Sequence[IncrementSeries], of: IntArray, z: FloatArray) -> FloatArray:
    """Return the increment of z in a cycle from each z (n, k), by the series with the numbers `of`
    (n,)."""
    added = increments(known, np.repeat(of, z.shape[1]), z.ravel()).reshape(z.shape)
    return step(np.array([series.coordinate.ahead for series in known])[of, None], z, added)


def _edges(
    series: IncrementSeries,
    problem: CountProblem,
    end: float,
    samples: FloatArray,
    gains: FloatArray,
    calm: IntArray,
) -> tuple[FloatArray, LimitWear | None]:
    """Return the ends in z of the panels on which Abel's equation is solved, and the limit wear if
    that is the last of them."""
    edges, fewest = samples[calm[[0, -1]]], ENOUGH * problem.size.panel_nodes
    to_limit = series.domain.tends and edges[1] >= end * (1 - 1e-9)
    limit_wear = problem.limit_wear if to_limit else None
    if limit_wear is not None:  # derivatives of cycles are known up to a distance
        known, number = 1.0 / limit_wear.nearest, np.sum(gains[calm[0] : calm[-1]])
        before = np.sum(gains[(samples[1:] <= known) & (samples[1:] > edges[0])])
        if fewest < before < number - fewest:
            pieces = math.ceil(math.log(known / edges[0]) / WIDEST)
            edges = np.append(np.geomspace(edges[0], known, pieces + 1), edges[1])
    return edges, limit_wear


def solved(
    known: Sequence[IncrementSeries], edges: Sequence[FloatArray], size: Settings
) -> list[tuple[abel.Density, FloatArray]]:
    """Solve Abel's equation for some series on panels between values of z, cut where that is
    needed; return also the residual off the nodes. Panels at the beginning that hold too few cycles
    to be cut are left out: those cycles are taken one by one."""
    if not known:
        return []
    of, m = np.repeat(np.arange(len(known)), [len(each) - 1 for each in edges]), size.panel_nodes
    coordinates = [(*series.coordinate,) for series in known]
    origin, ahead, shift = np.array(coordinates).T
    begins, ends = (np.concatenate([each[part] for each in edges]) for part in (_FIRST, _LAST))
    grid = abel.grid(shift[of], begins, ends)
    done: list[tuple[IntArray, abel.Density, FloatArray, BoolArray]] = []
    for rounds in range(MOST_CUTS):
        z = grid.states(np.append(chebyshev_nodes(m), CHECKS))
        steps = _steps(known, of, z)
        panels = abel.solve(grid, steps[:, :m])
        residual = np.max(np.abs(abel.residual(panels, CHECKS, steps[:, m:])), axis=1)
        eased = np.where(ahead[of] > 0.0, np.clip(origin[of] * grid.starts, 1.0, EASED), 1.0)
        coarse = ~(residual <= size.residual_tolerance * eased)
        cycles = grid.widths / 2 * np.mean(((z + shift[of, None]) / steps)[:, :m], axis=1)
        short = cycles <= ENOUGH * m
        again = coarse & ~short & (rounds < MOST_CUTS - 1)
        done.append(take((of, panels, residual, coarse & short), ~again))
        if not again.any():
            break
        grid, of = cut(take(grid, again)), np.tile(of[again], 2)
    of, panels, residual, poor = stacked(done)
    order = np.lexsort((panels.grid.starts, of))
    rows = np.split(order, np.flatnonzero(np.diff(of[order])) + 1)
    # All of them are kept if all are poor.
    return [take((panels, residual), own[int(np.argmin(poor[own])) :]) for own in rows]
