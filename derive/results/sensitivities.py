"""Sensitivities of the asymptotic wear per cycle and pressure to the data.

Overview
    (21) is linear in K_c, V, T and p_max, inversely proportional to H_c, and depends on f_c
    through tanh(4 - 2/f_c) alone.  An elasticity is the relative change of the result per
    relative change of a datum; that of f_c is (4/f_c) (1 - y), with y = p_inf/p_max, and is
    large at a low asymptotic pressure.  Inverting (21) identifies f_c or K_c from measured
    wear; the first integral gives f_c from a pressure and the wear at one instant, after the start.
Key results
    sensitivity(...)    d u_cum/da or d p_inf/da
    elasticity(...)     the same, relative
    slope_from_wear     f_c from u_cum
    coefficient_from_wear   K_c from u_cum
    slope_from_pressure f_c from a pressure at one instant
"""

from __future__ import annotations

import sympy as sp

from ..equations import stated
from ..hypotheses import OPEN_GAP, RIGID, ROUGHENING
from ..kernel import Judgement
from ..note.condensed import bearing_only
from ..note.stabilised import pressure, wear_per_cycle
from ..rules.algebra import Insert, substitute
from ..rules.assumption import assume
from ..rules.data import DataDerivative
from ..symbols import symbols
from .compliant import CompliantSteadyState
from .first_integral import log_odds
from .regimes import largest_wear
from .steady_state import named_limit

u_cum, p_inf, p_max, K_c, H_c, V, T = symbols("u_cum p_inf p_max K_c H_c V T")
f_c, h_0, U = symbols("f_c h_0 U")
sigma_c0, M, k = symbols("sigma_c0 M k")


share = p_inf / p_max
"""The asymptotic pressure over the largest."""

POWERS = {K_c: 1, V: 1, T: 1, p_max: 1, H_c: -1}
"""Data of which u_cum is a power, and the power: its elasticity."""

WITHOUT_EFFECT = (sigma_c0, h_0, U, k)
"""Data that u_cum and p_inf do not depend on."""


def sensitivity(
    result: Judgement, parameter: sp.Symbol, value: sp.Expr, scale: sp.Expr = sp.S.One
) -> Judgement:
    """Return the judgement that ``value`` is a scale times the derivative of a result."""
    slope = sp.Derivative(result.claim.lhs, parameter, evaluate=False)
    claim = sp.Eq(scale * slope, value, evaluate=False)
    names = [pressure] if value.has(p_inf) else []
    names += [largest_wear] if value.has(M) else []
    return DataDerivative(claim, parameter)(result, *names, name="sensitivity")


def elasticity(result: Judgement, parameter: sp.Symbol, value: sp.Expr) -> Judgement:
    """Return the judgement that ``value`` is the elasticity of a result."""
    return sensitivity(result, parameter, value, parameter / result.claim.lhs)


_wear_without_effect = named_limit(u_cum, CompliantSteadyState().wear_per_cycle, "wear per cycle")
_by_share = 4 / f_c**2 * share * (1 - share)

elasticities = tuple(elasticity(wear_per_cycle, a, sp.Integer(n)) for a, n in POWERS.items())
sensitivity_slope = sensitivity(wear_per_cycle, f_c, M * _by_share)
elasticity_slope = elasticity(wear_per_cycle, f_c, 4 / f_c * (1 - share))
without_effect = tuple(sensitivity(_wear_without_effect, a, sp.S.Zero) for a in WITHOUT_EFFECT)
sensitivity_pressure = (
    sensitivity(pressure, f_c, p_max * _by_share),
    sensitivity(pressure, p_max, share),
)

_odds = sp.log(M / u_cum - 1)
slope_from_wear = Insert(sp.Eq(f_c, 4 / (8 + _odds)))(
    Insert(sp.Eq(_odds, 4 / f_c - 8))(wear_per_cycle, largest_wear),
    assume(ROUGHENING),
    name="f_c from wear per cycle",
)
"""f_c from the asymptotic wear per cycle."""

coefficient_from_wear = Insert(
    sp.Eq(K_c, 3 * H_c * u_cum / (V * T * p_max) * (1 + sp.exp(4 / f_c - 8)))
)(wear_per_cycle, name="K_c from wear per cycle")
"""K_c from the asymptotic wear per cycle."""

_model = bearing_only()
slope_from_pressure = Insert(*stated("slope-from-pressure"))(
    log_odds,
    substitute(_model.closure, _model.wear_of_pin, assume(RIGID)),
    _model.roughness_at_wear,
    assume(OPEN_GAP),
    name="f_c from a pressure",
)
"""f_c from the pressure at one instant."""
