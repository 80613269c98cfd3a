"""Counts of many scenes that go on together: each asks for period maps, and all are answered at
once.

The count of one scene is written as if it were alone, as a generator: it asks for the cycles that
it needs next and goes on with the answer. Those of all scenes are integrated together.
"""

from __future__ import annotations

from collections.abc import Generator, Sequence
from typing import NamedTuple, TypeVar

import numpy as np

from wear.loss_of_contact.period_map import Advanced, SwitchedPeriodMap
from wear.numerics.gauss import FloatArray



class Request(NamedTuple):
    """A wish for cycles from each `wear` (k,), mm; `frozen` as if no rate felt what they add."""

    wear: FloatArray
    frozen: bool = False


T = TypeVar("T")
Asking = Generator[Request, Advanced, T]


def without_feedback(wear: FloatArray) -> Asking[FloatArray]:
    """Return the wear added by one cycle if the rate did not feel it, any shape."""
    run = yield Request(wear.ravel(), frozen=True)
    return np.asarray(np.sum(run.increment, axis=1).reshape(wear.shape))


def answered(counts: Sequence[Asking[T]], maps: SwitchedPeriodMap) -> list[T]:
    """Return what each of the counts returns, scene by scene, by the map of all scenes."""
    results: dict[int, T] = {}
    asked: dict[int, Request] = {}

    def go_on(scene: int, answer: Advanced | None) -> None:
        try:
            asked[scene] = counts[scene].send(answer)  # type: ignore[arg-type]  # none to begin
        except StopIteration as end:
            results[scene] = end.value

    for scene in range(len(counts)):
        go_on(scene, None)
    while asked:
        frozen = all(request.frozen for request in asked.values())
        some = [scene for scene, request in asked.items() if request.frozen == frozen]
        wear = [asked.pop(scene).wear for scene in some]
        for scene, answer in zip(some, _together(frozen, some, wear, maps), strict=True):
            go_on(scene, answer)
    return [results[scene] for scene in range(len(counts))]


def _together(
    frozen: bool, scenes: list[int], wear: list[FloatArray], maps: SwitchedPeriodMap
) -> list[Advanced]:
    """Return the answers to requests, all frozen or none."""
    lengths = [len(part) for part in wear]
    ends, which = np.cumsum(lengths)[:-1], np.repeat(scenes, lengths)
    if frozen:
        pieces = np.diff(maps.first)
        added = maps.each_without_feedback(np.concatenate(wear), which)
        parts = np.split(added, np.cumsum(lengths * pieces[scenes])[:-1])
        sound = np.array([True])
        return [
            Advanced(part.reshape(length, pieces[scene]), part, sound, 0)
            for part, length, scene in zip(parts, lengths, scenes, strict=True)
        ]
    run = maps.advance(np.concatenate(wear), which)
    share = run.evaluations / max(len(which), 1)
    each = zip(*(np.split(array, ends) for array in run[:3]), strict=True)
    return [Advanced(*arrays, round(share * len(arrays[0]))) for arrays in each]
