"""The pressure on a compliant support: one root, always, and its distance from a rigid one.

Overview
    With a support of stiffness k, Eq. (9) holds the wear rate on both sides.  At given wear and
    load it is an equation for the pressure, p = p_max phi((g + p/k)/sigma), where g is the
    closure on an undeflected support.  Left minus right increases with p, is negative at 0 and
    positive at p_max: there is exactly one root, and it lies in between.  Stiffening the
    support moves it towards the rigid pressure, from below, by at most p_max^2/(k sigma).
    For the share y = p/p_max it is y = phi(a + s y), with the closure a over roughness on an
    undeflected support and its softness s.  The distance of the root from where a step of Newton's
    iteration ends is that of the law from its tangent, which has one sign on either side of the
    law's inflection: the iteration does not cross the root.
Key results
    PressureRoot.equation    the equation for p
    PressureRoot.unique      the three inequalities by which its root exists and is one
    PressureRoot.softening   0 <= p_rigid - p <= p_max p/(k sigma), hence (10) as a limit
    newton                   a step of Newton's iteration, and where it ends
    curvature                the note's law is convex beyond h = 2 sigma, concave below
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import sympy as sp

from ..check import Check
from ..conditions import Condition
from ..equations import Equation
from ..laws import GENERAL, TANH, ContactLaw, r
from ..note.condensed import two_solids
from ..rules import Authored, proof, sampled
from ..rules.authored import Identity, Positive
from ..rules.sign import sign
from ..statement import Statement
from ..symbols import symbols
from ..typeset.display import as_written, minus
from ..typeset.present import presentable

p, p_max, k, sigma, U_a, U_c, u_a, u_c = symbols("p p_max k sigma U_a U_c u_a u_c")
h_0, h_rigid = symbols("h_0 h_rigid")

undeflected = h_0 + u_c - u_a - U_a
"""The closure on an undeflected support, g."""

BELOW_SATURATION = Condition("the pressure is below its largest value", sp.Lt(p, p_max))
odds = sp.Symbol("z", positive=True)
a = sp.Symbol("a", real=True)
s, x, y = sp.symbols("s x y", positive=True)
"""Softness p_max/(k sigma), a trial share of p_max, and the share at the root."""


@dataclass(frozen=True)
class MeanValue(Authored):
    """``-1 <= phi' <= 0`` everywhere gives ``0 <= phi(a) - phi(a + d) <= d`` for d >= 0.

    The parent bounds the slope; the claim is the conclusion times a positive factor.
    """

    law: ContactLaw
    at: sp.Expr
    step: sp.Expr
    factor: sp.Expr

    def conclusion(self) -> sp.Basic:
        """Return what the theorem says of this law, these points and this factor."""
        change = self.factor * (self.law.ratio(self.at) - self.law.ratio(self.at + self.step))
        return sp.And(sp.Ge(change, 0), sp.Le(change, self.factor * self.step))

    def check(self, statement: Statement) -> tuple[Check, ...]:
        (parent,) = statement.parents
        slope = sp.diff(self.law.phi, r)
        bounded = parent.claim == sp.And(sp.Le(slope, 0), sp.Ge(slope, -1))
        signs = sign(self.factor) == 1 and sign(self.step) == 1
        passed = bounded and signs and statement.claim == self.conclusion()
        return proof(passed, "mean value theorem for phi"), sampled(statement)


@dataclass(frozen=True)
class PressureRoot:
    """The pressure on a compliant support, for one contact law."""

    law: ContactLaw = TANH

    @cached_property
    def equation(self) -> Statement:
        """The equation that the pressure satisfies at given wear, roughness and load."""
        problem = two_solids(self.law)
        closed = problem.model.pressure.substitute(problem.model.closure, problem.deflection)
        return closed.named("equation for the pressure")

    def residual(self, pressure: sp.Expr) -> sp.Expr:
        """Left minus right of that equation, at any pressure."""
        return pressure - self.equation.claim.rhs.subs(p, pressure)

    @cached_property
    def unique(self) -> tuple[Statement, Statement, Statement]:
        """Negative at 0, positive at p_max, increasing in between: exactly one root."""
        trial = sp.Symbol("x", real=True)
        slope = sp.diff(self.residual(trial), trial).subs(trial, p)
        remark = "a continuous, increasing function that changes sign has exactly one root"
        return (
            Statement(sp.Lt(self.residual(sp.S.Zero), 0), Positive(), (self.equation,)),
            Statement(sp.Gt(self.residual(p_max), 0), Positive(), (self.equation,)),
            Statement(sp.Gt(slope, 0), Positive(), (self.equation,), (), remark, "one root"),
        )

    @cached_property
    def slope_bound(self) -> Statement:
        """The contact law is nowhere steeper than -1."""
        slope = sp.diff(self.law.phi, r)
        claim = sp.And(sp.Le(slope, 0), sp.Ge(slope, -1))
        return Statement(claim, Positive(), name="steepest slope of the law")

    @cached_property
    def softening(self) -> Statement:
        """The rigid pressure exceeds the compliant one, by at most p_max p/(k sigma)."""
        rule = MeanValue(self.law, undeflected / sigma, p / (k * sigma), p_max)
        remark = "the second pressure is p itself, by its equation, and p < p_max"
        return Statement(
            rule.conclusion(), rule, (self.slope_bound,), (BELOW_SATURATION,), remark, "softening"
        )

    @cached_property
    def error_bound(self) -> Statement:
        """That distance is below p_max^2/(k sigma), which tends to 0 for k -> oo."""
        claim = sp.Le(p_max * p / (k * sigma), p_max**2 / (k * sigma))
        below = Positive(((p, p_max * odds / (1 + odds)),))
        return Statement(claim, below, (), (BELOW_SATURATION,), name="bound of the softening")


def newton(law: ContactLaw) -> tuple[Statement, Statement]:
    """A step from x in a form in which nothing cancels; the distance of its end from the root y.

    At the root the second term of the distance vanishes.
    """
    steepness = 1 - s * sp.Subs(sp.diff(law.phi, r), r, a + s * x)
    end = x - (x - law.ratio(a + s * x)) / steepness
    summed = (law.ratio(a + s * x) + x * (steepness - 1)) / steepness
    tangent = law.ratio(a + s * x) + (1 - steepness) * (y - x)
    distance = y - end - (y - law.ratio(a + s * y)) / steepness
    remark = "a curve lies on one side of its tangents where it is curved one way"
    return (
        Statement(sp.Eq(end, summed), Identity(), name="step of Newton's iteration"),
        Statement(
            sp.Eq(distance, (law.ratio(a + s * y) - tangent) / steepness),
            Identity(),
            remark=remark,
            name="distance from the root",
        ),
    )


def curvature() -> tuple[Statement, Statement]:
    """The note's law is convex where h > 2 sigma, and concave where h < 2 sigma."""
    bend = sp.diff(TANH.phi, r, 2)
    beyond = Positive(((x, sp.atanh(odds / (1 + odds)) / 2),))
    return (
        Statement(sp.Ge(bend.subs(r, TANH.inflection + x), 0), beyond, name="convex"),
        Statement(sp.Le(bend.subs(r, TANH.inflection - x), 0), beyond, name="concave"),
    )


def equations() -> tuple[Equation, ...]:
    """Return the results on the pressure of a compliant support."""
    root, shown = PressureRoot(), _displays()
    section = "compliant support"
    steps, names = _newton()
    return (
        Equation(
            "pressure-root",
            section,
            "exactly one pressure",
            root.unique,
            (),
            shown["root"],
            where=shown["where"],
        ),
        Equation(
            "pressure-iteration",
            section,
            "Newton's iteration for the pressure",
            (*newton(GENERAL), *curvature()),
            (),
            (*steps, *(presentable(statement.claim) for statement in curvature())),
            where=names,
        ),
        Equation(
            "rigid-limit-error",
            section,
            "distance from a rigid support",
            (root.softening, root.error_bound),
            (),
            shown["softening"],
            where=shown["where"],
        ),
    )


def _newton() -> tuple[tuple[sp.Eq, sp.Eq], tuple[sp.Eq, sp.Eq, sp.Eq]]:
    """Return the step of Newton's iteration to be read, and its abbreviations."""
    below = sp.Symbol("D", positive=True)
    near, there = GENERAL.ratio(a + s * x), GENERAL.ratio(a + s * y)
    slope = sp.Subs(sp.diff(GENERAL.phi, r), r, a + s * x)
    at_x, at_y = sp.symbols("phi_x phi_y", positive=True)
    with as_written():
        step = sp.Add(x, minus(sp.Add(x, -at_x) / below))
        end = sp.Add(at_x, minus(s * x * slope)) / below
        distance = sp.Add(y, -x, sp.Add(x, -at_x) / below, minus(sp.Add(y, -at_y) / below))
        bent = sp.Add(at_y, -at_x, minus(s * sp.Add(y, -x) * slope)) / below
        steepness = sp.Eq(below, sp.Add(1, minus(s * slope)))
    names = (steepness, sp.Eq(at_x, near), sp.Eq(at_y, there))
    return (sp.Eq(step, end), sp.Eq(distance, bent)), names


def _displays() -> dict[str, tuple[sp.Basic, ...]]:
    """Return the forms to be read, for the law of the note, and their abbreviations."""
    phi = sp.Function("phi")
    with as_written():
        gap = sp.Eq(h_rigid, h_0 + u_c - u_a - U_a)
        law = sp.Eq(phi(r), sp.Rational(1, 2) * (1 + sp.tanh(sp.Add(4, minus(2 * r)))))
        rigid, full, soft = (x / sigma for x in (h_rigid, h_rigid + p_max / k, h_rigid + p / k))
        slope = sp.Subs(sp.Derivative(phi(r), r), r, soft)
        root = (
            sp.Lt(-(p_max * phi(rigid)), 0),
            sp.Gt(p_max - p_max * phi(full), 0),
            sp.Gt(1 - p_max / (k * sigma) * slope, 0),
        )
        change = sp.Add(p_max * phi(rigid), minus(p_max * phi(soft)))
        bound = p_max / (k * sigma) * p
        softening = (
            sp.And(sp.Ge(change, 0), sp.Le(change, bound)),
            sp.Le(bound, p_max**2 / (k * sigma)),
        )
    return {"root": root, "softening": softening, "where": (gap, law)}
