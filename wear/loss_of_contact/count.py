"""The cycle count with loss of contact: from one grazing wear to the next, and to the last.

Between two grazing wears (`wear.loss_of_contact.grazing`) the increments of a cycle are series
(`wear.loss_of_contact.increments`); where cycles are many, Abel's equation counts them
(`wear.loss_of_contact.wear_ranges`). The few cycles next to a grazing wear are taken one by one, by
the series as long as they do not pass it. The cycles that pass it, and the last ones before wear
stops, are integrated: their initial wears are predicted all the way ahead, so that they are
integrated at once, and corrected as in Newton's method.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from copy import copy
from typing import NamedTuple

import numpy as np

from wear.load import Load
from wear.loss_of_contact.arrest import TabulatedIterates, UnresolvedIterates
from wear.loss_of_contact.cycle_jumps import (
    CountPart,
    CountPartIterates,
    CycleJump,
    SingleCycles,
    walked,
    with_error,
)
from wear.loss_of_contact.grazing import limit_wear_of
from wear.loss_of_contact.period_map import switched_period_map
from wear.loss_of_contact.plan import (
    BEYOND,
    SHIFT,
    CountProblem,
    count_problem,
    plan_domains,
)
from wear.loss_of_contact.queries import (
    CYCLES,
    FINER_CYCLES,
    WEAR_RANGES,
    BatchSolver,
    Coroutine,
    Query,
    cycles_by,
    frozen_cycles,
    run_together,
    without_feedback,
)
from wear.loss_of_contact.samples import Samples
from wear.loss_of_contact.switching import Edge
from wear.loss_of_contact.wear_ranges import AbelSolution, WearRange, ranges_by
from wear.model import Model
from wear.numerics.floating_point import ROUNDOFF, TINY
from wear.orbit.iterates import Iterates
from wear.orbit.period_map import settings
from wear.orbit.problem import Cost
from wear.orbit.segments import Orbit, Segment
from wear.outcome import FADES, STOPS
from wear.scene_orbit import End, SceneOrbit

FEW = 4.0  # cycles to the next grazing wear: these are integrated
KEPT = 5  # cycles integrated one by one even when there is no time left
MOST_SINGLE = 2000  # cycles integrated one by one: then the count ends
MOST_WALKED = 100_000  # cycles taken one by one on series: then it ends, too
APART = 1e-9  # of roughness and wear: a small difference
MOST_AT_ONCE = 1000
VIOLENT = 0.5  # of the wear and its scale: larger increments have no series
FINER = 1e-2  # of the tolerance of a cycle: that of the finer cycle for its error
MOST_PREDICTIONS = 16  # one after the other
MOST_SAMPLES = 64  # cycles of a scene that are integrated at once
_FIRST = np.zeros(1, dtype=np.intp)  # scene


class CountRequest(NamedTuple):
    """A request for `cycles` of a model under a load that repeats, with its edge of contact, from
    the wear `start` (mm), known up to `start_error`; cycles beyond a wear `deepest` (mm) are not
    counted."""

    model: Model
    load: Load
    edge: Edge
    cycles: float
    start: float = 0.0
    start_error: float = 0.0
    deepest: float = np.inf


@np.errstate(all="ignore")
def count_scenes(
    requests: Sequence[CountRequest], rtol: float, deadline: float = np.inf, grace: float = np.inf
) -> list[SceneOrbit]:
    """Count the cycles of scenes of one variant, or until wear ends.

    After the `deadline` (`time.monotonic()`) a few cycles are integrated at most; `grace` seconds
    later a `TimeoutError` ends them.
    """
    models, loads = [each.model for each in requests], [each.load for each in requests]
    edges = [each.edge for each in requests]
    size = settings(rtol, [edge.pieces.begin for edge in edges])
    finer = max(ROUNDOFF, FINER * size.endpoint_tolerance)
    coarse, fine = (
        switched_period_map(models, loads, edges, *each)._replace(deadline=deadline + grace)
        for each in (
            (size.phase_nodes, size.endpoint_tolerance),
            (size.finer_nodes, finer),
        )
    )
    counts = [_count(each, rtol, deadline) for each in requests]
    answers: list[BatchSolver] = [frozen_cycles(coarse), ranges_by(coarse)]
    answers += [cycles_by(coarse), cycles_by(fine)]
    counters = run_together(counts, answers, deadline + grace)
    parts = [part for counter in counters for part in counter.parts]
    scene = np.repeat(np.arange(len(counters)), [len(counter.parts) for counter in counters])
    found = iter(with_error(parts, scene, [counter.problem for counter in counters], coarse.cycles))
    return [
        _segments(counter, [next(found) for _ in counter.parts], each)
        for counter, each in zip(counters, requests, strict=True)
    ]


def _count(request: CountRequest, rtol: float, deadline: float) -> Coroutine[_Counter]:
    asked = request.model, request.load, request.edge, request.deepest
    problem = count_problem(*asked, rtol, deadline)
    counter = _Counter(problem, request.start)
    while counter.unfinished(request.cycles):
        yield from counter.advance(max(request.cycles - counter.done, 1.0))
    yield from _estimate_errors(counter)
    return counter


class _Counter:
    """The count of a scene so far: its `parts` in order, `done` cycles in all, and the `wear` (mm)
    after them. It follows `wear_ranges` on which the increments are known; between them it takes
    integrated cycles, `samples`, whose initial wears are predicted, several at once. While it
    predicts, `predicted` collects the initial wears of cycles to integrate."""

    def __init__(self, problem: CountProblem, start: float) -> None:
        self.problem, self.wear, self.done = problem, start, 0.0
        self.over = self.arrested = self.fades = False
        self.parts: list[CountPart] = []
        self.wear_ranges: list[WearRange] = []
        self.planned_to = start
        self.samples = Samples()
        self.last_added, self.last_growth = 0.0, 1.0
        self.singles = self.walked = 0
        self.predicted: list[float] | None = None
        self.cost = Cost(0, 0)

    def unfinished(self, cycles: float) -> bool:
        """Return whether some of so many cycles are still to be counted."""
        most = min(self.problem.end, self.problem.deepest)
        ahead = self.done < cycles and self.wear < most
        return not self.over and (ahead or not self.parts)

    def advance(self, cycles: float) -> Coroutine[None]:
        """Count up to so many `cycles` more."""
        if self._lacks_a_plan(cycles):
            yield from self._plan(cycles)
        elif self._along(cycles) or (yield from self._to_the_grazing_wear()):
            return
        elif not self._cycle():
            yield from self._ask(cycles)

    def _lacks_a_plan(self, cycles: float) -> bool:
        in_time = time.monotonic() <= self.problem.deadline
        return self.wear >= self.planned_to and cycles > FEW and in_time

    def _plan(self, cycles: float) -> Coroutine[None]:
        problem = self.problem
        added = yield from without_feedback(np.array([self.wear]))
        if added[0] > VIOLENT * (SHIFT * problem.scale + self.wear):
            self.wear_ranges, self.planned_to = [], np.nextafter(self.wear, np.inf)
            return
        domains, self.planned_to = yield from plan_domains(problem, self.wear, cycles)
        self.wear_ranges, cost = yield Query(WEAR_RANGES, (domains, problem))
        self.cost = self.cost.plus(*cost)

    def _along(self, cycles: float) -> bool:
        """Count on the range with this wear, if there is one; return whether that led on."""
        for here in self.wear_ranges:
            if here.series.domain.start <= self.wear < here.series.domain.end:
                z = float(here.series.domain.coordinate.at(np.array(self.wear)))
                abel = here.abel
                if abel is not None and z < abel.first:
                    return self._walk(here, abel.first, cycles)
                return self._jump(abel, z) or self._walk(here, here.end, cycles)
        return False

    def _jump(self, abel: AbelSolution | None, z: float) -> bool:
        """Jump from z to the end of the panels of Abel's equation, if that takes a cycle."""
        if abel is None or not z < abel.last:
            return False
        ran, z_after = abel.to_end(z)
        limit_wear = abel.limit_wear
        if ran < 1.0 and not limit_wear:
            return False
        if self.predicted is None:
            self.parts.append(CycleJump(abel, z, ran))
        wear = float(abel.series.coordinate.wear(np.array(z_after)))
        self.wear, self.done = limit_wear.wear if limit_wear else wear, self.done + ran
        self.over = self.arrested = self.fades = limit_wear is not None
        return True

    def _walk(self, here: WearRange, end: float, cycles: float) -> bool:
        """Take single cycles until z passes `end`."""
        most = min(cycles, MOST_AT_ONCE)
        if self.predicted is not None and not here.series.domain.tends:
            (*before, last), _ = here.series.walk(self.wear, end, most)
            if before:
                self.wear, self.done = last, self.done + len(before)
                self.last_added = last - before[-1]
            return bool(before)
        found = walked(here.series, self.wear, end, most)
        if not found.added:
            return False
        self.walked += len(found.added)
        self.over = self.walked >= MOST_WALKED
        if here.series.domain.tends and end == here.end and len(found.wear) <= most:
            rest = here.series.domain.end - found.wear[-1]
            ends = [found.wear[-1], here.series.domain.end, here.series.domain.end]
            found.extend(SingleCycles(ends, [rest, 0.0], [0.0, 0.0], [0.0, 1.0]))
            self.over = self.arrested = self.fades = True
        self._append_cycles(found)
        return True

    def _to_the_grazing_wear(self) -> Coroutine[bool]:
        """Skip cycles next to a grazing wear that double precision does not resolve."""
        ahead = (stop for stop in self.problem.stops if stop.wear > self.wear * BEYOND)
        point = next(ahead, None)
        if point is None or point.wear - self.wear > 2 * point.nearest:
            return False
        # Contact shrinks like the root of the distance: twice the cycles at the present rate.
        rate = (yield from without_feedback(np.array([self.wear])))[0] + TINY
        distance = point.wear - self.wear
        cycles_left = np.floor(2 * distance / rate)
        if not FEW <= cycles_left < np.inf:
            return False
        part = np.array([[self.wear], [point.wear], [cycles_left], [distance]])
        self.parts.append(UnresolvedIterates(*part))
        self.wear, self.done = point.wear, self.done + float(cycles_left)
        return True

    def _cycle(self) -> bool:
        """Add one cycle, if a sample near by gives it accurately."""
        guess, limit = self.last_added * self.last_growth, self.problem.limit_wear
        sample = self.samples.at(self.wear, guess)
        known = sample.error <= self.problem.size.endpoint_tolerance
        if self.predicted is None and not known:
            return False
        if self.predicted is not None and not known:
            self.predicted.append(self.wear)
        added = sample.added
        if not added > 0.0 and limit is not None and self.wear < limit.wear:
            added = limit.wear - self.wear  # nearer than rounding resolves
        self.singles += 1
        cycle = [self.wear, self.wear + added], [added], [np.nan], [abs(1.0 + sample.slope)]
        self._append_cycles(SingleCycles(*cycle))
        self.arrested = not added > 0.0
        self.fades = self.arrested and limit is not None
        late = time.monotonic() > self.problem.deadline and self.singles >= KEPT
        failed = not sample.sound or not self.wear < self.problem.end
        self.over = self.arrested or failed or late or self.singles >= MOST_SINGLE
        return True

    def _ask(self, cycles: float) -> Coroutine[None]:
        """Integrate cycles here and at the predicted wears ahead, twice each for their slopes."""
        ahead = copy(self)
        ahead.parts, ahead.done, ahead.predicted = [], 0.0, []
        in_a_row = 0
        while ahead.unfinished(cycles) and len(ahead.predicted) < MOST_SAMPLES:
            remaining = cycles - ahead.done
            if ahead._lacks_a_plan(remaining) or in_a_row == MOST_PREDICTIONS:
                break
            in_a_row = 0 if ahead._along(remaining) else in_a_row + 1
            if in_a_row:
                ahead._cycle()
        wear = np.array(ahead.predicted)
        difference = APART * (4 * self.problem.scale + wear)
        run = yield Query(CYCLES, np.concatenate([wear, wear + difference]))
        self.cost = self.cost.plus(2 * len(wear), run.evaluations)
        added, beside = np.split(run.increment, 2)
        slope, sound = (beside - added) / difference, run.converged[: len(wear)]
        self.samples.add(wear, added, slope, sound)

    def _append_cycles(self, cycles: SingleCycles) -> None:
        if self.parts and isinstance(last := self.parts[-1], SingleCycles):
            last.extend(cycles)
        else:
            self.parts.append(cycles)
        self.wear, self.done = cycles.wear[-1], self.done + len(cycles.added)
        self.last_added = cycles.added[-1]
        self.last_growth = min(cycles.growth[-1], 1.0)


def _segments(
    counter: _Counter, found: Sequence[CountPartIterates], request: CountRequest
) -> SceneOrbit:
    """Return the parts of a count as segments, with one for the cycles after its end."""
    problem, cycles = counter.problem, request.cycles
    segments: list[Segment] = []
    begins, begins_error, one = 0.0, 0.0, np.zeros(1)
    start_error = one + request.start_error
    for counted in found:
        segments.append(Segment(_FIRST, counted, one + begins, start_error, one + begins_error))
        ran = counted.whole_cycles
        after, relative = counted.after(ran[None])
        start_error = after[0] * (relative[0] + start_error / (after[0] + TINY))
        begins += float(ran[0])
        begins_error += float(counted.reach[0]) if isinstance(counted, UnresolvedIterates) else 0.0
    end_of_wear: End | None = None
    limit = problem.limit_wear
    if not counter.arrested and begins < cycles and limit is not None:
        # The count has ended before, but no wear is beyond the limit.
        distance = max(limit.wear - counter.wear, 0.0) + limit.uncertainty
        short = UnresolvedIterates(
            *(one + x for x in (counter.wear, limit.wear, cycles - begins, distance))
        )
        segments.append(Segment(_FIRST, short, one + begins, start_error, one + begins_error))
    if counter.arrested and begins <= cycles:
        end_of_wear = _end(problem, segments, counter.fades)
        rest = end_of_wear and _rest(problem, segments, end_of_wear)
        segments += [rest] if rest else []
    return SceneOrbit(Orbit(1, tuple(segments), counter.cost), end_of_wear)


def _estimate_errors(counter: _Counter) -> Coroutine[None]:
    """Estimate the errors of integrated cycles by a finer period map."""
    todo = [
        (part, k)
        for part in counter.parts
        if isinstance(part, SingleCycles)
        for k, error in enumerate(part.local_error)
        if np.isnan(error)
    ]
    if not todo:
        return
    at, added = np.array([(part.wear[k], part.added[k]) for part, k in todo]).T
    fine = yield Query(FINER_CYCLES, at)
    error = np.abs(fine.increment - added) if fine.converged.all() else np.full(len(at), np.inf)
    for (part, k), found in zip(todo, error.tolist(), strict=True):
        part.local_error[k] = found
    counter.cost = counter.cost.plus(len(at), fine.evaluations)


def _end(problem: CountProblem, segments: list[Segment], fades: bool) -> End | None:
    """Return the cycle in which wear stops, if its error is known."""
    last = segments[-1]
    begins, counted = int(last.begins[0]), last.iterates
    # A segment that begins at rest does not show how long it took to get there.
    moving = [float(s.count_uncertainty[0]) for s in segments if s.iterates.first_increment[0] > 0]
    uncertainty = max([float(last.count_uncertainty[0]), *moving[-1:]])
    if not np.isfinite(last.start_error[0] + uncertainty):
        return None
    if isinstance(counted, TabulatedIterates):
        cycle = begins + int(counted.whole_cycles[0])
        return End(cycle, round(uncertainty + float(counted.count_error[-1])), FADES)
    if not isinstance(counted, Iterates) or not np.isfinite(counted.transient_error).all():
        return None
    cycle = begins + counted.first_idle_cycle
    # On springs the pressure vanishes with the distance that is left: no cycle is the last.
    fades |= problem.model.compliant and cycle > 0
    return End(cycle, round(uncertainty), FADES if fades else STOPS)


def _rest(problem: CountProblem, segments: list[Segment], end: End) -> Segment | None:
    """Return the segment after the end, if the limit of the wear is known: its error is that of
    rounding alone, not that of the cycles before."""
    wear = segments[-1].iterates.last_state
    limit = limit_wear_of(problem.model, problem.load, float(wear[0]))
    if limit is None:
        return None
    none, begins = np.zeros(1), np.array([end.cycle + 2.0 * end.uncertain])
    rest = UnresolvedIterates(wear, wear, none, none + limit.uncertainty)
    return Segment(_FIRST, rest, begins, none, none)
