"""Slopes by the chain rule from one assignment to the next, so that they share intermediates.

Key results
    with_slopes    assignments, each followed by that of its derivative with respect to the wear
"""

from __future__ import annotations

from collections.abc import Iterable

import sympy as sp

from .function import Assignment
from .symbols import number, u


def with_slopes(
    assignments: Iterable[Assignment],
) -> tuple[tuple[Assignment, ...], dict[sp.Symbol, sp.Expr]]:
    """Follow each assignment by that of its derivative with respect to u, where it has one.

    The slopes by name of what they are the slope of are returned too; zero ones are left out.
    """
    made: list[Assignment] = []
    slopes: dict[sp.Symbol, sp.Expr] = {}
    for name, expr in assignments:
        made.append((name, expr))
        slope = reusing(_total(expr, slopes), name, expr)
        if slope == 0:
            continue
        slopes[name] = slope if slope.is_Atom else number(f"{name}_u")
        if not slope.is_Atom:
            made.append((slopes[name], slope))
    return tuple(made), slopes


def _total(expr: sp.Expr, slopes: dict[sp.Symbol, sp.Expr]) -> sp.Expr:
    """Return d expr/du by the chain rule, given the slopes of intermediates."""
    inner = (sp.diff(expr, name) * slope for name, slope in slopes.items())
    return sp.Add(sp.diff(expr, u), *inner)


def reusing(slope: sp.Expr, name: sp.Symbol, expr: sp.Expr) -> sp.Expr:
    """Write the slope of a root or a quotient with the name that this has already."""
    root = expr.is_Pow and expr.exp == sp.Rational(1, 2)
    quotient = expr.is_Mul and not expr.as_numer_denom()[1].is_number
    return sp.factor_terms(slope.subs(expr, name) if root or quotient else slope)
