"""Monotonicity: in which direction each datum moves the wear, at every time.

Overview
    For two scalar equations du/dt = Q_1(u, t) and du/dt = Q_2(u, t) with Q_1 >= Q_2 and equal
    starts, u_1 >= u_2 for all time (comparison theorem; Q is locally Lipschitz).  So wear
    increases with a datum for as long as the rate at given wear and load does: with K_c, V,
    p_max and the load U_a always, with sigma_c0 and f_c while the mean surfaces do not
    interpenetrate (h > 0); it decreases with H_c and h_0.
Key results
    increases(law, datum)    dQ/d datum >= 0
    decreases(law, datum)    dQ/d datum <= 0
References
    Walter, Ordinary Differential Equations, 1998, section 9 (comparison theorem).
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from ..check import Check
from ..conditions import Condition
from ..equations import Equation
from ..laws import TANH, ContactLaw
from ..note.condensed import bearing_only
from ..rules import Authored, proof, sampled
from ..rules.sign import sign
from ..statement import Statement, inherited
from ..symbols import symbols

h_0, U_a, u_c, sigma_c0, f_c = symbols("h_0 U_a u_c sigma_c0 f_c")
K_c, H_c, V, p_max = symbols("K_c H_c V p_max")

roughness = sigma_c0 + f_c * u_c
closure = h_0 + u_c - U_a

ROUGH = Condition("the bearing is rough", sp.Gt(roughness, 0))
APART = Condition("the mean surfaces do not interpenetrate", sp.Gt(closure, 0))
WORN = Condition("there is wear", sp.Gt(u_c, 0))

INCREASING = (K_c, V, p_max, U_a, sigma_c0, f_c)
DECREASING = (H_c, h_0)
WHILE_APART = (sigma_c0, f_c)
"""Data whose effect needs h > 0."""


@dataclass(frozen=True)
class OfOneSign(Authored):
    """An authored bound of dQ/da by zero, from the rate Q of the parent.

    Proof: the derivative is taken again, closure and roughness are replaced by positive symbols
    where the conditions say that they are positive, and its sign must then be manifest.
    """

    datum: sp.Expr

    def check(self, statement: Statement) -> tuple[Check, ...]:
        (parent,) = statement.parents
        slope = _slope(parent.claim.rhs, self.datum)
        claim = statement.claim
        direction = sign(_manifest(slope, statement.conditions))
        proved = direction is not None and claim == _bound(slope, direction)
        return proof(proved, "the derivative has one sign"), sampled(statement)


def _bound(slope: sp.Expr, direction: int) -> sp.Basic:
    relation = sp.Ge if direction == 1 else sp.Le
    return relation(slope, 0, evaluate=False)


def _slope(rate: sp.Expr, datum: sp.Expr) -> sp.Expr:
    return sp.diff(rate, datum).doit()


def _manifest(slope: sp.Expr, conditions: tuple[Condition, ...]) -> sp.Expr:
    """Insert positive symbols for what the conditions make positive."""
    size, gap, wear = (sp.Dummy(name, positive=True) for name in ("sigma", "h", "u"))
    slope = slope.subs(U_a, h_0 + u_c - gap if APART in conditions else U_a)
    slope = slope.subs(sigma_c0, size - f_c * u_c).subs(u_c, wear)
    return sp.expand(slope) if APART in conditions else slope


def effect(law: ContactLaw, datum: sp.Expr) -> Statement:
    """Return the sign of the effect of a datum on the rate at given wear and load."""
    rate = bearing_only(law).rigid
    slope = _slope(rate.claim.rhs, datum)
    claim = _bound(slope, 1 if datum in INCREASING else -1)
    apart = (APART, WORN) if datum in WHILE_APART else ()
    conditions = (*inherited((rate,)), ROUGH, *apart)
    return Statement(claim, OfOneSign(datum), (rate,), conditions, name=f"effect of {datum}")


def equations() -> tuple[Equation, ...]:
    """Return the directions in which the data move the wear."""
    section = "monotonicity"
    always = tuple(effect(TANH, a) for a in INCREASING if a not in WHILE_APART)
    apart = tuple(effect(TANH, a) for a in WHILE_APART)
    falling = tuple(effect(TANH, a) for a in DECREASING)
    return (
        Equation(
            "wear-increases",
            section,
            "the rate increases with K_c, V, p_max and U_a",
            always,
            remark="that the wear follows the rate at every time is the comparison theorem",
        ),
        Equation(
            "wear-increases-apart",
            section,
            "the rate increases with sigma_c0 and f_c while h > 0",
            apart,
        ),
        Equation("wear-decreases", section, "the rate decreases with H_c and h_0", falling),
    )
