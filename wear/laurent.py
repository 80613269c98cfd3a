"""Laurent series: numbers in which generated code is evaluated at infinite wear.

Overview
    How the wear rate approaches its limit is a series in 1/u.  Instead of a formula for each
    coefficient, the generated right-hand side itself is evaluated with u = 1/e, where e is the
    variable of a truncated Laurent series: sums, products, quotients, roots and exponentials of
    such series are such series.
Key results
    Laurent     e^v (c_0 + c_1 e + c_2 e^2 + ...), each c an array
    NotSteady   an exponential of a series that is infinite at e = 0
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


class NotSteady(ArithmeticError):  # noqa: N818  # a finding, not a fault
    """The quantity has no power series at infinite wear."""


@dataclass(frozen=True)
class Laurent:
    """``e**valuation * sum(coefficients[n] * e**n)``, cut after the coefficients given.

    ``coefficients`` has shape (terms, ...): what follows the first axis broadcasts.

    >>> e = Laurent.variable(3)
    >>> (1 / (1 + e)).coefficients
    array([ 1., -1.,  1.])
    """

    coefficients: FloatArray
    valuation: int = 0

    @staticmethod
    def variable(terms: int) -> Laurent:
        """Return e itself."""
        return Laurent(_unit(terms), 1)

    @property
    def terms(self) -> int:
        """The number of coefficients."""
        return len(self.coefficients)

    @property
    def limit(self) -> FloatArray:
        """The value at e = 0, infinite where the series is."""
        first = self.coefficients[0]
        if self.valuation == 0:
            return np.asarray(first)
        infinite = np.sign(first) * np.inf if self.valuation < 0 else 0.0 * first
        return np.asarray(infinite)

    def like(self, other: Any) -> Laurent:
        """Return a number or an array as a series of as many terms."""
        if isinstance(other, Laurent):
            return other
        value = np.asarray(other, dtype=np.float64)
        return Laurent(np.multiply.outer(_unit(self.terms), value))

    def from_power(self, valuation: int) -> FloatArray:
        """Return as many coefficients, from that of e**valuation on; none may stand before it."""
        shift = self.valuation - valuation
        padding = np.zeros((min(shift, self.terms), *self.coefficients.shape[1:]))
        return np.concatenate([padding, self.coefficients])[: self.terms]

    def __add__(self, other: Any) -> Laurent:
        other = self.like(other)
        valuation = min(self.valuation, other.valuation)
        return Laurent(
            *_aligned_sum(self.from_power(valuation), other.from_power(valuation), valuation)
        )

    def __neg__(self) -> Laurent:
        return Laurent(-self.coefficients, self.valuation)

    def __sub__(self, other: Any) -> Laurent:
        return self + (-self.like(other))

    def __mul__(self, other: Any) -> Laurent:
        other = self.like(other)
        product = _product(self.coefficients, other.coefficients)
        return Laurent(product, self.valuation + other.valuation)

    def __truediv__(self, other: Any) -> Laurent:
        other = self.like(other)
        quotient = _product(self.coefficients, _reciprocal(other.coefficients))
        return Laurent(quotient, self.valuation - other.valuation)

    __radd__, __rmul__ = __add__, __mul__

    def __rsub__(self, other: Any) -> Laurent:
        return self.like(other) - self

    def __rtruediv__(self, other: Any) -> Laurent:
        return self.like(other) / self

    def exp(self) -> Laurent:
        """Return the exponential; NotSteady where the series is infinite at e = 0."""
        if self.valuation < 0:
            raise NotSteady("an exponential of something without bound has no power series")
        exponent = self.from_power(0)
        found = [np.exp(exponent[0])]
        for n in range(1, self.terms):
            found.append(sum(k * exponent[k] * found[n - k] for k in range(1, n + 1)) / n)
        return Laurent(np.array(found))

    def sqrt(self) -> Laurent:
        """Return the square root of a series that begins with an even power of e."""
        if self.valuation % 2:
            raise NotSteady("the root of an odd power has no Laurent series")
        found = [np.sqrt(self.coefficients[0])]
        for n in range(1, self.terms):
            crossed = sum(found[k] * found[n - k] for k in range(1, n))
            found.append((self.coefficients[n] - crossed) / (2.0 * found[0]))
        return Laurent(np.array(found), self.valuation // 2)

    def minimum(self, other: Any) -> Laurent:
        """Return the smaller of two, near e = 0."""
        other = self.like(other)
        return self if np.all(self.limit < other.limit) else other

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any, **_: Any) -> Any:
        """Let NumPy's functions, and NumPy numbers to the left, act on series."""
        if method != "__call__" or ufunc not in _ACTIONS:
            return NotImplemented
        first, *rest = inputs
        return _ACTIONS[ufunc](self.like(first), *rest)


_ACTIONS: dict[np.ufunc, Any] = {
    np.add: Laurent.__add__,
    np.subtract: Laurent.__sub__,
    np.multiply: Laurent.__mul__,
    np.divide: Laurent.__truediv__,
    np.negative: Laurent.__neg__,
    np.exp: Laurent.exp,
    np.sqrt: Laurent.sqrt,
    np.minimum: Laurent.minimum,
}


def _unit(terms: int) -> FloatArray:
    unit = np.zeros(terms)
    unit[0] = 1.0
    return unit


def _aligned_sum(left: FloatArray, right: FloatArray, valuation: int) -> tuple[FloatArray, int]:
    """Add coefficients; leading zeros, which a quotient could not divide by, are dropped."""
    dimensions = max(left.ndim, right.ndim)
    left, right = (a.reshape(a.shape + (1,) * (dimensions - a.ndim)) for a in (left, right))
    total = left + right
    zeros = 0
    while zeros < len(total) - 1 and not np.any(total[zeros]):
        zeros += 1
    padding = np.zeros((zeros, *total.shape[1:]))
    return np.concatenate([total[zeros:], padding]), valuation + zeros


def _product(left: FloatArray, right: FloatArray) -> FloatArray:
    terms = min(len(left), len(right))
    return np.array([sum(left[k] * right[n - k] for k in range(n + 1)) for n in range(terms)])


def _reciprocal(series: FloatArray) -> FloatArray:
    found = [1.0 / series[0]]
    for n in range(1, len(series)):
        found.append(-sum(series[k] * found[n - k] for k in range(1, n + 1)) / series[0])
    return np.array(found)
