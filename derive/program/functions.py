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
from .relations import closure, pin_wear, roughnesses
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


def to_ratio(variant: Variant, deflected: bool) -> tuple[Assignment, ...]:
    """Return the assignments of the roughnesses, the closure and their ratio."""
    return (*roughnesses(variant), closure(variant, deflected), (ratio, h / sigma))


def rigid(variant: Variant) -> tuple[Function, Function]:
    """Return the rate of wear and its slope."""
    names, value, slope = law(variant)
    sloped, slopes = with_slopes(to_ratio(variant, deflected=False))
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


def compliant(variant: Variant) -> tuple[Function, Function]:
    """Return the rate of wear at a pressure, and its slope at the root."""
    names, _, slope = law(variant)
    sloped, slopes = with_slopes(to_ratio(variant, deflected=True))
    stiffening = number("residual_p"), 1 - p_max * slope * compliance / sigma
    change = wear_per_pressure * p_max * slope * slopes[ratio] / stiffening[0]
    return (
        pruned("rate", (pressure,), (), wear_per_pressure * pressure),
        pruned("slope", (pressure, u, load), (*sloped, *names, stiffening), change),
    )


def fields(variant: Variant) -> tuple[tuple[str, ...], Function]:
    """Return the names of the fields that a variant has, and the function of them all."""
    pin = variant.pin
    intermediates, value, _ = law(variant)
    assignments = (*to_ratio(variant, deflected=variant.compliant), *intermediates)
    if pin is Pin.ROUGH:
        assignments = ((sigma_a, symbol("sigma_a0")), *assignments)
    possible = (
        ("u_a", pin_wear(variant), pin.wears),
        ("sigma_a", sigma_a, pin.rough),
        ("sigma_c", sigma_c if pin.rough else sigma, True),
        ("sigma", sigma, True),
        ("h", h, True),
        ("U_c", compliance * pressure, variant.compliant),
        ("p", pressure if variant.compliant else p_max * value, True),
    )
    names, results = zip(*((name, form) for name, form, has in possible if has), strict=True)
    arguments = (pressure, u, load) if variant.compliant else (u, load)
    return names, pruned("fields", arguments, assignments, *results)


def margin(variant: Variant) -> tuple[tuple[Assignment, ...], tuple[Function, ...]]:
    """Return the margin, its slope and the sum of its absolute terms, after their constants.

    The constants are the initial value and the growth of a linear margin.  One roughness is added
    last: where 3 sigma and h are close, both steps are exact.
    """
    cutoff, chain = variant.law.cutoff, to_ratio(variant, deflected=False)[:-1]
    constants: tuple[Assignment, ...] = ()
    assignments, slopes = with_slopes(chain)
    value, slope = cutoff * sigma - h, cutoff * slopes.get(sigma, 0) - slopes[h]
    if not variant.pin.rough:
        values, fresh = dict(chain), {u: 0, load: 0}
        most = (cutoff - 1) * values[sigma] - values[h]
        constants = (
            (most_of_margin, most.subs(fresh)),
            (fresh_margin, most_of_margin + values[sigma].subs(fresh)),
            (most_of_gain, sp.diff(most, u)),
            (margin_gain, most_of_gain + sp.diff(values[sigma], u)),
        )
        assignments, value, slope = (), fresh_margin + margin_gain * u + load, margin_gain
    terms = sp.Add.make_args(sp.expand(value.subs([chain[-1]])))
    return constants, (
        pruned("margin", (u, load), assignments, value),
        pruned("margin_slope", (u,), assignments, slope),
        pruned("margin_terms", (u, load), assignments, sp.Add(*map(sp.Abs, terms))),
    )


def limited() -> tuple[Function, Function]:
    """Return the pressure on a compliant support that relaxes no further than h = 3 sigma, and
    the slope of the rate while h stays there."""
    held = sp.Min(pressure, sp.Max(0, value_of_margin / compliance))
    change = wear_per_pressure * slope_of_margin / compliance
    return (
        pruned("limited_pressure", (pressure, value_of_margin, compliance), (), held),
        pruned("limited_slope", (slope_of_margin, compliance, wear_per_pressure), (), change),
    )
