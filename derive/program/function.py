"""Generated functions: a short list of named assignments, and results in terms of them.

Key results
    Assignment  a name and what it stands for
    Function    arguments, assignments, results
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import sympy as sp

from ..stable import released

Assignment = tuple[sp.Symbol, sp.Expr]


@dataclass(frozen=True)
class Function:
    """A generated function: ``results`` in terms of arguments, constants and ``assignments``."""

    name: str
    arguments: tuple[sp.Symbol, ...]
    assignments: tuple[Assignment, ...]
    results: tuple[sp.Expr, ...]
    meaning: str

    @staticmethod
    def made(
        name: str,
        arguments: tuple[sp.Symbol, ...],
        assignments: Sequence[Assignment],
        results: tuple[sp.Expr, ...],
        meaning: str,
    ) -> Function:
        """Make a function, leaving out the assignments that its results do not need."""
        needed = set().union(*(result.free_symbols for result in results))
        kept: list[Assignment] = []
        for symbol, value in reversed(assignments):
            if symbol in needed:
                kept.append((symbol, value))
                needed |= value.free_symbols
        return Function(name, arguments, tuple(reversed(kept)), results, meaning)

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

    def composed(self) -> tuple[sp.Expr, ...]:
        """Return the results with every assignment inserted, exponents not held: the exact form."""
        results = self.results
        for name, value in reversed(self.assignments):
            results = tuple(result.xreplace({name: released(value)}) for result in results)
        return results
