"""Loads: the prescribed displacement U_a of the pin, in mm.

A `Load` repeats and is a function of the phase t/T; `Sine`, `Constant`, `Harmonics` and `Table` are
such. An `AperiodicLoad` is a function of the time in s; `HistoryLoad` and `Blocks` are such.
All are frozen; values, slopes and extremes are exact to rounding.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from wear.load.blocks import Block, Blocks
from wear.load.harmonics import Harmonics
from wear.load.lines import HistoryLoad, Table
from wear.load.phase import FloatArray, centred

__all__ = [
    "AperiodicLoad",
    "Block",
    "Blocks",
    "Constant",
    "FloatArray",
    "Harmonics",
    "HistoryLoad",
    "Load",
    "Sine",
    "Table",
    "sampled",
]


class Load(Protocol):
    """A periodic displacement. One cycle is one unit of phase, whatever the period."""

    @property
    def period(self) -> float:
        """T in s."""

    def __call__(self, phase: FloatArray | float) -> FloatArray:
        """U_a in mm at phase = t/T, any real number, of any shape."""

    def slope(self, phase: FloatArray | float) -> FloatArray:
        """dU_a/dphase in mm per cycle; at a kink the slope to its right."""

    @property
    def kinks(self) -> tuple[float, ...]:
        """Phases in [0, 1), increasing, where U_a is not smooth."""

    @property
    def minimum(self) -> float:
        """Least U_a, mm."""

    @property
    def maximum(self) -> float:
        """Largest U_a, mm."""

    @property
    def mean(self) -> float:
        """Mean of U_a over a period, mm."""

    @property
    def peaks(self) -> tuple[float, ...]:
        """Phases in [0, 1), increasing, of the local maxima; a flat top counts at its start."""


class AperiodicLoad(Protocol):
    """A displacement that does not repeat, on 0 <= t <= duration."""

    @property
    def duration(self) -> float:
        """s."""

    @property
    def cycles(self) -> float:
        """How many cycles the load counts as."""

    def time_at(self, cycles: float) -> float:
        """The time in s at which that many cycles are done."""

    def value(self, time: FloatArray | float) -> FloatArray:
        """U_a in mm at a time in s."""

    def slope(self, time: FloatArray | float) -> FloatArray:
        """dU_a/dt in mm/s; at a breakpoint the slope to its right."""

    def breakpoints(self, start: float, end: float) -> FloatArray:
        """Times in (start, end), increasing, at which U_a has a kink or a jump."""

    @property
    def minimum(self) -> float:
        """Least U_a, mm."""

    @property
    def maximum(self) -> float:
        """Largest U_a, mm."""

    @property
    def mean(self) -> float:
        """Mean of U_a over the duration, mm."""


@dataclass(frozen=True)
class Sine:
    """U_a = U sin(2 pi t/T).

    >>> load = Sine(5e-4, 0.06)
    >>> float(load(0.25)), load.peaks, load.minimum
    (0.0005, (0.25,), -0.0005)
    """

    amplitude_mm: float
    period_s: float
    kinks: tuple[float, ...] = field(default=(), init=False, repr=False)
    mean: float = field(default=0.0, init=False, repr=False)

    def __call__(self, phase: FloatArray | float) -> FloatArray:
        return np.asarray(self.amplitude_mm * np.sin(2.0 * math.pi * centred(phase)))

    def slope(self, phase: FloatArray | float) -> FloatArray:
        angle = 2.0 * math.pi * centred(phase)
        return np.asarray(2.0 * math.pi * self.amplitude_mm * np.cos(angle))

    @property
    def period(self) -> float:
        return self.period_s

    @property
    def minimum(self) -> float:
        return -abs(self.amplitude_mm)

    @property
    def maximum(self) -> float:
        return abs(self.amplitude_mm)

    @property
    def peaks(self) -> tuple[float, ...]:
        if self.amplitude_mm == 0.0:
            return (0.0,)
        return (0.25,) if self.amplitude_mm > 0.0 else (0.75,)


@dataclass(frozen=True)
class Constant:
    """U_a constant; the period only counts cycles."""

    value_mm: float
    period_s: float
    kinks: tuple[float, ...] = field(default=(), init=False, repr=False)
    peaks: tuple[float, ...] = field(default=(0.0,), init=False, repr=False)

    def __call__(self, phase: FloatArray | float) -> FloatArray:
        return np.full(np.shape(phase), self.value_mm)

    def slope(self, phase: FloatArray | float) -> FloatArray:
        return np.zeros(np.shape(phase))

    @property
    def period(self) -> float:
        return self.period_s

    @property
    def minimum(self) -> float:
        return self.value_mm

    @property
    def maximum(self) -> float:
        return self.value_mm

    @property
    def mean(self) -> float:
        return self.value_mm


def sampled(loads: Sequence[Load], phases: FloatArray) -> FloatArray:
    """U_a in mm of many loads, each at phases (loads, ...) of its own; sines all at once."""
    amplitudes = [load.amplitude_mm for load in loads if isinstance(load, Sine)]
    if len(amplitudes) == len(loads):
        unit = Sine(1.0, 1.0)(phases)
        return np.array(amplitudes).reshape(-1, *[1] * (phases.ndim - 1)) * unit
    return np.stack([load(x) for load, x in zip(loads, phases, strict=True)])
