"""Numbers of a scene that vary in a study: levels of a grid, or a distribution to sample.

Key results
    Levels          the values of one key, for a grid
    Distribution    the distribution of one key, for samples
    parse           either of them from `KEY=...` as a command line has it
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from wear.faults import UsageError
from wear.numerics.gauss import FloatArray
from wear.request import is_number

MOST_LEVELS = 10**7  # of one key
EXAMPLES = 20  # levels of which one must be possible
_CALL = re.compile(r"(\w+)\(([^()]*)\)")


@dataclass(frozen=True)
class Levels:
    """The values that a key takes in a grid, in the order given."""

    key: str
    values: tuple[float, ...]

    def __post_init__(self) -> None:
        if not self.values or not all(is_number(x) and math.isfinite(x) for x in self.values):
            raise UsageError(f"{self.key}: every value must be a finite number")
        if len(set(self.values)) < len(self.values):
            raise UsageError(f"{self.key}: a value is given twice")

    @property
    def examples(self) -> tuple[float, ...]:
        """Return values that the key takes."""
        return self.values[:EXAMPLES]

    def quantile(self, probability: FloatArray) -> FloatArray:
        """Return the values that the key does not exceed with these probabilities (< 1), if its
        levels, in the order given, are equally likely."""
        places = (probability * len(self.values)).astype(int)
        return np.asarray(np.array(self.values)[places], dtype=float)


@dataclass(frozen=True)
class Distribution:
    """The distribution of a key.

    `law` is one of `uniform(low, high)`, `loguniform(low, high)`, `normal(mean, standard
    deviation)` and `lognormal(median, factor)`; two thirds of a lognormal quantity lie between
    median/factor and median*factor.
    """

    key: str
    law: str
    parameters: tuple[float, ...]

    def __post_init__(self) -> None:
        numbers = self.parameters
        if not all(is_number(x) and math.isfinite(x) for x in numbers):
            raise UsageError(f"{self.key}: every value must be a finite number")
        if self.law not in DISTRIBUTIONS:
            known = ", ".join(DISTRIBUTIONS)
            raise UsageError(f"{self.key}: {self.law} is unknown; choose one of {known}")
        law = DISTRIBUTIONS[self.law]
        if len(numbers) != 2 or not law.meets(*numbers):
            raise UsageError(f"{self.key}: {law.rule}")

    @property
    def examples(self) -> tuple[float, ...]:
        """Return the median."""
        return (float(self.quantile(np.array(0.5))),)

    @property
    def frozen(self) -> Any:
        """Return the distribution of `scipy.stats`."""
        from scipy import stats

        return DISTRIBUTIONS[self.law].frozen(stats, *self.parameters)

    def quantile(self, probability: FloatArray) -> FloatArray:
        """Return the values that the key does not exceed with these probabilities."""
        return np.asarray(self.frozen.ppf(probability), dtype=float)


Vary = Levels | Distribution


class Law(NamedTuple):
    """A kind of distribution: the condition on its two parameters, its message, and the function
    that makes the distribution of `scipy.stats` from that module and the parameters."""

    meets: Callable[[float, float], bool]
    rule: str
    frozen: Callable[..., Any]


DISTRIBUTIONS = {
    "uniform": Law(
        lambda low, high: low < high,
        "uniform(low,high) needs low < high",
        lambda stats, low, high: stats.uniform(low, high - low),
    ),
    "loguniform": Law(
        lambda low, high: 0 < low < high,
        "loguniform(low,high) needs 0 < low < high",
        lambda stats, low, high: stats.loguniform(low, high),
    ),
    "normal": Law(
        lambda _, deviation: deviation > 0,
        "normal(mean,sd) needs sd > 0",
        lambda stats, mean, deviation: stats.norm(mean, deviation),
    ),
    "lognormal": Law(
        lambda median, factor: median > 0 and factor > 1,
        "lognormal(median,factor) needs median > 0 and factor > 1",
        lambda stats, median, factor: stats.lognorm(math.log(factor), scale=median),
    ),
}


def parse(text: str) -> Vary:
    """Return the variation of a key from `KEY=low:high:count[:log]`, `KEY=a,b,c` or `KEY=law(x,y)`.

    Raises
    ------
    UsageError
        with the fault and the accepted forms.

    >>> parse("bearing.roughness_growth=0.1:0.3:3")
    Levels(key='bearing.roughness_growth', values=(0.1, 0.2, 0.3))
    >>> parse("bearing.wear_coefficient=loguniform(1e-8,1e-5)").parameters
    (1e-08, 1e-05)
    """
    if not isinstance(text, str):
        raise UsageError(f"vary: {text!r} is not a text such as bearing.hardness_MPa=100:300:21")
    key, equals, value = (part.strip() for part in text.partition("="))
    if not equals or not key:
        raise UsageError(f"{text!r}: write KEY=VALUES, as in bearing.hardness_MPa=100:300:21")
    if call := _CALL.fullmatch(value):
        return Distribution(key, call[1], tuple(map(_number, call[2].split(","))))
    if ":" in value:
        return _range(key, text, value.split(":"))
    return Levels(key, tuple(map(_number, value.split(","))))


def _range(key: str, text: str, parts: list[str]) -> Levels:
    spacing = parts[3].strip() if len(parts) == 4 else "linear"
    if not 3 <= len(parts) <= 4 or spacing not in ("linear", "log"):
        raise UsageError(f"{text}: write low:high:count or low:high:count:log")
    low, high, count = map(_number, parts[:3])
    if not all(map(math.isfinite, (low, high, count))):
        raise UsageError(f"{text}: every value must be a finite number")
    if not (count.is_integer() and 2 <= count <= MOST_LEVELS):
        raise UsageError(f"{text}: the count must be a whole number from 2 to {MOST_LEVELS:.0e}")
    if not low < high or (spacing == "log" and not low > 0.0):
        raise UsageError(f"{text}: {'0 < ' if spacing == 'log' else ''}low < high is needed")
    spaced = np.geomspace if spacing == "log" else np.linspace
    # As short as the ends are given, so that 0.2 is 0.2 and not 0.20000000000000004.
    return Levels(key, tuple(float(f"{value:.15g}") for value in spaced(low, high, int(count))))


def _number(word: str) -> float:
    try:
        return float(word)
    except ValueError:
        return math.nan
