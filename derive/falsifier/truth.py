"""Truth: whether a relation holds in a model, at an instant and for all time.

Overview
    A relation is meant for all times, as hypotheses and claims are.  It is evaluated at the
    model's times; equations to 20 digits and more, inequalities wherever the balls of the two
    sides part (with four times the precision if they do not at first).  A limit is judged by
    its trend.  What has no value (0/0) does not hold.
Key results
    judged(relation, moment)   at one moment; Undecided, Undefined are raised
    truth(relation, model)      True, False or None (no verdict), and where
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import chain
from operator import eq, ge, gt, le, lt, ne
from typing import TYPE_CHECKING

import sympy as sp
from flint import arb, ctx, fmpq
from sympy.core.relational import Relational
from sympy.logic.boolalg import And, BooleanFunction, Equivalent, Implies, Not, Or

from ..symbols import t
from .balls import (
    BITS,
    NOTHING,
    ZERO,
    Moment,
    NoValue,
    Number,
    Undecided,
    Undefined,
    ball,
    compiled,
)
from .trend import diverges, tends_to

if TYPE_CHECKING:
    from .models import Model

EARLY = 5
"""So many of a model's times are within three periods."""
_ROUNDING, _AGREE = arb(10) ** -40, arb(10) ** -2
"""Relative widths of balls: due to rounding alone; up to which those that overlap are equal."""
_SMALL = arb(10) ** -9
"""Width up to which balls that overlap are equal, data being about 1: both sides may vanish."""


_COMPARED = {"==": eq, "!=": ne, "<": lt, "<=": le, ">": gt, ">=": ge}


@dataclass(frozen=True)
class Truth:
    """Whether a relation holds in a model; None where no time decides.  ``where``: a witness, or
    what has no value in the model."""

    holds: bool | None
    where: str = ""


def judged(relation: sp.Basic, moment: Moment) -> bool:
    """Return whether a relation holds at a moment."""
    if relation in (sp.true, sp.false):
        return bool(relation)
    if isinstance(relation, BooleanFunction):
        return _composed(relation, moment)
    if not isinstance(relation, Relational):
        raise Undecided(f"{relation} is no relation")
    for bits in (BITS, 4 * BITS):
        final = bits > BITS
        with ctx.workprec(bits):
            try:
                outcome = _compared(relation, moment, final)
            except Undecided:
                if final:
                    raise
                continue
        if outcome is not None:
            return outcome
    raise Undecided("the two sides cannot be distinguished")


def _composed(relation: BooleanFunction, moment: Moment) -> bool:
    parts = relation.args
    if isinstance(relation, Not):
        return not judged(parts[0], moment)
    if isinstance(relation, Implies):
        return not judged(parts[0], moment) or judged(parts[1], moment)
    if isinstance(relation, Equivalent):
        return len({judged(part, moment) for part in parts}) == 1
    if isinstance(relation, (And, Or)):
        return _joined(relation, moment)
    raise Undecided(f"{type(relation).__name__} has no truth")


def _joined(relation: BooleanFunction, moment: Moment) -> bool:
    """Return the truth of an 'and' or an 'or', though parts of it may be undecided."""
    decisive, unknown = isinstance(relation, Or), None
    for part in relation.args:
        try:
            if judged(part, moment) == decisive:
                return decisive
        except Undecided as found:
            unknown = found
    if unknown is not None:
        raise unknown
    return not decisive


def _compared(relation: Relational, moment: Moment, final: bool) -> bool | None:
    left, right = relation.lhs, relation.rhs
    equal = isinstance(relation, (sp.Eq, sp.Ne))
    if equal and isinstance(right, sp.Limit):
        left, right = right, left
    if equal and right == 0 and isinstance(left, sp.Mul) and left.has(sp.Limit):
        zeros = [judged(sp.Eq(factor, 0, evaluate=False), moment) for factor in left.args]
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
        return None  # perhaps more digits part them
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
    """Return the truth of a claim on a limit; None where it is a comparison of numbers."""
    equal = isinstance(relation, (sp.Eq, sp.Ne))
    if not equal:
        return True if right == sp.oo and isinstance(relation, (sp.Lt, sp.Le)) else None
    if not isinstance(left, sp.Limit):
        return None
    if right.is_infinite:
        sign = 1 if right == sp.oo else -1
        outcome = moment.model.confirmed(left, lambda found: diverges(found, sign))
    else:
        if t in right.free_symbols:
            raise Undefined("a limit in time that still depends on time")
        value = ball(compiled(right)(moment))
        outcome = moment.model.confirmed(left, lambda found: tends_to(found, value))
    if outcome is None:
        raise Undecided("the trend is not clear")
    return outcome == isinstance(relation, sp.Eq)


def truth(relation: sp.Basic, model: Model) -> Truth:
    """Return whether a relation holds in a model for all its times."""
    timeless = t not in relation.free_symbols
    decided, doubtful = False, False
    for number, time in enumerate(model.times[:1] if timeless else model.times):
        moment = Moment(model, time)
        when = "" if timeless else f"at {t} = {_shown(time)}: "
        try:
            if not judged(relation, moment):
                return Truth(False, when + _sides(relation, moment))
            decided = True
        except Undefined as reason:
            return Truth(False, f"{when}{reason}")
        except NoValue as reason:
            if number < EARLY:
                return Truth(None, str(reason))
        except (ArithmeticError, ValueError, RecursionError):
            doubtful = doubtful or number < EARLY
    return Truth(True if decided and not doubtful else None)


def _sides(relation: sp.Basic, moment: Moment) -> str:
    """Return the values of the two sides of a relation that does not hold."""
    if not isinstance(relation, Relational):
        return "it does not hold"
    values: list[tuple[str, Number | str]] = []
    for side in relation.args:
        try:
            limit = isinstance(side, sp.Limit)
            found = moment.model.latest(side) if limit else compiled(side)(moment)
            values.append(("towards " if limit else "", found))
        except (ArithmeticError, ValueError):
            values.append(("", "oo" if side.is_infinite else "?"))
    for digits in range(6, 18):
        left, right = (_shown(value, digits) for _, value in values)
        if left != right:
            break
    return f"{values[0][0]}{left} on the left, {values[1][0]}{right} on the right"


def _shown(number: Number | str, digits: int = 6) -> str:
    return number if isinstance(number, str) else f"{float(arb(number).mid()):.{digits}g}"
