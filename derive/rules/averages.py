"""Averaging under a sine load: the terms of the long-time expansion.

Overview
    With sigma = sigma_c0 + f_c u_c the rate is a series in 1/sigma with periodic coefficients.
    What ``sigma = m + w_1/m + w_2/m^2 + ...`` and ``dm/dtau = rho (1 + c_1/m + ...)`` mean is the
    hypothesis EXPANSION: c_n and w_n are the coefficients of that formal solution.
Key results
    drift, oscillation   c_n and w_n, by averaging the series again, order by order
    slow_time            tau as a function of m, from dm/dtau
References
    Sanders, Verhulst, Murdock, Averaging Methods in Nonlinear Dynamical Systems, 2007.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import sympy as sp

from ..averaging import Averaged, average
from ..claims import Asymptotic, Equality
from ..harmonics import Harmonics, constant, sine, total
from ..hypotheses import Hypothesis, Kind
from ..kernel import Conclusion, Judgement, Rule, RuleError, infer
from ..symbols import symbol, symbols
from ..zero import is_zero
from .reading import LOAD, SINE, equality, fields, has_hypothesis

h_0, u_c, sigma_c0, f_c, p, U = symbols("h_0 u_c sigma_c0 f_c p U")
b_0, theta, rho, tau, m, s_0 = symbols("b_0 theta rho tau m s_0")
ORDER = 4

EXPANSION = Hypothesis(
    "c_n and w_n are the coefficients of the averaged roughness m and of its oscillation",
    kind=Kind.DEFINITION,
)
OFFSET = sp.Eq(b_0, sigma_c0 / f_c - h_0)
SATURATION = sp.Eq(theta, sp.tanh(4 - 2 / f_c))


@cache
def powers(pressure: sp.Expr, order: int) -> tuple[sp.Expr, ...]:
    """Return the coefficients of 1/sigma^n in a pressure ``F(u_c, U_a)``.

    With sigma = sigma_c0 + f_c u_c and b_0 = sigma_c0/f_c - h_0 the ratio h/sigma is a
    polynomial in 1/sigma whose first coefficient is 1/f_c.
    """
    small = sp.Dummy("1/sigma", positive=True)
    wear = (1 / small - sigma_c0) / f_c
    at_large = pressure.subs({u_c: wear, h_0: sigma_c0 / f_c - b_0})
    law = at_large.replace(lambda e: isinstance(e, sp.Function) and e.has(small), _in_lowest_terms)
    terms = (sp.diff(law, small, n) / sp.factorial(n) for n in range(order + 1))
    return tuple(term.subs(small, 0).doit() for term in terms)


def _in_lowest_terms(function: sp.Expr) -> sp.Expr:
    return function.func(*(sp.expand(sp.cancel(argument)) for argument in function.args))


@cache
def averaged(pressure: sp.Expr) -> Averaged:
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
    for coefficient in reversed(sp.Poly(polynomial.subs(LOAD, load), load).all_coeffs()):
        terms.append(power.scaled(coefficient))
        power = power * sine(U)
    return total(terms)


@dataclass(frozen=True)
class Averaging(Rule):
    """c_n, or w_n, of EXPANSION: the premises give the pressure, a sine load, b_0 and theta."""

    claim: sp.Equality
    words = "Average the rate over a cycle, order by order, with {all}."
    source = "Sanders, Verhulst, Murdock, 2007"

    def conclude(self, *premises: Judgement) -> Conclusion:
        given = equality(premises[0])
        for relation in (SINE.relation, OFFSET, SATURATION, sp.Gt(f_c, 0)):
            has_hypothesis(relation, *premises)
        if EXPANSION not in {h for premise in premises for h in premise.hypotheses}:
            raise RuleError(f"missing premise: {EXPANSION.text}")
        if given.lhs != p or fields(given.rhs) - {u_c, LOAD}:
            raise RuleError("missing premise: the pressure at given wear and load")
        solved, name = averaged(given.rhs), self.claim.lhs
        known = {symbol(f"c_{n}"): solved.drift[n] for n in range(1, ORDER + 1)}
        known |= {symbol(f"w_{n}"): solved.oscillation[n].at(tau) for n in (1, 2)}
        if name not in known:
            raise RuleError(f"missing premise: {name} is a coefficient of the expansion")
        if not is_zero(sp.expand_trig(self.claim.rhs) - sp.expand_trig(known[name])):
            raise RuleError(f"missing premise: {name} = {known[name]}")
        return Conclusion(Equality(name, self.claim.rhs))


def averaging(claim: sp.Equality, *premises: Judgement, name: str = "") -> Judgement:
    """State a coefficient of the averaged expansion."""
    return infer(Averaging(claim), *premises, name=name)


@dataclass(frozen=True)
class SlowTime(Rule):
    """``rho tau + s_0 = F(m) + o(m^-3)``: ``F' (1 + c_1/m + ... + c_4/m^4) = 1 + O(m^-5)``."""

    claim: sp.Equality
    words = "Integrate the averaged drift, {all}, term by term."
    source = "termwise integration of an asymptotic series"

    def conclude(self, *premises: Judgement) -> Conclusion:
        drifts = [equality(premise).lhs for premise in premises]
        if drifts != [symbol(f"c_{n}") for n in range(1, ORDER + 1)]:
            raise RuleError("missing premise: c_1 to c_4")
        small = sp.Dummy("1/m", positive=True)
        speed = 1 + sum((c * small**n for n, c in enumerate(drifts, 1)), sp.S.Zero)
        slope = sp.diff(self.claim.rhs, m).subs(m, 1 / small)
        remainder = sp.Poly(sp.expand(slope * speed - 1), small)
        if self.claim.lhs != rho * tau + s_0 or any(n <= ORDER for (n,) in remainder.monoms()):
            raise RuleError("missing premise: dtau/dm times dm/dtau is 1 + O(m^-5)")
        return Conclusion(Asymptotic(self.claim.lhs, self.claim.rhs, m, sp.oo, m**-3))


def slow_time(claim: sp.Equality, *premises: Judgement, name: str = "") -> Judgement:
    """State the time as a function of the averaged roughness."""
    return infer(SlowTime(claim), *premises, name=name)
