"""The adaptive integrator of u' = f(t, u): a mesh of given intervals, cut where that is needed.

Overview
    Many intervals are taken at once. Their number is halved where the iteration fails and doubled
    where it converges fast; a single interval on which it fails is cut in two. A rule with more
    nodes estimates the error of every interval and shows which to cut. Errors are propagated by the
    linearised equation.
Key results
    integrate    the increments and their errors, part after part
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from typing import NamedTuple, Protocol

import numpy as np

from wear.numerics.collocation import NOISE, CycleSolution, Rates, iterate
from wear.numerics.gauss import BoolArray, FloatArray, Mesh, product

MOST_AT_ONCE = 1024  # intervals: the arrays of more fall out of the processor's cache
MOST_CUT = 4 * MOST_AT_ONCE  # intervals and parts of intervals at once
FIRST_AT_ONCE = 64  # intervals
MOST_ROUNDS = 12  # of cutting
SHORTEST = 1e-12  # part of an interval, over the longest interval
FEW_ITERATIONS = 6  # no more than these: then twice as many intervals are tried
SAFETY = 3.0  # on measured discrepancies


class StoppedError(Exception):
    """The integration ends at a `state`: intervals cannot be cut any shorter there, or it takes too
    many."""

    def __init__(self, state: float) -> None:
        super().__init__(f"the state could not be followed beyond {state:.6g}")
        self.state = state


class RatesWithSlope(Rates, Protocol):
    """Rates on a mesh with their derivatives and errors; arrays are (1, 1, intervals, nodes)."""

    def slope(self, u: FloatArray) -> FloatArray:
        """Return the derivative of the rate with respect to u, per unit of time."""

    def endpoint_defect(self, starts: FloatArray, run: CycleSolution) -> FloatArray: ...


Sampled = Callable[[FloatArray, int, float], RatesWithSlope]
"""Rates on the mesh with these edges (q + 1,), nodes on each interval, and this tolerance."""


class Rules(NamedTuple):
    """The `nodes` on each interval, those of the finer rule for the error estimate, and the
    permitted relative error of an increment."""

    nodes: int
    finer_nodes: int
    tolerance: float


class Endpoints(NamedTuple):
    """The solution at the ends of some intervals (k,), since the start: the `increment`, its
    `error`, the `derivative` of the state with respect to the initial state, the largest `response`
    of the state to a relative error of the rate. Since the previous ends: the number of right-hand
    sides evaluated, and the `edges` (q + 1,) of the intervals taken."""

    increment: FloatArray
    error: FloatArray
    derivative: FloatArray
    response: FloatArray
    evaluations: int
    edges: FloatArray

    def then(self, more: Endpoints) -> Endpoints:
        """Return the solution `more`, which starts at the last of these ends, since the start of
        this one."""
        derivative = self.derivative[-1]
        return Endpoints(
            self.increment[-1] + more.increment,
            self.error[-1] * more.derivative + more.error,
            derivative * more.derivative,
            self.response[-1] * more.derivative + more.response,
            self.evaluations + more.evaluations,
            np.append(self.edges[:-1], more.edges),
        )

    def take(self, which: BoolArray) -> Endpoints:
        """Return the solution at some of the ends."""
        return Endpoints(
            self.increment[which],
            self.error[which],
            self.derivative[which],
            self.response[which],
            self.evaluations,
            self.edges,
        )


class _Intervals(NamedTuple):
    """Consecutive intervals: their `edges` (q + 1,), and whether the state at the end of each (q,)
    is `asked` for."""

    edges: FloatArray
    asked: BoolArray

    def split(self, count: int) -> tuple[_Intervals, _Intervals]:
        """Return the first `count` of them, and the rest."""
        first = _Intervals(self.edges[: count + 1], self.asked[:count])
        return first, _Intervals(self.edges[count:], self.asked[count:])

    def cut(self, marked: BoolArray) -> _Intervals:
        """Return the intervals with those `marked` (q,) cut in two."""
        middles = (self.edges[:-1] + self.edges[1:])[marked] / 2
        at = np.flatnonzero(marked)
        return _Intervals(np.insert(self.edges, at + 1, middles), np.insert(self.asked, at, False))


def integrate(
    sampled: Sampled,
    edges: FloatArray,
    start: float,
    rules: Rules,
    roundoff: Callable[[float], float] = lambda _: 0.0,
    limit: float = np.inf,
    deadline: float = np.inf,
    most: float = np.inf,
) -> Iterator[Endpoints]:
    """Yield the solution from the state `start` over intervals between `edges` (q + 1,), part after
    part.

    `roundoff` bounds the relative rounding error of the rate from a state on; `most` bounds the
    evaluations of the rate from one requested state to the next.

    Raises
    ------
    StoppedError
        where the intervals cannot be cut any shorter, or take too many evaluations, or the state
        would pass the `limit`.
    TimeoutError
        after the deadline (`time.monotonic()`).
    """
    todo = [_Intervals(edges, np.ones(len(edges) - 1, dtype=bool))] if len(edges) > 1 else []
    shortest, size = SHORTEST * np.max(np.diff(edges), initial=0.0), FIRST_AT_ONCE
    zero, one = np.zeros(1), np.ones(1)
    done = Endpoints(zero, zero, one, zero, 0, edges[:1])
    while todo:
        if time.monotonic() > deadline:
            raise TimeoutError
        now, state = todo.pop(), start + float(done.increment[-1])
        if len(now.asked) > size:
            now, rest = now.split(size)
            todo.append(rest)
        attempt = _attempt(sampled, now, state, rules, roundoff(state), limit)
        done = done._replace(evaluations=done.evaluations + attempt.evaluations)
        if done.evaluations > most:
            raise StoppedError(state)
        if attempt.part is None:
            size = max(1, len(now.asked) // 2)
            if len(now.asked) == 1:
                if now.edges[1] - now.edges[0] <= shortest:
                    raise StoppedError(state)
                now = now.cut(np.array([True]))
            todo.append(now)
            continue
        part = done.then(attempt.part)
        if attempt.asked.any():
            yield part.take(attempt.asked)
            part = part._replace(evaluations=0, edges=part.edges[-1:])
        done = part.take(np.arange(len(attempt.asked)) == len(attempt.asked) - 1)
        if attempt.easy:
            size = min(2 * size, MOST_AT_ONCE)


class _Attempt(NamedTuple):
    """The right-hand sides evaluated; the solution at the end of each interval, None if the
    iteration failed; which ends (q,) are `asked` for; and whether the iteration was `easy`: twice
    as many intervals would converge, too."""

    evaluations: int
    part: Endpoints | None
    asked: BoolArray
    easy: bool


def _attempt(
    sampled: Sampled,
    intervals: _Intervals,
    start: float,
    rules: Rules,
    rate_roundoff: float,
    limit: float,
) -> _Attempt:
    """Integrate all the intervals at once from the state `start`, cutting those that are not
    resolved; `rate_roundoff` is the relative error of the rate by rounding."""
    evaluations, at = 0, np.array([[start]])
    for _ in range(MOST_ROUNDS):
        coarse = sampled(intervals.edges, rules.nodes, max(NOISE, rate_roundoff))
        fine = sampled(intervals.edges, rules.finer_nodes, max(NOISE, rate_roundoff))
        try:
            run = iterate(coarse, at)
            judge = iterate(fine, at, run.guess(rules.finer_nodes))
        except ArithmeticError:  # a trial state so far off that it has no rate
            break
        on_each, finer = _on_each(run.rate, coarse.over), _on_each(judge.rate, fine.over)
        hidden = fine.endpoint_defect(at, judge)[0, 0]
        evaluations += run.evaluations + judge.evaluations + len(intervals.edges)
        sound = run.converged.all() and judge.converged.all()
        if not (sound and start + np.sum(on_each) < limit):
            break
        permitted = rules.tolerance * np.sum(on_each) / len(on_each)
        marked = np.abs(finer - on_each) > np.maximum(permitted, 4 * rate_roundoff * on_each)
        marked |= hidden > permitted
        if not marked.any():
            part = _endpoints(coarse, start, run, judge, on_each, finer, hidden, rate_roundoff)
            quick = run.evaluations <= FEW_ITERATIONS * run.rate.size
            easy = quick and 3 * len(on_each) <= MOST_CUT  # some of them may be cut once more
            return _Attempt(evaluations + run.rate.size, part, intervals.asked, easy)
        intervals = intervals.cut(marked)
        if len(intervals.asked) > MOST_CUT:
            break
    return _Attempt(evaluations, None, intervals.asked, False)


def _endpoints(
    coarse: RatesWithSlope,
    start: float,
    run: CycleSolution,
    judge: CycleSolution,
    on_each: FloatArray,
    finer: FloatArray,
    hidden: FloatArray,
    rate_roundoff: float,
) -> Endpoints:
    """Return the solution at the ends of resolved intervals with its error: by the rules, by the
    iteration, and by rounding."""
    increment = np.cumsum(on_each)
    growth = np.cumsum(_on_each(coarse.slope(start + run.inside), coarse.over))  # its logarithm
    most = growth - np.minimum(np.minimum.accumulate(growth), 0.0)  # since any interval
    by_rules = SAFETY * np.abs(np.cumsum(finer) - increment) + np.cumsum(hidden)
    iteration = float(run.iteration_error[0, 0] + judge.iteration_error[0, 0]) * increment[-1]
    error = by_rules + (iteration + rate_roundoff * increment) * np.exp(most)
    response = increment * np.exp(most)
    return Endpoints(increment, error, np.exp(growth), response, 0, coarse.over.edges.ravel())


def _on_each(values: FloatArray, over: Mesh) -> FloatArray:
    """Return the integral of `values` (1, 1, q, m) over each interval of a mesh, (q,)."""
    whole: FloatArray = (product(values, over.rule.weights) * over.lengths)[0, 0]
    return whole
