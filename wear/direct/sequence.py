"""Loads that do not repeat, as a sequence of loads that do, each from some cycle to another.

A load made of blocks is periodic inside each. A measured history is taken cycle by cycle, every
row a kink where the integrator stops: `wear.records` is faster by far where contact is smooth.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from wear.direct.problem import Real
from wear.load import AperiodicLoad, Blocks, HistoryLoad, Load

FOREVER = 1 << 62


class Span(NamedTuple):
    """A load that can be taken as periodic up to cycle `until`."""

    load: Load
    until: int


class Window:
    """One cycle of a measured history, from cycle `first`, as a function of its phase."""

    peaks: tuple[float, ...] = ()  # all of them are kinks

    def __init__(self, history: HistoryLoad, first: int) -> None:
        self._history = history
        self._start = first * history.period_s
        self.period = history.period_s
        end = min(self._start + self.period, history.duration)
        rows = history.breakpoints(self._start, end)
        self.kinks = tuple(((rows - self._start) / self.period).tolist())
        phases = np.array([0.0, *self.kinks, 1.0])
        levels = self(phases)
        self.minimum, self.maximum = float(np.min(levels)), float(np.max(levels))
        self.mean = float(np.trapezoid(levels, phases))

    def __call__(self, phase: Real) -> Real:
        return self._history.value(self._time(phase))

    def slope(self, phase: Real) -> Real:
        return self._history.slope(self._time(phase)) * self.period

    def gradient(self, phase: Real) -> dict[str, Real]:
        """Return nothing: the rows of a history are no parameters."""
        return {}

    def _time(self, phase: Real) -> Real:
        return np.minimum(self._start + np.asarray(phase) * self.period, self._history.duration)


def span(load: Load | AperiodicLoad, cycle: int) -> Span:
    """Return the load that acts from the start of a cycle (counted from 0), and how long it
    repeats."""
    if isinstance(load, HistoryLoad):
        return Span(Window(load, cycle), cycle + 1)
    if not isinstance(load, Blocks):
        return Span(load, FOREVER)  # type: ignore[arg-type]  # what is left of the union
    done = cycle - cycle % sum(block.cycles for block in load.blocks)
    for block in load.blocks:
        done += block.cycles
        if cycle < done:
            return Span(block.load, done)
    raise AssertionError("a cycle lies in some block of its round")


def most_cycles(load: Load | AperiodicLoad) -> int:
    """Return how many whole cycles the load has."""
    return int(load.cycles * (1.0 + 1e-12)) if isinstance(load, Blocks | HistoryLoad) else FOREVER
