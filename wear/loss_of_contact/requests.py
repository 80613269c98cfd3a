"""Counts of many scenes that go on together: what they ask for is answered for all at once.

The count of one scene is written as if it were alone, as a generator: it asks for the cycles, or
the solutions of Abel's equation, that it needs next and goes on with the answer. What all scenes
have asked for is one array.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterable, Sequence
from typing import Any, NamedTuple, TypeVar

import numpy as np

from wear.loss_of_contact.period_map import Advanced, SwitchedPeriodMap
from wear.numerics.gauss import FloatArray

# Cycles as if no rate felt the wear, ways along panels, and solutions of Abel's equation; cycles
# for the result, and to judge it. The cheap ones come first, so that the requests of more scenes
# for the others come together.
FROZEN, ALONG, SOLVED, COARSE, FINE = range(5)


class Request(NamedTuple):
    """A wish of one `kind`: for cycles, from each wear (k,), mm."""

    kind: int
    wish: Any


T = TypeVar("T")
Asking = Generator[Request, Any, T]
Answers = Callable[[list[int], list[Any]], Iterable[Any]]
"""Of the wishes of some scenes, one after the other."""


def without_feedback(wear: FloatArray) -> Asking[FloatArray]:
    """Return the wear added by one cycle if the rate did not feel it, any shape."""
    added = yield Request(FROZEN, wear.ravel())
    return np.asarray(np.sum(added, axis=1).reshape(wear.shape))


def answered(counts: Sequence[Asking[T]], answers: Sequence[Answers]) -> list[T]:
    """Return what each of the counts returns, scene by scene, with the answers to each kind of
    request."""
    results: dict[int, T] = {}
    asked: dict[int, Request] = {}

    def go_on(scene: int, answer: Any) -> None:
        try:
            asked[scene] = counts[scene].send(answer)
        except StopIteration as end:
            results[scene] = end.value

    for scene in range(len(counts)):
        go_on(scene, None)
    while asked:
        kind = min(request.kind for request in asked.values())
        some = [scene for scene, request in asked.items() if request.kind == kind]
        wishes = [asked.pop(scene).wish for scene in some]
        for scene, answer in zip(some, answers[kind](some, wishes), strict=True):
            go_on(scene, answer)
    return [results[scene] for scene in range(len(counts))]


def frozen_cycles(cycle: SwitchedPeriodMap) -> Answers:
    """Answer with what each piece adds, one after the other, if the rate does not feel the wear
    (k, pieces)."""

    def answer(scenes: list[int], wear: list[FloatArray]) -> list[FloatArray]:
        lengths, pieces = [len(part) for part in wear], np.diff(cycle.first)[scenes]
        added = cycle.each_without_feedback(np.concatenate(wear), np.repeat(scenes, lengths))
        parts = np.split(added, np.cumsum(lengths * pieces)[:-1])
        return [part.reshape(-1, number) for part, number in zip(parts, pieces, strict=True)]

    return answer


def cycles_by(cycle: SwitchedPeriodMap) -> Answers:
    """Answer with what cycles add."""

    def answer(scenes: list[int], wear: list[FloatArray]) -> list[Advanced]:
        lengths = [len(part) for part in wear]
        run = cycle.advance(np.concatenate(wear), np.repeat(scenes, lengths))
        share = run.evaluations / max(sum(lengths), 1)
        arrays, ends = (run.increment, run.missed, run.converged), np.cumsum(lengths)[:-1]
        each = zip(*(np.split(array, ends) for array in arrays), strict=True)
        return [
            Advanced(added, missed, sound, round(share * len(added)))
            for added, missed, sound in each
        ]

    return answer
