"""Dimensions: both sides of every equation must have the same, term by term.

Key results
    dimension          that of an expression as a product of powers of units, or DimensionError
    dimension_fault    the reason why a relation is not homogeneous, or None
"""

from __future__ import annotations

from collections.abc import Iterable

import sympy as sp
from sympy.core.function import AppliedUndef

from .claims import FirstZero, Term, landau_o
from .memory import cache
from .symbols import QUANTITIES
from .written import evaluated, read

BASE = mm, s, MPa = sp.symbols("mm s MPa", positive=True)
_ANY = (sp.S.Zero, sp.oo, -sp.oo)
_UNITS = {"mm": mm, "s": s, "MPa": MPa, "rpm": 1 / s}  # a count of turns has no dimension


class DimensionError(ValueError):
    """Two terms of a sum differ in dimension, or a function's argument has one."""


@cache
def parse_unit(unit: str) -> sp.Expr:
    """Read a unit such as ``MPa/mm`` or ``MPa mm^2``.

    >>> parse_unit("MPa mm^2"), parse_unit("rpm")
    (MPa*mm**2, 1/s)
    """
    return evaluated(read(unit, _UNITS))


def dimension(expr: sp.Expr) -> sp.Expr | None:
    """Return the dimension of an expression; None for zero and infinity, which fit any.

    Raises DimensionError where terms do not fit.
    """
    if expr in _ANY or isinstance(expr, (FirstZero, landau_o)):
        return None
    if isinstance(expr, sp.Symbol):
        return parse_unit(QUANTITIES[expr.name].unit) if expr.name in QUANTITIES else sp.S.One
    if isinstance(expr, AppliedUndef) and expr.func.__name__ in QUANTITIES:
        quantity = QUANTITIES[expr.func.__name__]
        if dimension(expr.args[0]) not in (None, parse_unit(QUANTITIES[quantity.clock].unit)):
            raise DimensionError(f"{expr}: its argument is no time")
        return parse_unit(quantity.unit)
    if isinstance(expr, Term):
        _, law, roughness, _, growth = expr.args
        dimension(law.xreplace({roughness: growth}))  # must be homogeneous; the period is 1
        return _product([growth]) ** expr.power
    if isinstance(expr, sp.Derivative):
        return _product([expr.expr]) / _product(expr.variables)
    if isinstance(expr, sp.Integral):
        return _product([expr.function, *expr.variables])
    if isinstance(expr, sp.Mul):
        return _product(expr.args)
    if isinstance(expr, sp.Pow) and expr.exp.is_Rational:
        return _product([expr.base]) ** expr.exp
    if isinstance(expr, sp.Piecewise):
        for _, condition in expr.args:
            _check_condition(condition)
        return _common([value for value, _ in expr.args])
    if isinstance(expr, (sp.Add, sp.Max, sp.Min)):
        return _common(expr.args)
    if isinstance(expr, (sp.Limit, sp.Subs, sp.Abs)):
        return dimension(expr.args[0])
    for argument in expr.args:  # tanh, exp, a power with a symbol in the exponent, ...
        if dimension(argument) not in (None, 1):
            raise DimensionError(f"the argument of {expr.func.__name__} in {expr} has a dimension")
    return sp.S.One


def _product(factors: Iterable[sp.Expr]) -> sp.Expr:
    return sp.Mul(*(dimension(factor) or 1 for factor in factors))


def _common(terms: Iterable[sp.Expr]) -> sp.Expr | None:
    distinct = {d for d in map(dimension, terms) if d is not None}
    if len(distinct) > 1:
        raise DimensionError(f"terms of different dimension: {', '.join(map(str, terms))}")
    return distinct.pop() if distinct else None


def _check_condition(condition: sp.Basic) -> None:
    for relation in condition.atoms(sp.core.relational.Relational):
        _common([relation.lhs, relation.rhs])


def dimension_fault(claim: sp.Basic) -> str | None:
    """Return why a relation in ``claim`` is not dimensionally homogeneous, None if all are."""
    try:
        _check_condition(claim)
    except DimensionError as fault:
        return str(fault)
    return None
