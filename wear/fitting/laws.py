"""Simpler laws for comparison: constant Archard wear, a power, a logarithm.

Each has a scale for every specimen and, except for Archard's, one number common to all.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from wear.fitting.readings import Specimen
from wear.fitting.residuals import Residuals, rms
from wear.numerics.gauss import FloatArray

LAWS: dict[str, tuple[Callable[[FloatArray, float], FloatArray], tuple[float, ...]]] = {
    "archard": (lambda cycles, _: np.log(cycles), ()),
    "power": (lambda cycles, power: power * np.log(cycles), (0.5,)),
    "logarithm": (
        lambda cycles, rate: np.log(np.logaddexp(0.0, np.log(cycles) + rate)),
        (-8.0, -2.0, 4.0),
    ),
}
"""The logarithm of each law without its scale, and starts of the search for the common number: the
power, or the logarithm of a rate."""


OVERFLOW_RESIDUAL = 1e6  # residual of a law that overflows


class Alternative(NamedTuple):
    """A fitted law: root mean square of its residuals, AICc, and the root mean square error of
    ln(wear) where the first half of the readings of each specimen predicts the last."""

    law: str
    rms: float
    aicc: float
    forecast_rms: float


def alternatives(specimens: Sequence[Specimen], relative: bool) -> list[Alternative]:
    """Return the fit of each law to these specimens."""
    early = first_half(specimens)
    residuals = Residuals.of(specimens, relative)
    fits = []
    for law, (_, starts) in LAWS.items():
        levels = _fitted(law, specimens, relative)([s.cycles for s in specimens])
        values = residuals(np.concatenate(levels))
        last = _fitted(law, early, relative)([s.cycles[-1:] for s in specimens])
        parameters = len(specimens) + bool(starts)
        predicted = forecast_rms(specimens, np.concatenate(last))
        fits.append(Alternative(law, rms(values), residuals.aicc(values, parameters), predicted))
    return fits


def first_half(specimens: Sequence[Specimen]) -> list[Specimen]:
    """Return the specimens with the first half of their readings."""
    return [specimen.first((len(specimen.cycles) + 1) // 2) for specimen in specimens]


def forecast_rms(specimens: Sequence[Specimen], log_wear: FloatArray) -> float:
    """Return the root mean square difference between forecasts (specimens,) of ln(wear) and the
    last readings; readings of zero are left out."""
    last = np.array([specimen.wear_mm[-1] for specimen in specimens])
    return rms((log_wear - np.log(np.where(last > 0.0, last, np.nan)))[last > 0.0])


def _fitted(
    law: str, specimens: Sequence[Specimen], relative: bool
) -> Callable[[Sequence[FloatArray]], list[FloatArray]]:
    """Return the logarithm of the wear of every specimen by a law, fitted by least squares, as a
    function of their numbers of cycles."""
    from scipy.optimize import least_squares

    shape, starts = LAWS[law]
    residuals, cycles = Residuals.of(specimens, relative), [s.cycles for s in specimens]
    wear = [np.log(np.mean(s.wear_mm)) for s in specimens]

    def levels(x: FloatArray, cycles: Sequence[FloatArray]) -> list[FloatArray]:
        shared = x[-1] if starts else 0.0
        return [scale + shape(n, shared) for scale, n in zip(x, cycles, strict=False)]

    def residuals_at(x: FloatArray) -> FloatArray:
        return np.nan_to_num(residuals(np.concatenate(levels(x, cycles))), posinf=OVERFLOW_RESIDUAL)

    tried = []
    for start in starts or (0.0,):
        scales = [u - np.mean(shape(n, start)) for u, n in zip(wear, cycles, strict=True)]
        with np.errstate(all="ignore"):
            tried.append(least_squares(residuals_at, [*scales, *((start,) if starts else ())]))
    x = min(tried, key=lambda each: each.cost).x
    return lambda cycles: levels(x, cycles)
