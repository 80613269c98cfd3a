"""Section 4: the stabilised response, equations (11) to (22).

Overview
    The note goes from (13) to (17) by way of (16), whose second line is false: the step from
    (15) drops a denominator that grows without bound.  (17) is true all the same.  Here every
    equation from (14) on is derived from the limit of h/sigma, which ``results.steady_state``
    proves for f_c > 0 and a bounded load, and the printed forms are compared with the results.
Key results
    limit_argument     (17), second line
    wear_per_cycle     (21)
    asymptote          the correction of (19)
    constant_bracket   the refutation of (16), second line: the bracket is a constant
Remarks
    (11) as printed holds for every field, with G_inf = G.  (12) as printed, without the dots,
    excludes the accumulation that it is meant to describe.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

import sympy as sp

from ..equations import Proved
from ..hypotheses import PERIODIC, Hypothesis
from ..results.steady_state import (
    closure,
    drift,
    excess,
    named_limit,
    roughness,
    steady_state,
)
from ..rules.algebra import Insert, substitute
from ..rules.assumption import RESPONSE, assume, define, defined
from ..rules.drift import first_order
from ..rules.growth import AtInfinity, Diverges
from ..rules.limits import Passes, forever, later, one_period_later
from ..symbols import rate, symbols, t

h_0, U_a, u_c = symbols("h_0 U_a u_c")
sigma_c0, f_c, p_max, K_c, H_c, V = symbols("sigma_c0 f_c p_max K_c H_c V")
u_cum, p_inf, G, G_inf, u_inf = symbols("u_cum p_inf G G_inf u_inf")


argument = (4 * roughness - 2 * closure) / roughness
bracket = (4 * f_c - 2) * roughness - f_c * (4 * roughness - 2 * closure)


steady = steady_state()
"""The limit of h/sigma and what it rests on, for the law of the note."""

asymptotic_response = assume(Hypothesis(sp.Eq(forever(G - G_inf.subs(t, 0)), 0)))
"""(11) in a form that is not vacuous: the field itself has a limit."""

every_field = Passes(sp.Eq(forever(G - G_inf), 0))(
    define(sp.Eq(G_inf, G)), name="every field satisfies (11)"
)
"""(11) as printed holds for every field, with G_inf = G."""

stabilised_response = (
    assume(Hypothesis(sp.Eq(rate("G_inf") - later(rate("G_inf")), 0))),
    assume(Hypothesis(sp.Eq(forever(rate("G") - rate("G_inf")), 0))),
)
"""(12), for rates as its text says."""

periodic_rate = Passes(sp.Eq(forever(later(rate("u_c")) - rate("u_c")), 0))(
    steady.rate, name="the rate becomes periodic"
)
"""(14): the difference of the rates of consecutive cycles tends to zero."""

_left = forever(3 * H_c / (K_c * V) * rate("u_c"))
_right = forever(p_max / 2 * (1 + sp.tanh(argument)))
_value = p_max / 2 * (1 + sp.tanh(4 - 2 / f_c))
passage = Insert(sp.Eq(_left, _right))(
    Passes(sp.Eq(_left, _value))(steady.rate),
    Passes(sp.Eq(_right, _value))(steady.ratio),
    name="passage to the limit",
)
"""First lines of (15), (16) and (17)."""

arguments_meet = Passes(sp.Eq(forever(later(argument) - argument), 0))(
    steady.ratio, name="the arguments come together"
)
"""(15), second line."""

limit_argument = Passes(sp.Eq(forever(argument), 4 - 2 / f_c))(
    steady.ratio, name="limit of the argument"
)
"""(17), second line: the argument of tanh tends to 4 - 2/f_c."""

constant_bracket = Insert(sp.Eq(bracket, 2 * (f_c * (h_0 - U_a) - sigma_c0)))(
    name="bracket of (16)",
    remark="independent of the wear; zero only where U_a = h_0 - sigma_c0/f_c: (16) is false",
)
"""The bracket in (16), second line, does not depend on the wear."""

_product = roughness * later(roughness)
_repeats = assume(PERIODIC)
_difference = sp.Eq(later(argument) - argument, (later(u_c) - u_c) * bracket / _product)
dropped_denominators = substitute(
    Insert(_difference)(_repeats, steady.roughening, steady.worn, one_period_later(steady.worn)),
    _repeats,
    name="from (15) to (16)",
    remark="the product of two roughnesses is no constant, and must not be dropped",
)
"""The difference in (15), with the denominators that (16) drops."""

_ratio = forever(bracket / _product)
bracket_over_roughness = Insert(sp.Eq(u_cum * _ratio, 0))(
    Passes(sp.Eq(_ratio, 0))(steady.vanishing, steady.divergence),
    name="(16) with its denominators",
)
"""(16), second line, with its denominators."""

_deviation = AtInfinity(
    sp.Eq(forever(u_c * (closure / roughness - 1 / f_c) + excess / f_c), 0), 1 / u_c
)(Diverges(u_c)(steady.growth, steady.roughening), steady.roughening, steady.worn)
linear_approach = first_order(
    *(steady.rate_at_wear, _deviation, steady.ratio, steady.rate),
    name="approach of the rate, first order",
)
"""The distance of the rate from its limit, to first order in 1/t."""

asymptote = drift(linear_approach)
"""The correction of (19): wear departs from every straight line like ln t."""

increment = defined(
    u_cum,
    later(u_inf) - u_inf,
    define(RESPONSE),
)
"""(20): the wear of one cycle of the asymptotic response."""

wear_per_cycle = named_limit(u_cum, steady.wear_per_cycle, "wear per cycle")
"""(21): the wear of a cycle tends to the product of limit rate and period."""

pressure = named_limit(p_inf, steady.pressure, "asymptotic pressure")
"""(22)."""

EQUATIONS: Mapping[str, Proved] = MappingProxyType(
    {
        "11": asymptotic_response,
        "12": stabilised_response,
        "14": periodic_rate,
        "15": (passage, arguments_meet),
        "16a": passage,
        "16b": bracket_over_roughness,
        "17a": passage,
        "17b": limit_argument,
        "18": steady.rate,
        "19": asymptote,
        "20": increment,
        "21": wear_per_cycle,
        "22": pressure,
        "every-field": every_field,
        "bracket": constant_bracket,
        "dropped-denominators": dropped_denominators,
    }
)
"""Equations (11) to (22), and the refutations of (11) and (16) as printed."""
