"""The reaction force of the pin, generated from equation (7b)."""

from __future__ import annotations

import sympy as sp

from ..note.governing import Model
from ..rules.algebra import solve
from ..symbols import symbol
from .formulas import Formula, formula_module

pressure = sp.Symbol("p", real=True)
"""The contact pressure as a number."""


def module() -> str:
    """Return the source of the generated module."""
    force = solve(Model().reaction, symbol("R_a")).claim.rhs
    value = force.subs(symbol("p"), pressure)
    formula = Formula("reaction", (pressure,), value, "reaction force of the pin, in N")
    return formula_module("Reaction of the pin.", ("7b",), (formula,))
