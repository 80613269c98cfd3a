"""Single cycles that were integrated, and what they tell about those from wears next to them."""

from __future__ import annotations

from bisect import bisect_left, insort
from typing import NamedTuple

import numpy as np

from wear.numerics.gauss import BoolArray, FloatArray

BEND = 10.0  # relative change of the slope over a wear as large as what the cycle adds, at most


class Cycle(NamedTuple):
    """A cycle from a `wear` (mm), what it has `added` (mm), and the `slope` of that; whether it is
    `sound`; and by how much, relatively, that may be `off`, infinite for a guess."""

    wear: float
    added: float
    slope: float = 0.0
    sound: bool = True
    off: float = 0.0


class Samples:
    """Cycles of one scene that were integrated, from rising wears."""

    def __init__(self) -> None:
        self.cycles: list[Cycle] = []

    def add(self, wear: FloatArray, added: FloatArray, slope: FloatArray, sound: BoolArray) -> None:
        """Take up some cycles (k,)."""
        for row in zip(*map(np.ndarray.tolist, (wear, added, slope, sound)), strict=True):
            insort(self.cycles, Cycle(*row))

    def at(self, wear: float, guess: float) -> Cycle:
        """Return the cycle from a wear (mm), by the slope of the nearest one; one that adds the
        `guess` (mm) if that is a cycle away, or more."""
        i = bisect_left(self.cycles, (wear,))
        around = self.cycles[max(i - 1, 0) : i + 1]
        near = min(around, key=lambda cycle: abs(wear - cycle.wear), default=None)
        if near is None or not (near.wear == wear or abs(wear - near.wear) < near.added):
            return Cycle(wear, guess, off=np.inf)
        if near.wear == wear:
            return near
        part = abs(wear - near.wear) / near.added
        added = max(near.added + near.slope * (wear - near.wear), 0.0)
        return Cycle(wear, added, near.slope, near.sound, BEND * abs(near.slope) * part**2)
