"""Steady wear: the limit of the wear rate, for any contact law.

Overview
    One worn solid, contact law p = p_max phi(h/sigma) with phi positive, smooth and
    decreasing, roughness that grows (f_c > 0) from sigma_c0 > 0, load bounded by U.  No
    periodicity is needed.  The ratio h/sigma has an upper bound, which a rough pin only lowers;
    so the rate has a positive lower bound, and wear and roughness grow without bound.  For a
    smooth pin h/sigma differs from 1/f_c by exactly b/sigma, where b = sigma_c0/f_c - h_0 + U_a
    is bounded, and so tends to 1/f_c.
Key results
    SteadyState.deviation   h/sigma = 1/f_c - b/sigma, exactly
    SteadyState.growth      u_c >= c t with an explicit c > 0, for a rough pin too
    SteadyState.ratio       h/sigma -> 1/f_c
    SteadyState.rate        du_c/dt -> K_c V p_max phi(1/f_c)/(3 H_c)
    SteadyState.pressure    p -> p_max phi(1/f_c)
    SteadyState.approach    |ln(rate/limit)| <= m |b/sigma|, where |phi'/phi| <= m
Remarks
    The proof needs neither (14) nor (16).  It is shorter than one by contradiction: the upper
    bound of h/sigma holds for all time, before anything is known of u_c.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, cached_property
from typing import ClassVar

import sympy as sp

from ..hypotheses import BOUNDED_LOAD, PERIODIC, RIGID, ROUGHENING
from ..kernel import Judgement, infer
from ..laws import TANH, ContactLaw, r
from ..note.condensed import CondensedProblem, bearing_only
from ..note.governing import NoteModel
from ..rules.algebra import Consequence, Insert
from ..rules.assumption import assume, defined
from ..rules.calculus import grows, rigid
from ..rules.drift import MEAN, logarithmic_drift
from ..rules.growth import Diverges, periodic_bound
from ..rules.inequalities import Arithmetic, LogarithmicSlope, Monotone
from ..rules.limits import Passes, accumulates, forever, vanishes
from ..symbols import rate, symbols

h, h_0, U_a, u_c, p, U, sigma = symbols("h h_0 U_a u_c p U sigma")
sigma_c0, f_c, p_max, K_c, H_c, V = symbols("sigma_c0 f_c p_max K_c H_c V")

roughness = sigma_c0 + f_c * u_c
closure = h_0 + u_c - U_a
excess = sigma_c0 / f_c - h_0 + U_a
"""Difference between the load and the one with a constant rate from the start."""


def worn(model: NoteModel) -> Judgement:
    """Return that the wear of the bearing is never negative, since its rate is not."""
    positive = Arithmetic(sp.Ge(rate("u_c"), 0))(model.wear_laws[2])
    return grows(positive, model.start[1], name="wear increases")


@dataclass(frozen=True)
class SteadyState:
    """The long-time limit of (13) for one contact law."""

    law: ContactLaw = TANH
    closure: ClassVar[sp.Expr] = closure
    excess: ClassVar[sp.Expr] = excess
    bound: ClassVar[sp.Expr] = sigma_c0 / f_c + h_0 + U

    @property
    def model(self) -> CondensedProblem:
        """Bearing wear only, as in section 4."""
        return bearing_only(self.law)

    @cached_property
    def worn(self) -> Judgement:
        """Wear increases from zero."""
        return worn(self.model)

    @cached_property
    def roughening(self) -> Judgement:
        """The hypothesis f_c > 0."""
        return assume(ROUGHENING)

    @cached_property
    def rate_at_wear(self) -> Judgement:
        """Eq. (13), solved for the rate."""
        return self.model.rigid.named("wear rate")

    @cached_property
    def pressure_at_wear(self) -> Judgement:
        """The pressure in terms of wear and load."""
        return rigid(self.model.pressure_of_bearing_wear)

    @cached_property
    def deviation(self) -> Judgement:
        """h/sigma of a smooth pin differs from 1/f_c by b/sigma, exactly."""
        claim = sp.Eq(self.closure / roughness, 1 / f_c - self.excess / roughness)
        return Insert(claim)(self.roughening, self.worn, name="exact deviation")

    @property
    def facts(self) -> tuple[Judgement, ...]:
        """The premises of bounds of the closure ratio."""
        return self.roughening, assume(BOUNDED_LOAD), self.worn, self.support

    @cached_property
    def support(self) -> Judgement:
        """What is known of the deflection: the support is rigid."""
        return assume(RIGID)

    @cached_property
    def highest_ratio(self) -> Judgement:
        """h/sigma stays below a bound that holds for all time, for a rough pin too."""
        model = self.model
        rougher = Arithmetic(sp.Ge(sigma, roughness))(
            *(model.roughness, model.roughness_of_bearing, self.roughening, self.worn),
            name="a rough pin adds roughness",
        )
        claim = sp.Le(h / sigma, 1 / f_c + self.bound / sigma_c0)
        return Arithmetic(claim)(
            *(model.closure, model.wear_of_pin, rougher, *self.facts), name="highest closure ratio"
        )

    @cached_property
    def lowest_rate(self) -> Judgement:
        """The wear rate never falls below a positive constant."""
        bound = Monotone(wear_rate(self.law))(self.highest_ratio)
        claim = sp.Le(bound.claim.lesser, rate("u_c"))
        parents = bound, self.model.wear_laws[2], self.model.pressure
        return Consequence(claim)(*parents, name="lowest wear rate")

    @cached_property
    def growth(self) -> Judgement:
        """Wear grows at least linearly, hence without bound."""
        return grows(self.lowest_rate, self.model.start[1], name="growth")

    @cached_property
    def divergence(self) -> Judgement:
        """Roughness grows without bound."""
        return Diverges(roughness)(self.growth, self.roughening, name="roughness diverges")

    @cached_property
    def squeeze(self) -> Judgement:
        """The deviation of h/sigma is at most a constant over the roughness."""
        offset = self.excess / roughness
        claim = sp.And(
            sp.Le(offset, self.bound / roughness), sp.Ge(offset, -self.bound / roughness)
        )
        return Arithmetic(claim)(*self.facts, name="bound of the deviation")

    @cached_property
    def vanishing(self) -> Judgement:
        """The deviation of h/sigma tends to zero."""
        return vanishes(self.squeeze, self.divergence, name="the deviation vanishes")

    @cached_property
    def ratio(self) -> Judgement:
        """h/sigma of a smooth pin tends to 1/f_c, for every law."""
        claim = sp.Eq(forever(self.closure / roughness), 1 / f_c)
        return Passes(claim)(self.deviation, self.vanishing, name="limit of the closure ratio")

    @cached_property
    def rate(self) -> Judgement:
        """The wear rate tends to a constant: (18) for the law of the note."""
        claim = sp.Eq(forever(rate("u_c")), K_c * V / (3 * H_c) * p_max * self.law.ratio(1 / f_c))
        return Passes(claim)(self.rate_at_wear, self.ratio, name="steady wear rate")

    @cached_property
    def pressure(self) -> Judgement:
        """The pressure tends to p_max phi(1/f_c): (22) for the law of the note."""
        claim = sp.Eq(forever(p), p_max * self.law.ratio(1 / f_c))
        return Passes(claim)(self.pressure_at_wear, self.ratio, name="steady pressure")

    @cached_property
    def wear_per_cycle(self) -> Judgement:
        """The wear of one period tends to a constant: (21) for the law of the note."""
        return accumulates(self.rate, name="steady wear per cycle")

    @cached_property
    def approach(self) -> Judgement:
        """Relative distance of the rate from its limit (laws whose ln has a bounded slope)."""
        y = sp.Dummy("r", real=True)
        function = sp.Lambda(y, self.law.ratio(y))
        steepest = -sp.limit(self.law.stable.far_steepness, r, sp.oo)
        ratio, limit = self.closure / roughness, 1 / f_c
        rule = LogarithmicSlope(function, ratio, limit, steepest)
        lemma = infer(rule, self.roughening, self.worn)
        claim = sp.Le(
            sp.Abs(sp.log(rate("u_c") / self.rate.claim.value)),
            steepest * sp.Abs(self.excess / roughness),
        )
        return Consequence(claim)(lemma, self.rate_at_wear, self.deviation)


def wear_rate(law: ContactLaw) -> sp.Lambda:
    """Return the wear rate as a function of h/sigma."""
    y = sp.Dummy("r", real=True)
    return sp.Lambda(y, K_c * V * p_max * law.ratio(y) / (3 * H_c))


@cache
def steady_state(law: ContactLaw = TANH) -> SteadyState:
    """Return the long-time limit for a law, derived once."""
    return SteadyState(law)


def named_limit(symbol: sp.Expr, limit: Judgement, name: str) -> Judgement:
    """Return the value of a symbol that is defined as a limit."""
    definition = defined(symbol, limit.claim.term, limit)
    return Insert(sp.Eq(symbol, limit.claim.value))(definition, limit, name=name)


def drift(approach: Judgement) -> Judgement:
    """Return the logarithmic drift under a periodic load, from the approach of the rate."""
    mean = defined(MEAN.lhs, MEAN.rhs)
    bounded = logarithmic_drift(approach, assume(PERIODIC), mean)
    return periodic_bound(bounded, name="logarithmic drift")
