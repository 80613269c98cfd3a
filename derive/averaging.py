"""Averaging, order by order: the slow growth of a periodically driven quantity.

Overview
    Let ds/dtau = rho (1 + p_1(tau)/s + p_2(tau)/s^2 + ...) with periodic p_n and large s.  Then
    s = m + w_1(tau)/m + w_2(tau)/m^2 + ... with periodic w_n of zero mean, and m grows without
    oscillation: dm/dtau = rho (1 + c_1/m + c_2/m^2 + ...).  Inserting and comparing powers of
    1/m gives at each order one linear equation, c_n + (dw_n/dtau)/rho = known terms: their mean
    is c_n, the rest integrates to w_n.  A periodic expression is a polynomial in
    z = exp(2 pi i tau) and 1/z, and its mean is the coefficient of z^0: no integral is needed.
Key results
    collected    the known terms at an order
    turning      a periodic expression in tau as a polynomial in z and 1/z
    mean         its mean over a cycle
References
    Sanders, Verhulst, Murdock, Averaging Methods in Nonlinear Dynamical Systems, 2007.
"""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

z = sp.Dummy("z")
"""exp(2 pi i tau), of no sign: SymPy must not decide on moduli and conditions."""


def collected(
    terms: Sequence[sp.Expr], drift: Sequence[sp.Expr], waves: Sequence[sp.Expr], n: int
) -> sp.Expr:
    """Return ``c_n + (dw_n/dtau)/rho`` from p_1 to p_n and the c and w of the orders below.

    ``terms[0]`` and ``drift[0]`` are 1, ``waves[0]`` is 0.
    """
    powers = (term * _power(waves[:n], -k, n - k) for k, term in enumerate(terms[: n + 1]))
    # the slow part of d(w_k/m^k)/dtau is -k w_k (dm/dtau)/m^(k + 1)
    slow = (k * waves[k] * drift[n - k - 1] for k in range(1, n))
    return sp.Add(*powers, *slow)


def _power(waves: Sequence[sp.Expr], power: int, order: int) -> sp.Expr:
    """Return the coefficient of 1/m^order in (s/m)^power, with s = m + w_1/m + w_2/m^2 + ..."""
    small = sp.Symbol("1/m")
    rest = sum((wave * small ** (k + 1) for k, wave in enumerate(waves)), sp.S.Zero)
    series = sum(sp.binomial(power, j) * rest**j for j in range(order // 2 + 1))
    return sp.expand(series).coeff(small, order)


def turning(expr: sp.Expr, phase: sp.Expr) -> sp.Expr:
    """Return an expression in sines and cosines of 2 pi n phase, n whole, in terms of z.

    >>> tau = sp.Symbol("tau")
    >>> turning(sp.cos(2 * sp.pi * tau) ** 2, tau) == sp.expand((z + 1 / z) ** 2 / 4)
    True
    """
    turns = expr.rewrite((sp.sin, sp.cos), sp.exp).replace(
        lambda part: isinstance(part, sp.exp) and part.has(phase),
        lambda turn: z ** sp.cancel(turn.exp / (2 * sp.pi * sp.I * phase)),
    )
    return sp.expand(turns)


def mean(expr: sp.Expr) -> sp.Expr:
    """Return the coefficient of z^0 of a polynomial in z and 1/z."""
    return expr.as_independent(z, as_Add=True)[0]
