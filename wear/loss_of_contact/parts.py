"""The parts of a count: cycles one by one, and those counted by Abel's equation."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from wear.loss_of_contact.arrest import TabulatedCount, Unresolved
from wear.loss_of_contact.increments import Increments, missed
from wear.loss_of_contact.plan import Problem
from wear.loss_of_contact.roundoff import Roundoff, roundoff
from wear.loss_of_contact.stretch import OnPanels, alike, tables
from wear.loss_of_contact.switching import Cycles
from wear.numerics.gauss import FloatArray, IntArray
from wear.numerics.rows import stacked
from wear.numerics.tolerances import ROUNDOFF, TINY
from wear.orbit.iterates import Cells, Iterates, joined
from wear.orbit.jobs import count_error
from wear.orbit.transient import SAFETY


class OneByOne(NamedTuple):
    """Cycles one by one: the `wear` (mm) before and after each, what each has `added` (mm), and its
    derivative `growth`, dP/du; `by` which series it was found, if by one, and what it may have
    `missed` (mm), no number where that is not known yet."""

    wear: list[float]
    added: list[float]
    growth: list[float]
    by: list[Increments | None]
    missed: list[float]

    @property
    def ends(self) -> FloatArray:
        """Return the wear (mm) where cycles begin and end."""
        return np.array(self.wear)

    def extend(self, more: OneByOne) -> None:
        """Add more cycles, from where these end."""
        self.wear.extend(more.wear[1:])
        self.added.extend(more.added)
        self.growth.extend(more.growth)
        self.by.extend(more.by)
        self.missed.extend(more.missed)

    def judged(self, problem: Problem, rounding: Roundoff) -> Iterates:
        """Return the cycles with their estimated error, by `rounding` at their ends, too."""
        wear, added, growth, lost = map(np.array, (*self[:3], self.missed))
        # The response to a relative error of the rate: what is made early grows, but once the wear
        # exceeds the roughness the rate hardly grows any more.
        response = added + np.minimum(added, 4 * problem.scale) * growth
        lost = SAFETY * lost + rounding.of_cycles * response
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


def walked(series: Increments, wear: float, end: float, most: float) -> OneByOne:
    """Return the cycles on a series from a `wear` (mm) until z passes `end`, or until there are
    `most`."""
    at = series.walk(wear, end, most)
    added = np.diff(at)
    growth = np.abs(1 + np.diff(added, append=added[-1:]) / (added + TINY))
    number = len(added)
    return OneByOne(at, added.tolist(), growth.tolist(), [series] * number, [np.nan] * number)


def judged(
    parts: Sequence[Part], scene: IntArray, problems: Sequence[Problem], cycles: Cycles
) -> list[Iterates | TabulatedCount | Unresolved]:
    """Return parts of the ways of some scenes, each with its estimated error; `cycles` has one of
    each scene."""
    _judge_by_series([part for part in parts if isinstance(part, OneByOne)])
    counts = [part for part in parts if isinstance(part, Counted)]
    found = tables([part.on.panels for part in counts], np.array([part.z for part in counts]))
    each = iter(found)
    ends = [next(each).bounds if isinstance(part, Counted) else part.ends for part in parts]
    for i, part in enumerate(parts):
        if isinstance(part, Counted):
            ends[i] = part.on.series.coordinate.wear(ends[i])
    rounding = roundoff(cycles.take(np.repeat(scene, list(map(len, ends)))), ends)
    rounded = [
        of.rate + of.contact
        for of, part in zip(rounding, parts, strict=True)
        if isinstance(part, Counted)
    ]
    tabulated = zip(counts, found, _errors(counts, found, rounded), strict=True)
    result: list[Iterates | TabulatedCount | Unresolved] = []
    for part, of, here in zip(parts, scene.tolist(), rounding, strict=True):
        if isinstance(part, OneByOne):
            result.append(part.judged(problems[of], here))
        elif isinstance(part, Counted):
            (on, _, ran), table, error = next(tabulated)
            limit = np.array([problems[of].end])
            own = on.series.coordinate, table, on.panels, error, on.limit_wear, limit, ran
            result.append(TabulatedCount(*own))
        else:
            result.append(part)
    return result


def _judge_by_series(parts: Sequence[OneByOne]) -> None:
    """Judge the cycles on series by what these miss."""
    places = [
        (part, k, series)
        for part in parts
        for k, series in enumerate(part.by)
        if series is not None and np.isnan(part.missed[k])
    ]
    if not places:
        return
    which = {id(series): series for _, _, series in places}
    number = {key: n for n, key in enumerate(which)}
    of = np.array([number[id(series)] for _, _, series in places])
    z = np.array([series.coordinate.at(np.array(part.wear[k])) for part, k, series in places])
    lost = missed(list(which.values()), of, z).tolist()
    for (part, k, _), relative in zip(places, lost, strict=True):
        part.missed[k] = relative * part.added[k]


def _errors(
    counts: Sequence[Counted], tables: Sequence[Cells], rounded: Sequence[FloatArray]
) -> list[FloatArray]:
    """Return the errors of counts, in cycles where their cells start and where the last one ends:
    of the increments, of Abel's equation, at junctions of panels, and what is `rounded`."""
    errors: dict[int, FloatArray] = {}
    for some in alike([part.on.panels for part in counts]):
        mine, table = [counts[i].on for i in some], joined([tables[i] for i in some])
        panels, residual = stacked([(on.panels, on.residual) for on in mine])
        rounding = np.stack([rounded[i] for i in some])
        error = count_error(panels, residual, table, rounding, len(some))
        ends = np.stack([tables[i].bounds for i in some])
        of = np.repeat(np.arange(len(some)), ends.shape[1])
        off = missed([on.series for on in mine], of, ends.ravel()).reshape(ends.shape)
        misfit = SAFETY * np.maximum(off[:, 1:], off[:, :-1]) * table.gain.reshape(len(some), -1)
        error[:, 1:] += np.cumsum(misfit, axis=1)
        errors |= zip(some, error, strict=True)
    return [errors[i] for i in range(len(counts))]
