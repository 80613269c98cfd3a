"""Blocks of periodic loads, one after the other: each counted from the wear the last one left."""

from __future__ import annotations

import time

import numpy as np

from wear.count import MOST_CYCLES, Cycles, Wear
from wear.count import cycles_until as until_of_one
from wear.count import wear_after as wear_of_one
from wear.count.cycle import Cost
from wear.direct.sequence import most_cycles, span
from wear.load import AperiodicLoad, Load
from wear.model import Model
from wear.numerics.gauss import (
    FloatArray,
)

PHASES = np.arange(256) / 256  # of a cycle, for its mean rate


def wear_after(
    model: Model,
    load: Load | AperiodicLoad,
    cycles: FloatArray,
    rtol: float,
    deadline: float = np.inf,
) -> Wear:
    """Wear u_c after whole numbers of cycles (n,) of a load that repeats or consists of blocks.

    An error that a block starts with is carried on, in proportion to the wear rate where that
    grows: two solutions of one equation keep their distance in time. After the `deadline`
    (`time.monotonic()`) nothing is refined and no other block begun; wear in a block that was not
    begun is no number, with an infinite error.
    """
    cycles = np.asarray(cycles, dtype=float)
    last = float(np.max(cycles, initial=0.0))
    u, error = np.full(cycles.shape, np.nan), np.full(cycles.shape, np.inf)
    start, missed, done, cost = 0.0, 0.0, 0, Cost(0, 0)
    notices: list[str] = []
    while True:
        acting, until = span(load, done)
        end = min(float(until), last)
        here = (cycles >= done) & (cycles <= end)
        wanted = np.append(cycles[here], end) - done
        found = wear_of_one(model, acting, wanted, rtol, start, deadline)
        absolute = found.error * found.u_c
        if missed:
            absolute += missed * growth(model, acting, start, float(found.u_c[-1]))
        u[here] = found.u_c[:-1]
        error[here] = (absolute / np.where(found.u_c > 0, found.u_c, 1.0))[:-1]
        start, missed = float(found.u_c[-1]), float(absolute[-1])
        cost = cost.plus(*found.cost)
        notices += [_since(text, done) for text in found.notices]
        if end >= last or not missed < np.inf or time.monotonic() > deadline:
            return Wear(u, error, cost, tuple(dict.fromkeys(notices)))
        done = until


def cycles_until(model: Model, load: Load | AperiodicLoad, wear: FloatArray, rtol: float) -> Cycles:
    """Whole cycles after which each wear u_c (mm, (n,)) is first reached, infinite where it is not
    within the load or 1e12 cycles, and the estimated relative error of their number.

    What a block reaches but for the estimated error counts as reached. If it did not, a block after
    it does, at its own pace: that the error tells too.
    """
    wear = np.asarray(wear, dtype=float)
    count, error = np.full(wear.shape, np.inf), np.zeros(wear.shape)
    start, missed, done, cost = 0.0, 0.0, 0, Cost(0, 0)
    most = min(MOST_CYCLES, float(most_cycles(load)))
    doubtful = np.full(wear.shape, False)
    while (np.isinf(count) | doubtful).any() and done < most:
        acting, until = span(load, done)
        length = min(float(until), most) - done
        still = np.isinf(count)
        if doubtful.any():
            late = until_of_one(
                model, acting, wear[doubtful], rtol, max(start - missed, 0.0), length
            )
            largest = done + late.cycles * (1.0 + late.error)
            known = np.where(np.isfinite(largest), largest / count[doubtful] - 1.0, 0.0)
            error[doubtful] = np.maximum(error[doubtful], known)
            doubtful[doubtful] = np.isinf(largest)
            cost = cost.plus(*late.cost)
        found = until_of_one(model, acting, wear[still], rtol, start, length, missed)
        count[still] = done + found.cycles
        own = np.where(np.isfinite(found.cycles), found.cycles, 0.0)  # what the error refers to
        error[still] = found.error * np.maximum(own, 1.0) / np.maximum(done + own, 1.0)
        cost = cost.plus(*found.cost)
        if until < most:
            ended = wear_of_one(model, acting, np.array([length]), rtol, start)
            begun, start = start, float(ended.u_c[0])
            missed *= growth(model, acting, begun, start)
            missed += float(ended.error[0]) * start
            doubtful = np.isfinite(count) & (wear > start - missed)
        done = until
    error[doubtful] = np.inf
    return Cycles(count, error, cost)


def growth(model: Model, load: Load, start: float, end: float) -> float:
    """By how much a small difference in wear grows between `start` and `end`; at least 1."""
    U_a = load(PHASES)
    before, after = (float(np.mean(model.rate(u, U_a))) for u in (start, end))
    return max(1.0, after / before) if before > 0.0 else 1.0


def _since(notice: str, done: int) -> str:
    """A notice of one block, whose cycles are counted from its start."""
    return f"in the block after {done} cycles: {notice}" if done else notice
