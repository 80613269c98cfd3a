"""Profile likelihoods: how far a parameter goes before the data object, all others following.

The end of an interval is the farthest value of the parameter at which the sum of squares is at its
limit (D. J. Venzon, S. H. Moolgavkar, Applied Statistics 37, 87, 1988). A step leads to where it is
in the linearised model; those of all ends are one batch of scenes. What each specimen has for
itself beside shared parameters is not moved: its interval is that of the linearised model.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from wear.fitting.estimate import FARTHEST, LEAST, Estimate
from wear.fitting.least_squares import descend
from wear.numerics.gauss import FloatArray, IntArray
from wear.numerics.tolerances import TINY

SHARES = (0.5, 1.0)  # of the quantile, at which a profile is drawn
NEAR = 0.01  # of the quantile: how closely an end is sought
ROUGHLY = 0.1  # of the quantile: an end that is not found to that is open
FIRST, LONGER, SHORTER = 1.0, 2.0, 0.4  # e-folds, or sizes, of the longest step; the next
MOST_STEPS = 25  # to each share
MOST_DESCENTS = 3  # where a profile finds a better estimate
BETTER = 0.5  # of the variance: worth another descent; less widens an interval by 6 % at most


class Profile(NamedTuple):
    """Profile likelihood of one parameter: values (n,) ascending, the root of the deviance at each
    in standard deviations (n,), and the interval in which it is below its 95 % quantile."""

    values: FloatArray
    roots: FloatArray
    interval: tuple[float, float]


def profiles(found: Estimate, say: Callable[[str], None]) -> tuple[Estimate, tuple[Profile, ...]]:
    """Return the profile likelihoods of an estimate, and the better estimate that they came upon,
    or the same."""
    if not np.isfinite(found.scatter):
        nothing, opened = np.array([0.0]), (-np.inf, np.inf)
        return found, tuple(Profile(np.array([x]), nothing, opened) for x in found.estimates)
    for _ in range(MOST_DESCENTS):
        ends = _Ends(found)
        for share in SHARES:
            ends.go(share * found.quantile * found.scatter, say)
        if not ends.least < found.chi_square - BETTER * found.scatter**2:
            break
        box = found.theta, FARTHEST * found.scale
        found = Estimate(found.model, descend(found.model, ends.best[None], box, say)[0][0])
    made = {number: ends.profile(2 * i) for i, number in enumerate(moved(found))}
    return found, tuple(made.get(i) or _linear(found, i) for i in range(len(found.theta)))


def moved(found: Estimate) -> list[int]:
    """Return which parameters have a profile: the shared ones, or all if none is shared."""
    shared = [i for i, parameter in enumerate(found.parameters) if not parameter.specimen]
    return shared or list(range(len(found.parameters)))


class _Ends:
    """The two ends (k,) of the intervals of all parameters that are moved: the number of each, the
    `side` to which it moves, the `points` (k, p) where they are, and whether the data leave them
    `opened` (k,); with the `best` point seen, of the `least` sum of squares."""

    def __init__(self, found: Estimate) -> None:
        self.found, self.number = found, np.repeat(moved(found), 2)
        self.side = np.tile([-1.0, 1.0], len(self.number) // 2)
        self.points = np.tile(found.theta, (len(self.number), 1))
        self.opened = np.full(len(self.number), False)
        self.best, self.least = found.theta, found.chi_square
        self.seen = [(self.points.copy(), np.zeros(len(self.number)))]

    def go(self, level: float, say: Callable[[str], None]) -> None:
        """Move on to where the root of the deviance is at a `level`, in units of residuals."""
        found, far = self.found, FARTHEST * self.found.scale
        low, high = found.theta - far, found.theta + far
        off, slope = found.model(self.points)
        longest, todo = np.full(len(self.number), FIRST), np.flatnonzero(~self.opened)
        slack = np.full(len(self.number), found.quantile * found.scatter)
        for _ in range(MOST_STEPS):
            if not len(todo):
                break
            say(f"ends of intervals: {len(todo)} left to be found")
            number, before, own = self.number[todo], self.points[todo], np.arange(len(todo))
            most = np.maximum(level + slack[todo], self._root(off[todo]))
            linear = Linearised.of(off[todo], slope[todo] * found.scale, number)
            step = linear.farthest(self.side[todo], found.chi_square + level**2)
            step *= np.minimum(1.0, longest[todo] / np.max(np.abs(step), axis=1))[:, None]
            # Cut off at a bound it would leave the valley: it ends there as a whole.
            room = np.where(step > 0.0, high - before, before - low) / found.scale
            step *= np.minimum(1.0, np.min(room / (np.abs(step) + TINY), axis=1))[:, None]
            trial = before + step * found.scale
            trial_off, trial_slope = found.model(trial)
            bad = self._root(trial_off) > most
            if bad.any():  # the valley bends: the other parameters follow
                near = Linearised.of(trial_off[bad], trial_slope[bad] * found.scale, number[bad])
                trial[bad] = np.clip(trial[bad] + near.followed() * found.scale, low, high)
                trial_off[bad], trial_slope[bad] = found.model(trial[bad])
            self._remember(trial, trial_off)
            root = self._root(trial_off)
            good = root <= most
            longest[todo] *= np.where(good, LONGER, SHORTER)
            slack[todo] *= np.where(good & (root > level), SHORTER, 1.0)
            way, moved_by = (np.abs(trial - x)[own, number] for x in (found.theta, before))
            there = (np.abs(root - level) <= NEAR * level) & (moved_by <= NEAR * way)
            won = todo[good]
            for whole, part in zip(
                (self.points, off, slope), (trial, trial_off, trial_slope), strict=True
            ):
                whole[won] = part[good]
            self.opened[todo] = good & np.any(np.abs(trial - found.theta) > 0.999 * far, axis=1)
            todo = todo[~(good & there) & ~self.opened[todo]]
        root = self._root(off)
        self.opened[todo] |= np.abs(root - level)[todo] > ROUGHLY * level
        self.seen.append((self.points.copy(), root / found.scatter))

    def profile(self, end: int) -> Profile:
        """Return the profile between an end and the next, in the unit of its parameter."""
        found, number, opened = self.found, self.number[end], self.opened[end : end + 2]
        points, roots = (np.array(each) for each in zip(*self.seen, strict=True))
        theta = np.concatenate([points[::-1, end, number], points[1:, end + 1, number]])
        roots = np.concatenate([roots[::-1, end], roots[1:, end + 1]])
        values = found.parameters[number].value(theta)
        interval = np.where(opened, [-np.inf, np.inf], values[[0, -1]])
        # What is drawn of an open end comes to no end either.
        drawn = np.append(np.diff(theta) > 0.0, True) & (
            (roots < found.quantile) | ~np.where(theta < found.theta[number], *opened)
        )
        return Profile(values[drawn], roots[drawn], (float(interval[0]), float(interval[1])))

    def _root(self, off: FloatArray) -> FloatArray:
        deviance = np.sum(off**2, axis=1) - self.found.chi_square
        return np.asarray(np.sqrt(np.maximum(deviance, 0.0)))

    def _remember(self, points: FloatArray, off: FloatArray) -> None:
        for point, cost in zip(points, np.sum(off**2, axis=1).tolist(), strict=True):
            if cost < self.least:
                self.best, self.least = point, cost


class Linearised(NamedTuple):
    """The model linearised at points (k,), in each of which one parameter is moved: the step `down`
    (k, p) to the `least` sum of squares (k,), the step `along` (k, p) by which the others follow
    the one as it moves by 1, and by how much (k,) it varies where the sum is larger by 1."""

    down: FloatArray
    least: FloatArray
    along: FloatArray
    width: FloatArray
    number: IntArray

    @classmethod
    def of(cls, off: FloatArray, slope: FloatArray, number: IntArray) -> Linearised:
        """Return the same for residuals `off` (k, n) with this `slope` (k, n, p), if parameters of
        these numbers (k,) are moved."""
        _, values, rows = np.linalg.svd(slope, full_matrices=False)
        part = np.swapaxes(rows, 1, 2) / np.maximum(values, LEAST * values[:, :1])[:, None]
        covariance = part @ np.swapaxes(part, 1, 2)
        gradient = np.einsum("knp,kn->kp", slope, off)
        down = -np.einsum("kpq,kq->kp", covariance, gradient)
        least = np.sum(off**2, axis=1) + np.sum(gradient * down, axis=1)
        across = covariance[np.arange(len(number)), number]
        own = np.take_along_axis(across, number[:, None], axis=1)
        return cls(down, least, across / own, np.sqrt(own[:, 0]), number)

    def farthest(self, side: FloatArray, limit: float) -> FloatArray:
        """Return the steps (k, p) to where the parameters are farthest to a `side` (k,) with a sum
        of squares of `limit`."""
        way = side * self.width * np.sqrt(np.maximum(limit - self.least, 0.0))
        return np.asarray(self.down + way[:, None] * self.along)

    def followed(self) -> FloatArray:
        """Return the steps (k, p) to the least sum of squares that leave the parameters."""
        own = np.take_along_axis(self.down, self.number[:, None], axis=1)
        return np.asarray(self.down - own * self.along)


def _linear(found: Estimate, index: int) -> Profile:
    """Return the profile of a parameter in the linearised model."""
    parameter, limit = found.parameters[index], found.quantile
    width = limit * float(found.spread(np.eye(len(found.theta))[index]))
    farthest = FARTHEST * float(found.scale[index])
    steps = min(width, farthest) * np.array([-1.0, 0.0, 1.0])
    values = parameter.value(found.theta[index] + steps)
    ends = (float(values[0]), float(values[2])) if width < farthest else (-np.inf, np.inf)
    return Profile(values, np.abs(steps) * limit / width, ends)
