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
from ..rules.algebra import Insert, Solve, substitute
from ..rules.assumption import assume
from ..rules.reading import CONSTANT
from ..rules.solutions import Parametric
from ..symbols import initial, symbols, t
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
BETWEEN = tuple(
    Hypothesis(f"for the pressures in between, {h.text}", relation, kind=Kind.STATE)
    for h, relation in ((h, h.relation.subs(p, p_s)) for h in (UNSATURATED, OFF_LIMIT))
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
    def time(self) -> Judgement:
        """The time at a pressure, counted from the first pressure p(0)."""
        facts = (load_offset, assume(OFF_LIMIT), assume(SLOPED), *map(assume, BETWEEN))
        _, claim, *_ = stated("static-solution-compliant")
        return self._time(claim, self.wear, *facts)

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
        facts = (assume(UNSATURATED), assume(START))
        return self._time(sp.Eq(t, _elementary() / (2 * C)), self.wear_smooth, *facts)

    def _time(self, claim: sp.Basic, wear: Judgement, *facts: Judgement) -> Judgement:
        law, start = self.model.wear_laws[2], self.model.start[1]
        pressure, rough = bearing_only().pressure_of_bearing_wear, self.model.roughness_at_wear
        parents = (law, wear, start, pressure, rough, half_rate, assume(CONSTANT), *facts)
        return Parametric(claim)(*parents, name="time")


def _elementary() -> sp.Expr:
    """Return the integral of (p_max/p) du from p(0), where u = 0, to p, for f_c = 0."""
    odds, odds_start = (p_max - p) / p, (p_max - p_start) / p_start
    return sp.Add(
        sigma_c0 / 4 * sp.Add(odds, -odds_start, sp.log(odds), -sp.log(odds_start)),
        -(p_max / k * sp.log(p / p_start)),
    )


def results() -> dict[str, Proved]:
    """Return the static solutions on a compliant support."""
    static = StaticCompliant()
    return {
        "static-solution-compliant": (static.wear, static.time, load_offset, half_rate),
        "static-solution-compliant-smooth": (static.wear_smooth, static.time_smooth, half_rate),
    }
