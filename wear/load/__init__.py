"""Loads: the prescribed displacement U_a of the pin, in mm, or its reaction R_a, in N.

A `Load` is periodic, a function of the phase t/T: the displacements `Sine`, `Constant`,
`Harmonics` and `Table`, and the forces `Force` and `ForceTable`. `Blocks` are periodic loads one
after the other, and a `HistoryLoad` is a function of the time in s.
All are frozen and checked where they are made; values, slopes and extremes are exact to rounding.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import ClassVar

import numpy as np
from pydantic import Field

from wear.load.blocks import Block, Blocks
from wear.load.harmonics import Harmonics, Waves, derivative
from wear.load.periodic import Load, Smooth, cosine_and_sine
from wear.load.piecewise_linear import ForceTable, HistoryLoad, HistoryPart, Table
from wear.load.spans import Loading
from wear.numerics.gauss import FloatArray
from wear.validation import Positive, Real, table

__all__ = [
    "Block",
    "Blocks",
    "Constant",
    "Force",
    "ForceTable",
    "Harmonics",
    "HistoryLoad",
    "HistoryPart",
    "Load",
    "Loading",
    "Sine",
    "Table",
    "Waves",
    "sampled",
    "waves",
]


@table("load", kind="sine")
class Sine(Smooth):
    """U_a = U sin(2 pi t/T).

    >>> load = Sine(5e-4, 0.06)
    >>> float(load(0.25)), load.peaks, load.minimum
    (0.0005, (0.25,), -0.0005)
    """

    amplitude_mm: Real = Field(description="amplitude U")
    period_s: Positive = Field(description="period T of a cycle")
    mean: ClassVar[float] = 0.0

    def __call__(self, phase: FloatArray | float) -> FloatArray:
        return np.asarray(self.amplitude_mm * cosine_and_sine(phase)[1])

    def slope(self, phase: FloatArray | float) -> FloatArray:
        return np.asarray(2.0 * math.pi * self.amplitude_mm * cosine_and_sine(phase)[0])

    def gradient(self, phase: FloatArray) -> dict[str, FloatArray]:
        return {"amplitude_mm": cosine_and_sine(phase)[1]}

    def terms(self) -> FloatArray:
        """Return the rows j, cosine_j, sine_j of the harmonics."""
        return np.array([[1.0], [0.0], [self.amplitude_mm]])

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


@table("")
class _Level(Smooth):
    """A constant load; `value_field` names the field of its value."""

    value_field: ClassVar[str] = "value_mm"
    peaks: ClassVar[tuple[float, ...]] = (0.0,)

    @property
    def mean(self) -> float:
        return float(getattr(self, self.value_field))

    def __call__(self, phase: FloatArray | float) -> FloatArray:
        return np.full(np.shape(phase), self.mean)

    def slope(self, phase: FloatArray | float) -> FloatArray:
        return np.zeros(np.shape(phase))

    def gradient(self, phase: FloatArray) -> dict[str, FloatArray]:
        return {self.value_field: np.ones(phase.shape)}

    @property
    def minimum(self) -> float:
        return self.mean

    @property
    def maximum(self) -> float:
        return self.mean


@table("load", kind="constant")
class Constant(_Level):
    """U_a constant; the period only counts cycles."""

    value_mm: Real = Field(description="displacement U_a")
    period_s: Positive = Field(description="period T, only to count cycles")


@table("load", kind="force")
class Force(_Level):
    """R_a constant: wear is its integral, problem (i) of the note, and the displacement follows.

    The contact needs `width_mm` and `length_mm`; its pressure is R_a/(b L).
    """

    value_field: ClassVar[str] = "force_N"
    force_N: Positive = Field(description="reaction R_a of the pin")
    period_s: Positive = Field(description="period T, only to count cycles")


def sampled(loads: Sequence[Load], phases: FloatArray) -> FloatArray:
    """Return U_a in mm of many loads at phases (loads, ...), a row for each; sines all at once."""
    amplitudes = [load.amplitude_mm for load in loads if isinstance(load, Sine)]
    if len(amplitudes) == len(loads):
        unit = Sine(1.0, 1.0)(phases)
        return np.array(amplitudes).reshape(-1, *[1] * (phases.ndim - 1)) * unit
    if all(load is loads[0] for load in loads):
        return loads[0](phases)
    return np.stack([load(x) for load, x in zip(loads, phases, strict=True)])


def waves(loads: Sequence[Load]) -> Waves:
    """Return the displacements of many loads, sines or harmonics."""
    single = [load.terms() for load in loads if isinstance(load, (Sine, Harmonics))]
    terms = np.zeros((3, max(rows.shape[1] for rows in single), len(loads)))
    for k, rows in enumerate(single):
        terms[:, : rows.shape[1], k] = rows
    return Waves(np.array([load.mean for load in loads]), terms, derivative(terms))
