"""Results as functions of a datum: their derivative, and the datum for a given result.

Key results
    Differentiated   the derivative of a parent with respect to a datum
    Solved           a parent solved for a datum
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import sympy as sp

from .. import sample
from ..check import Check
from ..conditions import Condition
from ..symbols import symbol
from ..zero import is_zero
from . import SAMPLES, Authored, proof
from .authored import insert

if TYPE_CHECKING:
    from ..statement import Statement

RESOLVED = Condition("160 digits resolve 1 + tanh", sp.Gt(symbol("f_c"), sp.Rational(1, 50)))
"""Where samples of the steady state are drawn: below, 1 + tanh(4 - 2/f_c) rounds to 0."""


@dataclass(frozen=True)
class Differentiated(Authored):
    """An authored relation for dy/da, the derivative of a result with respect to a datum.

    The first parent says ``y = F(a, ...)``; the others name constants of the claim.
    """

    parameter: sp.Symbol

    def check(self, statement: Statement) -> tuple[Check, ...]:
        slope = sp.diff(statement.parents[0].claim.rhs, self.parameter)
        claim = statement.claim
        rest = insert(self._with(claim.lhs - claim.rhs, slope, statement), statement.parents)
        detail = "the derivative, taken again, agrees"
        return proof(is_zero(rest), detail), self._sample(statement)

    def _with(self, expr: sp.Expr, slope: sp.Expr, statement: Statement) -> sp.Expr:
        result = statement.parents[0].claim.lhs
        return expr.xreplace({sp.Derivative(result, self.parameter, evaluate=False): slope})

    def _sample(self, statement: Statement) -> Check:
        """Compare with difference quotients, of 30 digits."""
        value, slope = statement.parents[0].claim.rhs, sp.Dummy()
        claim = self._with(statement.claim, slope, statement)
        left, right = (insert(side, statement.parents) for side in claim.args)
        everything = sp.Tuple(value, self.parameter, left, right)
        conditions = (*statement.conditions, RESOLVED)
        worlds = sample.satisfying((), everything, conditions, SAMPLES)
        passed = True
        for world in worlds:
            measured = {**world, slope: self._quotient(value, world)}
            gap = abs(sample.evaluate(left, measured) - sample.evaluate(right, measured))
            passed = passed and bool(gap <= 1e-30 * abs(sample.evaluate(right, measured)))
        return Check("sample", passed, f"{SAMPLES} points, difference quotients, 30 digits")

    def _quotient(self, value: sp.Expr, world: sample.World) -> sp.Expr:
        at, step = world[self.parameter], sp.Float(10) ** -40 * world[self.parameter]
        above = sample.evaluate(value, {**world, self.parameter: at + step})
        below = sample.evaluate(value, {**world, self.parameter: at - step})
        return (above - below) / (2 * step)


@dataclass(frozen=True)
class Solved(Authored):
    """An authored ``a = G(y, ...)``, the first parent ``y = F(a, ...)`` solved for a datum.

    Further parents name constants of the claim.  Proof: F(G(y)) = y; F is monotone in a.
    """

    def check(self, statement: Statement) -> tuple[Check, ...]:
        first, *names = statement.parents
        claim, law = statement.claim, first.claim
        back = insert(law.rhs.subs(claim.lhs, claim.rhs), tuple(names))
        proved = is_zero(back - law.lhs)
        detail = "inserted into what it solves, it gives back the result"
        return proof(proved, detail), self._sample(statement)

    def _sample(self, statement: Statement) -> Check:
        """Compute y from drawn data, and the datum from y."""
        first, *names = statement.parents
        claim, law = statement.claim, first.claim
        again = insert(claim.rhs.subs(law.lhs, law.rhs), tuple(names))
        conditions = (*statement.conditions, RESOLVED)
        worlds = sample.satisfying((), sp.Tuple(again, claim.lhs), conditions, SAMPLES)
        passed = all(
            abs(sample.evaluate(again, world) / world[claim.lhs] - 1) < 10**-sample.DIGITS
            for world in worlds
        )
        return Check("sample", passed, f"{SAMPLES} points, {sample.DIGITS} digits")
