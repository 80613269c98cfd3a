"""The functions of the contact condition, h <= 3 sigma.

Key results
    margin     3 sigma - h with an undeflected support
    limited    the pressure of a compliant support, which lets go no further than to h = 3 sigma
"""

from __future__ import annotations

import sympy as sp

from .function import Assignment, Function
from .relations import Relations
from .slopes import with_slopes
from .symbols import compliance, h, load, pressure, sigma, u, wear_per_pressure


def margin(relations: Relations) -> tuple[Function, ...]:
    """Return the margin and its slope."""
    cutoff = relations.variant.law.cutoff
    assignments, slope = _margin_slope(relations)
    return (
        Function.made(
            "margin",
            (u, load),
            _undeflected(relations),
            (cutoff * sigma - h,),
            "3 sigma - h with an undeflected support, in mm: contact where it is not negative",
        ),
        Function.made(
            "margin_slope",
            (u,),
            assignments,
            (slope,),
            "derivative of the margin with respect to u_c; with respect to U_a it is 1",
        ),
    )


def limited(relations: Relations) -> tuple[Function, ...]:
    """Return the pressure with cutoff, and the slope of the rate where h stays at 3 sigma."""
    cutoff = relations.variant.law.cutoff
    assignments, slope = _margin_slope(relations)
    return (
        Function.made(
            "limited",
            (pressure, u, load),
            _undeflected(relations),
            (sp.Min(pressure, sp.Max(0, (cutoff * sigma - h) / compliance)),),
            "contact pressure with cutoff, from the root of the residual, in MPa",
        ),
        Function.made(
            "limited_slope",
            (u,),
            assignments,
            (wear_per_pressure * slope / compliance,),
            "derivative of the wear rate with respect to u_c while h stays at 3 sigma, in 1/s",
        ),
    )


def _undeflected(relations: Relations) -> tuple[Assignment, ...]:
    return (*relations.roughnesses(), relations.closure(deflected=False))


def _margin_slope(relations: Relations) -> tuple[tuple[Assignment, ...], sp.Expr]:
    """Return the derivative of the margin with respect to u, and what it is made of."""
    assignments, slopes = with_slopes(_undeflected(relations))
    return assignments, relations.variant.law.cutoff * slopes.get(sigma, 0) - slopes[h]
