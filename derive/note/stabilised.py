"""Section 4: the stabilised response, equations (11) to (22).

Overview
    The note goes from (13) to (17) by way of (16), whose second line is false: the step from
    (15) drops a denominator that grows without bound.  (17) is true all the same.  Here every
    equation from (14) on is derived from the limit of h/sigma, which ``results.steady_state``
    proves for f_c > 0 and a bounded load, and the printed forms are compared with the results.
Key results
    Stabilised.argument          (17), second line
    Stabilised.wear_per_cycle    (21)
    Stabilised.asymptote         what stands in the place of (19)
    Stabilised.bracket           why (16), second line, is false: the bracket is a constant
Remarks
    (11) as printed holds for every field, with G_inf = G.  (12) as printed, without the dots,
    excludes the accumulation that it is meant to describe.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import sympy as sp

from ..equations import Proved
from ..hypotheses import Hypothesis, Kind
from ..kernel import Judgement
from ..results.steady_state import (
    SteadyState,
    closure,
    excess,
    roughness,
    steady_state,
)
from ..rules.algebra import Identity, Insert, substitute
from ..rules.assumption import assume, defined
from ..rules.drift import MEAN, first_order, logarithmic_drift
from ..rules.limits import (
    AtInfinity,
    Diverges,
    Passes,
    forever,
    later,
    one_period_later,
)
from ..rules.reading import CONTINUOUS, PERIODIC
from ..symbols import rate, symbols, t

h_0, U_a, u_c = symbols("h_0 U_a u_c")
sigma_c0, f_c, p_max, K_c, H_c, V = symbols("sigma_c0 f_c p_max K_c H_c V")
u_cum, p_inf, G, G_inf, u_inf = symbols("u_cum p_inf G G_inf u_inf")

argument = (4 * roughness - 2 * closure) / roughness
bracket = (4 * f_c - 2) * roughness - f_c * (4 * roughness - 2 * closure)


@dataclass(frozen=True)
class Stabilised:
    """Section 4, from the limit of h/sigma."""

    steady: SteadyState = field(default_factory=steady_state)

    @cached_property
    def vacuous(self) -> Judgement:
        """(11) as printed holds for every field, with G_inf = G."""
        choice = assume(Hypothesis("a choice of G_inf", sp.Eq(G_inf, G), kind=Kind.DEFINITION))
        claim = sp.Eq(forever(G - G_inf), 0)
        return Passes(claim)(choice, name="every field satisfies (11)")

    @cached_property
    def asymptotic_response(self) -> Judgement:
        """(11), made to say something: the field itself has a limit."""
        at_rest = G_inf.subs(t, 0)
        claim = sp.Eq(forever(G - at_rest), 0)
        return assume(Hypothesis("an asymptotic response", claim, kind=Kind.DEFINITION))

    @cached_property
    def stabilised_response(self) -> tuple[Judgement, Judgement]:
        """(12), for rates as its text says."""
        claims = (
            sp.Eq(rate("G_inf") - later(rate("G_inf")), 0),
            sp.Eq(forever(rate("G") - rate("G_inf")), 0),
        )
        text = "a stabilised response"
        periodic, tends = (assume(Hypothesis(text, c, kind=Kind.DEFINITION)) for c in claims)
        return periodic, tends

    @cached_property
    def periodic_rate(self) -> Judgement:
        """(14): the rates of two cycles come together."""
        claim = sp.Eq(forever(later(rate("u_c")) - rate("u_c")), 0)
        return Passes(claim)(self.steady.rate, name="the rate becomes periodic")

    @cached_property
    def passage(self) -> Judgement:
        """First lines of (15), (16) and (17)."""
        left = 3 * H_c / (K_c * V) * rate("u_c")
        right = p_max / 2 * (1 + sp.tanh(argument))
        value = p_max / 2 * (1 + sp.tanh(4 - 2 / f_c))
        sides = (
            Passes(sp.Eq(forever(left), value))(self.steady.rate),
            Passes(sp.Eq(forever(right), value))(self.steady.ratio),
        )
        claim = sp.Eq(forever(left), forever(right))
        return Insert(claim)(*sides, name="passage to the limit")

    @cached_property
    def argument(self) -> Judgement:
        """(17), second line: the argument of tanh tends to 4 - 2/f_c."""
        claim = sp.Eq(forever(argument), 4 - 2 / f_c)
        return Passes(claim)(self.steady.ratio, name="limit of the argument")

    @cached_property
    def arguments_meet(self) -> Judgement:
        """(15), second line."""
        claim = sp.Eq(forever(later(argument) - argument), 0)
        return Passes(claim)(self.steady.ratio, name="the arguments come together")

    @cached_property
    def bracket(self) -> Judgement:
        """The bracket in (16), second line, does not depend on the wear."""
        claim = sp.Eq(bracket, 2 * (f_c * (h_0 - U_a) - sigma_c0))
        remark = "a constant for each load, zero only for one load: (16) as printed is false"
        return Identity(claim)(name="bracket of (16)", remark=remark)

    @cached_property
    def difference(self) -> Judgement:
        """The difference in (15), with the denominators that (16) drops."""
        wear, repeats = later(u_c) - u_c, assume(PERIODIC)
        product = roughness * later(roughness)
        claim = sp.Eq(later(argument) - argument, wear * bracket / product)
        worn = self.steady.worn
        facts = (self.steady.roughening, worn, one_period_later(worn))
        remark = "the product of two roughnesses tends to infinity and must not be dropped"
        found = Insert(claim)(repeats, *facts)
        return substitute(found, repeats, name="from (15) to (16)", remark=remark)

    @cached_property
    def bracket_over_roughness(self) -> Judgement:
        """(16), second line, with its denominators."""
        product = forever(bracket / (roughness * later(roughness)))
        vanishing = Passes(sp.Eq(product, 0))(self.steady.vanishing, self.steady.divergence)
        claim = sp.Eq(u_cum * product, 0)
        return Insert(claim)(vanishing, name="(16) with its denominators")

    @cached_property
    def linear_approach(self) -> Judgement:
        """The distance of the rate from its limit, to first order in 1/t."""
        steady = self.steady
        wear = Diverges(u_c)(steady.growth, steady.roughening)
        claim = sp.Eq(forever(u_c * (closure / roughness - 1 / f_c) + excess / f_c), 0)
        deviation = AtInfinity(claim, 1 / u_c)(wear, steady.roughening, steady.worn)
        parents = (steady.rate_at_wear, deviation, steady.ratio, steady.rate)
        return first_order(*parents, name="approach of the rate, first order")

    @cached_property
    def asymptote(self) -> Judgement:
        """In the place of (19): wear departs from every straight line like ln t."""
        return drift(self.linear_approach)

    @cached_property
    def increment(self) -> Judgement:
        """(20): the wear of one cycle of the asymptotic response."""
        same = sp.Eq(later(rate("u_inf")), rate("u_inf"))
        periodic = assume(Hypothesis("a stabilised response", same, kind=Kind.DEFINITION))
        return defined(u_cum, later(u_inf) - u_inf, "", periodic)

    @cached_property
    def wear_per_cycle(self) -> Judgement:
        """(21): the wear of a cycle tends to the product of limit rate and period."""
        limit = self.steady.wear_per_cycle
        return named_limit(u_cum, limit, "wear per cycle")

    @cached_property
    def pressure(self) -> Judgement:
        """(22)."""
        return named_limit(p_inf, self.steady.pressure, "asymptotic pressure")


def named_limit(symbol: sp.Expr, limit: Judgement, name: str) -> Judgement:
    """Return the value of a symbol that is defined as a limit."""
    definition = defined(symbol, limit.claim.term)
    return Insert(sp.Eq(symbol, limit.claim.value))(definition, limit, name=name)


def drift(approach: Judgement) -> Judgement:
    """Return the logarithmic drift under a periodic load, from the approach of the rate."""
    mean = defined(MEAN.lhs, MEAN.rhs, "mean of the load")
    load = (assume(PERIODIC), assume(CONTINUOUS), mean)
    return logarithmic_drift(approach, *load, name="logarithmic drift")


def results() -> dict[str, Proved]:
    """Return equations (11) to (22), and what refutes (11) and (16) as printed."""
    s = Stabilised()
    return {
        "11": s.asymptotic_response,
        "12": s.stabilised_response,
        "14": s.periodic_rate,
        "15": (s.passage, s.arguments_meet),
        "16a": s.passage,
        "16b": s.bracket_over_roughness,
        "17a": s.passage,
        "17b": s.argument,
        "18": s.steady.rate,
        "19": s.asymptote,
        "20": s.increment,
        "21": s.wear_per_cycle,
        "22": s.pressure,
        "every-field": s.vacuous,
        "bracket": s.bracket,
        "dropped-denominators": s.difference,
    }
