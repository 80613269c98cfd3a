"""Generated functions: a short list of named assignments, and results in terms of them.

Key results
    Assignment  a name and its value
    Function    arguments, assignments, results
    pruned      a function without the assignments that its results do not need
    with_slopes assignments, each followed by that of its derivative with respect to the wear
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import sympy as sp

from .symbols import number, u

Assignment = tuple[sp.Symbol, sp.Expr]


@dataclass(frozen=True)
class Function:
    """A generated function: ``results`` in terms of arguments, constants and ``assignments``."""

    name: str
    arguments: tuple[sp.Symbol, ...]
    assignments: tuple[Assignment, ...]
    results: tuple[sp.Expr, ...]

    @property
    def expressions(self) -> tuple[sp.Expr, ...]:
        """Return the expressions that one call evaluates, in order."""
        return (*(value for _, value in self.assignments), *self.results)

    @property
    def free_symbols(self) -> set[sp.Symbol]:
        """Return the symbols that are neither arguments nor assigned."""
        used = set().union(*(expr.free_symbols for expr in self.expressions))
        return used - {name for name, _ in self.assignments} - set(self.arguments)

    @property
    def operations(self) -> int:
        """Return the number of operations of one call, functions counted as one."""
        return sum(int(expr.count_ops()) for expr in self.expressions)


def pruned(
    name: str,
    arguments: tuple[sp.Symbol, ...],
    assignments: Sequence[Assignment],
    *results: sp.Expr,
) -> Function:
    """Return a function without the assignments that its results do not need."""
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
    """Return assignments, each followed by that of its derivative with respect to u, and slopes.

    The slopes are those of the assigned names, by name; zero ones are left out.
    """
    result: list[Assignment] = []
    slopes: dict[sp.Symbol, sp.Expr] = {}
    for name, expr in assignments:
        result.append((name, expr))
        inner = (sp.diff(expr, symbol) * slope for symbol, slope in slopes.items())
        slope = reusing(sp.Add(sp.diff(expr, u), *inner), name, expr)
        if slope == 0:
            continue
        slopes[name] = slope if slope.is_Atom else number(f"{name}_u")
        if not slope.is_Atom:
            result.append((slopes[name], slope))
    return tuple(result), slopes


def reusing(slope: sp.Expr, name: sp.Symbol, expr: sp.Expr) -> sp.Expr:
    """Write the slope of a root or a quotient in terms of the name of its value."""
    root = expr.is_Pow and expr.exp == sp.Rational(1, 2)
    quotient = expr.is_Mul and not expr.as_numer_denom()[1].is_number
    return sp.factor_terms(slope.subs(expr, name) if root or quotient else slope)
