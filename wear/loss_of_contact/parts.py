"""The parts of a count: cycles one by one, and those counted by Abel's equation."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from wear.loss_of_contact.arrest import TabulatedCount, Unresolved
from wear.loss_of_contact.increments import Increments, missed
from wear.loss_of_contact.plan import Problem
from wear.loss_of_contact.roundoff import Roundoff, roundoff
from wear.loss_of_contact.stretch import OnPanels, alike
from wear.loss_of_contact.switching import Cycles
from wear.numerics.gauss import IntArray
from wear.numerics.rows import stacked
from wear.numerics.tolerances import ROUNDOFF, TINY
from wear.orbit.iterates import Iterates, cells
from wear.orbit.jobs import count_error
from wear.orbit.transient import SAFETY


class OneByOne(NamedTuple):
    """Cycles one by one: the `wear` (mm) before and after each, what each has `added` and may have
    `missed` (mm), no number where that is not known yet, and its derivative `growth`, dP/du."""

    wear: list[float]
    added: list[float]
    missed: list[float]
    growth: list[float]

    def extend(self, more: OneByOne) -> None:
        """Add more cycles, from where these end."""
        self.wear.extend(more.wear[1:])
        for own, fresh in zip(self[1:], more[1:], strict=True):
            own.extend(fresh)

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


class Counted(NamedTuple):
    """So many `cycles`, counted by Abel's equation `on` panels from z on."""

    on: OnPanels
    z: float
    cycles: float


Part = OneByOne | Counted | Unresolved
Judged = Iterates | TabulatedCount | Unresolved


def walked(series: Increments, wear: float, end: float, most: float) -> OneByOne:
    """Return the cycles on a series from a `wear` (mm) until z passes `end`, or until there are
    `most`."""
    at = series.walk(wear, end, most)
    added, z = np.diff(at), series.coordinate.at(np.array(at[:-1]))
    lost = missed([series], np.zeros(len(z), dtype=int), z) * added
    growth = np.abs(1 + np.diff(added, append=added[-1:]) / (added + TINY))
    return OneByOne(at, added.tolist(), lost.tolist(), growth.tolist())


def judged(
    parts: Sequence[Part], scene: IntArray, problems: Sequence[Problem], cycles: Cycles
) -> list[Judged]:
    """Return parts of the ways of some scenes, each with its estimated error; `cycles` has one of
    each scene."""
    single = {i: part for i, part in enumerate(parts) if isinstance(part, OneByOne)}
    ends = [np.array(part.wear) for part in single.values()]
    rows = np.repeat(scene[list(single)], [len(wear) for wear in ends])
    rounding = roundoff(cycles.take(rows), ends)
    found: dict[int, Judged] = {
        i: part for i, part in enumerate(parts) if isinstance(part, Unresolved)
    }
    found |= {
        i: part.judged(problems[scene[i]], here)
        for (i, part), here in zip(single.items(), rounding, strict=True)
    }
    counts = {i: part for i, part in enumerate(parts) if isinstance(part, Counted)}
    for some in alike({i: part.on.panels for i, part in counts.items()}):
        limits = [problems[of].end for of in scene[some].tolist()]
        alone = _tabulated([counts[i] for i in some], cycles.take(scene[some]), limits)
        found |= zip(some, alone, strict=True)
    return [found[i] for i in range(len(parts))]


def _tabulated(
    counts: Sequence[Counted], cycles: Cycles, limits: Sequence[float]
) -> list[TabulatedCount]:
    """Return counts on as many panels each, with a cycle of each and the wear (mm) that limits it;
    the error is that of the increments, of Abel's equation, at junctions of panels, by rounding at
    the ends of cells."""
    every = [part.on for part in counts]
    panels, residual = stacked([(on.panels, on.residual) for on in every])
    table = cells(panels, scenes=len(every), start=np.array([part.z for part in counts]))
    each = table.parts(len(every))
    z = np.stack([own.bounds for own in each])
    wear = [on.series.coordinate.wear(ends) for on, ends in zip(every, z, strict=True)]
    of = np.repeat(np.arange(len(every)), z.shape[1])
    rounding = roundoff(cycles.take(of), wear)
    rounded = np.stack([here.rate + here.contact for here in rounding])
    error = count_error(panels, residual, table, rounded, len(every))
    off = missed([on.series for on in every], of, z.ravel()).reshape(z.shape)
    misfit = SAFETY * np.maximum(off[:, 1:], off[:, :-1]) * table.gain.reshape(len(every), -1)
    error[:, 1:] += np.cumsum(misfit, axis=1)
    return [
        TabulatedCount(
            on.series.coordinate,
            own,
            on.panels,
            lost,
            on.limit_wear,
            np.array([limit]),
            part.cycles,
        )
        for part, on, own, lost, limit in zip(counts, every, each, error, limits, strict=True)
    ]
