"""Static solution: wear under a load that does not vary, in closed form.

Overview
    For constant U_a the rate depends on the wear alone, so time is the integral of 1/rate:
    half the wear over C, for the saturated pressure, plus an exponential integral for the
    excess of the gap.  Where f_c = 0 the integral is elementary and inverts by Lambert's W.  On
    a compliant support everything is explicit in the pressure but for one integral, which has
    no closed form; for f_c = 0 it has one.
Key results
    StaticSolution.time        t(u_c), f_c != 0, of either sign while sigma > 0
    StaticSolution.time_smooth t(u_c), f_c = 0
    StaticSolution.wear_smooth u_c(t), f_c = 0
References
    Ei: DLMF 6.2.5.  W: Corless et al., Adv. Comput. Math. 5 (1996) 329.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import sympy as sp

from ..equations import Proved, stated
from ..hypotheses import Hypothesis
from ..kernel import Judgement
from ..note.condensed import bearing_only
from ..rules.algebra import Consequence, Insert, Multiply, Solve, substitute
from ..rules.assumption import assume, defined
from ..rules.reading import CONSTANT
from ..rules.solutions import Integrated, Lambert, Separate
from ..symbols import rate, symbols, t
from .first_integral import SLOPED
from .regimes import Regimes

h_0, U_a, u_c, sigma_c, sigma_c0, f_c = symbols("h_0 U_a u_c sigma_c sigma_c0 f_c")
p_max, K_c, H_c, V, C, beta, x_inf = symbols("p_max K_c H_c V C beta x_inf")
ell, u_s, sigma_s = symbols("ell u_s sigma_s")

MOVING = Hypothesis("the load is not the one under which wear is steady", sp.Ne(beta, 0))

half_rate = defined(C, K_c * V * p_max / (6 * H_c))
load_offset = defined(beta, 2 * (sigma_c0 / f_c - h_0 + U_a), "", assume(CONSTANT))
limit_argument = defined(x_inf, 4 - 2 / f_c)
scale = defined(ell, sigma_c0 / 8 * sp.exp(4 * (h_0 - U_a) / sigma_c0 - 8), "", assume(CONSTANT))


odds = sp.exp(-2 * x_inf - 2 * beta / sigma_s)
"""p_max/p - 1 at a roughness."""


def primitive(roughness: sp.Expr) -> tuple[sp.Expr, sp.Expr]:
    """Return the two parts of a primitive of exp(-2 beta/sigma) with respect to sigma."""
    z = -2 * beta / roughness
    return roughness * sp.exp(z), 2 * beta * sp.Ei(z)


@dataclass(frozen=True)
class StaticSolution:
    """Wear under a constant load, for the law of the note and a rigid support."""

    @cached_property
    def rate(self) -> Judgement:
        """Eq. (13) in terms of the roughness: the saturated rate, over one plus the excess."""
        names = (half_rate, load_offset, limit_argument)
        claim = sp.Eq(rate("u_c"), 2 * C / (1 + odds.subs(sigma_s, sigma_c)))
        return Consequence(claim)(bearing_only().rigid, self.worn, *names, name="rate")

    @cached_property
    def worn(self) -> Judgement:
        """The wear at a roughness."""
        return Solve(u_c)(bearing_only().model.roughness_of_bearing, assume(SLOPED))

    @cached_property
    def time(self) -> Judgement:
        """The time at which the wear is u_c."""
        whole = sp.Integral(1 + odds, (sigma_s, sigma_c0, sigma_c))
        sloped, moving, (grown, rough) = assume(SLOPED), assume(MOVING), Regimes().rough
        start, facts = bearing_only().model.start[4], (rough, sloped, moving)
        time = Separate(sp.Eq(2 * C * f_c * t, whole))(self.rate, self.worn, start, *facts)
        time = Integrated(sigma_s + sigma_s * odds, -2 * beta / sigma_s * odds)(time, rough)
        time = Integrated(sp.exp(-2 * x_inf) * primitive(sigma_s)[1])(time, rough, moving)
        claim, *_ = stated("static-solution")
        scaled = Multiply(1 / (2 * C * f_c))(time, sloped)
        return Consequence(claim)(scaled, grown, rough, moving, name="static solution")

    @cached_property
    def rate_smooth(self) -> Judgement:
        """The rate at a wear, for f_c = 0."""
        claim = sp.Eq(rate("u_c"), 2 * C / (1 + 8 * ell / sigma_c0 * sp.exp(4 * u_c / sigma_c0)))
        return Consequence(claim)(Regimes().kept, half_rate, scale, name="rate, f_c = 0")

    @cached_property
    def time_smooth(self) -> Judgement:
        """The time at which the wear is u_c, for f_c = 0."""
        growth = 4 * ell / sigma_c0 * sp.exp(4 * u_s / sigma_c0)
        whole = sp.Integral(sp.Rational(1, 2) + growth, (u_s, 0, u_c))
        parents = (self.rate_smooth, bearing_only().model.start[1], assume(CONSTANT))
        time = Separate(sp.Eq(C * t, whole))(*parents)
        return Integrated(u_s / 2 + ell * sp.exp(4 * u_s / sigma_c0))(time)

    @cached_property
    def wear_smooth(self) -> Judgement:
        """The wear at a time, for f_c = 0."""
        grown = sp.exp(4 * u_c / sigma_c0)
        w = 8 * ell / sigma_c0 * grown
        claim = sp.Eq(w * sp.exp(w), 8 * ell / sigma_c0 * sp.exp(8 * (C * t + ell) / sigma_c0))
        inverse = Solve(grown)(Lambert(w)(Insert(claim)(self.time_smooth)))
        return Solve(u_c)(substitute(self.time_smooth, inverse), name="wear at a time, f_c = 0")


def results() -> dict[str, Proved]:
    """Return the static solutions."""
    static = StaticSolution()
    return {
        "static-solution": (static.time, load_offset, limit_argument, half_rate),
        "static-solution-smooth": (static.time_smooth, scale, half_rate),
        "static-wear-smooth": static.wear_smooth,
    }
