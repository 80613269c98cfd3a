"""Calculus: integrals over time, and limits of parameters.

Key results
    Integrate    dy/dt = c dx/dt, from the initial values
    TakeLimit    a parameter tends to a point, at an instant
"""

from __future__ import annotations

import random
from dataclasses import dataclass
from typing import TYPE_CHECKING

import mpmath
import sympy as sp
from sympy.core.function import AppliedUndef

from .. import sample
from ..check import Check
from ..symbols import QUANTITIES, t
from ..zero import is_zero, same
from . import Rule, RuleError, proof

if TYPE_CHECKING:
    from ..statement import Statement


@dataclass(frozen=True)
class Integrate(Rule):
    """From ``dy/dt = c dx/dt`` with constant c, and y(0), x(0): y = y(0) + c (x - x(0))."""

    def pivot_of(self, claim: sp.Basic) -> sp.Expr | None:
        return claim.lhs

    def apply(self, parents: tuple[sp.Basic, ...]) -> sp.Basic:
        rate, *initial = parents
        y, x, factor = _proportional_rates(rate)
        start = {value.lhs: value.rhs for value in initial}
        return sp.Eq(y, (y - factor * x).subs(t, 0).subs(start) + factor * x)

    def check(self, statement: Statement) -> tuple[Check, ...]:
        return self._proof(statement), self._sample(statement)

    def _proof(self, statement: Statement) -> Check:
        """Differentiate the claim back, and look at time zero."""
        rate, *initial = (parent.claim for parent in statement.parents)
        y, x, factor = _proportional_rates(rate)
        start = {value.lhs: value.rhs for value in initial}
        claim = statement.claim
        slope = is_zero(sp.diff(claim.rhs, t) - factor * sp.diff(x, t)) and claim.lhs == y
        begin = is_zero((claim.lhs - claim.rhs).subs(t, 0).subs(start))
        return proof(slope and begin, "its derivative and its value at t = 0 agree")

    def _sample(self, statement: Statement) -> Check:
        """Integrate the parent's rate by quadrature along a random path x(t)."""
        rate, *initial = (parent.claim for parent in statement.parents)
        y, x, factor = _proportional_rates(rate)
        generator = random.Random(0)
        constants = {a: sample.draw(a, generator) for a in sorted(_constants(statement), key=str)}
        start = {v.lhs: sample.evaluate(v.rhs, constants) for v in initial}
        growth = [generator.random() for _ in range(3)]
        with mpmath.workdps(sample.DIGITS + 15):
            c = mpmath.mpf(sample.evaluate(factor, constants))
            speed = lambda s: sum(a * s**i for i, a in enumerate(growth))  # noqa: E731
            wear = mpmath.quad(speed, [0, 1])
            x_end = mpmath.mpf(start.get(x.subs(t, 0), sp.Float(0))) + wear
            y_end = mpmath.mpf(start[y.subs(t, 0)]) + c * wear
            values = {**constants, x: sp.Float(x_end, 65), y: sp.Float(y_end, 65)}
        passed = sample.holds(statement.claim, values)
        return Check("sample", passed, f"quadrature along a path, {sample.DIGITS} digits")


def _constants(statement: Statement) -> set[sp.Expr]:
    everything = sp.Tuple(statement.claim, *(parent.claim for parent in statement.parents))
    return {a for a in sample.atoms(everything) if isinstance(a, sp.Symbol) and a != t}


def _proportional_rates(claim: sp.Equality) -> tuple[sp.Expr, sp.Expr, sp.Expr]:
    """Read ``dy/dt = c dx/dt`` as (y, x, c)."""
    driving = list(claim.rhs.atoms(sp.Derivative))
    if not isinstance(claim.lhs, sp.Derivative) or len(driving) != 1:
        raise RuleError(f"{claim} is not of the form dy/dt = c dx/dt")
    factor = sp.cancel(claim.rhs / driving[0])
    if factor.atoms(AppliedUndef) or factor.has(t):
        raise RuleError(f"the factor {factor} is not constant")
    return claim.lhs.expr, driving[0].expr, factor


@dataclass(frozen=True)
class TakeLimit(Rule):
    """Let a parameter tend to a point, all else at an instant held fixed."""

    variable: sp.Symbol
    point: sp.Expr

    def pivot_of(self, claim: sp.Basic) -> sp.Expr | None:
        """A limit is a source of its own: its parents hold before it only."""
        if not isinstance(claim, sp.Equality):
            return None
        derivatives = claim.lhs.atoms(sp.Derivative) or claim.lhs.atoms(AppliedUndef)
        return next(iter(derivatives), None)

    def apply(self, parents: tuple[sp.Basic, ...]) -> sp.Basic:
        (claim,) = parents
        return claim.func(*(self._limit(side) for side in claim.args))

    def _limit(self, side: sp.Expr) -> sp.Expr:
        """Insert the point where the side is continuous there; else ask for SymPy's limit."""
        small = sp.Dummy("epsilon", positive=True)
        shifted = side.subs(self.variable, 1 / small if self.point == sp.oo else self.point + small)
        inserted = shifted.subs(small, 0)
        if not inserted.has(sp.oo, sp.zoo, sp.nan) and _continuous(inserted):
            return inserted
        return sp.limit(shifted, small, 0, "+")

    def check(self, statement: Statement) -> tuple[Check, ...]:
        again = self.apply(tuple(parent.claim for parent in statement.parents))
        return (
            proof(same(again, statement.claim), f"the limit, taken again, is {again}"),
            self._sample(statement),
        )

    def _sample(self, statement: Statement) -> Check:
        """Go towards the point in steps of 1e10; each must bring the sides as much nearer."""
        (parent,) = (p.claim for p in statement.parents)
        claim = statement.claim
        values = sample.world((), sp.Tuple(parent, claim), seed=1)
        distances, reached = [], []
        for exponent in (20, 30, 40):
            near = sp.Float(10) ** (exponent if self.point == sp.oo else -exponent)
            at = near if self.point == sp.oo else self.point + near
            there = {**values, self.variable: at}
            reached.append(f"{float(at):.0e}")
            gaps = [
                abs(sample.evaluate(a, there) - sample.evaluate(b, values))
                / max(abs(sample.evaluate(b, values)), sp.Float(10) ** -300)
                for a, b in zip(parent.args, claim.args, strict=True)
            ]
            distances.append(max(gaps))
        passed = all(
            gap < sp.Float(10) ** (-e + 15) for gap, e in zip(distances, (20, 30, 40), strict=True)
        )
        shown = ", ".join(f"{float(gap):.0e}" for gap in distances)
        known = QUANTITIES.get(self.variable.name)
        unit = f" {known.unit}" if known and known.unit != "1" else ""
        where = f"at {self.variable} = {', '.join(reached)}{unit}"
        return Check("sample", passed, f"{where} the relative distance from the limit is {shown}")


def _continuous(expr: sp.Expr) -> bool:
    """Return whether an expression is made of functions continuous where they are evaluated."""
    roots = (e for e in expr.atoms(sp.Pow) if not e.exp.is_Integer)
    known = all(
        isinstance(f, (sp.tanh, sp.exp, AppliedUndef))
        for f in expr.atoms(sp.Function, AppliedUndef)
    )
    return known and all(e.base.is_nonnegative for e in roots)
