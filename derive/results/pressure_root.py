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

from ..equations import Proved
from ..kernel import Judgement, infer
from ..laws import GENERAL, TANH, ContactLaw, r
from ..note.condensed import two_solids
from ..rules.algebra import Identity, substitute
from ..rules.assumption import assume
from ..rules.inequalities import Arithmetic, Lipschitz
from ..symbols import symbols
from .first_integral import UNSATURATED

p, p_max, k, sigma, U_a, u_a, u_c = symbols("p p_max k sigma U_a u_a u_c")
(h_0,) = symbols("h_0")

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


def results() -> dict[str, Proved]:
    """Return the results on the pressure of a compliant support."""
    root = PressureRoot()
    return {
        "pressure-root": root.unique,
        "pressure-iteration": (*newton(GENERAL), *curvature()),
        "rigid-limit-error": (root.softening, root.error_bound),
    }
