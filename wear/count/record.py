"""The wear along a measured history, part after part.

A part is as many lines as the iteration takes at once (`wear.count.lines`): half as many where it
fails, and half a line where it fails on one; twice as many where it is easy.
"""

import math
import time
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from wear.count.cycle import Cost
from wear.count.lines import MOST_LINES, Lines, integrated
from wear.count.scan import roughness_limit, roughness_scale
from wear.faults import AccuracyError
from wear.load import HistoryLoad
from wear.model import Model
from wear.numerics.gauss import (
    FloatArray,
)
from wear.numerics.tolerances import (
    ROUNDOFF,
)

FIRST_LINES = 64  # at once
SHORTEST = 1e-12  # part of a line, of the longest
NEARLY = 0.9  # of the wear at which the roughness vanishes
STRICTER = 0.01  # tolerance on lines, over the requested accuracy


class Followed(NamedTuple):
    """Wear `u` (mm) after those `cycles` that were reached, in rising order, its estimated relative
    `error`, and what it cost. `stopped` says why cycles are missing (None: none are) and
    `interrupted` whether that was the user or the clock."""

    cycles: tuple[int, ...]
    u: FloatArray
    error: FloatArray
    cost: Cost
    stopped: str | None
    interrupted: bool


@np.errstate(all="ignore")  # trial states far off the solution may overflow
def follow(
    model: Model,
    load: HistoryLoad,
    cycles: Sequence[int],
    rtol: float,
    deadline: float = np.inf,
) -> Followed:
    """Wear after whole numbers of `cycles`, in any order, along a history, without cutoff.

    After the `deadline` (`time.monotonic()`) or on Ctrl-C the cycles reached by then are kept.
    """
    marks = tuple(sorted(set(cycles)))
    lines = lines_of(load, marks)
    u, error = ([0.0], [0.0]) if lines.marked[0] else ([], [])
    evaluations, stopped, interrupted = 0, None, False
    try:
        for part in _parts(model, lines, STRICTER * rtol, deadline):
            u += part.wear.tolist()
            error += part.error.tolist()
            evaluations += part.evaluations
    except TimeoutError:
        stopped, interrupted = "the time limit has passed", True
    except KeyboardInterrupt:
        stopped, interrupted = "interrupted", True
    except AccuracyError as end:
        stopped = str(end)
    reached, wear = marks[: len(u)], np.array(u)
    relative = np.where(wear > 0.0, np.array(error) / wear + ROUNDOFF, 0.0)
    cost = Cost(2 * max(reached, default=0), evaluations)
    return Followed(reached, wear, relative, cost, stopped, interrupted)


def lines_of(load: HistoryLoad, marks: Sequence[int]) -> Lines:
    """The lines of a history up to the last of the `marks`, cycles in rising order."""
    ends = np.array([load.time_at(mark) for mark in marks])
    times = np.union1d(np.append(load.breakpoints(0.0, ends[-1]), 0.0), ends)
    return Lines(np.diff(times), load.value(times), np.isin(times, ends))


class Part(NamedTuple):
    """The `wear` (mm) and its estimated `error` (mm) at those ends of some lines where they are
    asked for, and the right-hand sides evaluated since the part before."""

    wear: FloatArray
    error: FloatArray
    evaluations: int


def _parts(model: Model, lines: Lines, tolerance: float, deadline: float) -> Iterator[Part]:
    """Part after part of the lines, each as long as the iteration permits.

    Raises
    ------
    TimeoutError
        after the deadline.
    AccuracyError
        where the lines cannot be followed any further.
    """
    limit = roughness_limit(model, 1e12 * roughness_scale(model))
    shortest = SHORTEST * np.max(lines.lengths, initial=0.0)
    todo, size = [lines] if len(lines.lengths) else [], FIRST_LINES
    added, error, evaluations = [0.0], 0.0, 0
    while todo:
        if time.monotonic() > deadline:
            raise TimeoutError
        now, start = todo.pop(), math.fsum(added)
        if len(now.lengths) > size:
            now, rest = now.parted(size)
            todo.append(rest)
        tried = integrated(model, now, start, tolerance, limit)
        evaluations += tried.evaluations
        if tried.along is None:
            size = max(1, len(now.lengths) // 2)
            if len(now.lengths) == 1:
                if now.lengths[0] <= shortest:
                    raise AccuracyError(_why(start, limit))
                now = now.cut(np.array([True]))
            todo.append(now)
            continue
        along = tried.along
        errors = error * along.growth + along.error
        yield Part(start + along.wear[along.marked], errors[along.marked], evaluations)
        added.append(float(along.wear[-1]))
        error, evaluations = float(errors[-1]), 0
        if along.easy:
            size = min(2 * size, MOST_LINES)


def _why(wear: float, limit: float) -> str:
    """What there is to say where the lines cannot be followed any further than to a `wear` (mm)."""
    if wear > NEARLY * limit:
        return f"the roughness vanishes near u_c = {limit:.4g} mm: the model ends"
    return f"the wear could not be followed beyond u_c = {wear:.6g} mm"
