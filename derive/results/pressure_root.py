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
from functools import cached_property, partial

import sympy as sp

from ..equations import Equation, beyond
from ..kernel import Judgement, infer
from ..laws import GENERAL, TANH, ContactLaw, r
from ..note.condensed import two_solids
from ..rules.algebra import Identity, substitute
from ..rules.assumption import assume
from ..rules.inequalities import Arithmetic, Lipschitz
from ..symbols import symbols
from ..typeset.display import as_written, minus
from ..typeset.present import presentable
from .first_integral import UNSATURATED

p, p_max, k, sigma, U_a, u_a, u_c = symbols("p p_max k sigma U_a u_a u_c")
h_0, h_rigid = symbols("h_0 h_rigid")

undeflected = h_0 + u_c - u_a - U_a
"""The closure on an undeflected support, g."""

a = sp.Symbol("a", real=True)
s, x, y = sp.symbols("s x y", positive=True)
"""Softness p_max/(k sigma), a trial share of p_max, and the share at the root."""


@dataclass(frozen=True)
class PressureRoot:
    """The pressure on a compliant support, for one contact law."""

    law: ContactLaw = TANH

    @cached_property
    def equation(self) -> Judgement:
        """The equation that the pressure satisfies at given wear, roughness and load."""
        problem = two_solids(self.law)
        closed = substitute(problem.model.pressure, problem.model.closure, problem.deflection)
        return closed.named("equation for the pressure")

    def residual(self, pressure: sp.Expr) -> sp.Expr:
        """Left minus right of that equation, at any pressure."""
        return pressure - self.equation.claim.rhs.subs(p, pressure)

    @cached_property
    def unique(self) -> tuple[Judgement, Judgement, Judgement]:
        """Negative at 0, positive at p_max, increasing in between: exactly one root."""
        trial = sp.Symbol("x", real=True)
        slope = sp.diff(self.residual(trial), trial).subs(trial, p)
        remark = "a continuous, increasing function that changes sign has exactly one root"
        return (
            Arithmetic(sp.Lt(self.residual(sp.S.Zero), 0))(self.equation),
            Arithmetic(sp.Gt(self.residual(p_max), 0))(self.equation),
            Arithmetic(sp.Gt(slope, 0))(self.equation, name="one root", remark=remark),
        )

    @cached_property
    def softening(self) -> Judgement:
        """The rigid pressure exceeds the compliant one, by at most p_max p/(k sigma)."""
        function = sp.Lambda(r, self.law.phi)
        rule = Lipschitz(function, undeflected / sigma, p / (k * sigma), p_max)
        remark = "the second pressure is p itself, by its equation, and p < p_max"
        return infer(rule, name="softening", remark=remark)

    @cached_property
    def error_bound(self) -> Judgement:
        """That distance is below p_max^2/(k sigma), which tends to 0 for k -> oo."""
        claim = sp.Le(p_max * p / (k * sigma), p_max**2 / (k * sigma))
        return Arithmetic(claim)(assume(UNSATURATED), name="bound of the softening")


def newton(law: ContactLaw) -> tuple[Judgement, Judgement]:
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
        Identity(sp.Eq(end, summed))(name="step of Newton's iteration"),
        Identity(sp.Eq(distance, (law.ratio(a + s * y) - tangent) / steepness))(
            name="distance from the root", remark=remark
        ),
    )


def curvature() -> tuple[Judgement, Judgement]:
    """The note's law is convex where h > 2 sigma, and concave where h < 2 sigma."""
    bend = sp.diff(TANH.phi, r, 2)
    return (
        Arithmetic(sp.Ge(bend.subs(r, TANH.inflection + x), 0))(name="convex"),
        Arithmetic(sp.Le(bend.subs(r, TANH.inflection - x), 0))(name="concave"),
    )


def equations() -> tuple[Equation, ...]:
    """Return the results on the pressure of a compliant support."""
    root, result = PressureRoot(), partial(beyond, "compliant support")
    iteration, softening = (*newton(GENERAL), *curvature()), (root.softening, root.error_bound)
    (unique, softer), where = _displays()
    steps, names = _newton()
    shown = (*steps, *(presentable(statement.relation) for statement in curvature()))
    return (
        result("pressure-root", "exactly one pressure", root.unique, unique, where),
        result(
            "pressure-iteration", "Newton's iteration for the pressure", iteration, shown, names
        ),
        result("rigid-limit-error", "distance from a rigid support", softening, softer, where),
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


def _displays() -> tuple[tuple[tuple[sp.Basic, ...], ...], tuple[sp.Eq, sp.Eq]]:
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
    return (root, softening), (gap, law)
