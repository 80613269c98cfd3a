"""Values of expressions, and truth of relations, at a time in a model.

Overview
    An expression is compiled, once, to a function of a moment (a model and a time).  Derivatives
    in time are those of the fields' formulas.  Equations are compared to 20 digits and more,
    inequalities are decided if the balls of the two sides do not overlap (with four times the
    precision if they do at first).  A limit is judged by its trend.
Key results
    compiled(expr)               the function of a moment
    holds_at(relation, moment)   whether it holds; raises UndecidedError and UndefinedError
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache, lru_cache
from itertools import chain
from math import tau
from operator import eq, ge, gt, le, lt, ne
from typing import Any

import sympy as sp
from flint import arb, ctx, fmpq
from sympy.core.function import AppliedUndef
from sympy.core.relational import Relational
from sympy.logic.boolalg import And, BooleanFunction, Equivalent, Implies, Not, Or

from ..claims import FirstZero
from ..symbols import t
from .balls import (
    BITS,
    CONSTANTS,
    FUNCTIONS,
    NOTHING,
    ZERO,
    Number,
    UndecidedError,
    UndefinedError,
    ball,
    first_zero,
    fraction,
    integral,
)
from .expansion import Array, ExpansionCoefficient, at_phase, coefficients
from .trend import diverges, tends_to

_ROUNDING, _AGREE = arb(10) ** -40, arb(10) ** -2
"""Relative widths of balls: from rounding alone; below which overlapping balls count as equal."""
_SMALL = arb(10) ** -9
"""Absolute width below which overlapping balls count as equal, since both sides may vanish."""


_COMPARED = {"==": eq, "!=": ne, "<": lt, "<=": le, ">": gt, ">=": ge}


@dataclass(frozen=True)
class Moment:
    """A time in a model; ``bound`` are the values of variables of integration and the like."""

    model: Any  # of .models: a Model
    time: Number = ZERO
    bound: tuple[tuple[sp.Symbol, Number], ...] = ()

    def at(self, name: sp.Symbol, value: Number) -> Moment:
        """Return the moment with a value of a variable."""
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


@cache
def compiled(expr: sp.Basic) -> Value:
    """Return the function from a moment to the value of an expression."""
    if expr == t:
        return lambda moment: moment.time
    if expr in CONSTANTS:
        known = CONSTANTS[expr]
        return lambda _: known()
    if expr.is_Number and expr.is_finite:
        number = fraction(expr)
        return lambda _: number
    for kind, build in _SPECIAL:
        if isinstance(expr, kind):
            return build(expr)
    if type(expr) not in FUNCTIONS:
        raise UndecidedError(f"{type(expr).__name__} has no numerical value")
    function = FUNCTIONS[type(expr)]
    arguments = [compiled(a) for a in expr.args]
    return lambda moment: function(*[argument(moment) for argument in arguments])


def field_of(expr: AppliedUndef) -> sp.Expr:
    """Return a field at time t, always the same object for fast lookups."""
    return _at_time_t(expr.func)


@cache
def _at_time_t(function: sp.FunctionClass) -> sp.Expr:
    return function(t)


def _field(expr: AppliedUndef, order: int = 0) -> Value:
    field, at = field_of(expr), compiled(expr.args[0])
    return lambda moment: moment.model.field(field, at(moment), order)


def _sum(expr: sp.Add) -> Value:
    """Return a sum, in which the increment of a field between two times loses no digits."""
    fields = [(a, -b) for a in expr.args for b in expr.args
              if isinstance(a, AppliedUndef) and isinstance(-b, AppliedUndef)
              and a.func == (-b).func]  # fmt: skip
    if not fields:
        terms = [compiled(term) for term in expr.args]
        return lambda moment: sum((term(moment) for term in terms), ZERO)
    later, earlier = fields[0]
    rest, field = compiled(expr - later + earlier), field_of(later)
    begin, end = compiled(earlier.args[0]), compiled(later.args[0])
    return lambda moment: rest(moment) + moment.model.increment(field, begin(moment), end(moment))


def _derivative(expr: sp.Derivative) -> Value:
    inside, data = expr.expr, tuple(expr.variables)
    if isinstance(inside, sp.Symbol):
        return lambda moment: moment.model.slope(inside, data)
    if isinstance(inside, AppliedUndef) and set(data) == set(inside.args):
        return _field(inside, len(data))
    done = expr.doit()
    if done == expr:
        raise UndecidedError(f"{expr} is no derivative in time")
    return compiled(done)


def _at(expr: sp.Subs) -> Value:
    """Return an expression at another value of its variable, such as a field at time zero."""
    (name,), (point,) = expr.variables, expr.point
    inside, at = compiled(expr.expr), compiled(point)
    return lambda moment: inside(moment.at(name, at(moment)))


def _limit(expr: sp.Limit) -> Value:
    return lambda moment: moment.model.limit(expr)


def _integral(expr: sp.Integral) -> Value:
    ((name, low, high),) = expr.limits
    inside, begin, end = _along(expr.function, name), compiled(low), compiled(high)
    return lambda moment: integral(inside(moment), begin(moment), end(moment))


def _first_zero(expr: FirstZero) -> Value:
    inside = _along(*expr.args)
    return lambda moment: first_zero(inside(moment))


def _along(expr: sp.Expr, name: sp.Symbol) -> Callable[[Moment], Callable[[Number], arb]]:
    """Return an expression as a function of one variable, at each moment."""
    value = compiled(expr)
    return lambda moment: lambda x: ball(value(moment.at(name, x)))


def _expanded(expr: ExpansionCoefficient) -> Value:
    number, order = map(int, expr.args[:2])
    law, at = expr.args[2:6], compiled(expr.args[6])

    def value(moment: Moment) -> arb:
        drift, waves = _coefficients(moment.model, number, *law)
        phase = float(ball(at(moment)).mid()) % 1
        term = drift[number] if order < 0 else at_phase(waves[number], phase, order)
        size = abs(drift[number]) + abs(waves[number]).max() * (number * tau) ** max(order, 0)
        return arb(float(term), 1e-9 * float(size))

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
    values = [(compiled(value), condition) for value, condition in expr.args]

    def value(moment: Moment) -> Number:
        for branch, condition in values:
            if holds_at(condition, moment):
                return branch(moment)
        raise UndefinedError("no case of a piecewise expression")

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
    (ExpansionCoefficient, _expanded),
)


def holds_at(relation: sp.Basic, moment: Moment) -> bool:
    """Return whether a relation holds at a moment."""
    if relation in (sp.true, sp.false):
        return bool(relation)
    if isinstance(relation, BooleanFunction):
        return _composed(relation, moment)
    if not isinstance(relation, Relational):
        raise UndecidedError(f"{relation} is no relation")
    for bits in (BITS, 4 * BITS):
        final = bits > BITS
        with ctx.workprec(bits):
            try:
                outcome = _compared(relation, moment, final)
            except UndecidedError:
                if final:
                    raise
                continue
        if outcome is not None:
            return outcome
    raise UndecidedError("the two sides cannot be distinguished")


def _composed(relation: BooleanFunction, moment: Moment) -> bool:
    parts = relation.args
    if isinstance(relation, Not):
        return not holds_at(parts[0], moment)
    if isinstance(relation, Implies):
        return not holds_at(parts[0], moment) or holds_at(parts[1], moment)
    if isinstance(relation, Equivalent):
        return len({holds_at(part, moment) for part in parts}) == 1
    if isinstance(relation, (And, Or)):
        return _joined(relation, moment)
    raise UndecidedError(f"{type(relation).__name__} has no truth")


def _joined(relation: BooleanFunction, moment: Moment) -> bool:
    """Return the truth of an 'and' or an 'or', of which some parts may be undecided."""
    decisive, unknown = isinstance(relation, Or), None
    for part in relation.args:
        try:
            if holds_at(part, moment) == decisive:
                return decisive
        except UndecidedError as reason:
            unknown = reason
    if unknown is not None:
        raise unknown
    return not decisive


def _compared(relation: Relational, moment: Moment, final: bool) -> bool | None:
    left, right = relation.lhs, relation.rhs
    equal = isinstance(relation, (sp.Eq, sp.Ne))
    if equal and isinstance(right, sp.Limit):
        left, right = right, left
    if equal and right == 0 and isinstance(left, sp.Mul) and left.has(sp.Limit):
        zeros = [holds_at(sp.Eq(factor, 0, evaluate=False), moment) for factor in left.args]
        return any(zeros) == isinstance(relation, sp.Eq)
    if left.is_infinite or right.is_infinite or isinstance(left, sp.Limit):
        outcome = _at_infinity(relation, left, right, moment)
        if outcome is not None:
            return outcome
    terms = [[compiled(term)(moment) for term in sp.Add.make_args(side)] for side in (left, right)]
    gap = sum(terms[0], ZERO) - sum(terms[1], ZERO)
    if isinstance(gap, fmpq) or gap.is_zero() or not gap.contains(0):
        return bool(_COMPARED[relation.rel_op](_sign(gap), 0))
    gap = ball(gap)
    size = max(abs(ball(term)).upper() for term in chain(*terms))
    if not final and gap.rad() <= _ROUNDING * size:
        return None  # more digits may separate them
    if isinstance(relation, (sp.Eq, sp.Ge, sp.Le)) and gap.rad() <= max(_AGREE * size, _SMALL):
        return True
    if isinstance(relation, sp.Ne) and gap.rad() <= max(_AGREE * size, NOTHING):
        return False
    return None


def _sign(gap: fmpq | arb) -> int:
    return 0 if gap == 0 else 1 if gap > 0 else -1


def _at_infinity(
    relation: Relational, left: sp.Expr, right: sp.Expr, moment: Moment
) -> bool | None:
    """Return the truth of a claim on a limit; None if numbers are to be compared."""
    equal = isinstance(relation, (sp.Eq, sp.Ne))
    if not equal:
        return True if right == sp.oo and isinstance(relation, (sp.Lt, sp.Le)) else None
    if not isinstance(left, sp.Limit):
        return None
    if right.is_infinite:
        sign = 1 if right == sp.oo else -1
        outcome = moment.model.judge_limit(left, lambda windows: diverges(windows, sign))
    else:
        if t in right.free_symbols:
            raise UndefinedError("a limit in time that still depends on time")
        value = ball(compiled(right)(moment))
        outcome = moment.model.judge_limit(left, lambda windows: tends_to(windows, value))
    if outcome is None:
        raise UndecidedError("the trend is not clear")
    return outcome == isinstance(relation, sp.Eq)
