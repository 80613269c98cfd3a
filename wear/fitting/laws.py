"""Simpler laws that the data are held against: constant Archard wear, a power, a logarithm.

Each has a scale for every specimen and, but for Archard's, one number that all share. They are
compared by the corrected information criterion of Akaike (C. M. Hurvich, C.-L. Tsai, Biometrika 76,
1989) and by how well the first half of the readings foretells the last.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from wear.fitting.readings import FloatArray, Specimen

Shape = Callable[[FloatArray, float], FloatArray]

LAWS: dict[str, tuple[Shape, tuple[float, float] | None]] = {
    "archard": (lambda cycles, _: np.log(cycles), None),
    "power": (lambda cycles, power: power * np.log(cycles), (0.0, 2.0)),
    "logarithm": (lambda cycles, scale: np.log(np.log1p(cycles * np.exp(scale))), (-30.0, 30.0)),
}
"""The logarithm of each law but for the scale, and the range of the number that is shared."""


@dataclass(frozen=True)
class Alternative:
    """How a law does: root mean square of the residuals of ln(wear), AICc, and the root mean square
    of its forecast of the last reading of each specimen from the first half of them."""

    law: str
    rms: float
    aicc: float
    forecast_rms: float


def alternatives(specimens: Sequence[Specimen]) -> tuple[Alternative, ...]:
    """Return how each law does on these specimens."""
    early = [half(specimen) for specimen in specimens]
    last = [specimen.cycles[-1:] for specimen in specimens]
    found = []
    for law, (shape, interval) in LAWS.items():
        _, residuals = _fitted(shape, interval, specimens)
        parameters = len(specimens) + (interval is not None) + 1  # the scatter is one
        shared_early, _ = _fitted(shape, interval, early)
        missed = [
            float((np.log(s.wear_mm[-1]) - _level(shape, part, shared_early, at))[0])
            for s, part, at in zip(specimens, early, last, strict=True)
        ]
        found.append(
            Alternative(law, rms(residuals), aicc(residuals, parameters), rms(np.array(missed)))
        )
    return tuple(found)


def half(specimen: Specimen) -> Specimen:
    """Return the first half of the readings of a specimen."""
    first = slice(0, (len(specimen.cycles) + 1) // 2)
    error = specimen.standard_error_mm
    return Specimen(specimen.name, specimen.cycles[first], specimen.wear_mm[first],
                    None if error is None else error[first], specimen.changes)  # fmt: skip


def rms(residuals: FloatArray) -> float:
    """Return the root mean square."""
    return float(np.sqrt(np.mean(np.square(residuals))))


def aicc(residuals: FloatArray, parameters: int) -> float:
    """Return the corrected information criterion of normal residuals of unknown scatter; infinite
    where there are too few readings for it."""
    n = len(residuals)
    if n <= parameters + 1:
        return float(np.inf)
    penalty = 2.0 * parameters * n / (n - parameters - 1)
    return float(n * np.log(2 * np.pi * np.mean(residuals**2)) + n + penalty)


def _fitted(
    shape: Shape, interval: tuple[float, float] | None, specimens: Sequence[Specimen]
) -> tuple[float, FloatArray]:
    """Return the shared number and the residuals (n,) of least squares."""
    from scipy.optimize import minimize_scalar

    def residuals(shared: float) -> FloatArray:
        return np.concatenate(
            [np.log(s.wear_mm) - _level(shape, s, shared, s.cycles) for s in specimens]
        )

    if interval is None:
        return 0.0, residuals(0.0)
    best = minimize_scalar(
        lambda shared: float(np.sum(residuals(shared) ** 2)), bounds=interval, method="bounded",
        options={"xatol": 1e-10},
    )  # fmt: skip
    return float(best.x), residuals(float(best.x))


def _level(shape: Shape, specimen: Specimen, shared: float, cycles: FloatArray) -> FloatArray:
    """Return the logarithm of the wear after `cycles`, with the scale that fits the specimen."""
    scale = np.mean(np.log(specimen.wear_mm) - shape(specimen.cycles, shared))
    return np.asarray(scale + shape(cycles, shared))
