"""`fit`: the parameters of a scene from measured wear, and how certain they are.

Residuals are those of the logarithm of the wear, or of the wear; their scatter is given with the
readings, or unknown. Intervals are profile likelihoods (W. Q. Meeker, L. A. Escobar, *Statistical
Methods for Reliability Data*, Wiley 1998, chapter 8; D. M. Bates, D. G. Watts, *Nonlinear
Regression Analysis*, Wiley 1988, chapter 6): an end that the data leave open is infinite.
"""

from __future__ import annotations

import itertools
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from wear.faults import UsageError
from wear.fitting import model as models
from wear.fitting.model import RTOL, Model, Parameter
from wear.fitting.readings import FloatArray, Specimen, read_readings
from wear.fitting.residuals import Residuals, rms
from wear.progress import Pace

if TYPE_CHECKING:
    from wear.scene import Scene

CONFIDENCE = 0.95
FARTHEST = 7.0  # e-folds (a factor of a thousand), or multiples of its size, that it is followed
SEARCHED = 20.0  # the same, around the scene, for the estimate
LEAST = 1e-7  # singular value, of the largest: below are the errors of the derivatives
LOST = 1e3  # residual where a point has no scene or no wear
FACTORS = tuple(10.0**power for power in range(-2, 3))  # of wear coefficients, to start from
GROWTHS = (0.08, 0.15, 0.25, 0.4)  # of roughness, to start from
FOLLOWED = 4  # starts
ROUGHLY, CLOSELY = 1e-4, 1e-9  # of the sum of squares: how closely its least is sought
DAMPING, HOPELESS = 1e-3, 1e8  # of a Gauss-Newton step: first, and where none descends


class Profile(NamedTuple):
    """Profile likelihood of one parameter: values (n,) ascending, the root of the deviance at each
    in standard deviations (n,), and the interval in which it is below its 95 % quantile."""

    values: FloatArray
    roots: FloatArray
    interval: tuple[float, float]


@dataclass(frozen=True)
class Problem:
    """The least squares problem: residuals and their exact Jacobian at points theta."""

    model: Model
    residuals: Residuals
    pace: Pace = field(default_factory=Pace, compare=False)

    def __call__(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return residuals (m, n) and Jacobian (m, n, p) at points (m, p)."""
        level, slope = self.model.log_wear(points, self.model.cycles)
        off = self.residuals(level)
        slope = self.residuals.slope(level)[..., None] * slope
        fine = np.isfinite(off) & np.all(np.isfinite(slope), axis=-1)
        return np.where(fine, off, LOST), np.where(fine[..., None], slope, 0.0)

    def cost(self, points: FloatArray) -> FloatArray:
        """Return the sums of the squared residuals (m,)."""
        return np.asarray(np.sum(self(points)[0] ** 2, axis=1))

    def follow(
        self,
        starts: FloatArray,
        fixed: NDArray[np.bool_],
        box: tuple[FloatArray, FloatArray],
        accuracy: float,
        most: int,
    ) -> tuple[FloatArray, FloatArray]:
        """Return points (m, p) of least squares near each start and their sums of squares (m,),
        with the `fixed` (m, p) parameters held, in a box given by its centre and half widths (p,).

        Levenberg and Marquardt's method (J. Nocedal, S. J. Wright, *Numerical Optimization*,
        Springer 2006, section 10.3) with a damping for every start: each round is one batch of
        scenes, of those that still descend by more than the `accuracy` of their sum of squares.
        """
        low, high = box[0] - box[1], box[0] + box[1]
        points = np.where(fixed, starts, np.clip(starts, low, high))
        off, slope = self(points)
        costs = np.sum(off**2, axis=1)
        damping, todo = np.full(len(points), DAMPING), np.arange(len(points))
        for _ in range(most):
            self.pace.say(f"least sum of squares: {costs.min():.6g}, searches left: {len(todo)}")
            J = np.where(fixed[todo, None], 0.0, slope[todo])
            normal = np.swapaxes(J, 1, 2) @ J
            diagonal = np.einsum("mii->mi", normal)  # a view
            diagonal += damping[todo, None] * diagonal + np.where(diagonal > 0.0, 0.0, 1.0)
            step = np.linalg.solve(normal, -np.einsum("mnp,mn->mp", J, off[todo])[..., None])
            trial = np.clip(points[todo] + step[..., 0], low, high)
            trial = np.where(fixed[todo], points[todo], trial)
            trial_off, trial_slope = self(trial)
            trial_costs = np.sum(trial_off**2, axis=1)
            better = trial_costs < costs[todo]
            little = np.abs(costs[todo] - trial_costs) <= accuracy * costs[todo]
            won = todo[better]
            points[won], costs[won] = trial[better], trial_costs[better]
            off[won], slope[won] = trial_off[better], trial_slope[better]
            damping[todo] *= np.where(better, 0.1, 8.0)
            todo = todo[~(little | (damping[todo] > HOPELESS))]
            if not len(todo):
                break
        return points, costs

    def estimate(self) -> FloatArray:
        """Return the point (p,) of least squares, from several starts.

        Wear coefficients and roughness growths are tried on a grid, free roughnesses also as large
        as the wear calls for, which grows in proportion to them. Raises `UsageError` where no start
        has any wear, or a parameter no influence.
        """
        starts = self._starts()
        off, slope = self(starts)
        fine = np.all(np.abs(off) < LOST, axis=1)
        if not fine.any():
            raise UsageError("no start leads to a scene with wear: correct the scene")
        idle = np.all(slope == 0.0, axis=(0, 1))
        if idle.any():
            names = [str(p) for p, none in zip(self.model.parameters, idle, strict=True) if none]
            raise UsageError("\n".join(f"free: {name}: has no influence" for name in names))
        starts = np.concatenate([starts, self._in_proportion(starts[fine])])
        best = starts[np.argsort(self.cost(starts), kind="stable")[:FOLLOWED]]
        centre = self.model.start()
        box = centre, SEARCHED * self.model.scale(centre)
        near, costs = self.follow(best, np.zeros(best.shape, dtype=bool), box, ROUGHLY, 30)
        return self.settle(near[np.argmin(costs)], box)

    def settle(self, start: FloatArray, box: tuple[FloatArray, FloatArray]) -> FloatArray:
        """Return the point (p,) of least squares next to a point."""
        none = np.zeros((1, len(start)), dtype=bool)
        points, _ = self.follow(start[None], none, box, CLOSELY, 60)
        return np.asarray(points[0])

    def _starts(self) -> FloatArray:
        """Return the scene's own point and, around it, a grid over what wear depends on most."""
        choices = [
            [p.theta(models.given(self.model.scene, p.key) or 0.0)] for p in self.model.parameters
        ]
        for choice, p in zip(choices, self.model.parameters, strict=True):
            if not p.specimen and p.key.endswith(".wear_coefficient"):
                choice[:] = [choice[0] + np.log(factor) for factor in FACTORS]
            elif not p.specimen and p.key.endswith(".roughness_growth"):
                choice += GROWTHS
        return np.array(list(itertools.product(*choices)))

    def _in_proportion(self, starts: FloatArray) -> FloatArray:
        """Return the starts with free roughnesses as much larger as the last wear read is."""
        level, _ = self.model.log_wear(starts, [s.cycles[-1:] for s in self.model.specimens])
        wear = np.array([max(s.wear_mm[-1], 1e-30) for s in self.model.specimens])
        off = np.log(wear) - level
        scaled = starts.copy()
        for i, p in enumerate(self.model.parameters):
            if p.key.endswith(".roughness_mm"):
                own = [p.specimen in ("", s.name) for s in self.model.specimens]
                scaled[:, i] += off[:, own].mean(axis=1)
        return scaled


@dataclass(frozen=True)
class Fit:
    """Parameters estimated from measured wear.

    `theta` (p,) holds the estimates, in logarithms where positive; `profiles` is empty where
    intervals were not asked for.
    """

    problem: Problem
    theta: FloatArray
    profiles: tuple[Profile, ...] = ()

    @property
    def model(self) -> Model:
        """Return the specimens, their scene and what is free in it."""
        return self.problem.model

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """Return the parameters that were free."""
        return self.model.parameters

    @property
    def estimates(self) -> list[float]:
        """Return the estimates in the units of their keys."""
        return self.model.values(self.theta)

    @cached_property
    def _at_theta(self) -> tuple[FloatArray, FloatArray]:
        return self.problem(self.theta[None])

    @property
    def residuals(self) -> FloatArray:
        """Return the residuals (n,), over the scatter where that is known."""
        return np.asarray(self._at_theta[0][0])

    @property
    def degrees_of_freedom(self) -> int:
        """Return the number of readings less that of parameters."""
        return len(self.residuals) - len(self.theta)

    @property
    def chi_square(self) -> float:
        """Return the sum of the squared residuals."""
        return float(self.residuals @ self.residuals)

    @property
    def rms(self) -> float:
        """Return the root mean square of the residuals."""
        return rms(self.residuals)

    @property
    def aicc(self) -> float:
        """Return the corrected information criterion, see `Residuals.aicc`."""
        return self.problem.residuals.aicc(self.residuals, len(self.theta))

    @cached_property
    def scatter(self) -> float:
        """Return the standard deviation of a residual: 1 where it was given, otherwise estimated,
        and infinite where there is no reading to spare for it."""
        if self.problem.residuals.known:
            return 1.0
        if self.degrees_of_freedom == 0:
            return float(np.inf)
        level = np.log(np.maximum(self.problem.residuals.observed, 1e-300))
        least = 10.0 * RTOL * rms(self.problem.residuals.slope(level))
        return float(max(np.sqrt(self.chi_square / self.degrees_of_freedom), least))

    @property
    def quantile(self) -> float:
        """Return how many standard deviations a 95 % interval extends."""
        from scipy import stats

        law = stats.norm if self.problem.residuals.known else stats.t(self.degrees_of_freedom)
        return float(law.ppf((1.0 + CONFIDENCE) / 2.0)) if np.isfinite(self.scatter) else np.inf

    @cached_property
    def scale(self) -> FloatArray:
        """Return the size (p,) of every parameter, see `Model.scale`."""
        return self.model.scale(self.theta)

    @cached_property
    def _modes(self) -> tuple[FloatArray, FloatArray]:
        """What `directions` returns, for residuals with a scatter of 1."""
        _, values, rows = np.linalg.svd(self._at_theta[1][0] * self.scale)
        values = np.append(values, np.zeros(len(self.theta) - len(values)))
        return 1.0 / np.maximum(values, LEAST * values[0]), rows

    @property
    def directions(self) -> tuple[FloatArray, FloatArray]:
        """Return the standard errors (p,) of the directions in which the data see the parameters,
        and the directions (p, p), a row each, relative to their `scale`."""
        return self.scatter * self._modes[0], self._modes[1]

    def spread(self, gradients: FloatArray) -> FloatArray:
        """Return the standard errors (m,) of what has these gradients (m, p) in theta."""
        errors, rows = self._modes
        each = (gradients * self.scale) @ rows.T * errors
        return np.asarray(self.scatter * np.linalg.norm(each, axis=-1))

    @property
    def unscaled_covariance(self) -> FloatArray:
        """Return the covariance (p, p) of theta for residuals with a scatter of 1; of what the data
        do not determine it is huge."""
        errors, rows = self._modes
        part = rows.T * errors * self.scale[:, None]
        return np.asarray(part @ part.T)

    @property
    def covariance(self) -> FloatArray:
        """Return the covariance (p, p) of theta."""
        return self.scatter**2 * self.unscaled_covariance

    @property
    def standard_errors(self) -> list[float]:
        """Return the standard errors of the estimates in the units of their keys, infinite where
        the data do not determine them."""
        errors = self.spread(np.eye(len(self.theta)))
        known = errors < FARTHEST * self.scale
        sizes = [value if p.positive else 1.0
                 for p, value in zip(self.parameters, self.estimates, strict=True)]  # fmt: skip
        return [float(x) for x in np.where(known, errors * sizes, np.inf)]

    @property
    def correlation(self) -> FloatArray:
        """Return the correlation (p, p) of the estimates."""
        covariance = self.unscaled_covariance
        errors = np.sqrt(np.diag(covariance))
        return np.asarray(covariance / np.outer(errors, errors))


def fit(
    data: str | os.PathLike[str] | Sequence[Specimen],
    scene: Scene | str | os.PathLike[str],
    free: Sequence[str] = (),
    free_each: Sequence[str] = (),
    *,
    error: str = "relative",
    ignore: Sequence[str] = (),
    intervals: bool = True,
    progress: Callable[[str], None] = lambda _: None,
) -> Fit:
    """Estimate entries of a scene from measured wear.

    Parameters
    ----------
    data
        A CSV file, see `read_readings`, or specimens.
    scene
        The scene, its name or path: all that is not free, and where the search starts.
    free, free_each
        Entries that are one value for all specimens, or one for each.
    error
        "relative": residuals of the logarithm; "absolute": of the wear.
    ignore
        Columns of the file to drop.
    intervals
        Whether to follow the profile likelihoods, which takes most of the time.
    progress
        Is told in words how far a fit is that takes more than two seconds.

    Raises
    ------
    UsageError
        with everything that is wrong with the request.
    """
    from wear.fitting.profiles import profiles
    from wear.scene import as_scene

    problem = prepare(data, as_scene(scene), free, free_each, error, ignore)
    found = estimated(replace(problem, pace=Pace(progress)))
    return profiles(found) if intervals else found


def prepare(
    data: str | os.PathLike[str] | Sequence[Specimen],
    scene: Scene,
    free: Sequence[str],
    free_each: Sequence[str],
    error: str,
    ignore: Sequence[str],
) -> Problem:
    """Return the problem of a fit, or raise a `UsageError` with all that is wrong with it."""
    faults: list[str] = []
    specimens: tuple[Specimen, ...] = ()
    try:
        from_file = isinstance(data, (str, os.PathLike))
        specimens = read_readings(Path(data), ignore) if from_file else tuple(data)  # type: ignore[arg-type]
    except UsageError as fault:
        faults.append(str(fault))
    faults += models.faults(scene, specimens, free, free_each)
    if error not in ("relative", "absolute"):
        faults.append(f"error: {error!r} is neither relative nor absolute")
    elif error == "relative" and any(np.any(s.wear_mm <= 0.0) for s in specimens):
        faults.append("error: a wear of zero has no logarithm; leave it out, or take absolute")
    if faults:
        raise UsageError("\n".join(faults))
    model = Model.of(scene, specimens, free, free_each)
    return Problem(model, Residuals.of(specimens, error == "relative"))


def estimated(problem: Problem) -> Fit:
    """Return the fit without profile likelihoods."""
    return Fit(problem, problem.estimate())
