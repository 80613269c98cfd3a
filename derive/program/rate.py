"""The functions of the wear rate: explicit with a rigid support, through the pressure else.

Key results
    law         the contact law at ``ratio``, in a form to compute with
    to_ratio    the assignments that lead to ``ratio``
    rigid       rate and slope with a rigid support
    rate_and_slope   both at once
    compliant   rate and slope at the pressure with a compliant support
"""

from __future__ import annotations

import sympy as sp

from ..laws import r
from ..symbols import symbol
from ..variant import Variant
from .function import Assignment, Function, made
from .relations import Relations
from .slopes import with_slopes
from .symbols import (
    compliance,
    h,
    largest_rate,
    load,
    number,
    pressure,
    ratio,
    sigma,
    u,
    wear_per_pressure,
)

p_max = symbol("p_max")


def law(variant: Variant) -> tuple[tuple[Assignment, ...], sp.Expr, sp.Expr]:
    """Return the law's intermediates, value and slope at ``ratio``."""
    row = variant.law.stable
    names = tuple((name, expr.subs(r, ratio)) for name, expr in row.names)
    return names, row.value.subs(r, ratio), row.slope.subs(r, ratio)


def to_ratio(relations: Relations, deflected: bool) -> tuple[Assignment, ...]:
    """Return the assignments of the roughnesses, the closure and their ratio."""
    return (*relations.roughnesses(), relations.closure(deflected), (ratio, h / sigma))


def rigid(relations: Relations) -> tuple[Function, ...]:
    """Return the rate of wear and its slope."""
    names, value, slope = law(relations.variant)
    sloped, slopes = with_slopes(to_ratio(relations, deflected=False))
    assignments = (*sloped, *names)
    rate, change = largest_rate * value, largest_rate * slope * slopes[ratio]
    return (
        made("rate", (u, load), assignments, rate),
        made("slope", (u, load), assignments, change),
    )


def rate_and_slope(rate: Function, slope: Function) -> Function:
    """Return the rate and its slope at the cost of little more than one."""
    assignments = tuple(dict.fromkeys((*slope.assignments, *rate.assignments)))
    return made("rate_and_slope", rate.arguments, assignments, *rate.results, *slope.results)


def compliant(relations: Relations) -> tuple[Function, ...]:
    """Return the rate of wear at a pressure, and its slope at the root."""
    names, _, slope = law(relations.variant)
    sloped, slopes = with_slopes(to_ratio(relations, deflected=True))
    stiffening = number("residual_p"), 1 - p_max * slope * compliance / sigma
    change = wear_per_pressure * p_max * slope * slopes[ratio] / stiffening[0]
    return (
        made("rate", (pressure,), (), wear_per_pressure * pressure),
        made("slope", (pressure, u, load), (*sloped, *names, stiffening), change),
    )
