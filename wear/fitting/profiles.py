"""Profile likelihoods: the range of a parameter within the data, the others being fitted to it.

The end of an interval is the farthest value of the parameter at which the sum of squares is at its
limit (D. J. Venzon, S. H. Moolgavkar, Applied Statistics 37, 87, 1988). A step leads to the end in
the linearised model; the steps of all ends are one batch of scenes. Parameters of single specimens
are not moved beside shared ones: their intervals are those of the linearised model.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from wear.fitting.estimate import LEAST_SLOPE, PARAMETER_RANGE, RANK_TOLERANCE, Estimate
from wear.fitting.least_squares import descend
from wear.fitting.model import Linearised
from wear.numerics.floating_point import TINY
from wear.numerics.gauss import FloatArray, IntArray
from wear.numerics.rows import take

LEVELS = (0.5, 1.0)  # of the deviance's root, in quantiles, at which a profile is drawn
END_TOLERANCE = 0.01  # of the quantile: accuracy of an end
OPEN_END_ERROR = 0.1  # of the quantile: an end with a larger error is open
FIRST_STEP, LENGTHENED, SHORTENED = 1.0, 2.0, 0.4  # bound of a step in e-folds, or sizes
MOST_STEPS = 25  # to each of the levels
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
        ends = _Ends(fit)
        for level in LEVELS:
            ends.move_to(level * fit.quantile * fit.scatter, say)
        if not ends.least < fit.chi_square - WORTHWHILE_GAIN * fit.scatter**2:
            break
        fit = Estimate(fit.model, descend(fit.model, ends.best, fit.box, say))
    made = {number: ends.profile(2 * i) for i, number in enumerate(moved(fit))}
    return fit, tuple(made.get(i) or _linear(fit, i) for i in range(len(fit.theta)))


def moved(fit: Estimate) -> list[int]:
    """Return the indices of the parameters with a profile: the shared ones, or all without any."""
    shared = [i for i, parameter in enumerate(fit.parameters) if not parameter.specimen]
    return shared or list(range(len(fit.parameters)))


class _Ends:
    """Both ends of the intervals of all moved parameters (k,): the number of the parameter, the
    `side` to which it moves, the points `at` which the model was evaluated last (k, ...), and
    whether the data leave it `unbounded` (k,); with the `best` point seen, of the `least` sum of
    squares."""

    def __init__(self, fit: Estimate) -> None:
        self.fit, self.number = fit, np.repeat(moved(fit), 2)
        self.side = np.tile([-1.0, 1.0], len(self.number) // 2)
        self.at = take(fit.best, np.zeros(len(self.number), dtype=int))
        self.unbounded = np.full(len(self.number), False)
        self.best, self.least = fit.best, fit.chi_square
        self.seen = [(self.at.theta, np.zeros(len(self.number)))]

    def move_to(self, level: float, say: Callable[[str], None]) -> None:
        """Move the ends until the root of the deviance is at a `level`, in units of residuals."""
        fit, far = self.fit, PARAMETER_RANGE * self.fit.scale
        low, high = fit.theta - far, fit.theta + far
        longest, active = np.full(len(self.number), FIRST_STEP), np.flatnonzero(~self.unbounded)
        slack = np.full(len(self.number), fit.quantile * fit.scatter)
        ends, roots = self.at.theta.copy(), self._root(self.at)
        for _ in range(MOST_STEPS):
            say(f"ends of intervals: {len(active)} left to be found")
            number, before, rows = (
                self.number[active],
                take(self.at, active),
                np.arange(len(active)),
            )
            linear = LinearModel.of(before.residuals, before.slope * fit.scale, number)
            step = linear.farthest(self.side[active], fit.chi_square + level**2)
            distance, next_step = (
                np.abs(x)[rows, number] for x in ((before.theta - fit.theta) / fit.scale, step)
            )
            converged = np.abs(roots[active] - level) <= END_TOLERANCE * level
            converged &= next_step <= END_TOLERANCE * distance
            # The last step of Newton's method is not evaluated any more.
            ends[active[converged]] = (before.theta + step * fit.scale)[converged]
            roots[active[converged]] = level
            left = ~converged & ~self.unbounded[active]
            active, number, step, before = (
                active[left],
                number[left],
                step[left],
                take(before, left),
            )
            if not len(active):
                break
            limit = np.maximum(level + slack[active], roots[active])
            step *= np.minimum(1.0, longest[active] / np.max(np.abs(step), axis=1))[:, None]
            # At a bound the whole step is shortened: clipped, it would leave the valley.
            room = np.where(step > 0.0, high - before.theta, before.theta - low) / fit.scale
            step *= np.minimum(1.0, np.min(room / (np.abs(step) + TINY), axis=1))[:, None]
            trial = fit.model(before.theta + step * fit.scale)
            bad = self._root(trial) > limit
            bad &= trial.slope.any(axis=(1, 2))  # where there is a scene
            if bad.any():  # the valley bends: the other parameters follow
                there = take(trial, bad)
                near = LinearModel.of(there.residuals, there.slope * fit.scale, number[bad])
                followed = np.clip(there.theta + near.steps_of_others() * fit.scale, low, high)
                trial = trial.with_rows(bad, fit.model(followed))
            self._remember(trial)
            root = self._root(trial)
            good = root <= limit
            longest[active] *= np.where(good, LENGTHENED, SHORTENED)
            slack[active] *= np.where(good & (root > level), SHORTENED, 1.0)
            accepted = active[good]
            self.at = self.at.with_rows(accepted, take(trial, good))
            ends[accepted], roots[accepted] = trial.theta[good], root[good]
            self.unbounded[active] = good & np.any(
                np.abs(trial.theta - fit.theta) > 0.999 * far, axis=1
            )
        self.unbounded[active] |= np.abs(roots - level)[active] > OPEN_END_ERROR * level
        self.seen.append((ends, roots / fit.scatter))

    def profile(self, end: int) -> Profile:
        """Return the profile between an end and the next, in the unit of its parameter."""
        fit, number, unbounded = self.fit, self.number[end], self.unbounded[end : end + 2]
        points, roots = (np.array(each) for each in zip(*self.seen, strict=True))
        theta = np.concatenate([points[::-1, end, number], points[1:, end + 1, number]])
        roots = np.concatenate([roots[::-1, end], roots[1:, end + 1]])
        values = fit.parameters[number].value(theta)
        interval = np.where(unbounded, [-np.inf, np.inf], values[[0, -1]])
        # Towards an open end only values below the quantile are drawn.
        drawn = np.append(np.diff(theta) > 0.0, True) & (
            (roots < fit.quantile) | ~np.where(theta < fit.theta[number], *unbounded)
        )
        return Profile(values[drawn], roots[drawn], (float(interval[0]), float(interval[1])))

    def _root(self, points: Linearised) -> FloatArray:
        return np.asarray(np.sqrt(np.maximum(points.costs - self.fit.chi_square, 0.0)))

    def _remember(self, points: Linearised) -> None:
        lowest = np.argmin(points.costs)
        if points.costs[lowest] < self.least:
            self.best, self.least = take(points, np.array([lowest])), float(points.costs[lowest])


class LinearModel(NamedTuple):
    """The model linearised at points (k,), one parameter of each being moved: the step `down`
    (k, p) to the `least` sum of squares (k,), the step `along` (k, p) of all parameters as this one
    moves by 1, and its change `width` (k,) where the sum is larger by 1."""

    down: FloatArray
    least: FloatArray
    along: FloatArray
    width: FloatArray
    number: IntArray

    @classmethod
    def of(cls, residuals: FloatArray, slope: FloatArray, number: IntArray) -> LinearModel:
        """Return the linear model of residuals (k, n) with this `slope` (k, n, p), the parameters
        of these numbers (k,) being moved."""
        _, values, rows = np.linalg.svd(slope, full_matrices=False)
        told = np.maximum(values, RANK_TOLERANCE * values[:, :1] + LEAST_SLOPE)
        part = np.swapaxes(rows, 1, 2) / told[:, None]
        covariance = part @ np.swapaxes(part, 1, 2)
        gradient = np.einsum("knp,kn->kp", slope, residuals)
        down = -np.einsum("kpq,kq->kp", covariance, gradient)
        least = np.sum(residuals**2, axis=1) + np.sum(gradient * down, axis=1)
        across = covariance[np.arange(len(number)), number]
        own = np.take_along_axis(across, number[:, None], axis=1)
        return cls(down, least, across / own, np.sqrt(own[:, 0]), number)

    def farthest(self, side: FloatArray, limit: float) -> FloatArray:
        """Return the steps (k, p) to the farthest points on a `side` (k,) with a sum of squares of
        `limit`."""
        distance = side * self.width * np.sqrt(np.maximum(limit - self.least, 0.0))
        return np.asarray(self.down + distance[:, None] * self.along)

    def steps_of_others(self) -> FloatArray:
        """Return the steps (k, p) to the least sum of squares with the moved parameters fixed."""
        own = np.take_along_axis(self.down, self.number[:, None], axis=1)
        return np.asarray(self.down - own * self.along)


def _linear(fit: Estimate, index: int) -> Profile:
    """Return the profile of a parameter in the linearised model."""
    parameter, limit = fit.parameters[index], fit.quantile
    width = limit * float(fit.spread(np.eye(len(fit.theta))[index]))
    farthest = PARAMETER_RANGE * float(fit.scale[index])
    steps = min(width, farthest) * np.array([-1.0, 0.0, 1.0])
    values = parameter.value(fit.theta[index] + steps)
    ends = (float(values[0]), float(values[2])) if width < farthest else (-np.inf, np.inf)
    return Profile(values, np.abs(steps) * limit / width, ends)
