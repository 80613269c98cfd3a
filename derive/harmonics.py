"""Trigonometric polynomials of the phase, exactly.

Overview
    A periodic load with finitely many harmonics, and everything that an expansion in 1/m makes
    of it, is a finite sum of c_n exp(2 pi i n tau).  Sums, products, means and antiderivatives
    of such sums are plain arithmetic on the coefficients: no integral has to be found.
Key results
    Harmonics    the sum, with +, *, mean and antiderivative
    sine         a load U sin(2 pi tau)
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import reduce
from types import MappingProxyType

import sympy as sp


@dataclass(frozen=True)
class Harmonics:
    """The sum of ``coefficients[n] exp(2 pi i n tau)``; zero coefficients are left out."""

    coefficients: Mapping[int, sp.Expr] = field(default_factory=dict)

    def __post_init__(self) -> None:
        expanded = {n: sp.expand(c) for n, c in self.coefficients.items()}
        kept = {n: c for n, c in sorted(expanded.items()) if c != 0}
        object.__setattr__(self, "coefficients", MappingProxyType(kept))

    def __add__(self, other: Harmonics) -> Harmonics:
        total = dict(self.coefficients)
        for n, c in other.coefficients.items():
            total[n] = total.get(n, sp.S.Zero) + c
        return Harmonics(total)

    def __mul__(self, other: Harmonics) -> Harmonics:
        total: dict[int, sp.Expr] = {}
        for n, c in self.coefficients.items():
            for k, d in other.coefficients.items():
                total[n + k] = total.get(n + k, sp.S.Zero) + c * d
        return Harmonics(total)

    def scaled(self, factor: sp.Expr) -> Harmonics:
        """Return the sum times a constant."""
        return Harmonics({n: factor * c for n, c in self.coefficients.items()})

    @property
    def mean(self) -> sp.Expr:
        """Return the mean over a period."""
        return self.coefficients.get(0, sp.S.Zero)

    @property
    def antiderivative(self) -> Harmonics:
        """Return the antiderivative, of zero mean, of the sum without its mean."""
        turned = {n: c / (2 * sp.pi * sp.I * n) for n, c in self.coefficients.items() if n}
        return Harmonics(turned)

    def at(self, phase: sp.Expr) -> sp.Expr:
        """Return the value at a phase, in sines and cosines."""
        angles = {n: 2 * sp.pi * n * phase for n in self.coefficients}
        waves = {n: sp.cos(angle) + sp.I * sp.sin(angle) for n, angle in angles.items()}
        return sp.expand(sp.Add(*(c * waves[n] for n, c in self.coefficients.items())))


def constant(value: sp.Expr) -> Harmonics:
    """Return a constant."""
    return Harmonics({0: value})


def sine(amplitude: sp.Expr) -> Harmonics:
    """Return ``amplitude sin(2 pi tau)``.

    >>> sine(sp.Symbol("U")).at(sp.Rational(1, 4))
    U
    """
    half = amplitude / (2 * sp.I)
    return Harmonics({1: half, -1: -half})


def total(terms: list[Harmonics]) -> Harmonics:
    """Return the sum of several."""
    return reduce(Harmonics.__add__, terms, Harmonics())
