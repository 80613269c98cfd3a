"""What the figures draw: arrays with names. No matplotlib here."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Line:
    """One curve: `name` may hold mathtext, `x` and `y` are of one shape (n,).

    Lines of one `family` share colour and marker, `variant` sets them apart by dash (with the
    cutoff, say, or an asymptote).
    """

    name: str
    x: FloatArray
    y: FloatArray
    family: int = 0
    variant: int = 0

    def __post_init__(self) -> None:
        if np.shape(self.x) != np.shape(self.y) or np.ndim(self.x) != 1 or not np.size(self.x):
            raise ValueError(
                f"line {self.name!r}: x and y must be of one shape (n,) with n > 0, "
                f"got {np.shape(self.x)} and {np.shape(self.y)}"
            )


@dataclass(frozen=True)
class Method:
    """Time against true error of one method: arrays of shape (n,), n tolerances.

    `failed` marks runs that stopped early or missed their tolerance by far; they are drawn hollow.
    """

    name: str
    error: FloatArray
    seconds: FloatArray
    failed: NDArray[np.bool_]


@dataclass(frozen=True)
class Regime:
    """A range of f_c with the name of what happens there."""

    name: str
    start: float
    end: float


@dataclass(frozen=True)
class Threshold:
    """A value of f_c that parts two regimes, or only seems to."""

    name: str
    value: float
