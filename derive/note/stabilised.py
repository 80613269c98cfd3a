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

from ..equations import Equation
from ..hypotheses import Hypothesis, Kind
from ..kernel import Judgement
from ..results.steady_state import (
    SteadyState,
    closure,
    excess,
    per_cycle,
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
from ..typeset.display import as_written, minus
from . import printed_stabilised as printed

h_0, U_a, u_c, p, T, U_mean = symbols("h_0 U_a u_c p T U_mean")
sigma_c0, f_c, p_max, K_c, H_c, V = symbols("sigma_c0 f_c p_max K_c H_c V")
u_cum, p_inf, G, G_inf, u_inf, A, sigma = symbols("u_cum p_inf G G_inf u_inf A sigma")

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
        at_rest = printed.at("G_inf", sp.S.Zero)
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
        return defined(u_cum, printed.at("u_inf", t + T) - u_inf, "", periodic)

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


def _displays() -> dict[str, tuple[sp.Basic, ...]]:
    """Return what differs from the printed forms, laid out by an author."""
    with as_written():
        denominators = roughness * later(roughness)
        upper = 4 * sigma - 2 * sp.Add(h_0, u_c, -U_a)
        upper_later = later(upper).xreplace({later(U_a): U_a})
        bracket = sp.Add((4 * f_c - 2) * sigma, minus(f_c * upper))
        worn = sp.Add(later(u_c), -u_c)
        return {
            "11": (sp.Eq(forever(sp.Add(G, -printed.at("G_inf", sp.S.Zero))), 0),),
            "12": (
                sp.Eq(sp.Add(rate("G_inf"), -later(rate("G_inf"))), 0),
                sp.Eq(forever(sp.Add(rate("G"), -rate("G_inf"))), 0),
            ),
            "16b": (sp.Eq(u_cum * forever(printed.BRACKET / denominators), 0),),
            "19": (sp.Eq(forever(sp.Add(u_c, minus(u_cum * t / T)) / sp.log(t / T)), A),),
            "bracket": (sp.Eq(printed.BRACKET, 2 * (f_c * (h_0 - U_a) - sigma_c0)),),
            "difference": (
                sp.Eq(
                    sp.Add(upper_later / later(sigma), minus(upper / sigma)),
                    worn * bracket / (sigma * later(sigma)),
                ),
            ),
        }


def drift_and_wear() -> tuple[sp.Eq, sp.Eq]:
    """Return the coefficient of the drift and (21), as abbreviations."""
    with as_written():
        coefficient = 2 / f_c * (1 - sp.tanh(4 - 2 / f_c)) * sp.Add(sigma_c0 / f_c, -h_0, U_mean)
        return sp.Eq(A, coefficient), per_cycle


def equations() -> tuple[Equation, ...]:
    """Return equations (11) to (22), and what refutes (11) and (16) as printed."""
    s, shown = Stabilised(), _displays()
    first, second = "4.1", "4.2"
    limit = "passage to the limit"
    return (
        Equation(
            "11",
            first,
            "asymptotic response",
            (s.asymptotic_response,),
            printed.EQ_11,
            shown["11"],
            remark="as printed every field satisfies it, with G_inf = G",
        ),
        Equation(
            "12",
            first,
            "stabilised response",
            s.stabilised_response,
            printed.EQ_12,
            shown["12"],
            remark="misprint: without the dots it excludes accumulation, its own case (b)",
        ),
        Equation("14", second, "the rate becomes periodic", (s.periodic_rate,), printed.EQ_14),
        Equation("15", second, limit, (s.passage, s.arguments_meet), printed.EQ_15),
        Equation("16a", second, limit, (s.passage,), printed.EQ_16A),
        Equation(
            "16b",
            second,
            "argument, with the denominators restored",
            (s.bracket_over_roughness,),
            printed.EQ_16B,
            shown["16b"],
            remark="as printed the bracket is a constant that differs from zero",
        ),
        Equation("17a", second, limit, (s.passage,), printed.EQ_17A),
        Equation("17b", second, "limit of the argument", (s.argument,), printed.EQ_17B),
        Equation("18", second, "limit of the wear rate", (s.steady.rate,), printed.EQ_18),
        Equation(
            "19",
            second,
            "asymptote of the wear",
            (s.asymptote,),
            printed.EQ_19,
            shown["19"],
            remark="no affine asymptote: the distance from (19) grows like ln t",
            where=drift_and_wear(),
        ),
        Equation("20", second, "wear per cycle, definition", (s.increment,), printed.EQ_20),
        Equation("21", second, "wear per cycle", (s.wear_per_cycle,), printed.EQ_21),
        Equation("22", second, "asymptotic pressure", (s.pressure,), printed.EQ_22),
        Equation("every-field", first, "what (11) as printed says", (s.vacuous,)),
        Equation("bracket", second, "the bracket of (16)", (s.bracket,), display=shown["bracket"]),
        Equation(
            "dropped-denominators",
            second,
            "from (15) to (16)",
            (s.difference,),
            display=shown["difference"],
            where=(sp.Eq(sigma, roughness),),
        ),
    )
