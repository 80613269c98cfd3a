"""The pressure on a compliant support: its unique root, and the distance from a rigid one.

Overview
    With a support of stiffness k, Eq. (9) has the wear rate on both sides.  At given wear and
    load it is an equation for the pressure, p = p_max phi((g + p/k)/sigma), where g is the
    closure on an undeflected support.  Left minus right increases with p, is negative at 0 and
    positive at p_max: there is exactly one root, and it lies in between.  For a stiff support it
    tends to the rigid pressure, from below, with a distance of at most p_max^2/(k sigma).
    For the share y = p/p_max it is y = phi(a + s y), with the ratio a of closure and roughness
    on an undeflected support and its softness s.  The error of a Newton step is proportional to
    the distance of the law from its tangent, which has one sign on either side of the law's
    inflection: between bounds without an inflection the iteration crosses the root once at most,
    if a step beyond a bound is brought back to it.
Key results
    equation            the equation for p
    pressure_root       the three inequalities for existence and uniqueness of its root
    rigid_limit_error   0 <= p_rigid - p <= p_max p/(k sigma), hence (10) as a limit
    pressure_iteration  a Newton step and its error; the note's law is convex beyond
                        h = 2 sigma, concave below
"""

from __future__ import annotations

import sympy as sp

from ..hypotheses import UNSATURATED
from ..kernel import infer
from ..laws import GENERAL, TANH, r
from ..note.condensed import two_solids
from ..rules.algebra import Insert, substitute
from ..rules.assumption import assume
from ..rules.inequalities import Arithmetic, Lipschitz
from ..symbols import symbols

p, p_max, k, sigma, U_a, u_a, u_c = symbols("p p_max k sigma U_a u_a u_c")
(h_0,) = symbols("h_0")

undeflected = h_0 + u_c - u_a - U_a
"""The closure on an undeflected support, g."""

a = sp.Symbol("a", real=True)
s, x, y = sp.symbols("s x y", positive=True)
"""Softness p_max/(k sigma), a trial share of p_max, and the share at the root."""


problem = two_solids()
equation = substitute(
    problem.pressure,
    problem.closure,
    problem.deflection,
    name="equation for the pressure",
)
"""The equation that the pressure satisfies at given wear, roughness and load."""


def residual(pressure: sp.Expr) -> sp.Expr:
    """Return left minus right of that equation, at any pressure."""
    return pressure - equation.claim.rhs.subs(p, pressure)


_trial = sp.Symbol("x", real=True)
pressure_root = (
    Arithmetic(sp.Lt(residual(sp.S.Zero), 0))(equation),
    Arithmetic(sp.Gt(residual(p_max), 0))(equation),
    Arithmetic(sp.Gt(sp.diff(residual(_trial), _trial).subs(_trial, p), 0))(
        equation,
        name="one root",
        remark="a continuous, increasing function that changes sign has exactly one root",
    ),
)
"""Negative at 0, positive at p_max, increasing in between: exactly one root."""

softening = infer(
    Lipschitz(sp.Lambda(r, TANH.phi), undeflected / sigma, p / (k * sigma), p_max),
    name="softening",
    remark="the second pressure is p itself, by its equation, and p < p_max",
)
"""The rigid pressure exceeds the compliant one, by at most p_max p/(k sigma)."""

rigid_limit_error = (
    softening,
    Arithmetic(sp.Le(p_max * p / (k * sigma), p_max**2 / (k * sigma)))(
        assume(UNSATURATED), name="bound of the softening"
    ),
)
"""That distance is below p_max^2/(k sigma), which tends to 0 for k -> oo."""


# Newton's iteration for y = phi(a + s y), from a trial share x
_at_x, _at_y = GENERAL.ratio(a + s * x), GENERAL.ratio(a + s * y)
_steepness = 1 - s * sp.Subs(sp.diff(GENERAL.phi, r), r, a + s * x)
_end = x - (x - _at_x) / _steepness
_summed = (_at_x + x * (_steepness - 1)) / _steepness
_tangent = _at_x + (1 - _steepness) * (y - x)
_distance = y - _end - (y - _at_y) / _steepness
_bend = sp.diff(TANH.phi, r, 2)

pressure_iteration = (
    Insert(sp.Eq(_end, _summed))(name="step of Newton's iteration"),
    Insert(sp.Eq(_distance, (_at_y - _tangent) / _steepness))(
        name="distance from the root",
        remark="a curve lies on one side of its tangents where it is curved one way",
    ),
    Arithmetic(sp.Ge(_bend.subs(r, TANH.inflection + x), 0))(name="convex"),
    Arithmetic(sp.Le(_bend.subs(r, TANH.inflection - x), 0))(name="concave"),
)
"""A step from x without cancellation; its distance from the root y; the curvature of phi.

At the root the second term of the distance vanishes.
"""
