"""Loads: the prescribed displacement U_a of the pin, in mm, or its reaction R_a, in N.

A `Load` repeats and is a function of the phase t/T; `Sine`, `Constant`, `Harmonics` and `Table` are
such, and of forces `Force` and `ForceTable`. `Blocks` are such loads one after the other, and a
`HistoryLoad` is a function of the time in s.
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
from wear.load.lines import ForceTable, HistoryLoad, Table
from wear.load.phase import FloatArray, centred
from wear.load.protocol import Load
from wear.load.spans import Loading

__all__ = [
    "Block",
    "Blocks",
    "Constant",
    "FloatArray",
    "Force",
    "ForceTable",
    "Harmonics",
    "HistoryLoad",
    "Load",
    "Loading",
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

    def gradient(self, phase: FloatArray) -> dict[str, FloatArray]:
        return {"amplitude_mm": np.sin(2.0 * math.pi * centred(phase))}

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


class _Level:
    """A load that stays as it is."""

    kinks: ClassVar[tuple[float, ...]] = ()
    peaks: ClassVar[tuple[float, ...]] = (0.0,)

    @property
    def mean(self) -> float:
        raise NotImplementedError

    def __call__(self, phase: FloatArray | float) -> FloatArray:
        return np.full(np.shape(phase), self.mean)

    def slope(self, phase: FloatArray | float) -> FloatArray:
        return np.zeros(np.shape(phase))

    @property
    def minimum(self) -> float:
        return self.mean

    @property
    def maximum(self) -> float:
        return self.mean


@table("load", kind="constant")
class Constant(_Level, SceneTable):
    """U_a constant; the period only counts cycles."""

    value_mm: Real = Field(description="displacement U_a")
    period_s: Positive = Field(description="period T, only to count cycles")

    @property
    def period(self) -> float:
        return self.period_s

    @property
    def mean(self) -> float:
        return self.value_mm

    def gradient(self, phase: FloatArray) -> dict[str, FloatArray]:
        return {"value_mm": np.ones(phase.shape)}


@table("load", kind="force")
class Force(_Level, SceneTable):
    """R_a constant: wear is its integral, problem (i) of the note, and the displacement follows.

    The contact needs `width_mm` and `length_mm`; its pressure is R_a/(b L).
    """

    force_N: Positive = Field(description="reaction R_a of the pin")
    period_s: Positive = Field(description="period T, only to count cycles")

    @property
    def period(self) -> float:
        return self.period_s

    @property
    def mean(self) -> float:
        return self.force_N

    def gradient(self, phase: FloatArray) -> dict[str, FloatArray]:
        return {"force_N": np.ones(phase.shape)}


def sampled(loads: Sequence[Load], phases: FloatArray) -> FloatArray:
    """U_a in mm of many loads, each at phases (loads, ...) of its own; sines all at once."""
    amplitudes = [load.amplitude_mm for load in loads if isinstance(load, Sine)]
    if len(amplitudes) == len(loads):
        unit = Sine(1.0, 1.0)(phases)
        return np.array(amplitudes).reshape(-1, *[1] * (phases.ndim - 1)) * unit
    if all(load is loads[0] for load in loads):
        return loads[0](phases)
    return np.stack([load(x) for load, x in zip(loads, phases, strict=True)])
