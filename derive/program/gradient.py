"""Derivatives with respect to load, constants and parameters, by reverse accumulation.

Overview
    The wear rate depends on the load and on the named constants of a run through h/sigma; the
    constants depend on the physical parameters through ``bind``.  The chain rule is applied from
    the result back to the data, so that all derivatives together cost little more than one.
Key results
    rate_gradient        of the rate, with respect to the load and to each constant
    margin_gradient      of the margin of contact, with respect to each constant
    parameter_gradient   with respect to each parameter, from the derivatives by the constants
References
    Reverse accumulation: Griewank and Walther, Evaluating Derivatives (2008), chapter 3.
"""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from ..variant import Variant
from .function import Assignment, Function, pruned, reusing
from .functions import law, p_max, to_ratio
from .symbols import compliance, largest_rate, load, number, pressure, ratio, sigma, u
from .symbols import wear_per_pressure as per_pressure

Adjoints = dict[sp.Symbol, sp.Expr]


def by_constant(name: str) -> sp.Symbol:
    """Return the symbol of a derivative with respect to a constant of the run."""
    return number(f"by_{name}")


def rate_gradient(variant: Variant, constants: Sequence[sp.Symbol]) -> Function:
    """Return the derivatives of the rate with respect to the load and to each constant."""
    names, value, slope = law(variant)
    chain = to_ratio(variant, deflected=variant.compliant)
    if variant.compliant:  # the pressure solves p = p_max phi(ratio), in which ratio depends on p
        stiffening = number("residual_p"), 1 - p_max * slope * compliance / sigma
        names = (*names, stiffening)
        seed = per_pressure * p_max * slope / stiffening[0]
        adjoints: Adjoints = {per_pressure: pressure, p_max: per_pressure * value / stiffening[0]}
    else:
        seed, adjoints = largest_rate * slope, {largest_rate: value}
    adjoints[ratio] = seed
    sweep = _reverse_sweep(chain, adjoints, "rate_{}")
    slopes = (adjoints.get(name, sp.Integer(0)) for name in (load, *constants))
    arguments = (pressure, u, load) if variant.compliant else (u, load)
    return pruned("rate_gradient", arguments, (*chain, *names, *sweep), *slopes)


def margin_gradient(margin: Function, constants: Sequence[sp.Symbol]) -> Function:
    """Return the derivatives of the margin with respect to each constant."""
    value = number("margin")
    adjoints: Adjoints = {value: sp.Integer(1)}
    chain = (*margin.assignments, (value, margin.results[0]))
    sweep = _reverse_sweep(chain, adjoints, "margin_{}")
    slopes = (adjoints.get(name, sp.Integer(0)) for name in constants)
    return pruned("margin_gradient", margin.arguments, (*margin.assignments, *sweep), *slopes)


def parameter_gradient(
    constants: Sequence[Assignment], parameters: Sequence[sp.Symbol]
) -> Function:
    """Return the derivatives with respect to the parameters, from those by the constants."""
    adjoints: Adjoints = {name: by_constant(name.name) for name, _ in constants}
    computed = [(name, value) for name, value in constants if name != value]
    sweep = _reverse_sweep(computed, adjoints, "total_{}")
    slopes = (adjoints[name] for name in parameters)
    return pruned("parameter_gradient", (), (*computed, *sweep), *slopes)


def _reverse_sweep(
    chain: Sequence[Assignment], adjoints: Adjoints, form: str
) -> tuple[Assignment, ...]:
    """Replace derivatives by assigned names with those by the symbols of their expressions.

    ``adjoints`` are the derivatives of the result by name, updated in place; returned are
    assignments of intermediate ones, with names of this form.
    """
    intermediates: list[Assignment] = []
    for name, expr in reversed(chain):
        if name not in adjoints:
            continue
        adjoint = adjoints.pop(name)
        if not adjoint.is_Atom:
            symbol = number(form.format(name.name))
            intermediates.append((symbol, sp.factor_terms(adjoint)))
            adjoint = symbol
        for inner in sorted(expr.free_symbols, key=str):
            part = adjoint * _partial(expr, inner, name)
            adjoints[inner] = adjoints.get(inner, sp.Integer(0)) + part
    return tuple(intermediates)


def _partial(expr: sp.Expr, inner: sp.Symbol, name: sp.Symbol) -> sp.Expr:
    """Return d expr/d inner, that of a power of a positive symbol as a multiple of name/inner."""
    slope = sp.diff(expr, inner)
    power = sp.cancel(slope * inner / expr)
    if inner.is_positive and power.is_number:
        return power * name / inner
    return reusing(slope, name, expr)
