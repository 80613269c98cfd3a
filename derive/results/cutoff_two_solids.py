"""Cutoff with two solids: the arrest depth as the first root of a quadratic.

Overview
    The margin 3 sigma - h is convex in the wear: its second derivative is
    3 (P q^2 - p_1^2)/sigma^3, which the product of two sums of squares keeps from being negative.
    A convex margin that starts positive is lost at its first zero, if it has one, and wear
    cannot pass that depth.  At the zero 9 sigma^2 = h^2, a quadratic equation.
Key results
    convex         the second derivative of the margin
    arrest_depth   its first zero, in the form without cancellation
Remarks
    There is no arrest where the discriminant is negative or the root is not positive: for one
    solid, f_c >= 1/3.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import sympy as sp

from .. import sample
from ..check import Check
from ..conditions import Condition
from ..equations import Equation
from ..rules import Authored, proof
from ..rules.authored import Identity
from ..statement import Statement
from ..symbols import symbols
from ..typeset.display import as_written, minus
from ..zero import is_zero

h_0, U_max, u_stop, q, g, p_1 = symbols("h_0 U_max u_stop q g p_1")
sigma_a0, sigma_c0, sigma = symbols("sigma_a0 sigma_c0 sigma")

sigma_stop = sp.sqrt(sigma_a0**2 + sigma_c0**2 + 2 * p_1 * u_stop + q**2 * u_stop**2)
margin = 3 * sigma_stop - (h_0 + g * u_stop - U_max)
"""3 sigma - h at the peak of the load, as a function of the wear."""

_gap = h_0 - U_max
_half = 9 * p_1 - g * _gap
_product = 9 * (sigma_a0**2 + sigma_c0**2) - _gap**2
discriminant = _half**2 + (g**2 - 9 * q**2) * _product

LOST = Condition(
    "the margin has a zero",
    sp.And(sp.Ge(discriminant, 0), sp.Gt(discriminant, _half * sp.Abs(_half))),
)
STARTS = Condition("the peak of the load makes contact at the start", sp.Gt(_product, 0))
POSSIBLE = Condition("the roughnesses are real", p_1**2 < q**2 * (sigma_a0**2 + sigma_c0**2))
OPENING = Condition("wear opens the gap", sp.And(g > 0, _gap > 0))


@dataclass(frozen=True)
class FirstZero(Authored):
    """An authored first zero of a convex function that starts positive.

    Proof: the zero satisfies the squared equation.  The sample follows the function from the
    start to the claimed zero: it must stay positive, and vanish there to 50 digits.
    """

    function: sp.Expr
    squared: sp.Expr

    def check(self, statement: Statement) -> tuple[Check, ...]:
        claim = statement.claim
        zero = is_zero(self.squared.subs(claim.lhs, claim.rhs))
        detail = "it satisfies the squared equation"
        return proof(zero, detail), self._follow(statement)

    def _follow(self, statement: Statement) -> Check:
        claim = statement.claim
        everything = sp.Tuple(self.function.subs(claim.lhs, claim.rhs), claim.rhs)
        worlds = sample.satisfying((), everything, statement.conditions, 5)
        passed = all(self._first(statement, world) for world in worlds)
        return Check("sample", passed, "5 points, followed from the start to the zero")

    def _first(self, statement: Statement, world: sample.World) -> bool:
        wear = statement.claim.lhs
        end = sample.evaluate(statement.claim.rhs, world)
        values = [
            sample.evaluate(self.function, {**world, wear: end * share / 20}) for share in range(21)
        ]
        positive = all(value > 0 for value in values[:-1])
        return bool(end > 0 and positive and abs(values[-1]) < values[0] * sp.Float(10) ** -50)


@dataclass(frozen=True)
class CutoffTwoSolids:
    """Two worn solids with the cutoff."""

    @cached_property
    def convex(self) -> Statement:
        """The second derivative of the margin."""
        second = sp.diff(margin, u_stop, 2)
        claim = sp.Eq(second, 3 * (q**2 * (sigma_a0**2 + sigma_c0**2) - p_1**2) / sigma_stop**3)
        return Statement(claim, Identity(), (), (POSSIBLE,), name="curvature of the margin")

    @cached_property
    def arrest_depth(self) -> Statement:
        """The first zero of the margin at the peak of the load."""
        claim = sp.Eq(u_stop, _product / (sp.sqrt(discriminant) - _half))
        squared = 9 * sigma_stop**2 - (h_0 + g * u_stop - U_max) ** 2
        conditions = (STARTS, LOST, POSSIBLE, OPENING)
        rule = FirstZero(margin, squared)
        return Statement(claim, rule, (self.convex,), conditions, name="arrest depth")


def equations() -> tuple[Equation, ...]:
    """Return what the cutoff brings, for two solids."""
    cut = CutoffTwoSolids()
    section = "cutoff"
    a_0, a_1, a_2 = sp.symbols("a_0 a_1 a_2", real=True)
    with as_written():
        squares = sp.Add(sigma_a0**2, sigma_c0**2)
        stopped = sp.Add(squares, 2 * p_1 * u_stop, q**2 * u_stop**2)
        slope = sp.Add(p_1, q**2 * u_stop) ** 2 / sigma**2
        second = sp.Add(q**2, minus(slope)) * (3 / sigma)
        curved = (sp.Eq(second, 3 * sp.Add(q**2 * squares, minus(p_1**2)) / sigma**3),)
        gap = sp.Add(h_0, minus(U_max))
        root = sp.sqrt(sp.Add(a_1**2, minus(a_2 * a_0)))
        depth = (sp.Eq(u_stop, a_0 / sp.Add(root, minus(a_1))),)
        names = (
            sp.Eq(a_0, sp.Add(9 * squares, minus(gap**2))),
            sp.Eq(a_1, sp.Add(9 * p_1, minus(g * gap))),
            sp.Eq(a_2, sp.Add(9 * q**2, minus(g**2))),
        )
        where = (sp.Eq(sigma, sp.sqrt(stopped)),)
    return (
        Equation(
            "margin-curvature",
            section,
            "second derivative of the margin with respect to wear",
            (cut.convex,),
            (),
            curved,
            where=where,
        ),
        Equation(
            "arrest-depth-two-solids",
            section,
            "arrest depth, two solids",
            (cut.arrest_depth,),
            (),
            depth,
            where=names,
        ),
    )
