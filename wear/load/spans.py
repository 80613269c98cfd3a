"""Every load as a sequence of periodic loads, each over a range of cycles.

A load made of blocks is periodic in each block. A measured history is taken cycle by cycle, with a
kink at every row, where an integrator stops: for smooth contact `wear.records` is much faster.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, NamedTuple

import numpy as np

from wear.load.blocks import Blocks
from wear.load.periodic import Load
from wear.load.piecewise_linear import HistoryLoad
from wear.numerics.gauss import FloatArray

FOREVER = 1 << 62

Loading = Load | Blocks | HistoryLoad
"""The loads of a scene, periodic or not."""


class LoadSpan(NamedTuple):
    """A load that is periodic up to cycle `until`, and its `place` in the scene file."""

    load: Load
    until: int
    place: str = "load"


@dataclass(frozen=True)
class Window:
    """One cycle of a measured history, from cycle `first`, as a function of its phase."""

    history: HistoryLoad
    first: int
    peaks: ClassVar[tuple[float, ...]] = ()  # all of them are kinks

    @property
    def period(self) -> float:
        return self.history.period_s

    def __call__(self, phase: FloatArray | float) -> FloatArray:
        return self.history(self._time(phase))

    def slope(self, phase: FloatArray | float) -> FloatArray:
        return self.history.slope(self._time(phase)) * self.period

    def gradient(self, phase: FloatArray) -> dict[str, FloatArray]:
        """Return no derivatives: the rows of a history are no parameters."""
        return {}

    def _time(self, phase: FloatArray | float) -> FloatArray:
        time = (self.first + np.asarray(phase)) * self.period
        return np.minimum(time, self.history.duration)

    @cached_property
    def kinks(self) -> tuple[float, ...]:
        start, end = self._time(np.array([0.0, 1.0])).tolist()
        return tuple(((self.history.breakpoints(start, end) - start) / self.period).tolist())

    @cached_property
    def _rows(self) -> FloatArray:
        """Return the phases of the rows (n,), the ends of the cycle among them, and U_a there in
        mm."""
        phases = np.array([0.0, *self.kinks, 1.0])
        return np.stack([phases, self(phases)])

    @property
    def minimum(self) -> float:
        return float(np.min(self._rows[1]))

    @property
    def maximum(self) -> float:
        return float(np.max(self._rows[1]))

    @property
    def mean(self) -> float:
        return float(np.trapezoid(self._rows[1], self._rows[0]))


def span(load: Loading, cycle: int) -> LoadSpan:
    """Return the load that acts from the start of a cycle (counted from 0), with its last cycle; at
    the end of blocks the last of them."""
    if isinstance(load, HistoryLoad):
        return LoadSpan(Window(load, cycle), cycle + 1)
    if not isinstance(load, Blocks):
        return LoadSpan(load, FOREVER)
    rounds, rest = divmod(min(cycle, load.cycles - 1), load.cycles_of_round)
    ends = np.cumsum([block.cycles for block in load.blocks])
    at = int(np.searchsorted(ends, rest, side="right"))
    until = rounds * load.cycles_of_round + int(ends[at])
    return LoadSpan(load.blocks[at].load, until, f"load.blocks[{at}]")


def most_cycles(load: Loading) -> int:
    """Return the number of whole cycles of the load."""
    return int(load.cycles * (1.0 + 1e-12)) if isinstance(load, Blocks | HistoryLoad) else FOREVER
