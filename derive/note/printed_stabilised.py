"""Equations (11) to (22) as printed, transcribed once and only compared with the derivation.

A dot over G is missing in (12) as printed; the transcription keeps it missing.
"""

from __future__ import annotations

import sympy as sp

from ..rules.limits import forever, later
from ..symbols import rate, symbol, symbols, t
from ..typeset.display import as_written

h_0, U_a, u_c, p_max, V, T, p_inf = symbols("h_0 U_a u_c p_max V T p_inf")
sigma_c0, f_c, K_c, H_c, u_cum, t_inf = symbols("sigma_c0 f_c K_c H_c u_cum t_inf")
G, G_inf, u_inf = symbols("G G_inf u_inf")


def at(field: str, time: sp.Expr) -> sp.Expr:
    """Return a field at another time."""
    return symbol(field).func(time)


with as_written():
    _ROUGHNESS = sigma_c0 + f_c * u_c
    _UPPER = 4 * _ROUGHNESS - 2 * sp.Add(h_0, u_c, -U_a)
    _ARGUMENT = _UPPER / _ROUGHNESS
    _RATE = 3 * H_c / (K_c * V) * rate("u_c")
    _PRESSURE = sp.Rational(1, 2) * p_max * (1 + sp.tanh(_ARGUMENT))
    _LIMIT = 4 - 2 / f_c
    _SPEED = K_c * V / (6 * H_c) * p_max * (1 + sp.tanh(_LIMIT))

    EQ_11 = (sp.Eq(forever(G - G_inf), 0),)
    EQ_12 = (sp.Eq(G_inf - at("G_inf", t + T), 0), sp.Eq(forever(G - G_inf), 0))
    EQ_14 = (sp.Eq(forever(later(rate("u_c")) - rate("u_c")), 0),)
    EQ_15 = (
        sp.Eq(forever(_RATE), forever(_PRESSURE)),
        sp.Eq(forever(later(_ARGUMENT) - _ARGUMENT), 0),
    )
    EQ_16A = (sp.Eq(forever(_RATE), forever(_PRESSURE)),)
    BRACKET = (4 * f_c - 2) * _ROUGHNESS - f_c * _UPPER
    EQ_16B = (sp.Eq(u_cum * forever(BRACKET), 0),)
    EQ_17A = EQ_16A
    EQ_17B = (sp.Eq(forever(_ARGUMENT), _LIMIT),)
    EQ_18 = (sp.Eq(forever(rate("u_c")), _SPEED),)
    EQ_19 = (sp.Eq(u_inf, _SPEED * (t - t_inf) + at("u_inf", t_inf)),)
    EQ_20 = (sp.Eq(u_cum, at("u_inf", t + T) - u_inf),)
    EQ_21 = (sp.Eq(u_cum, K_c * V * T / (6 * H_c) * p_max * (1 + sp.tanh(_LIMIT))),)
    EQ_22 = (sp.Eq(p_inf, sp.Rational(1, 2) * p_max * (1 + sp.tanh(_LIMIT))),)
