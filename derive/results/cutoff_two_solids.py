"""Cutoff with two solids: the arrest depth as the first root of a quadratic.

Overview
    The margin 3 sigma - h is convex in the wear: its second derivative is
    3 (P q^2 - p_1^2)/sigma^3 with P = sigma_a0^2 + sigma_c0^2, and p_1^2 <= P q^2 by the
    Cauchy-Schwarz inequality.  A convex margin that starts positive loses contact at its first
    zero if it is negative beyond, and wear cannot pass that depth.  At the zero 9 sigma^2 = h^2, a
    quadratic equation.
Key results
    margin_curvature          the curvature of the margin, in two forms
    arrest_depth_two_solids   its first zero, in the form without cancellation
Remarks
    There is no arrest where the discriminant is negative or the root is not positive: for one
    solid, f_c >= 1/3.
"""

from __future__ import annotations

import sympy as sp

from ..claims import FirstZero
from ..hypotheses import Hypothesis
from ..rules.algebra import Insert, substitute
from ..rules.assumption import assume, defined
from ..rules.solutions import FirstRoot
from ..symbols import symbols

h_0, U_max, u_stop, q, g, p_1 = symbols("h_0 U_max u_stop q g p_1")
sigma_a0, sigma_c0 = symbols("sigma_a0 sigma_c0")

sigma_stop = sp.sqrt(sigma_a0**2 + sigma_c0**2 + 2 * p_1 * u_stop + q**2 * u_stop**2)
room = 3 * sigma_stop - (h_0 + g * u_stop - U_max)
"""The margin 3 sigma - h at the peak of the load, as a function of the wear."""

_gap = h_0 - U_max
_half = 9 * p_1 - g * _gap
_product = 9 * (sigma_a0**2 + sigma_c0**2) - _gap**2
discriminant = _half**2 - (9 * q**2 - g**2) * _product

LOST = Hypothesis(sp.Gt(sp.sqrt(discriminant), _half))
"""The margin has a zero."""
STARTS = Hypothesis(sp.Gt(_product, 0))
"""The peak of the load makes contact at the start."""
POSSIBLE = Hypothesis(p_1**2 < q**2 * (sigma_a0**2 + sigma_c0**2))
OPENING = Hypothesis(sp.And(g > 0, _gap > 0))

margin_curvature = Insert(
    sp.Eq(
        sp.diff(room, u_stop, 2),
        3 * (q**2 * (sigma_a0**2 + sigma_c0**2) - p_1**2) / sigma_stop**3,
    )
)(assume(POSSIBLE), name="curvature of the margin")
"""The curvature of the margin, in two forms."""

_wear = sp.Symbol("u", positive=True)
_lost = FirstZero(room.subs(u_stop, _wear), _wear)
_smoother = 6 * sigma_stop.subs(u_stop, _wear) - _lost.args[0]
_root = FirstRoot(_lost, _smoother)(*map(assume, (STARTS, LOST, POSSIBLE, OPENING)))
arrest_depth_two_solids = substitute(
    defined(u_stop, _lost, _root),
    _root,
    name="arrest depth",
)
"""The first zero of the margin at the peak of the load."""
