"""The cycle count with loss of contact: from one grazing wear to the next, and to the last.

Between two grazing wears (`wear.loss_of_contact.grazing`) the increments of a cycle are series
(`wear.loss_of_contact.increments`), of which Abel's equation makes the count where cycles are many
(`wear.loss_of_contact.stretch`); the few cycles next to a grazing wear are taken one by one, from
the series as long as they do not pass it. The cycles that pass, and the last ones before wear
stops, are integrated by themselves: where they begin is guessed for the whole way ahead, so that
all are integrated at once, and the next guess is better as in Newton's method.
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from copy import copy
from typing import NamedTuple

import numpy as np

from wear.counted import FADES, STOPS, End
from wear.counted import Counted as CountedCycles
from wear.load import Load
from wear.loss_of_contact.arrest import TabulatedCount, Unresolved
from wear.loss_of_contact.grazing import limit_wear_of
from wear.loss_of_contact.increments import Increments, fitted
from wear.loss_of_contact.parts import Counted, Judged, OneByOne, Part, judged, walked
from wear.loss_of_contact.period_map import switched_period_map
from wear.loss_of_contact.plan import GRAIN, SHIFT, Problem, planned, problem_of
from wear.loss_of_contact.requests import (
    ALONG,
    COARSE,
    FINE,
    SOLVED,
    Answers,
    Asking,
    Request,
    answered,
    cycles_by,
    frozen_cycles,
    without_feedback,
)
from wear.loss_of_contact.samples import Samples
from wear.loss_of_contact.stretch import OnPanels, Stretch, passed, stretches
from wear.loss_of_contact.switching import Edge
from wear.model import Model
from wear.numerics.tolerances import ROUNDOFF, TINY
from wear.orbit.iterates import Iterates
from wear.orbit.period_map import settings
from wear.orbit.problem import Cost
from wear.orbit.segments import Orbit, Segment

FEW = 4.0  # cycles to the next grazing wear: they are integrated
KEPT = 5  # cycles integrated one by one even when there is no time left
MOST_SINGLE = 2000  # cycles integrated one by one: then the count ends
APART = 1e-9  # of roughness and wear: a small difference
MOST_AT_ONCE = 1000
VIOLENT = 0.5  # of the wear and its scale: increments that have no series
JUDGED = 1e-2  # of the tolerance of a cycle: that of the cycle that judges it
MOST_GUESSES = 10  # one after the other
MOST_SAMPLES = 64  # cycles of a scene that are integrated at once
_FIRST = np.zeros(1, dtype=np.intp)  # scene
COEFFICIENTS, FEWER_COEFFICIENTS = 32, 24  # of a panel of increments, for many and for few digits


class Wanted(NamedTuple):
    """A scene's model under a load that repeats, and its edge of contact, of which `cycles` are to
    be counted from the wear `start` (mm), known up to `start_error`."""

    model: Model
    load: Load
    edge: Edge
    cycles: float
    start: float = 0.0
    start_error: float = 0.0


@np.errstate(all="ignore")
def counted_stages(
    wanted: Sequence[Wanted], rtol: float, deadline: float = np.inf
) -> list[CountedCycles]:
    """Count the cycles of scenes of one variant, or until wear ends.

    After the `deadline` (`time.monotonic()`) a few cycles are integrated at most.
    """
    models, loads = [each.model for each in wanted], [each.load for each in wanted]
    edges = [each.edge for each in wanted]
    size = settings(rtol)
    coarse = switched_period_map(models, loads, edges, size.phase_nodes, size.endpoint_tolerance)
    finer = max(ROUNDOFF, JUDGED * size.endpoint_tolerance)
    fine = switched_period_map(models, loads, edges, size.finer_nodes, finer)
    counts = [_count(each, rtol, deadline) for each in wanted]
    answers: list[Answers] = [frozen_cycles(coarse), _ways, _stretches]
    answers += [cycles_by(coarse), cycles_by(fine)]
    ways = answered(counts, answers)
    parts = [part for way in ways for part in way.parts]
    scene = np.repeat(np.arange(len(ways)), [len(way.parts) for way in ways])
    found = iter(judged(parts, scene, [way.problem for way in ways], coarse.cycles))
    return [
        _segments(way, [next(found) for _ in way.parts], each)
        for way, each in zip(ways, wanted, strict=True)
    ]


def _ways(_: list[int], ways: list[tuple[OnPanels, float]]) -> list[tuple[float, float]]:
    return passed(ways)


def _stretches(
    _: list[int], known: list[tuple[list[Increments], Problem]]
) -> Iterator[list[Stretch]]:
    found = iter(stretches([(series, problem) for some, problem in known for series in some]))
    return ([next(found) for _ in some] for some, _ in known)


def _count(wanted: Wanted, rtol: float, deadline: float) -> Asking[_Way]:
    problem = yield from problem_of(wanted.model, wanted.load, wanted.edge, rtol, deadline)
    way = _Way(problem, wanted.start)
    while way.goes_on(wanted.cycles):
        yield from way.go(max(wanted.cycles - way.done, 1.0))
    yield from _judge(way)
    return way


class _Way:
    """The way of a count: `parts`, one after the other, `done` cycles in all, and the `wear` (mm)
    so far. It goes along `stretches` on which the increments are known, and between them by
    `samples`: those are asked for where the way is likely to lead, all at once."""

    def __init__(self, problem: Problem, start: float) -> None:
        self.problem, self.wear, self.done = problem, start, 0.0
        self.over = self.arrested = self.fades = False
        self.parts: list[Part] = []
        self.stretches: list[Stretch] = []
        self.planned_to = start
        self.samples = Samples()
        self.last_added = 0.0
        self.singles = 0
        self.ahead_of: list[float] | None = None
        self.cost = Cost(0, 0)

    def goes_on(self, cycles: float) -> bool:
        """Return whether some of so many cycles are still wanted."""
        return not self.over and (self.done < cycles or not self.parts)

    def go(self, cycles: float) -> Asking[None]:
        """Go on for so many `cycles`, or less."""
        if self._lacks_a_plan(cycles):
            yield from self._plan(cycles)
        elif (yield from self._along(cycles)) or (yield from self._to_the_grazing_wear()):
            return
        elif not self._cycle():
            yield from self._ask(cycles)

    def _lacks_a_plan(self, cycles: float) -> bool:
        in_time = time.monotonic() <= self.problem.deadline
        return self.wear >= self.planned_to and cycles > FEW and in_time

    def _plan(self, cycles: float) -> Asking[None]:
        problem = self.problem
        added = yield from without_feedback(np.array([self.wear]))
        if added[0] > VIOLENT * (SHIFT * problem.scale + self.wear):
            self.stretches, self.planned_to = [], np.nextafter(self.wear, np.inf)
            return
        spans, self.planned_to = yield from planned(problem, self.wear, cycles)
        number = COEFFICIENTS if problem.rtol < 1e-8 else FEWER_COEFFICIENTS
        known, cost = yield from fitted(spans, number, problem.size.residual_tolerance / 2)
        self.cost = self.cost.plus(*cost)
        self.stretches = yield Request(SOLVED, (known, problem))

    def _along(self, cycles: float) -> Asking[bool]:
        """Go along a stretch on which the increments are known, if this is one."""
        for here in self.stretches:
            if here.series.span.start <= self.wear < here.series.span.end:
                z = float(here.series.span.coordinate.at(np.array(self.wear)))
                counted = here.counted
                if counted is not None and z < counted.first:
                    return self._walk(here, counted.first, cycles)
                some = yield from self._count(counted, z)
                return some or self._walk(here, here.end, cycles)
        return False

    def _count(self, counted: OnPanels | None, z: float) -> Asking[bool]:
        """Count by Abel's equation from z to the end of the panels, if there is a cycle to it."""
        if counted is None or not z < counted.last:
            return False
        ran, z_after = yield Request(ALONG, (counted, z))
        limit_wear = counted.limit_wear
        if ran < 1.0 and not limit_wear:
            return False
        if self.ahead_of is None:
            self.parts.append(Counted(counted, z, ran))
        wear = float(counted.series.coordinate.wear(np.array(z_after)))
        self.wear, self.done = limit_wear.wear if limit_wear else wear, self.done + ran
        self.over = self.arrested = self.fades = limit_wear is not None
        return True

    def _walk(self, here: Stretch, end: float, cycles: float) -> bool:
        """Go on cycle by cycle until z passes `end`."""
        most = min(cycles, MOST_AT_ONCE)
        if self.ahead_of is not None and not here.series.span.tends:
            *before, last = here.series.walk(self.wear, end, most)
            if before:
                self.wear, self.done = last, self.done + len(before)
                self.last_added = last - before[-1]
            return bool(before)
        found = walked(here.series, self.wear, end, most)
        if not found.added:
            return False
        if here.series.span.tends and end == here.end and len(found.wear) <= most:
            rest = here.series.span.end - found.wear[-1]
            ends = [found.wear[-1], here.series.span.end, here.series.span.end]
            found.extend(OneByOne(ends, [rest, 0.0], [0.0, 0.0], [0.0, 1.0]))
            self.over = self.arrested = self.fades = True
        self._append_cycles(found)
        return True

    def _to_the_grazing_wear(self) -> Asking[bool]:
        """Pass cycles that double precision does not resolve, next to a grazing wear."""
        ahead = self._grazing_wear()
        if ahead - self.wear > 2 * GRAIN * ROUNDOFF * ahead:
            return False
        # Contact shrinks like the root of what is left: twice the cycles at the present pace.
        rate = (yield from without_feedback(np.array([self.wear])))[0] + TINY
        left = np.floor(2 * (ahead - self.wear) / rate)
        if not FEW <= left < np.inf:
            return False
        part = np.array([[self.wear], [ahead], [left], [ahead - self.wear]])
        self.parts.append(Unresolved(*part))
        self.wear, self.done = ahead, self.done + float(left)
        return True

    def _grazing_wear(self) -> float:
        """Return the next one (mm), infinite if there is none."""
        behind = self.wear * (1 + 8 * ROUNDOFF)
        return min((stop.at for stop in self.problem.stops if stop.at > behind), default=np.inf)

    def _cycle(self) -> bool:
        """Add one cycle, if a sample is so near that it is known."""
        sample, limit = self.samples.at(self.wear, self.last_added), self.problem.limit_wear
        known = sample.off <= self.problem.size.endpoint_tolerance
        if self.ahead_of is None and not known:
            return False
        if self.ahead_of is not None and not known:
            self.ahead_of.append(self.wear)
        added = sample.added
        if not added > 0.0 and limit is not None and self.wear < limit.wear:
            added = limit.wear - self.wear  # nearer than rounding resolves
        self.singles += 1
        cycle = [self.wear, self.wear + added], [added], [np.nan], [abs(1.0 + sample.slope)]
        self._append_cycles(OneByOne(*cycle))
        self.arrested = not added > 0.0
        self.fades = self.arrested and limit is not None
        late = time.monotonic() > self.problem.deadline and self.singles >= KEPT
        failed = not sample.sound or not self.wear < self.problem.end
        self.over = self.arrested or failed or late or self.singles >= MOST_SINGLE
        return True

    def _ask(self, cycles: float) -> Asking[None]:
        """Integrate cycles here, and wherever the way may lead between stretches, twice each."""
        ahead = copy(self)
        ahead.parts, ahead.done, ahead.ahead_of = [], 0.0, []
        in_a_row = 0
        while ahead.goes_on(cycles) and len(ahead.ahead_of) < MOST_SAMPLES:
            left = cycles - ahead.done
            if ahead._lacks_a_plan(left) or in_a_row == MOST_GUESSES:
                break
            in_a_row = 0 if (yield from ahead._along(left)) else in_a_row + 1
            if in_a_row:
                ahead._cycle()
        wear = np.array(ahead.ahead_of)
        apart = APART * (4 * self.problem.scale + wear)
        run = yield Request(COARSE, np.concatenate([wear, wear + apart]))
        self.cost = self.cost.plus(2 * len(wear), run.evaluations)
        added, beside = np.split(run.increment, 2)
        slope, sound = (beside - added) / apart, run.converged[: len(wear)]
        self.samples.add(wear, added, slope, sound)

    def _append_cycles(self, cycles: OneByOne) -> None:
        if self.parts and isinstance(last := self.parts[-1], OneByOne):
            last.extend(cycles)
        else:
            self.parts.append(cycles)
        self.wear, self.done = cycles.wear[-1], self.done + len(cycles.added)
        self.last_added = cycles.added[-1]


def _segments(way: _Way, found: Sequence[Judged], wanted: Wanted) -> CountedCycles:
    """Return the parts of the way as segments, with what there is after its end."""
    problem, cycles = way.problem, wanted.cycles
    segments: list[Segment] = []
    begins, drift, one = 0.0, 0.0, np.zeros(1)
    inherited = one + wanted.start_error
    for counted in found:
        segments.append(Segment(_FIRST, counted, one + begins, inherited, one + drift))
        ran = counted.whole_cycles
        after, relative = counted.after(ran[None])
        inherited = after[0] * (relative[0] + inherited / (after[0] + TINY))
        begins += float(ran[0])
        drift += float(counted.reach[0]) if isinstance(counted, Unresolved) else 0.0
    end_of_wear: End | None = None
    limit = problem.limit_wear
    if not way.arrested and begins < cycles and limit is not None:
        # The count has ended before, but no wear is beyond the limit.
        left = max(limit.wear - way.wear, 0.0) + limit.uncertainty
        short = Unresolved(*(one + x for x in (way.wear, limit.wear, cycles - begins, left)))
        segments.append(Segment(_FIRST, short, one + begins, inherited, one + drift))
    if way.arrested and begins <= cycles:
        end_of_wear = _end(problem, segments, way.fades)
        rest = end_of_wear and _rest(problem, segments, end_of_wear)
        segments += [rest] if rest else []
    return CountedCycles(Orbit(1, tuple(segments), way.cost), end_of_wear)


def _judge(way: _Way) -> Asking[None]:
    """Judge the cycles that were integrated by another map."""
    todo = [
        (part, k)
        for part in way.parts
        if isinstance(part, OneByOne)
        for k, missed in enumerate(part.missed)
        if np.isnan(missed)
    ]
    if not todo:
        return
    at, added = np.array([(part.wear[k], part.added[k]) for part, k in todo]).T
    fine = yield Request(FINE, at)
    missed = np.abs(fine.increment - added) if fine.converged.all() else np.full(len(at), np.inf)
    for (part, k), found in zip(todo, missed.tolist(), strict=True):
        part.missed[k] = found
    way.cost = way.cost.plus(len(at), fine.evaluations)


def _end(problem: Problem, segments: list[Segment], fades: bool) -> End | None:
    """Return the cycle in which wear stops, if its error is known."""
    last = segments[-1]
    begins, counted = int(last.begins[0]), last.counted
    # A segment that begins at rest does not tell how long it took to get there.
    moving = [float(s.blur[0]) for s in segments if s.counted.first_increment[0] > 0]
    uncertainty = max([float(last.blur[0]), *moving[-1:]])
    if not np.isfinite(last.inherited[0] + uncertainty):
        return None
    if isinstance(counted, TabulatedCount):
        cycle = begins + int(counted.whole_cycles[0])
        return End(cycle, round(uncertainty + float(counted.count_error[-1])), FADES)
    if not isinstance(counted, Iterates) or not np.isfinite(counted.transient_error).all():
        return None
    cycle = begins + counted.first_idle_cycle
    # On springs the pressure vanishes with the distance that is left: no cycle is the last.
    fades |= problem.model.compliant and cycle > 0
    return End(cycle, round(uncertainty), FADES if fades else STOPS)


def _rest(problem: Problem, segments: list[Segment], end: End) -> Segment | None:
    """Return the cycles after the end, if the limit of the wear is known: to rounding, whatever the
    error of the cycles before."""
    wear = segments[-1].counted.last_state
    limit = limit_wear_of(problem.model, problem.load, float(wear[0]))
    if limit is None:
        return None
    none, begins = np.zeros(1), np.array([end.cycle + 2.0 * end.uncertain])
    rest = Unresolved(wear, wear, none, none + limit.uncertainty)
    return Segment(_FIRST, rest, begins, none, none)
