"""Static solution on a compliant support: wear and time as functions of the pressure.

Overview
    On a compliant support the pressure is an implicit function of the wear, but the wear is an
    explicit function of the pressure: the first integral, solved for the roughness.  Time then
    follows by integrating du/(du/dt) along the pressure, by parts.  For f_c != 0 one integral
    remains, of a smooth function; for f_c = 0 everything is elementary.
Key results
    StaticCompliant.wear          u_c(p), f_c != 0
    StaticCompliant.time          t(p)
    StaticCompliant.wear_smooth   u_c(p), f_c = 0
    StaticCompliant.time_smooth   t(p)
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import sympy as sp

from ..conditions import Condition
from ..equations import Equation
from ..note.condensed import bearing_only
from ..note.governing import Model
from ..rules.authored import Inserted
from ..rules.solutions import ParametricSolution
from ..statement import Statement, inherited
from ..symbols import initial, symbols, t
from ..typeset.display import as_written, over
from .first_integral import FirstIntegral
from .static_solution import CONSTANT_LOAD, half_rate, load_offset, written_offset

h, h_0, U_a, u_c, sigma, sigma_c0, f_c = symbols("h h_0 U_a u_c sigma sigma_c0 f_c")
p, p_max, k, C, beta, p_s = symbols("p p_max k C beta p_s")
p_start = initial("p")

log_odds = sp.log(p / (p_max - p))
UNSATURATED_START = Condition(
    "the first pressure solves u_c = 0", typeset=r"\text{the first pressure solves}\; u_c = 0"
)


@dataclass(frozen=True)
class StaticCompliant:
    """Wear under a constant load, for the law of the note and a support of stiffness k."""

    @property
    def model(self) -> Model:
        """Bearing wear only."""
        return bearing_only().model

    @cached_property
    def wear(self) -> Statement:
        """The wear at a pressure."""
        roughness = FirstIntegral().compliant.solve_for(sigma)
        parents = (self.model.roughness_at_wear.solve_for(u_c), roughness, load_offset)
        claim = sp.Eq(u_c, _worn(p))
        return Statement(claim, Inserted(), parents, inherited(parents), name="wear at a pressure")

    @cached_property
    def time(self) -> Statement:
        """The time at a pressure, counted from the first pressure p(0)."""
        return self._time(self.wear, _by_parts())

    @cached_property
    def wear_smooth(self) -> Statement:
        """The wear at a pressure, for f_c = 0."""
        model = self.model
        smooth = model.roughness_at_wear.specialise({f_c: 0}, "the roughness does not change")
        closed = FirstIntegral().log_odds.solve_for(h)
        deflection = bearing_only().deflection
        opened = model.closure.substitute(model.wear_of_pin).solve_for(u_c)
        parents = (opened, closed, deflection, smooth)
        claim = sp.Eq(u_c, _worn_smooth())
        return Statement(claim, Inserted(), parents, inherited(parents), name="wear, f_c = 0")

    @cached_property
    def time_smooth(self) -> Statement:
        """The time at a pressure, for f_c = 0."""
        return self._time(self.wear_smooth, _elementary())

    def _time(self, wear: Statement, travelled: sp.Expr) -> Statement:
        parents = (self.model.wear_laws[2], wear, half_rate, load_offset)
        conditions = (*inherited(parents), CONSTANT_LOAD, UNSATURATED_START)
        claim = sp.Eq(t, travelled / (2 * C))
        return Statement(claim, ParametricSolution(), parents, conditions, name="time")


def _worn(at: sp.Expr) -> sp.Expr:
    """Return the wear at a pressure, for f_c != 0."""
    drop = 2 * sp.Add(beta, -(2 * at / k))
    roughness = drop / sp.Add(sp.log(at / (p_max - at)), -8, 4 / f_c)
    return sp.Add(roughness, -sigma_c0) / f_c


def _by_parts() -> sp.Expr:
    """Return the integral of (p_max/p) du from p(0), where u = 0, to p."""
    inside = p_max * _worn(p_s) / p_s**2
    with sp.evaluate(True):  # else SymPy writes an orientation, 1, into the integrand
        integral = sp.Integral(inside, (p_s, p_start, p))
    return sp.Add(p_max / p * _worn(p), integral)


def _worn_smooth() -> sp.Expr:
    """Return the wear at a pressure, for f_c = 0."""
    return sp.Add(U_a, -h_0, -(p / k), sigma_c0 / 4 * (8 - log_odds))


def _elementary() -> sp.Expr:
    """Return the integral of (p_max/p) du from p(0), where u = 0, to p, for f_c = 0."""
    odds, odds_start = (p_max - p) / p, (p_max - p_start) / p_start
    return sp.Add(
        sigma_c0 / 4 * sp.Add(odds, -odds_start, sp.log(odds), -sp.log(odds_start)),
        -(p_max / k * sp.log(p / p_start)),
    )


def equations() -> tuple[Equation, ...]:
    """Return the static solutions on a compliant support."""
    static = StaticCompliant()
    section = "static load"
    size, primitive = sp.Function("S"), sp.Function("Q")
    with as_written():
        odds = sp.Add(sp.log(p_s / (p_max - p_s)), -8, 4 / f_c)
        roughness = sp.Eq(size(p_s), 2 * sp.Add(beta, -(2 * p_s / k)) / odds)
        worn, growth = sp.Add(size(p), -sigma_c0), sp.Add(size(p_s), -sigma_c0)
        inside = p_max * growth / (f_c * p_s**2)
        with sp.evaluate(True):
            integral = sp.Integral(inside, (p_s, p_start, p))
        by_parts = sp.Add((p_max * worn) / (f_c * p), integral)
        rough = (sp.Eq(u_c, over(f_c) * worn), sp.Eq(t, over(2 * C) * by_parts))
        ratio = (p_max - p_s) / p_s
        depth = sigma_c0 / 4 * sp.Add(ratio, sp.log(ratio))
        elementary = sp.Eq(primitive(p_s), sp.Add(depth, -(p_max / k * sp.log(p_s / p_max))))
        change = sp.Add(primitive(p), -primitive(p_start))
        smooth = (sp.Eq(u_c, _worn_smooth()), sp.Eq(t, over(2 * C) * change))
    return (
        Equation(
            "static-solution-compliant",
            section,
            "wear and time at a pressure",
            (static.wear, static.time, load_offset, half_rate),
            display=(*rough, written_offset, half_rate.claim),
            where=(roughness,),
        ),
        Equation(
            "static-solution-compliant-smooth",
            section,
            "wear and time at a pressure, f_c = 0",
            (static.wear_smooth, static.time_smooth, half_rate),
            display=(*smooth, half_rate.claim),
            where=(elementary,),
        ),
    )
