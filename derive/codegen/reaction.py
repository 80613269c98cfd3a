"""The forces of the pin: its reaction, the pressure under a given one, and the work of friction.

Overview
    Reaction and pressure are those of equation (7b).  Friction is Coulomb's: the shear stress is
    mu times the pressure, and it acts along the sliding distance of the pin.
"""

from __future__ import annotations

import sympy as sp

from ..note.governing import NoteModel
from ..note.problems import problem_i
from ..rules.algebra import Solve
from ..symbols import symbol, symbols
from .formulas import Formula, formula_module

pressure, given = sp.symbols("p R_a", real=True)
"""The contact pressure and the reaction as numbers."""

mu, distance = sp.symbols("mu distance", nonnegative=True)
"""The coefficient of friction and the sliding distance of the pin."""


def formulas() -> tuple[Formula, ...]:
    """Return the formulas of the forces of the pin."""
    force = Solve(symbol("R_a"))(NoteModel().reaction).claim.rhs.subs(symbol("p"), pressure)
    carried = problem_i[0].claim.rhs.subs(symbol("R_a"), given)
    width, length = symbols("b L")
    per_cycle = NoteModel().slip.claim.rhs * symbol("T")
    of_pressure = "derivative of the pressure with respect to"
    return (
        Formula("reaction", (pressure,), force, "reaction force of the pin, in N"),
        Formula("pressure", (given,), carried, "contact pressure under a given reaction, in MPa"),
        Formula("by_force", (), sp.diff(carried, given), f"{of_pressure} the reaction"),
        Formula("by_width", (given,), sp.diff(carried, width), f"{of_pressure} the width"),
        Formula("by_length", (given,), sp.diff(carried, length), f"{of_pressure} the length"),
        Formula("sliding_distance", (), per_cycle, "sliding distance of a cycle, in mm"),
        Formula(
            "friction_work",
            (pressure, distance, mu),
            mu * pressure * distance,
            "work of friction per area under a mean pressure, in mJ/mm^2",
        ),
    )


def module() -> str:
    """Return the source of the generated module."""
    return formula_module("Forces of the pin.", ("7b", "problem-i"), formulas())
