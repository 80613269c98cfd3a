"""Static solution on a compliant support: wear and time as functions of the pressure.

Overview
    On a compliant support the pressure is an implicit function of the wear, but the wear is an
    explicit function of the pressure: the first integral, solved for the roughness.  Time then
    follows by integrating du/(du/dt) over the pressure, by parts.  For f_c != 0 one integral
    remains, of a smooth function; for f_c = 0 the solution is elementary.
Key results
    wear, time                         u_c(p) and t(p), f_c != 0
    static_solution_compliant_smooth   the same for f_c = 0
"""

from __future__ import annotations

import sympy as sp

from ..equations import stated
from ..hypotheses import CONSTANT, KEPT, SLOPED, UNSATURATED, Hypothesis
from ..kernel import Judgement
from ..note.condensed import bearing_only
from ..rules.algebra import Consequence, Insert, Solve, substitute
from ..rules.assumption import assume
from ..rules.solutions import ByParts, Separate, follows
from ..symbols import initial, rate, symbols, t
from .first_integral import first_integral_compliant, log_odds
from .static_solution import half_rate, load_offset

h, u_c, sigma, sigma_c0, f_c = symbols("h u_c sigma sigma_c0 f_c")
p, p_max, k, C, p_s = symbols("p p_max k C p_s")
p_start = initial("p")


def odds_of(pressure: sp.Expr) -> sp.Expr:
    """Return the logarithm of the odds of a pressure."""
    return sp.log(pressure / (p_max - pressure))


OFF_LIMIT = Hypothesis(sp.Ne(odds_of(p) - 8 + 4 / f_c, 0))
"""The pressure is not that of steady wear."""


model = bearing_only()
off_limit, sloped = assume(OFF_LIMIT), assume(SLOPED)

wear = Insert(stated("static-solution-compliant")[0])(
    Solve(u_c)(model.roughness_at_wear, sloped),
    Solve(sigma)(first_integral_compliant, off_limit),
    load_offset,
    off_limit,
    sloped,
    name="wear at a pressure",
)
"""The wear at a pressure."""

wear_smooth = Insert(stated("static-solution-compliant-smooth")[0])(
    Solve(u_c)(substitute(model.closure, model.wear_of_pin)),
    Solve(h)(log_odds),
    bearing_only().deflection,
    substitute(model.roughness_at_wear, assume(KEPT)),
    name="wear, f_c = 0",
)
"""The wear at a pressure, for f_c = 0."""

_rate = Consequence(sp.Eq(rate("u_c"), 2 * C * p / p_max))(
    model.wear_laws[2], half_rate, name="rate at a pressure"
)

_continuous = follows(
    model.pressure_of_bearing_wear, model.roughness_at_wear, assume(CONSTANT), name="continuity"
)
"""The pressure takes all values between the first and the present one."""


def _time(wear: Judgement, primitive: sp.Expr, rest: sp.Expr, *facts: Judgement) -> Judgement:
    """Return the time since the first pressure p(0), the integral of 2 C dt = (p_max/p) du.

    The integral is partly done by a primitive; ``rest`` is the integrand that remains.
    """
    facts = assume(UNSATURATED), _continuous, *facts
    logarithm = sp.Function("L", real=True)(p_s)
    worn = wear.claim.rhs.subs(p, p_s).subs(odds_of(p_s), logarithm)
    known = {sp.diff(logarithm, p_s): p_max / (p_s * (p_max - p_s)), logarithm: odds_of(p_s)}
    slope = p_max / p_s * sp.diff(worn, p_s).subs(known).subs(p, p_s)
    claim = sp.Eq(2 * C * t, sp.Integral(slope, (p_s, p_start, p)))
    time = Separate(claim)(_rate, wear, *facts)
    return ByParts(primitive, rest)(time, *facts, name="time")


_rough = (f_c * wear.claim.rhs + sigma_c0).subs(p, p_s)
_by_parts, _rest = p_max * _rough / (f_c * p_s), p_max * _rough / (f_c * p_s**2)
time = _time(wear, _by_parts, _rest, off_limit, sloped)
"""The time at a pressure."""

static_solution_compliant = (wear, time, load_offset, half_rate)

_odds = (p_max - p_s) / p_s
_primitive = sigma_c0 / 4 * (_odds + sp.log(_odds)) - p_max / k * sp.log(p_s / p_max)
static_solution_compliant_smooth = (
    wear_smooth,
    _time(wear_smooth, _primitive, sp.S.Zero),
    half_rate,
)
