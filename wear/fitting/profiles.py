"""Profile likelihoods: a parameter is moved, all others follow.

The ends of all intervals are sought side by side, so that each round is one batch of scenes. What
each specimen has for itself beside shared parameters is not moved: its interval is that of the
linearised model.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from wear.fitting.estimate import FARTHEST, Estimate
from wear.fitting.least_squares import ROUGHLY, follow, settle
from wear.fitting.readings import FloatArray

FLAT = 0.02  # of the slope that the root of the deviance has at the estimate: it rises no more
NEAR = 0.01  # of the quantile: how closely the end of an interval is sought
FIRST, FARTHER = 1.0, 2.5  # e-folds, or sizes, of the first step; times as far for the next
MOST_ROUNDS, MOST_STEPS = 8, 15
MOST_DESCENTS = 3  # where a profile finds a better estimate
BETTER = 0.5  # of the variance: worth another descent; less widens an interval by 6 % at most


class Profile(NamedTuple):
    """Profile likelihood of one parameter: values (n,) ascending, the root of the deviance at each
    in standard deviations (n,), and the interval in which it is below its 95 % quantile."""

    values: FloatArray
    roots: FloatArray
    interval: tuple[float, float]


@dataclass
class _End:
    """One end of an interval: what is moved, how far it went, the root of the deviance there."""

    index: int
    side: float
    error: float  # standard error of the parameter
    farthest: float
    path: FloatArray  # how all parameters move with it
    step: float  # the next
    inner: float = 0.0
    below: float = 0.0  # root of the deviance at `inner`
    outer: float = np.inf
    above: float = np.inf
    unfollowed: bool = False  # at `outer` another parameter can follow no farther
    done: bool = False
    seen: dict[float, float] = field(default_factory=dict)  # where all others could follow

    def learn(self, point: FloatArray, root: float, limit: float, unfollowed: bool) -> None:
        """Take in the root of the deviance at the step, (p,) away from the estimate, and choose
        the next."""
        if not unfollowed:
            self.seen[self.side * self.step] = root
        if root < limit:
            self.path = point / (self.side * self.step)
            flat = root - self.below < FLAT * (self.step - self.inner) / self.error
            self.inner, self.below = self.step, root
            if np.isinf(self.outer):
                self.done = flat or self.step >= self.farthest
                farther = self.step * min(FARTHER, 1.1 * limit / max(root, 1e-9))
                self.step = min(farther, self.farthest)
                return
        else:
            self.outer, self.above, self.unfollowed = self.step, root, unfollowed
        self.done = abs(root / limit - 1.0) < NEAR and np.isfinite(self.outer)
        self.step = self.inner + (self.outer - self.inner) * min(self._share(limit), 0.95)

    def value(self, limit: float) -> float:
        """Return the step at which the root of the deviance comes to the limit, infinite if it does
        not, or not for the data's sake."""
        if np.isinf(self.outer) or (self.unfollowed and self.below < (1.0 - NEAR) * limit):
            return np.inf
        return self.inner + (self.outer - self.inner) * self._share(limit)

    def _share(self, limit: float) -> float:
        return (limit - self.below) / (min(self.above, 3.0 * limit) - self.below)


def profiles(found: Estimate, say: Callable[[str], None]) -> tuple[Estimate, tuple[Profile, ...]]:
    """Return the profile likelihoods of an estimate, and the better estimate that they came upon,
    or the same."""
    if not np.isfinite(found.scatter):
        nothing, opened = np.array([0.0]), (-np.inf, np.inf)
        return found, tuple(Profile(np.array([x]), nothing, opened) for x in found.estimates)
    for _ in range(MOST_DESCENTS):
        ends, best, cost = _followed(found, say)
        if not cost < found.chi_square - BETTER * found.scatter**2:
            break
        found = Estimate(found.model, settle(found.model, best, _box(found), say))
    made = {end.index: _profile(found, end, high)
            for end, high in zip(ends[::2], ends[1::2], strict=True)}  # fmt: skip
    indices = range(len(found.theta))
    return found, tuple(made.get(i) or _linear(found, i) for i in indices)


def moved(found: Estimate) -> list[int]:
    """Return which parameters have a profile: the shared ones, or all if none is shared."""
    shared = [i for i, parameter in enumerate(found.parameters) if not parameter.specimen]
    return shared or list(range(len(found.parameters)))


def _followed(found: Estimate, say: Callable[[str], None]) -> tuple[list[_End], FloatArray, float]:
    """Return the ends, low and high in turn, and the best point seen with its sum of squares: of
    those that are not out at the bounds, where a valley that the data leave open has no end."""
    errors = found.spread(np.eye(len(found.theta)))
    covariance = found.covariance
    limit, best, least = found.quantile, found.theta, found.chi_square
    ends = []
    for index in moved(found):
        error = float(errors[index])
        for side in (-1.0, 1.0):
            farthest = FARTHEST * float(found.scale[index])
            step = min(limit * error, FIRST * float(found.scale[index]))
            path = covariance[:, index] / covariance[index, index]
            ends.append(_End(index, side, error, farthest, path, step))
    for _ in range(MOST_ROUNDS):
        active = [end for end in ends if not end.done]
        if not active:
            break
        starts = np.array([found.theta + end.side * end.step * end.path for end in active])
        fixed = np.arange(len(found.theta)) == np.array([[end.index] for end in active])
        points, costs = follow(found.model, starts, fixed, _box(found), ROUGHLY, MOST_STEPS, say)
        for end, point, cost in zip(active, points, costs.tolist(), strict=True):
            at_bound = np.abs(point - found.theta) > 0.999 * FARTHEST * found.scale
            if cost < least and not at_bound.any():
                best, least = point, cost
            root = float(np.sqrt(max(cost - found.chi_square, 0.0))) / found.scatter
            unfollowed = bool(np.delete(at_bound, end.index).any())
            end.learn(point - found.theta, root, limit, unfollowed)
    return ends, best, least


def _box(found: Estimate) -> tuple[FloatArray, FloatArray]:
    """Return where the other parameters may follow."""
    return found.theta, FARTHEST * found.scale


def _linear(found: Estimate, index: int) -> Profile:
    """Return the profile of a parameter in the linearised model."""
    parameter, limit = found.parameters[index], found.quantile
    width = limit * float(found.spread(np.eye(len(found.theta))[index]))
    farthest = FARTHEST * float(found.scale[index])
    steps = min(width, farthest) * np.array([-1.0, 0.0, 1.0])
    values = parameter.value(found.theta[index] + steps)
    ends = (float(values[0]), float(values[2])) if width < farthest else (-np.inf, np.inf)
    return Profile(values, np.abs(steps) * limit / width, ends)


def _profile(found: Estimate, low: _End, high: _End) -> Profile:
    """Return the profile of a parameter, in its own unit."""
    parameter, theta = found.parameters[low.index], found.theta[low.index]
    seen = {0.0: 0.0} | low.seen | high.seen
    steps = np.array(sorted(seen))
    interval = [
        float(parameter.value(theta + end.side * step)) if np.isfinite(step) else end.side * step
        for end, step in ((end, end.value(found.quantile)) for end in (low, high))
    ]
    roots = np.array([seen[step] for step in steps.tolist()])
    return Profile(parameter.value(theta + steps), roots, (interval[0], interval[1]))
