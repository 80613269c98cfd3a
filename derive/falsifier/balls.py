"""Numbers: rational ones stay exact, so that 0/0 is detected; all others are balls.

Overview
    A ball of `python-flint` contains the value.  An operation outside its domain raises
    UndefinedError, one that a ball is too wide to decide UndecidedError.
Key results
    FUNCTIONS, CONSTANTS    the heads of SymPy as functions of numbers
    integral, first_zero    of functions of a number
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, reduce
from itertools import pairwise
from math import isqrt
from operator import mul
from typing import Any

import sympy as sp
from flint import arb, fmpq

Number = Any  # fmpq or arb, which mix
BITS = 320
"""Working precision: 96 digits."""
ZERO = fmpq(0)
NOTHING = arb(10) ** -200
"""A ball around 0 narrower than this, which only a higher precision gives, is 0."""


_HALVINGS, _AGREEING = 24, arb(10) ** -12
"""Greatest number of bisections of an interval of integration; relative tolerance of two rules."""
_HALVINGS_OF_ZERO = 110


class UndefinedError(ArithmeticError):
    """The expression has no value there: a division by zero, the logarithm of a negative."""


class UndecidedError(ArithmeticError):
    """The balls are too wide, or the model lacks the data to decide."""


class NoValueError(UndecidedError):
    """The model itself has no value for a quantity."""


def ball(x: Number) -> arb:
    """Return a number as a ball; UndecidedError unless it is finite."""
    result = arb(x)
    if not result.is_finite():
        raise UndecidedError("not finite")
    return result


def fraction(expr: sp.Expr) -> fmpq:
    """Return a SymPy number as an exact fraction."""
    exact = sp.Rational(expr)
    return fmpq(int(exact.p), int(exact.q))


def _divided(a: Number, b: Number) -> Number:
    if b == 0:
        raise UndefinedError("division by zero")
    if isinstance(b, arb) and b.contains(0):
        raise UndecidedError("a possible division by zero")
    return a / b


def _require_positive(x: Number, operation: str) -> None:
    if not arb(x) > 0:
        raise UndefinedError(operation) if arb(x) <= 0 else UndecidedError(operation)


def _power(base: Number, exponent: Number) -> Number:
    if isinstance(exponent, fmpq) and exponent.q == 1:
        n = int(exponent.p)
        if n < 0:
            return _divided(fmpq(1), _power(base, -exponent))
        if isinstance(base, arb) and base.contains(0):  # ``**`` would take its logarithm
            return reduce(mul, [base] * n, fmpq(1))
        return base**n
    if base == 0:
        if arb(exponent) > 0:
            return ZERO
        raise UndefinedError("a power of zero")
    if exponent == fmpq(1, 2):
        return _root(base)
    _require_positive(base, "a power of a negative")
    return (exponent * _log(base)).exp()


def _root(x: Number) -> Number:
    if isinstance(x, fmpq):
        p, q = isqrt(abs(int(x.p))), isqrt(int(x.q))
        if fmpq(p * p, q * q) == x:
            return fmpq(p, q)
    if arb(x) < 0:
        raise UndefinedError("the root of a negative")
    return arb(x).sqrt()


def _log(x: Number) -> Number:
    _require_positive(x, "the logarithm of a number that is not positive")
    return arb(x).log()


def sign(x: Number) -> fmpq:
    if x == 0:
        return ZERO
    if not (x > 0 or x < 0):
        raise UndecidedError("a sign")
    return fmpq(1 if x > 0 else -1)


def _floor(x: Number) -> fmpq:
    whole = arb(x).floor().unique_fmpz()
    if whole is None:
        raise UndecidedError("a floor")
    return fmpq(whole)


def _lambert(x: Number, branch: Number = ZERO) -> Number:
    if arb(x) + arb(-1).exp() < 0 or (branch != 0 and not arb(x) < 0):
        raise UndefinedError("a Lambert function outside its domain")
    return arb(x).lambertw(0 if branch == 0 else -1)


def _smaller(a: Number, b: Number) -> Number:
    return a if sign(b - a) >= 0 else b


def _exact_at(point: int, value: int, function: Callable[[arb], arb]) -> Callable[..., Number]:
    """Return a function with an exact value at the only point at which this is rational."""
    return lambda x: fmpq(value) if x == point else function(arb(x))


FUNCTIONS: dict[type, Callable[..., Number]] = {
    sp.exp: _exact_at(0, 1, arb.exp),
    sp.log: _exact_at(1, 0, _log),
    sp.tanh: _exact_at(0, 0, arb.tanh),
    sp.sin: _exact_at(0, 0, arb.sin),
    sp.cos: _exact_at(0, 1, arb.cos),
    sp.tan: lambda x: _divided(arb(x).sin(), arb(x).cos()),
    sp.atan: _exact_at(0, 0, arb.atan),
    sp.asin: _exact_at(0, 0, arb.asin),
    sp.Abs: abs,
    sp.sign: sign,
    sp.floor: _floor,
    sp.LambertW: _lambert,
    sp.Ei: lambda x: arb(x).ei(),
    sp.besseli: lambda order, x: arb(x).bessel_i(arb(order)),
    sp.Min: lambda *xs: reduce(_smaller, xs),
    sp.Max: lambda *xs: -reduce(_smaller, [-x for x in xs]),
    sp.Pow: _power,
    sp.Mul: lambda *xs: reduce(lambda a, b: a * b, xs),
}

CONSTANTS: dict[sp.Basic, Callable[[], arb]] = {
    sp.pi: arb.pi,
    sp.E: arb.const_e,
}


def integral(function: Callable[[Number], arb], low: Number, high: Number) -> arb:
    """Integrate by Gauss-Legendre quadrature of two orders, with bisection until they agree.

    The error is their difference.
    """

    def total(a: Number, b: Number, halvings: int) -> arb:
        half = (b - a) / 2
        coarse, fine = (
            half * sum(weight * function(a + half * (1 + x)) for x, weight in _nodes(order))
            for order in (20, 32)
        )
        error = abs(fine - coarse).mid()
        if halvings and error > fine.rad() and error > _AGREEING * abs(fine).mid():
            return total(a, a + half, halvings - 1) + total(a + half, b, halvings - 1)
        return fine + arb(0, error)

    return total(low, high, _HALVINGS)


@cache
def _nodes(order: int) -> tuple[tuple[arb, arb], ...]:
    return tuple(arb.legendre_p_root(order, k, weight=True) for k in range(order))


def first_zero(function: Callable[[Number], arb]) -> arb:
    """Return the least positive zero, by bisection of the first interval that may have one.

    Intervals are excluded by the sign of the function on a ball; UndecidedError if none is left.
    """

    def sign_at(x: Number) -> fmpq:
        try:
            return sign(function(x))
        except UndecidedError:
            return ZERO

    def first(low: fmpq, high: fmpq, halvings: int) -> arb | None:
        middle, width = (low + high) / 2, high - low
        if sign_at(arb(middle, arb(width / 2).upper())) != 0:
            return None
        if halvings == 0:  # the zero is in this interval, or very near
            if sign_at(low - 8 * width) * sign_at(high + 8 * width) < 0:
                return arb(middle, arb(9 * width).upper())
            raise UndecidedError("a possible zero")
        earlier = first(low, middle, halvings - 1)
        return first(middle, high, halvings - 1) if earlier is None else earlier

    ends = (ZERO, *(fmpq(137, 100) * fmpq(2) ** k for k in range(-20, 40)))
    for low, high in pairwise(ends):
        zero = first(low, high, _HALVINGS_OF_ZERO)
        if zero is not None:
            return zero
    raise UndecidedError("no zero is found")
