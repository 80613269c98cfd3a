"""Displacements given by rows: straight lines between them, periodic or not."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from wear.load.phase import FloatArray, inside, within_cycle


def _segment_slopes(times: FloatArray, values: FloatArray, at: FloatArray) -> FloatArray:
    """The slope of the straight line that starts at or before each `at`."""
    slopes = np.diff(values) / np.diff(times)
    place = np.searchsorted(times, at, side="right") - 1
    return np.asarray(slopes[np.clip(place, 0, len(slopes) - 1)])


def _mean_of_lines(times: FloatArray, values: FloatArray) -> float:
    areas = 0.5 * np.diff(times) * (values[1:] + values[:-1])
    return math.fsum(areas.tolist()) / float(times[-1] - times[0])


@dataclass(frozen=True)
class Table:
    """Straight lines between rows over one period; the first row, at t = 0, is also the last.

    `times_s` runs from 0 to the period. `file` and `sha256` say where the rows came from.

    >>> saw = Table((0.0, 0.5, 2.0), (0.0, 1e-3, 0.0), "saw.csv")
    >>> saw.period, saw.kinks, saw.peaks, float(saw(0.125))
    (2.0, (0.0, 0.25), (0.25,), 0.0005)
    """

    times_s: tuple[float, ...]
    values_mm: tuple[float, ...]
    file: str = ""
    sha256: str = ""

    @cached_property
    def _phases(self) -> FloatArray:
        return np.asarray(self.times_s) / self.period

    @cached_property
    def _values(self) -> FloatArray:
        return np.asarray(self.values_mm)

    def __call__(self, phase: FloatArray | float) -> FloatArray:
        return np.asarray(np.interp(within_cycle(phase), self._phases, self._values))

    def slope(self, phase: FloatArray | float) -> FloatArray:
        return _segment_slopes(self._phases, self._values, within_cycle(phase) % 1.0)

    @property
    def period(self) -> float:
        return self.times_s[-1]

    @cached_property
    def kinks(self) -> tuple[float, ...]:
        return tuple(self._phases[:-1].tolist())

    @cached_property
    def minimum(self) -> float:
        return min(self.values_mm)

    @cached_property
    def maximum(self) -> float:
        return max(self.values_mm)

    @cached_property
    def mean(self) -> float:
        return _mean_of_lines(self._phases, self._values)

    @cached_property
    def peaks(self) -> tuple[float, ...]:
        rises = np.sign(np.diff(self._values))
        moving = np.flatnonzero(rises)
        if len(moving) == 0:
            return (0.0,)
        falls_next = (rises[moving] > 0.0) & (rises[np.roll(moving, -1)] < 0.0)
        return tuple(np.sort(self._phases[moving[falls_next] + 1] % 1.0).tolist())


@dataclass(frozen=True)
class HistoryLoad:
    """Straight lines between measured rows, from t = 0 to the last row; it does not repeat.

    `period_s` only counts cycles. Times outside the rows are a `ValueError`.
    """

    times_s: tuple[float, ...]
    values_mm: tuple[float, ...]
    period_s: float
    file: str = ""
    sha256: str = ""

    @cached_property
    def _times(self) -> FloatArray:
        return np.asarray(self.times_s)

    @cached_property
    def _values(self) -> FloatArray:
        return np.asarray(self.values_mm)

    def value(self, time: FloatArray | float) -> FloatArray:
        return np.asarray(np.interp(inside(time, self.duration), self._times, self._values))

    def slope(self, time: FloatArray | float) -> FloatArray:
        return _segment_slopes(self._times, self._values, inside(time, self.duration))

    def breakpoints(self, start: float, end: float) -> FloatArray:
        first = np.searchsorted(self._times, start, side="right")
        return self._times[first : np.searchsorted(self._times, end, side="left")]

    @property
    def duration(self) -> float:
        return self.times_s[-1]

    @property
    def cycles(self) -> float:
        return self.duration / self.period_s

    def time_at(self, cycles: float) -> float:
        return float(inside(cycles * self.period_s, self.duration))

    @cached_property
    def minimum(self) -> float:
        return min(self.values_mm)

    @cached_property
    def maximum(self) -> float:
        return max(self.values_mm)

    @cached_property
    def mean(self) -> float:
        return _mean_of_lines(self._times, self._values)
