"""The functions of the contact condition, h <= 3 sigma.

Overview
    With one rough surface the margin is linear in the wear. It is computed from where it starts and
    how it grows: roughness and closure grow with the wear, and their difference would be lost.
Key results
    constants  start and growth of a linear margin, named
    margin     3 sigma - h with an undeflected support, its slope, the terms it is made of
    limited    the pressure of a compliant support, which lets go no further than to h = 3 sigma
Remarks
    Neither the contact law nor the support takes part: the functions depend on the pin alone.
"""

from __future__ import annotations

import sympy as sp

from .function import Assignment, Function, made
from .relations import Relations
from .slopes import with_slopes
from .symbols import (
    compliance,
    fresh_margin,
    h,
    load,
    margin_gain,
    most_of_gain,
    most_of_margin,
    number,
    pressure,
    sigma,
    u,
    wear_per_pressure,
)

value_of_margin, slope_of_margin = number("margin"), number("margin_slope")


def constants(relations: Relations) -> tuple[Assignment, ...]:
    """Return start and growth of a margin that is linear in the wear, none of another.

    One roughness is added last: where 3 sigma and h are close, both steps are exact.
    """
    if relations.variant.pin.rough:
        return ()
    values = dict(_undeflected(relations))
    most = (relations.variant.law.cutoff - 1) * values[sigma] - values[h]
    fresh = {u: 0, load: 0}
    return (
        (most_of_margin, most.subs(fresh)),
        (fresh_margin, most_of_margin + values[sigma].subs(fresh)),
        (most_of_gain, sp.diff(most, u)),
        (margin_gain, most_of_gain + sp.diff(values[sigma], u)),
    )


def margin(relations: Relations) -> tuple[Function, ...]:
    """Return the margin, its slope and the sum of its absolute terms."""
    assignments, value, slope = _margin(relations)
    terms = sp.Add.make_args(sp.expand(value.subs(dict([relations.closure(deflected=False)]))))
    return (
        made("margin", (u, load), assignments, value),
        made("margin_slope", (u,), assignments, slope),
        made("margin_terms", (u, load), assignments, sp.Add(*map(sp.Abs, terms))),
    )


def limited() -> tuple[Function, ...]:
    """Return the pressure of a compliant support that lets go no further than to h = 3 sigma, and
    the slope of the rate while h stays there."""
    held = sp.Min(pressure, sp.Max(0, value_of_margin / compliance))
    change = wear_per_pressure * slope_of_margin / compliance
    return (
        made("limited_pressure", (pressure, value_of_margin, compliance), (), held),
        made("limited_slope", (slope_of_margin, compliance, wear_per_pressure), (), change),
    )


def _undeflected(relations: Relations) -> tuple[Assignment, ...]:
    return (*relations.roughnesses(), relations.closure(deflected=False))


def _margin(relations: Relations) -> tuple[tuple[Assignment, ...], sp.Expr, sp.Expr]:
    """Return the margin, its derivative with respect to u, and what they are made of."""
    if not relations.variant.pin.rough:
        return (), fresh_margin + margin_gain * u + load, margin_gain
    cutoff = relations.variant.law.cutoff
    assignments, slopes = with_slopes(_undeflected(relations))
    return assignments, cutoff * sigma - h, cutoff * slopes.get(sigma, 0) - slopes[h]
