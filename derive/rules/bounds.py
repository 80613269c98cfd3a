"""Bounds: rules that carry inequalities from one quantity to another, and from rates to wear.

Key results
    Monotone            a >= b gives F(a) >= F(b) for an increasing F
    Grows               du/dt >= c > 0 and u(0) = 0 give u >= c t
    LogarithmicSlope    |F'/F| <= m gives |ln(F(a)/F(b))| <= m |a - b|
    Consequence         an authored claim: the first parent, rewritten by the others
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import sympy as sp
from sympy.core.function import AppliedUndef

from ..check import Check
from ..symbols import t
from ..zero import same
from . import Authored, Pointwise, RuleError, Theorem, proof, sampled
from .sign import LAW, assume, sign

if TYPE_CHECKING:
    from ..statement import Statement


@dataclass(frozen=True)
class Monotone(Pointwise):
    """``a >= b`` gives ``F(a) >= F(b)`` for an increasing F, ``<=`` for a decreasing one."""

    function: sp.Lambda
    theorem = "the derivative of the function has one sign"

    def apply(self, parents: tuple[sp.Basic, ...]) -> sp.Basic:
        (claim,) = parents
        at = sp.Dummy(real=True)
        direction = sign(sp.diff(self.function(at), at))
        if direction is None:
            raise RuleError(f"{self.function} is not manifestly monotone")
        high, low = self.function(claim.gts), self.function(claim.lts)
        return sp.Ge(high, low) if direction > 0 else sp.Le(high, low)


@dataclass(frozen=True)
class Grows(Theorem):
    """From ``du/dt >= c`` with a positive constant c, and u(0) = 0: ``u >= c t``."""

    positive: tuple[sp.Symbol, ...] = ()
    theorem = "mean value theorem: u_c(t) - u_c(0) is t times the rate at some time in between"

    def apply(self, parents: tuple[sp.Basic, ...]) -> sp.Basic:
        bound, start = parents
        rate, least = bound.gts, bound.lts
        if not isinstance(rate, sp.Derivative) or start.lhs != rate.expr.subs(t, 0):
            raise RuleError(f"{bound} does not bound the rate of {start.lhs}")
        if (
            least.has(t)
            or least.atoms(AppliedUndef) - least.atoms(LAW)
            or sign(assume(least, self.positive)) != 1
        ):
            raise RuleError(f"{least} is not a positive constant")
        return sp.Ge(rate.expr, start.rhs + least * t)


@dataclass(frozen=True)
class LogarithmicSlope(Authored):
    """``|F'/F| <= m`` for F > 0 gives ``|ln(F(a)/F(b))| <= m |a - b|``."""

    function: sp.Lambda
    a: sp.Expr
    b: sp.Expr
    bound: sp.Expr

    def check(self, statement: Statement) -> tuple[Check, ...]:
        y = sp.Dummy(real=True)
        value = self.function(y)
        slope = sp.cancel((sp.diff(value, y) / value).rewrite(sp.exp))
        held = sign(value) == 1 and sign(self.bound - slope) == 1 and sign(self.bound + slope) == 1
        ratio = self.function(self.a) / self.function(self.b)
        said = sp.Le(sp.Abs(sp.log(ratio)), self.bound * sp.Abs(self.a - self.b))
        detail = "mean value theorem for ln phi, whose slope stays within the bound"
        return proof(held and said == statement.claim, detail), sampled(statement)


@dataclass(frozen=True)
class Consequence(Authored):
    """An authored claim that becomes its first parent when the other parents are inserted."""

    def check(self, statement: Statement) -> tuple[Check, ...]:
        first, *others = (parent.claim for parent in statement.parents)
        claim = statement.claim
        for other in others:
            claim = claim.subs(other.lhs, other.rhs)
            first = first.subs(other.lhs, other.rhs)
        detail = "the parents, inserted, turn it into the first of them"
        return proof(same(claim, first), detail), sampled(statement)
