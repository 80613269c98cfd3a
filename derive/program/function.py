"""Generated functions: a short list of named assignments, and results in terms of them.

Key results
    Assignment  a name and what it stands for
    Function    arguments, assignments, results
    made        a function with no more assignments than it needs
    with_slopes assignments, each followed by that of its derivative with respect to the wear
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import sympy as sp

from .symbols import number, u

Assignment = tuple[sp.Symbol, sp.Expr]

MEANINGS = {
    "rate": "wear rate of the bearing, du_c/dt, in mm/s",
    "slope": "derivative of the wear rate with respect to u_c, in 1/s",
    "rate_and_slope": "wear rate in mm/s and its derivative with respect to u_c in 1/s",
    "residual": "what the contact pressure p must make zero, in MPa",
    "undeflected": "closure over roughness with an undeflected support",
    "softness": "roughnesses that the support gives way per pressure, in 1/MPa",
    "start": "estimate of the pressure with the support, in MPa",
    "lower": "a pressure below that with the support, in MPa",
    "upper": "a pressure above that with the support, in MPa",
    "newton": "the pressure after a step of Newton's iteration from p, in MPa",
    "fields": "every field at given wear and load, in mm and MPa",
    "margin": "3 sigma - h with an undeflected support, in mm: contact where it is not negative",
    "margin_slope": "derivative of the margin with respect to u_c; with respect to U_a it is 1",
    "margin_terms": "sum of the absolute terms of the margin, in mm: known to as many roundoffs",
    "limited_pressure": "contact pressure in MPa: root of the residual, or what keeps h at 3 sigma",
    "limited_slope": "derivative of the wear rate with respect to u_c with h at 3 sigma, in 1/s",
    "rate_gradient": "derivatives of the wear rate with respect to U_a and to the constants",
    "margin_gradient": "derivatives of the margin with respect to the constants; to U_a it is 1",
    "parameter_gradient": "derivatives with respect to the parameters, from those to the constants",
    "contact_pressure": "contact pressure in MPa at closure and roughness in mm, and its slope",
}
"""What a function returns, by its name."""


@dataclass(frozen=True)
class Function:
    """A generated function: ``results`` in terms of arguments, constants and ``assignments``."""

    name: str
    arguments: tuple[sp.Symbol, ...]
    assignments: tuple[Assignment, ...]
    results: tuple[sp.Expr, ...]

    @property
    def meaning(self) -> str:
        """Return what it returns, in words."""
        return MEANINGS[self.name]

    @property
    def expressions(self) -> tuple[sp.Expr, ...]:
        """Return all that one call computes, in order."""
        return (*(value for _, value in self.assignments), *self.results)

    @property
    def free_symbols(self) -> set[sp.Symbol]:
        """Return what the function uses without computing it or taking it as an argument."""
        used = set().union(*(expr.free_symbols for expr in self.expressions))
        return used - {name for name, _ in self.assignments} - set(self.arguments)

    @property
    def operations(self) -> int:
        """Return how many arithmetic operations one call costs, functions counted as one."""
        return sum(int(expr.count_ops()) for expr in self.expressions)


def made(
    name: str,
    arguments: tuple[sp.Symbol, ...],
    assignments: Sequence[Assignment],
    *results: sp.Expr,
) -> Function:
    """Return a function, without the assignments that its results do not need."""
    needed = set().union(*(result.free_symbols for result in results))
    kept: list[Assignment] = []
    for symbol, value in reversed(assignments):
        if symbol in needed:
            kept.append((symbol, value))
            needed |= value.free_symbols
    return Function(name, arguments, tuple(reversed(kept)), results)


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
