"""The derived relations of a variant, in the symbols of its program.

Overview
    The judgements of `derive.note` are about functions of time.  Here they become assignments of
    numbers, with named constants for the combinations that do not change during a run.
Key results
    groups        the named constants of a run
    roughnesses   the assignments of the roughnesses
    closure       that of the closure
    pin_wear      the wear of the pin
"""

from __future__ import annotations

from functools import cache

import sympy as sp

from ..hypotheses import RIGID
from ..kernel import Judgement
from ..note.condensed import condensed
from ..note.governing import Pin
from ..rules.algebra import Solve, substitute
from ..rules.assumption import assume, defined
from ..symbols import QUANTITIES, symbols
from ..variant import Variant
from . import symbols as named
from .function import Assignment

kappa, K_a, K_c, H_a, H_c, k, p, p_max, f_a = symbols("kappa K_a K_c H_a H_c k p p_max f_a")


@cache
def groups(variant: Variant) -> tuple[Assignment, ...]:
    """Return the named constants of a run: each a combination of parameters."""
    model = variant.model
    archard = substitute(model.wear_laws[2], model.slip).claim.rhs / p
    constants: list[Assignment] = []
    if variant.pin.wears:
        constants += [(kappa, _kappa().claim.rhs), (named.gain, 1 + named.pin_wear_sign * kappa)]
    if variant.pin is Pin.WORN_ROUGH:
        constants.append((named.slope_a, f_a * kappa))
    if variant.compliant:
        constants += [(named.compliance, 1 / k), (named.wear_per_pressure, archard)]
    else:
        constants.append((named.largest_rate, archard * p_max))
    return tuple(constants)


def roughnesses(variant: Variant) -> tuple[Assignment, ...]:
    """Return the assignments of sigma_a, sigma_c (where there are two) and sigma."""
    model, pin = variant.model, variant.pin
    bearing = _plain(model.roughness_of_bearing.claim.rhs)
    if not pin.rough:
        return ((named.sigma, bearing),)
    rough, combined = model.roughness_of_pin, _plain(model.roughness.claim.rhs)
    if not pin.wears:
        combined = combined.subs(named.sigma_a, _plain(rough.claim.rhs))
        return (named.sigma_c, bearing), (named.sigma, combined)
    of_pin = _hoisted(_plain(substitute(rough, _wear_of_pin(variant)).claim.rhs), variant)
    return (named.sigma_a, of_pin), (named.sigma_c, bearing), (named.sigma, combined)


def closure(variant: Variant, deflected: bool) -> Assignment:
    """Return the assignment of h; the undeflected one is that of a rigid support.

    It is linear in the sign of pin wear, and determined by the closures for both signs.
    """
    signs = []
    for opening in (True, False):
        model = condensed(variant.law, opening, variant.pin)
        deflection = model.deflection if deflected else assume(RIGID)
        closed = substitute(model.closure, _wear_of_pin(variant), deflection)
        signs.append(_plain(closed.claim.rhs))
    opening, closing = signs
    either = (opening + closing) / 2 + named.pin_wear_sign * (opening - closing) / 2
    return named.h, _hoisted(either, variant).subs(1 / k, named.compliance)


def pin_wear(variant: Variant) -> sp.Expr:
    """Return u_a in terms of the wear of the bearing."""
    return _plain(_wear_of_pin(variant).claim.rhs)


def _wear_of_pin(variant: Variant) -> Judgement:
    worn = variant.model.wear_of_pin
    return substitute(worn, Solve(K_a)(_kappa())) if variant.pin.wears else worn


@cache
def _kappa() -> Judgement:
    """Return the wear of the pin per wear of the bearing."""
    return defined(kappa, K_a * H_c / (K_c * H_a))


def _plain(expr: sp.Expr) -> sp.Expr:
    """Replace functions of time by the symbols of the program."""
    names = {"u_c": named.u, "U_a": named.load, "p": named.pressure}
    fields = [f for f in expr.atoms(sp.Function) if f.func.__name__ in QUANTITIES]
    return expr.xreplace(
        {f: names.get(f.func.__name__, named.number(f.func.__name__)) for f in fields}
    )


def _hoisted(expr: sp.Expr, variant: Variant) -> sp.Expr:
    """Write the coefficients of a polynomial in the state as named constants."""
    collected = sp.collect(sp.expand(expr), named.u)
    for name, value in groups(variant):
        if name is not kappa:
            collected = collected.subs(value, name)
    return collected
