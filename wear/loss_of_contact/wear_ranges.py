"""Ranges of wear on which the increments are known, and the number of cycles on them.

The ranges of all scenes are sampled, solved and counted together, as arrays.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from wear.loss_of_contact.arrest import LimitWear
from wear.loss_of_contact.increments import (
    EASED,
    IncrementSeries,
    SeriesDomain,
    cut,
    fitted,
    increments,
    step,
)
from wear.loss_of_contact.period_map import SwitchedPeriodMap
from wear.loss_of_contact.plan import CountProblem
from wear.loss_of_contact.queries import BatchSolver
from wear.numerics.chebyshev import chebyshev_nodes
from wear.numerics.gauss import BoolArray, FloatArray, IntArray
from wear.numerics.rows import stacked, take
from wear.orbit import abel
from wear.orbit.iterates import CountTable, count_table
from wear.orbit.panels import CHECKS
from wear.orbit.period_map import MANY_DIGITS, Settings
from wear.orbit.problem import Cost

WIDEST = 12.0  # panel of a count to a limit wear, in ln z: derivatives are smooth on it
CALM = 24.0  # cycles that the distance to a grazing wear would last: then Abel's equation is solved
MOST_WALKED = 120  # cycles on a series that are taken one by one
SAMPLES, NEAR_END = 64, 32  # of a series, to estimate its number of cycles: equally far apart, and
# each at half the distance to the end; where wear runs away, most of its cycles lie there
MOST_CUTS = 16  # rounds of cutting panels in two
MOST_PANELS = 500  # of a series that are too coarse: then its increments are rounding errors
ENOUGH = 1.5  # cycles per coefficient of a panel
SAME = 1e-9  # relative difference of two z that are one
TOGETHER = 32  # series in one set of arrays
COEFFICIENTS, FEWER_COEFFICIENTS = 32, 24  # of a panel of increments, for many and for few digits
_FIRST, _LAST = slice(None, -1), slice(1, None)


class AbelSolution(NamedTuple):
    """The solution of Abel's equation: the `density` dn/dz with its `residual` on each panel, the
    `table` of n(z), and the `series` of the increments; it reaches to the `limit_wear`, if there is
    one."""

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

    def to_end(self, z: float) -> tuple[float, float]:
        """Return the number of whole cycles from z to the end of the panels, and z after them; up
        to rounding where wear tends to its limit there."""
        begin = float(self.table.cycles_at(np.array([z]))[0])
        remaining = self.table.last_cycles - begin
        cycles = math.floor(remaining) if self.limit_wear is None else math.ceil(remaining)
        after, _ = self.table.state_after(np.array([begin + cycles]))
        return float(cycles), float(after[0])


class WearRange(NamedTuple):
    """A range of wear on which the increments are known by their `series`, up to `end` in z; with
    the solution of Abel's equation, `abel`, if it takes many cycles."""

    series: IncrementSeries
    end: float
    abel: AbelSolution | None


def alike(panels: Mapping[int, abel.Density]) -> list[list[int]]:
    """Return the keys, grouped by the number of their panels."""
    kinds: dict[int, list[int]] = {}
    for i, (grid, _) in panels.items():
        kinds.setdefault(len(grid.c), []).append(i)
    return list(kinds.values())


def ranges_by(cycle: SwitchedPeriodMap) -> BatchSolver:
    """Return a solver for the ranges of wear on planned domains, with the cost of their cycles."""

    def answer(
        scenes: list[int], plans: list[tuple[list[SeriesDomain], CountProblem]]
    ) -> Iterator[tuple[list[WearRange], Cost]]:
        plan = np.repeat(np.arange(len(plans)), [len(domains) for domains, _ in plans])
        domains, problem = [domain for some, _ in plans for domain in some], plans[0][1]
        number = COEFFICIENTS if problem.rtol < MANY_DIGITS else FEWER_COEFFICIENTS
        tolerance = problem.size.residual_tolerance / 2
        fits, costs = fitted(domains, np.array(scenes)[plan], cycle, number, tolerance)
        known = [(fit, plans[i][1]) for i, some in zip(plan, fits, strict=True) for fit in some]
        found = [
            each
            for at in range(0, len(known), TOGETHER)
            for each in _together(known[at : at + TOGETHER])
        ]
        for i in range(len(plans)):
            own = [each for each, (_, of) in zip(found, known, strict=True) if of is plans[i][1]]
            cycles, evaluations = np.sum(costs[:, plan == i], axis=1)
            yield own, Cost(round(cycles), round(evaluations))

    return answer


def _together(fits: Sequence[tuple[IncrementSeries, CountProblem]]) -> list[WearRange]:
    """Return the ranges of wear of some series, each with its solution of Abel's equation if it
    takes many cycles, all at once."""
    every, size = [series for series, _ in fits], fits[0][1].size
    begin, end = np.array([series.domain.ends for series in every]).T
    samples, numbers, calm = _samples(every, begin, end)
    todo: dict[int, tuple[FloatArray, LimitWear | None]] = {}
    for i, (z, cycles, at) in enumerate(
        zip(samples, numbers, map(np.flatnonzero, calm), strict=True)
    ):
        number = float(np.sum(cycles[at[0] : at[-1]])) if len(at) else 0.0
        if number >= 2 * ENOUGH * size.panel_nodes and np.sum(cycles) >= MOST_WALKED:
            todo[i] = _edges(*fits[i], float(end[i]), z, cycles, at)
    densities = solved([every[i] for i in todo], [edges for edges, _ in todo.values()], size)
    known, solutions = dict(zip(todo, densities, strict=True)), dict[int, AbelSolution]()
    for group in alike({i: density for i, (density, _) in known.items()}):
        table = count_table(stacked([known[i][0] for i in group]), scenes=len(group))
        for i, own in zip(group, table.of_each(len(group)), strict=True):
            solutions[i] = AbelSolution(own, *known[i], every[i], todo[i][1])
    return [WearRange(series, float(end[i]), solutions.get(i)) for i, series in enumerate(every)]


def _samples(
    fits: Sequence[IncrementSeries], begin: FloatArray, end: FloatArray
) -> tuple[FloatArray, FloatArray, BoolArray]:
    """Return samples of z along each series (s, k), the approximate number of cycles between them
    (s, k - 1), and the samples at which the increments are small (s, k)."""
    shift = np.array([series.coordinate.shift for series in fits])
    whole = abel.grid(shift, begin, end)
    far = np.linspace(-1.0, 1.0, SAMPLES, endpoint=False)
    t = np.concatenate([far, 1.0 - (1.0 - far[-1]) * 0.5 ** np.arange(1, NEAR_END), [1.0]])
    samples = whole.states(t)
    cycles = (samples + shift[:, None]) / _steps(fits, np.arange(len(fits)), samples)  # per y
    return samples, (cycles[:, 1:] + cycles[:, :-1]) / 2 * np.diff(whole.y_at(t)), cycles >= CALM


def _steps(fits: Sequence[IncrementSeries], which: IntArray, z: FloatArray) -> FloatArray:
    """Return the increment of z in a cycle from each z (n, k), by the fits with the numbers `which`
    (n,)."""
    added = increments(fits, np.repeat(which, z.shape[1]), z.ravel()).reshape(z.shape)
    return step(np.array([series.coordinate.ahead for series in fits])[which, None], z, added)


def _edges(
    series: IncrementSeries,
    problem: CountProblem,
    end: float,
    samples: FloatArray,
    cycles: FloatArray,
    calm: IntArray,
) -> tuple[FloatArray, LimitWear | None]:
    """Return the ends in z of the panels on which Abel's equation is solved, and the limit wear if
    that is the last of them."""
    edges, fewest = samples[calm[[0, -1]]], ENOUGH * problem.size.panel_nodes
    to_limit = series.domain.tends and edges[1] >= end * (1 - SAME)
    limit_wear = problem.limit_wear if to_limit else None
    if limit_wear is not None:  # derivatives of cycles are known up to a distance
        known, number = 1.0 / limit_wear.nearest, np.sum(cycles[calm[0] : calm[-1]])
        before = np.sum(cycles[(samples[1:] <= known) & (samples[1:] > edges[0])])
        if fewest < before < number - fewest:
            pieces = math.ceil(math.log(known / edges[0]) / WIDEST)
            edges = np.append(np.geomspace(edges[0], known, pieces + 1), edges[1])
    return edges, limit_wear


def solved(
    fits: Sequence[IncrementSeries], edges: Sequence[FloatArray], size: Settings
) -> list[tuple[abel.Density, FloatArray]]:
    """Solve Abel's equation for some fits on panels between the `edges` of each in z, cut where
    needed; return also the residual off the nodes. Panels at the beginning that hold too few cycles
    to be cut are left out: those cycles are taken one by one."""
    if not fits:
        return []
    of, m = np.repeat(np.arange(len(fits)), [len(each) - 1 for each in edges]), size.panel_nodes
    coordinates = [(*series.coordinate,) for series in fits]
    origin, ahead, shift = np.array(coordinates).T
    begins, ends = (np.concatenate([each[part] for each in edges]) for part in (_FIRST, _LAST))
    grid = abel.grid(shift[of], begins, ends)
    done: list[tuple[IntArray, abel.Density, FloatArray, BoolArray]] = []
    for rounds in range(MOST_CUTS):
        z = grid.states(np.append(chebyshev_nodes(m), CHECKS))
        steps = _steps(fits, of, z)
        density = abel.solve(grid, steps[:, :m])
        residual = np.max(np.abs(abel.residual(density, CHECKS, steps[:, m:])), axis=1)
        eased = np.where(ahead[of] > 0.0, np.clip(origin[of] * grid.starts, 1.0, EASED), 1.0)
        coarse = ~(residual <= size.residual_tolerance * eased)
        cycles = grid.widths / 2 * np.mean(((z + shift[of, None]) / steps)[:, :m], axis=1)
        short = cycles <= ENOUGH * m
        again = coarse & ~short & (rounds < MOST_CUTS - 1)
        again &= np.bincount(of[again], minlength=len(fits))[of] <= MOST_PANELS
        done.append(take((of, density, residual, coarse & short), ~again))
        if not again.any():
            break
        grid, of = cut(take(grid, again)), np.tile(of[again], 2)
    of, density, residual, poor = stacked(done)
    order = np.lexsort((density.grid.starts, of))
    rows = np.split(order, np.flatnonzero(np.diff(of[order])) + 1)
    # All panels of a fit are kept if all are poor.
    return [take((density, residual), own[int(np.argmin(poor[own])) :]) for own in rows]
