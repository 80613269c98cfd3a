"""Truth: whether a relation holds in a model for all time.

Overview
    Hypotheses and claims are about all times.  A relation is evaluated at the model's times; it
    does not hold if one of its sides has no value (0/0).
Key results
    truth(relation, model)      True, False or None (no verdict), and where
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp
from flint import arb
from sympy.core.relational import Relational

from ..symbols import t
from .balls import NoValueError, Number, UndefinedError
from .models import Model
from .values import Moment, compiled, holds_at

EARLY = 5
"""Number of a model's times within three periods."""


@dataclass(frozen=True)
class Truth:
    """Whether a relation holds in a model, None if undecided.

    ``where`` is a time and values that refute it, or the expression without a value.
    """

    holds: bool | None
    where: str = ""


def truth(relation: sp.Basic, model: Model) -> Truth:
    """Return whether a relation holds in a model for all its times."""
    timeless = t not in relation.free_symbols
    decided, doubtful = False, False
    for number, time in enumerate(model.times[:1] if timeless else model.times):
        moment = Moment(model, time)
        when = "" if timeless else f"at {t} = {_shown(time)}: "
        try:
            if not holds_at(relation, moment):
                return Truth(False, when + _sides(relation, moment))
            decided = True
        except UndefinedError as reason:
            return Truth(False, f"{when}{reason}")
        except NoValueError as reason:
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
        latest = {limit: sp.Dummy() for limit in side.atoms(sp.Limit)}
        at = moment
        try:
            for limit, name in latest.items():
                at = at.at(name, moment.model.latest(limit))
            values.append(("towards " * bool(latest), compiled(side.xreplace(latest))(at)))
        except (ArithmeticError, ValueError):
            values.append(("", "oo" if side.is_infinite else "?"))
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
