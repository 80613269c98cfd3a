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

# Maps: as if no rate felt the wear, for the result, and to judge it; the cheap ones come first, so
# that the requests of more scenes for the others come together.
FROZEN, COARSE, FINE = range(3)


class Request(NamedTuple):
    """A wish for cycles from each `wear` (k,), mm, by one of the maps."""

    map: int
    wear: FloatArray


T = TypeVar("T")
Asking = Generator[Request, Advanced, T]


def without_feedback(wear: FloatArray) -> Asking[FloatArray]:
    """Return the wear added by one cycle if the rate did not feel it, any shape."""
    run = yield Request(FROZEN, wear.ravel())
    return np.asarray(np.sum(run.increment, axis=1).reshape(wear.shape))


def answered(counts: Sequence[Asking[T]], maps: Sequence[SwitchedPeriodMap]) -> list[T]:
    """Return what each of the counts returns, scene by scene, by the maps of all scenes for each
    kind of request."""
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
        kind = min(request.map for request in asked.values())
        some = [scene for scene, request in asked.items() if request.map == kind]
        wear = [asked.pop(scene).wear for scene in some]
        for scene, answer in zip(some, _together(kind, some, wear, maps), strict=True):
            go_on(scene, answer)
    return [results[scene] for scene in range(len(counts))]


def _together(
    kind: int, scenes: list[int], wear: list[FloatArray], maps: Sequence[SwitchedPeriodMap]
) -> list[Advanced]:
    """Return the answers to requests for one map."""
    lengths = [len(part) for part in wear]
    ends, which = np.cumsum(lengths)[:-1], np.repeat(scenes, lengths)
    if kind == FROZEN:
        pieces = np.diff(maps[FROZEN].first)
        added = maps[FROZEN].each_without_feedback(np.concatenate(wear), which)
        parts = np.split(added, np.cumsum(lengths * pieces[scenes])[:-1])
        sound = np.array([True])
        return [
            Advanced(part.reshape(length, pieces[scene]), part, sound, 0)
            for part, length, scene in zip(parts, lengths, scenes, strict=True)
        ]
    run = maps[kind].advance(np.concatenate(wear), which)
    share = run.evaluations / max(len(which), 1)
    arrays = (run.increment, run.missed, run.converged)
    each = zip(*(np.split(array, ends) for array in arrays), strict=True)
    return [
        Advanced(added, missed, sound, round(share * len(added))) for added, missed, sound in each
    ]
