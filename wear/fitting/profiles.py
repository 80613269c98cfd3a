"""Profile likelihoods: the range of a parameter within the data, the others being fitted to it.

The parameter is moved to either side and held, while the others descend to their least sum of
squares. The root of the deviance is nearly proportional to the distance (D. M. Bates, D. G. Watts,
*Nonlinear Regression Analysis*, Wiley 1988, 6.1.2), so that a secant soon leads to the end of the
interval, where it is the quantile; all ends are one batch of scenes. Parameters of single specimens
are not moved beside shared ones: their intervals are those of the linearised model.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from wear.fitting.estimate import PARAMETER_RANGE, Estimate
from wear.fitting.least_squares import descend
from wear.numerics.floating_point import TINY
from wear.numerics.gauss import FloatArray

END_TOLERANCE = 0.01  # of the quantile: accuracy of an end
OPEN_END_ERROR = 0.1  # of the quantile: an end with a larger error is open
FIRST_AIM = 0.5  # of the quantile
FIRST_STEP = 1.0  # in e-folds, or sizes, at most; after it the distance is doubled at most
LEAST_RISE = 1e-6  # of the root in a step
MOST_STEPS = 25  # to an end
MOST_DESCENTS = 3  # where a profile finds a better estimate
WORTHWHILE_GAIN = 0.5  # of the variance, for another descent: less widens intervals by 6 % at most


class Profile(NamedTuple):
    """Profile likelihood of one parameter: values (n,) ascending, the root of the deviance at each
    in standard deviations (n,), and the interval in which it is below its 95 % quantile."""

    values: FloatArray
    roots: FloatArray
    interval: tuple[float, float]


def profiles(fit: Estimate, say: Callable[[str], None]) -> tuple[Estimate, tuple[Profile, ...]]:
    """Return the best estimate that the profiles met, or the same, and its profile likelihoods."""
    if not np.isfinite(fit.scatter):
        zero, unbounded = np.array([0.0]), (-np.inf, np.inf)
        return fit, tuple(Profile(np.array([x]), zero, unbounded) for x in fit.estimates)
    for _ in range(MOST_DESCENTS):
        sides = _followed(fit, say)
        best = min((point for side in sides for point in side.points), key=lambda each: each.cost)
        if not best.cost < fit.chi_square - WORTHWHILE_GAIN * fit.scatter**2:
            break
        theta, _ = descend(fit.model, best.theta[None], fit.box, say)
        fit = Estimate(fit.model, theta[0])
    pairs = zip(sides[::2], sides[1::2], strict=True)
    drawn = {low.number: _profile(fit, low, high) for low, high in pairs}
    return fit, tuple(drawn.get(i) or _linear(fit, i) for i in range(len(fit.theta)))


def moved(fit: Estimate) -> list[int]:
    """Return the indices of the parameters with a profile: the shared ones, or all without any."""
    shared = [i for i, parameter in enumerate(fit.parameters) if not parameter.specimen]
    return shared or list(range(len(fit.parameters)))


class _Point(NamedTuple):
    """A point `theta` (p,) of a profile, its sum of squares, the root of its deviance in standard
    deviations, and whether some parameter is at a bound."""

    theta: FloatArray
    cost: float
    root: float
    at_bound: bool


class _Side:
    """One side of the profile of the parameter with a `number`: the `points` met, the last of them
    `below` the quantile and the last `above` it, and the change `secant` (p,) of the parameters
    beyond the former in which the root rises by 1."""

    def __init__(self, fit: Estimate, number: int, sign: float) -> None:
        self.fit, self.number, self.sign = fit, number, sign
        self.below = _Point(fit.theta, fit.chi_square, 0.0, False)
        self.above: _Point | None = None
        self.points = [self.below]
        covariance = fit.covariance[number]
        self.secant = sign * covariance / np.sqrt(covariance[number])

    @property
    def ended(self) -> bool:
        """Return whether the last point is the end, or no point can be farther off."""
        return self._is_end(self.points[-1], END_TOLERANCE) or self.below.at_bound

    @property
    def end(self) -> float:
        """Return the value of theta at the end, infinite where that is open."""
        last = self.points[-1] if self._is_end(self.points[-1], END_TOLERANCE) else self.below
        found = self._is_end(last, OPEN_END_ERROR) and not last.at_bound
        return float(last.theta[self.number]) if found else self.sign * np.inf

    def _is_end(self, point: _Point, tolerance: float) -> bool:
        return abs(point.root - self.fit.quantile) <= tolerance * self.fit.quantile

    def next_start(self) -> FloatArray:
        """Return the point (p,) at which the root is expected to be the quantile, or at first a
        part of that."""
        fit, here = self.fit, self.below
        aim = fit.quantile if len(self.points) > 1 else FIRST_AIM * fit.quantile
        step = (aim - here.root) * self.secant / fit.scale
        if self.above is None:
            longest = np.max(np.abs(here.theta - fit.theta) / fit.scale) or FIRST_STEP
            step *= min(1.0, longest / np.max(np.abs(step)))
        # At a bound the whole step is shortened: clipped, it would leave the valley.
        room = PARAMETER_RANGE - np.sign(step) * (here.theta - fit.theta) / fit.scale
        step *= min(1.0, np.min(room / (np.abs(step) + TINY)))
        return np.asarray(here.theta + step * fit.scale)

    def add(self, theta: FloatArray, cost: float) -> None:
        """Add a point of the profile, with its sum of squares."""
        fit, before = self.fit, self.below
        root = np.sqrt(max(cost - fit.chi_square, 0.0)) / fit.scatter
        at_bound = bool(np.any(np.abs(theta - fit.theta) > 0.999 * fit.box[1]))
        point = _Point(theta, cost, float(root), at_bound)
        self.points.append(point)
        if root < fit.quantile:
            self.below = point
        else:
            self.above = point
        beyond, here = (point, before) if self.above is None else (self.above, self.below)
        # A point far above the quantile is no guide: then the way to it is halved.
        rise = min(beyond.root, 2.0 * fit.quantile) - here.root
        self.secant = (beyond.theta - here.theta) / max(rise, LEAST_RISE)


def _followed(fit: Estimate, say: Callable[[str], None]) -> list[_Side]:
    """Return both sides of the profile of every moved parameter, the lower one first."""
    sides = [_Side(fit, number, sign) for number in moved(fit) for sign in (-1.0, 1.0)]
    for _ in range(MOST_STEPS):
        active = [side for side in sides if not side.ended]
        if not active:
            break
        say(f"ends of intervals: {len(active)} left to be found")
        starts = np.array([side.next_start() for side in active])
        held = np.array([side.number for side in active])
        points, costs = descend(fit.model, starts, fit.box, held=held)
        for side, point, cost in zip(active, points, costs.tolist(), strict=True):
            side.add(point, cost)
    return sides


def _profile(fit: Estimate, low: _Side, high: _Side) -> Profile:
    """Return the profile from both sides, in the unit of its parameter; towards an open end only
    points below the quantile are drawn."""
    parameter, number = fit.parameters[low.number], low.number
    points = [
        point
        for side in (low, high)
        for point in side.points
        if point.root < fit.quantile * (1.0 + END_TOLERANCE * np.isfinite(side.end))
    ]
    theta, first = np.unique([point.theta[number] for point in points], return_index=True)
    roots = np.array([point.root for point in points])[first]
    ends = (parameter.value(np.array(side.end)) if np.isfinite(side.end) else side.end
            for side in (low, high))  # fmt: skip
    return Profile(parameter.value(theta), roots, (float(next(ends)), float(next(ends))))


def _linear(fit: Estimate, index: int) -> Profile:
    """Return the profile of a parameter in the linearised model."""
    parameter, limit = fit.parameters[index], fit.quantile
    width = limit * float(fit.spread(np.eye(len(fit.theta))[index]))
    farthest = PARAMETER_RANGE * float(fit.scale[index])
    steps = min(width, farthest) * np.array([-1.0, 0.0, 1.0])
    values = parameter.value(fit.theta[index] + steps)
    ends = (float(values[0]), float(values[2])) if width < farthest else (-np.inf, np.inf)
    return Profile(values, np.abs(steps) * limit / width, ends)
