"""What every method gives: the wear after the cycles that it reached."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from wear.orbit.problem import Cost


class Outcome(NamedTuple):
    """Wear `u` (mm) by a `method` after those `cycles` that were reached, in rising order, its
    estimated relative `error`, NaN where there is none, and the cost.

    `stopped` says why cycles are missing (None: none are), and `interrupted` whether that was the
    user or the clock.
    """

    method: str
    cycles: tuple[int, ...]
    u: NDArray[np.float64]
    error: NDArray[np.float64]
    cost: Cost
    notices: tuple[str, ...] = ()
    stopped: str | None = None
    interrupted: bool = False
