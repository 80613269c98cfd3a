"""The first cycles, integrated one by one: until a panel spans many cycles."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from wear.numerics.floating_point import ROUNDOFF
from wear.numerics.gauss import FloatArray, IntArray
from wear.numerics.rows import take
from wear.orbit.period_map import PeriodMap, Settings
from wear.orbit.problem import Cost

BLOCK = 5  # cycles integrated at once
SAFETY = 3.0  # on measured discrepancies


class Transient(NamedTuple):
    """The first cycles of some scenes (s,): the `states` (s, k + 1) after 0, 1, ... k of them; and
    of each cycle (s, k) the `local_error` of its increment, its `derivative` dP/du, and its largest
    `response` to a relative error of the rate."""

    states: FloatArray
    local_error: FloatArray
    derivative: FloatArray
    response: FloatArray

    @property
    def cycles(self) -> int:
        """Return the number of cycles."""
        return int(self.local_error.shape[1])

    @property
    def last(self) -> FloatArray:
        """Return the states (s,) after them."""
        return self.states[:, -1]

    @property
    def last_increment(self) -> FloatArray:
        """Return the increment of the last cycle (s,)."""
        return self.states[:, -1] - self.states[:, -2]

    def then(self, increment: FloatArray, *columns: FloatArray) -> Transient:
        """Return the transient with more cycles; `columns` (s, j) are their other fields."""
        states = self.last[:, None] + np.cumsum(increment, axis=1)
        pairs = zip(self, (states, *columns), strict=True)
        return Transient(*(np.concatenate(pair, axis=1) for pair in pairs))

    def error(self, start_error: FloatArray, roundoff: FloatArray) -> FloatArray:
        """Return the errors (s, k + 1) of the states: the local errors of all cycles, by their mesh
        and by the relative `roundoff` (s, k) of the rate, propagated through the cycles after."""
        error = [start_error]
        local = SAFETY * self.local_error + roundoff * self.response
        for k in range(self.cycles):
            error.append(error[-1] * self.derivative[:, k] + local[:, k])
        return np.stack(error, axis=1) + ROUNDOFF * self.states


def no_cycle(starts: FloatArray) -> Transient:
    """Return the transient of no cycle from the `starts` (s,)."""
    none = np.empty((len(starts), 0))
    return Transient(starts[:, None], none, none, none)


class TransientBlock(NamedTuple):
    """The scenes `which`, with the period map that resolves their cycles, and their transient after
    more cycles, or after none more where the map had to be refined first; and the cost."""

    which: IntArray
    maps: PeriodMap
    transient: Transient
    cost: Cost


def extended(
    maps: PeriodMap, begun: Transient, limit: FloatArray, size: Settings, tolerance: FloatArray
) -> Iterator[TransientBlock]:
    """Integrate BLOCK more cycles of some scenes, or only one where the rate is so fast that the
    iteration over cycles fails; refine the meshes that do not resolve the cycles.

    States beyond the `limit` (s,) have no meaning.
    """
    run = maps.consecutive(begun.last, BLOCK)
    states = begun.last[:, None] + np.cumsum(run.increment, axis=1)
    starts = np.concatenate([begun.last[:, None], states[:, :-1]], axis=1)
    sound = run.converged & (states[:, -1] < limit)
    for i in np.flatnonzero(~sound).tolist():
        which = np.array([i])
        alone = maps.take(which)
        *cycle, evaluations = alone.violent_cycle(float(begun.last[i]), float(limit[i]), size)
        more = take(begun, which).then(*(np.array([[value]]) for value in cycle))
        yield TransientBlock(which, alone, more, Cost(BLOCK + 1, evaluations))
    marked = maps.unresolved(starts, run, size) & sound[:, None]
    if maps.full:
        marked[:] = False
    calm = np.flatnonzero(sound & ~marked.any(axis=1))
    evaluations = run.evaluations
    if len(calm):
        coarse, run, starts = maps.take(calm), take(run, calm), starts[calm]
        fine = coarse.finer(size)
        judge = fine.advance(starts, run.guess(size.finer_nodes))
        evaluations += judge.evaluations
        error = np.abs(judge.increment - run.increment)
        # The error that both meshes have in common, and that of the iteration.
        error += np.sum(fine.endpoint_defect(starts, judge), axis=2)
        error += judge.iteration_error * judge.increment
        error[~judge.converged] = np.inf
        inaccurate = np.any(error > tolerance[calm, None] * states[calm], axis=1) & (not maps.full)
        marked[calm[inaccurate]] = True
        derivative = coarse.derivative(starts, run)
        response = run.increment * np.maximum(derivative, 1.0)
        columns = run.increment, error, derivative, response
        good = np.flatnonzero(~inaccurate)
        if len(good):
            more = take(begun, calm[good]).then(*(array[good] for array in columns))
            cost = Cost(2 * BLOCK * len(calm), evaluations)
            yield TransientBlock(calm[good], coarse.take(good), more, cost)
            evaluations = 0
    for which, finer in maps.refined(marked):
        yield TransientBlock(which, finer, take(begun, which), Cost(0, evaluations))
        evaluations = 0
