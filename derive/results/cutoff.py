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

from ..check import Check
from ..conditions import Condition
from ..equations import Equation
from ..laws import TANH, ContactLaw
from ..rules import Authored, Given, proof, sampled
from ..rules.authored import Identity, Inserted
from ..rules.bounds import Consequence, Monotone
from ..statement import Statement, given
from ..symbols import rate, symbols, t
from ..typeset.display import as_written, minus, over
from ..zero import is_zero
from .static_solution import ROUGH
from .steady_state import closure, made, roughness, steady_state, step

h_0, U_a, u_c, u_stop, U_max, U_min = symbols("h_0 U_a u_c u_stop U_max U_min")
sigma_c0, f_c, u_perm, u_cum, d, T = symbols("sigma_c0 f_c u_perm u_cum d T")
p, p_max, k, h, sigma, K_c, H_c, V = symbols("p p_max k h sigma K_c H_c V")

SMOOTHING = Condition("the gap outgrows the roughness", sp.Lt(f_c, sp.Rational(1, 3)))
ROUGHER = Condition("the roughness outgrows the gap", sp.Gt(f_c, sp.Rational(1, 3)))
IN_CONTACT = Condition("contact is active", sp.Le(closure, 3 * roughness))

margin = 3 * roughness - closure
"""Room to the edge of contact; contact where it is not negative."""


@dataclass(frozen=True)
class Rearranged(Authored):
    """Two inequalities that say the same: their differences are equal."""

    def check(self, statement: Statement) -> tuple[Check, ...]:
        left, right = statement.claim.args
        equal = is_zero((left.gts - left.lts) - (right.gts - right.lts))
        return proof(equal, "the differences of the sides are equal"), sampled(statement)


@dataclass(frozen=True)
class WhileInContact(Authored):
    """A limit of the rate that holds during a fraction d of every period: u_cum = d T rate."""

    slope: sp.Expr

    def check(self, statement: Statement) -> tuple[Check, ...]:
        (limit,) = statement.parents
        speed = limit.claim.rhs.subs(f_c, self.slope)
        claim = statement.claim
        accumulated = is_zero(claim.rhs - speed * d * T) and claim.lhs == u_cum
        detail = "mean value theorem on the part of the period in contact"
        return (proof(accumulated, detail),)


@dataclass(frozen=True)
class Cutoff:
    """One worn solid with the cutoff."""

    law: ContactLaw = TANH

    @cached_property
    def contact(self) -> Statement:
        """Contact as a condition on the wear."""
        room = 3 * sigma_c0 - h_0 + U_a
        claim = sp.Equivalent(IN_CONTACT.relation, sp.Le((1 - 3 * f_c) * u_c, room))
        return Statement(claim, Rearranged(), name="contact condition")

    @cached_property
    def arrest_depth(self) -> Statement:
        """The wear at which the peak of the load just reaches contact."""
        at_peak = margin.subs({u_c: u_stop, U_a: U_max})
        meaning = given(sp.Eq(at_peak, 0), "no margin at the peak of the load", u_stop)
        claim = sp.Eq(u_stop, (3 * sigma_c0 - h_0 + U_max) / (1 - 3 * f_c))
        solved = meaning.solve_for(u_stop)
        return Statement(claim, Inserted(), (solved,), (SMOOTHING,), name="arrest depth")

    @cached_property
    def no_contact(self) -> Statement:
        """Beyond the arrest depth the margin is negative at every load."""
        claim = sp.Eq(margin, (1 - 3 * f_c) * (u_stop - u_c) - (U_max - U_a))
        return step(claim, Inserted(), self.arrest_depth, name="margin and arrest depth")

    @cached_property
    def lowest_rate(self) -> Statement:
        """The rate in contact is at least that at the edge of contact."""
        conditions = (IN_CONTACT, ROUGH)
        edge = Statement(sp.Le(closure / roughness, 3), Given("contact"), conditions=conditions)
        y = sp.Dummy("r", real=True)
        wear_rate = sp.Lambda(y, K_c * V * p_max * self.law.ratio(y) / (3 * H_c))
        bound = made(Monotone(wear_rate), edge)
        claim = sp.Le(bound.claim.lts, rate("u_c"))
        steady = steady_state(self.law)
        return step(claim, Consequence(), bound, steady.rate_at_wear, name="rate in contact")

    @cached_property
    def sliding(self) -> Statement:
        """While h = 3 sigma is kept, wear follows the load."""
        kept = given(sp.Eq(sp.diff(margin, t), 0), "the margin stays zero", rate("u_c"))
        solved = kept.solve_for(rate("u_c"))
        claim = sp.Eq(rate("u_c"), rate("U_a") / (1 - 3 * f_c))
        return Statement(claim, Inserted(), (solved,), (SMOOTHING,), name="sliding rate")

    @cached_property
    def margin_rate(self) -> Statement:
        """How the margin changes: wear lowers it, a rising load raises it."""
        claim = sp.Eq(sp.diff(margin, t), rate("U_a") - (1 - 3 * f_c) * rate("u_c"))
        return Statement(claim, Identity(), name="rate of the margin")

    @cached_property
    def in_wear(self) -> Statement:
        """The margin is linear in the wear, and for f_c = 1/3 independent of it."""
        claim = sp.Eq(margin, 3 * sigma_c0 - h_0 + U_a + (3 * f_c - 1) * u_c)
        return Statement(claim, Identity(), name="margin and wear")

    @cached_property
    def per_cycle(self) -> Statement:
        """For f_c = 1/3: the steady wear per cycle, d the fraction of the period in contact."""
        claim = sp.Eq(u_cum, d * K_c * V * T * p_max * self.law.ratio(sp.Integer(3)) / (3 * H_c))
        limit = steady_state(self.law).rate
        rule = WhileInContact(sp.Rational(1, 3))
        return Statement(claim, rule, (limit,), name="wear per cycle for f_c = 1/3")

    @cached_property
    def permanent(self) -> Statement:
        """The wear beyond which every load keeps contact."""
        at_lowest = margin.subs({u_c: u_perm, U_a: U_min})
        meaning = given(sp.Eq(at_lowest, 0), "no margin at the lowest load", u_perm)
        claim = sp.Eq(u_perm, (h_0 - 3 * sigma_c0 - U_min) / (3 * f_c - 1))
        solved = meaning.solve_for(u_perm)
        return Statement(claim, Inserted(), (solved,), (ROUGHER,), name="permanent contact")

    @cached_property
    def always_contact(self) -> Statement:
        """Beyond that depth the margin is positive at every load."""
        claim = sp.Eq(margin, (3 * f_c - 1) * (u_c - u_perm) + (U_a - U_min))
        return step(claim, Inserted(), self.permanent, name="margin and permanent contact")

    @cached_property
    def at_edge(self) -> Statement:
        """Compliant support: k margin exceeds p exactly where the smooth law is in contact.

        ``h - p/k`` is the undeflected closure.  Where the smooth solution has h > 3 sigma, the
        bearing rests at h = 3 sigma, with the pressure k margin that its springs give.
        """
        undeflected = h - p / k
        claim = sp.Equivalent(sp.Le(p, k * (3 * sigma - undeflected)), sp.Le(k * h, 3 * k * sigma))
        return Statement(claim, Rearranged(), name="edge of contact, compliant support")


def equations() -> tuple[Equation, ...]:
    """Return what the cutoff brings, for one worn solid."""
    cut = Cutoff()
    section = "cutoff"
    with as_written():
        room = sp.Add(3 * sigma_c0, minus(h_0), U_max)
        depth = (sp.Eq(u_stop, room / sp.Add(1, minus(3 * f_c))),)
        beyond = sp.Add(h_0, minus(3 * sigma_c0), minus(U_min))
        permanent = (sp.Eq(u_perm, beyond / sp.Add(3 * f_c, -1)),)
        now = sp.Add(3 * sp.Add(sigma_c0, f_c * u_c), minus(sp.Add(h_0, u_c, minus(U_a))))
        room = sp.Add(3 * sigma_c0, minus(h_0), U_a, sp.Add(3 * f_c, -1) * u_c)
        linear = (sp.Eq(now, room),)
        gone = sp.Add(sp.Add(1, minus(3 * f_c)) * sp.Add(u_stop, -u_c), -sp.Add(U_max, -U_a))
        kept = sp.Add(sp.Add(3 * f_c, -1) * sp.Add(u_c, -u_perm), U_a, -U_min)
        least = K_c * V * p_max / (6 * H_c) * sp.Add(1, -sp.tanh(2))
        opens = sp.Add(1, minus(3 * f_c))
        follows = (sp.Eq(rate("u_c"), over(opens) * rate("U_a")),)
        before = sp.Add(3 * f_c * rate("u_c"), -sp.Add(rate("u_c"), -rate("U_a")))
        changes = (sp.Eq(before, sp.Add(rate("U_a"), minus(opens * rate("u_c")))),)
        touching = sp.Equivalent(
            sp.Le(opens * u_c, sp.Add(3 * sigma_c0, minus(h_0), U_a)),
            sp.Le(sp.Add(h_0, u_c, -U_a), 3 * sp.Add(sigma_c0, f_c * u_c)),
        )
        edge = sp.Equivalent(
            sp.Le(p, k * sp.Add(3 * sigma, -sp.Add(h, -(p / k)))), sp.Le(k * h, 3 * k * sigma)
        )
        third = (sp.Eq(u_cum, d * (K_c * V * T * p_max / (6 * H_c)) * sp.Add(1, -sp.tanh(2))),)
    return (
        Equation(
            "contact-condition", section, "condition of contact", (cut.contact,), (), (touching,)
        ),
        Equation("arrest-depth", section, "arrest depth", (cut.arrest_depth,), (), depth),
        Equation(
            "no-contact",
            section,
            "margin and arrest depth",
            (cut.no_contact,),
            (),
            (sp.Eq(now, gone),),
        ),
        Equation(
            "rate-in-contact",
            section,
            "least rate in contact",
            (cut.lowest_rate,),
            (),
            (sp.Ge(rate("u_c"), least),),
        ),
        Equation(
            "sliding-rate", section, "wear that follows the load", (cut.sliding,), (), follows
        ),
        Equation("margin-rate", section, "rate of the margin", (cut.margin_rate,), (), changes),
        Equation("margin", section, "margin 3 sigma - h", (cut.in_wear,), (), linear),
        Equation("one-third", section, "wear per cycle, f_c = 1/3", (cut.per_cycle,), (), third),
        Equation(
            "permanent-contact",
            section,
            "wear from which contact is permanent",
            (cut.permanent,),
            (),
            permanent,
        ),
        Equation(
            "always-contact",
            section,
            "margin and permanent contact",
            (cut.always_contact,),
            (),
            (sp.Eq(now, kept),),
        ),
        Equation(
            "edge-of-contact",
            section,
            "edge of contact, compliant support",
            (cut.at_edge,),
            (),
            (edge,),
        ),
    )
