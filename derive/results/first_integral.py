"""First integral: a function of pressure, roughness and load that wear leaves constant.

Overview
    Wear opens the gap and roughens the bearing in proportion, so closure and roughness stay on
    a straight line: h + U_a - U_c - sigma/f_c does not change.  With the note's contact law the
    closure is a logarithm of the pressure, and the line becomes a relation between pressure,
    roughness and load that holds at every instant, whatever the history of the load, on a
    rigid or a compliant support, if contact is not lost and f_c is not 0.
Key results
    closure_line               any contact law
    log_odds                   ln(p/(p_max - p)) = 8 - 4 h/sigma, for (4)
    first_integral_compliant   the relation for (4), with the deflection p/k
    first_integral             its limit for k -> oo
"""

from __future__ import annotations

import sympy as sp

from ..equations import stated
from ..hypotheses import RIGID, SLOPED, UNSATURATED
from ..kernel import Judgement
from ..laws import GENERAL, TANH, ContactLaw
from ..note.condensed import bearing_only
from ..rules.algebra import Insert, Solve
from ..rules.assumption import assume
from ..symbols import symbols

h, sigma = symbols("h sigma")
p, p_max, f_c = symbols("p p_max f_c")


def _line(law: ContactLaw) -> Judgement:
    """Return the line of closure and roughness, which the load shifts."""
    model = bearing_only(law)
    parents = (model.closure, model.roughness_at_wear, model.wear_of_pin)
    return Insert(*stated("closure-line"))(*parents, assume(SLOPED), name="line of closure")


closure_line = _line(GENERAL)


def log_odds_of(unsaturated: Judgement) -> Judgement:
    """Return Eq. (4) solved for the closure, where 0 < p < p_max."""
    claim = sp.Eq(sp.log(p / (p_max - p)), 8 - 4 * h / sigma)
    return Insert(claim)(bearing_only().pressure, unsaturated, name="log-odds of pressure")


log_odds = log_odds_of(assume(UNSATURATED))
"""Eq. (4) solved for the closure."""

_closure = Solve(h)(_line(TANH))

first_integral_compliant = Insert(*stated("first-integral-compliant"))(
    log_odds, _closure, bearing_only().deflection, name="first integral, compliant support"
)
"""The first integral on a support of stiffness k."""

first_integral = Insert(*stated("first-integral"))(
    log_odds, _closure, assume(RIGID), name="first integral"
)
"""The first integral on a rigid support."""
