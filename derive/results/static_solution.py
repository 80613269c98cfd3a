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
from ..rules.assumption import assume, defined
from ..rules.reading import CONSTANT
from ..rules.solutions import Inverted, Solution
from ..symbols import symbols
from .first_integral import SLOPED
from .regimes import Regimes

h_0, U_a, sigma_c0, f_c = symbols("h_0 U_a sigma_c0 f_c")
p_max, K_c, H_c, V, C, beta, x_inf = symbols("p_max K_c H_c V C beta x_inf")

MOVING = Hypothesis("the load is not the one under which wear is steady", sp.Ne(beta, 0))

half_rate = defined(C, K_c * V * p_max / (6 * H_c))
load_offset = defined(beta, 2 * (sigma_c0 / f_c - h_0 + U_a), "", assume(CONSTANT))
limit_argument = defined(x_inf, 4 - 2 / f_c)


def excess(roughness: sp.Expr) -> sp.Expr:
    """Return a primitive of exp(-2 beta/sigma) with respect to sigma."""
    z = -2 * beta / roughness
    return roughness * sp.exp(z) + 2 * beta * sp.Ei(z)


@dataclass(frozen=True)
class StaticSolution:
    """Wear under a constant load, for the law of the note and a rigid support."""

    @property
    def start(self) -> Judgement:
        """Wear begins at 0."""
        return bearing_only().model.start[1]

    @cached_property
    def time(self) -> Judgement:
        """The time at which the wear is u_c."""
        claim, *_ = stated("static-solution")
        names = (half_rate, load_offset, limit_argument)
        facts = (assume(CONSTANT), assume(SLOPED), assume(MOVING), *Regimes().rough)
        parents = (bearing_only().rigid, self.start, *names, *facts)
        return Solution(claim)(*parents, name="static solution")

    @cached_property
    def time_smooth(self) -> Judgement:
        """The time at which the wear is u_c, for f_c = 0."""
        claim, *_ = stated("static-solution-smooth")
        parents = (Regimes().kept, self.start, half_rate, assume(CONSTANT))
        return Solution(claim)(*parents, name="static solution, f_c = 0")

    @cached_property
    def wear_smooth(self) -> Judgement:
        """The wear at a time, for f_c = 0."""
        (claim,) = stated("static-wear-smooth")
        return Inverted(claim)(self.time_smooth, name="wear at a time, f_c = 0")


def results() -> dict[str, Proved]:
    """Return the static solutions."""
    static = StaticSolution()
    return {
        "static-solution": (static.time, load_offset, limit_argument, half_rate),
        "static-solution-smooth": (static.time_smooth, half_rate),
        "static-wear-smooth": static.wear_smooth,
    }
