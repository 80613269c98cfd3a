"""Derivatives with respect to everything that a run depends on, from the result back to the data.

Overview
    The wear rate depends on the load and on the named constants of a run through h/sigma; the
    constants depend on the physical parameters through ``bind``.  Both chains are run from their
    end to their start, so that all derivatives together cost little more than one.
Key results
    rate_gradient        of the rate, with respect to the load and to each constant
    margin_gradient      of the margin of contact, with respect to each constant
    parameter_gradient   with respect to each parameter, from those with respect to the constants
References
    Reverse accumulation: Griewank and Walther, Evaluating Derivatives (2008), chapter 3.
"""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from .function import Assignment, Function, made, reusing
from .functions import law, p_max, to_ratio
from .relations import Relations
from .symbols import compliance, largest_rate, load, number, pressure, ratio, sigma, u
from .symbols import wear_per_pressure as per_pressure

Totals = dict[sp.Symbol, sp.Expr]


def by_constant(name: str) -> sp.Symbol:
    """Return the symbol of a derivative with respect to a constant of the run."""
    return number(f"by_{name}")


def rate_gradient(relations: Relations, constants: Sequence[sp.Symbol]) -> Function:
    """Return the derivatives of the rate with respect to the load and to each constant."""
    compliant = relations.variant.compliant
    names, value, slope = law(relations.variant)
    chain = to_ratio(relations, deflected=compliant)
    if compliant:  # the pressure solves p = p_max phi(ratio), in which ratio depends on p
        stiffening = number("residual_p"), 1 - p_max * slope * compliance / sigma
        names = (*names, stiffening)
        seed = per_pressure * p_max * slope / stiffening[0]
        totals: Totals = {per_pressure: pressure, p_max: per_pressure * value / stiffening[0]}
    else:
        seed, totals = largest_rate * slope, {largest_rate: value}
    totals[ratio] = seed
    back = _back(chain, totals, "rate_{}")
    found = (totals.get(name, sp.Integer(0)) for name in (load, *constants))
    arguments = (pressure, u, load) if compliant else (u, load)
    return made("rate_gradient", arguments, (*chain, *names, *back), *found)


def margin_gradient(margin: Function, constants: Sequence[sp.Symbol]) -> Function:
    """Return the derivatives of the margin with respect to each constant."""
    whole = number("margin")
    totals: Totals = {whole: sp.Integer(1)}
    back = _back((*margin.assignments, (whole, margin.results[0])), totals, "margin_{}")
    found = (totals.get(name, sp.Integer(0)) for name in constants)
    return made("margin_gradient", margin.arguments, (*margin.assignments, *back), *found)


def parameter_gradient(
    constants: Sequence[Assignment], parameters: Sequence[sp.Symbol]
) -> Function:
    """Return the derivatives with respect to the parameters from those to the constants."""
    totals: Totals = {name: by_constant(name.name) for name, _ in constants}
    computed = [(name, value) for name, value in constants if name != value]
    back = _back(computed, totals, "total_{}")
    found = (totals[name] for name in parameters)
    return made("parameter_gradient", (), (*computed, *back), *found)


def _back(chain: Sequence[Assignment], totals: Totals, named: str) -> tuple[Assignment, ...]:
    """Take derivatives with respect to assigned names back to what these are made of.

    ``totals`` holds the derivatives by name and is brought to those of the beginning; returned are
    the derivatives in between that deserve a name.
    """
    between: list[Assignment] = []
    for name, expr in reversed(chain):
        if name not in totals:
            continue
        total = totals.pop(name)
        if not total.is_Atom:
            symbol = number(named.format(name.name))
            between.append((symbol, sp.factor_terms(total)))
            total = symbol
        for inner in sorted(expr.free_symbols, key=str):
            part = total * _partial(expr, inner, name)
            totals[inner] = totals.get(inner, sp.Integer(0)) + part
    return tuple(between)


def _partial(expr: sp.Expr, inner: sp.Symbol, name: sp.Symbol) -> sp.Expr:
    """Return d expr/d inner, of a power of a positive number as a quotient of what is known."""
    slope = sp.diff(expr, inner)
    power = sp.cancel(slope * inner / expr)
    if inner.is_positive and power.is_number:
        return power * name / inner
    return reusing(slope, name, expr)
