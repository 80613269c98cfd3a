"""What follows from a fit: what the data leave open, forecasts and lives with their bands, and the
next reading that would help most.

Bands are those of the linearised model: they hold where the wear, not the parameters, is
determined.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from wear.fitting.estimate import FARTHEST, Fit
from wear.fitting.laws import first_half, forecast_rms
from wear.fitting.least_squares import settle
from wear.fitting.model import Parameter
from wear.fitting.readings import FloatArray

UNKNOWN = 1.0  # standard error of a logarithm, or share of a value, from which it is open
ALIKE = 0.1  # relative spread of powers that are shown as one
NEGLIGIBLE = 0.02  # power
CANDIDATES = 25  # numbers of cycles at which a further reading is tried
AHEAD = 10.0  # times the cycles of the last reading: what is predicted if nothing is asked for


class Open(NamedTuple):
    """A combination of parameters, as their powers, that the data leave open, and a sentence."""

    combination: dict[str, float]
    sentence: str


class Forecast(NamedTuple):
    """Wear (mm) of a specimen and number of cycles to it, with the 95 % band of whichever was not
    given."""

    specimen: str
    cycles: float
    bearing_wear_mm: float
    interval_95: tuple[float, float]


class NextReading(NamedTuple):
    """The further reading that narrows the forecast of all specimens most, and the factor by which
    it does."""

    specimen: str
    cycles: float
    band_of_forecast_times: float


def undetermined(found: Fit) -> Iterator[Open]:
    """Yield every combination of parameters that the data leave open.

    That is a direction of the parameters, each relative to its size, whose standard error is as
    large as a factor e; or a parameter whose interval has an open end beside them.
    """
    named: set[str] = set()
    for error, direction in zip(*found.directions, strict=True):
        if UNKNOWN < error < np.inf:
            powers = _by_key(found.parameters, direction / direction[np.argmax(np.abs(direction))])
            named |= {name.split(" ")[0] for name in powers}
            yield Open(powers, _sentence(powers, float(error)))
    for parameter, profile in zip(found.parameters, found.profiles, strict=False):
        low, high = np.isfinite(profile.interval)
        if not (low and high) and parameter.key not in named:
            sides = {(False, False): "either side", (True, False): "above", (False, True): "below"}
            words = f"The data do not bound {parameter} from {sides[bool(low), bool(high)]}."
            yield Open({str(parameter): 1.0}, words)


def _by_key(parameters: Sequence[Parameter], powers: FloatArray) -> dict[str, float]:
    """Return the power of every parameter that counts; specimens that are alike under their key."""
    found: dict[str, float] = {}
    for key in dict.fromkeys(parameter.key for parameter in parameters):
        own = [(p, x) for p, x in zip(parameters, powers.tolist(), strict=True) if p.key == key]
        values = [x for _, x in own]
        if max(values) - min(values) < ALIKE * max(map(abs, values)):
            found[key] = sum(values) / len(values)
        else:
            found |= {str(p): x for p, x in own}
    return {name: power for name, power in found.items() if abs(power) > NEGLIGIBLE}


def _sentence(powers: dict[str, float], error: float) -> str:
    """Return what it means that the data leave a combination open."""
    factor = f"a factor e^{error:.2g}" if error < FARTHEST else "beyond all bounds"
    if len(powers) == 1:
        return f"The data do not determine {next(iter(powers))}: its standard error is {factor}."
    *names, last = powers
    along = " * ".join(f"{name}^{power:.2g}" for name, power in powers.items())
    text = (
        f"The data do not determine {', '.join(names)} and {last} each by itself: the wear hardly "
        f"changes along {along}, whose standard error is {factor}"
    )
    if len(powers) == 2:
        (one, p), (other, q) = powers.items()
        text += f"; they enter only as {one}^{-q / p:.2g} * {other}^1" if abs(p) > abs(q) else (
            f"; they enter only as {one}^1 * {other}^{-p / q:.2g}"
        )  # fmt: skip
    return text + "."


def forecast(found: Fit, cycles: Sequence[float]) -> Iterator[Forecast]:
    """Yield the wear of every specimen after numbers of cycles, with its 95 % band."""
    specimens, wanted = found.model.specimens, np.array(cycles, dtype=float)
    level, slope = found.model.log_wear(found.theta[None], [wanted] * len(specimens))
    width = found.quantile * found.spread(slope[0])
    rows = zip(level[0].tolist(), width.tolist(), strict=True)
    for specimen in specimens:
        for number in wanted.tolist():
            wear, width = next(rows)
            yield Forecast(specimen.name, number, float(np.exp(wear)), _band(wear, width))


def _band(level: float, width: float) -> tuple[float, float]:
    """Return the ends of a band of this half width around `level`, all three of logarithms."""
    with np.errstate(over="ignore"):
        return float(np.exp(level - width)), float(np.exp(level + width))


def forecast_rms_from_first_half(found: Fit) -> float:
    """Return the root mean square error of ln(wear) where the first half of the readings of each
    specimen predicts the last; no number where they are fewer than the parameters."""
    model = found.model
    early = replace(model, specimens=tuple(first_half(model.specimens)))
    if len(early.residuals.observed) < len(found.theta):
        return float(np.nan)
    theta = settle(early, found.theta, (found.theta, FARTHEST * found.scale))
    level, _ = model.log_wear(theta[None], [s.cycles[-1:] for s in model.specimens])
    return forecast_rms(model.specimens, level[0])


def life(found: Fit, wear_mm: float) -> Iterator[Forecast]:
    """Yield the number of cycles to a wear depth of every specimen, with its 95 % band; infinite
    where the depth is not reached within 1e12 cycles.

    The logarithm of the number has the standard error of that of the wear, over the slope of the
    one against the other.
    """
    from wear.cycles import cycles_to_depth

    specimens, count = found.model.specimens, len(found.model.specimens)
    numbers = cycles_to_depth(found.model.scenes(found.theta), np.array([wear_mm])).cycles[:, 0]
    near = np.where(np.isfinite(numbers), numbers, 1.0)
    around = [np.array([n, n + max(1.0, np.rint(n / 50.0))]) for n in near]
    level, slope = found.model.log_wear(found.theta[None], around)
    level, slope = level.reshape(count, 2), slope.reshape(count, 2, -1)[:, 0]
    steepness = np.diff(level)[:, 0] / np.diff(np.log(around))[:, 0]
    with np.errstate(all="ignore"):
        width = found.quantile * found.spread(slope) / steepness
    for specimen, number, own in zip(specimens, numbers.tolist(), width.tolist(), strict=True):
        yield Forecast(specimen.name, number, wear_mm, _band(float(np.log(number)), own))


def next_reading(found: Fit, cycles: float | None = None) -> NextReading:
    """Return the one further reading, of any specimen within the cycles read so far, that narrows
    the forecast of all specimens after `cycles` most (default: ten times as many as were read)."""
    specimens = found.model.specimens
    last = max(float(specimen.cycles[-1]) for specimen in specimens)
    tried = np.unique(np.rint(np.geomspace(1.0, last, CANDIDATES)))
    slots = [np.append(tried, cycles or min(AHEAD * last, 1e12))] * len(specimens)
    level, slope = found.model.log_wear(found.theta[None], slots)
    residuals = found.model.residuals
    weight = replace(residuals, weight=np.median(residuals.weight, keepdims=True)).slope(level)
    shape = (len(specimens), len(tried) + 1, -1)
    target = slope.reshape(shape)[:, -1]
    read = (slope * np.reshape(weight, (-1, 1))).reshape(shape)[:, :-1].reshape(-1, slope.shape[-1])
    covariance = found.unscaled_covariance
    shared = target @ covariance @ read.T
    own = 1.0 + np.einsum("ij,jk,ik->i", read, covariance, read)
    before = float(np.einsum("ij,jk,ik->", target, covariance, target))
    gain = np.sum(shared**2, axis=0) / own
    best = int(np.argmax(gain))
    factor = float(np.sqrt(max(0.0, 1.0 - gain[best] / before)))
    return NextReading(specimens[best // len(tried)].name, float(tried[best % len(tried)]), factor)
