"""Averaging, order by order: the slow growth of a periodically driven quantity.

Overview
    Let ds/dtau = rho (1 + p_1(tau)/s + p_2(tau)/s^2 + ...) with periodic p_n and large s.  Then
    s = m + w_1(tau)/m + w_2(tau)/m^2 + ... with periodic w_n of zero mean, and m grows without
    oscillation: dm/dtau = rho (1 + c_1/m + c_2/m^2 + ...).  Inserting and comparing powers of
    1/m gives at each order one linear equation, dw_n/dtau + rho c_n = known: its mean is c_n,
    the rest integrates to w_n.
Key results
    Averaged     the c_n and w_n
    average      solves order by order
References
    Sanders, Verhulst, Murdock, Averaging Methods in Nonlinear Dynamical Systems, 2007.
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from .harmonics import Harmonics, constant, total

Series = list[Harmonics]
"""A power series: coefficients of 1/m, from order 0."""


@dataclass(frozen=True)
class Averaged:
    """``drift[n] = c_n`` and ``oscillation[n] = w_n``; entries 0 are 1 and 0."""

    drift: tuple[sp.Expr, ...]
    oscillation: tuple[Harmonics, ...]


def average(terms: Series, rho: sp.Expr) -> Averaged:
    """Solve ``ds/dtau = rho sum_n terms[n](tau)/s^n`` order by order; ``terms[0]`` is 1."""
    order = len(terms) - 1
    drift, oscillation = [sp.S.One], [Harmonics()]
    for n in range(1, order + 1):
        known = _right(terms, oscillation, n) + _left(drift, oscillation, n).scaled(-1)
        drift.append(known.mean)
        oscillation.append(known.antiderivative.scaled(rho))
    return Averaged(tuple(drift), tuple(oscillation))


def _right(terms: Series, oscillation: list[Harmonics], n: int) -> Harmonics:
    """Return the coefficient of 1/m^n in ``sum_k terms[k]/s^k``."""
    size = n + 1
    ratio = [constant(sp.S.One), *(Harmonics() for _ in range(n))]  # s/m
    for k in range(1, n):
        ratio[k + 1] = oscillation[k] if k < len(oscillation) else Harmonics()
    inverse = _reciprocal(ratio)
    reciprocal = [Harmonics(), *inverse[:n]]  # 1/s
    power, sums = [constant(sp.S.One), *(Harmonics() for _ in range(n))], []
    for k in range(size):
        sums.append(terms[k] * power[n])
        power = _product(power, reciprocal)
    return total(sums)


def _left(drift: list[sp.Expr], oscillation: list[Harmonics], n: int) -> Harmonics:
    """Return what known w_k contribute to the coefficient of 1/m^n in (ds/dtau)/rho.

    d(w_k/m^k)/dtau has the slow part -k w_k (dm/dtau)/m^(k + 1).
    """
    return total(
        [oscillation[k].scaled(-k * drift[n - k - 1]) for k in range(1, min(n, len(oscillation)))]
    )


def _product(left: Series, right: Series) -> Series:
    return [
        total([left[j] * right[n - j] for j in range(n + 1)])
        for n in range(min(len(left), len(right)))
    ]


def _reciprocal(series: Series) -> Series:
    """Return 1/series for a series that begins with 1."""
    inverse = [constant(sp.S.One)]
    for n in range(1, len(series)):
        inverse.append(total([series[j] * inverse[n - j] for j in range(1, n + 1)]).scaled(-1))
    return inverse
