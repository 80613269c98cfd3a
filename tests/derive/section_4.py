"""Expressions with the data of the note's section 4, beside numbers found independently."""

from typing import Any

import mpmath
import sympy as sp

from derive.symbols import symbol

M = 44 * sp.pi / 10**6
"""The wear (mm) of a cycle under the largest pressure."""
SECTION_4 = {
    symbol(name): sp.Rational(value)
    for name, value in {
        "f_c": "1/4", "h_0": "1.08e-3", "sigma_c0": "3.6e-4", "K_c": "1e-6", "H_c": "200",
        "p_max": "300", "U_mean": "0", "U_max": "5e-4", "U": "5e-4", "T": "0.06",
    }.items()
} | {symbol("V"): sp.Integer(22) * 2000 * sp.pi / 30}  # fmt: skip


def number(expr: sp.Expr, changed: dict[sp.Expr, Any] | None = None, **named: str) -> sp.Float:
    """Evaluate an expression with these data, some of them changed, to 40 digits."""
    data = SECTION_4 | (changed or {}) | {symbol(n): sp.Rational(v) for n, v in named.items()}
    return sp.N(expr.subs(data), 40)


def agrees(found: sp.Float, reference: str, digits: int = 30) -> bool:
    """Return whether a number has so many digits of the reference."""
    with mpmath.workdps(45):
        return bool(abs(mpmath.mpf(found) / mpmath.mpf(reference) - 1) < mpmath.mpf(10) ** -digits)
