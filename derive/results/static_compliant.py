"""Static solution on a compliant support: wear and time as functions of the pressure.

Overview
    On a compliant support the pressure is an implicit function of the wear, but the wear is an
    explicit function of the pressure: the first integral, solved for the roughness.  Time then
    follows by integrating du/(du/dt) along the pressure, by parts.  For f_c != 0 one integral
    remains, of a smooth function; for f_c = 0 everything is elementary.
Key results
    StaticCompliant.wear          u_c(p), f_c != 0
    StaticCompliant.time          t(p)
    StaticCompliant.wear_smooth   u_c(p), f_c = 0
    StaticCompliant.time_smooth   t(p)
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import sympy as sp

from ..equations import Proved, stated
from ..hypotheses import Hypothesis, Kind
from ..kernel import Judgement
from ..note.condensed import bearing_only
from ..note.governing import Model
from ..rules.algebra import Consequence, Insert, Solve, substitute
from ..rules.assumption import assume
from ..rules.reading import CONSTANT
from ..rules.solutions import Integrated, Separate
from ..symbols import initial, rate, symbols, t
from .first_integral import SLOPED, UNSATURATED, FirstIntegral
from .regimes import KEPT
from .static_solution import half_rate, load_offset

h, u_c, sigma, sigma_c0, f_c = symbols("h u_c sigma sigma_c0 f_c")
p, p_max, k, C, p_s = symbols("p p_max k C p_s")
p_start = initial("p")

log_odds = sp.log(p / (p_max - p))
START = Hypothesis("the first pressure is below p_max", sp.Lt(p_start, p_max), kind=Kind.STATE)
OFF_LIMIT = Hypothesis(
    "the pressure is not that of steady wear", sp.Ne(log_odds - 8 + 4 / f_c, 0), kind=Kind.STATE
)
BETWEEN = Hypothesis(
    "no pressure before is that of steady wear", OFF_LIMIT.relation.subs(p, p_s), kind=Kind.STATE
)


@dataclass(frozen=True)
class StaticCompliant:
    """Wear under a constant load, for the law of the note and a support of stiffness k."""

    @property
    def model(self) -> Model:
        """Bearing wear only."""
        return bearing_only().model

    @cached_property
    def wear(self) -> Judgement:
        """The wear at a pressure."""
        off, sloped = assume(OFF_LIMIT), assume(SLOPED)
        roughness = Solve(sigma)(FirstIntegral().compliant, off)
        grown = Solve(u_c)(self.model.roughness_at_wear, sloped)
        parents = (grown, roughness, load_offset, off, sloped)
        claim, *_ = stated("static-solution-compliant")
        return Insert(claim)(*parents, name="wear at a pressure")

    @cached_property
    def rate(self) -> Judgement:
        """The rate at a pressure."""
        claim = sp.Eq(rate("u_c"), 2 * C * p / p_max)
        return Consequence(claim)(self.model.wear_laws[2], half_rate, name="rate at a pressure")

    @cached_property
    def time(self) -> Judgement:
        """The time at a pressure, counted from the first pressure p(0)."""
        rough = (f_c * self.wear.claim.rhs + sigma_c0).subs(p, p_s)
        by_parts, rest = p_max * rough / (f_c * p_s), p_max * rough / (f_c * p_s**2)
        return self._integrated(self.wear, by_parts, rest, assume(BETWEEN), assume(SLOPED))

    @cached_property
    def wear_smooth(self) -> Judgement:
        """The wear at a pressure, for f_c = 0."""
        model = self.model
        smooth = substitute(model.roughness_at_wear, assume(KEPT))
        closed = Solve(h)(FirstIntegral().log_odds)
        opened = Solve(u_c)(substitute(model.closure, model.wear_of_pin))
        parents = (opened, closed, bearing_only().deflection, smooth)
        claim, *_ = stated("static-solution-compliant-smooth")
        return Insert(claim)(*parents, name="wear, f_c = 0")

    @cached_property
    def time_smooth(self) -> Judgement:
        """The time at a pressure, for f_c = 0."""
        odds = (p_max - p_s) / p_s
        primitive = sigma_c0 / 4 * (odds + sp.log(odds)) - p_max / k * sp.log(p_s / p_max)
        return self._integrated(self.wear_smooth, primitive, sp.S.Zero)

    def _integrated(
        self, wear: Judgement, primitive: sp.Expr, rest: sp.Expr, *facts: Judgement
    ) -> Judgement:
        """Return the time, 2 C dt = (p_max/p) du, integrated by means of a primitive."""
        below = assume(UNSATURATED), assume(START)
        logarithm = sp.Function("L", real=True)(p_s)
        worn = wear.claim.rhs.subs(p, p_s).subs(log_odds.subs(p, p_s), logarithm)
        known = {sp.diff(logarithm, p_s): p_max / (p_s * (p_max - p_s)), logarithm: log_odds}
        slope = p_max / p_s * sp.diff(worn, p_s).subs(known).subs(p, p_s)
        claim = sp.Eq(2 * C * t, sp.Integral(slope, (p_s, p_start, p)))
        root = bearing_only().pressure_of_bearing_wear, self.model.roughness_at_wear
        time = Separate(claim)(self.rate, wear, *root, assume(CONSTANT), *below, *facts)
        return Integrated(primitive, rest)(time, *below, *facts, name="time")


def results() -> dict[str, Proved]:
    """Return the static solutions on a compliant support."""
    static = StaticCompliant()
    return {
        "static-solution-compliant": (static.wear, static.time, load_offset, half_rate),
        "static-solution-compliant-smooth": (static.wear_smooth, static.time_smooth, half_rate),
    }
