"""Averaged expansions in numbers: the values of the coefficients c_n and w_n.

Overview
    For ``ds/dtau = rho F(s, tau)/F(oo)`` the coefficients of the powers of 1/s in F/F(oo) are
    those of a polynomial through nine values of F, very near 1/s = 0 and in many digits.  With
    ``s = m + w_1/m + ...`` and ``dm/dtau = rho (1 + c_1/m + ...)`` both sides are series in 1/m,
    with coefficients known at equal phases: at each order c_n is the mean of the known terms, w_n
    the integral of the rest.
Key results
    ExpansionTerm   a term of the expansion at time t, or a derivative of it, as an expression
    coefficients    drifts and oscillations of a law that is given as a function
References
    Sanders, Verhulst and Murdock, Averaging Methods in Nonlinear Dynamical Systems, chapter 2.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import sympy as sp
from flint import arb, fmpq, fmpq_mat
from numpy.typing import NDArray

from ..claims import Drift
from ..symbols import symbol, t

Array = NDArray[np.float64]
PHASES = 32
_NEAR, _VALUES = fmpq(1, 10**12), 9
_HARMONICS = np.fft.rfftfreq(PHASES, 1 / PHASES)


class ExpansionTerm(sp.Expr):
    """``ExpansionTerm(term, k)``: the k-th derivative, by the phase t/T, of a term."""

    is_real = True
    is_commutative = True

    @property
    def free_symbols(self) -> set[sp.Basic]:
        """Return the symbols, time only for an oscillation: a drift rests on no phase."""
        names: set[sp.Basic] = self.args[0].free_symbols
        return names - {t} if isinstance(self.args[0], Drift) else names

    def _eval_derivative(self, variable: sp.Symbol) -> sp.Expr:
        term, order = self.args
        if isinstance(term, Drift) or variable != t:
            return sp.S.Zero
        return ExpansionTerm(term, order + 1) / symbol("T")


def coefficients(law: Callable[[fmpq, fmpq], arb], rho: float, n: int) -> tuple[Array, Array]:
    """Return c_0 to c_n, and w_0 to w_n at equal phases, shape ``(n + 1, PHASES)``.

    ``law`` is F, a function of s and of the phase.
    """
    powers = _powers(law, n)
    drift, waves = np.eye(1, n + 1)[0], np.zeros((n + 1, PHASES))
    for j in range(1, n + 1):
        order = np.arange(1, n + 1)[:, None]
        size = np.concatenate((np.ones((1, PHASES)), np.zeros((1, PHASES)), waves[1:]))  # s/m
        slope = np.concatenate((size[:2], -order * waves[1:]))  # ds/dm
        inverse = _reciprocal(size)
        rest = -np.sum([drift[i] * slope[j - i] for i in range(j)], axis=0)
        power = inverse
        for k in range(1, j + 1):
            rest += powers[k] * power[j - k]
            power = _product(power, inverse)
        drift[j] = rest.mean()
        waves[j] = rho * _integrated(rest)
    return drift, waves


def _powers(law: Callable[[fmpq, fmpq], arb], n: int) -> Array:
    """Return the coefficients of the powers of 1/s in F/F(oo) at equal phases."""
    nodes = range(1, _VALUES + 1)
    inverse = fmpq_mat([[fmpq(j) ** k for k in range(_VALUES)] for j in nodes]).inv()
    rows = []
    for phase in range(PHASES):
        values = [law(1 / (j * _NEAR), fmpq(phase, PHASES)) for j in nodes]
        sums = [sum((inverse[k, j] * v for j, v in enumerate(values)), arb(0))
                for k in range(n + 1)]  # fmt: skip
        rows.append([float((a / _NEAR**k / sums[0]).mid()) for k, a in enumerate(sums)])
    return np.array(rows).T


def _product(a: Array, b: Array) -> Array:
    return np.array([sum(a[i] * b[j - i] for i in range(j + 1)) for j in range(len(a))])


def _reciprocal(series: Array) -> Array:
    """Return 1/series for a series whose first coefficient is 1."""
    inverse = np.zeros_like(series)
    inverse[0] = 1
    for j in range(1, len(series)):
        inverse[j] = -sum(series[i] * inverse[j - i] for i in range(1, j + 1))
    return inverse


def _integrated(rate: Array) -> Array:
    """Return the periodic integral, of zero mean, of a periodic function without its mean."""
    waves = np.fft.rfft(rate)
    waves[1:] /= 2j * np.pi * _HARMONICS[1:]
    waves[0] = 0
    return np.fft.irfft(waves, PHASES)


def at_phase(values: Array, phase: float, order: int) -> float:
    """Return a derivative of a periodic function at a phase, from its values at equal phases."""
    waves = np.fft.rfft(values)[:-1] / PHASES * (2j * np.pi * _HARMONICS[:-1]) ** order
    turned = waves * np.exp(2j * np.pi * _HARMONICS[:-1] * phase)
    return float(turned[0].real + 2 * turned[1:].real.sum())
