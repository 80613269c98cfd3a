"""Cutoff: contact only for h <= 3 sigma, as in the text below (4). One worn solid.

Overview
    With the cutoff, contact is a condition on wear and load: the margin 3 sigma - h must not be
    negative.  For one worn solid it is linear in the wear.  For f_c < 1/3 it decreases: wear
    stops at a depth at which even the peak of the load does not make contact, unless the
    roughness vanishes before.  For
    f_c = 1/3 it does not depend on the wear; for f_c > 1/3 contact becomes permanent.
Key results
    contact_condition   contact if and only if (1 - 3 f_c) u_c <= 3 sigma_c0 - h_0 + U_a
    arrest_depth        f_c < 1/3: where the margin vanishes at the peak of the load
    rate_in_contact     its lower bound, the rate at h = 3 sigma
    margin_rate         the time derivative of the margin
    sliding_rate        the rate that keeps h = 3 sigma while the load rises
    one_third           f_c = 1/3: the steady wear per cycle, a fraction d of the full one
    permanent_contact   f_c > 1/3: the wear beyond which contact is permanent
    edge_of_contact     compliant support: the basis of p = min(p_smooth, max(0, k margin))
Remarks
    The pressure jumps at h = 3 sigma, by phi(3) p_max = 1.8 % of p_max for tanh.  On a rigid
    support the jump makes wear arrest in finite time at a smooth peak of the load.  Let r be
    the least ``rate_in_contact`` and e so small that dU_a/dt <= (1 - 3 f_c) r wherever
    U_a >= max U_a - (1 - 3 f_c) e, which is a fraction d of the period.  As long as wear is
    further than e from the arrest depth, its increment per cycle is at least r d T
    (``no_contact``).  Then the margin cannot grow before the peak (``margin_rate``): wear slides
    along h = 3 sigma up to the peak, where it stops, no later than in cycle 2 + u_stop/(r d T).
    On a compliant support the pressure falls to zero with the margin, and wear approaches the
    same depth without reaching it.
"""

from __future__ import annotations

import sympy as sp

from ..equations import stated
from ..hypotheses import (
    BOUNDED_LOAD,
    DIFFERENTIABLE,
    PERIODIC,
    RIGID,
    Hypothesis,
)
from ..laws import TANH
from ..note.condensed import bearing_only
from ..rules.algebra import Consequence, Insert, Solve, substitute
from ..rules.assumption import assume, define, defined
from ..rules.calculus import differentiate
from ..rules.growth import intermittent, periodic_bound
from ..rules.inequalities import Arithmetic, Monotone
from ..symbols import rate, symbols, t
from .regime_map import OUTGROWN, ROUGHER, THIRD, TOUCHING
from .steady_state import closure, named_limit, roughness, wear_rate, worn

h_0, U_a, u_c, u_stop, U_max, U_min = symbols("h_0 U_a u_c u_stop U_max U_min")
sigma_c0, f_c, u_perm, u_cum, d, T = symbols("sigma_c0 f_c u_perm u_cum d T")
p_max, K_c, H_c, V = symbols("p_max K_c H_c V")

room = 3 * roughness - closure
"""The margin: room to the edge of contact; contact where it is not negative."""

outgrown, rougher, third = map(assume, (OUTGROWN, ROUGHER, THIRD))


contact_condition = Arithmetic(*stated("contact-condition"))(name="contact condition")
"""Contact as a condition on the wear."""

margin = Insert(*stated("margin"))(name="margin and wear")
"""The margin is linear in the wear, and for f_c = 1/3 independent of it."""

margin_rate = Insert(*stated("margin-rate"))(assume(DIFFERENTIABLE), name="rate of the margin")
"""The time derivative of the margin: wear lowers it, a rising load raises it."""

touching = assume(TOUCHING)
_at_peak = define(sp.Eq(room.subs({u_c: u_stop, U_a: U_max}), 0), touching, outgrown)
arrest_depth = Insert(sp.Eq(u_stop, (3 * sigma_c0 - h_0 + U_max) / (1 - 3 * f_c)))(
    Solve(u_stop)(_at_peak, outgrown), outgrown, name="arrest depth"
)
"""The wear at which the peak of the load just makes contact."""

no_contact = Insert(*stated("no-contact"))(arrest_depth, name="margin and arrest depth")
"""The margin in terms of the distances from the arrest depth and from the peak of the load."""

_at_lowest = define(sp.Eq(room.subs({u_c: u_perm, U_a: U_min}), 0), rougher)
permanent_contact = Insert(sp.Eq(u_perm, (h_0 - 3 * sigma_c0 - U_min) / (3 * f_c - 1)))(
    Solve(u_perm)(_at_lowest, rougher), rougher, name="permanent contact"
)
"""The wear beyond which contact lasts under all loads from U_min on."""

always_contact = Insert(*stated("always-contact"))(
    permanent_contact, name="margin and permanent contact"
)
"""The margin in terms of the distances from that depth and from the lowest load."""

model = bearing_only()
geometry = (
    substitute(model.closure, model.wear_of_pin, assume(RIGID)),
    model.roughness_at_wear,
)
"""Closure and roughness in terms of wear and load."""

_ratio = sp.Le(closure / roughness, 3)
_bound = Monotone(wear_rate(TANH))(Arithmetic(_ratio)(assume(model.in_contact), *geometry))
rate_in_contact = Consequence(sp.Le(_bound.claim.lesser, rate("u_c")))(
    _bound,
    substitute(model.wear_laws[2], substitute(model.pressure_in_contact, *geometry)),
    name="rate in contact",
)
"""The rate in contact is at least the rate at the edge of contact."""

_kept = assume(Hypothesis(sp.Eq(room, 0)))
sliding_rate = Insert(*stated("sliding-rate"))(
    Solve(rate("u_c"))(differentiate(_kept, assume(DIFFERENTIABLE)), outgrown),
    outgrown,
    name="sliding rate",
)
"""While h = 3 sigma is kept, wear follows the load."""

_inside = sp.Piecewise((1, sp.Ge(3 * sigma_c0 - h_0 + U_a, 0)), (0, True))
_part = sp.Integral(_inside, (t, 0, T)) / T
_law = substitute(model.wear_laws[2], substitute(model.pressure_with_cutoff, *geometry), third)
_limit = intermittent(
    _law,
    defined(d, _part),
    worn(model),
    *map(assume, (PERIODIC, BOUNDED_LOAD)),
)
one_third = Insert(sp.Eq(u_cum, d * K_c * V * T * p_max * TANH.ratio(sp.Integer(3)) / (3 * H_c)))(
    named_limit(u_cum, periodic_bound(_limit), ""), name="wear per cycle for f_c = 1/3"
)
"""For f_c = 1/3: the steady wear per cycle, d the fraction of the period in contact."""

edge_of_contact = Arithmetic(*stated("edge-of-contact"))(name="edge of contact, compliant support")
"""Compliant support: k margin exceeds p exactly where the smooth law is in contact.

``h - p/k`` is the undeflected closure.  Where the smooth solution has h > 3 sigma, the bearing
stays at h = 3 sigma, under the pressure k margin of its springs.
"""
