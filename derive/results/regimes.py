"""Regimes: what becomes of the wear of one solid for f_c = 0 and f_c < 0, without cutoff.

Overview
    f_c > 0 is the steady regime.  For f_c = 0 the argument of tanh falls with the wear without
    bound, the rate is close to its exponential tail, and wear grows like the logarithm of the
    cycles.  For f_c < 0 the roughness would vanish at the wear sigma_c0/|f_c|.  There the gap
    at the peak of the load is h* = h_0 + sigma_c0/|f_c| - max U_a.  If it is open, wear
    saturates at that depth, logarithmically slowly; if not, roughness vanishes in finite time.
Key results
    tail            the rate is below its exponential tail, by a factor that tends to 1
    logarithmic     f_c = 0: the wear of the tail, for any periodic load
    saturating      f_c < 0, h* > 0: the cycles at which the roughness is s, static load
    finite          f_c < 0, h* <= 0: the rate while the peak of the load is in contact
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import sympy as sp

from ..claims import landau_o
from ..equations import Proved, stated
from ..hypotheses import Hypothesis, Kind
from ..kernel import Judgement
from ..laws import TANH
from ..note.condensed import bearing_only
from ..note.governing import ROUGH_BEARING
from ..rules.algebra import Consequence, Solve, discharge, substitute
from ..rules.assumption import assume, defined
from ..rules.drift import LeadingTerm, LogarithmicGrowth
from ..rules.inequalities import Arithmetic, Monotone
from ..rules.limits import AtInfinity, forever, unbounded
from ..rules.reading import CONSTANT, SINE
from ..rules.solutions import Integrated, Separate
from ..symbols import rate, symbols, t
from .steady_state import closure, roughness, wear_rate

h_0, U_a, u_c, U, N, M, h_star, T = symbols("h_0 U_a u_c U N M h_star T")
sigma_c0, sigma_c, f_c, p_max, K_c, H_c, V = symbols("sigma_c0 sigma_c f_c p_max K_c H_c V")
(sigma_s,) = symbols("sigma_s")

SMOOTHING = Hypothesis("the bearing smoothens as it wears", sp.Lt(f_c, 0))
KEPT = Hypothesis("wear does not change the roughness", sp.Eq(f_c, 0))
OVERLAP = Hypothesis(
    "no gap is left where the roughness would vanish",
    sp.Ge(U_a, h_0 - sigma_c0 / f_c),
    kind=Kind.STATE,
)

GAP = "gap where the roughness would vanish"

odds = sp.exp(4 * h_star / sigma_s + 4 / f_c - 8)
"""p_max/p - 1 at a roughness, f_c < 0 and static load."""

largest_wear = defined(M, K_c * V * T * p_max / (3 * H_c))


@dataclass(frozen=True)
class Regimes:
    """One worn solid, the law of the note, no cutoff."""

    @cached_property
    def rate(self) -> Judgement:
        """Eq. (13), solved for the rate."""
        return bearing_only().rigid

    @cached_property
    def rough(self) -> tuple[Judgement, ...]:
        """The roughness of the bearing, which has not vanished."""
        return bearing_only().model.roughness_of_bearing, assume(ROUGH_BEARING)

    @cached_property
    def tail_rate(self) -> sp.Expr:
        """The exponential tail of the rate."""
        return K_c * V * p_max / (3 * H_c) * sp.exp(8 - 4 * closure / roughness)

    @cached_property
    def tail(self) -> Judgement:
        """The rate is below its exponential tail."""
        bound = Arithmetic(sp.Lt(self.rate.claim.rhs, self.tail_rate))(*self.rough)
        claim = sp.Lt(rate("u_c"), self.tail_rate)
        return Consequence(claim)(bound, self.rate, name="tail of the rate")

    @cached_property
    def kept(self) -> Judgement:
        """The rate of a bearing that keeps its roughness."""
        kept = assume(KEPT)
        grown = bearing_only().model.roughness_of_bearing
        return discharge(substitute(self.rate, kept), ROUGH_BEARING, grown, kept)

    @cached_property
    def logarithmic(self) -> Judgement:
        """Wear for f_c = 0 after N cycles of a sine load: the tail adds up to a logarithm."""
        scale, sine = sigma_c0 / 4, assume(SINE)
        bounded = Arithmetic(sp.Le(sp.Abs(U_a), U))(sine)
        deep = unbounded(self.kept, bounded, name="growth")
        grown, tail = sp.exp((u_c - U_a) / scale), sp.exp(8 - 4 * closure / sigma_c0)
        value = K_c * V * p_max / (3 * H_c) * sp.exp(8 - 4 * h_0 / sigma_c0)
        level = value / (1 + tail)
        fading = sp.exp(-u_c / scale)
        faded = AtInfinity(sp.Eq(forever(level), value), fading)(deep, bounded)
        claim = sp.Eq(forever(rate("u_c") * grown), value)
        approach = Consequence(claim)(faded, self.kept)
        worn = LogarithmicGrowth(scale)(approach, sine)
        return substitute(worn, Solve(K_c)(largest_wear), name="logarithmic wear")

    @cached_property
    def cycles(self) -> Judgement:
        """The cycles to a roughness, as an integral over the roughness; static load."""
        grown, rough = self.rough
        gap = defined(h_star, h_0 - sigma_c0 / f_c - U_a, GAP, assume(CONSTANT))
        smoothing, start = assume(SMOOTHING), bearing_only().model.start[4]
        worn = Solve(u_c)(grown, smoothing)
        law = sp.Eq(rate("u_c"), M / T / (1 + odds.subs(sigma_s, sigma_c)))
        falling = Consequence(law)(self.rate, worn, largest_wear, gap, name="rate at a roughness")
        whole = sp.Integral(1 + odds, (sigma_s, sigma_c0, sigma_c))
        time = Separate(sp.Eq(f_c * M * t / T, whole))(falling, worn, start, rough, smoothing)
        return Consequence(sp.Eq(f_c * M * N, whole))(time, defined(N, t / T, "number of cycles"))

    @cached_property
    def saturating(self) -> Judgement:
        """The number of cycles at which the roughness has fallen to sigma_c, static load."""
        primitive = sigma_s - sigma_s**2 / (4 * h_star) * odds
        by_parts = Integrated(primitive, sigma_s / (2 * h_star) * odds)
        (shown,) = stated("saturating-wear")
        claim = sp.Eq(shown.lhs, shown.rhs - landau_o(sp.S.One))
        facts = self.rough[1], assume(SMOOTHING)
        return LeadingTerm(claim)(by_parts(self.cycles, *facts), *facts, name="saturating wear")

    @cached_property
    def finite(self) -> Judgement:
        """While the load closes the gap, the rate stays above a positive constant."""
        facts = (assume(OVERLAP), assume(SMOOTHING), *self.rough)
        ratio = Arithmetic(sp.Le(closure / roughness, 1 / f_c))(*facts)
        bound = Monotone(wear_rate(TANH))(ratio)
        claim = sp.Le(bound.claim.lesser, rate("u_c"))
        return Consequence(claim)(bound, self.rate, name="rate while the gap is closed")


def results() -> dict[str, Proved]:
    """Return the regimes of one solid for f_c <= 0."""
    regimes = Regimes()
    return {
        "tail": regimes.tail,
        "logarithmic-wear": regimes.logarithmic,
        "saturating-wear": regimes.saturating,
        "closed-gap": regimes.finite,
    }
