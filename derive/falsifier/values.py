"""Values of expressions, and truth of relations, in a model.

Overview
    An expression is compiled, once, to a function of a moment (a model and a time).  Derivatives
    in time are those of the fields' formulas.  Equations are compared to the digits that their
    sides have, 20 and more, or up to 12 with fields that are integrated; inequalities are decided
    if the balls of the two sides do not overlap (with four times the precision if they do at
    first).  A limit is judged by its trend.  Hypotheses and claims are
    about all times: a relation is evaluated at the model's times, and does not hold if one of its
    sides has no value (0/0).
Key results
    compiled(expr)            the function of a moment
    truth(relation, model)    True, False or None (no verdict), and where
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import lru_cache
from itertools import chain
from math import tau
from operator import eq, ge, gt, le, lt, ne
from typing import Any

import sympy as sp
from flint import arb, ctx, fmpq
from sympy.core.function import AppliedUndef
from sympy.core.logic import fuzzy_and, fuzzy_not, fuzzy_or
from sympy.core.relational import Relational
from sympy.logic.boolalg import BooleanFunction

from ..claims import Drift, FirstZero, Term
from ..memory import cache
from ..symbols import symbol, t
from .balls import (
    BITS,
    CONSTANTS,
    FUNCTIONS,
    NOTHING,
    ZERO,
    NoValueError,
    Number,
    UndecidedError,
    UndefinedError,
    ball,
    first_zero,
    fraction,
    integral,
)
from .expansion import Array, ExpansionTerm, at_phase, coefficients

EARLY = 5
"""Number of a model's times within three periods."""
_ROUNDING, _AGREE = arb(10) ** -40, arb(10) ** -2
"""Relative widths of balls: from rounding alone; below which overlapping balls count as equal."""
_SMALL = arb(10) ** -9
"""Absolute width below which overlapping balls count as equal, since both sides may vanish."""
_T = symbol("T")
_COMPARED = {"==": eq, "!=": ne, "<": lt, "<=": le, ">": gt, ">=": ge}


@dataclass(frozen=True)
class Moment:
    """A time in a model; ``bound`` are the values of variables of integration and the like."""

    model: Any  # of .models: a Model
    time: Number = ZERO
    bound: Mapping[sp.Symbol, Number] = field(default_factory=dict)

    def at(self, name: sp.Symbol, value: Number) -> Moment:
        """Return the moment with a value of a variable."""
        if name == t:
            return replace(self, time=value)
        return replace(self, bound={**self.bound, name: value})


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


@cache
def field_of(expr: AppliedUndef) -> sp.Expr:
    """Return a field at time t."""
    return expr.func(t)


def _symbol(name: sp.Symbol) -> Value:
    return lambda moment: (
        moment.bound[name] if name in moment.bound else moment.model.constant(name)
    )


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


def _integral(expr: sp.Integral) -> Value:
    ((name, low, high),) = expr.limits
    inside, begin, end = compiled(expr.function), compiled(low), compiled(high)
    return lambda moment: integral(
        lambda x: ball(inside(moment.at(name, x))), begin(moment), end(moment)
    )


def _first_zero(expr: FirstZero) -> Value:
    inside, name = compiled(expr.args[0]), expr.args[1]
    return lambda moment: first_zero(lambda x: ball(inside(moment.at(name, x))))


def _expansion_term(expr: ExpansionTerm) -> Value:
    number, order = int(expr.args[0].args[0]), int(expr.args[1])

    def value(moment: Moment) -> arb:
        drift, waves = _expansion(moment.model, expr.args[0])
        if isinstance(expr.args[0], Drift):
            term = drift[number]
        else:
            phase = float(ball(moment.time / moment.model.constant(_T)).mid()) % 1
            term = at_phase(waves[number], phase, order)
        size = abs(drift[number]) + abs(waves[number]).max() * (number * tau) ** order
        return arb(float(term), 1e-9 * float(size))

    return value


@lru_cache(maxsize=50)
def _expansion(model: Any, term: Term) -> tuple[Array, Array]:
    """Return the coefficients of an averaged expansion up to a term of it."""
    number, law, s, _, rho = term.args
    inside, period = compiled(law), model.constant(_T)
    return coefficients(
        lambda size, phase: ball(inside(Moment(model, phase * period, {s: size}))),
        float(ball(compiled(rho)(Moment(model))).mid()),
        int(number),
    )


def _cases(expr: sp.Piecewise) -> Value:
    values = [(compiled(value), condition) for value, condition in expr.args]

    def value(moment: Moment) -> Number:
        for branch, condition in values:
            holds = holds_at(condition, moment, agree=False)
            if holds is None:
                raise UndecidedError("a condition of a piecewise expression")
            if holds:
                return branch(moment)
        raise UndefinedError("no case of a piecewise expression")

    return value


_SPECIAL: tuple[tuple[type, Callable[..., Value]], ...] = (
    (sp.Symbol, _symbol),
    (sp.Add, _sum),
    (AppliedUndef, _field),
    (sp.Derivative, _derivative),
    (sp.Subs, _at),
    (sp.Limit, lambda limit: lambda moment: moment.model.limit(limit)),
    (sp.Integral, _integral),
    (sp.Piecewise, _cases),
    (FirstZero, _first_zero),
    (ExpansionTerm, _expansion_term),
)


def holds_at(relation: sp.Basic, moment: Moment, agree: bool = True) -> bool | None:
    """Return whether a relation holds at a moment, None if it is undecided.

    With ``agree`` two sides whose balls overlap count as equal if these are narrow.
    """
    if relation in (sp.true, sp.false):
        return bool(relation)
    if isinstance(relation, (sp.And, sp.Or)):
        composed = fuzzy_and if isinstance(relation, sp.And) else fuzzy_or
        return composed(holds_at(part, moment, agree) for part in relation.args)
    if isinstance(relation, (sp.Not, sp.Implies, sp.Equivalent)):
        return holds_at(_normal_form(relation), moment, agree)
    if isinstance(relation, Relational):
        for bits in (BITS, 4 * BITS):
            with ctx.workprec(bits), suppress(UndecidedError):
                outcome = _compared(relation, moment, bits > BITS, agree)
                if outcome is not None:
                    return outcome
    return None


@cache
def _normal_form(relation: BooleanFunction) -> sp.Basic:
    """Return a relation composed by "and" and "or" alone."""
    return relation.to_nnf(simplify=False)


def _compared(relation: Relational, moment: Moment, final: bool, agree: bool) -> bool | None:
    left, right = relation.args
    if right == sp.oo and relation.rel_op in ("<", "<="):
        return True
    if isinstance(relation, sp.Ne) and relation.has(sp.Limit):
        return fuzzy_not(holds_at(sp.Eq(left, right, evaluate=False), moment))
    if isinstance(relation, sp.Eq):
        left, right = sorted(relation.args, key=lambda side: not isinstance(side, sp.Limit))
        if isinstance(left, sp.Limit):
            return _tends(left, right, moment)
        if right == 0 and isinstance(left, sp.Mul) and left.has(sp.Limit):
            zeros = (sp.Eq(factor, 0, evaluate=False) for factor in left.args)
            return fuzzy_or(holds_at(zero, moment) for zero in zeros)
    strict = isinstance(relation, (sp.Gt, sp.Lt)) and relation.has(sp.Limit)
    if strict and holds_at(sp.Eq(left, right, evaluate=False), moment):
        return False  # the balls of the two sides would overlap
    terms = [[compiled(term)(moment) for term in sp.Add.make_args(side)] for side in (left, right)]
    gap = sum(terms[0], ZERO) - sum(terms[1], ZERO)
    if isinstance(gap, fmpq) or gap.is_zero() or not gap.contains(0):
        return bool(_COMPARED[relation.rel_op](gap, 0))
    gap = ball(gap)
    size = max(abs(ball(term)).upper() for term in chain(*terms))
    if not agree or (not final and gap.rad() <= _ROUNDING * size):
        return None  # more digits may separate them
    if isinstance(relation, (sp.Eq, sp.Ge, sp.Le)) and gap.rad() <= max(_AGREE * size, _SMALL):
        return True
    if isinstance(relation, sp.Ne) and gap.rad() <= max(_AGREE * size, NOTHING):
        return False
    return None


def _tends(limit: sp.Limit, value: sp.Expr, moment: Moment) -> bool | None:
    if t in value.free_symbols:
        raise UndefinedError("no value: a limit in time that still depends on time")
    infinite = {sp.oo: arb.pos_inf(), -sp.oo: arb.neg_inf()}
    end = infinite[value] if value in infinite else ball(compiled(value)(moment))
    tends: bool | None = moment.model.tends(limit, end)
    return tends


@dataclass(frozen=True)
class Truth:
    """Whether a relation holds in a model, None if undecided.

    ``where`` is a time and values that refute it, or the expression without a value.
    """

    holds: bool | None
    where: str = ""


def truth(relation: sp.Basic, model: Any) -> Truth:
    """Return whether a relation holds in a model for all its times."""
    timeless = t not in relation.free_symbols

    def when(time: Number) -> str:
        return "" if timeless else f"at {t} = {_shown(time)}: "

    outcomes: set[bool | None] = set()
    for number, time in enumerate(model.times[:1] if timeless else model.times):
        moment = Moment(model, time)
        holds = None
        try:
            holds = holds_at(relation, moment)
        except UndefinedError as reason:
            return Truth(False, f"{when(time)}{reason}")
        except NoValueError as reason:
            if number < EARLY:
                return Truth(None, str(reason))
        except (ArithmeticError, ValueError, RecursionError):
            pass
        if holds is False:
            return Truth(False, when(time) + _sides(relation, moment))
        if holds or number < EARLY:
            outcomes.add(holds)
    return Truth(True if outcomes == {True} else None)


def _sides(relation: sp.Basic, moment: Moment) -> str:
    """Return the values of the two sides of a relation that does not hold."""
    if not isinstance(relation, Relational):
        return "it does not hold"
    values: list[tuple[str, Number | str]] = []
    for side in relation.args:
        latest = {limit: sp.Dummy() for limit in side.atoms(sp.Limit)}
        at = moment
        try:
            with ctx.workprec(BITS):
                for limit, name in latest.items():
                    at = at.at(name, moment.model.latest(limit))
                values.append(("last value " * bool(latest), compiled(side.xreplace(latest))(at)))
        except (ArithmeticError, ValueError):
            values.append(("", str(side) if side.is_infinite else "?"))
    for digits in range(6, 18):
        left, right = (_shown(value, digits) for _, value in values)
        if left != right:
            break
    return f"{values[0][0]}{left} on the left, {values[1][0]}{right} on the right"


def _shown(number: Number | str, digits: int = 6) -> str:
    if isinstance(number, str):
        return number
    value = arb(number)
    return f"{0.0 if value.contains(0) else float(value.mid()):.{digits}g}"
