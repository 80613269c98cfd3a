"""The cycle count with a cutoff: stages between the wears at which contact grazes.

Where the edge of contact passes a turning point of the load, or the phase at which cycles begin,
the one-cycle map has a kink, and where it passes the highest point wear stops for good. No panel
may hold a kink: panels end shortly before it, a few exact cycles lead across, and the count begins
anew. A stage counts from its own start.
"""

import time
from typing import NamedTuple

import numpy as np

from wear.count.build import CycleCount, cycle_count, cycle_count_upto, evaluate, exact_error
from wear.count.collocation import FloatArray
from wear.count.cutoff import TOUCH, CutoffCycle, one_cycle, touch
from wear.count.cycle import ROUNDOFF, TINY, Cost, OneCycle, settings
from wear.count.first import exact_cycles
from wear.count.panels import NONE
from wear.count.scan import roughness_limit, roughness_scale
from wear.load import Load
from wear.model import Model

AHEAD = 30.0  # cycles before a kink that are integrated one by one
GRAIN = 1e6  # roundoffs of the wear that the way to a kink may shrink to
MOST_STAGES = 40


class Stage(NamedTuple):
    """A count from `begins` cycles on, give or take `adrift`, with the error (mm) of the wear that
    it begins with."""

    begins: float
    counted: CycleCount
    inherited: float
    adrift: float = 0.0

    @property
    def blur(self) -> float:
        """By how many cycles its count may be out."""
        pace = self.counted.pace
        return self.adrift + (self.inherited / pace if pace > 0 else 0.0)


class Arrest(NamedTuple):
    """The `cycle`, counted from 1, in which wear stops for good, give or take some."""

    cycle: int
    uncertain: int

    def __str__(self) -> str:
        spread = f", give or take {self.uncertain}" if self.uncertain else ""
        return f"wear stops for good in cycle {self.cycle}{spread}"


class Stages(NamedTuple):
    """All stages, in order, and whether wear has stopped for good after the last one; it is then
    known up to the relative error `at_rest`, whatever the error of the cycles before."""

    stages: tuple[Stage, ...]
    arrested: bool
    at_rest: float
    cost: Cost

    @property
    def last_wear(self) -> float:
        """The wear (mm) up to which it counts."""
        return self.stages[-1].counted.last_wear

    @property
    def arrest(self) -> Arrest | None:
        """When wear stops, if it does within the cycles counted and their error is known."""
        last = self.stages[-1]
        known = np.isfinite(last.inherited) and np.isfinite(last.counted.first_error).all()
        # A stage that begins at rest does not tell how long it took to get there.
        moving = [stage.blur for stage in self.stages if stage.counted.pace > 0]
        blur = max([last.blur, *moving[-1:]])
        if not (self.arrested and known and np.isfinite(blur)):
            return None
        idle = int(np.argmax(np.diff(last.counted.first) <= 0))
        return Arrest(int(last.begins) + idle, round(blur))


def kinks(cycle: OneCycle, shift: float) -> FloatArray:
    """Wear (mm) at which the edge of contact passes an end of a piece, rising.

    Where the margin is hardly more than its own rounding, the map does not feel the kink.
    """
    if not isinstance(cycle, CutoffCycle):
        return NONE
    wear = shift * np.expm1(np.linspace(0.0, 40.0, 400))
    blur = touch(cycle.model, cycle.load, wear)
    found = []
    for height in cycle.edge.heights:
        margin = cycle.model.margin(wear, np.full_like(wear, height))
        told = np.abs(margin) > blur
        crossed = np.sign(margin[:-1]) * np.sign(margin[1:]) < 0
        for i in np.flatnonzero(crossed & (told[:-1] | told[1:])):
            found.append(_root(cycle, wear[i], wear[i + 1], float(height)))
    return np.array(sorted(kink for kink in found if kink > TOUCH * ROUNDOFF * shift))


def _root(cycle: CutoffCycle, low: float, high: float, height: float) -> float:
    """The wear between `low` and `high` at which the margin vanishes, by bisection."""

    def inside(wear: float) -> bool:
        return bool(cycle.model.margin(np.array(wear), np.array(height)) > 0.0)

    contact = inside(low)
    while low < (middle := (low + high) / 2) < high:
        low, high = (middle, high) if inside(middle) == contact else (low, middle)
    return low if contact else high


@np.errstate(all="ignore")
def counted_stages(
    model: Model, load: Load, cycles: float, rtol: float, start: float, deadline: float = np.inf
) -> Stages:
    """Count from the wear `start` (mm) up to `cycles`, or until wear stops.

    After the `deadline` (`time.monotonic()`) no other stage is begun.
    """
    if not model.cutoff:
        return _smooth_stages(model, load, cycles, rtol, start, deadline)
    cycle = one_cycle(model, load)
    shift = roughness_scale(model)
    end = roughness_limit(model, 1e12 * shift)
    targets = kinks(cycle, shift)
    size = settings(rtol)
    exact = cycle.resolved(NONE, size.phase_nodes, size.phase_tolerance)
    done: list[Stage] = []
    begins, wear, inherited, adrift, cost = 0.0, start, 0.0, 0.0, Cost(0, 0)
    while len(done) < MOST_STAGES:
        target = min((kink for kink in targets if kink > wear * (1 + 8 * ROUNDOFF)), default=end)
        limit = _panels_until(exact, wear, target) if target < end else end
        left = _too_near(exact, wear, target)
        if left > AHEAD:
            # Double precision cannot tell the steps that are left to the kink.
            counted = CycleCount(
                np.array([wear]), np.zeros(1), None, None, NONE, exact.over, end, Cost(0, 0)
            )
            inherited, adrift = inherited + target - wear, adrift + left
            done.append(Stage(begins, counted, inherited, adrift))
            begins, wear = begins + np.floor(left), float(target)
            if begins >= cycles:
                break
            continue
        if limit > wear:
            counted = cycle_count_upto(
                exact, model, load, cycles - begins, rtol, wear, limit, deadline=deadline
            )
        else:
            run = exact_cycles(exact, wear, target, cycles - begins, size)
            error = exact_error(model, load, run)
            counted = CycleCount(run.wear, error, None, None, NONE, run.over, end, run.cost)
        counted = counted._replace(limit=end)
        done.append(Stage(begins, counted, inherited, adrift))
        cost = cost.plus(*counted.cost)
        ran = _ran(counted)
        arrested = counted.table is None and not np.sum(np.diff(counted.first)[-1:]) > 0
        if arrested or begins + ran >= cycles:
            return Stages(tuple(done), arrested, rest_error(model, load, counted.last_wear), cost)
        after, relative = evaluate(counted, np.array([ran]))
        begins, wear = begins + ran, float(after[0])
        inherited += float(relative[0]) * wear
        if time.monotonic() > deadline:
            break
    return Stages(tuple(done), False, np.inf, cost)


def _smooth_stages(
    model: Model, load: Load, cycles: float, rtol: float, start: float, deadline: float
) -> Stages:
    """Stages without a cutoff: one does, unless wear gathers pace so much that a panel would hold
    too few cycles; these are integrated, and the count begins anew."""
    done: list[Stage] = []
    begins, wear, missed, cost = 0.0, start, 0.0, Cost(0, 0)
    while True:
        counted = cycle_count(model, load, cycles - begins, rtol, wear, missed, deadline)
        done.append(Stage(begins, counted, 0.0))
        cost = cost.plus(*counted.cost)
        ran = _ran(counted)
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
        if not missed < np.inf:
            return Stages(tuple(done), False, np.inf, cost)


def rest_error(model: Model, load: Load, wear: float) -> float:
    """Relative error of the wear (mm) at which the peak of the load just fails to make contact:
    that of a root of the margin. Infinite if this is not such a wear."""
    peak, worn = np.array(load.maximum), np.array(wear)
    blur = ROUNDOFF * float(model.margin_terms(worn, peak))
    left = abs(float(model.margin(worn, peak)))
    if wear <= 0 or left > TOUCH * blur:
        return np.inf
    return (left + blur) / (abs(float(model.margin_slope(worn, peak))) + TINY) / wear


def _ran(counted: CycleCount) -> float:
    """How many whole cycles a count covers."""
    if counted.table is None:
        return float(len(counted.first) - 1)
    return float(np.floor(counted.table.last_cycles))


def _panels_until(cycle: OneCycle, wear: float, target: float) -> float:
    """The wear (mm) from which AHEAD cycles lead to `target`, roughly, or from which on double
    precision tells too little; `wear` if none does."""
    before: FloatArray = (target - wear) * 0.5 ** np.arange(1.0, 60.0)
    near = (before < AHEAD * cycle.frozen(target - before)) | (before < GRAIN * ROUNDOFF * target)
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


def evaluate_stages(found: Stages, cycles: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Wear (mm) after `cycles` and its estimated relative error, infinite where out of reach."""
    wear, error = np.zeros(cycles.shape), np.zeros(cycles.shape)
    begins = np.array([stage.begins for stage in found.stages])
    which = np.maximum(np.searchsorted(begins, cycles, side="right") - 1, 0)
    for i, stage in enumerate(found.stages):
        mine = which == i
        if mine.any():
            u, relative = evaluate(stage.counted, cycles[mine] - stage.begins)
            wear[mine] = u
            error[mine] = relative + stage.inherited / (u + TINY)
    last = found.stages[-1]
    if found.arrest is not None:
        rests = cycles >= found.arrest.cycle + 2 * found.arrest.uncertain
        error[rests] = found.at_rest if np.isfinite(found.at_rest) else error[rests]
    else:
        error[cycles > last.begins + _ran(last.counted) + 1.0] = np.inf
    return wear, error
