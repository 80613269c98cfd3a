"""The parts of a count: single cycles, and cycle jumps by Abel's equation."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from wear.loss_of_contact.arrest import TabulatedIterates, UnresolvedIterates
from wear.loss_of_contact.increments import IncrementSeries, relative_error
from wear.loss_of_contact.plan import CountProblem
from wear.loss_of_contact.roundoff import Roundoff, roundoff
from wear.loss_of_contact.switching import Cycles
from wear.loss_of_contact.wear_ranges import AbelSolution, alike
from wear.numerics.floating_point import TINY
from wear.numerics.gauss import IntArray
from wear.numerics.rows import stacked
from wear.orbit.batches import count_error
from wear.orbit.iterates import Iterates, count_table
from wear.orbit.transient import SAFETY, Transient


class SingleCycles(NamedTuple):
    """Cycles one by one: the `wear` (mm) before and after each, its increment `added` (mm), the
    `local_error` of that (mm), NaN while unknown, and the derivative `growth`, dP/du."""

    wear: list[float]
    added: list[float]
    local_error: list[float]
    growth: list[float]

    def extend(self, more: SingleCycles) -> None:
        """Add more cycles, from where these end."""
        self.wear.extend(more.wear[1:])
        for own, fresh in zip(self[1:], more[1:], strict=True):
            own.extend(fresh)

    def with_error(self, problem: CountProblem, rounding: Roundoff) -> Iterates:
        """Return the cycles with their estimated error, which includes the `rounding` error."""
        wear, added, local_error, growth = (np.array([values]) for values in self)
        # An early error grows, but once the wear exceeds the roughness the rate hardly grows.
        response = added + np.minimum(added, 4 * problem.scale) * growth
        transient = Transient(wear, local_error, growth, response)
        error = transient.error(np.zeros(1), rounding.of_cycles[None])
        one, limit = np.zeros((1, 1)), np.array([problem.end])
        return Iterates(wear, error, None, None, one, limit, one)


class CycleJump(NamedTuple):
    """A jump over `cycles` from z on, by a `solution` of Abel's equation."""

    solution: AbelSolution
    z: float
    cycles: float


CountPart = SingleCycles | CycleJump | UnresolvedIterates
CountPartIterates = Iterates | TabulatedIterates | UnresolvedIterates


def walked(series: IncrementSeries, wear: float, end: float, most: float) -> SingleCycles:
    """Return the cycles on a series from a `wear` (mm) on, until z passes `end`, `most` at most."""
    at, error = series.walk(wear, end, most)
    added = np.diff(at)
    growth = np.abs(1 + np.diff(added, append=added[-1:]) / (added + TINY))
    return SingleCycles(at, added.tolist(), error, growth.tolist())


def with_error(
    parts: Sequence[CountPart], scene: IntArray, problems: Sequence[CountProblem], cycles: Cycles
) -> list[CountPartIterates]:
    """Return the iterates on parts of the counts of some scenes, with their estimated errors;
    `cycles` has one cycle of each scene."""
    single = {i: part for i, part in enumerate(parts) if isinstance(part, SingleCycles)}
    ends = [np.array(part.wear) for part in single.values()]
    rows = np.repeat(scene[list(single)], [len(wear) for wear in ends])
    rounding = roundoff(cycles.take(rows), ends)
    iterates: dict[int, CountPartIterates] = {
        i: part for i, part in enumerate(parts) if isinstance(part, UnresolvedIterates)
    }
    iterates |= {
        i: part.with_error(problems[scene[i]], here)
        for (i, part), here in zip(single.items(), rounding, strict=True)
    }
    jumps = {i: part for i, part in enumerate(parts) if isinstance(part, CycleJump)}
    for group in alike({i: jump.solution.density for i, jump in jumps.items()}):
        limits = [problems[of].end for of in scene[group].tolist()]
        tables = _tabulated([jumps[i] for i in group], cycles.take(scene[group]), limits)
        iterates |= zip(group, tables, strict=True)
    return [iterates[i] for i in range(len(parts))]


def _tabulated(
    jumps: Sequence[CycleJump], cycles: Cycles, limits: Sequence[float]
) -> list[TabulatedIterates]:
    """Return the iterates of cycle jumps on equally many panels each, with a cycle of each and the
    wear (mm) that limits it. Their error is that of the increments, of Abel's equation, where
    panels meet, and by rounding."""
    every = [jump.solution for jump in jumps]
    density, residual = stacked([(own.density, own.residual) for own in every])
    table = count_table(density, scenes=len(every), start=np.array([jump.z for jump in jumps]))
    tables = table.of_each(len(every))
    z = np.stack([own.bounds for own in tables])
    wear = [own.series.coordinate.wear(ends) for own, ends in zip(every, z, strict=True)]
    of = np.repeat(np.arange(len(every)), z.shape[1])
    rounding = roundoff(cycles.take(of), wear)
    rounded = np.stack([here.rate + here.contact for here in rounding])
    error = count_error(density, residual, table, rounded, len(every))
    at_ends = relative_error([own.series for own in every], of, z.ravel()).reshape(z.shape)
    misfit = (
        SAFETY * np.maximum(at_ends[:, 1:], at_ends[:, :-1]) * table.number.reshape(len(every), -1)
    )
    error[:, 1:] += np.cumsum(misfit, axis=1)
    return [
        TabulatedIterates(
            own.series, n, own.density, of_n, own.limit_wear, np.array([limit]), jump.cycles
        )
        for jump, own, n, of_n, limit in zip(jumps, every, tables, error, limits, strict=True)
    ]
