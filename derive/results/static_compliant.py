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
from functools import cached_property, partial

import sympy as sp

from ..equations import Equation, beyond
from ..hypotheses import Hypothesis, Kind
from ..kernel import Judgement
from ..note.condensed import bearing_only
from ..note.governing import Model
from ..rules.algebra import Insert, Solve, substitute
from ..rules.assumption import assume
from ..rules.reading import CONSTANT
from ..rules.solutions import Parametric
from ..symbols import initial, symbols, t
from ..typeset.display import as_written, over
from .first_integral import SLOPED, UNSATURATED, FirstIntegral
from .regimes import KEPT
from .static_solution import half_rate, load_offset, written_offset

h, h_0, U_a, u_c, sigma, sigma_c0, f_c = symbols("h h_0 U_a u_c sigma sigma_c0 f_c")
p, p_max, k, C, beta, p_s = symbols("p p_max k C beta p_s")
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
        return Insert(sp.Eq(u_c, _worn(p)))(*parents, name="wear at a pressure")

    @cached_property
    def time(self) -> Judgement:
        """The time at a pressure, counted from the first pressure p(0)."""
        facts = (load_offset, assume(OFF_LIMIT), assume(SLOPED), *map(assume, BETWEEN))
        return self._time(self.wear, _by_parts(), *facts)

    @cached_property
    def wear_smooth(self) -> Judgement:
        """The wear at a pressure, for f_c = 0."""
        model = self.model
        smooth = substitute(model.roughness_at_wear, assume(KEPT))
        closed = Solve(h)(FirstIntegral().log_odds)
        opened = Solve(u_c)(substitute(model.closure, model.wear_of_pin))
        parents = (opened, closed, bearing_only().deflection, smooth)
        return Insert(sp.Eq(u_c, _worn_smooth()))(*parents, name="wear, f_c = 0")

    @cached_property
    def time_smooth(self) -> Judgement:
        """The time at a pressure, for f_c = 0."""
        facts = (assume(UNSATURATED), assume(START))
        return self._time(self.wear_smooth, _elementary(), *facts)

    def _time(self, wear: Judgement, travelled: sp.Expr, *facts: Judgement) -> Judgement:
        law, start = self.model.wear_laws[2], self.model.start[1]
        claim = sp.Eq(t, travelled / (2 * C))
        parents = (law, wear, start, half_rate, assume(CONSTANT), *facts)
        return Parametric(claim)(*parents, name="time")


def _worn(at: sp.Expr) -> sp.Expr:
    """Return the wear at a pressure, for f_c != 0."""
    drop = 2 * sp.Add(beta, -(2 * at / k))
    roughness = drop / sp.Add(sp.log(at / (p_max - at)), -8, 4 / f_c)
    return sp.Add(roughness, -sigma_c0) / f_c


def _by_parts() -> sp.Expr:
    """Return the integral of (p_max/p) du from p(0), where u = 0, to p."""
    inside = p_max * _worn(p_s) / p_s**2
    with sp.evaluate(True):  # else SymPy writes an orientation, 1, into the integrand
        integral = sp.Integral(inside, (p_s, p_start, p))
    return sp.Add(p_max / p * _worn(p), integral)


def _worn_smooth() -> sp.Expr:
    """Return the wear at a pressure, for f_c = 0."""
    return sp.Add(U_a, -h_0, -(p / k), sigma_c0 / 4 * (8 - log_odds))


def _elementary() -> sp.Expr:
    """Return the integral of (p_max/p) du from p(0), where u = 0, to p, for f_c = 0."""
    odds, odds_start = (p_max - p) / p, (p_max - p_start) / p_start
    return sp.Add(
        sigma_c0 / 4 * sp.Add(odds, -odds_start, sp.log(odds), -sp.log(odds_start)),
        -(p_max / k * sp.log(p / p_start)),
    )


def equations() -> tuple[Equation, ...]:
    """Return the static solutions on a compliant support."""
    static = StaticCompliant()
    result = partial(beyond, "static load")
    size, primitive = sp.Function("S"), sp.Function("Q")
    with as_written():
        odds = sp.Add(sp.log(p_s / (p_max - p_s)), -8, 4 / f_c)
        roughness = sp.Eq(size(p_s), 2 * sp.Add(beta, -(2 * p_s / k)) / odds)
        worn, growth = sp.Add(size(p), -sigma_c0), sp.Add(size(p_s), -sigma_c0)
        inside = p_max * growth / (f_c * p_s**2)
        with sp.evaluate(True):
            integral = sp.Integral(inside, (p_s, p_start, p))
        by_parts = sp.Add((p_max * worn) / (f_c * p), integral)
        rough = (sp.Eq(u_c, over(f_c) * worn), sp.Eq(t, over(2 * C) * by_parts))
        ratio = (p_max - p_s) / p_s
        depth = sigma_c0 / 4 * sp.Add(ratio, sp.log(ratio))
        elementary = sp.Eq(primitive(p_s), sp.Add(depth, -(p_max / k * sp.log(p_s / p_max))))
        change = sp.Add(primitive(p), -primitive(p_start))
        smooth = (sp.Eq(u_c, _worn_smooth()), sp.Eq(t, over(2 * C) * change))
    title, of_slope = "wear and time at a pressure", (load_offset, half_rate)
    sloped, flat = (static.wear, static.time, *of_slope), (static.wear_smooth, static.time_smooth)
    shown = (*rough, written_offset, half_rate.relation)
    return (
        result("static-solution-compliant", title, sloped, shown, (roughness,)),
        result(
            "static-solution-compliant-smooth",
            f"{title}, f_c = 0",
            (*flat, half_rate),
            (*smooth, half_rate.relation),
            (elementary,),
        ),
    )
