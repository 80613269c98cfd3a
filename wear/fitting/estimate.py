"""`fit`: the parameters of a scene from measured wear, and how certain they are.

Residuals are those of the logarithm of the wear, or of the wear; their scatter is given with the
readings, or unknown. Intervals are profile likelihoods (W. Q. Meeker, L. A. Escobar, *Statistical
Methods for Reliability Data*, Wiley 1998, chapter 8; D. M. Bates, D. G. Watts, *Nonlinear
Regression Analysis*, Wiley 1988, chapter 6): an end that the data leave open is infinite.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from wear.faults import UsageError
from wear.fitting import model as models
from wear.fitting.least_squares import estimate
from wear.fitting.model import RTOL, Model, Parameter
from wear.fitting.readings import FloatArray, Specimen, read_readings
from wear.fitting.residuals import rms
from wear.progress import Pace

if TYPE_CHECKING:
    from wear.scene import Scene

CONFIDENCE = 0.95
FARTHEST = 7.0  # e-folds (a factor of a thousand), or multiples of its size, that it is followed
LEAST = 1e-7  # singular value, of the largest: below are the errors of the derivatives


class Profile(NamedTuple):
    """Profile likelihood of one parameter: values (n,) ascending, the root of the deviance at each
    in standard deviations (n,), and the interval in which it is below its 95 % quantile."""

    values: FloatArray
    roots: FloatArray
    interval: tuple[float, float]


@dataclass(frozen=True)
class Fit:
    """Parameters estimated from measured wear.

    `theta` (p,) holds the estimates, in logarithms where positive; `profiles` is empty where
    intervals were not asked for.
    """

    model: Model
    theta: FloatArray
    profiles: tuple[Profile, ...] = ()

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
        return self.model(self.theta[None])

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
        return self.model.residuals.aicc(self.residuals, len(self.theta))

    @cached_property
    def scatter(self) -> float:
        """Return the standard deviation of a residual: 1 where it was given, otherwise estimated,
        and infinite where there is no reading to spare for it."""
        if self.model.residuals.known:
            return 1.0
        if self.degrees_of_freedom == 0:
            return float(np.inf)
        level = np.log(np.maximum(self.model.residuals.observed, 1e-300))
        least = 10.0 * RTOL * rms(self.model.residuals.slope(level))
        return float(max(np.sqrt(self.chi_square / self.degrees_of_freedom), least))

    @property
    def quantile(self) -> float:
        """Return how many standard deviations a 95 % interval extends."""
        from scipy import stats

        law = stats.norm if self.model.residuals.known else stats.t(self.degrees_of_freedom)
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

    model = prepare(data, as_scene(scene), free, free_each, error, ignore)
    model = replace(model, pace=Pace(progress))
    found = Fit(model, estimate(model))
    return profiles(found) if intervals else found


def prepare(
    data: str | os.PathLike[str] | Sequence[Specimen],
    scene: Scene,
    free: Sequence[str],
    free_each: Sequence[str],
    error: str,
    ignore: Sequence[str],
) -> Model:
    """Return the model of a fit, or raise a `UsageError` with all that is wrong with it."""
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
    return Model.of(scene, specimens, free, free_each, error == "relative")
