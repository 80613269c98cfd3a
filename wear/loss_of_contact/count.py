"""The cycle count with loss of contact: from one grazing wear to the next, and to the last.

Between two grazing wears (`wear.loss_of_contact.grazing`) the increments of a cycle are series
(`wear.loss_of_contact.increments`), of which Abel's equation makes the count where cycles are many;
the few cycles next to a grazing wear are taken one by one, from the series as long as they do not
pass it. Only the cycle that passes is integrated by itself, and the last ones before wear stops.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from wear.counted import FADES, STOPS, Counted, End
from wear.load import Load
from wear.loss_of_contact.arrest import TO_ROUNDOFF, TabulatedCount, Unresolved
from wear.loss_of_contact.grazing import limit_wear_of
from wear.loss_of_contact.increments import Increments, Span, fitted, frame_of
from wear.loss_of_contact.parts import ENOUGH, OneByOne, OnPanels, on_a_line, solved, walked
from wear.loss_of_contact.period_map import switched_period_map
from wear.loss_of_contact.plan import GRAIN, SHIFT, Problem, planned, problem_of
from wear.loss_of_contact.requests import (
    COARSE,
    FINE,
    Asking,
    Request,
    answered,
    without_feedback,
)
from wear.loss_of_contact.switching import Edge, edge_of_contact
from wear.model import Model
from wear.numerics.tolerances import ROUNDOFF, TINY
from wear.orbit.iterates import Iterates, cells
from wear.orbit.period_map import settings
from wear.orbit.problem import Cost
from wear.orbit.segments import Orbit, Segment

FEW = 4.0  # cycles to the next grazing wear: they are integrated
CALM = 24.0  # cycles that the distance to a grazing wear would last: then Abel's equation is solved
MOST_WALKED = 250  # cycles on a series that are taken one by one
LOOKS = 65  # at a series, for how many cycles it takes
KEPT = 5  # cycles integrated one by one even when there is no time left
MOST_SINGLE = 2000  # cycles integrated one by one: then the count ends
APART = 1e-9  # of roughness and wear: a small difference
MOST_AT_ONCE = 1000
VIOLENT = 0.5  # of the wear and its scale: increments that have no series
JUDGED = 1e-2  # of the tolerance of a cycle: that of the cycle that judges it
MOST_POOR = 8  # times that panels may hold too few cycles
_FIRST = np.zeros(1, dtype=np.intp)  # scene
COEFFICIENTS, FEWER_COEFFICIENTS = 32, 24  # of a panel of increments, for many and for few digits


class Wanted(NamedTuple):
    """A scene's model under a load that repeats, of which `cycles` are to be counted from the wear
    `start` (mm), known up to `start_error`."""

    model: Model
    load: Load
    cycles: float
    start: float = 0.0
    start_error: float = 0.0


@np.errstate(all="ignore")
def counted_stages(
    wanted: Sequence[Wanted], rtol: float, deadline: float = np.inf
) -> list[Counted]:
    """Count the cycles of scenes of one variant, or until wear ends.

    After the `deadline` (`time.monotonic()`) a few cycles are integrated at most.
    """
    models, loads = [each.model for each in wanted], [each.load for each in wanted]
    edges = [edge_of_contact(*pair) for pair in zip(models, loads, strict=True)]
    size = settings(rtol)
    coarse = switched_period_map(models, loads, edges, size.phase_nodes, size.endpoint_tolerance)
    finer = max(ROUNDOFF, JUDGED * size.endpoint_tolerance)
    fine = switched_period_map(models, loads, edges, size.finer_nodes, finer)
    counts = [_count(*each, rtol, deadline) for each in zip(wanted, edges, strict=True)]
    return answered(counts, [coarse, fine])


def _count(wanted: Wanted, edge: Edge, rtol: float, deadline: float) -> Asking[Counted]:
    problem = yield from problem_of(wanted.model, wanted.load, edge, rtol, deadline)
    way = _Way(problem, wanted.start)
    while not way.over and (way.done < wanted.cycles or not way.parts):
        yield from way.go(max(wanted.cycles - way.done, 1.0))
    return (yield from _judged(problem, way, wanted.start_error, wanted.cycles))


class _Way:
    """The way of a count: `parts`, one after the other, `done` cycles in all, and the `wear` (mm)
    so far."""

    def __init__(self, problem: Problem, start: float) -> None:
        self.problem, self.wear, self.done, self.over = problem, start, 0.0, False
        self.parts: list[OneByOne | OnPanels | Unresolved] = []
        self.known: list[tuple[Span, Increments]] = []
        self.problem_of = start
        self.singles = self.poor = 0
        self.arrested = self.fades = False
        self.cost = Cost(0, 0)

    def go(self, cycles: float) -> Asking[None]:
        """Go on for so many `cycles`, or less."""
        in_time = time.monotonic() <= self.problem.deadline
        if self.wear >= self.problem_of and cycles > FEW and in_time:
            yield from self._prepare(cycles)
            return
        for span, series in self.known:
            if span.start <= self.wear < span.end:
                yield from self._along(span, series, cycles)
                return
        ahead = min(self._ahead(), default=np.inf)
        if ahead - self.wear <= 2 * GRAIN * ROUNDOFF * ahead:
            # Contact shrinks like the root of what is left: twice the cycles at the present pace.
            rate = (yield from without_feedback(np.array([self.wear])))[0] + TINY
            left = 2 * (ahead - self.wear) / rate
            if FEW < left < np.inf:
                left = np.floor(left)
                part = np.array([[self.wear], [ahead], [left], [ahead - self.wear]])
                self._append(Unresolved(*part), float(left), ahead)
                return
        yield from self._single()

    def _ahead(self) -> list[float]:
        return [stop.at for stop in self.problem.stops if stop.at > self.wear * (1 + 8 * ROUNDOFF)]

    def _prepare(self, cycles: float) -> Asking[None]:
        added = yield from without_feedback(np.array([self.wear]))
        if added[0] > VIOLENT * (SHIFT * self.problem.scale + self.wear):
            yield from self._single()
            return
        spans, self.problem_of = yield from planned(self.problem, self.wear, cycles)
        number = COEFFICIENTS if self.problem.rtol < 1e-8 else FEWER_COEFFICIENTS
        tolerance = self.problem.size.residual_tolerance / 2
        self.known, cost = yield from fitted(spans, number, tolerance)
        self.cost = self.cost.plus(*cost)
        if self.known and self.known[-1][0].tends:
            (span, series), limit = self.known[-1], spans[-1].coordinate.origin
            width = -np.log(TO_ROUNDOFF * limit * series.end)
            self.known[-1] = span._replace(end=limit), series.on_a_line(float(width))

    def _append(self, part: OnPanels | Unresolved, ran: float, wear: float) -> None:
        self.parts.append(part)
        self.wear, self.done = wear, self.done + ran

    def _append_cycles(self, cycles: OneByOne) -> None:
        if self.parts and isinstance(last := self.parts[-1], OneByOne):
            last.wear.extend(cycles.wear[1:])
            for own, more in zip(last[1:], cycles[1:], strict=True):
                own.extend(more)
        else:
            self.parts.append(cycles)
        self.wear, self.done = cycles.wear[-1], self.done + len(cycles.added)

    def _single(self) -> Asking[None]:
        """Integrate one cycle."""
        run = yield Request(COARSE, np.array([self.wear]))
        self.cost = self.cost.plus(1, run.evaluations)
        self.singles += 1
        added = float(run.increment[0])
        if (
            not added > 0.0
            and self.problem.limit_wear is not None
            and self.wear < self.problem.limit_wear.wear
        ):
            added = self.problem.limit_wear.wear - self.wear  # nearer than rounding resolves
        unknown = [np.nan]
        cycle = OneByOne([self.wear, self.wear + added], [added], unknown.copy(), unknown.copy())
        self._append_cycles(cycle)
        self.arrested = not added > 0.0
        self.fades = self.arrested and self.problem.limit_wear is not None
        late = time.monotonic() > self.problem.deadline and self.singles >= KEPT
        failed = not run.converged.all() or not self.wear < self.problem.end
        self.over = self.arrested or failed or late or self.singles >= MOST_SINGLE

    def _along(self, span: Span, series: Increments, cycles: float) -> Asking[None]:
        """Count along a span on which the increments are known."""
        coordinate = span.coordinate
        begin = float(coordinate.at(np.array(self.wear)))
        end = series.end if span.tends else float(coordinate.at(np.array(span.end)))
        width = np.log([(end + coordinate.shift) / (begin + coordinate.shift)])
        whole = frame_of(coordinate, np.array([begin]), width)
        looks = whole.states(np.linspace(-1.0, 1.0, LOOKS))[0]
        lasts = (looks + coordinate.shift) / coordinate.step(looks, series.at(looks))
        gains = (lasts[1:] + lasts[:-1]) / 2 * np.diff(np.log(looks + coordinate.shift))
        calm = np.flatnonzero(lasts >= CALM)
        number = float(np.sum(gains[calm[0] : calm[-1]])) if len(calm) else 0.0
        if np.sum(gains) < MOST_WALKED or number < 2 * ENOUGH * self.problem.size.panel_nodes:
            yield from self._walk(span, series, end, cycles)
        elif calm[0] > 0:
            yield from self._walk(span, series, float(looks[calm[0]]), cycles)
        else:
            before = float(np.sum(gains[looks[1:] <= series.frame.starts[-1]]))
            line = before > ENOUGH * self.problem.size.panel_nodes
            yield from self._count(span, series, begin, float(looks[calm[-1]]), line)

    def _count(
        self, span: Span, series: Increments, begin: float, end: float, line: bool
    ) -> Asking[None]:
        """Count by Abel's equation from one z to another, on a line at last if that is to be."""
        limit_wear = (
            self.problem.limit_wear if span.tends and end >= series.end * (1 - 1e-9) else None
        )
        line &= limit_wear is not None
        end = float(series.frame.starts[-1]) if line else end
        panels, residual, poor = solved(series, begin, end, self.problem.size)
        if poor and self.poor < MOST_POOR:  # panels of too few cycles: some more one by one
            self.poor += 1
            yield from self._walk(span, series, end, MOST_WALKED)
            return
        if line:
            panels, residual = on_a_line(panels, residual, series)
        part = OnPanels(cells(panels), panels, residual, series, limit_wear, line)
        if limit_wear is not None:
            self._append(part, part.ran, limit_wear.wear)
            self.over = self.arrested = self.fades = True
        elif part.ran < 1.0:
            yield from self._single()
        else:
            z, _ = part.table.state_after(np.array([part.ran]))
            self._append(part, part.ran, float(span.coordinate.wear(z)[0]))

    def _walk(self, span: Span, series: Increments, end: float, cycles: float) -> Asking[None]:
        """Go on cycle by cycle until z passes `end`."""
        most = min(cycles, MOST_AT_ONCE)
        cycles_on = walked(series, self.wear, end, most)
        if not cycles_on.added:
            yield from self._single()
            return
        if span.tends and end == series.end and len(cycles_on.wear) <= most:
            rest = span.end - cycles_on.wear[-1]
            cycles_on.wear.extend([span.end, span.end])
            cycles_on.added.extend([rest, 0.0])
            cycles_on.missed.extend([0.0, 0.0])
            cycles_on.growth.extend([0.0, 1.0])
            self.over = self.arrested = self.fades = True
        self._append_cycles(cycles_on)


def _judged(problem: Problem, way: _Way, begun_with: float, cycles: float) -> Asking[Counted]:
    """Return the parts of the way as segments, each with its estimate of error."""
    yield from _judge(problem, way)
    segments: list[Segment] = []
    begins, drift, one = 0.0, 0.0, np.zeros(1)
    inherited = one + begun_with
    for part in way.parts:
        counted = part if isinstance(part, Unresolved) else part.judged(problem)
        segments.append(Segment(_FIRST, counted, one + begins, inherited, one + drift))
        ran = counted.whole_cycles
        after, relative = counted.after(ran[None])
        inherited = after[0] * (relative[0] + inherited / (after[0] + TINY))
        begins += float(ran[0])
        drift += float(part.reach[0]) if isinstance(part, Unresolved) else 0.0
    end_of_wear = None
    if way.arrested and begins <= cycles:
        end_of_wear = _end(problem, segments, way.fades)
        rest = end_of_wear and _rest(problem, segments, end_of_wear)
        segments += [rest] if rest else []
    return Counted(Orbit(1, tuple(segments), way.cost), end_of_wear)


def _judge(problem: Problem, way: _Way) -> Asking[None]:
    """Judge the cycles that were integrated, by another map and from beside."""
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
    apart = APART * (4 * problem.scale + at)
    beside = yield Request(COARSE, at + apart)
    missed = np.abs(fine.increment - added) if fine.converged.all() else np.full(len(at), np.inf)
    growth = np.abs(1 + (beside.increment - added) / apart)
    for (part, k), *found in zip(todo, missed.tolist(), growth.tolist(), strict=True):
        part.missed[k], part.growth[k] = found
    evaluations = fine.evaluations + beside.evaluations
    way.cost = way.cost.plus(2 * len(at), evaluations)


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
