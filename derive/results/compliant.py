"""Compliant support: the long-time results for a finite stiffness k.

Overview
    The deflection p/k of the support is bounded by p_max/k, so it shifts the closure by a
    bounded amount and changes neither the limit of h/sigma nor steady wear: (18), (21) and (22)
    hold for every k.  What depends on k is the way to the limit, and with it the wear itself:
    the coefficient A of ln t is lowered by the deflection p_inf/k of the steady state.
Key results
    CompliantSteadyState    the limits of SteadyState, for a finite k
    drift_coefficient       A, any contact law; the rigid support is k -> oo
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import sympy as sp

from ..conditions import Condition
from ..equations import Equation
from ..laws import GENERAL, TANH, ContactLaw, r
from ..note.condensed import bearing_only
from ..rules.authored import Identity, Inserted, Positive
from ..rules.bounds import Consequence, Monotone
from ..rules.limits import Passes, forever
from ..statement import Statement, given, inherited
from ..symbols import rate, symbols
from ..typeset.display import as_written
from .expansion_rules import LogarithmicCoefficient
from .steady_state import BOUNDED_LOAD, ROUGHENING, SIGNS, SteadyState, made, roughness, step

h_0, U_a, U_c, u_c, p, U, sigma_c0, f_c = symbols("h_0 U_a U_c u_c p U sigma_c0 f_c")
p_max, k, K_c, H_c, V, A, U_mean, p_inf = symbols("p_max k K_c H_c V A U_mean p_inf")

closure = h_0 + u_c + U_c - U_a
excess = sigma_c0 / f_c - h_0 + U_a - U_c
_BOUND = sigma_c0 / f_c + h_0 + U + p_max / k
_part = sp.Symbol("part", positive=True)
_SIGNS = (*SIGNS, (U_c, p_max / k * _part / (1 + _part)))
DEFLECTED = Condition(
    "the support carries a pressure below p_max", sp.And(sp.Gt(U_c, 0), sp.Lt(U_c, p_max / k))
)
_CONDITIONS = (ROUGHENING, BOUNDED_LOAD, DEFLECTED)


@dataclass(frozen=True)
class CompliantSteadyState(SteadyState):
    """The long-time limit of (9) for one contact law and a finite stiffness."""

    @cached_property
    def pressure_at_wear(self) -> Statement:
        """The pressure in terms of wear, load and deflection."""
        model = self.model
        parents = (model.pressure, model.closure, model.wear_of_pin, model.roughness_at_wear)
        claim = sp.Eq(p, p_max * self.law.ratio(closure / roughness))
        return Statement(claim, Inserted(p), parents, name="pressure at wear and deflection")

    @cached_property
    def rate_at_wear(self) -> Statement:
        """The wear rate in terms of wear, load and deflection."""
        parents = (self.model.wear_laws[2], self.pressure_at_wear)
        claim = sp.Eq(rate("u_c"), K_c * V / (3 * H_c) * self.pressure_at_wear.claim.rhs)
        return Statement(claim, Inserted(rate("u_c")), parents, name="wear rate")

    @cached_property
    def deviation(self) -> Statement:
        """h/sigma differs from 1/f_c by a bounded quantity over sigma, exactly."""
        claim = sp.Eq(closure / roughness, 1 / f_c - excess / roughness)
        return Statement(claim, Identity(), conditions=(ROUGHENING,), name="exact deviation")

    @cached_property
    def highest_ratio(self) -> Statement:
        """h/sigma stays below a bound that holds for all time."""
        claim = sp.Le(closure / roughness, 1 / f_c + _BOUND / sigma_c0)
        return Statement(claim, Positive(_SIGNS), (), _CONDITIONS, name="highest closure ratio")

    @cached_property
    def lowest_rate(self) -> Statement:
        """The wear rate never falls below a positive constant."""
        y = sp.Dummy("r", real=True)
        wear_rate = sp.Lambda(y, K_c * V * p_max * self.law.ratio(y) / (3 * H_c))
        bound = made(Monotone(wear_rate), self.highest_ratio)
        claim = sp.Le(bound.claim.lts, rate("u_c"))
        return step(claim, Consequence(), bound, self.rate_at_wear, name="lowest wear rate")

    @cached_property
    def squeeze(self) -> Statement:
        """The deviation of h/sigma is at most a constant over the roughness."""
        deviation = excess / roughness
        upper = sp.Le(deviation, _BOUND / roughness)
        claim = sp.And(upper, sp.Ge(deviation, -_BOUND / roughness))
        return Statement(claim, Positive(_SIGNS), (), _CONDITIONS, name="bound of the deviation")

    @cached_property
    def ratio(self) -> Statement:
        """h/sigma tends to 1/f_c, whatever the law and the stiffness."""
        claim = sp.Eq(forever(closure / roughness), 1 / f_c)
        return step(claim, Passes(), self.deviation, self.vanishing, name="limit of h/sigma")

    @cached_property
    def pressure(self) -> Statement:
        """The pressure tends to p_max phi(1/f_c), whatever the stiffness."""
        claim = sp.Eq(forever(p), p_max * self.law.ratio(1 / f_c))
        return step(claim, Passes(), self.pressure_at_wear, self.ratio, name="steady pressure")


def drift_coefficient(law: ContactLaw) -> Statement:
    """Return A of ``u_c(N T) = u_cum N + A ln N + O(1)`` for any periodic load."""
    steady = given(sp.Eq(p_inf, p_max * law.ratio(1 / f_c)), "definition", p_inf)
    condensed = bearing_only(law).pressure_of_bearing_wear
    decline = -sp.diff(law.phi, r).subs(r, 1 / f_c) / law.ratio(1 / f_c)
    claim = sp.Eq(A, decline * (sigma_c0 / f_c - h_0 + U_mean - p_inf / k) / f_c)
    parents = (condensed, steady)
    repeats = Condition(
        "the load repeats with period T", typeset=r"\text{the load repeats with period}\; T"
    )
    conditions = (*inherited(parents), ROUGHENING, repeats)
    return Statement(claim, LogarithmicCoefficient(), parents, conditions, name="drift")


def equations() -> tuple[Equation, ...]:
    """Return the results for a compliant support."""
    general, tanh = CompliantSteadyState(GENERAL), CompliantSteadyState(TANH)
    section = "compliant support"
    slope = sp.diff(GENERAL.phi, r).subs(r, 1 / f_c)
    with as_written():
        steepness = 2 * (1 - sp.tanh(4 - 2 / f_c)) / f_c
        shifted = sp.Add(sigma_c0 / f_c, -h_0, U_mean, -(p_inf / k))
        display = (sp.Eq(A, steepness * shifted),)
        any_law = (sp.Eq(A, -(slope / (f_c * GENERAL.ratio(1 / f_c))) * shifted),)
    return (
        Equation("compliant-pressure", section, "asymptotic pressure", (general.pressure,)),
        Equation(
            "compliant-wear-per-cycle", section, "asymptotic wear per cycle", (tanh.wear_per_cycle,)
        ),
        Equation(
            "log-drift-any-law",
            section,
            "coefficient of ln t, any law",
            (drift_coefficient(GENERAL),),
            display=any_law,
        ),
        Equation(
            "log-drift-compliant",
            section,
            "coefficient of ln t",
            (drift_coefficient(TANH),),
            display=display,
        ),
    )
