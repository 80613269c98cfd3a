"""Inequalities: between reals, and from one quantity to another.

Key results
    Arithmetic          a relation that follows from facts in the reals
    Monotone            a >= b gives F(a) >= F(b) for an increasing F
    Lipschitz           -m <= F' <= 0 bounds the change of F
    LogarithmicSlope    |F'/F| <= m gives |ln(F(a)/F(b))| <= m |a - b|
    Threshold           F(x) > e if and only if x > x*, for an increasing F
"""

from __future__ import annotations

import sympy as sp

from ..claims import Equivalence, Inequality, claim_of
from ..kernel import Conclusion, Judgement, RuleError
from ..parts import nonnegative, positive
from ..reals import holds, sign
from ..zero import is_zero
from .proving import continuity, facts_of, require, require_defined, smooth
from .reading import exchanged, inequality
from .theorem import Theorem


class Arithmetic(Theorem):
    """A relation that follows from the premises in the real numbers."""

    claim: sp.Basic
    words = "This follows from {all}."
    alone = "This holds for all values in their domains."
    source = "decided by z3: Jovanovic, de Moura, Solving nonlinear arithmetic, 2012"

    def prove(self, *premises: Judgement) -> Conclusion:
        require(self.claim, *premises)
        return Conclusion(claim_of(self.claim))


class Monotone(Theorem):
    """``a >= b`` gives ``F(a) >= F(b)`` for an increasing F, ``<=`` for a decreasing one."""

    function: sp.Lambda
    words = "Apply a monotone function to both sides of {0}."
    source = "the derivative of the function has one sign between the two sides"
    premise_names = ("the bound",)

    def prove(self, *premises: Judgement) -> Conclusion:
        bound, at = inequality(premises[0]), sp.Dummy(real=True)
        value = self.function(at)
        inside = (nonnegative(at - bound.lesser), nonnegative(bound.greater - at))
        facts = facts_of(premises) | set(inside)
        open_set = continuity(value, {at})
        direction = sign(sp.diff(value, at), facts) if smooth(value) else None
        if not all(holds(goal, facts) for goal in open_set):
            direction = None
        if direction is None:
            raise RuleError(f"missing premise: {self.function} is monotone")
        high, low = self.function(bound.greater), self.function(bound.lesser)
        relation = (sp.Gt, sp.Lt) if bound.strict else (sp.Ge, sp.Le)
        return Conclusion(Inequality(relation[direction < 0](high, low, evaluate=False)))


class Lipschitz(Theorem):
    """``-1 <= F' <= 0`` everywhere gives ``0 <= c (F(a) - F(a + d)) <= c d`` for c, d >= 0."""

    function: sp.Lambda
    at: sp.Expr
    step: sp.Expr
    factor: sp.Expr
    words = "The mean value theorem, with a slope between -1 and 0."
    source = "mean value theorem"

    def prove(self, *premises: Judgement) -> Conclusion:
        y = sp.Dummy(real=True)
        value = self.function(y)
        slope = sp.diff(value, y)
        require_defined(value)
        if not smooth(value) or not all(map(holds, (nonnegative(-slope), nonnegative(1 + slope)))):
            raise RuleError(f"missing premise: -1 <= {slope} <= 0")
        for length in (self.step, self.factor):
            require(nonnegative(length), *premises)
        change = self.factor * (self.function(self.at) - self.function(self.at + self.step))
        most = self.factor * self.step
        bounds = nonnegative(change), sp.Le(change, most, evaluate=False)
        return Conclusion(claim_of(sp.And(*bounds, evaluate=False)))


class LogarithmicSlope(Theorem):
    """``|F'/F| <= m`` for F > 0 gives ``|ln(F(a)/F(b))| <= m |a - b|``."""

    function: sp.Lambda
    a: sp.Expr
    b: sp.Expr
    bound: sp.Expr
    words = (
        "The mean value theorem for the logarithm of a function; the slope of the logarithm is "
        "bounded by {bound}."
    )
    source = "mean value theorem"

    def prove(self, *premises: Judgement) -> Conclusion:
        y = sp.Dummy(real=True)
        value = self.function(y)
        require_defined(value)
        slope = sp.cancel((sp.diff(value, y) / value).rewrite(sp.exp))
        goals = (positive(value), nonnegative(self.bound - slope), nonnegative(self.bound + slope))
        if not smooth(value) or not all(holds(goal) for goal in goals):
            raise RuleError(f"missing premise: |{slope}| <= {self.bound}")
        ratio = self.function(self.a) / self.function(self.b)
        bound = self.bound * sp.Abs(self.a - self.b)
        return Conclusion(Inequality(sp.Le(sp.Abs(sp.log(ratio)), bound, evaluate=False)))


class Threshold(Theorem):
    """``F(x) > e`` if and only if ``x > x*``, where F increases and F(x*) = e.

    If x is positive by a premise, F need increase for positive numbers only, and x* is one.
    """

    claim: sp.Equivalent
    variable: sp.Expr
    alone = "What is compared with a level increases with {variable}, and equals it at the bound."
    words = f"{alone[:-1]}, by {{all}}."

    def prove(self, *premises: Judgement) -> Conclusion:
        claim = claim_of(self.claim)
        if not isinstance(claim, Equivalence):
            raise RuleError(f"missing premise: {self.claim} is an equivalence")
        demand, bound = claim.left, claim.right
        if self.variable in (demand.greater, demand.lesser):
            demand, bound = bound, demand
        function, level, point = demand.greater, demand.lesser, bound.lesser
        if bound.greater != self.variable or not (demand.strict and bound.strict):
            raise RuleError(f"missing premise: {self.claim} is strict on both sides")
        above = holds(positive(self.variable), facts_of(premises))
        any_ = sp.Dummy(positive=True) if above else sp.Dummy(real=True)
        value = exchanged(function, self.variable, any_)
        require_defined(value, *premises)
        if above:
            require(positive(point), *premises)
        slope = sp.diff(value, any_)
        if point.has(self.variable) or not smooth(value) or sign(slope, facts_of(premises)) != 1:
            raise RuleError(f"missing premise: {function} increases with {self.variable}")
        if not is_zero(value.xreplace({any_: point}) - level):
            raise RuleError(f"missing premise: the left side is {level} at {point}")
        return Conclusion(claim)
