"""The request for an orbit: the equation with its scales, and the cycles; and its cost."""

from __future__ import annotations

import time
from typing import NamedTuple, Protocol

import numpy as np

from wear.numerics.gauss import FloatArray
from wear.orbit.period_map import Equation, Selection

MOST_EVALUATIONS = 2e7  # of a scene with up to MANY breakpoints, else in proportion
MANY = 100


class Cost(NamedTuple):
    """The cost of a result: numbers of cycles integrated and of right-hand sides evaluated."""

    cycles_integrated: int
    rhs_evaluations: int

    def plus(self, cycles: int, evaluations: int) -> Cost:
        """Return the cost after more work."""
        return Cost(self.cycles_integrated + cycles, self.rhs_evaluations + evaluations)


class Problem(Equation, Protocol):
    """The equation of some scenes (s,) with the scales of its states."""

    @property
    def scale(self) -> FloatArray:
        """Return the change of the state (s,) that changes the rate by a factor of order one."""

    @property
    def limit(self) -> FloatArray:
        """Return the states (s,) from which on the rate has no meaning, infinite if none has."""

    @property
    def breakpoints(self) -> list[FloatArray]:
        """Return the phases, from 0 to 1, between which the rate of each scene is smooth."""

    def take(self, rows: Selection) -> Problem: ...

    def roundoff(self, u: FloatArray) -> FloatArray:
        """Return the relative error of the rate by rounding at states u (s, k), at most."""


class Request(NamedTuple):
    """A request for some scenes (s,): `cycles` from the states `start`, known up to `start_error`;
    nothing is refined after the `deadline` (`time.monotonic()`)."""

    cycles: FloatArray
    start: FloatArray
    start_error: FloatArray
    deadline: float = np.inf

    @property
    def late(self) -> bool:
        """Return whether the deadline has passed."""
        return time.monotonic() > self.deadline


def most_evaluations(problem: Problem) -> FloatArray:
    """Return the right-hand sides (s,) after which a scene is refined no more: then the error
    estimate exceeds the tolerance."""
    numbers = np.array([len(phases) for phases in problem.breakpoints])
    return MOST_EVALUATIONS * np.maximum(1.0, numbers / MANY)
