"""The interface of periodic loads, and the exact reduction of phases and times to their range."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar, Protocol

import numpy as np

from wear.faults import UsageError
from wear.numerics.gauss import FloatArray
from wear.validation import SceneTable, table


class Load(Protocol):
    """A periodic displacement. One cycle is one unit of phase, whatever the period."""

    @property
    def period(self) -> float:
        """T in s."""

    def __call__(self, phase: FloatArray | float) -> FloatArray:
        """U_a in mm at phase = t/T, any real number, of any shape."""

    def slope(self, phase: FloatArray | float) -> FloatArray:
        """dU_a/dphase in mm per cycle; at a kink the slope to its right."""

    def gradient(self, phase: FloatArray) -> dict[str, FloatArray]:
        """dU_a/dp at `phase`, in its shape, for every number p of the load except its period, by
        the key of p in the scene file; entries of a list are counted from 0."""

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


@table("")
class Smooth(SceneTable):
    """A load without kinks, whose table has a `period_s`."""

    kinks: ClassVar[tuple[float, ...]] = ()
    if TYPE_CHECKING:
        period_s: float

    @property
    def period(self) -> float:
        return self.period_s


def centred(phase: FloatArray | float) -> FloatArray:
    """Return phase minus the nearest integer, in (-1/2, 1/2]: exact for every float, so that no
    period is lost."""
    given = np.asarray(phase, dtype=np.float64)
    near_zero: FloatArray = given - np.rint(given)
    near_zero += near_zero == -0.5
    return near_zero


def cosine_and_sine(phase: FloatArray | float) -> tuple[FloatArray, FloatArray]:
    """Return cos and sin of 2 pi phase, each to two roundoffs: by the tangent of half the angle,
    which NumPy takes ten times as fast as each of them."""
    tangent = np.tan(np.pi * centred(phase))
    square = tangent * tangent
    return (1.0 - square) / (1.0 + square), 2.0 * tangent / (1.0 + square)


def within_cycle(phase: FloatArray | float) -> FloatArray:
    """Return the phase reduced to [0, 1]."""
    near_zero = centred(phase)
    return np.where(near_zero < 0.0, near_zero + 1.0, near_zero)


def inside(time: FloatArray | float, duration: float) -> FloatArray:
    """Return `time` clipped to [0, duration]; a `UsageError` beyond roundoff outside."""
    given = np.asarray(time, dtype=np.float64)
    slack = 1e-12 * duration
    if not np.all((given >= -slack) & (given <= duration + slack)):
        raise UsageError(f"time outside the load, which lasts {duration!r} s")
    return np.clip(given, 0.0, duration)
