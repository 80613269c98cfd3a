"""Laws for a finite element code: contact pressure, and growth of the state in a time increment.

Overview
    A finite element code computes the contact pressure itself; from the model it needs Archard's
    law and the change of roughness, (5).  Their rates do not depend on the state, so that rate
    times increment is exact while pressure and slip rate are constant.
Key results
    Increment    parameters, and the growth of each state variable
    increment    the increment of a variant
    contact      the contact pressure and its derivative at a closure
"""

from __future__ import annotations

from typing import NamedTuple

import sympy as sp

from ..program.function import Assignment, Function, pruned
from ..program.functions import law, p_max
from ..program.symbols import h, ratio, sigma
from ..symbols import rate, symbols
from ..variant import Variant

pressure, slip_rate, time_increment = sp.symbols(
    "pressure slip_rate time_increment", nonnegative=True
)
"""The inputs from the finite element code, in MPa, mm/s and s."""

_p, _V, _u_a, _u_c, _sigma_a, _sigma_c = symbols("p V u_a u_c sigma_a sigma_c")


class Increment(NamedTuple):
    """The parameters of an increment, and pairs of a state variable and its growth, in order."""

    parameters: tuple[sp.Symbol, ...]
    growth: tuple[Assignment, ...]


def increment(variant: Variant) -> Increment:
    """Return the growth of a variant's state in a time increment, from (5).

    >>> from derive.variant import VARIANTS
    >>> for name, value in increment(VARIANTS[0]).growth:
    ...     print(name, value)
    u_c K_c*pressure*slip_rate*time_increment/(3*H_c)
    sigma_c f_c*growth_u_c
    """
    u_a_rate, sigma_a_rate, u_c_rate, sigma_c_rate = variant.model.wear_laws
    laws = [(_u_c, u_c_rate), (_sigma_c, sigma_c_rate)]
    if variant.pin.wears:
        laws.append((_u_a, u_a_rate))
        laws += [(_sigma_a, sigma_a_rate)] * variant.pin.rough
    known = {_p: pressure, _V: slip_rate}
    wear = {rate(name): sp.Symbol(f"growth_{name}", real=True) for name in ("u_c", "u_a")}
    growth = []
    for field, statement in laws:
        name = field.func.__name__
        value = statement.claim.rhs
        grown = value.xreplace(wear) if name.startswith("sigma") else value * time_increment
        growth.append((sp.Symbol(name, real=True), grown.xreplace(known)))
    used = set().union(*(value.free_symbols for _, value in growth))
    data = symbols("K_c H_c f_c K_a H_a f_a")
    return Increment(tuple(symbol for symbol in data if symbol in used), tuple(growth))


def contact(variant: Variant) -> Function:
    """Return the contact law of a variant, (4), with its derivative.

    >>> from derive.variant import VARIANTS
    >>> contact(VARIANTS[0]).results
    (p_max*share, -4*p_max*spread/sigma)
    """
    names, value, slope = law(variant)
    assignments, results = ((ratio, h / sigma), *names), (p_max * value, p_max * slope / sigma)
    return pruned("contact_pressure", (h, sigma, p_max), assignments, *results)
