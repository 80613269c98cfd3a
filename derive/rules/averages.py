"""Averaging under a sine load: the terms of the long-time expansion.

Overview
    With sigma = sigma_c0 + f_c u_c the rate is a series in 1/sigma with periodic coefficients.
    Its formal solution is ``sigma = m + w_1/m + w_2/m^2 + ...``, ``dm/dtau = rho (1 + c_1/m +
    ...)``.  That a name is one of its coefficients is a premise, by definition; that m and s_0
    belong to it, too.
Key results
    term_of              what c_n and w_n are by definition, for a pressure
    Averaging            c_n and w_n, by averaging the series again, order by order
    SlowTime             tau as a function of m, from dm/dtau
References
    Sanders, Verhulst, Murdock, Averaging Methods in Nonlinear Dynamical Systems, 2007.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import sympy as sp

from ..averaging import Averaged, at, average, sine
from ..claims import Asymptotic, Drift, Equality, Oscillation, Term
from ..hypotheses import Hypothesis, Kind
from ..kernel import Conclusion, Judgement, Rule, RuleError, listed
from ..symbols import symbol, symbols, t
from ..zero import is_zero
from .proving import require_defined
from .reading import LOAD, SINE, T, clocks, constant, equality, fields, require_hypothesis

h_0, u_c, sigma_c0, f_c, p, U = symbols("h_0 u_c sigma_c0 f_c p U")
b_0, theta, rho, tau, m, s_0 = symbols("b_0 theta rho tau m s_0")
ORDER = 4

ROUGHNESS = sp.Symbol("s", positive=True)
"""The roughness as a variable: bound in a definition of a coefficient."""

EXPANSION = Hypothesis(
    "m is the averaged roughness, dm/dtau = rho (1 + c_1/m + ...), with s_0 for its start",
    typeset=r"\mathrm{d}m / \mathrm{d}\tau = \rho \left(1 + c_1 / m + \dots\right)",
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


def term_of(kind: type[Term], n: int, pressure: sp.Expr) -> Term:
    """Return c_n (``Drift``) or w_n (``Oscillation``) for a pressure ``F(u_c, U_a)``.

    The wear is that of the roughness, and the load is the sine, at the phase tau = t/T.
    """
    load = SINE.relation.rhs.subs(t, T * tau)
    law = pressure.subs({u_c: (ROUGHNESS - sigma_c0) / f_c, LOAD: load})
    return kind(sp.Integer(n), law, ROUGHNESS, tau, rho)


def _meaning(name: sp.Expr, premises: tuple[Judgement, ...]) -> Term:
    """Return the coefficient that a name is, by one of the premises."""
    for claim in (premise.claim for premise in premises):
        if isinstance(claim, Equality) and claim.lhs == name and isinstance(claim.rhs, Term):
            return claim.rhs
    raise RuleError(f"missing premise: {name} is a coefficient of the expansion, by definition")


@cache
def averaged(pressure: sp.Expr) -> Averaged:
    """Average ``dsigma/dtau = rho p/p_inf`` over U_a = U sin(2 pi tau), to order 4."""
    steady, *corrections = (
        term.subs(sp.tanh(4 - 2 / f_c), theta).subs(sp.tanh(2 / f_c - 4), -theta)
        for term in powers(pressure, ORDER)
    )
    under_sine = (sp.cancel(term / steady).subs(LOAD, U * sine) for term in corrections)
    return average([sp.S.One, *under_sine], rho)


@dataclass(frozen=True)
class Averaging(Rule):
    """A coefficient of the expansion, for a name that a premise defines as one.

    The others give the pressure (the first), a sine load, b_0 and theta.
    """

    claim: sp.Equality
    words = "Average the rate over a cycle, order by order, with {all}."
    source = "Sanders, Verhulst, Murdock, 2007"
    asks = ("the pressure",)

    def conclude(self, *premises: Judgement) -> Conclusion:
        given, name = equality(premises[0]), self.claim.lhs
        for relation in (SINE.relation, OFFSET, SATURATION, sp.Gt(f_c, 0)):
            require_hypothesis(relation, *premises)
        if given.lhs != p or fields(given.rhs) - {u_c, LOAD} or clocks(given.rhs):
            raise RuleError("missing premise: the pressure at given wear and load")
        meaning, solved = _meaning(name, premises[1:]), averaged(given.rhs)
        known = {term_of(Drift, n, given.rhs): solved.drift[n] for n in range(1, ORDER + 1)}
        for n in (1, 2):
            known[term_of(Oscillation, n, given.rhs)] = at(solved.oscillation[n], tau)
        if meaning not in known:
            raise RuleError(f"missing premise: {name} is c_1 to c_4, w_1 or w_2 of this pressure")
        require_defined(self.claim.rhs, *premises)
        if not is_zero(sp.expand_trig(self.claim.rhs) - sp.expand_trig(known[meaning])):
            raise RuleError(f"missing premise: {name} = {known[meaning]}")
        return Conclusion(Equality(name, self.claim.rhs))


def _definitions(law: sp.Expr) -> set[sp.Equality]:
    """Return that c_1 to c_4 are the drifts of the expansion for a law."""
    return {
        sp.Eq(symbol(f"c_{n}"), Drift(sp.Integer(n), law, ROUGHNESS, tau, rho), evaluate=False)
        for n in range(1, ORDER + 1)
    }


@dataclass(frozen=True)
class SlowTime(Rule):
    """``rho tau + s_0 = F(m) + o(m^-3)``: ``F' (1 + c_1/m + ... + c_4/m^4) = 1 + O(m^-5)``.

    s_0 is the constant of integration, so F is made of powers of m and ln(m/rho) alone.
    The premises define c_1 to c_4, all of one pressure, or rest on these definitions; the others
    say what m and s_0 are.
    """

    claim: sp.Equality
    words = "Integrate the averaged drift term by term, with {all}."
    source = "termwise integration of an asymptotic series"

    def conclude(self, *premises: Judgement) -> Conclusion:
        said = {h.relation for premise in premises for h in premise.hypotheses}
        drifts = [symbol(f"c_{n}") for n in range(1, ORDER + 1)]
        laws = {term.args[1] for relation in said for term in relation.atoms(Drift)}
        if not any(_definitions(law) <= said for law in laws):
            names = listed(map(str, drifts))
            raise RuleError(f"missing premise: {names} are the drifts of the expansion")
        require_hypothesis(EXPANSION, *premises)
        require_defined(self.claim.rhs, *premises)
        small = sp.Dummy("1/m", positive=True)
        speed = 1 + sum((c * small**n for n, c in enumerate(drifts, 1)), sp.S.Zero)
        slope = sp.diff(self.claim.rhs, m).subs(m, 1 / small)
        large, log = sp.Dummy("m"), sp.Dummy("log")
        inside = sp.expand(self.claim.rhs.subs(sp.log(m / rho), log).subs(m, large))
        terms = sp.Add.make_args(inside)
        if not all(term.has(large, log) and constant(term) for term in terms) or inside.has(sp.log):
            raise RuleError("missing premise: what is added to s_0 is a function of m")
        remainder = sp.Poly(sp.expand(slope * speed - 1), small)
        if self.claim.lhs != rho * tau + s_0 or any(n <= ORDER for (n,) in remainder.monoms()):
            raise RuleError("missing premise: dtau/dm times dm/dtau is 1 + O(m^-5)")
        return Conclusion(Asymptotic(self.claim.lhs, self.claim.rhs, m, sp.oo, m**-3))
