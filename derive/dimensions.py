"""Dimensions: both sides of every equation must have the same, term by term.

Key results
    dimension          the exponents of (mm, s, MPa) of an expression, or DimensionError
    dimension_fault    the reason why a relation is not homogeneous, or None
"""

from __future__ import annotations

import re
from fractions import Fraction
from functools import cache

import sympy as sp
from sympy.core.function import AppliedUndef

from .claims import FirstZero, Term, landau_o
from .symbols import QUANTITIES

Dimension = tuple[Fraction, Fraction, Fraction]
"""Exponents of mm, s and MPa."""

NONE: Dimension = (Fraction(0), Fraction(0), Fraction(0))
_BASE = ("mm", "s", "MPa")
_COUNTED = {"rpm": "1/s"}  # a count of turns has no dimension, and a minute is a time


class DimensionError(ValueError):
    """Two terms of a sum differ in dimension, or a function's argument has one."""


@cache
def parse_unit(unit: str) -> Dimension:
    """Read a unit such as ``MPa/mm`` or ``MPa mm^2``.

    >>> parse_unit("MPa/mm")
    (Fraction(-1, 1), Fraction(0, 1), Fraction(1, 1))
    >>> parse_unit("rpm") == parse_unit("1/s")
    True
    """
    unit = _COUNTED.get(unit, unit)
    exponents = dict.fromkeys(_BASE, Fraction(0))
    for sign, factor in zip((1, -1), unit.split("/"), strict=False):
        for base, power in re.findall(r"([A-Za-z]+)(?:\^(\d+))?", factor):
            exponents[base] += sign * Fraction(power or 1)
    return exponents["mm"], exponents["s"], exponents["MPa"]


def dimension(expr: sp.Expr) -> Dimension | None:
    """Return the dimension of an expression; None for zero and infinity, which fit any.

    Raises DimensionError where terms do not fit.
    """
    if expr == 0 or expr.is_infinite or isinstance(expr, (FirstZero, landau_o)):
        return None
    if isinstance(expr, sp.Symbol):
        return parse_unit(QUANTITIES[expr.name].unit) if expr.name in QUANTITIES else NONE
    if isinstance(expr, AppliedUndef) and expr.func.__name__ in QUANTITIES:
        quantity = QUANTITIES[expr.func.__name__]
        if dimension(expr.args[0]) not in (None, parse_unit(QUANTITIES[quantity.clock].unit)):
            raise DimensionError(f"{expr}: its argument is no time")
        return parse_unit(quantity.unit)
    if isinstance(expr, Term):
        _, law, roughness, _, growth = expr.args
        dimension(law.xreplace({roughness: growth}))  # must be homogeneous; the period is 1
        return _combine(NONE, dimension(growth), Fraction(expr.power))
    if isinstance(expr, sp.Derivative):
        result = dimension(expr.expr)
        for variable, count in expr.variable_count:
            result = _combine(result, dimension(variable), Fraction(-count))
        return result
    if isinstance(expr, sp.Integral):
        result = dimension(expr.function)
        for variable in expr.variables:
            result = _combine(result, dimension(variable), Fraction(1))
        return result
    if isinstance(expr, sp.Mul):
        result = NONE
        for factor in expr.args:
            result = _combine(result, dimension(factor), Fraction(1))
        return result
    if isinstance(expr, sp.Pow) and expr.exp.is_Rational:
        return _combine(NONE, dimension(expr.base), Fraction(expr.exp.p, expr.exp.q))
    if isinstance(expr, sp.Piecewise):
        for _, condition in expr.args:
            _check_condition(condition)
        return _common([value for value, _ in expr.args])
    if isinstance(expr, (sp.Add, sp.Max, sp.Min)):
        return _common(expr.args)
    if isinstance(expr, (sp.Limit, sp.Subs, sp.Abs)):
        return dimension(expr.args[0])
    for argument in expr.args:  # tanh, exp, a power with a symbol in the exponent, ...
        if dimension(argument) not in (None, NONE):
            raise DimensionError(f"the argument of {expr.func.__name__} in {expr} has a dimension")
    return NONE


def _combine(left: Dimension | None, right: Dimension | None, power: Fraction) -> Dimension:
    pairs = zip(left or NONE, right or NONE, strict=True)
    mm, s, mpa = (a + power * b for a, b in pairs)
    return mm, s, mpa


def _common(terms: tuple[sp.Expr, ...] | list[sp.Expr]) -> Dimension | None:
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
