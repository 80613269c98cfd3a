"""Parameters estimated by least squares, with their uncertainty in the linearised model.

The scatter of the residuals is given with the readings, or unknown (D. M. Bates, D. G. Watts,
*Nonlinear Regression Analysis*, Wiley 1988, chapter 2).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from wear.fitting.model import RTOL, FitModel, Linearised, Parameter
from wear.fitting.residuals import rms
from wear.numerics.gauss import FloatArray

CONFIDENCE = 0.95
PARAMETER_RANGE = 7.0  # on each side: e-folds (a factor of a thousand), or sizes
RANK_TOLERANCE = 1e-7  # of the largest singular value: smaller ones are errors of the derivatives
LEAST_SLOPE = 1e-90  # of residuals: without any, the standard error is as good as infinite


@dataclass(frozen=True, eq=False)
class Estimate:
    """A model and its `best` point, that of least squares."""

    model: FitModel
    best: Linearised

    @property
    def theta(self) -> FloatArray:
        """Return the estimates (p,), as logarithms where only positive numbers make a scene."""
        return np.asarray(self.best.theta[0])

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """Return the parameters that were free."""
        return self.model.parameters

    @property
    def estimates(self) -> list[float]:
        """Return the estimates in the units of their keys."""
        return self.model.values(self.theta)

    @property
    def residuals(self) -> FloatArray:
        """Return the residuals (n,), over the scatter where that is known."""
        return np.asarray(self.best.residuals[0])

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
        """Return the standard deviation of a residual.

        It is 1 where the readings have standard errors, otherwise estimated, and infinite without
        a degree of freedom.
        """
        if self.model.residuals.known:
            return 1.0
        if self.degrees_of_freedom == 0:
            return float(np.inf)
        level = np.log(np.maximum(self.model.residuals.observed, 1e-300))
        least = 10.0 * RTOL * rms(self.model.residuals.slope(level))
        return float(max(np.sqrt(self.chi_square / self.degrees_of_freedom), least))

    @property
    def quantile(self) -> float:
        """Return the half width of a 95 % interval in standard deviations."""
        from scipy.special import ndtri, stdtrit

        share, freedom = (1.0 + CONFIDENCE) / 2.0, self.degrees_of_freedom
        if not np.isfinite(self.scatter):
            return np.inf
        return float(ndtri(share) if self.model.residuals.known else stdtrit(freedom, share))

    @cached_property
    def scale(self) -> FloatArray:
        """Return the size (p,) of every parameter, see `Model.scale`."""
        return self.model.scale(self.theta)

    @property
    def box(self) -> tuple[FloatArray, FloatArray]:
        """Return the centre and the half widths (p,) of the range of the parameters."""
        return self.theta, PARAMETER_RANGE * self.scale

    @cached_property
    def _modes(self) -> tuple[FloatArray, FloatArray]:
        """Return the `directions` for residuals with a scatter of 1."""
        _, values, rows = np.linalg.svd(self.best.slope[0] * self.scale)
        return 1.0 / np.maximum(values, RANK_TOLERANCE * values[0] + LEAST_SLOPE), rows

    @property
    def directions(self) -> tuple[FloatArray, FloatArray]:
        """Return the standard errors (p,) along the principal directions of the covariance, and
        these directions (p, p), one a row, relative to `scale`."""
        return self.scatter * self._modes[0], self._modes[1]

    def factors(self, gradients: FloatArray) -> FloatArray:
        """Return the factor F (m, p) of the covariance F F^T of quantities with these gradients
        (m, p) in theta, for residuals with a scatter of 1."""
        errors, rows = self._modes
        return np.asarray((gradients * self.scale) @ rows.T * errors)

    def spread(self, gradients: FloatArray) -> FloatArray:
        """Return the standard errors (m,) of quantities with these gradients (m, p) in theta."""
        return np.asarray(self.scatter * np.linalg.norm(self.factors(gradients), axis=-1))

    @property
    def covariance(self) -> FloatArray:
        """Return the covariance (p, p) of theta; it is huge along directions that the data do not
        determine."""
        factors = self.scatter * self.factors(np.eye(len(self.theta)))
        return np.asarray(factors @ factors.T)

    @property
    def standard_errors(self) -> list[float]:
        """Return the standard errors of the estimates in the units of their keys, infinite where
        the data do not determine them."""
        errors = self.spread(np.eye(len(self.theta)))
        known = errors < PARAMETER_RANGE * self.scale
        sizes = [value if p.positive else 1.0
                 for p, value in zip(self.parameters, self.estimates, strict=True)]  # fmt: skip
        return [float(x) for x in np.where(known, errors * sizes, np.inf)]

    @property
    def correlation(self) -> FloatArray:
        """Return the correlation (p, p) of the estimates."""
        factors = self.factors(np.eye(len(self.theta)))
        factors /= np.linalg.norm(factors, axis=1, keepdims=True)
        return np.asarray(factors @ factors.T)
