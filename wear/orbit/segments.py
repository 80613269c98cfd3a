"""Orbits of many scenes: segments, each solved by Abel's equation from the end of the one before.

Overview
    A segment begins with cycles that are integrated, if the state changes its own rate much within
    a cycle; panels follow as far as each holds many cycles. Where the density gets sharp again
    farther on, the next segment begins there.
Key results
    orbit      all segments of all scenes
    Orbit      the states after any numbers of cycles, the cycles to any states
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, Protocol

import numpy as np

from wear.numerics.floating_point import TINY
from wear.numerics.gauss import BoolArray, FloatArray, IntArray
from wear.numerics.rows import take
from wear.orbit.batches import Batches
from wear.orbit.iterates import NEARLY, Iterates
from wear.orbit.problem import Cost, Problem, Request, most_evaluations

MOST_SEGMENTS = 40  # of a scene
TIGHT = 1e-12  # relative accuracy of a second try, where the rate rises steeply


class AnyIterates(Protocol):
    """States of some scenes (s,) after any numbers of cycles."""

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

    def take(self, rows: IntArray) -> AnyIterates: ...

    def after(self, cycles: FloatArray) -> tuple[FloatArray, FloatArray]: ...

    def until(self, u: FloatArray) -> tuple[FloatArray, FloatArray]: ...


class Segment(NamedTuple):
    """The iterates of the scenes `which` (s,) from `begins` (s,) cycles on, a number with the error
    `begins_error` (s,); `start_error` (s,) is the error of the initial state."""

    which: IntArray
    iterates: AnyIterates
    begins: FloatArray
    start_error: FloatArray
    begins_error: FloatArray

    def take(self, rows: IntArray) -> Segment:
        """Return some of the scenes."""
        return Segment(
            self.which[rows],
            self.iterates.take(rows),
            self.begins[rows],
            self.start_error[rows],
            self.begins_error[rows],
        )

    @property
    def count_uncertainty(self) -> FloatArray:
        """Return the error of the number of cycles (s,) at its start."""
        rate = self.iterates.first_increment
        return self.begins_error + np.where(
            rate > 0, self.start_error / np.where(rate > 0, rate, 1.0), 0.0
        )


class Orbit(NamedTuple):
    """All `segments` of some scenes, in rising order for each, and their cost."""

    scenes: int
    segments: tuple[Segment, ...]
    cost: Cost

    def after(self, cycles: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the states after `cycles` (s, c) and their estimated relative errors, infinite
        where out of reach."""
        u, error = np.full(cycles.shape, np.nan), np.full(cycles.shape, np.inf)
        found = np.full(cycles.shape, False)
        for segment in reversed(self.segments):
            since = cycles[segment.which] - segment.begins[:, None]
            here = (since >= 0) & ~found[segment.which]
            if not here.any():
                continue
            state, relative = segment.iterates.after(np.maximum(since, 0.0))
            relative = relative + segment.start_error[:, None] / (state + TINY)
            relative[np.isnan(relative)] = np.inf
            u[segment.which] = np.where(here, state, u[segment.which])
            error[segment.which] = np.where(here, relative, error[segment.which])
            found[segment.which] |= here
        return u, error

    def until(self, u: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the whole cycles after which each state (s, c) is first reached, infinite where
        it is not, and the estimated error in cycles."""
        count, error = np.full(u.shape, np.inf), np.zeros(u.shape)
        for segment in reversed(self.segments):
            after, uncertain = segment.iterates.until(u[segment.which])
            here = np.isfinite(after)
            after = after + segment.begins[:, None]
            uncertain = uncertain + segment.count_uncertainty[:, None]
            count[segment.which] = np.where(here, after, count[segment.which])
            error[segment.which] = np.where(here, uncertain, error[segment.which])
        return count, error

    @property
    def at_rest(self) -> BoolArray:
        """Return which scenes (s,) have come to rest."""
        at_rest = np.full(self.scenes, False)
        for segment in self.segments:
            at_rest[segment.which] = segment.iterates.at_rest
        return at_rest

    def last(self, scene: int) -> Segment:
        """Return the last segment of a scene, alone."""
        return next(segment for segment in reversed(self.segments) if scene in segment.which)


def orbit(
    problem: Problem,
    cycles: FloatArray,
    rtol: float,
    start: FloatArray,
    start_error: FloatArray,
    deadline: float = np.inf,
    keep: bool = False,
) -> Orbit:
    """Return the orbits of all scenes over `cycles` (s,), or until states end, from the states
    `start` (s,), known up to `start_error` (s,), to the relative accuracy `rtol`; `keep` the cycles
    of panels, for derivatives."""
    request = Request(cycles, start, start_error, deadline)
    segments, again, cost = _segments(problem, request, rtol, keep)
    more = cost.rhs_evaluations <= np.sum(most_evaluations(problem))
    # Where the rate rises steeply, a small error of the count is a large one of the state.
    if len(again) and rtol > TIGHT and more:
        own = cycles[again], TIGHT, start[again], start_error[again], deadline, keep
        tight = orbit(problem.take(again), *own)
        others = [_without(segment, again) for segment in segments]
        segments = [segment for segment in others if segment]
        segments += [segment._replace(which=again[segment.which]) for segment in tight.segments]
        cost = cost.plus(*tight.cost)
    return Orbit(problem.scenes, tuple(segments), cost)


def _segments(
    problem: Problem, request: Request, rtol: float, keep: bool
) -> tuple[list[Segment], IntArray, Cost]:
    """Return the segments of all scenes, the scenes of which some states miss the accuracy `rtol`,
    and the cost."""
    cost, segments, inaccurate = Cost(0, 0), list[Segment](), [np.empty(0, dtype=np.intp)]
    cycles, todo = request.cycles, [(np.arange(problem.scenes), request)]
    most = np.sum(most_evaluations(problem))
    for _ in range(MOST_SEGMENTS):
        following = []
        for which, asked in todo:
            batches = Batches(problem.take(which), asked, rtol, keep)
            for rows, iterates in batches.counts():
                scenes, remaining = which[rows], take(asked, rows)
                begins = cycles[scenes] - remaining.cycles
                zero = np.zeros(len(rows))
                segments.append(Segment(scenes, iterates, begins, zero, zero))
                if not request.late:
                    inaccurate.append(scenes[iterates.largest_error > rtol])
                ran = iterates.whole_cycles
                ended = iterates.at_rest | ~(iterates.last_state < NEARLY * iterates.limit)
                more = np.flatnonzero(~ended & (ran < remaining.cycles) & (ran > 0))
                if len(more) == 0 or request.late:
                    continue
                state, error = iterates.after(ran[:, None])
                error = (error * state)[more, 0]
                known = np.isfinite(error)
                inaccurate.append(scenes[more[~known]])
                more = more[known]
                if len(more):
                    left = (remaining.cycles - ran)[more], state[more, 0], error[known]
                    following.append((scenes[more], Request(*left, request.deadline)))
            cost = cost.plus(*batches.cost)
        todo = following
        if not todo or cost.rhs_evaluations > most:
            break
    return segments, np.unique(np.concatenate(inaccurate)), cost


def single_cycle(states: FloatArray, error: FloatArray, edges: FloatArray) -> Orbit:
    """Return the orbit of one cycle of a scene with known `states` (2,) before and after, and their
    `error`; the mesh of phase has `edges` (q + 1,)."""
    zero, limit = np.zeros(1), np.full(1, np.inf)
    none = np.empty((1, 0))
    cycle = Iterates(states[None], error[None], None, None, none, limit, edges[None])
    return Orbit(1, (Segment(np.zeros(1, dtype=np.intp), cycle, zero, zero, zero),), Cost(0, 0))


def joined(orbits: Sequence[Orbit]) -> Orbit:
    """Return the orbits of one scene each as that of all of them."""
    segments = [
        segment._replace(which=segment.which + i)
        for i, orbit in enumerate(orbits)
        for segment in orbit.segments
    ]
    cost = Cost(*np.sum([orbit.cost for orbit in orbits], axis=0).tolist())
    return Orbit(len(orbits), tuple(segments), cost)


def _without(segment: Segment, scenes: IntArray) -> Segment | None:
    """Return the segment without some scenes, None if none is left."""
    keep = np.flatnonzero(~np.isin(segment.which, scenes))
    if len(keep) == len(segment.which):
        return segment
    return segment.take(keep) if len(keep) else None
