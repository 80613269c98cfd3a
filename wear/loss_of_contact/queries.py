"""Counts of many scenes side by side: the queries of all of them are answered with one array.

The count of a scene is a coroutine, written as if the scene were alone: it yields a query for the
cycles, or the solutions of Abel's equation, that it needs next, and continues with the answer.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Generator, Iterable, Sequence
from typing import Any, NamedTuple, TypeVar

import numpy as np

from wear.loss_of_contact.period_map import CycleResult, SwitchedPeriodMap
from wear.numerics.gauss import FloatArray

# Cycles with a frozen rate, ranges of wear with their solutions of Abel's equation; cycles for the
# result, and finer ones for its error. The cheap kinds come first, so that queries of more scenes
# for the others come together.
FROZEN_CYCLES, WEAR_RANGES, CYCLES, FINER_CYCLES = range(4)


class Query(NamedTuple):
    """A query of one `kind` with its `argument`: for cycles, the initial wears (k,), mm."""

    kind: int
    argument: Any


T = TypeVar("T")
Coroutine = Generator[Query, Any, T]
BatchSolver = Callable[[list[int], list[Any]], Iterable[Any]]
"""From the numbers and the arguments of some scenes to their answers, scene by scene."""


def without_feedback(wear: FloatArray) -> Coroutine[FloatArray]:
    """Return the increments of cycles with the rate frozen at each initial `wear`, any shape."""
    added = yield Query(FROZEN_CYCLES, wear.ravel())
    return np.asarray(np.sum(added, axis=1).reshape(wear.shape))


def run_together(
    counts: Sequence[Coroutine[T]], answers: Sequence[BatchSolver], deadline: float = np.inf
) -> list[T]:
    """Run the counts of all scenes to their ends and return their results; `answers` has a solver
    for each kind of query. After the `deadline` (`time.monotonic()`) raise a `TimeoutError`."""
    results: dict[int, T] = {}
    asked: dict[int, Query] = {}

    def go_on(scene: int, answer: Any) -> None:
        try:
            asked[scene] = counts[scene].send(answer)
        except StopIteration as end:
            results[scene] = end.value

    for scene in range(len(counts)):
        go_on(scene, None)
    while asked:
        if time.monotonic() > deadline:
            raise TimeoutError
        kind = min(request.kind for request in asked.values())
        some = [scene for scene, request in asked.items() if request.kind == kind]
        arguments = [asked.pop(scene).argument for scene in some]
        for scene, answer in zip(some, answers[kind](some, arguments), strict=True):
            go_on(scene, answer)
    return [results[scene] for scene in range(len(counts))]


def frozen_cycles(cycle: SwitchedPeriodMap) -> BatchSolver:
    """Return a solver for the increments (k, pieces) of all pieces with the rate frozen."""

    def answer(scenes: list[int], wear: list[FloatArray]) -> list[FloatArray]:
        lengths, pieces = [len(part) for part in wear], np.diff(cycle.first)[scenes]
        added = cycle.each_without_feedback(np.concatenate(wear), np.repeat(scenes, lengths))
        parts = np.split(added, np.cumsum(lengths * pieces)[:-1])
        return [part.reshape(-1, number) for part, number in zip(parts, pieces, strict=True)]

    return answer


def cycles_by(cycle: SwitchedPeriodMap) -> BatchSolver:
    """Return a solver for cycles."""

    def answer(scenes: list[int], wear: list[FloatArray]) -> list[CycleResult]:
        lengths = [len(part) for part in wear]
        run = cycle.advance(np.concatenate(wear), np.repeat(scenes, lengths))
        share = run.evaluations / max(sum(lengths), 1)
        arrays, ends = (run.increment, run.error, run.converged), np.cumsum(lengths)[:-1]
        each = zip(*(np.split(array, ends) for array in arrays), strict=True)
        return [
            CycleResult(added, error, sound, round(share * len(added)))
            for added, error, sound in each
        ]

    return answer
