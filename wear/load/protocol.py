"""What a load that repeats has to offer."""

from __future__ import annotations

from typing import Protocol

from wear.numerics.gauss import FloatArray


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
        """dU_a/dp at `phase`, in its shape, for every number p of the load but its period, by the
        key of p in the scene file; a list's entries are counted from 0."""

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
