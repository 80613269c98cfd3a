"""Practical identifiability: combinations of parameters that the data do not determine, in words.

The wear hardly changes along them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from wear.fitting.estimate import PARAMETER_RANGE, Estimate
from wear.fitting.model import Parameter
from wear.fitting.profiles import Profile
from wear.numerics.gauss import FloatArray

UNKNOWN = math.log(2.0)  # standard error of the logarithm of an open combination: a factor of two
ALIKE = 0.1  # relative spread of powers that are shown as one
NEGLIGIBLE = 0.02  # power


class OpenCombination(NamedTuple):
    """A combination of parameters, as their powers, that the data leave open, and a sentence."""

    combination: dict[str, float]
    sentence: str


def undetermined(fit: Estimate, profiles: Sequence[Profile]) -> Iterator[OpenCombination]:
    """Yield every combination of parameters that the data leave open, see `Fit.undetermined`."""
    named: set[str] = set()
    for error, direction in zip(*fit.directions, strict=True):
        if UNKNOWN < error < np.inf:
            powers = _by_key(fit.parameters, direction / direction[np.argmax(np.abs(direction))])
            named |= {name.split(" ")[0] for name in powers}
            yield OpenCombination(powers, _sentence(powers, float(error)))
    for parameter, profile in zip(fit.parameters, profiles, strict=False):
        low, high = np.isfinite(profile.interval)
        if not (low and high) and parameter.key not in named:
            sides = {(False, False): "either side", (True, False): "above", (False, True): "below"}
            words = f"The data do not bound {parameter} from {sides[bool(low), bool(high)]}."
            yield OpenCombination({str(parameter): 1.0}, words)


def _by_key(parameters: Sequence[Parameter], powers: FloatArray) -> dict[str, float]:
    """Return the power of every parameter that matters, one for all specimens that are alike."""
    by_name: dict[str, float] = {}
    for key in dict.fromkeys(parameter.key for parameter in parameters):
        pairs = [(p, x) for p, x in zip(parameters, powers.tolist(), strict=True) if p.key == key]
        values = [x for _, x in pairs]
        if max(values) - min(values) < ALIKE * max(map(abs, values)):
            by_name[key] = sum(values) / len(values)
        else:
            by_name |= {str(p): x for p, x in pairs}
    return {name: power for name, power in by_name.items() if abs(power) > NEGLIGIBLE}


def _sentence(powers: dict[str, float], error: float) -> str:
    """Return the sentence on a combination that the data leave open."""
    factor = (
        f"a factor of {math.exp(error):.2g}" if error < PARAMETER_RANGE else "beyond all bounds"
    )
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
        first, second = (-q / p, 1.0) if abs(p) > 1.01 * abs(q) else (1.0, -p / q)
        text += f"; they enter only as {one}^{first:.2g} * {other}^{second:.2g}"
    return text + "."
