"""Averaging, order by order: the slow growth of a periodically driven quantity.

Overview
    Let ds/dtau = rho (1 + p_1(tau)/s + p_2(tau)/s^2 + ...) with periodic p_n and large s.  Then
    s = m + w_1(tau)/m + w_2(tau)/m^2 + ... with periodic w_n of zero mean, and m grows without
    oscillation: dm/dtau = rho (1 + c_1/m + c_2/m^2 + ...).  Inserting and comparing powers of
    1/m gives at each order one linear equation, dw_n/dtau + rho c_n = known: its mean is c_n,
    the rest integrates to w_n.  What is periodic is a polynomial in z = exp(2 pi i tau) and 1/z,
    of which the mean is the coefficient of z^0: no integral has to be found.
Key results
    Averaged     the c_n and w_n
    average      solves order by order
    at           a polynomial in z, in sines and cosines
References
    Sanders, Verhulst, Murdock, Averaging Methods in Nonlinear Dynamical Systems, 2007.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import sympy as sp

z = sp.Dummy("z", positive=True)
"""exp(2 pi i tau)."""

sine = (z - 1 / z) / (2 * sp.I)
"""sin(2 pi tau)."""


@dataclass(frozen=True)
class Averaged:
    """``drift[n] = c_n`` and ``oscillation[n] = w_n``; entries 0 are 1 and 0."""

    drift: tuple[sp.Expr, ...]
    oscillation: tuple[sp.Expr, ...]


def average(terms: Sequence[sp.Expr], rho: sp.Expr) -> Averaged:
    """Solve ``ds/dtau = rho sum_n terms[n]/s^n`` order by order; ``terms[0]`` is 1."""
    drift, waves = [sp.S.One], [sp.S.Zero]
    for n in range(1, len(terms)):
        powers = (term * _power(waves, -k, n - k) for k, term in enumerate(terms[: n + 1]))
        # of d(w_k/m^k)/dtau the slow part is -k w_k (dm/dtau)/m^(k + 1)
        slow = (k * waves[k] * drift[n - k - 1] for k in range(1, n))
        known = _coefficients(sp.Add(*powers, *slow))
        drift.append(known.pop(0, sp.S.Zero))
        turns = (c * z**j / (2 * sp.pi * sp.I * j) for j, c in known.items())
        waves.append(rho * sp.Add(*turns))
    return Averaged(tuple(drift), tuple(waves))


def _power(waves: Sequence[sp.Expr], power: int, order: int) -> sp.Expr:
    """Return the coefficient of 1/m^order in (s/m)^power, with s = m + w_1/m + w_2/m^2 + ..."""
    small = sp.Symbol("1/m")
    rest = sum((wave * small ** (k + 1) for k, wave in enumerate(waves)), sp.S.Zero)
    series = sum(sp.binomial(power, j) * rest**j for j in range(order // 2 + 1))
    return sp.expand(series).coeff(small, order)


def _coefficients(expr: sp.Expr) -> dict[int, sp.Expr]:
    """Return the coefficients of a polynomial in z and 1/z, by the power."""
    powers = sp.collect(sp.expand(expr), z, evaluate=False)
    return {int(p.as_base_exp()[1]) if p.has(z) else 0: c for p, c in powers.items()}


def at(expr: sp.Expr, phase: sp.Expr) -> sp.Expr:
    """Return a polynomial in z and 1/z at a phase, in sines and cosines.

    >>> at(1 + sine**2, sp.Rational(1, 4))
    2
    """
    angles = {n: 2 * sp.pi * n * phase for n in _coefficients(expr)}
    waves = {n: sp.cos(angle) + sp.I * sp.sin(angle) for n, angle in angles.items()}
    return sp.expand(sp.Add(*(c * waves[n] for n, c in _coefficients(expr).items())))
