"""Validity: the meaning of f_c > 1/8.

Overview
    The note calls (22) valid where tanh(4 - 2/f_c) > -1, "that is" f_c > 1/8.  But tanh > -1
    holds everywhere.  The asymptotic pressure increases with f_c, from 0 at f_c = 0, so that
    p_inf/p_max > epsilon is equivalent to f_c > 4/(8 + ln(1/epsilon - 1)).  f_c > 1/8 is the case
    epsilon = 1/(1 + e^24) = 3.8e-11: not a limit of validity but one of resolution, that of a
    calculation with ten digits.
Key results
    share       p_inf/p_max = 1/(1 + e^(4/f_c - 8))
    criterion   tanh(4 - 2/f_c) > -1, for f_c != 0
    share_slope the slope of the share with f_c, in terms of the share
    threshold   p_inf/p_max > epsilon if and only if f_c > 4/(8 + ln(1/epsilon - 1))
    one_eighth  the case f_c > 1/8
    RESOLUTIONS epsilon of several number formats
"""

from __future__ import annotations

from types import MappingProxyType

import sympy as sp

from ..hypotheses import ROUGHENING, SLOPED, Hypothesis
from ..kernel import Judgement
from ..rules.algebra import Insert
from ..rules.assumption import assume
from ..rules.inequalities import Arithmetic, Monotone, Threshold
from ..symbols import symbols

f_c, epsilon = symbols("f_c epsilon")

RESOLUTIONS = MappingProxyType(
    {
        "ten digits": sp.Rational(1, 4) * sp.Integer(10) ** -10,
        "double precision": sp.Integer(2) ** -55,
        "single precision": sp.Integer(2) ** -26,
    }
)
"""Half of the 1 + tanh at which a correctly rounded tanh becomes -1."""

RESOLVED = Hypothesis(epsilon < 1 / (1 + sp.exp(-8)))
"""epsilon is below the largest possible share."""

sloped = assume(SLOPED)

share = Insert(sp.Eq((1 + sp.tanh(4 - 2 / f_c)) / 2, 1 / (1 + sp.exp(4 / f_c - 8))))(
    sloped, name="share of p_max"
)
"""(22) as a share of p_max, in the form to compute with."""

criterion = Arithmetic(sp.Gt(sp.tanh(4 - 2 / f_c), -1))(sloped, name="the criterion always holds")
"""The note's criterion holds for every f_c but 0."""

_value = share.claim.rhs
share_slope = Insert(sp.Eq(sp.diff(_value, f_c), 4 / f_c**2 * _value * (1 - _value)))(
    sloped, name="slope of the share"
)
"""The slope of the share with f_c, a product of positive factors."""

bound = 4 / (8 + sp.log(1 / epsilon - 1))
"""The least f_c of a resolution epsilon."""


def _threshold(level: sp.Expr, point: sp.Expr, *facts: Judgement) -> Judgement:
    """Return that the share exceeds a level if and only if f_c exceeds a point."""
    claim = sp.Equivalent(sp.Gt(_value, level), sp.Gt(f_c, point))
    return Threshold(claim, f_c)(assume(ROUGHENING), *facts, name="threshold")


_x = sp.Dummy("x", real=True)
_rare = Arithmetic(sp.Gt(1 / epsilon - 1, sp.exp(-8)))(assume(RESOLVED))
threshold = _threshold(epsilon, bound, Monotone(sp.Lambda(_x, sp.log(_x)))(_rare))
"""A lower bound of the pressure is equivalent to one of f_c."""

one_eighth = _threshold(1 / (1 + sp.exp(24)), sp.Rational(1, 8))
"""f_c > 1/8 is equivalent to a lower bound of the asymptotic pressure."""


def threshold_at(resolution: sp.Expr) -> sp.Expr:
    """Return the least f_c whose asymptotic pressure exceeds the resolution.

    >>> round(float(threshold_at(RESOLUTIONS["double precision"])), 9)
    0.086724449
    """
    return bound.subs(epsilon, resolution)
