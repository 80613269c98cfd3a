"""What the data leave open, in words: combinations of parameters along which the wear hardly
changes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from wear.fitting.estimate import FARTHEST, Estimate
from wear.fitting.model import Parameter
from wear.fitting.profiles import Profile
from wear.numerics.gauss import FloatArray

UNKNOWN = 1.0  # standard error of a logarithm, or share of a value, from which it is open
ALIKE = 0.1  # relative spread of powers that are shown as one
NEGLIGIBLE = 0.02  # power


class Open(NamedTuple):
    """A combination of parameters, as their powers, that the data leave open, and a sentence."""

    combination: dict[str, float]
    sentence: str


def undetermined(found: Estimate, profiles: Sequence[Profile]) -> Iterator[Open]:
    """Yield every combination of parameters that the data leave open, see `Fit.undetermined`."""
    named: set[str] = set()
    for error, direction in zip(*found.directions, strict=True):
        if UNKNOWN < error < np.inf:
            powers = _by_key(found.parameters, direction / direction[np.argmax(np.abs(direction))])
            named |= {name.split(" ")[0] for name in powers}
            yield Open(powers, _sentence(powers, float(error)))
    for parameter, profile in zip(found.parameters, profiles, strict=False):
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
        first, second = (-q / p, 1.0) if abs(p) > 1.01 * abs(q) else (1.0, -p / q)
        text += f"; they enter only as {one}^{first:.2g} * {other}^{second:.2g}"
    return text + "."
