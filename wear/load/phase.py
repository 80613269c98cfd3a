"""Phases and times brought into the range of a load, without loss."""

from __future__ import annotations

import numpy as np

from wear.faults import UsageError
from wear.numerics.gauss import FloatArray


def centred(phase: FloatArray | float) -> FloatArray:
    """phase less the nearest whole number: exact for every float, so that no period is lost."""
    given = np.asarray(phase, dtype=np.float64)
    return given - np.rint(given)


def within_cycle(phase: FloatArray | float) -> FloatArray:
    """The phase in [0, 1]."""
    near_zero = centred(phase)
    return np.where(near_zero < 0.0, near_zero + 1.0, near_zero)


def inside(time: FloatArray | float, duration: float) -> FloatArray:
    """`time`, held to [0, duration] where it leaves it by no more than roundoff."""
    given = np.asarray(time, dtype=np.float64)
    slack = 1e-12 * duration
    if not np.all((given >= -slack) & (given <= duration + slack)):
        raise UsageError(f"time outside the load, which lasts {duration!r} s")
    return np.clip(given, 0.0, duration)
