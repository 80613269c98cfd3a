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
from wear.loss_of_contact.arrest import TO_ROUNDOFF, LimitWear, Rest, TabulatedCount, Unresolved
from wear.loss_of_contact.grazing import limit_wear_of
from wear.loss_of_contact.increments import Increments, Span, fitted, frame_of, middle
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
from wear.loss_of_contact.roundoff import Roundoff, roundoff
from wear.loss_of_contact.switching import Edge, edge_of_contact
from wear.model import Model
from wear.numerics.chebyshev import chebyshev_nodes, chebyshev_values
from wear.numerics.gauss import BoolArray, FloatArray
from wear.numerics.tolerances import ROUNDOFF, TINY
from wear.orbit import abel
from wear.orbit.iterates import Cells, Iterates, cells
from wear.orbit.panels import CHECKS
from wear.orbit.period_map import Settings, settings
from wear.orbit.problem import Cost
from wear.orbit.segments import Orbit, Segment
from wear.orbit.transient import SAFETY

FEW = 4.0  # cycles to the next grazing wear: they are integrated
CALM = 24.0  # cycles that the distance to a grazing wear would last: then Abel's equation is solved
MOST_WALKED = 250  # cycles on a series that are taken one by one
LOOKS = 65  # at a series, for how many cycles it takes
KEPT = 5  # cycles integrated one by one even when there is no time left
MOST_SINGLE = 2000  # cycles integrated one by one: then the count ends
MOST_CUTS = 16  # rounds of cutting panels in two
ENOUGH = 1.5  # cycles per coefficient of a panel
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
    runs = _Count(problem, wanted.start)
    while not runs.over and (runs.done < wanted.cycles or not runs.parts):
        yield from runs.go(max(wanted.cycles - runs.done, 1.0))
    return (yield from _judged(problem, runs, wanted.start_error, wanted.cycles))


class OneByOne(NamedTuple):
    """Cycles one by one: the `wear` (mm) before and after each and what each has `added` (mm); and
    the series that these are found with, for so many each, or None where they are integrated."""

    wear: list[float]
    added: list[float]
    found_with: list[tuple[int, Increments | None]]

    @property
    def marks(self) -> FloatArray:
        """Return the wears (mm) between which rounding counts."""
        return np.array(self.wear)

    @property
    def ran(self) -> float:
        """Return how many cycles."""
        return float(len(self.added))

    @property
    def integrated(self) -> BoolArray:
        """Return which cycles (k,) are integrated."""
        numbers, series = zip(*self.found_with, strict=True)
        return np.repeat([each is None for each in series], numbers)

    def extended(self, wear: list[float], added: list[float], series: Increments | None) -> None:
        """Add cycles, from the last wear to each `wear` (mm)."""
        self.wear.extend(wear)
        self.added.extend(added)
        self.found_with.append((len(added), series))

    def missed(self) -> tuple[FloatArray, FloatArray]:
        """Return what each cycle on a series may have missed (mm), and its derivative dP/du; zero
        for cycles that are integrated."""
        wear, added = np.array(self.wear), np.array(self.added)
        missed, growth = np.zeros((2, len(added)))
        begin = 0
        for number, series in self.found_with:
            some = slice(begin, begin + number)
            begin += number
            if series is not None:
                own = added[some]
                missed[some] = series.missed(series.coordinate.at(wear[some])) * own
                growth[some] = np.abs(1 + np.diff(own, append=own[-1]) / (own + TINY))
        return missed, growth

    def judged(
        self, problem: Problem, missed: FloatArray, growth: FloatArray, rounding: Roundoff
    ) -> Iterates:
        """Return the cycles with what each may have missed (mm) and the factor by which it changes
        an error."""
        wear, added = np.array(self.wear), np.array(self.added)
        # The response to a relative error of the rate: what is made early grows, but once the wear
        # exceeds the roughness the rate hardly grows any more.
        response = added + np.minimum(added, 4 * problem.scale) * growth
        lost = SAFETY * missed + rounding.of_cycles * response
        error = [0.0]
        for more, factor in zip(lost.tolist(), growth.tolist(), strict=True):
            error.append(error[-1] * factor + more)
        estimate = np.array(error) + ROUNDOFF * wear
        one, limit = np.zeros((1, 1)), np.array([problem.end])
        return Iterates(wear[None], estimate[None], None, None, one, limit, one)


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
    def marks(self) -> FloatArray:
        """Return the wears (mm) between which rounding counts."""
        return self.series.coordinate.wear(np.append(self.table.u, self.table.ends[-1]))

    def judged(self, problem: Problem, rounding: Roundoff) -> TabulatedCount:
        """Return the count with its estimated error: of the increments, of Abel's equation, at
        junctions of panels, by rounding."""
        table, panels = self.table, self.panels
        coordinate = self.series.coordinate
        parts = len(table.length) // len(panels.series)
        ends = self.series.missed(np.append(table.u, table.ends[-1]))
        misfit = np.maximum(ends[1:], ends[:-1])
        if self.line:
            misfit[table.u >= self.series.frame.starts[-1]] = 0.0  # there the residual says it all
        missed = SAFETY * (np.repeat(self.residual, parts) + misfit) * table.gain + table.missed
        if len(panels.series) > 1:
            apart = abel.matching_defect(panels.take(slice(-1)), panels.take(slice(1, None)))
            missed[parts - 1 : -1 : parts] += SAFETY * apart
        terms = np.sum(np.abs(panels.series), axis=1)  # of the logarithm of the density
        of_density = ROUNDOFF * np.repeat(terms, parts)
        missed += (rounding.larger_rate + of_density) * table.gain
        error = np.concatenate([[0.0], np.cumsum(missed)])
        limit = np.array([problem.end])
        return TabulatedCount(coordinate, table, panels, error, self.limit_wear, limit)


class _Count:
    """The way so far: `parts`, one after the other, `done` cycles in all, and the `wear` (mm)."""

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
                way = np.array([[self.wear], [ahead], [np.floor(left)]])
                self._append(Unresolved(*way), float(np.floor(left)), ahead)
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

    def _append_cycles(
        self, wear: list[float], added: list[float], series: Increments | None
    ) -> None:
        if not (self.parts and isinstance(self.parts[-1], OneByOne)):
            self.parts.append(OneByOne([self.wear], [], []))
        last = self.parts[-1]
        assert isinstance(last, OneByOne)
        last.extended(wear, added, series)
        self.wear, self.done = wear[-1], self.done + len(added)

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
        self._append_cycles([self.wear + added], [added], None)
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
        walked = series.walk(self.wear, end, min(cycles, MOST_AT_ONCE))
        if len(walked) == 1:
            yield from self._single()
            return
        if span.tends and end == series.end and len(walked) <= min(cycles, MOST_AT_ONCE):
            walked += [span.end, span.end]
            self.over = self.arrested = self.fades = True
        self._append_cycles(walked[1:], np.diff(walked).tolist(), series)


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
        across = np.log((ends + shift) / (starts + shift))
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


def _judged(problem: Problem, runs: _Count, begun_with: float, cycles: float) -> Asking[Counted]:
    """Return the parts of the way as segments, each with its estimate of error."""
    marks = [np.empty(0) if isinstance(part, Unresolved) else part.marks for part in runs.parts]
    ends = np.cumsum([len(at) for at in marks]).tolist()
    rounding = roundoff(problem.model, problem.load, np.concatenate(marks))
    missed, growth, cost = yield from _judge(problem, runs)
    segments: list[Segment] = []
    begins, drift, one = 0.0, 0.0, np.zeros(1)
    inherited = one + begun_with
    for i, (part, end, at) in enumerate(zip(runs.parts, ends, marks, strict=True)):
        counted: TabulatedCount | Iterates | Unresolved
        own = rounding.part(slice(end - len(at), end))
        if isinstance(part, OneByOne):
            counted = part.judged(problem, missed[i], growth[i], own)
        else:
            counted = part.judged(problem, own) if isinstance(part, OnPanels) else part
        segments.append(Segment(_FIRST, counted, one + begins, inherited, one + drift))
        ran = counted.whole_cycles
        after, relative = counted.after(ran[None])
        inherited = after[0] * (relative[0] + inherited / (after[0] + TINY))
        begins += float(ran[0])
        drift += float(part.reach[0]) if isinstance(part, Unresolved) else 0.0
    end_of_wear = None
    if runs.arrested and begins <= cycles:
        end_of_wear = _end(problem, segments, runs.fades)
        rest = end_of_wear and _rest(problem, segments, end_of_wear)
        segments += [rest] if rest else []
    return Counted(Orbit(1, tuple(segments), cost), end_of_wear)


def _judge(
    problem: Problem, runs: _Count
) -> Asking[tuple[dict[int, FloatArray], dict[int, FloatArray], Cost]]:
    """Return what cycles one by one missed (mm), by part, and their derivatives dP/du: by the
    series, or those that are integrated by another map and from beside; and the cost of all."""
    parts = {i: part for i, part in enumerate(runs.parts) if isinstance(part, OneByOne)}
    missed, growth = {}, {}
    for i, part in parts.items():
        missed[i], growth[i] = part.missed()
    which = {i: part.integrated for i, part in parts.items()}
    none = [np.empty(0)]
    at = np.concatenate(none + [part.marks[:-1][which[i]] for i, part in parts.items()])
    added = np.concatenate(none + [np.array(part.added)[which[i]] for i, part in parts.items()])
    if len(at) == 0:
        return missed, growth, runs.cost
    fine = yield Request(FINE, at)
    apart = APART * (4 * problem.scale + at)
    beside = yield Request(COARSE, at + apart)
    off = np.abs(fine.increment - added) if fine.converged.all() else np.full(len(at), np.inf)
    change, begin = np.abs(1 + (beside.increment - added) / apart), 0
    for i, own in which.items():
        some = slice(begin, begin := begin + int(np.sum(own)))
        missed[i][own], growth[i][own] = off[some], change[some]
    return missed, growth, runs.cost.plus(2 * len(at), fine.evaluations + beside.evaluations)


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
    return Segment(_FIRST, Rest(wear, limit.uncertainty / wear), begins, none, none)
