"""Numbers: the value of an expression at a time in a model, in ball arithmetic.

Overview
    An expression is compiled, once, to a function of a moment (a model and a time).  Rational
    numbers stay exact, so that 0/0 is seen; all else is a ball of `python-flint` that contains
    the value.  Derivatives in time are those of the fields' own formulas.
Key results
    compiled(expr, variable)   the function of a moment
    Undefined, Undecided       no value exists; the balls are too wide to say
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, reduce
from math import isqrt
from typing import Any

import sympy as sp
from flint import arb, fmpq
from sympy.core.function import AppliedUndef

from ..symbols import t

Number = Any  # fmpq or arb, which mix
BITS = 320
"""Working precision: 96 digits."""
ZERO = fmpq(0)
NOTHING = arb(10) ** -200
"""A ball around 0 narrower than this, which only a higher precision gives, is 0."""


class Undefined(ArithmeticError):  # noqa: N818 - a fact about an expression, not a fault
    """The expression has no value there: a division by zero, the logarithm of a negative."""


class Undecided(ArithmeticError):  # noqa: N818
    """The balls are too wide, or the model cannot say."""


class NoValue(Undecided):
    """The model itself gives a quantity no value."""


class NearZero(Undecided):
    """A divisor is a ball around 0, very narrow: 0 itself, as far as can be said."""


@dataclass(frozen=True)
class Moment:
    """A time in a model."""

    model: Any  # of .models: a Model, or a Present one
    time: Number = ZERO


Value = Callable[[Moment], Number]


def ball(x: Number) -> arb:
    """Return a number as a finite ball."""
    found = arb(x)
    if not found.is_finite():
        raise Undecided("not finite")
    return found


def fraction(expr: sp.Expr) -> fmpq:
    """Return a SymPy number exactly."""
    exact = sp.Rational(expr)
    return fmpq(int(exact.p), int(exact.q))


def _divided(a: Number, b: Number) -> Number:
    if b == 0:
        raise Undefined("division by zero")
    if isinstance(b, arb) and b.contains(0):
        narrow = b.rad() < NOTHING
        raise NearZero("division by zero") if narrow else Undecided("perhaps a division by zero")
    return a / b


def _positive(x: Number, what: str) -> None:
    if not arb(x) > 0:
        raise Undefined(what) if arb(x) <= 0 else Undecided(what)


def _power(base: Number, exponent: Number) -> Number:
    if isinstance(exponent, fmpq) and exponent.q == 1:
        n = int(exponent.p)
        return base**n if n >= 0 else _divided(fmpq(1), base**-n)
    if base == 0:
        if arb(exponent) > 0:
            return ZERO
        raise Undefined("a power of zero")
    if exponent == fmpq(1, 2):
        return _root(base)
    _positive(base, "a power of a negative")
    return (exponent * _log(base)).exp()


def _root(x: Number) -> Number:
    if isinstance(x, fmpq):
        p, q = isqrt(abs(int(x.p))), isqrt(int(x.q))
        if fmpq(p * p, q * q) == x:
            return fmpq(p, q)
    if arb(x) < 0:
        raise Undefined("the root of a negative")
    return arb(x).sqrt()


def _log(x: Number) -> Number:
    _positive(x, "the logarithm of what is not positive")
    return arb(x).log()


def _sign(x: Number) -> fmpq:
    if x == 0:
        return ZERO
    if not (x > 0 or x < 0):
        raise Undecided("a sign")
    return fmpq(1 if x > 0 else -1)


def _floor(x: Number) -> fmpq:
    whole = arb(x).floor().unique_fmpz()
    if whole is None:
        raise Undecided("a floor")
    return fmpq(whole)


def _lambert(x: Number, branch: Number = ZERO) -> Number:
    if arb(x) + arb(-1).exp() < 0 or (branch != 0 and not arb(x) < 0):
        raise Undefined("a Lambert function outside its domain")
    return arb(x).lambertw(0 if branch == 0 else -1)


def _smaller(a: Number, b: Number) -> Number:
    return a if _sign(b - a) >= 0 else b


def _exact_at(point: int, value: int, function: Callable[[arb], arb]) -> Callable[..., Number]:
    """Return a function that is exact at the one point where its value is rational."""
    return lambda x: fmpq(value) if x == point else function(arb(x))


_FUNCTIONS: dict[type, Callable[..., Number]] = {
    sp.exp: _exact_at(0, 1, arb.exp),
    sp.log: _exact_at(1, 0, _log),
    sp.tanh: _exact_at(0, 0, arb.tanh),
    sp.sin: _exact_at(0, 0, arb.sin),
    sp.cos: _exact_at(0, 1, arb.cos),
    sp.tan: lambda x: _divided(arb(x).sin(), arb(x).cos()),
    sp.atan: _exact_at(0, 0, arb.atan),
    sp.asin: _exact_at(0, 0, arb.asin),
    sp.Abs: abs,
    sp.sign: _sign,
    sp.floor: _floor,
    sp.LambertW: _lambert,
    sp.Ei: lambda x: arb(x).ei(),
    sp.besseli: lambda order, x: arb(x).bessel_i(arb(order)),
    sp.Min: lambda *xs: reduce(_smaller, xs),
    sp.Max: lambda *xs: -reduce(_smaller, [-x for x in xs]),
    sp.Pow: _power,
    sp.Add: lambda *xs: reduce(lambda a, b: a + b, xs),
    sp.Mul: lambda *xs: reduce(lambda a, b: a * b, xs),
}

_CONSTANTS: dict[sp.Basic, Callable[[], arb]] = {
    sp.pi: arb.pi,
    sp.E: arb.const_e,
}


@cache
def compiled(expr: sp.Basic, variable: sp.Symbol = t) -> Value:
    """Return the function that gives an expression its value at a moment; ``variable`` is what
    runs there (time)."""
    if expr == variable:
        return lambda moment: moment.time
    if expr in _CONSTANTS:
        known = _CONSTANTS[expr]
        return lambda _: known()
    if expr.is_Number and expr.is_finite:
        number = fraction(expr)
        return lambda _: number
    if isinstance(expr, sp.Symbol):
        return lambda moment: moment.model.constant(expr)
    for kind, build in _SPECIAL:
        if isinstance(expr, kind):
            return build(expr, variable)
    if type(expr) not in _FUNCTIONS:
        raise Undecided(f"{type(expr).__name__} has no number")
    function = _FUNCTIONS[type(expr)]
    arguments = [compiled(a, variable) for a in expr.args]
    return lambda moment: function(*[argument(moment) for argument in arguments])


def field_of(expr: AppliedUndef) -> sp.Expr:
    """Return a field at time t, always the same object: it is looked up often."""
    return _at_time_t(expr.func)


@cache
def _at_time_t(function: sp.FunctionClass) -> sp.Expr:
    return function(t)


def _field(expr: AppliedUndef, variable: sp.Symbol, order: int = 0) -> Value:
    field, at = field_of(expr), compiled(expr.args[0], variable)
    return lambda moment: moment.model.field(field, at(moment), order)


def _derivative(expr: sp.Derivative, variable: sp.Symbol) -> Value:
    inside, data = expr.expr, tuple(expr.variables)
    if set(data) != {variable} and isinstance(inside, sp.Symbol):
        return lambda moment: moment.model.slope(inside, data)
    if isinstance(inside, AppliedUndef) and inside.args == data[:1]:
        return _field(inside, variable, len(data))
    done = expr.doit()
    if done == expr:
        raise Undecided(f"{expr} is no derivative in time")
    return compiled(done, variable)


def _at(expr: sp.Subs, variable: sp.Symbol) -> Value:
    """An expression at another value of its variable: a field at time zero, one period later."""
    (name,), (point,) = expr.variables, expr.point
    inside, at = compiled(expr.expr, name), compiled(point, variable)
    return lambda moment: inside(Moment(moment.model, at(moment)))


def _limit(expr: sp.Limit, _: sp.Symbol) -> Value:
    return lambda moment: moment.model.limit(expr)


def _integral(expr: sp.Integral, variable: sp.Symbol) -> Value:
    """Gauss and Legendre, on two halves; the error is the distance of two orders."""
    ((name, low, high),) = expr.limits
    inside = compiled(expr.function, name)
    ends = compiled(low, variable), compiled(high, variable)

    def value(moment: Moment) -> Number:
        a, b = (end(moment) for end in ends)

        def total(order: int) -> arb:
            half = (b - a) / 4
            return half * sum(
                weight * ball(inside(Moment(moment.model, a + half * (shift + x))))
                for shift in (1, 3)
                for x, weight in _nodes(order)
            )

        coarse, fine = total(20), total(32)
        return arb(fine.mid(), abs(fine - coarse).upper() + fine.rad())

    return value


@cache
def _nodes(order: int) -> tuple[tuple[arb, arb], ...]:
    return tuple(arb.legendre_p_root(order, k, weight=True) for k in range(order))


def _cases(expr: sp.Piecewise, variable: sp.Symbol) -> Value:
    from .truth import judged

    values = [(compiled(value, variable), condition) for value, condition in expr.args]

    def value(moment: Moment) -> Number:
        for branch, condition in values:
            if judged(condition, moment, variable):
                return branch(moment)
        raise Undefined("no case of a piecewise expression")

    return value


_SPECIAL: tuple[tuple[type, Callable[..., Value]], ...] = (
    (AppliedUndef, _field),
    (sp.Derivative, _derivative),
    (sp.Subs, _at),
    (sp.Limit, _limit),
    (sp.Integral, _integral),
    (sp.Piecewise, _cases),
)
