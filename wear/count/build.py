"""Cycles near a kink of the period map, integrated one by one."""

from typing import NamedTuple

import numpy as np

from wear.numerics.gauss import FloatArray
from wear.numerics.tolerances import TINY

NO_DIGIT = 0.1  # relative error


class CycleCount(NamedTuple):
    """Cycles that were integrated one by one: `first` (mm) is the wear after 0, 1, ... of them,
    `first_error` (mm) its estimated error; wear beyond `limit` (mm) has no meaning."""

    first: FloatArray
    first_error: FloatArray
    limit: float

    @property
    def last_wear(self) -> float:
        """Return the wear (mm) up to which it counts."""
        return float(self.first[-1])

    @property
    def rests(self) -> bool:
        """Return whether its last cycle adds nothing, and so no cycle after it."""
        return not np.sum(np.diff(self.first[-2:])) > 0

    @property
    def reach(self) -> float:
        """Return how many cycles it counts."""
        return np.inf if self.rests else len(self.first) - 1.0

    @property
    def pace(self) -> float:
        """Return the wear (mm) that its first cycle adds."""
        return float(np.sum(np.diff(self.first[:2])))


def evaluate(counted: CycleCount, cycles: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the wear (mm) after `cycles` and its estimated relative error, infinite where out of
    reach."""
    index = np.minimum(cycles, len(counted.first) - 1).astype(int)
    wear, error = counted.first[index], counted.first_error[index]
    error = error / np.where(wear > 0, wear, 1.0)
    # A discretisation that has not a digit right does not know its error either.
    known = (wear < (1 - 1e-9) * counted.limit) & (error < NO_DIGIT) & (cycles <= counted.reach)
    return np.minimum(wear, counted.limit), np.where(known, error, np.inf)


def until(counted: CycleCount, wear: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Whole cycles after which each wear (mm) is first reached, infinite where the count ends
    before, and the estimated error in cycles."""
    # A wear that is reached at the very end of a cycle must not ask for another one.
    told = counted.first_error <= NO_DIGIT * counted.first
    exact = counted.first + np.where(told, counted.first_error, 0.0)
    index = np.searchsorted(exact, wear, side="left")
    late = index == len(exact)
    count = np.where(late, np.inf, index)
    # From the least count to the largest, at the pace of the cycle after: that of wear slows down.
    pace = np.diff(counted.first) if len(counted.first) > 1 else np.array([counted.pace])
    after, before = np.append(pace, pace[-1]), np.append(pace[0], pace)
    after = np.where(after > 0, after, before)[: len(counted.first)]
    blur = np.where(told, 2 * counted.first_error / (after + TINY), np.inf)
    error = np.append(blur, 0.0)[index]
    return count, error
