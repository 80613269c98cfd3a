"""The functions of a program: wear rate, fields, and the condition of contact.

Overview
    With a rigid support the rate is explicit, with a compliant one it is a function of the
    pressure.  The margin of contact, 3 sigma - h, depends neither on the contact law nor on the
    support.  With one rough surface it is linear in the wear, and computed from its initial value
    and its growth: roughness and closure grow with the wear, and their difference would lose all
    digits.
Key results
    law             the contact law at ``ratio``, in a form to compute with
    to_ratio        the assignments that lead to ``ratio``
    rigid           rate and slope with a rigid support
    rate_and_slope  both at once
    compliant       rate and slope at the pressure with a compliant support
    fields          every field at given wear and load
    constants       start and growth of a linear margin, named
    margin          3 sigma - h with an undeflected support, its slope, the size of its terms
    limited         the pressure on a compliant support, which relaxes no further than h = 3 sigma
"""

from __future__ import annotations

import sympy as sp

from ..laws import r
from ..note.governing import Pin
from ..symbols import symbol
from ..variant import Variant
from .function import Assignment, Function, pruned, with_slopes
from .relations import Relations
from .symbols import (
    compliance,
    fresh_margin,
    h,
    largest_rate,
    load,
    margin_gain,
    most_of_gain,
    most_of_margin,
    number,
    pressure,
    ratio,
    sigma,
    sigma_a,
    sigma_c,
    u,
    wear_per_pressure,
)

p_max = symbol("p_max")
value_of_margin, slope_of_margin = number("margin"), number("margin_slope")


def law(variant: Variant) -> tuple[tuple[Assignment, ...], sp.Expr, sp.Expr]:
    """Return the law's intermediates, value and slope at ``ratio``."""
    form = variant.law.stable
    intermediates = tuple((name, expr.subs(r, ratio)) for name, expr in form.intermediates)
    return intermediates, form.value.subs(r, ratio), form.slope.subs(r, ratio)


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
        pruned("rate", (u, load), assignments, rate),
        pruned("slope", (u, load), assignments, change),
    )


def rate_and_slope(rate: Function, slope: Function) -> Function:
    """Return the function of rate and slope together, which costs little more than one."""
    assignments = tuple(dict.fromkeys((*slope.assignments, *rate.assignments)))
    return pruned("rate_and_slope", rate.arguments, assignments, *rate.results, *slope.results)


def compliant(relations: Relations) -> tuple[Function, ...]:
    """Return the rate of wear at a pressure, and its slope at the root."""
    names, _, slope = law(relations.variant)
    sloped, slopes = with_slopes(to_ratio(relations, deflected=True))
    stiffening = number("residual_p"), 1 - p_max * slope * compliance / sigma
    change = wear_per_pressure * p_max * slope * slopes[ratio] / stiffening[0]
    return (
        pruned("rate", (pressure,), (), wear_per_pressure * pressure),
        pruned("slope", (pressure, u, load), (*sloped, *names, stiffening), change),
    )


def field_names(variant: Variant) -> tuple[str, ...]:
    """Return the fields of a variant, by name, in order."""
    presence = {
        "u_a": variant.pin.wears,
        "sigma_a": variant.pin.rough,
        "sigma_c": True,
        "sigma": True,
        "h": True,
        "U_c": variant.compliant,
        "p": True,
    }
    return tuple(name for name, present in presence.items() if present)


def fields(relations: Relations) -> Function:
    """Return the function of all fields."""
    variant = relations.variant
    intermediates, value, _ = law(variant)
    assignments = (*to_ratio(relations, deflected=variant.compliant), *intermediates)
    if variant.pin is Pin.ROUGH:
        assignments = ((sigma_a, symbol("sigma_a0")), *assignments)
    values: dict[str, sp.Expr] = {
        "u_a": relations.pin_wear(),
        "sigma_a": sigma_a,
        "sigma_c": sigma_c if variant.pin.rough else sigma,
        "sigma": sigma,
        "h": h,
        "U_c": compliance * pressure,
        "p": pressure if variant.compliant else p_max * value,
    }
    arguments = (pressure, u, load) if variant.compliant else (u, load)
    results = (values[name] for name in field_names(variant))
    return pruned("fields", arguments, assignments, *results)


def constants(relations: Relations) -> tuple[Assignment, ...]:
    """Return the initial value and growth of a linear margin; no constants for another.

    One roughness is added last: where 3 sigma and h are close, both steps are exact.
    """
    if relations.variant.pin.rough:
        return ()
    values = dict(to_ratio(relations, deflected=False))
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
        pruned("margin", (u, load), assignments, value),
        pruned("margin_slope", (u,), assignments, slope),
        pruned("margin_terms", (u, load), assignments, sp.Add(*map(sp.Abs, terms))),
    )


def limited() -> tuple[Function, ...]:
    """Return the pressure on a compliant support that relaxes no further than h = 3 sigma, and
    the slope of the rate while h stays there."""
    held = sp.Min(pressure, sp.Max(0, value_of_margin / compliance))
    change = wear_per_pressure * slope_of_margin / compliance
    return (
        pruned("limited_pressure", (pressure, value_of_margin, compliance), (), held),
        pruned("limited_slope", (slope_of_margin, compliance, wear_per_pressure), (), change),
    )


def _margin(relations: Relations) -> tuple[tuple[Assignment, ...], sp.Expr, sp.Expr]:
    """Return the assignments of the margin, its value and its derivative with respect to u."""
    if not relations.variant.pin.rough:
        return (), fresh_margin + margin_gain * u + load, margin_gain
    cutoff = relations.variant.law.cutoff
    assignments, slopes = with_slopes(to_ratio(relations, deflected=False)[:-1])
    return assignments, cutoff * sigma - h, cutoff * slopes.get(sigma, 0) - slopes[h]
