"""Steady wear: the limit of the wear rate, for any contact law.

Overview
    One worn solid, contact law p = p_max phi(h/sigma) with phi positive, continuous and
    decreasing, roughness that grows (f_c > 0) from sigma_c0 > 0, load bounded by U.  No
    periodicity is needed.  The ratio h/sigma differs from 1/f_c by exactly b/sigma, where
    b = sigma_c0/f_c - h_0 + U_a is bounded.  So the ratio is bounded, the rate has a positive
    lower bound, wear and roughness grow without bound, and the ratio tends to 1/f_c.
Key results
    SteadyState.deviation   h/sigma = 1/f_c - b/sigma, exactly
    SteadyState.growth      u_c >= c t with an explicit c > 0
    SteadyState.ratio       h/sigma -> 1/f_c
    SteadyState.rate        du_c/dt -> K_c V p_max phi(1/f_c)/(3 H_c)
    SteadyState.pressure    p -> p_max phi(1/f_c)
    SteadyState.approach    |ln(rate/limit)| <= m |b/sigma|, where |phi'/phi| <= m
Remarks
    The proof needs neither (14) nor (16).  It is shorter than one by contradiction: the lower
    bound of h/sigma holds for all time, before anything is known of u_c.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, cached_property

import sympy as sp

from ..conditions import Condition
from ..equations import Equation
from ..laws import GENERAL, TANH, ContactLaw, r
from ..note import condensed
from ..note.governing import Model
from ..rules.authored import Identity, Positive
from ..rules.bounds import Consequence, Grows, LogarithmicSlope, Monotone
from ..rules.limits import Accumulates, Diverges, Passes, Vanishes, forever
from ..statement import Statement, inherited
from ..symbols import rate, symbols, t
from ..typeset.display import as_written

h_0, U_a, u_c, p, T, U, k = symbols("h_0 U_a u_c p T U k")
sigma_c0, f_c, p_max, K_c, H_c, V = symbols("sigma_c0 f_c p_max K_c H_c V")
beta, u_cum = symbols("beta u_cum")

ROUGHENING = Condition("the bearing roughens as it wears", sp.Gt(f_c, 0))
BOUNDED_LOAD = Condition("the load is bounded by U", sp.Le(sp.Abs(U_a), U))

roughness = sigma_c0 + f_c * u_c
closure = h_0 + u_c - U_a
excess = sigma_c0 / f_c - h_0 + U_a
"""Distance of the load from the one at which the rate would be steady at once."""

_slope, _wear, _share = sp.symbols("slope wear share", positive=True)
SIGNS = (
    (U_a, U * (1 - _share) / (1 + _share)),
    (u_c, _wear),
    (f_c, _slope),
)
"""The domain f_c > 0, u_c > 0, -U < U_a < U in positive parameters."""

_BOUND = sigma_c0 / f_c + h_0 + U

with as_written():
    per_cycle = sp.Eq(u_cum, K_c * V * T / (6 * H_c) * p_max * (1 + sp.tanh(4 - 2 / f_c)))
"""What u_cum stands for in display forms."""


def step(claim: sp.Basic, rule: object, *parents: Statement, name: str = "") -> Statement:
    """Return an authored statement with the conditions of its parents."""
    return Statement(claim, rule, parents, inherited(parents), name=name)  # type: ignore[arg-type]


def made(rule: object, *parents: Statement, name: str = "") -> Statement:
    """Return the statement that a rule makes from its parents."""
    claim = rule.apply(tuple(parent.claim for parent in parents))  # type: ignore[attr-defined]
    return step(claim, rule, *parents, name=name)


@dataclass(frozen=True)
class SteadyState:
    """The long-time limit of (13) for one contact law."""

    law: ContactLaw = TANH

    @property
    def model(self) -> Model:
        """Bearing wear only, as in section 4."""
        return condensed.bearing_only(self.law).model

    @cached_property
    def rate_at_wear(self) -> Statement:
        """Eq. (13), solved for the rate."""
        return condensed.bearing_only(self.law).rigid.named("wear rate")

    @cached_property
    def deviation(self) -> Statement:
        """h/sigma differs from 1/f_c by b/sigma, exactly."""
        claim = sp.Eq(closure / roughness, 1 / f_c - excess / roughness)
        return Statement(claim, Identity(), conditions=(ROUGHENING,), name="exact deviation")

    @cached_property
    def highest_ratio(self) -> Statement:
        """h/sigma stays below a bound that holds for all time."""
        claim = sp.Le(closure / roughness, 1 / f_c + _BOUND / sigma_c0)
        conditions = (ROUGHENING, BOUNDED_LOAD)
        return Statement(claim, Positive(SIGNS), (), conditions, name="highest closure ratio")

    @cached_property
    def lowest_rate(self) -> Statement:
        """The wear rate never falls below a positive constant."""
        y = sp.Dummy("r", real=True)
        wear_rate = sp.Lambda(y, K_c * V * p_max * self.law.ratio(y) / (3 * H_c))
        bound = made(Monotone(wear_rate), self.highest_ratio)
        claim = sp.Le(bound.claim.lts, rate("u_c"))
        return step(claim, Consequence(), bound, self.rate_at_wear, name="lowest wear rate")

    @cached_property
    def growth(self) -> Statement:
        """Wear grows at least linearly, hence without bound."""
        start = self.model.start[1]
        return made(Grows((f_c,)), self.lowest_rate, start, name="growth")

    @cached_property
    def divergence(self) -> Statement:
        """Roughness grows without bound."""
        return made(Diverges(roughness, (f_c,)), self.growth, name="roughness diverges")

    @cached_property
    def squeeze(self) -> Statement:
        """The deviation of h/sigma is at most a constant over the roughness."""
        offset = excess / roughness
        claim = sp.And(sp.Le(offset, _BOUND / roughness), sp.Ge(offset, -_BOUND / roughness))
        conditions = (ROUGHENING, BOUNDED_LOAD)
        return Statement(claim, Positive(SIGNS), (), conditions, name="bound of the deviation")

    @cached_property
    def vanishing(self) -> Statement:
        """The deviation of h/sigma tends to zero."""
        return made(Vanishes(), self.squeeze, self.divergence, name="the deviation vanishes")

    @cached_property
    def ratio(self) -> Statement:
        """h/sigma tends to 1/f_c, whatever the law."""
        claim = sp.Eq(forever(closure / roughness), 1 / f_c)
        return step(claim, Passes(), self.deviation, self.vanishing, name="limit of h/sigma")

    @cached_property
    def rate(self) -> Statement:
        """The wear rate tends to a constant: (18) for the law of the note."""
        claim = sp.Eq(forever(rate("u_c")), K_c * V / (3 * H_c) * p_max * self.law.ratio(1 / f_c))
        return step(claim, Passes(), self.rate_at_wear, self.ratio, name="steady wear rate")

    @cached_property
    def pressure(self) -> Statement:
        """The pressure tends to p_max phi(1/f_c): (22) for the law of the note."""
        law = condensed.bearing_only(self.law).pressure_of_bearing_wear.limit(k, sp.oo)
        claim = sp.Eq(forever(p), p_max * self.law.ratio(1 / f_c))
        return step(claim, Passes(), law, self.ratio, name="steady pressure")

    @cached_property
    def wear_per_cycle(self) -> Statement:
        """The wear of one period tends to a constant: (21) for the law of the note."""
        return made(Accumulates(), self.rate, name="steady wear per cycle")

    @cached_property
    def approach(self) -> Statement:
        """Relative distance of the rate from its limit (laws whose ln has a bounded slope)."""
        y = sp.Dummy("r", real=True)
        function = sp.Lambda(y, self.law.ratio(y))
        steepest = -sp.limit(sp.diff(self.law.phi, r) / self.law.phi, r, sp.oo)
        ratio, limit = closure / roughness, 1 / f_c
        slope = LogarithmicSlope(function, ratio, limit, steepest)
        said = sp.Abs(sp.log(function(ratio) / function(limit)))
        lemma = Statement(sp.Le(said, steepest * sp.Abs(ratio - limit)), slope, (), (ROUGHENING,))
        claim = sp.Le(
            sp.Abs(sp.log(rate("u_c") / self.rate.claim.rhs)),
            steepest * sp.Abs(excess / roughness),
        )
        return step(claim, Consequence(), lemma, self.rate_at_wear, self.deviation)


@cache
def steady_state(law: ContactLaw = TANH) -> SteadyState:
    """Return the limit for a law, derived once for all that rests on it."""
    return SteadyState(law)


def equations() -> tuple[Equation, ...]:
    """Return the results for any contact law."""
    general, tanh = steady_state(GENERAL), steady_state(TANH)
    section = "steady state"
    with as_written():
        offset = sp.Eq(beta, 2 * sp.Add(sigma_c0 / f_c, -h_0, U_a))
        ratio = sp.Add(h_0, u_c, -U_a) / roughness
        deviation = (sp.Eq(ratio, sp.Add(1 / f_c, -(beta / (2 * roughness)))),)
        relative = rate("u_c") / (u_cum / T)
        far = sp.Le(sp.Abs(sp.log(relative)), 2 * sp.Abs(beta / roughness))
        slowest = sp.Add(4, -(4 / f_c), -(2 * sp.Add(h_0, U) / sigma_c0))
        growth = (sp.Ge(u_c, K_c * V * p_max * t / (6 * H_c) * (1 + sp.tanh(slowest))),)
    return (
        Equation(
            "deviation",
            section,
            "exact deviation of h/sigma from 1/f_c",
            (general.deviation,),
            display=deviation,
            where=(offset,),
        ),
        Equation("growth", section, "wear grows without bound", (tanh.growth,), display=growth),
        Equation("general-rate", section, "wear rate, any law", (general.rate_at_wear,)),
        Equation("closure-ratio", section, "limit of h/sigma, any law", (general.ratio,)),
        Equation("general-law", section, "asymptotic pressure, any law", (general.pressure,)),
        Equation(
            "approach",
            section,
            "distance from the steady rate",
            (tanh.approach,),
            display=(far,),
            where=(offset, per_cycle),
        ),
    )
