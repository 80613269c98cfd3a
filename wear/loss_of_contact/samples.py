"""Single integrated cycles, and extrapolation to the wears next to them."""

from __future__ import annotations

from bisect import bisect_left, insort
from typing import NamedTuple

import numpy as np

from wear.numerics.gauss import BoolArray, FloatArray

CURVATURE = 10.0  # relative change of the slope over the increment of a cycle, at most


class Cycle(NamedTuple):
    """A cycle from a `wear` (mm): its increment `added` (mm), the `slope` of that with respect to
    the wear, whether its integration is `sound`, and the relative `error`, infinite for a guess."""

    wear: float
    added: float
    slope: float = 0.0
    sound: bool = True
    error: float = 0.0


class Samples:
    """Integrated cycles of one scene, in order of wear."""

    def __init__(self) -> None:
        self.cycles: list[Cycle] = []

    def add(self, wear: FloatArray, added: FloatArray, slope: FloatArray, sound: BoolArray) -> None:
        """Add cycles (k,)."""
        for row in zip(*map(np.ndarray.tolist, (wear, added, slope, sound)), strict=True):
            insort(self.cycles, Cycle(*row))

    def at(self, wear: float, guess: float) -> Cycle:
        """Return the cycle from a wear (mm), extrapolated from the nearest one by its slope; if
        none begins less than a cycle away, with the increment `guess` (mm)."""
        i = bisect_left(self.cycles, (wear,))
        around = self.cycles[max(i - 1, 0) : i + 1]
        near = min(around, key=lambda cycle: abs(wear - cycle.wear), default=None)
        if near is None or not (near.wear == wear or abs(wear - near.wear) < near.added):
            return Cycle(wear, guess, error=np.inf)
        if near.wear == wear:
            return near
        part = abs(wear - near.wear) / near.added
        added = max(near.added + near.slope * (wear - near.wear), 0.0)
        return Cycle(wear, added, near.slope, near.sound, CURVATURE * abs(near.slope) * part**2)
