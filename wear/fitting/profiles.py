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

from wear.fitting.estimate import PARAMETER_RANGE, RANK_TOLERANCE, Estimate
from wear.fitting.least_squares import descend
from wear.numerics.floating_point import TINY
from wear.numerics.gauss import FloatArray, IntArray

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
        theta, _ = descend(fit.model, ends.best[None], fit.box, say)
        fit = Estimate(fit.model, theta[0])
    made = {number: ends.profile(2 * i) for i, number in enumerate(moved(fit))}
    return fit, tuple(made.get(i) or _linear(fit, i) for i in range(len(fit.theta)))


def moved(fit: Estimate) -> list[int]:
    """Return the indices of the parameters with a profile: the shared ones, or all without any."""
    shared = [i for i, parameter in enumerate(fit.parameters) if not parameter.specimen]
    return shared or list(range(len(fit.parameters)))


class _Ends:
    """Both ends of the intervals of all moved parameters (k,): the number of the parameter, the
    `side` to which it moves, the `points` (k, p) reached, and whether the data leave it `unbounded`
    (k,); with the `best` point seen, of the `least` sum of squares."""

    def __init__(self, fit: Estimate) -> None:
        self.fit, self.number = fit, np.repeat(moved(fit), 2)
        self.side = np.tile([-1.0, 1.0], len(self.number) // 2)
        self.points = np.tile(fit.theta, (len(self.number), 1))
        self.unbounded = np.full(len(self.number), False)
        self.best, self.least = fit.theta, fit.chi_square
        self.seen = [(self.points.copy(), np.zeros(len(self.number)))]

    def move_to(self, level: float, say: Callable[[str], None]) -> None:
        """Move the ends until the root of the deviance is at a `level`, in units of residuals."""
        fit, far = self.fit, PARAMETER_RANGE * self.fit.scale
        low, high = fit.theta - far, fit.theta + far
        residuals, slope = fit.model(self.points)
        longest, active = np.full(len(self.number), FIRST_STEP), np.flatnonzero(~self.unbounded)
        slack = np.full(len(self.number), fit.quantile * fit.scatter)
        for _ in range(MOST_STEPS):
            if not len(active):
                break
            say(f"ends of intervals: {len(active)} left to be found")
            number, before, rows = self.number[active], self.points[active], np.arange(len(active))
            limit = np.maximum(level + slack[active], self._root(residuals[active]))
            linear = LinearModel.of(residuals[active], slope[active] * fit.scale, number)
            step = linear.farthest(self.side[active], fit.chi_square + level**2)
            step *= np.minimum(1.0, longest[active] / np.max(np.abs(step), axis=1))[:, None]
            # At a bound the whole step is shortened: clipped, it would leave the valley.
            room = np.where(step > 0.0, high - before, before - low) / fit.scale
            step *= np.minimum(1.0, np.min(room / (np.abs(step) + TINY), axis=1))[:, None]
            trial = before + step * fit.scale
            residuals_there, trial_slope = fit.model(trial)
            bad = self._root(residuals_there) > limit
            bad &= trial_slope.any(axis=(1, 2))  # where there is a scene
            if bad.any():  # the valley bends: the other parameters follow
                near = LinearModel.of(
                    residuals_there[bad], trial_slope[bad] * fit.scale, number[bad]
                )
                trial[bad] = np.clip(trial[bad] + near.steps_of_others() * fit.scale, low, high)
                residuals_there[bad], trial_slope[bad] = fit.model(trial[bad])
            self._remember(trial, residuals_there)
            root = self._root(residuals_there)
            good = root <= limit
            longest[active] *= np.where(good, LENGTHENED, SHORTENED)
            slack[active] *= np.where(good & (root > level), SHORTENED, 1.0)
            distance, moved_by = (np.abs(trial - x)[rows, number] for x in (fit.theta, before))
            converged = np.abs(root - level) <= END_TOLERANCE * level
            converged &= moved_by <= END_TOLERANCE * distance
            accepted = active[good]
            for whole, part in zip(
                (self.points, residuals, slope), (trial, residuals_there, trial_slope), strict=True
            ):
                whole[accepted] = part[good]
            self.unbounded[active] = good & np.any(np.abs(trial - fit.theta) > 0.999 * far, axis=1)
            active = active[~(good & converged) & ~self.unbounded[active]]
        root = self._root(residuals)
        self.unbounded[active] |= np.abs(root - level)[active] > OPEN_END_ERROR * level
        self.seen.append((self.points.copy(), root / fit.scatter))

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

    def _root(self, residuals: FloatArray) -> FloatArray:
        deviance = np.sum(residuals**2, axis=1) - self.fit.chi_square
        return np.asarray(np.sqrt(np.maximum(deviance, 0.0)))

    def _remember(self, points: FloatArray, residuals: FloatArray) -> None:
        for point, cost in zip(points, np.sum(residuals**2, axis=1).tolist(), strict=True):
            if cost < self.least:
                self.best, self.least = point, cost


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
        part = np.swapaxes(rows, 1, 2) / np.maximum(values, RANK_TOLERANCE * values[:, :1])[:, None]
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
