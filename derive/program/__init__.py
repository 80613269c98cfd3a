"""Programs: what a variant computes, as short lists of named assignments.

Overview
    The derived relations of a variant (closure, roughness, pressure at given wear) become
    functions of numbers.  Intermediates keep the names of the field.  What does not change
    during a run is hoisted into named constants.
Key results
    Program     the functions and constants of one variant
    program     the program of a variant
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import sympy as sp

from ..symbols import QUANTITIES
from ..variant import Variant
from . import cutoff, fields, rate, root
from .function import Assignment, Function
from .relations import Relations, groups


@dataclass(frozen=True)
class Program:
    """All that is generated for one variant.

    ``constants`` are computed once, by ``bind``, from ``parameters``; ``fields`` names the
    results of the last function.
    """

    variant: Variant
    parameters: tuple[sp.Symbol, ...]
    constants: tuple[Assignment, ...]
    functions: tuple[Function, ...]
    fields: tuple[str, ...]

    @property
    def exact_constants(self) -> dict[sp.Symbol, sp.Expr]:
        """Return every constant in terms of the parameters alone."""
        values: dict[sp.Symbol, sp.Expr] = {}
        for name, expr in self.constants:
            values[name] = expr.xreplace(values)
        return values


@cache
def program(variant: Variant) -> Program:
    """Return the program of a variant."""
    functions = _functions(variant)
    hoisted = _hoisted(variant)
    constants = _constants(hoisted, functions)
    used = set().union(*(expr.free_symbols for _, expr in constants))
    parameters = sorted(used - {name for name, _ in hoisted}, key=_order)
    return Program(variant, tuple(parameters), constants, functions, fields.names(variant))


def _hoisted(variant: Variant) -> tuple[Assignment, ...]:
    """Return all that may be computed once, by ``bind``."""
    limits = cutoff.constants(Relations(variant)) if variant.cutoff else ()
    return (*groups(variant), *limits)


def _functions(variant: Variant) -> tuple[Function, ...]:
    """Return the functions of a variant, that of the fields last."""
    relations = Relations(variant)
    if variant.compliant:
        found = (*root.root(relations), *rate.compliant(relations))
    else:
        found = rate.rigid(relations)
    if variant.cutoff:
        found += cutoff.margin(relations)
    if variant.cutoff and variant.compliant:
        found += cutoff.limited(relations)
    return (*found, fields.fields(relations))


def _constants(
    hoisted: Sequence[Assignment], functions: Sequence[Function]
) -> tuple[Assignment, ...]:
    """Return the constants that the functions use: parameters as they are, then hoisted ones."""
    used = set().union(*(function.free_symbols for function in functions))
    named = {name for name, _ in hoisted}
    needed = used & named
    for name, value in reversed(hoisted):
        if name in needed:
            needed |= value.free_symbols & named
    plain = sorted(used - named, key=_order)
    kept = ((name, value) for name, value in hoisted if name in needed)
    return (*((name, name) for name in plain), *kept)


def _order(parameter: sp.Symbol) -> int:
    return list(QUANTITIES).index(parameter.name)
