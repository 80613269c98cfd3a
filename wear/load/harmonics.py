"""Displacements given by Fourier coefficients, with their extremes to roundoff."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import cached_property, partial
from typing import Annotated, Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, PlainValidator

from wear.load.periodic import Smooth, centred, cosine_and_sine, within_cycle
from wear.numerics.floating_point import ROUNDOFF
from wear.numerics.gauss import FloatArray
from wear.validation import Positive, Real, numbers, table

MOST_HARMONICS = 100
Coefficients = Annotated[tuple[float, ...], PlainValidator(partial(numbers, most=MOST_HARMONICS))]
SLOPE_ROUNDOFF = 8 * ROUNDOFF  # of the slope's terms, each times its order


@table("load", kind="harmonics")
class Harmonics(Smooth):
    """U_a = mean + sum over j = 1, 2, ... of cosine_j cos(2 pi j t/T) + sine_j sin(2 pi j t/T)."""

    mean_mm: Real = Field(description="mean of U_a")
    cosine_mm: Coefficients = Field(description="cosine_1, cosine_2, ...")
    sine_mm: Coefficients = Field(description="sine_1, sine_2, ...")
    period_s: Positive = Field(description="period T of a cycle")
    left_out: ClassVar[Mapping[str, Any]] = {"mean_mm": 0.0, "cosine_mm": (), "sine_mm": ()}

    def __call__(self, phase: FloatArray | float) -> FloatArray:
        return self.mean_mm + _trigonometric_sum(self.terms(), phase)

    def slope(self, phase: FloatArray | float) -> FloatArray:
        return _trigonometric_sum(derivative(self.terms()), phase)

    def gradient(self, phase: FloatArray) -> dict[str, FloatArray]:
        turn = 2.0 * math.pi * centred(phase)
        found = {"mean_mm": np.ones(turn.shape)}
        for name, wave in (("cosine_mm", np.cos), ("sine_mm", np.sin)):
            for j in range(len(getattr(self, name))):
                found[f"{name}[{j}]"] = wave((j + 1) * turn)
        return found

    def terms(self) -> FloatArray:
        """Return the rows j, cosine_j, sine_j of the harmonics."""
        terms = np.zeros((3, max(len(self.cosine_mm), len(self.sine_mm))))
        terms[0] = np.arange(1, terms.shape[1] + 1)
        terms[1, : len(self.cosine_mm)] = self.cosine_mm
        terms[2, : len(self.sine_mm)] = self.sine_mm
        return terms

    @property
    def mean(self) -> float:
        return self.mean_mm

    @cached_property
    def minimum(self) -> float:
        return float(np.min(self(self._turning_points)))

    @cached_property
    def maximum(self) -> float:
        return float(np.max(self(self._turning_points)))

    @cached_property
    def peaks(self) -> tuple[float, ...]:
        turning, terms = self._turning_points, derivative(self.terms())
        slope_after = self.slope(0.5 * (turning + np.append(turning[1:], turning[0] + 1.0)))
        # Next to a flat top or bottom rounding alone decides whether the load rises.
        largest = np.sum(terms[0] * np.sum(np.abs(terms[1:]), axis=0))
        known = np.flatnonzero(np.abs(slope_after) > SLOPE_ROUNDOFF * largest)
        rises = slope_after[known] > 0.0
        tops = turning[known[np.roll(rises, 1) & ~rises]]
        return tuple(tops.tolist()) or (0.0,)

    @cached_property
    def _turning_points(self) -> FloatArray:
        """Return phases in [0, 1), increasing, that contain those of zero slope; at least one."""
        return _zeros(derivative(self.terms()))


class Waves(NamedTuple):
    """The `mean` (k,) and `terms` (3, n, k), rows j, cosine_j, sine_j, of the displacements in many
    cycles, and the terms of their slopes."""

    mean: FloatArray
    terms: FloatArray
    slopes: FloatArray

    def take(self, which: NDArray[Any]) -> Waves:
        """Return the displacements in some of the cycles."""
        return Waves(self.mean[which], self.terms[..., which], self.slopes[..., which])

    def __call__(self, phase: FloatArray) -> FloatArray:
        """Return the displacement (mm) at phases (..., k)."""
        return self.mean + _polynomial(self.terms, phase)

    def slope(self, phase: FloatArray) -> FloatArray:
        """Return its derivative with respect to the phase, mm."""
        return _polynomial(self.slopes, phase)


def _trigonometric_sum(terms: FloatArray, phase: FloatArray | float) -> FloatArray:
    within = centred(phase)
    total = np.zeros_like(within)
    for order, *amplitudes in zip(*terms, strict=True):
        for amplitude, wave in zip(amplitudes, cosine_and_sine(order * within), strict=True):
            total += amplitude * wave
    return total


def _polynomial(terms: FloatArray, phase: FloatArray) -> FloatArray:
    """Return the trigonometric sum to a few roundoffs times the highest order: the real part of a
    polynomial in exp(2 pi i phase), by Horner's rule, which is faster for many harmonics."""
    cosine, sine = cosine_and_sine(phase)
    if terms.shape[1] == 1:
        return np.asarray(terms[1, 0] * cosine + terms[2, 0] * sine)
    wave = np.empty(cosine.shape, dtype=complex)
    wave.real, wave.imag = cosine, sine
    *lower, highest = terms[1] - 1j * terms[2]
    total = highest * wave
    for coefficient in reversed(lower):
        total += coefficient
        total *= wave
    return np.asarray(total.real)


def derivative(terms: FloatArray) -> FloatArray:
    order, cosine, sine = terms
    return np.stack([order, 2.0 * math.pi * order * sine, -2.0 * math.pi * order * cosine])


def _zeros(terms: FloatArray) -> FloatArray:
    """Return phases in [0, 1), increasing, that contain the zeros of a zero-mean trigonometric sum.

    With z = exp(2 pi i phase) the sum is a polynomial of degree 2n in z over z^n, and its zeros are
    the roots on the unit circle. The roots come from the companion pencil, which stays accurate
    when the leading coefficient is small; Newton's iteration brings the simple ones to roundoff.
    Multiple roots leave the circle by a root of the roundoff, so a wide ring is kept: a phase too
    many does no harm where extremes are sought.
    """
    size = np.max(np.abs(terms[1:]), initial=0.0)
    if size == 0.0:
        return np.zeros(1)
    cosine, sine = terms[1:] / size  # while real: a subnormal size would overflow complex ones
    half = cosine - 1j * sine
    alpha, beta = _roots(np.concatenate([half[::-1], [0.0], half.conj()]))
    ring = np.abs(np.abs(alpha) - np.abs(beta)) < 0.2 * np.abs(alpha)
    phases = np.angle(alpha[ring] * beta[ring].conj()) / (2.0 * math.pi)
    slopes = derivative(terms)
    for _ in range(4):
        slope = _trigonometric_sum(slopes, phases)
        step = np.divide(
            _trigonometric_sum(terms, phases), slope, out=np.zeros_like(phases), where=slope != 0.0
        )
        phases = phases - np.where(np.abs(step) < 1e-3 / terms.shape[1], step, 0.0)
    return np.unique(within_cycle(np.append(phases, 0.0)) % 1.0)


def _roots(coefficients: NDArray[np.complex128]) -> tuple[NDArray[np.complex128], ...]:
    """Return the roots alpha/beta of a polynomial, its highest power first."""
    from scipy.linalg import eigvals  # takes longer to import than all else here

    degree = len(coefficients) - 1
    companion = np.eye(degree, k=-1, dtype=np.complex128)
    companion[0] = -coefficients[1:]
    lead = np.eye(degree, dtype=np.complex128)
    lead[0, 0] = coefficients[0]
    alpha, beta = eigvals(companion, lead, homogeneous_eigvals=True)
    return alpha, beta
