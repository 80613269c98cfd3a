"""The outcome of every method: the wear after the cycles that it reached."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from wear.orbit.problem import Cost

STOPS = "wear stops for good in cycle {}"
FADES = "wear approaches its limit; within rounding from cycle {} on"


class Outcome(NamedTuple):
    """Wear `u` (mm) by a `method` after the `cycles` reached, in ascending order, its estimated
    relative `error` (NaN if unknown) and the cost.

    `stopped` is the reason why cycles are missing (None if complete), `interrupted` whether that
    was the user or the time limit.
    """

    method: str
    cycles: tuple[int, ...]
    u: NDArray[np.float64]
    error: NDArray[np.float64]
    cost: Cost
    notices: tuple[str, ...] = ()
    stopped: str | None = None
    interrupted: bool = False
