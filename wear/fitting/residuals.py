"""Residuals of measured wear, and the information criterion of a law."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from wear.fitting.readings import Specimen
from wear.numerics.gauss import FloatArray

MISSING = 1e3  # difference without wear: e-folds, or mm


@dataclass(frozen=True)
class Residuals:
    """Differences between a law and the readings.

    Attributes
    ----------
    observed, weight
        Wear (n,) in mm; factor of the differences (n,), one over their standard error.
    relative
        Whether differences are those of the logarithm of the wear; otherwise of the wear in mm.
    known
        Whether the scatter is known; otherwise every weight is 1.
    """

    observed: FloatArray
    weight: FloatArray
    relative: bool
    known: bool

    @classmethod
    def of(cls, specimens: Sequence[Specimen], relative: bool) -> Residuals:
        """Return the residuals of these readings, one specimen after the other."""
        observed = np.concatenate([s.wear_mm for s in specimens])
        errors = [s.standard_error_mm for s in specimens if s.standard_error_mm is not None]
        if len(errors) < len(specimens):
            return cls(observed, np.ones(len(observed)), relative, known=False)
        weight = (observed if relative else 1.0) / np.concatenate(errors)
        return cls(observed, weight, relative, known=True)

    @property
    def missing(self) -> float:
        """Return the residual of a reading without wear: more than any other."""
        return MISSING * float(np.max(self.weight))

    def __call__(self, log_wear: FloatArray) -> FloatArray:
        """Return the residuals (..., n)."""
        with np.errstate(all="ignore"):
            difference = log_wear - np.log(self.observed) if self.relative else (
                np.exp(log_wear) - self.observed
            )  # fmt: skip
        return np.asarray(self.weight * difference)

    def slope(self, log_wear: FloatArray) -> FloatArray:
        """Return the derivatives of the residuals with respect to the logarithm of the wear."""
        factor = np.ones_like(log_wear) if self.relative else np.exp(log_wear)
        return np.asarray(self.weight * factor)

    def aicc(self, residuals: FloatArray, parameters: int) -> float:
        """Return the corrected information criterion of Akaike for normal residuals, but for a
        constant (C. M. Hurvich, C.-L. Tsai, Biometrika 76, 1989); an unknown scatter counts as one
        more parameter. Infinite where the readings are too few."""
        n, k = len(residuals), parameters + (not self.known)
        if n <= k + 1:
            return float(np.inf)
        square = float(residuals @ residuals)
        misfit = square if self.known else n * np.log(max(square, 1e-300) / n)
        return float(misfit + 2.0 * k * n / (n - k - 1))


def rms(residuals: FloatArray) -> float:
    """Return the root mean square."""
    return float(np.sqrt(np.mean(np.square(residuals))))
