"""Orbits of many scenes: segments, each counted by Abel's equation from where the last one ended.

Overview
    A segment begins with cycles that are integrated, if the state changes its own rate much within
    a cycle; panels follow as far as each holds many cycles. Where the density gets sharp again
    farther on, the next segment begins there. A rough look ahead with the rate frozen over each
    cycle says how far panels must reach; what it misses, the residual of Abel's equation finds.
Key results
    orbit      all segments of all scenes
    Orbit      the states after any numbers of cycles, the cycles until any states
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from typing import NamedTuple, Protocol

import numpy as np

from wear.numerics.gauss import BoolArray, FloatArray, IntArray
from wear.numerics.tolerances import ROUNDOFF, TINY
from wear.orbit import abel
from wear.orbit.iterates import Cells, Iterates, cells
from wear.orbit.panels import SolvedPanels, fill, planned
from wear.orbit.period_map import (
    Equation,
    PeriodMap,
    Rows,
    by_size,
    period_map,
    resolved,
    settings,
)
from wear.orbit.transient import BLOCK, SAFETY, Transient, extended, no_cycle

LEAST = 200.0  # the last panel reaches this count at least: panels are long against a cycle
MARGIN = 4.0  # of the look ahead, in cycles
LONGEST, STEPS = 36.0, 60  # of the look ahead, in ln(1 + u/scale)
AHEAD_NODES = 10  # on each interval of phase, to look ahead
SAMPLES = np.array([0.0, 0.15, 0.3, 0.45, 0.6, 0.8, 1.0])  # of the way: there a mesh must suit
FRAME_SCALE = 12.0  # of the coordinate of panels, over the scale: one serves to infinity
SMALL = 0.5  # step in ln(u + scale): then panels may begin with it
APART = 1e-3  # of the state and its scale: states between which a change is taken
SHARP = 0.3  # change of the logarithm of the density within a cycle
FAR_TOO_WIDE = 1e-2  # residual of a panel that was not planned
MOST_FIRST = 120  # cycles integrated one by one in a segment
MOST_SEGMENTS = 40
MOST_EVALUATIONS = 20_000_000  # of a scene: then the estimate shows what is missed
NEARLY_THERE = 10.0  # times the residual that is asked for
NEARLY = 1 - 1e-9  # of the limit of the states
TIGHT = 1e-12


class Cost(NamedTuple):
    """What a result took: starts times cycles integrated, right-hand sides evaluated."""

    cycles_integrated: int
    rhs_evaluations: int

    def plus(self, cycles: int, evaluations: int) -> Cost:
        """Return the cost after so much more work."""
        return Cost(self.cycles_integrated + cycles, self.rhs_evaluations + evaluations)


class Problem(Equation, Protocol):
    """The equation of some scenes (s,) with the scales of its states."""

    @property
    def scale(self) -> FloatArray:
        """Return the change of the state (s,) that changes the rate by a factor of order one."""

    @property
    def limit(self) -> FloatArray:
        """Return the states (s,) from which on the rate has no meaning; infinite if none has."""

    @property
    def breakpoints(self) -> list[FloatArray]:
        """Return the phases, from 0 to 1, between which the rate of each scene is smooth."""

    def take(self, rows: Rows) -> Problem: ...

    def roundoff(self, u: FloatArray) -> FloatArray:
        """Return the relative error of the rate by rounding at states u (s, k), at most."""


class Counted(Protocol):
    """A count of cycles of some scenes (s,)."""

    @property
    def limit(self) -> FloatArray: ...

    @property
    def first_increment(self) -> FloatArray: ...

    @property
    def last_state(self) -> FloatArray: ...

    @property
    def at_rest(self) -> BoolArray: ...

    @property
    def whole_cycles(self) -> FloatArray: ...

    def take(self, rows: IntArray) -> Counted: ...

    def after(self, cycles: FloatArray) -> tuple[FloatArray, FloatArray]: ...

    def until(self, u: FloatArray) -> tuple[FloatArray, FloatArray]: ...


class Request(NamedTuple):
    """For some scenes (s,): count `cycles` from the states `start`, known up to `start_error`; and
    refine nothing after the `deadline` (`time.monotonic()`)."""

    cycles: FloatArray
    start: FloatArray
    start_error: FloatArray
    deadline: float = np.inf

    @property
    def late(self) -> bool:
        """Return whether the deadline has passed."""
        return time.monotonic() > self.deadline

    def take(self, which: IntArray) -> Request:
        """Return some of the scenes."""
        return Request(
            self.cycles[which], self.start[which], self.start_error[which], self.deadline
        )


class Segment(NamedTuple):
    """A count of the scenes `which` (s,) from `begins` (s,) cycles on, which may be out by `drift`
    (s,), with the error `inherited` (s,) of the state that it begins with."""

    which: IntArray
    counted: Counted
    begins: FloatArray
    inherited: FloatArray
    drift: FloatArray

    def take(self, rows: IntArray) -> Segment:
        """Return some of the scenes."""
        return Segment(
            self.which[rows],
            self.counted.take(rows),
            self.begins[rows],
            self.inherited[rows],
            self.drift[rows],
        )

    @property
    def blur(self) -> FloatArray:
        """Return by how many cycles (s,) its count may be out at its start."""
        rate = self.counted.first_increment
        return self.drift + np.where(rate > 0, self.inherited / np.where(rate > 0, rate, 1.0), 0.0)


class Orbit(NamedTuple):
    """All `segments` of some scenes, in rising order for each, and what they cost."""

    scenes: int
    segments: tuple[Segment, ...]
    cost: Cost

    def after(self, cycles: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the states after `cycles` (s, c) and their estimated relative errors, infinite
        where out of reach."""
        u, error = np.full(cycles.shape, np.nan), np.full(cycles.shape, np.inf)
        for segment in self.segments:
            since = cycles[segment.which] - segment.begins[:, None]
            here = since >= 0
            if not here.any():
                continue
            state, missed = segment.counted.after(np.maximum(since, 0.0))
            missed = missed + segment.inherited[:, None] / (state + TINY)
            missed[np.isnan(missed)] = np.inf
            u[segment.which] = np.where(here, state, u[segment.which])
            error[segment.which] = np.where(here, missed, error[segment.which])
        return u, error

    def until(self, u: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the whole cycles after which each state (s, c) is first reached, infinite where
        it is not, and the estimated error in cycles."""
        count, error = np.full(u.shape, np.inf), np.zeros(u.shape)
        for segment in reversed(self.segments):
            after, missed = segment.counted.until(u[segment.which])
            here = np.isfinite(after)
            after, missed = after + segment.begins[:, None], missed + segment.blur[:, None]
            count[segment.which] = np.where(here, after, count[segment.which])
            error[segment.which] = np.where(here, missed, error[segment.which])
        return count, error

    def last(self, scene: int) -> Segment:
        """Return the last segment of a scene, alone."""
        return next(part for part in reversed(self.segments) if scene in part.which)


def orbit(
    problem: Problem,
    cycles: FloatArray,
    rtol: float,
    start: FloatArray,
    start_error: FloatArray,
    deadline: float = np.inf,
) -> Orbit:
    """Count the `cycles` (s,) of each scene from its state `start` (s,), known up to `start_error`
    (s,), to the relative accuracy `rtol`, or until states end."""
    cost = Cost(0, 0)
    todo = [(np.arange(problem.scenes), Request(cycles, start, start_error, deadline))]
    found: list[Segment] = []
    lost: list[IntArray] = []
    for _ in range(MOST_SEGMENTS):
        following = []
        for which, request in todo:
            work = _Work(problem.take(which), request, rtol)
            for rows, counted in work.counts():
                mine, asked = which[rows], request.take(rows)
                begins = cycles[mine] - asked.cycles
                zero = np.zeros(len(rows))
                found.append(Segment(mine, counted, begins, zero, zero))
                if not request.late:
                    lost.append(mine[counted.largest_error > rtol])
                ran = counted.whole_cycles
                ended = counted.at_rest | ~(counted.last_state < NEARLY * counted.limit)
                more = np.flatnonzero(~ended & (ran < asked.cycles) & (ran > 0))
                if len(more) == 0 or request.late:
                    continue
                state, error = counted.after(ran[:, None])
                error = (error * state)[more, 0]
                known = np.isfinite(error)
                lost.append(mine[more[~known]])
                more = more[known]
                if len(more):
                    left = (asked.cycles - ran)[more]
                    onward = Request(left, state[more, 0], error[known], deadline)
                    following.append((mine[more], onward))
            cost = cost.plus(*work.cost)
        todo = following
        if not todo:
            break
    # Where the rate rises steeply, a small error of the count is a large one of the state.
    again = np.unique(np.concatenate(lost)) if lost else np.empty(0, dtype=np.intp)
    if len(again) and rtol > TIGHT:
        tight = orbit(
            problem.take(again), cycles[again], TIGHT, start[again], start_error[again], deadline
        )
        found = [part for part in (_without(segment, again) for segment in found) if part]
        found += [segment._replace(which=again[segment.which]) for segment in tight.segments]
        cost = cost.plus(*tight.cost)
    return Orbit(problem.scenes, tuple(found), cost)


def _without(segment: Segment, scenes: IntArray) -> Segment | None:
    """Return the segment without some scenes, None if none is left."""
    keep = np.flatnonzero(~np.isin(segment.which, scenes))
    if len(keep) == len(segment.which):
        return segment
    return segment.take(keep) if len(keep) else None


class Layout(NamedTuple):
    """Panels, each of a `scene` (panels,)."""

    scene: IntArray
    frame: abel.Frame

    def take(self, rows: IntArray) -> Layout:
        """Return the panels of some scenes, rising, which are counted anew."""
        chosen = np.isin(self.scene, rows)
        return Layout(np.searchsorted(rows, self.scene[chosen]), self.frame.take(chosen))


class _Job(NamedTuple):
    """Scenes `which` with their period maps and transient; how many cycles of it are `needed`; the
    `worst` residual (s,) so far, the right-hand sides `spent` (s,), and panels to begin with, if
    any are known."""

    which: IntArray
    maps: PeriodMap
    transient: Transient
    needed: int
    worst: FloatArray
    spent: FloatArray
    layout: Layout | None = None

    @property
    def key(self) -> tuple[int, int, int, bool]:
        """Return what jobs must have in common to be joined."""
        intervals = self.maps.over.lengths.shape[-1]
        return (intervals, self.transient.cycles, self.needed, self.layout is None)

    def take(self, rows: IntArray, needed: int) -> _Job:
        """Return some of the scenes, that need so many cycles."""
        return _Job(
            self.which[rows],
            self.maps.take(rows),
            self.transient.take(rows),
            needed,
            self.worst[rows],
            self.spent[rows],
        )


class _Work:
    """The counts of one segment of some scenes, found in jobs of scenes that go together."""

    def __init__(self, problem: Problem, request: Request, rtol: float) -> None:
        self.problem, self.request, self.rtol = problem, request, rtol
        self.size = size = settings(rtol, problem.breakpoints)
        self.cost = Cost(0, 0)
        self.scale, self.limit = problem.scale, problem.limit
        self.end = _look_ahead(problem, request)
        begin = request.start + self.scale
        way = np.log1p((self.end - request.start) / begin)
        self.samples = request.start[:, None] + begin[:, None] * np.expm1(way[:, None] * SAMPLES)
        floor = np.max(problem.roundoff(self.samples), axis=1)
        self.tolerance = np.maximum(size.residual_tolerance, floor)
        self.todo: dict[tuple[int, int, int, bool], list[_Job]] = {}

    def counts(self) -> Iterator[tuple[IntArray, Iterates]]:
        """Return groups of scenes with their counts."""
        problem, start = self.problem, self.request.start
        for which, maps in resolved(problem, problem.breakpoints, self.samples, self.size):
            zero, infinite = np.zeros(len(which)), np.full(len(which), np.inf)
            self._add(_Job(which, maps, no_cycle(start[which]), 0, infinite, zero))
        while self.todo:
            jobs = self.todo.pop(min(self.todo))
            job = jobs[0] if len(jobs) == 1 else self._joined(jobs)
            if job.transient.cycles < job.needed:
                yield from self._extended(job)
            else:
                yield from self._on_panels(job)

    def _add(self, job: _Job) -> None:
        if len(job.which):
            self.todo.setdefault(job.key, []).append(job)

    def _joined(self, jobs: list[_Job]) -> _Job:
        """Return jobs with the same key as one."""
        which, worst, spent = (
            np.concatenate(arrays)
            for arrays in zip(*((job.which, job.worst, job.spent) for job in jobs), strict=True)
        )
        edges = [job.maps.over.edges[:, 0] for job in jobs]
        edges = [
            np.repeat(own, len(job.which), 0) if len(own) == 1 else own
            for own, job in zip(edges, jobs, strict=True)
        ]
        m, tolerance = len(jobs[0].maps.over.rule.nodes), jobs[0].maps.tolerance
        maps = period_map(self.problem.take(which), np.concatenate(edges), m, tolerance)
        parts = zip(*(job.transient for job in jobs), strict=True)
        transient = Transient(*(np.concatenate(arrays) for arrays in parts))
        layout = None
        if jobs[0].layout is not None:
            offsets = np.cumsum([0, *(len(job.which) for job in jobs)])
            layouts = [job.layout for job in jobs if job.layout is not None]
            frames = zip(*(own.frame for own in layouts), strict=True)
            layout = Layout(
                np.concatenate([own.scene + at for own, at in zip(layouts, offsets, strict=False)]),
                abel.Frame(*(np.concatenate(arrays) for arrays in frames)),
            )
        return _Job(which, maps, transient, jobs[0].needed, worst, spent, layout)

    def _extended(self, job: _Job) -> Iterator[tuple[IntArray, Iterates]]:
        """Integrate more cycles; return scenes that have come to an end by them."""
        limit, tolerance = self.limit[job.which], self.tolerance[job.which]
        for more in extended(job.maps, job.transient, limit, self.size, tolerance):
            which = job.which[more.which]
            spent = job.spent[more.which] + more.evaluations / len(which)
            self.cost = self.cost.plus(more.increments, more.evaluations)
            fresh = _Job(which, more.maps, more.transient, job.needed, job.worst[more.which], spent)
            late = self.request.late and more.transient.cycles >= BLOCK
            ended = np.full(len(which), late)
            if more.transient.cycles > job.transient.cycles:
                last = more.transient.last
                ended |= more.transient.cycles >= self.request.cycles[which]
                ended |= ~(last < self.limit[which]) | ~(more.transient.last_increment > 0)
            if ended.any():
                yield self._without_panels(fresh, np.flatnonzero(ended))
            self._add(fresh.take(np.flatnonzero(~ended), job.needed))

    def _on_panels(self, job: _Job) -> Iterator[tuple[IntArray, Iterates]]:
        """Solve Abel's equation on panels; return scenes that are counted, and send the others to
        where they are refined."""
        if job.layout is None:
            if job.transient.cycles:
                yield from self._planned(job)
                return
            gentle = self._is_gentle(job)
            self._add(job.take(np.flatnonzero(~gentle), BLOCK))
            job = job.take(np.flatnonzero(gentle), 0)
            if len(job.which) == 0:
                return
            job = job._replace(layout=Layout(np.arange(len(job.which)), self._frame(job)))
        which, number, tolerance = job.which, job.transient.cycles, self.tolerance[job.which]
        widest = np.inf if number else FAR_TOO_WIDE
        assert job.layout is not None
        fine, (scene, frame) = job.maps.finer(self.size), job.layout
        filled = fill(job.maps, fine, scene, frame, self.size, tolerance, widest)
        self.cost = self.cost.plus(filled.increments, filled.evaluations)
        spent = job.spent + filled.evaluations / len(which)
        scene, residual = filled.panels.scene, filled.panels.residual
        worst = np.zeros(len(which))
        np.maximum.at(worst, scene, np.nan_to_num(residual, nan=np.inf))
        marked, good = filled.marked.any(axis=1), worst <= tolerance
        if number == 0:
            good &= self._meets_the_request(job, filled.panels)
        # What rounding leaves no refinement cures.
        accepted = (job.worst <= NEARLY_THERE * tolerance) & ~(worst < job.worst / 2)
        accepted &= number > 0
        accepted |= (spent > MOST_EVALUATIONS) | (marked & job.maps.full)
        accepted |= self.request.late and number > 0
        accepted |= good & ~marked
        finer = np.flatnonzero(marked & ~accepted)
        for group, maps in job.maps.take(finer).refined(filled.marked[finer]) if len(finer) else ():
            rows = finer[group]
            layout = Layout(filled.panels.scene, filled.panels.density.frame).take(rows)
            fresh = job.take(rows, number)._replace(maps=maps, worst=worst[rows], spent=spent[rows])
            self._add(fresh._replace(layout=layout))
        # Panels that can be cut no more: too few cycles lie behind them.
        rest = np.flatnonzero(~accepted & ~marked)
        more = job.take(rest, max(BLOCK, 2 * number))
        self._add(more._replace(worst=worst[rest], spent=spent[rest]))
        yield from self._counted(job, filled.panels.take(accepted[scene]))

    def _frame(self, job: _Job) -> abel.Frame:
        """Return one panel of each scene, as far as it must reach."""
        last, limit = job.transient.last, self.limit[job.which]
        ahead = 10 * BLOCK * job.transient.last_increment if job.transient.cycles else 0.0
        end = np.minimum(np.maximum(self.end[job.which], last + ahead), limit)
        return abel.frame(FRAME_SCALE * self.scale[job.which], last, end)

    def _planned(self, job: _Job) -> Iterator[tuple[IntArray, Iterates]]:
        """Lay out panels that hold enough cycles, as far as there are such; scenes of which the
        first panels do not hold enough get more integrated cycles."""
        number = job.transient.cycles
        scenes = np.arange(len(job.which))
        plan = planned(job.maps, scenes, self._frame(job), self.size)
        # Far beyond the cycles asked for the rate may vanish altogether: there is no density.
        wanted = MARGIN * np.maximum(self.request.cycles[job.which], LEAST)
        plan = plan.take(~_enough_before(plan.cycles / wanted[plan.scene], plan.scene))
        usable = _before_the_first(plan.cycles < self.size.panel_nodes, plan.scene)
        all_usable = np.full(len(scenes), True)
        all_usable[plan.scene[~usable]] = False
        cycles = np.zeros(len(scenes))
        np.add.at(cycles, plan.scene[usable], plan.cycles[usable])
        # Where the rate rises panels become short again, perhaps far ahead.
        ready = all_usable | (cycles > MOST_FIRST - number)
        over = ~ready & ((number >= MOST_FIRST) | self.request.late)
        if over.any():
            yield self._without_panels(job, np.flatnonzero(over))
        self._add(job.take(np.flatnonzero(~ready & ~over), number + BLOCK))
        rows = np.flatnonzero(ready)
        layout = Layout(plan.scene[usable], plan.frame.take(usable)).take(rows)
        self._add(job.take(rows, number)._replace(layout=layout))

    def _meets_the_request(self, job: _Job, panels: SolvedPanels) -> BoolArray:
        """Return whether the estimated error of each scene (s,), where panels meet included, is as
        small as requested."""
        met, order = np.full(len(job.which), True), np.argsort(job.which)
        for rows, counted in self._counted(job, panels):
            place = order[np.searchsorted(job.which, rows, sorter=order)]
            met[place] = counted.largest_error <= self.rtol
        return met

    def _is_gentle(self, job: _Job) -> BoolArray:
        """Return where (s,) a cycle is a small step that changes its own rate little."""
        last, scale = job.transient.last, self.scale[job.which]
        beside = last + APART * (last + scale)
        frozen = job.maps.increment_without_feedback(np.stack([last, beside], axis=1))
        step = np.log1p(frozen[:, 0] / (last + scale))
        change = np.abs(np.log(frozen[:, 1] / frozen[:, 0])) / APART * step
        return (frozen[:, 0] > TINY) & (step <= SMALL) & (change <= SHARP)

    def _without_panels(self, job: _Job, rows: IntArray) -> tuple[IntArray, Iterates]:
        """Return the integrated cycles alone."""
        which, transient = job.which[rows], job.transient.take(rows)
        error = self._transient_error(which, transient)
        none = np.empty((len(rows), 0))
        limit = self.limit[which]
        edges = _edges(job.maps, rows)
        return which, Iterates(transient.states, error, None, None, none, limit, edges)

    def _transient_error(self, which: IntArray, transient: Transient) -> FloatArray:
        """Return the errors (s, k + 1) of the integrated cycles."""
        rounding = self.problem.take(which).roundoff(transient.states)
        start_error = self.request.start_error[which]
        return transient.error(start_error, np.maximum(rounding[:, 1:], rounding[:, :-1]))

    def _counted(self, job: _Job, panels: SolvedPanels) -> Iterator[tuple[IntArray, Iterates]]:
        """Return the counts on panels, scenes with as many panels together."""
        scenes, inverse, counts = np.unique(panels.scene, return_inverse=True, return_counts=True)
        for number in np.unique(counts).tolist():
            rows = scenes[counts == number]
            which, transient = job.which[rows], job.transient.take(rows)
            error = self._transient_error(which, transient)
            some = panels.take(counts[inverse] == number)
            table = cells(some.density, float(transient.cycles), len(rows))
            roundoff = self.problem.take(which).roundoff
            missed = count_error(some, table, roundoff, len(rows))
            missed += error[:, -1:] / table.first_rate.reshape(len(rows), -1)[:, :1]
            counted = Iterates(
                transient.states,
                error,
                table,
                some.density,
                missed,
                self.limit[which],
                _edges(job.maps, rows),
            )
            yield which, counted


def count_error(
    panels: SolvedPanels,
    table: Cells,
    roundoff: Callable[[FloatArray], FloatArray],
    scenes: int,
) -> FloatArray:
    """Return the error (scenes, cells + 1) of n where each cell starts and where the last ends: of
    the density, where panels meet, by rounding."""
    shape = (scenes, -1)
    gain = table.gain.reshape(shape)
    of_panel = gain.size // len(panels.scene)
    lost = SAFETY * np.repeat(panels.residual, of_panel).reshape(shape) * gain
    lost += table.missed.reshape(shape)
    each = len(panels.scene) // scenes
    for k in range(1, each):
        before = panels.density.take(slice(k - 1, None, each))
        after = panels.density.take(slice(k, None, each))
        # It shifts the count at once, and so belongs to what was missed before.
        lost[:, k * of_panel - 1] += SAFETY * abel.matching_defect(before, after)
    u = np.concatenate([table.u.reshape(shape), table.ends.reshape(shape)[:, -1:]], axis=1)
    rounding = roundoff(u)
    terms = ROUNDOFF * np.sum(np.abs(panels.density.series), axis=1)  # of ln(density)
    of_density = np.repeat(terms, of_panel).reshape(shape)
    lost += (np.maximum(rounding[:, 1:], rounding[:, :-1]) + of_density) * gain
    return np.concatenate([np.zeros((scenes, 1)), np.cumsum(lost, axis=1)], axis=1)


def _look_ahead(problem: Problem, request: Request) -> FloatArray:
    """Return the states (s,) that panels must reach: to where the rate, frozen over each cycle,
    puts the cycles, roughly."""
    start, scale, limit = request.start, problem.scale, problem.limit
    begin = (start + scale)[:, None]
    longest = np.minimum(LONGEST, np.log1p((limit - start) / begin[:, 0]))[:, None]
    ahead = longest / STEPS * np.arange(STEPS + 1)
    u = start[:, None] + begin * np.expm1(ahead)
    added = np.empty_like(u)
    for which, edges in by_size(problem.breakpoints):
        maps = period_map(problem.take(which), edges, AHEAD_NODES)
        added[which] = maps.increment_without_feedback(u[which])
    density = -np.log(np.log1p(added / (u + scale[:, None])) + TINY)
    # Between two points the density is taken as exponential in y = ln(u + scale).
    rise = np.diff(density, axis=1)
    rise = np.where(np.abs(rise) < 1e-6, 1e-6, rise)
    first = np.exp(density[:, :-1]) * (longest / STEPS) / rise
    counts = np.cumsum(first * np.expm1(rise), axis=1)
    wanted = MARGIN * np.maximum(request.cycles, LEAST)
    part = np.minimum(np.sum(counts < wanted[:, None], axis=1), STEPS - 1)
    at = (np.arange(len(start)), part)
    missing = wanted - np.where(part > 0, counts[at[0], part - 1], 0.0)
    share = np.log1p(missing / first[at]) / rise[at]
    # Where the states end before the cycles do, the share is no number.
    y = np.fmin(ahead[at] + share * longest[:, 0] / STEPS, longest[:, 0])
    end: FloatArray = start + begin[:, 0] * np.expm1(y)
    return end


def _edges(maps: PeriodMap, rows: IntArray) -> FloatArray:
    """Return the edges (s, q + 1) of the meshes of some scenes."""
    edges = maps.over.edges[:, 0]
    return np.repeat(edges, len(rows), axis=0) if len(edges) == 1 else np.asarray(edges[rows])


def _enough_before(share: FloatArray, scene: IntArray) -> BoolArray:
    """Return before which panels, in order, those of the same scene make up one whole already, of
    which each holds a `share` (panels,)."""
    before = np.concatenate([[0.0], np.cumsum(np.minimum(share, 1.0))[:-1]])
    first = np.searchsorted(scene, scene)  # the first panel of the scene of each
    return np.asarray(before - before[first] >= 1.0)


def _before_the_first(bad: BoolArray, scene: IntArray) -> BoolArray:
    """Return which panels, in order, come before the first `bad` one of their scene."""
    so_far: IntArray = np.cumsum(bad)
    first = np.searchsorted(scene, scene)  # the first panel of the scene of each
    before = so_far[first] - bad[first].astype(int)
    return np.asarray(so_far == before)
