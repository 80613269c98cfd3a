"""The note's equations as printed, transcribed once.

Nothing is derived from this module: its forms are only compared with what the derivation
yields.  Equations (1) to (6) are the hypotheses, stated in ``governing``.
"""

from __future__ import annotations

import sympy as sp

from ..symbols import initial, rate, symbols, t
from ..typeset.display import as_written

(h, h_0, U_a, U_c, u_a, u_c) = symbols("h h_0 U_a U_c u_a u_c")
(sigma, sigma_a, sigma_c, sigma_a0, sigma_c0) = symbols("sigma sigma_a sigma_c sigma_a0 sigma_c0")
(p, p_max, R_a, b, L, k, V) = symbols("p p_max R_a b L k V")
(f_a, f_c, K_a, K_c, H_a, H_c) = symbols("f_a f_c K_a K_c H_a H_c")


def _half(expr: sp.Expr) -> sp.Expr:
    return sp.Rational(1, 2) * expr


with as_written():
    EQ_7A = (sp.Eq(h, h_0 + (u_c + U_c) - (u_a + U_a)),)
    EQ_7B = (sp.Eq(p * b * L, R_a),)
    EQ_7C = (sp.Eq(U_c, p / k),)
    EQ_7D = (sp.Eq(sigma, sp.sqrt(sigma_a**2 + sigma_c**2)),)
    EQ_7E = (sp.Eq(p, _half(p_max) * (1 + sp.tanh((4 * sigma - 2 * h) / sigma))),)
    EQ_7F = (
        sp.Eq(rate("u_a"), K_a * (p * V / (3 * H_a))),
        sp.Eq(rate("sigma_a"), f_a * rate("u_a")),
        sp.Eq(rate("u_c"), K_c * (p * V / (3 * H_c))),
        sp.Eq(rate("sigma_c"), f_c * rate("u_c")),
    )
    EQ_7G = (
        sp.Eq(initial("h"), h_0),
        sp.Eq(initial("u_c"), 0),
        sp.Eq(initial("u_a"), 0),
        sp.Eq(initial("sigma_a"), sigma_a0),
        sp.Eq(initial("sigma_c"), sigma_c0),
    )

    _ROOT = sp.sqrt((sigma_a0 + f_a * u_a) ** 2 + (sigma_c0 + f_c * u_c) ** 2)
    _DEFLECTION = 3 * H_c / (k * K_c * V) * rate("u_c")
    _ARGUMENT = (4 * _ROOT - 2 * (h_0 + (u_c + _DEFLECTION) - (u_a + U_a))) / _ROOT
    EQ_8 = (
        sp.Eq(3 * H_c / (K_c * V) * rate("u_c"), _half(p_max) * (1 + sp.tanh(_ARGUMENT))),
        sp.Eq(u_a, (K_a / K_c) * (H_c / H_a) * u_c),
        sp.Eq(initial("u_c"), 0),
    )

    _ROUGHNESS = sigma_c0 + f_c * u_c
    _ARGUMENT_13 = (4 * _ROUGHNESS - 2 * (h_0 + u_c - U_a)) / _ROUGHNESS
    EQ_13 = (
        sp.Eq(3 * H_c / (K_c * V) * rate("u_c"), _half(p_max) * (1 + sp.tanh(_ARGUMENT_13))),
        sp.Eq(initial("u_c"), 0),
    )

__all__ = [name for name in dir() if name.startswith("EQ_")] + ["t"]
