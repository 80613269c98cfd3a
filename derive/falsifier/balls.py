"""Numbers: the value of an expression at a time in a model, in ball arithmetic.

Overview
    An expression is compiled, once, to a function of a moment (a model and a time).  Rational
    numbers stay exact, so that 0/0 is seen; all else is a ball of `python-flint` that contains
    the value.  Derivatives in time are those of the fields' own formulas.
Key results
    compiled(expr)         the function of a moment
    Undefined, Undecided   no value exists; the balls are too wide to say
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache, lru_cache, reduce
from itertools import pairwise
from math import isqrt, tau
from operator import mul
from typing import Any

import sympy as sp
from flint import arb, fmpq
from sympy.core.function import AppliedUndef

from ..claims import FirstZero
from ..symbols import t
from .expansion import Array, Expanded, at_phase, coefficients

Number = Any  # fmpq or arb, which mix
BITS = 320
"""Working precision: 96 digits."""
ZERO = fmpq(0)
_HALVINGS_OF_ZERO = 110
_HALVINGS, _AGREEING = 24, arb(10) ** -12
"""Of an interval of integration; relative distance of two rules that needs none."""
NOTHING = arb(10) ** -200
"""A ball around 0 narrower than this, which only a higher precision gives, is 0."""


class Undefined(ArithmeticError):  # noqa: N818 - a fact about an expression, not a fault
    """The expression has no value there: a division by zero, the logarithm of a negative."""


class Undecided(ArithmeticError):  # noqa: N818
    """The balls are too wide, or the model cannot say."""


class NoValue(Undecided):
    """The model itself gives a quantity no value."""


@dataclass(frozen=True)
class Moment:
    """A time in a model; ``bound`` are the values of variables of integration and the like."""

    model: Any  # of .models: a Model
    time: Number = ZERO
    bound: tuple[tuple[sp.Symbol, Number], ...] = ()

    def at(self, name: sp.Symbol, value: Number) -> Moment:
        """Return the moment at which a variable has a value."""
        if name == t:
            return replace(self, time=value)
        return replace(self, bound=((name, value), *self.bound))

    def valued(self, name: sp.Symbol) -> Number:
        """Return the value of a variable or of a datum."""
        for variable, value in self.bound:
            if variable == name:
                return value
        return self.model.constant(name)


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
        raise Undecided("perhaps a division by zero")
    return a / b


def _positive(x: Number, what: str) -> None:
    if not arb(x) > 0:
        raise Undefined(what) if arb(x) <= 0 else Undecided(what)


def _power(base: Number, exponent: Number) -> Number:
    if isinstance(exponent, fmpq) and exponent.q == 1:
        n = int(exponent.p)
        if n < 0:
            return _divided(fmpq(1), _power(base, -exponent))
        if isinstance(base, arb) and base.contains(0):  # a power of a ball takes its logarithm
            return reduce(mul, [base] * n, fmpq(1))
        return base**n
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
    sp.Mul: lambda *xs: reduce(lambda a, b: a * b, xs),
}

_CONSTANTS: dict[sp.Basic, Callable[[], arb]] = {
    sp.pi: arb.pi,
    sp.E: arb.const_e,
}


@cache
def compiled(expr: sp.Basic) -> Value:
    """Return the function that gives an expression its value at a moment."""
    if expr == t:
        return lambda moment: moment.time
    if expr in _CONSTANTS:
        known = _CONSTANTS[expr]
        return lambda _: known()
    if expr.is_Number and expr.is_finite:
        number = fraction(expr)
        return lambda _: number
    for kind, build in _SPECIAL:
        if isinstance(expr, kind):
            return build(expr)
    if type(expr) not in _FUNCTIONS:
        raise Undecided(f"{type(expr).__name__} has no number")
    function = _FUNCTIONS[type(expr)]
    arguments = [compiled(a) for a in expr.args]
    return lambda moment: function(*[argument(moment) for argument in arguments])


def field_of(expr: AppliedUndef) -> sp.Expr:
    """Return a field at time t, always the same object: it is looked up often."""
    return _at_time_t(expr.func)


@cache
def _at_time_t(function: sp.FunctionClass) -> sp.Expr:
    return function(t)


def _field(expr: AppliedUndef, order: int = 0) -> Value:
    field, at = field_of(expr), compiled(expr.args[0])
    return lambda moment: moment.model.field(field, at(moment), order)


def _sum(expr: sp.Add) -> Value:
    """Return a sum, in which what a field gains from one time to another loses no digits."""
    fields = [(a, -b) for a in expr.args for b in expr.args
              if isinstance(a, AppliedUndef) and isinstance(-b, AppliedUndef)
              and a.func == (-b).func]  # fmt: skip
    if not fields:
        terms = [compiled(term) for term in expr.args]
        return lambda moment: sum((term(moment) for term in terms), ZERO)
    later, earlier = fields[0]
    rest, field = compiled(expr - later + earlier), field_of(later)
    begin, end = compiled(earlier.args[0]), compiled(later.args[0])
    return lambda moment: rest(moment) + moment.model.gain(field, begin(moment), end(moment))


def _derivative(expr: sp.Derivative) -> Value:
    inside, data = expr.expr, tuple(expr.variables)
    if isinstance(inside, sp.Symbol):
        return lambda moment: moment.model.slope(inside, data)
    if isinstance(inside, AppliedUndef) and set(data) == set(inside.args):
        return _field(inside, len(data))
    done = expr.doit()
    if done == expr:
        raise Undecided(f"{expr} is no derivative in time")
    return compiled(done)


def _at(expr: sp.Subs) -> Value:
    """An expression at another value of its variable: a field at time zero, one period later."""
    (name,), (point,) = expr.variables, expr.point
    inside, at = compiled(expr.expr), compiled(point)
    return lambda moment: inside(moment.at(name, at(moment)))


def _limit(expr: sp.Limit) -> Value:
    return lambda moment: moment.model.limit(expr)


def _integral(expr: sp.Integral) -> Value:
    """Gauss and Legendre, on halves of halves until two orders agree; the error is their
    distance."""
    ((name, low, high),) = expr.limits
    inside, begin, end = compiled(expr.function), compiled(low), compiled(high)

    def value(moment: Moment) -> Number:
        def total(a: Number, b: Number, halvings: int) -> arb:
            half = (b - a) / 2
            coarse, fine = (
                half * sum(weight * ball(inside(moment.at(name, a + half * (1 + x))))
                           for x, weight in _nodes(order))
                for order in (20, 32)
            )  # fmt: skip
            error = abs(fine - coarse).mid()
            if halvings and error > fine.rad() and error > _AGREEING * abs(fine).mid():
                return total(a, a + half, halvings - 1) + total(a + half, b, halvings - 1)
            return fine + arb(0, error)

        return total(begin(moment), end(moment), _HALVINGS)

    return value


@cache
def _nodes(order: int) -> tuple[tuple[arb, arb], ...]:
    return tuple(arb.legendre_p_root(order, k, weight=True) for k in range(order))


def _first_zero(expr: FirstZero) -> Value:
    """The first of the intervals, halved, in which the balls do not exclude a zero."""
    inside, name = compiled(expr.args[0]), expr.args[1]

    def value(moment: Moment) -> arb:
        def sign(x: Number) -> fmpq:
            try:
                return _sign(ball(inside(moment.at(name, x))))
            except Undecided:
                return ZERO

        def first(low: fmpq, high: fmpq, halvings: int) -> arb | None:
            middle, width = (low + high) / 2, high - low
            if sign(arb(middle, arb(width / 2).upper())) != 0:
                return None
            if halvings == 0:  # the zero is here, or near enough to be seen from here
                if sign(low - 8 * width) * sign(high + 8 * width) < 0:
                    return arb(middle, arb(9 * width).upper())
                raise Undecided("perhaps a zero")
            earlier = first(low, middle, halvings - 1)
            return first(middle, high, halvings - 1) if earlier is None else earlier

        ends = (ZERO, *(fmpq(137, 100) * fmpq(2) ** k for k in range(-20, 40)))
        for low, high in pairwise(ends):
            found = first(low, high, _HALVINGS_OF_ZERO)
            if found is not None:
                return found
        raise Undecided("no zero is found")

    return value


def _expanded(expr: Expanded) -> Value:
    number, order = map(int, expr.args[:2])
    law, at = expr.args[2:6], compiled(expr.args[6])

    def value(moment: Moment) -> arb:
        drift, waves = _coefficients(moment.model, number, *law)
        phase = float(ball(at(moment)).mid()) % 1
        found = drift[number] if order < 0 else at_phase(waves[number], phase, order)
        size = abs(drift[number]) + abs(waves[number]).max() * (number * tau) ** max(order, 0)
        return arb(float(found), 1e-9 * float(size))

    return value


@lru_cache(maxsize=50)
def _coefficients(
    model: Any, number: int, law: sp.Expr, s: sp.Symbol, phase: sp.Symbol, rho: sp.Expr
) -> tuple[Array, Array]:
    now, inside = Moment(model), compiled(law)
    return coefficients(
        lambda size, turned: ball(inside(now.at(s, size).at(phase, turned))),
        float(ball(compiled(rho)(now)).mid()),
        number,
    )


def _cases(expr: sp.Piecewise) -> Value:
    from .truth import judged

    values = [(compiled(value), condition) for value, condition in expr.args]

    def value(moment: Moment) -> Number:
        for branch, condition in values:
            if judged(condition, moment):
                return branch(moment)
        raise Undefined("no case of a piecewise expression")

    return value


_SPECIAL: tuple[tuple[type, Callable[..., Value]], ...] = (
    (sp.Symbol, lambda name: lambda moment: moment.valued(name)),
    (sp.Add, _sum),
    (AppliedUndef, _field),
    (sp.Derivative, _derivative),
    (sp.Subs, _at),
    (sp.Limit, _limit),
    (sp.Integral, _integral),
    (sp.Piecewise, _cases),
    (FirstZero, _first_zero),
    (Expanded, _expanded),
)
