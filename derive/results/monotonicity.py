"""Monotonicity: the sign of the effect of each datum on the wear, at every time.

Overview
    For two scalar equations du/dt = Q_1(u, t) and du/dt = Q_2(u, t) with Q_1 >= Q_2 and equal
    starts, u_1 >= u_2 for all time (comparison theorem; Q is locally Lipschitz).  So wear
    increases with a datum as long as the rate at given wear and load does: with K_c, V,
    p_max and the load U_a always, with sigma_c0 and f_c while the mean surfaces do not
    interpenetrate (h > 0); it decreases with H_c and h_0.
Key results
    increases(law, datum)    dQ/d datum >= 0
    decreases(law, datum)    dQ/d datum <= 0
References
    Walter, Ordinary Differential Equations, 1998, section 9 (comparison theorem).
"""

from __future__ import annotations

import sympy as sp

from ..hypotheses import Hypothesis
from ..kernel import Judgement
from ..laws import TANH, ContactLaw
from ..note.condensed import bearing_only
from ..rules.assumption import assume
from ..rules.inequalities import Arithmetic
from ..symbols import symbols
from .steady_state import closure, worn

h_0, U_a, sigma_c0, f_c = symbols("h_0 U_a sigma_c0 f_c")
K_c, H_c, V, p_max = symbols("K_c H_c V p_max")

APART = Hypothesis(sp.Gt(closure, 0))
"""The mean surfaces do not interpenetrate."""

INCREASING = (K_c, V, p_max, U_a, sigma_c0, f_c)
DECREASING = (H_c, h_0)
WHILE_APART = (sigma_c0, f_c)
"""Data whose effect needs h > 0."""
_SLOPE = "the derivative of the rate with respect to a datum, at given wear and load"


def effect(law: ContactLaw, datum: sp.Expr, apart: bool | None = None) -> Judgement:
    """Return the sign of the effect of a datum on the rate at given wear and load.

    ``apart``: whether to suppose h > 0; by default only for data that need it.
    """
    problem = bearing_only(law)
    facts = [problem.roughness_of_bearing, problem.rough]
    if datum in WHILE_APART if apart is None else apart:
        facts += [assume(APART), worn(problem)]
    slope = sp.diff(problem.rigid.claim.rhs, datum).doit()
    claim = (sp.Ge if datum in INCREASING else sp.Le)(slope, 0, evaluate=False)
    return Arithmetic(claim)(problem.rigid, *facts, name=f"effect of {datum}", remark=_SLOPE)


wear_increases = tuple(effect(TANH, a) for a in INCREASING if a not in WHILE_APART)
wear_increases_apart = tuple(effect(TANH, a) for a in WHILE_APART)
wear_decreases = tuple(effect(TANH, a) for a in DECREASING)
