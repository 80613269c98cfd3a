"""Numbers: what an expression is worth at a moment of a model, in ball arithmetic.

Overview
    An expression is compiled, once, to a function of a moment (a model, a time, a number of
    Taylor coefficients).  Rational numbers stay exact, so that 0/0 is seen; all else is a ball
    of `python-flint` that contains the value, or a power series of balls in the time from the
    moment on, whose coefficients give derivatives in time.
Key results
    compiled(expr, variable)   the function of a moment
    Undefined, Undecided       no value exists; the balls are too wide to say
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import cache, reduce
from math import isqrt
from typing import TYPE_CHECKING, Any

import sympy as sp
from flint import arb, arb_series, ctx, fmpq
from sympy.core.function import AppliedUndef

if TYPE_CHECKING:
    from .models import Model

Number = Any  # fmpq, arb or arb_series, which mix
BITS = 320
"""Working precision: 96 digits."""
ZERO = fmpq(0)
NOTHING = arb(10) ** -200
"""A ball around 0 narrower than this, which only a higher precision gives, is 0."""


class Undefined(ArithmeticError):  # noqa: N818 - a fact about an expression, not a fault
    """The expression has no value there: a division by zero, the logarithm of a negative."""


class Undecided(ArithmeticError):  # noqa: N818
    """The balls are too wide, or the model cannot say."""


class NearZero(Undecided):
    """A divisor is a ball around 0, very narrow: 0 itself, as far as can be said."""


@dataclass(frozen=True)
class Moment:
    """A time in a model; ``terms`` coefficients of all that varies are wanted."""

    model: Model
    time: Number = ZERO
    terms: int = 1

    def now(self) -> Number:
        """Return time itself, as a series if one is wanted."""
        return self.time if self.terms == 1 else arb_series([self.time, 1], self.terms)


Value = Callable[[Moment], Number]


@contextmanager
def precision(bits: int = BITS, terms: int = 1) -> Iterator[None]:
    """Work with so many bits, and so many coefficients of a series."""
    before = ctx.prec, ctx.cap
    ctx.prec, ctx.cap = bits, terms
    try:
        yield
    finally:
        ctx.prec, ctx.cap = before


def head(x: Number) -> Number:
    """Return the value at the moment itself."""
    return x[0] if isinstance(x, arb_series) else x


def ball(x: Number) -> arb:
    """Return the value at the moment itself as a finite ball."""
    found = arb(head(x))
    if not found.is_finite():
        raise Undecided("not finite")
    return found


def _nonzero(x: Number) -> None:
    first = head(x)
    if first == 0:
        raise Undefined("division by zero")
    if isinstance(first, arb) and first.contains(0):
        narrow = first.rad() < NOTHING
        raise NearZero("division by zero") if narrow else Undecided("perhaps a division by zero")


def _positive(x: Number, what: str) -> None:
    first = arb(head(x))
    if not first > 0:
        raise Undefined(what) if first <= 0 else Undecided(what)


def _divided(a: Number, b: Number) -> Number:
    _nonzero(b)
    return a / b


def _power(base: Number, exponent: Number) -> Number:
    if isinstance(exponent, fmpq) and exponent.q == 1:
        n = int(exponent.p)
        return base**n if n >= 0 else _divided(fmpq(1), base**-n)
    if head(base) == 0 and not isinstance(base, arb_series):
        if arb(head(exponent)) > 0:
            return fmpq(0)
        raise Undefined("a power of zero")
    if exponent == fmpq(1, 2):
        return _root(base)
    _positive(base, "a power of a negative")
    return _exp(exponent * _log(base))


def _root(x: Number) -> Number:
    if isinstance(x, fmpq):
        p, q = isqrt(abs(int(x.p))), isqrt(int(x.q))
        if fmpq(p * p, q * q) == x:
            return fmpq(p, q)
    if arb(head(x)) < 0:
        raise Undefined("the root of a negative")
    return arb(x).sqrt() if isinstance(x, fmpq) else x.sqrt()


def _exp(x: Number) -> Number:
    return fmpq(1) if x == 0 and isinstance(x, fmpq) else _raised(x).exp()


def _log(x: Number) -> Number:
    _positive(x, "the logarithm of what is not positive")
    return fmpq(0) if isinstance(x, fmpq) and x == 1 else _raised(x).log()


def _raised(x: Number) -> Number:
    return arb(x) if isinstance(x, fmpq) else x


def _tanh(x: Number) -> Number:
    if not isinstance(x, arb_series):
        return fmpq(0) if x == 0 and isinstance(x, fmpq) else arb(x).tanh()
    if head(x) > 0:
        return -_tanh(-x)
    grown = (2 * x).exp()
    return (grown - 1) / (grown + 1)


def _modulus(x: Number) -> Number:
    return x * _sign(x) if isinstance(x, arb_series) else abs(x)


def _sign(x: Number) -> fmpq:
    first = head(x)
    if first == 0:
        return fmpq(0)
    if not (first > 0 or first < 0):
        raise Undecided("a sign")
    return fmpq(1 if first > 0 else -1)


def _floor(x: Number) -> fmpq:
    first = head(x)
    if isinstance(first, fmpq):
        return fmpq(int(first.p) // int(first.q))
    whole = first.floor().unique_fmpz()
    if whole is None:
        raise Undecided("a floor")
    return fmpq(whole)


def _lambert(x: Number, branch: Number = ZERO) -> Number:
    edge = arb(-1).exp()
    if arb(head(x)) + edge < 0 or (branch != 0 and not arb(head(x)) < 0):
        raise Undefined("a Lambert function outside its domain")
    return _raised(x).lambertw(0 if branch == 0 else -1)


def _smaller(a: Number, b: Number) -> Number:
    return a if _sign(b - a) >= 0 else b


_FUNCTIONS: dict[type, Callable[..., Number]] = {
    sp.exp: _exp,
    sp.log: _log,
    sp.tanh: _tanh,
    sp.coth: lambda x: _divided(fmpq(1), _tanh(x)),
    sp.sinh: lambda x: (_exp(x) - _exp(-x)) / 2,
    sp.cosh: lambda x: (_exp(x) + _exp(-x)) / 2,
    sp.sin: lambda x: fmpq(0) if isinstance(x, fmpq) and x == 0 else _raised(x).sin(),
    sp.cos: lambda x: fmpq(1) if isinstance(x, fmpq) and x == 0 else _raised(x).cos(),
    sp.tan: lambda x: _divided(_raised(x).sin(), _raised(x).cos()),
    sp.atan: lambda x: fmpq(0) if isinstance(x, fmpq) and x == 0 else _raised(x).atan(),
    sp.asin: lambda x: _raised(x).asin(),
    sp.acos: lambda x: _raised(x).acos(),
    sp.Abs: _modulus,
    sp.sign: _sign,
    sp.floor: _floor,
    sp.ceiling: lambda x: -_floor(-x),
    sp.LambertW: _lambert,
    sp.Ei: lambda x: _raised(x).ei(),
    sp.besseli: lambda order, x: arb(head(x)).bessel_i(arb(head(order))),
    sp.Min: lambda *xs: reduce(_smaller, xs),
    sp.Max: lambda *xs: -reduce(_smaller, [-x for x in xs]),
    sp.Pow: _power,
    sp.Add: lambda *xs: reduce(lambda a, b: a + b, xs),
    sp.Mul: lambda *xs: reduce(lambda a, b: a * b, xs),
}

_CONSTANTS: dict[sp.Basic, Callable[[], arb]] = {
    sp.pi: arb.pi,
    sp.E: arb.const_e,
    sp.EulerGamma: arb.const_euler,
}


@cache
def compiled(expr: sp.Expr, variable: sp.Symbol) -> Value:
    """Return the function that gives an expression its value at a moment; ``variable`` is what
    runs there (time)."""
    if expr == variable:
        return Moment.now
    if expr in _CONSTANTS:
        known = _CONSTANTS[expr]
        return lambda _: known()
    if expr.is_Number and expr.is_finite:
        exact = sp.Rational(expr)
        number = fmpq(int(exact.p), int(exact.q))
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
    return lambda moment: function(*(argument(moment) for argument in arguments))


def _field(expr: AppliedUndef, variable: sp.Symbol) -> Value:
    name, (argument,) = expr.func.__name__, expr.args
    if argument == variable:
        return lambda moment: moment.model.field(name, moment.time, moment.terms)
    at, slope = compiled(argument, variable), compiled(sp.diff(argument, variable), variable)

    def value(moment: Moment) -> Number:
        plain = replace(moment, terms=1)
        speed = slope(plain)
        if moment.terms == 1 or speed == 0:
            return head(moment.model.field(name, at(plain), 1))
        found = moment.model.field(name, at(plain), moment.terms)
        if isinstance(found, fmpq):
            return found
        return arb_series([c * speed**k for k, c in enumerate(found.coeffs())], moment.terms)

    return value


def _derivative(expr: sp.Derivative, variable: sp.Symbol) -> Value:
    if not all(v == variable for v, _ in expr.variable_count):
        if isinstance(expr.expr, sp.Symbol):
            name, data = expr.expr, tuple(expr.variables)
            return lambda moment: moment.model.slope(name, data)
        done = expr.doit()
        if done == expr:
            raise Undecided(f"{expr} is no derivative in time")
        return compiled(done, variable)
    inside, times = compiled(expr.expr, variable), sum(int(n) for _, n in expr.variable_count)

    def value(moment: Moment) -> Number:
        with precision(ctx.prec, moment.terms + times):
            found = inside(replace(moment, terms=moment.terms + times))
            if not isinstance(found, arb_series):
                return fmpq(0)
            for _ in range(times):
                found = found.derivative()
        return found if moment.terms > 1 else found[0]

    return value


def _at(expr: sp.Subs, variable: sp.Symbol) -> Value:
    """An expression at another value of its variable: a field at time zero, one period later."""
    (name,), (point,) = expr.variables, expr.point
    inside, at = compiled(expr.expr, name), compiled(point, variable)
    slope = sp.diff(point, variable)

    def value(moment: Moment) -> Number:
        if moment.terms > 1 and slope not in (0, 1):
            raise Undecided("a series of a series")
        terms = moment.terms if slope == 1 else 1
        return inside(Moment(moment.model, head(at(replace(moment, terms=1))), terms))

    return value


def _limit(expr: sp.Limit, _: sp.Symbol) -> Value:
    return lambda moment: moment.model.limit(expr)


def _integral(expr: sp.Integral, variable: sp.Symbol) -> Value:
    """Gauss and Legendre, on two halves; the error is the distance of two orders."""
    ((name, low, high),) = expr.limits
    inside = compiled(expr.function, name)
    ends = compiled(low, variable), compiled(high, variable)

    def value(moment: Moment) -> Number:
        if moment.terms > 1:
            raise Undecided("a series of an integral")
        a, b = (head(end(moment)) for end in ends)
        middle = (a + b) / 2

        def total(order: int) -> arb:
            found = arb(0)
            for start, end in ((a, middle), (middle, b)):
                for x, weight in _nodes(order):
                    at = (start + end) / 2 + (end - start) / 2 * x
                    found += weight * (end - start) / 2 * ball(inside(Moment(moment.model, at)))
            return found

        rough, fine = total(24), total(40)
        return arb(fine.mid(), abs(fine - rough).upper() + fine.rad())

    return value


@cache
def _nodes(order: int) -> tuple[tuple[arb, arb], ...]:
    return tuple(arb.legendre_p_root(order, k, weight=True) for k in range(order))


def _cases(expr: sp.Piecewise, variable: sp.Symbol) -> Value:
    from .truth import judged

    values = [(compiled(value, variable), condition) for value, condition in expr.args]

    def value(moment: Moment) -> Number:
        for branch, condition in values:
            if judged(condition, replace(moment, terms=1), variable):
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
