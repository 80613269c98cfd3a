"""All fields at given wear and load, for results and figures."""

from __future__ import annotations

import sympy as sp

from ..note.governing import Pin
from ..symbols import symbol
from ..variant import Variant
from .function import Function, made
from .rate import law, p_max, to_ratio
from .relations import Relations
from .symbols import compliance, h, load, pressure, sigma, sigma_a, sigma_c, u


def names(variant: Variant) -> tuple[str, ...]:
    """Return the fields of a variant, by name, in order."""
    own = {
        "u_a": variant.pin.wears,
        "sigma_a": variant.pin.rough,
        "sigma_c": True,
        "sigma": True,
        "h": True,
        "U_c": variant.compliant,
        "p": True,
    }
    return tuple(name for name, present in own.items() if present)


def fields(relations: Relations) -> Function:
    """Return the function that gives every field."""
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
    return made("fields", arguments, assignments, *(values[name] for name in names(variant)))
