"""Loads: the prescribed displacement U_a of the pin, in mm.

A `Load` repeats and is a function of the phase t/T; `Sine`, `Constant`, `Harmonics` and `Table` are
such. An `AperiodicLoad` is a function of the time in s; `HistoryLoad` and `Blocks` are such.
All are frozen and checked where they are made; values, slopes and extremes are exact to rounding.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import ClassVar

import numpy as np
from pydantic import Field

from wear.checked import Positive, Real, SceneTable, table
from wear.load.blocks import Block, Blocks
from wear.load.harmonics import Harmonics
from wear.load.lines import HistoryLoad, Table
from wear.load.phase import FloatArray, centred
from wear.load.protocols import AperiodicLoad, Load

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


@table("load", kind="sine")
class Sine(SceneTable):
    """U_a = U sin(2 pi t/T).

    >>> load = Sine(5e-4, 0.06)
    >>> float(load(0.25)), load.peaks, load.minimum
    (0.0005, (0.25,), -0.0005)
    """

    amplitude_mm: Real = Field(description="amplitude U")
    period_s: Positive = Field(description="period T of a cycle")
    kinks: ClassVar[tuple[float, ...]] = ()
    mean: ClassVar[float] = 0.0

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


@table("load", kind="constant")
class Constant(SceneTable):
    """U_a constant; the period only counts cycles."""

    value_mm: Real = Field(description="displacement U_a")
    period_s: Positive = Field(description="period T, only to count cycles")
    kinks: ClassVar[tuple[float, ...]] = ()
    peaks: ClassVar[tuple[float, ...]] = (0.0,)

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
