"""Rules that prove the terms of the long-time expansion by deriving them again.

Key results
    powers         the pressure as a series in 1/sigma, from the contact law
    Drift          c_n, from averaging the series over a sine load
    Oscillation    w_n, likewise
    SlowTime       tau(m), from dm/dtau = rho (1 + sum c_n/m^n)
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from typing import TYPE_CHECKING

import mpmath
import sympy as sp

from .. import sample
from ..check import Check
from ..rules import Authored, RuleError, proof
from ..sample import DIGITS
from ..symbols import symbol, symbols
from ..zero import is_zero
from .averaging import Averaged, average
from .harmonics import Harmonics, constant, sine, total

if TYPE_CHECKING:
    from ..statement import Statement

h_0, U_a, u_c, sigma_c0, f_c, p, U = symbols("h_0 U_a u_c sigma_c0 f_c p U")
b_0, theta, rho, tau, m = symbols("b_0 theta rho tau m")
ORDER = 4


@cache
def powers(pressure: sp.Equality, order: int) -> tuple[sp.Expr, ...]:
    """Return the coefficients of 1/sigma^n in p, from ``p = F(p/k, u_c, U_a)``.

    With sigma = sigma_c0 + f_c u_c and b_0 = sigma_c0/f_c - h_0 the ratio h/sigma is a
    polynomial in 1/sigma whose first coefficient is 1/f_c; p/k stands with 1/sigma, so that the
    coefficient of order n needs those below only.
    """
    small, unknown = sp.Dummy("1/sigma", positive=True), sp.Dummy("p")
    wear = (1 / small - sigma_c0) / f_c
    at_large = pressure.rhs.subs({p: unknown, u_c: wear, h_0: sigma_c0 / f_c - b_0})
    law = at_large.replace(lambda e: isinstance(e, sp.Function) and e.has(small), _in_lowest_terms)
    found: list[sp.Expr] = []
    for n in range(order + 1):
        so_far = sum((c * small**i for i, c in enumerate(found)), sp.S.Zero)
        slope = sp.diff(law.subs(unknown, so_far), small, n) / sp.factorial(n)
        found.append(slope.subs(small, 0).doit())
    return tuple(found)


def _in_lowest_terms(function: sp.Expr) -> sp.Expr:
    return function.func(*(sp.expand(sp.cancel(argument)) for argument in function.args))


@cache
def averaged(pressure: sp.Equality) -> Averaged:
    """Average ``dsigma/dtau = rho p/p_inf`` over U_a = U sin(2 pi tau), to order 4."""
    steady, *corrections = (
        term.subs(sp.tanh(4 - 2 / f_c), theta).subs(sp.tanh(2 / f_c - 4), -theta)
        for term in powers(pressure, ORDER)
    )
    terms = [constant(sp.S.One)]
    terms += [_under_sine(sp.cancel(term / steady)) for term in corrections]
    return average(terms, rho)


def _under_sine(polynomial: sp.Expr) -> Harmonics:
    """Insert the load into a polynomial in U_a."""
    load = sp.Dummy()
    power, terms = constant(sp.S.One), []
    for coefficient in reversed(sp.Poly(polynomial.subs(U_a, load), load).all_coeffs()):
        terms.append(power.scaled(coefficient))
        power = power * sine(U)
    return total(terms)


@dataclass(frozen=True)
class Drift(Authored):
    """An authored c_n; the first parent gives the pressure."""

    order: int

    def check(self, statement: Statement) -> tuple[Check, ...]:
        again = averaged(statement.parents[0].claim).drift[self.order]
        proved = is_zero(statement.claim.rhs - again)
        return (proof(proved, "averaged again, order by order"),)


@dataclass(frozen=True)
class Oscillation(Authored):
    """An authored w_n(tau); the first parent gives the pressure."""

    order: int

    def check(self, statement: Statement) -> tuple[Check, ...]:
        again = averaged(statement.parents[0].claim).oscillation[self.order].at(tau)
        proved = is_zero(sp.expand_trig(statement.claim.rhs) - sp.expand_trig(again))
        return (proof(proved, "averaged again, order by order"),)


@dataclass(frozen=True)
class SlowTime(Authored):
    """An authored ``rho tau + s_0 = F(m)``; the parents give c_1 to c_4, then w_1 and w_2.

    Proof: F'(m) (1 + c_1/m + ... + c_4/m^4) - 1 has no power of 1/m below the fifth.  In
    numbers, the expansion is inserted into the differential equation itself, which no step
    towards it has used: the mean residual over a cycle falls like m^-5.
    """

    def check(self, statement: Statement) -> tuple[Check, ...]:
        small = sp.Dummy("1/m", positive=True)
        drifts = [parent.claim.lhs for parent in statement.parents[:ORDER]]
        speed = 1 + sum((c * small**n for n, c in enumerate(drifts, 1)), sp.S.Zero)
        slope = sp.diff(statement.claim.rhs, m).subs(m, 1 / small)
        remainder = sp.Poly(sp.expand(slope * speed - 1), small)
        proved = all(powers[0] > ORDER for powers in remainder.monoms())
        return proof(proved, "dtau/dm times dm/dtau is 1 + O(m^-5)"), _residual(statement)


def _residual(statement: Statement) -> Check:
    """Insert the expansion into ``dsigma/dtau = rho p/p_inf`` at growing m."""
    sizes = [sp.Integer(10) ** -1 * 10**n for n in range(4)]
    with mpmath.workdps(DIGITS + 20):
        residuals = [_mean_residual(statement, mpmath.mpf(size)) for size in map(float, sizes)]
        rates = [mpmath.log10(a / b) for a, b in pairwise(residuals)]
    passed = all(abs(rate - (ORDER + 1)) < 0.05 for rate in rates[1:])
    shown = ", ".join(f"{float(rate):.3f}" for rate in rates)
    return Check("sample", passed, f"mean residual falls as m^-n with n = {shown}")


_SCENE: Mapping[sp.Expr, sp.Expr] = {
    symbol("sigma_c0"): sp.Rational(36, 100000),
    symbol("h_0"): sp.Rational(108, 100000),
    symbol("U"): sp.Rational(5, 10000),
    symbol("f_c"): sp.Rational(2, 5),
    symbol("p_max"): sp.Integer(300),
    symbol("rho"): sp.Rational(7, 10000),
}
"""Data of the size of the note's."""


def _mean_residual(statement: Statement, size: mpmath.mpf) -> mpmath.mpf:
    pressure, *definitions = (s.claim for s in statement.parents[0].parents)
    known = {**_SCENE, **{d.lhs: d.rhs.subs(_SCENE) for d in definitions}}
    terms = [s.claim.rhs.subs(known) for s in statement.parents]
    drifts = [mpmath.mpf(sp.N(c, 90)) for c in terms[:ORDER]]
    waves = terms[ORDER:]
    if len(waves) != 2:
        raise RuleError("the expansion needs w_1 and w_2")
    growth = mpmath.mpf(sp.N(known[rho], 90)) * (
        1 + sum(c / size**n for n, c in enumerate(drifts, 1))
    )
    driven = sp.lambdify((u_c, U_a), pressure.rhs.subs(_SCENE), "mpmath")
    steady = sp.N((powers(pressure, 0)[0]).subs(known), 90)
    values = [sp.lambdify(tau, w, "mpmath") for w in waves]
    slopes = [sp.lambdify(tau, sp.diff(w, tau), "mpmath") for w in waves]

    def residual(phase: mpmath.mpf) -> mpmath.mpf:
        sigma = size + sum(w(phase) / size**n for n, w in enumerate(values, 1))
        moving = growth * (1 - sum(n * w(phase) / size ** (n + 1) for n, w in enumerate(values, 1)))
        moving += sum(w(phase) / size**n for n, w in enumerate(slopes, 1))
        wear = (sigma - mpmath.mpf(_SCENE[sigma_c0])) / mpmath.mpf(_SCENE[f_c])
        load = mpmath.mpf(_SCENE[U]) * mpmath.sin(2 * mpmath.pi * phase)
        ratio = driven(wear, load) / mpmath.mpf(steady)
        return moving - mpmath.mpf(_SCENE[rho]) * ratio

    phases = 24
    return abs(sum(residual(mpmath.mpf(n) / phases) for n in range(phases)) / phases)


@dataclass(frozen=True)
class LogarithmicCoefficient(Authored):
    """An authored A = c_1/f_c; the parents give the pressure and p_inf.

    Proof: the first coefficient of the series in 1/sigma, over f_c.  In numbers: sigma times
    the relative excess of the pressure, found by iteration, at growing sigma.
    """

    def check(self, statement: Statement) -> tuple[Check, ...]:
        pressure, steady = (parent.claim for parent in statement.parents)
        zeroth, first = powers(pressure, 1)
        again = (first / zeroth / f_c).subs(b_0, sigma_c0 / f_c - h_0).subs(U_a, symbol("U_mean"))
        claimed = statement.claim.rhs.subs(steady.lhs, steady.rhs)
        proved = is_zero(claimed - again)
        detail = "the pressure, expanded again in 1/sigma, agrees"
        return proof(proved, detail), self._sample(statement)

    def _sample(self, statement: Statement) -> Check:
        pressure, steady = (sample.concrete(s.claim) for s in statement.parents)
        claimed = sample.concrete(statement.claim.rhs.subs(steady.lhs, steady.rhs)).doit()
        known = sample.satisfying((), sp.Tuple(claimed, pressure.rhs), statement.conditions, 1)[0]
        known = {**known, U_a: known[symbol("U_mean")]}
        limit = sample.evaluate(steady.rhs, known)
        distances = []
        for exponent in (10, 20, 30):
            size = sp.Float(10) ** exponent
            wear = (size - known[sigma_c0]) / known[f_c]
            found = limit
            for _ in range(8):
                found = sample.evaluate(pressure.rhs, {**known, u_c: wear, p: found})
            excess = size * (found / limit - 1) / known[f_c]
            distances.append(abs(excess / sample.evaluate(claimed, known) - 1))
        passed = all(
            d < sp.Float(10) ** (4 - e) for d, e in zip(distances, (10, 20, 30), strict=True)
        )
        shown = ", ".join(f"{float(d):.0e}" for d in distances)
        return Check(
            "sample", passed, f"at sigma = 1e10, 1e20, 1e30 mm the relative difference is {shown}"
        )
