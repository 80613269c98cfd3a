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

from ..claims import FirstZero
from ..equations import Proved
from ..hypotheses import Hypothesis
from ..kernel import Judgement
from ..rules.algebra import Identity, Insert
from ..rules.assumption import assume, defined
from ..rules.solutions import FirstRoot
from ..symbols import symbols

h_0, U_max, u_stop, q, g, p_1 = symbols("h_0 U_max u_stop q g p_1")
sigma_a0, sigma_c0 = symbols("sigma_a0 sigma_c0")

sigma_stop = sp.sqrt(sigma_a0**2 + sigma_c0**2 + 2 * p_1 * u_stop + q**2 * u_stop**2)
margin = 3 * sigma_stop - (h_0 + g * u_stop - U_max)
"""3 sigma - h at the peak of the load, as a function of the wear."""

_gap = h_0 - U_max
_half = 9 * p_1 - g * _gap
_product = 9 * (sigma_a0**2 + sigma_c0**2) - _gap**2
discriminant = _half**2 + (g**2 - 9 * q**2) * _product

LOST = Hypothesis(
    "the margin has a zero",
    sp.And(sp.Ge(discriminant, 0), sp.Gt(discriminant, _half * sp.Abs(_half))),
)
STARTS = Hypothesis("the peak of the load makes contact at the start", sp.Gt(_product, 0))
POSSIBLE = Hypothesis("the roughnesses are real", p_1**2 < q**2 * (sigma_a0**2 + sigma_c0**2))
OPENING = Hypothesis("wear opens the gap", sp.And(g > 0, _gap > 0))


@dataclass(frozen=True)
class CutoffTwoSolids:
    """Two worn solids with the cutoff."""

    @cached_property
    def convex(self) -> Judgement:
        """The second derivative of the margin."""
        second = sp.diff(margin, u_stop, 2)
        claim = sp.Eq(second, 3 * (q**2 * (sigma_a0**2 + sigma_c0**2) - p_1**2) / sigma_stop**3)
        return Identity(claim)(assume(POSSIBLE), name="curvature of the margin")

    @cached_property
    def arrest_depth(self) -> Judgement:
        """The first zero of the margin at the peak of the load."""
        wear = sp.Symbol("u", positive=True)
        at_peak = margin.subs(u_stop, wear)
        meaning = defined(u_stop, FirstZero(at_peak, wear), "first wear without margin at the peak")
        facts = tuple(map(assume, (STARTS, LOST, POSSIBLE, OPENING)))
        other = 6 * sigma_stop.subs(u_stop, wear) - at_peak
        found = FirstRoot(other)(meaning, *facts)
        claim = sp.Eq(u_stop, _product / (sp.sqrt(discriminant) - _half))
        return Insert(claim)(found, *facts, name="arrest depth")


def results() -> dict[str, Proved]:
    """Return what the cutoff brings, for two solids."""
    cut = CutoffTwoSolids()
    return {"margin-curvature": cut.convex, "arrest-depth-two-solids": cut.arrest_depth}
