"""The cycle count in stages: with a cutoff between the wears at which contact grazes.

Where the edge of contact passes a turning point of the load, or the phase at which cycles begin,
the one-cycle map has a kink, and where it passes the highest point wear ends. No panel may hold a
kink: panels end shortly before it, a few exact cycles lead across, and the count begins anew. A
stage counts from its own start.
"""

import time
from typing import NamedTuple

import numpy as np

from wear.count.build import CycleCount, cycle_count, cycle_count_upto, evaluate, exact_error
from wear.count.cutoff import CutoffCycle, one_cycle
from wear.count.cycle import Cost, OneCycle, Settings, settings
from wear.count.first import exact_cycles
from wear.count.kinks import fades, kinks, rest_of
from wear.count.panels import NONE, Maps
from wear.count.scan import roughness_limit, roughness_scale
from wear.count.stage import Leap, Stage, Stages
from wear.count.tail import Rest, Tail, begins_at, tail
from wear.load import Load
from wear.model import Model
from wear.numerics.gauss import (
    FloatArray,
    mesh,
)
from wear.numerics.tolerances import (
    ROUNDOFF,
    TINY,
)

AHEAD = 30.0  # cycles before a kink that are integrated one by one
AHEAD_ON_SUPPORT = 8.0  # the same on a compliant support, where the rate is continuous
GRAIN = 1e6  # roundoffs of the wear that the way to a kink may shrink to
NEAR_REST = 0.1  # of the wear that changes the pressure: where a tail may begin
MOST_STAGES = 40
TIGHT = 1e-12


@np.errstate(all="ignore")
def counted_stages(
    model: Model,
    load: Load,
    cycles: float,
    rtol: float,
    start: float,
    deadline: float = np.inf,
    begun_with: float = 0.0,
) -> Stages:
    """Count from the wear `start` (mm), known up to `begun_with`, up to `cycles`, or until wear
    ends.

    After the `deadline` (`time.monotonic()`) no other stage is begun.
    """
    cycle = one_cycle(model, load)
    if not isinstance(cycle, CutoffCycle):
        return _smooth_stages(model, load, cycles, rtol, start, deadline, begun_with)
    way, cost = _way(cycle, rtol, deadline), Cost(0, 0)
    done: list[Stage] = []
    now = Now(0.0, start, begun_with, 0.0)
    while len(done) < MOST_STAGES:
        stage = _next_stage(way, now, cycles - now.cycles)
        done.append(stage)
        cost = cost.plus(*stage.counted.cost)
        beyond = stage.begins + stage.ran
        last = stage.counted.last_wear
        if stage.ends or beyond >= cycles:
            # A tail is known to its very end, whether or not that is asked for.
            ended = stage.ends and not (isinstance(stage.counted, Tail) and beyond > cycles)
            rest = rest_of(model, load, last)
            at_rest = rest.blur / last if rest else np.inf
            return Stages(tuple(done), ended, at_rest, cost)
        after, relative = stage.wear_after(np.array([beyond]))
        now = Now(beyond, float(after[0]), float(relative[0] * after[0]), stage.drift)
        if not now.missed < np.inf or time.monotonic() > deadline:
            break
    return Stages(tuple(done), False, np.inf, cost)


class Now(NamedTuple):
    """How far the count has come: after `cycles`, give or take `adrift`, with the `wear` known up
    to `missed`, in mm."""

    cycles: float
    wear: float
    missed: float
    adrift: float

    def stage(self, counted: CycleCount | Tail | Leap) -> Stage:
        """The stage from here on."""
        return Stage(self.cycles, counted, self.missed, self.adrift)


class Way(NamedTuple):
    """What is ahead of a count with cutoff: the `kinks` (mm), rising; the `rest`, the last of them,
    if wear fades there; the wear `end` (mm) beyond which nothing has a meaning."""

    exact: CutoffCycle
    kinks: FloatArray
    rest: Rest | None
    end: float
    shift: float
    rtol: float
    deadline: float

    @property
    def size(self) -> Settings:
        return settings(self.rtol)


def _way(cycle: CutoffCycle, rtol: float, deadline: float) -> Way:
    """What is ahead, with a map of a cycle that suits the accuracy `rtol`."""
    model, load, size = cycle.model, cycle.load, settings(rtol)
    shift = roughness_scale(model)
    grazing = kinks(cycle, shift)
    rest = rest_of(model, load, float(grazing[-1])) if len(grazing) else None
    if rest is not None and not fades(cycle, rest.wear):
        rest = None
    end = roughness_limit(model, 1e12 * shift)
    exact = cycle.resolved(NONE, size)
    return Way(exact, grazing, rest, end, shift, rtol, deadline)


def _next_stage(way: Way, now: Now, cycles: float) -> Stage:
    """The stage from `now` on, for `cycles` more: on panels towards the next kink, or near it."""
    wear = now.wear
    target = min((kink for kink in way.kinks if kink > wear * (1 + 8 * ROUNDOFF)), default=way.end)
    if way.rest is not None and target == way.rest.wear:
        limit = way.rest.wear - NEAR_REST * way.shift
        if wear >= limit:
            towards = _towards(way, way.rest, wear, cycles)
            return now.stage(towards or _one_by_one(way, wear, wear, cycles))
        target = limit
    else:
        limit = _panels_until(way.exact, wear, target) if target < way.end else way.end
        left = _too_near(way.exact, wear, target)
        if left > _ahead(way.exact):
            return now.stage(Leap(wear, float(target), float(np.floor(left))))
    counted = _on_panels(way, wear, limit, cycles) if limit > wear else None
    return now.stage(counted or _one_by_one(way, wear, target, cycles))


def _on_panels(way: Way, wear: float, limit: float, cycles: float) -> CycleCount | None:
    """The count on panels up to the wear `limit` (mm); None if cycles are too long for them."""
    model, load = way.exact.model, way.exact.load
    counted = cycle_count_upto(
        way.exact, model, load, cycles, way.rtol, wear, limit, deadline=way.deadline
    )
    if counted.table is None:
        # What passes the limit is not counted.
        known = int(np.sum(np.isfinite(counted.first_error)))
        if known < 2:
            return None
        first, error = counted.first[:known], counted.first_error[:known]
        counted = counted._replace(first=first, first_error=error)
    return counted._replace(limit=way.end)


def _one_by_one(way: Way, wear: float, target: float, cycles: float) -> CycleCount:
    """Cycle after cycle until the wear passes the `target` (mm)."""
    run = exact_cycles(way.exact, wear, target, cycles, way.size)
    error = exact_error(way.exact.model, way.exact.load, run)
    return CycleCount(run.wear, error, None, None, NONE, run.over, way.end, run.cost)


def _towards(way: Way, rest: Rest, wear: float, cycles: float) -> CycleCount | Tail | None:
    """The count near the `rest`: a tail, or the cycles before it; None if it cannot be solved."""
    begin = begins_at(way.exact, rest, wear)
    if begin > wear * (1 + 8 * ROUNDOFF):
        return _one_by_one(way, wear, begin, cycles)
    finer = way.exact.on(mesh(way.exact.over.edges, way.size.finer_nodes))
    both = Maps(way.exact, finer)
    return tail(both, way.exact.model, way.exact.load, rest, wear, way.size)


def _smooth_stages(
    model: Model,
    load: Load,
    cycles: float,
    rtol: float,
    start: float,
    deadline: float,
    begun_with: float,
) -> Stages:
    """Stages without a cutoff: one does, unless wear gathers pace so much that a panel would hold
    too few cycles; these are integrated, and the count begins anew."""
    done: list[Stage] = []
    begins, wear, missed, cost = 0.0, start, begun_with, Cost(0, 0)
    while True:
        counted = cycle_count(model, load, cycles - begins, rtol, wear, missed, deadline)
        done.append(Stage(begins, counted, 0.0))
        cost = cost.plus(*counted.cost)
        ran = done[-1].ran
        ends = counted.rests or not counted.last_wear < (1 - 1e-9) * counted.limit
        if (
            ends
            or begins + ran >= cycles
            or len(done) == MOST_STAGES
            or time.monotonic() > deadline
        ):
            return Stages(tuple(done), counted.rests, np.inf, cost)
        after, relative = evaluate(counted, np.array([ran]))
        begins, wear = begins + ran, float(after[0])
        missed = float(relative[0]) * wear
        if not missed < np.inf and rtol > TIGHT:
            # Where wear takes off, a small error of the count is a large one of the wear.
            again = _smooth_stages(model, load, cycles, TIGHT, start, deadline, begun_with)
            return again._replace(cost=again.cost.plus(*cost))
        if not missed < np.inf:
            return Stages(tuple(done), False, np.inf, cost)


def _ahead(cycle: CutoffCycle) -> float:
    return AHEAD_ON_SUPPORT if cycle.model.compliant else AHEAD


def _panels_until(cycle: CutoffCycle, wear: float, target: float) -> float:
    """The wear (mm) from which so many cycles lead to `target` as are integrated before a kink,
    roughly, or from which on double precision tells too little; `wear` if none does."""
    before: FloatArray = (target - wear) * 0.5 ** np.arange(1.0, 60.0)
    near = before < _ahead(cycle) * cycle.frozen(target - before)
    near |= before < GRAIN * ROUNDOFF * target
    first = int(np.argmax(near))
    return float(target - before[first - 1]) if first else wear


def _too_near(cycle: OneCycle, wear: float, target: float) -> float:
    """Cycles (roughly) that are left to `target`, if wear is so near that roundoff rules; else 0.

    Contact shrinks like the square root of what is left, so that this takes twice the cycles that
    it would at the present pace.
    """
    if not 0.0 < target - wear < 4 * GRAIN * ROUNDOFF * target:
        return 0.0
    return float(2 * (target - wear) / (cycle.frozen(np.array([wear]))[0] + TINY))
