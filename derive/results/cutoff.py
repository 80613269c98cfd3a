"""Cutoff: contact only for h <= 3 sigma, as the text under (4) says. One worn solid.

Overview
    With the cutoff, contact is a condition on wear and load: the margin 3 sigma - h must not be
    negative.  For one worn solid it is linear in the wear.  Where f_c < 1/3 it falls: wear
    arrests at a depth at which even the peak of the load does not reach contact.  For
    f_c = 1/3 it does not depend on the wear; for f_c > 1/3 contact becomes permanent.
Key results
    contact         contact if and only if (1 - 3 f_c) u_c <= 3 sigma_c0 - h_0 + U_a
    arrest_depth    f_c < 1/3: where the margin vanishes at the peak of the load
    lowest_rate     the rate in contact, never below that at h = 3 sigma
    margin_rate     how the margin changes in time
    sliding         the rate that keeps h = 3 sigma while the load rises
    per_cycle       f_c = 1/3: the steady wear per cycle, a fraction d of the full one
    permanent       f_c > 1/3: the wear beyond which contact is permanent
    at_edge         compliant support: why p = min(p_smooth, max(0, k margin))
Remarks
    The pressure jumps at h = 3 sigma, by phi(3) p_max = 1.8 % of p_max for tanh.  On a rigid
    support the jump makes wear arrest in finite time at a smooth peak of the load.  Let r be
    ``lowest_rate`` and e so small that dU_a/dt <= (1 - 3 f_c) r wherever
    U_a >= max U_a - (1 - 3 f_c) e, which is a fraction d of the period.  As long as wear is
    further than e from the arrest depth, every cycle wears by r d T at least (``no_contact``).
    Then the margin cannot grow before the peak (``margin_rate``): wear slides along h = 3 sigma
    up to the peak, where it arrests.  So it does by cycle 2 + u_stop/(r d T).  On a compliant
    support the pressure falls to zero with the margin, and wear approaches the same depth
    without reaching it.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import sympy as sp

from ..equations import Proved, stated
from ..hypotheses import Hypothesis, Kind
from ..kernel import Judgement
from ..laws import TANH, ContactLaw
from ..note.condensed import bearing_only
from ..note.governing import ROUGH_BEARING, Model
from ..note.stabilised import named_limit
from ..rules.algebra import Alike, Consequence, Identity, Insert, Solve, discharge, substitute
from ..rules.assumption import assume
from ..rules.calculus import RIGID, differentiate
from ..rules.inequalities import Arithmetic, Monotone
from ..rules.limits import intermittent
from ..rules.proving import DIFFERENTIABLE
from ..rules.reading import CONTINUOUS, PERIODIC
from ..symbols import rate, symbols, t
from .steady_state import BOUNDED_LOAD, closure, roughness, wear_rate, worn

h_0, U_a, u_c, u_stop, U_max, U_min = symbols("h_0 U_a u_c u_stop U_max U_min")
sigma_c0, f_c, u_perm, u_cum, d, T = symbols("sigma_c0 f_c u_perm u_cum d T")
p_max, K_c, H_c, V = symbols("p_max K_c H_c V")

SMOOTHING = Hypothesis("the gap outgrows the roughness", sp.Lt(f_c, sp.Rational(1, 3)))
ROUGHER = Hypothesis("the roughness outgrows the gap", sp.Gt(f_c, sp.Rational(1, 3)))
THIRD = Hypothesis("gap and cutoff grow alike", sp.Eq(f_c, sp.Rational(1, 3)))

margin = 3 * roughness - closure
"""Room to the edge of contact; contact where it is not negative."""


@dataclass(frozen=True)
class Cutoff:
    """One worn solid with the cutoff."""

    law: ContactLaw = TANH

    @property
    def model(self) -> Model:
        """Bearing wear only."""
        return bearing_only(self.law).model

    @cached_property
    def contact(self) -> Judgement:
        """Contact as a condition on the wear."""
        (claim,) = stated("contact-condition")
        return Alike(claim)(name="contact condition")

    @cached_property
    def arrest_depth(self) -> Judgement:
        """The wear at which the peak of the load just reaches contact."""
        at_peak = sp.Eq(margin.subs({u_c: u_stop, U_a: U_max}), 0)
        meaning = _defined("no margin at the peak of the load", at_peak)
        smoothing = assume(SMOOTHING)
        claim = sp.Eq(u_stop, (3 * sigma_c0 - h_0 + U_max) / (1 - 3 * f_c))
        return Insert(claim)(Solve(u_stop)(meaning, smoothing), smoothing, name="arrest depth")

    @cached_property
    def no_contact(self) -> Judgement:
        """Beyond the arrest depth the margin is negative at every load."""
        (claim,) = stated("no-contact")
        return Insert(claim)(self.arrest_depth, name="margin and arrest depth")

    @cached_property
    def geometry(self) -> tuple[Judgement, ...]:
        """Closure and roughness in terms of wear and load."""
        model = self.model
        closed = substitute(model.closure, model.wear_of_pin, assume(RIGID))
        return closed, model.roughness_at_wear

    @cached_property
    def lowest_rate(self) -> Judgement:
        """The rate in contact is at least that at the edge of contact."""
        model, (closed, rough) = self.model, self.geometry
        pressure = substitute(model.pressure_in_contact, closed, rough)
        contact_rate = substitute(model.wear_laws[2], pressure)
        ratio = sp.Le(closure / roughness, 3)
        edge = Arithmetic(ratio)(assume(model.in_contact), closed, rough)
        bound = Monotone(wear_rate(self.law))(edge)
        claim = sp.Le(bound.claim.lesser, rate("u_c"))
        return Consequence(claim)(bound, contact_rate, name="rate in contact")

    @cached_property
    def sliding(self) -> Judgement:
        """While h = 3 sigma is kept, wear follows the load."""
        kept = assume(Hypothesis("h = 3 sigma is kept", sp.Eq(margin, 0), kind=Kind.STATE))
        smoothing = assume(SMOOTHING)
        solved = Solve(rate("u_c"))(differentiate(kept, assume(DIFFERENTIABLE)), smoothing)
        (claim,) = stated("sliding-rate")
        return Insert(claim)(solved, smoothing, name="sliding rate")

    @cached_property
    def margin_rate(self) -> Judgement:
        """How the margin changes: wear lowers it, a rising load raises it."""
        (claim,) = stated("margin-rate")
        return Identity(claim)(assume(DIFFERENTIABLE), name="rate of the margin")

    @cached_property
    def in_wear(self) -> Judgement:
        """The margin is linear in the wear, and for f_c = 1/3 independent of it."""
        (claim,) = stated("margin")
        return Identity(claim)(name="margin and wear")

    @cached_property
    def per_cycle(self) -> Judgement:
        """For f_c = 1/3: the steady wear per cycle, d the fraction of the period in contact."""
        model, third = self.model, assume(THIRD)
        pressure = substitute(model.pressure_with_cutoff, *self.geometry)
        law = substitute(model.wear_laws[2], pressure, third)
        law = discharge(law, ROUGH_BEARING, model.roughness_of_bearing, worn(model), third)
        inside = sp.Ge(3 * sigma_c0 - h_0 + U_a, 0)
        share = sp.Integral(sp.Piecewise((1, inside), (0, True)), (t, 0, T)) / T
        part = _defined("fraction of the period in contact", sp.Eq(d, share))
        load = (assume(PERIODIC), assume(CONTINUOUS), assume(BOUNDED_LOAD))
        limit = intermittent(law, part, worn(model), *load)
        claim = sp.Eq(u_cum, d * K_c * V * T * p_max * self.law.ratio(sp.Integer(3)) / (3 * H_c))
        return Insert(claim)(named_limit(u_cum, limit, ""), name="wear per cycle for f_c = 1/3")

    @cached_property
    def permanent(self) -> Judgement:
        """The wear beyond which every load keeps contact."""
        at_lowest = sp.Eq(margin.subs({u_c: u_perm, U_a: U_min}), 0)
        meaning = _defined("no margin at the lowest load", at_lowest)
        rougher = assume(ROUGHER)
        claim = sp.Eq(u_perm, (h_0 - 3 * sigma_c0 - U_min) / (3 * f_c - 1))
        return Insert(claim)(Solve(u_perm)(meaning, rougher), rougher, name="permanent contact")

    @cached_property
    def always_contact(self) -> Judgement:
        """Beyond that depth the margin is positive at every load."""
        (claim,) = stated("always-contact")
        return Insert(claim)(self.permanent, name="margin and permanent contact")

    @cached_property
    def at_edge(self) -> Judgement:
        """Compliant support: k margin exceeds p exactly where the smooth law is in contact.

        ``h - p/k`` is the undeflected closure.  Where the smooth solution has h > 3 sigma, the
        bearing rests at h = 3 sigma, with the pressure k margin that its springs give.
        """
        (claim,) = stated("edge-of-contact")
        return Alike(claim)(name="edge of contact, compliant support")


def _defined(text: str, relation: sp.Basic) -> Judgement:
    return assume(Hypothesis(text, relation, kind=Kind.DEFINITION))


def results() -> dict[str, Proved]:
    """Return what the cutoff brings, for one worn solid."""
    cut = Cutoff()
    return {
        "contact-condition": cut.contact,
        "arrest-depth": cut.arrest_depth,
        "no-contact": cut.no_contact,
        "rate-in-contact": cut.lowest_rate,
        "sliding-rate": cut.sliding,
        "margin-rate": cut.margin_rate,
        "margin": cut.in_wear,
        "one-third": cut.per_cycle,
        "permanent-contact": cut.permanent,
        "always-contact": cut.always_contact,
        "edge-of-contact": cut.at_edge,
    }
