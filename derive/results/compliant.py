"""Compliant support: the long-time results for a finite stiffness k.

Overview
    The deflection p/k of the support is bounded by p_max/k, so it shifts the closure by a
    bounded amount and changes neither the limit of h/sigma nor steady wear: (18), (21) and (22)
    hold for every k.  The approach to the limit depends on k, and so does the wear itself:
    the deflection p_inf/k of the steady state lowers the coefficient A of ln t.
Key results
    CompliantSteadyState    the limits of SteadyState, for a finite k
    drift_coefficient       A, any contact law; the rigid support is k -> oo
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import sympy as sp

from ..hypotheses import UNSATURATED
from ..kernel import Judgement, RuleError
from ..laws import GENERAL, TANH, ContactLaw, r
from ..rules.algebra import Insert, substitute
from ..rules.assumption import assume, defined
from ..rules.drift import first_order
from ..rules.growth import AtInfinity, Diverges
from ..rules.inequalities import Arithmetic
from ..rules.limits import Passes, forever
from ..symbols import rate, symbols
from .steady_state import SteadyState, drift, named_limit, roughness

h_0, U_a, U_c, u_c, p, U, sigma_c0, f_c = symbols("h_0 U_a U_c u_c p U sigma_c0 f_c")
p_max, k, K_c, H_c, V, A, U_mean, p_inf = symbols("p_max k K_c H_c V A U_mean p_inf")

closure = h_0 + u_c + U_c - U_a
excess = sigma_c0 / f_c - h_0 + U_a - U_c


@dataclass(frozen=True)
class CompliantSteadyState(SteadyState):
    """The long-time limit of (9) for one contact law and a finite stiffness."""

    closure: ClassVar[sp.Expr] = closure
    excess: ClassVar[sp.Expr] = excess
    bound: ClassVar[sp.Expr] = sigma_c0 / f_c + h_0 + U + p_max / k

    @cached_property
    def pressure_at_wear(self) -> Judgement:
        """The pressure in terms of wear, load and deflection."""
        model = self.model
        parents = (model.pressure, model.closure, model.wear_of_pin, model.roughness_at_wear)
        claim = sp.Eq(p, p_max * self.law.ratio(closure / roughness))
        facts = (self.roughening, self.worn)
        return Insert(claim)(*parents, *facts, name="pressure at wear and deflection")

    @cached_property
    def rate_at_wear(self) -> Judgement:
        """The wear rate in terms of wear, load and deflection."""
        parents = (self.model.wear_laws[2], self.pressure_at_wear)
        claim = sp.Eq(rate("u_c"), K_c * V / (3 * H_c) * self.pressure_at_wear.claim.rhs)
        return Insert(claim)(*parents, name="wear rate")

    @cached_property
    def support(self) -> Judgement:
        """The deflection lies between 0 and p_max/k: by the law, or the premise p < p_max."""
        claim = sp.And(sp.Gt(U_c, 0), sp.Lt(U_c, p_max / k))
        deflection = self.model.deflection
        try:
            return Arithmetic(claim)(deflection, self.model.pressure)
        except RuleError:
            return Arithmetic(claim)(deflection, assume(UNSATURATED))

    @cached_property
    def pressure(self) -> Judgement:
        """The pressure tends to p_max phi(1/f_c) for every stiffness."""
        claim = sp.Eq(forever(p), p_max * self.law.ratio(1 / f_c))
        return Passes(claim)(self.pressure_at_wear, self.ratio, name="steady pressure")

    @cached_property
    def drift(self) -> Judgement:
        """The coefficient of ln t, in terms of the deflection under the steady pressure."""
        wear = Diverges(u_c)(self.growth, self.roughening)
        claim = sp.Eq(forever(u_c * (closure / roughness - 1 / f_c) + excess / f_c), 0)
        deviation = AtInfinity(claim, 1 / u_c)(wear, *self.facts)
        near = first_order(self.rate_at_wear, deviation, self.ratio, self.rate, self.support)
        limit = Passes(sp.Eq(forever(U_c), p_inf / k))(self.model.deflection, self.steady)
        at_rest = near.claim.expr.subs(U_c, p_inf / k)
        return drift(Passes(sp.Eq(forever(at_rest), 0))(near, limit))

    @cached_property
    def steady(self) -> Judgement:
        """p tends to p_inf, by the definition of that name."""
        named = named_limit(p_inf, self.pressure, "asymptotic pressure")
        return substitute(self.pressure, Insert(sp.Eq(self.pressure.claim.value, p_inf))(named))


def drift_coefficient(law: ContactLaw) -> Judgement:
    """Return A of ``u_c(N T) = u_cum N + A ln N + O(1)`` for any periodic load."""
    steady = CompliantSteadyState(law)
    decline = -sp.diff(law.phi, r).subs(r, 1 / f_c) / law.ratio(1 / f_c)
    claim = sp.Eq(A, decline * (sigma_c0 / f_c - h_0 + U_mean - p_inf / k) / f_c)
    definition = defined(A, steady.drift.claim.term, steady.drift)
    return Insert(claim)(definition, steady.drift, name="drift")


compliant_pressure = CompliantSteadyState(GENERAL).pressure
compliant_wear_per_cycle = CompliantSteadyState().wear_per_cycle
log_drift_any_law = drift_coefficient(GENERAL)
log_drift_compliant = drift_coefficient(TANH)
