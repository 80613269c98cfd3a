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
from functools import reduce
from itertools import pairwise
from operator import mul
from typing import Any

import sympy as sp
from flint import arb, fmpq
from flint.utils.flint_exceptions import DomainError

from ..memory import cache

Number = Any  # fmpq or arb, which mix
BITS = 320
"""Working precision: 96 digits."""
ZERO = fmpq(0)
NOTHING = arb(10) ** -200
"""A ball around 0 narrower than this, which only a higher precision gives, is 0."""

_ORDERS, _HALVINGS, _AGREEING = (20, 32), 40, arb(10) ** -12
"""Orders of two rules of integration; greatest number of bisections; relative tolerance."""
_FALLING = arb("0.97")
"""Ratio of the integrals next to a singularity, after and before a bisection, up to which it is
taken to be integrable."""
_HALVINGS_OF_ZERO = 60


class UndefinedError(ArithmeticError):
    """The expression has no value there; the message says why: "no value: a division by zero"."""


class UndecidedError(ArithmeticError):
    """The balls are too wide, or the model lacks the data to decide."""


class NoValueError(ArithmeticError):
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


def real(function: Callable[..., arb], *parameters: Number) -> Callable[[Number], Number]:
    """Return a function of a number from one of balls; integers stay exact.

    It has no value at a ball if it has none at both ends, since its domain is an interval.
    """

    def value(x: Number) -> Number:
        at = arb(x)
        result = function(at, *parameters)
        if result.is_nan():
            if all(function(end, *parameters).is_nan() for end in (at.lower(), at.upper())):
                raise UndefinedError(f"no value: {function.__name__} outside its domain")
            raise UndecidedError(f"{function.__name__} at the end of its domain")
        whole = result.unique_fmpz() if result.is_exact() else None
        return result if whole is None else fmpq(whole)

    return value


_exponential, _logarithm, _root = map(real, (arb.exp, arb.log, arb.sqrt))


def _divided(a: Number, b: Number) -> Number:
    if b == 0:
        raise UndefinedError("no value: a division by zero")
    if isinstance(b, arb) and b.contains(0):
        raise UndecidedError("a possible division by zero")
    return a / b


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
        raise UndefinedError("no value: a power of zero")
    if exponent == fmpq(1, 2):
        try:
            return base.sqrt() if isinstance(base, fmpq) else _root(base)
        except DomainError:  # not the square of a fraction
            return _root(base)
    return _exponential(exponent * _logarithm(base))


def sign(x: Number) -> fmpq:
    """Return -1, 0 or 1."""
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
    if branch != 0 and not arb(x) < 0:
        raise UndefinedError("no value: the lower branch of W at a number not below 0")
    return real(arb.lambertw, int(branch.p))(x)


FUNCTIONS: dict[type, Callable[..., Number]] = {
    sp.exp: _exponential,
    sp.log: _logarithm,
    sp.tanh: real(arb.tanh),
    sp.sin: real(arb.sin),
    sp.cos: real(arb.cos),
    sp.tan: lambda x: _divided(arb(x).sin(), arb(x).cos()),
    sp.atan: real(arb.atan),
    sp.asin: real(arb.asin),
    sp.Abs: abs,
    sp.sign: sign,
    sp.floor: _floor,
    sp.LambertW: _lambert,
    sp.Ei: real(arb.ei),
    sp.besseli: lambda order, x: arb(x).bessel_i(arb(order)),
    sp.Pow: _power,
    sp.Mul: lambda *xs: reduce(mul, xs),
}

CONSTANTS: dict[sp.Basic, Callable[[], arb]] = {
    sp.pi: arb.pi,
    sp.E: arb.const_e,
}


def integral(function: Callable[[Number], arb], low: Number, high: Number) -> arb:
    """Integrate by Gauss-Legendre quadrature of two orders, with bisection until they agree.

    The error is their difference.  Where they never agree, at a singularity ``|x|**-a``, the
    integral over the interval next to it falls with each bisection by ``q = 2**(a - 1)``, and the
    error of order n falls like ``n**(2 a - 2)``; UndecidedError if q is not clearly below 1.
    """

    def total(a: Number, b: Number, sizes: tuple[arb, ...] = ()) -> arb:
        half = (b - a) / 2
        coarse, fine = (
            [half * weight * function(a + half * (1 + x)) for x, weight in _nodes(order)]
            for order in _ORDERS
        )
        value = sum(fine, arb(0))
        error = abs(value - sum(coarse, arb(0))).mid()
        if error <= value.rad() or error <= _AGREEING * abs(value).mid():
            return value + arb(0, error)
        sizes = (*sizes, sum(map(abs, fine), arb(0)).mid())
        if len(sizes) <= _HALVINGS:
            return total(a, a + half, sizes) + total(a + half, b, sizes)
        fall = (sizes[-1] / sizes[-9]) ** (arb(1) / 8)
        if not fall < _FALLING:
            raise UndecidedError("the integral may diverge")
        orders = (arb(_ORDERS[1]) / _ORDERS[0]) ** (-2 * fall.log() / arb(2).log())
        return value + arb(0, (error * max(arb(1), 2 / (orders - 1))).upper())

    return total(low, high)


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

    ends = (ZERO, *(fmpq(137, 100) * fmpq(2) ** k for k in range(-20, 40)))
    waiting = [(low, high, _HALVINGS_OF_ZERO) for low, high in pairwise(ends)][::-1]
    while waiting:
        low, high, halvings = waiting.pop()
        middle, width = (low + high) / 2, high - low
        if sign_at(arb(middle, arb(width / 2).upper())) != 0:
            continue
        if halvings:
            waiting += [(middle, high, halvings - 1), (low, middle, halvings - 1)]
        elif sign_at(low - 8 * width) * sign_at(high + 8 * width) < 0:
            return arb(middle, arb(9 * width).upper())  # the zero is here, or very near
        else:
            raise UndecidedError("a possible zero")
    raise UndecidedError("no zero is found")
