"""Averaging under a sine load: the terms of the long-time expansion.

Overview
    With s = sigma_c0 + f_c u_c the pressure is a series F(s) in 1/s with periodic coefficients.
    The formal solution of ``ds/dtau = rho F/F(oo)``, which is the equation of the roughness if rho
    is f_c u_cum, is ``s = m + w_1/m + w_2/m^2 + ...``, ``dm/dtau = rho (1 + c_1/m + ...)``.
    Premises define the names of its coefficients, and m and s_0.
Key results
    term_of              the definition of c_n or w_n, for a pressure
    OrderEquation        the equation of c_n and w_n from the terms with 1/m^n
    Averaging            c_n, the mean of its known terms, and w_n, the integral of the rest
    SlowTime             tau as a function of m, from dm/dtau
References
    Sanders, Verhulst, Murdock, Averaging Methods in Nonlinear Dynamical Systems, 2007.
"""

from __future__ import annotations

from collections.abc import Callable

import sympy as sp

from ..averaging import collected, mean, turning, z
from ..claims import Asymptotic, Drift, Equality, Oscillation, SlowEquation, Term
from ..hypotheses import LOAD, SINE, Hypothesis, Kind
from ..kernel import Conclusion, Judgement, RuleError, listed, plain
from ..parts import needs, nonzero, positive
from ..reals import LAW, holds
from ..symbols import symbol, symbols, t
from ..zero import is_zero
from .algebra import inserted
from .growth import expanded, taylor
from .proving import coefficients, continuous, facts_of, lasts
from .reading import T, clocks, constant, equality, fields, functions, require_hypothesis
from .theorem import Theorem

h_0, u_c, sigma_c0, f_c, p, U = symbols("h_0 u_c sigma_c0 f_c p U")
b_0, theta, rho, tau, m, s_0 = symbols("b_0 theta rho tau m s_0")
ORDER = 4

ROUGHNESS = sp.Symbol("s", positive=True)
"""The roughness as a variable: bound in a definition of a coefficient."""

EXPANSION = Hypothesis(SlowEquation(m, s_0), Kind.DEFINITION)
OFFSET = sp.Eq(b_0, sigma_c0 / f_c - h_0)
SATURATION = sp.Eq(theta, sp.tanh(4 - 2 / f_c))


def _coefficients(law: sp.Expr, order: int, *premises: Judgement) -> tuple[sp.Expr, ...]:
    """Return the coefficients of a law in powers of 1/roughness.

    RuleError unless it is smooth at infinity and continuous in the load, and tends to a constant
    that is not zero.  The unspecified contact law has one continuous derivative.
    """
    if order > 1 and law.has(LAW):
        raise RuleError(f"missing premise: {law} is smooth enough for order {order}")
    small = sp.Dummy("1/sigma", positive=True)
    partial = [part for part in sp.preorder_traversal(law) if needs(part)]  # before they cancel
    inside = [expanded(e.subs(ROUGHNESS, 1 / small), small) for e in (*partial, law)]
    power, inverse = inside[-1]
    if power or not all(continuous(e, {small: sp.S.Zero}, *premises) for _, e in inside):
        raise RuleError(f"missing premise: {law} is smooth at infinity")
    steady, *others = (taylor(inverse, small, n) for n in range(order + 1))
    moves = fields(steady) or clocks(steady) or steady.atoms(sp.Dummy)
    if moves or not holds(nonzero(steady), facts_of(premises)):
        raise RuleError(f"missing premise: {steady} is the limit of {law}")
    return steady, *others


def require_expansion(term: Term, *premises: Judgement) -> None:
    """Raise RuleError unless a formal solution has this coefficient.

    The law must have the period 1, be smooth at infinity and tend to a constant other than zero.
    """
    order, law, *variables = term.args
    steady = law.subs(sp.sin(2 * sp.pi * tau), sp.Dummy(real=True))
    if variables != [ROUGHNESS, tau, rho] or functions(law) or clocks(steady):
        raise RuleError(f"missing premise: {law} has the period 1")
    _coefficients(steady, int(order), *premises)


def term_of(kind: type[Term], n: int, pressure: sp.Expr) -> Term:
    """Return c_n (``Drift``) or w_n (``Oscillation``) for a pressure ``F(u_c, U_a)``.

    The wear is written in terms of the roughness, and the load is the sine at tau = t/T.
    """
    load = SINE.relation.rhs.subs(t, T * tau)
    law = pressure.subs({u_c: (ROUGHNESS - sigma_c0) / f_c, LOAD: load})
    return kind(sp.Integer(n), law, ROUGHNESS, tau, rho)


class OrderEquation(Theorem):
    """``dw_n/dtau = rho (K - c_n)``: the terms with 1/m^n, where K has terms of lower order.

    The premises give the pressure, a sine load, b_0 and theta, and name c_n and w_n, and those
    of the orders below, by definition.
    """

    order: sp.Integer
    words = (
        "Insert the expansion into ds/dtau = rho F/F(oo), with {0} for F, and with {others}, "
        "and compare the terms of order {order} in 1/m."
    )
    source = "Sanders, Verhulst, Murdock, 2007"
    premise_names = ("the pressure",)

    def prove(self, *premises: Judgement) -> Conclusion:
        given, n = equality(premises[0]), int(self.order)
        if n != self.order or n < 1:
            raise RuleError(f"missing premise: {self.order} is the number of an order")
        for relation in (SINE.relation, OFFSET, SATURATION, positive(f_c)):
            require_hypothesis(relation, *premises)
        if given.lhs != p or fields(given.rhs) - {u_c, LOAD} or clocks(given.rhs):
            raise RuleError("missing premise: the pressure at given wear and load")
        drift, waves = [sp.S.One], [sp.S.Zero]
        for k in range(1, n + 1):
            drift.append(_named(term_of(Drift, k, given.rhs), *premises))
            waves.append(_named(term_of(Oscillation, k, given.rhs), *premises))
        known = collected(_series(given.rhs, n, *premises), drift, waves, n)
        slope = sp.Derivative(waves[n], tau)
        return Conclusion(Equality(slope, rho * (known - drift[n])), gives=(slope,))


def _named(term: Term, *premises: Judgement) -> sp.Expr:
    """Return the name that a coefficient has at every time, by one of the premises."""
    for claim in (premise.claim for premise in filter(lasts, premises)):
        if isinstance(claim, Equality) and claim.rhs == term:
            return claim.lhs
    kind = type(term).__name__.lower()
    raise RuleError(f"missing premise: a name of the {kind} {term.letter}_{term.args[0]}")


def _series(pressure: sp.Expr, order: int, *premises: Judgement) -> tuple[sp.Expr, ...]:
    """Return the coefficients of 1/sigma^n in ``p/p_inf`` under U_a = U sin(2 pi tau).

    With sigma = sigma_c0 + f_c u_c and b_0 = sigma_c0/f_c - h_0 the ratio h/sigma is a
    polynomial in 1/sigma whose first coefficient is 1/f_c.
    """
    law = pressure.subs({u_c: (ROUGHNESS - sigma_c0) / f_c, h_0: sigma_c0 / f_c - b_0})
    steady, *corrections = (
        term.subs(sp.tanh(4 - 2 / f_c), theta).subs(sp.tanh(2 / f_c - 4), -theta)
        for term in _coefficients(law, order, *premises)
    )
    load = SINE.relation.rhs.subs(t, T * tau)
    return sp.S.One, *(sp.factor(sp.cancel(c / steady)).subs(LOAD, load) for c in corrections)


class Averaging(Theorem):
    """``dw/dtau = R(tau)``, where w has the period 1 and the mean 0: c_n in R, or w.

    The mean of R is 0, and so is that of every oscillation in it; the others give coefficients of
    lower order, and c_n for w_n.
    """

    claim: sp.Equality
    source = "Sanders, Verhulst, Murdock, 2007"
    premise_names = ("the equation of an order",)

    def prove(self, *premises: Judgement) -> Conclusion:
        law, (name, value) = equality(premises[0]), self.claim.args
        known = {h.relation for h in premises[0].hypotheses if h.kind is Kind.DEFINITION}
        waves = {r.lhs: sp.S.Zero for r in known if isinstance(getattr(r, "rhs", 0), Oscillation)}
        of_wave = isinstance(law.lhs, sp.Derivative) and law.lhs.variables == (tau,)
        whole = law.lhs.args[0] if of_wave else law.lhs
        if whole not in waves or value.has(*waves):
            raise RuleError(f"missing premise: {law.relation} is of an oscillation")
        rest = sp.expand(inserted(law.rhs, premises[1:]))
        if not _periodic(rest.xreplace(waves)):
            raise RuleError(f"missing premise: {rest} has the period 1")
        if name == whole:
            slope = turning(sp.diff(value, tau) - rest, tau)
            no_mean = _periodic(value) and mean(turning(value, tau)) == 0
            right = law.lhs != whole and no_mean and slope == 0
        else:
            *slopes, alone = coefficients(rest, *waves) or (tau, rest)
            average = mean(turning(alone, tau))
            right = constant(sp.Tuple(*slopes)) and is_zero(average + rho * (name - value))
        if not right:
            raise RuleError(f"missing premise: {name} = {value} by the mean of {rest}")
        return Conclusion(Equality(name, value))

    def sentence(self, *labels: str, write: Callable[[sp.Basic], str] = plain) -> str:
        known = f", with {listed(labels[1:])}" if labels[1:] else ""
        if (name := self.claim.lhs).is_Symbol:
            return f"The mean of {labels[0]} over a cycle is zero{known}: solve for {write(name)}."
        return f"Integrate {labels[0]} over the phase{known}; the mean of an oscillation is zero."


def _periodic(expr: sp.Expr) -> bool:
    """Return whether an expression is a polynomial in sines and cosines of 2 pi n tau."""
    terms = (term.as_coeff_exponent(z) for term in sp.Add.make_args(turning(expr, tau)))
    polynomial = all(power.is_Integer and not factor.has(z, tau) for factor, power in terms)
    return polynomial and not functions(expr) and clocks(expr) <= {tau}


def _definitions(law: sp.Expr) -> set[sp.Equality]:
    """Return the definitions of c_1 to c_4 as the drifts of the expansion for a law."""
    return {
        sp.Eq(symbol(f"c_{n}"), Drift(sp.Integer(n), law, ROUGHNESS, tau, rho), evaluate=False)
        for n in range(1, ORDER + 1)
    }


class SlowTime(Theorem):
    """``rho tau + s_0 = F(m) + o(m^-3)``: ``F' (1 + c_1/m + ... + c_4/m^4) = 1 + O(m^-5)``.

    s_0 is the constant of integration, so F consists of powers of m and ln(m/rho) alone.
    The premises define c_1 to c_4, all of one pressure, or rest on these definitions; another
    one defines m and s_0.
    """

    claim: sp.Equality
    words = "Divide by the drift, expand in powers of 1/m and integrate term by term, with {all}."
    source = "termwise integration of an asymptotic series"

    def prove(self, *premises: Judgement) -> Conclusion:
        known = {h.relation for premise in premises for h in premise.hypotheses}
        drifts = [symbol(f"c_{n}") for n in range(1, ORDER + 1)]
        laws = {term.args[1] for relation in known for term in relation.atoms(Drift)}
        if not any(_definitions(law) <= known for law in laws):
            names = listed(map(str, drifts))
            raise RuleError(f"missing premise: {names} are the drifts of the expansion")
        require_hypothesis(EXPANSION, *premises)
        small = sp.Dummy("1/m", positive=True)
        speed = 1 + sum((c * small**n for n, c in enumerate(drifts, 1)), sp.S.Zero)
        slope = sp.diff(self.claim.rhs, m).subs(m, 1 / small)
        large, log = sp.Dummy("m"), sp.Dummy("log")
        inside = sp.expand(self.claim.rhs.subs(sp.log(m / rho), log).subs(m, large))
        terms = (term.as_independent(large, log) for term in sp.Add.make_args(inside))
        plain = (
            constant(factor) and (part == log or (base == large and power.is_Integer))
            for factor, part in terms
            for base, power in (part.as_base_exp(),)
        )
        if not all(plain):
            raise RuleError("missing premise: the right side has powers of m, and ln(m/rho), alone")
        remainder = sp.Poly(sp.expand(slope * speed - 1), small)
        if self.claim.lhs != rho * tau + s_0 or any(n <= ORDER for (n,) in remainder.monoms()):
            raise RuleError("missing premise: dtau/dm times dm/dtau is 1 + O(m^-5)")
        return Conclusion(Asymptotic(self.claim.lhs, self.claim.rhs, m, sp.oo, m**-3))
