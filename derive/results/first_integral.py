"""First integral: what pressure, roughness and load keep constant while the bearing wears.

Overview
    Wear opens the gap and roughens the bearing in proportion, so closure and roughness stay on
    a straight line: h + U_a - U_c - sigma/f_c does not change.  With the note's contact law the
    closure is a logarithm of the pressure, and the line becomes a relation between pressure,
    roughness and load that holds at every instant of every history, periodic or not, on a
    rigid or a compliant support.
Key results
    FirstIntegral.line       any contact law
    FirstIntegral.log_odds   ln(p/(p_max - p)) = 8 - 4 h/sigma, for (4)
    FirstIntegral.compliant  the relation for (4), with the deflection p/k
    FirstIntegral.rigid      its limit for k -> oo
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import sympy as sp

from ..conditions import Condition
from ..equations import Equation
from ..laws import GENERAL, TANH, ContactLaw
from ..note.condensed import bearing_only
from ..note.governing import Model
from ..rules.authored import Inserted, LogOdds
from ..statement import Statement, given, inherited
from ..symbols import symbols
from ..typeset.display import as_written

h, h_0, U_a, U_c, u_c, sigma = symbols("h h_0 U_a U_c u_c sigma")
p, p_max, k, f_c, sigma_c0 = symbols("p p_max k f_c sigma_c0")

SLOPED = Condition("the roughness changes with wear", sp.Ne(f_c, 0))
UNSATURATED = Condition("the pressure is below its largest value", sp.Lt(p, p_max))

RIGID = given(sp.Eq(U_c, 0), "rigid support, k -> oo in (7c)", U_c)


@dataclass(frozen=True)
class FirstIntegral:
    """The first integral of one worn solid, for one contact law."""

    law: ContactLaw = TANH

    @property
    def model(self) -> Model:
        """Bearing wear only."""
        return bearing_only(self.law).model

    @cached_property
    def line(self) -> Statement:
        """Closure and roughness lie on a line that the load shifts."""
        model = self.model
        parents = (model.closure, model.roughness_at_wear, model.wear_of_pin)
        claim = sp.Eq(h + U_a - U_c - sigma / f_c, h_0 - sigma_c0 / f_c)
        conditions = (*inherited(parents), SLOPED)
        return Statement(claim, Inserted(), parents, conditions, name="line of closure")

    @cached_property
    def log_odds(self) -> Statement:
        """Eq. (4) solved for the closure."""
        pressure = self.model.pressure
        claim = sp.Eq(sp.log(p / (p_max - p)), 8 - 4 * h / sigma)
        conditions = (*pressure.conditions, UNSATURATED)
        return Statement(claim, LogOdds(), (pressure,), conditions, name="log-odds of pressure")

    @cached_property
    def compliant(self) -> Statement:
        """What stays constant, with a support of stiffness k."""
        deflection = bearing_only(self.law).deflection
        return self._from(deflection, p / k).named("first integral, compliant support")

    @cached_property
    def rigid(self) -> Statement:
        """What stays constant, on a rigid support."""
        return self._from(RIGID, sp.S.Zero).named("first integral")

    def _from(self, deflection: Statement, depth: sp.Expr) -> Statement:
        parents = (self.log_odds, self.line.solve_for(h), deflection)
        bracket = sp.log(p / (p_max - p)) - (8 - 4 / f_c)
        claim = sp.Eq(sigma * bracket + 4 * depth - 4 * U_a, 4 * (sigma_c0 / f_c - h_0))
        return Statement(claim, Inserted(), parents, inherited(parents))


def equations() -> tuple[Equation, ...]:
    """Return the first integrals."""
    general, tanh = FirstIntegral(GENERAL), FirstIntegral(TANH)
    with as_written():
        bracket = sp.log(p / (p_max - p)) - (8 - 4 / f_c)
        value = 4 * (sigma_c0 / f_c - h_0)
        rigid = (sp.Eq(sp.Add(sigma * bracket, -(4 * U_a)), value),)
        compliant = (sp.Eq(sp.Add(sigma * bracket, 4 * p / k, -(4 * U_a)), value),)
        line = (sp.Eq(sp.Add(h, U_a, -U_c, -(sigma / f_c)), h_0 - sigma_c0 / f_c),)
    section = "first integral"
    return (
        Equation("closure-line", section, "first integral, any law", (general.line,), (), line),
        Equation("first-integral", section, "first integral", (tanh.rigid,), (), rigid),
        Equation(
            "first-integral-compliant",
            section,
            "first integral, compliant support",
            (tanh.compliant,),
            (),
            compliant,
        ),
    )
