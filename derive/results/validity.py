"""Validity: what f_c > 1/8 means.

Overview
    The note calls (22) valid where tanh(4 - 2/f_c) > -1, "that is" f_c > 1/8.  But tanh > -1
    holds everywhere.  The asymptotic pressure grows with f_c > 0 from 0 on, so that a demand
    p_inf/p_max > epsilon is a demand f_c > 4/(8 + ln(1/epsilon - 1)).  f_c > 1/8 is the case
    epsilon = 1/(1 + e^24) = 3.8e-11: not a limit of validity but one of resolution, that of a
    calculation with ten digits.
Key results
    share       p_inf/p_max = 1/(1 + e^(4/f_c - 8))
    always      tanh(4 - 2/f_c) > -1, without condition
    growing     d/df_c of it is positive
    threshold   p_inf/p_max > epsilon if and only if f_c > 4/(8 + ln(1/epsilon - 1))
    eighth      the case f_c > 1/8
    RESOLUTIONS the epsilon of some arithmetics
"""

from __future__ import annotations

from types import MappingProxyType

import sympy as sp

from ..equations import Proved
from ..hypotheses import Hypothesis
from ..kernel import Judgement
from ..rules.algebra import Identity, discharge, forget, substitute
from ..rules.assumption import assume
from ..rules.inequalities import Arithmetic, Monotone, Threshold
from ..symbols import symbols
from .first_integral import SLOPED
from .steady_state import ROUGHENING

f_c, epsilon = symbols("f_c epsilon")

RESOLUTIONS = MappingProxyType(
    {
        "ten digits": sp.Rational(1, 4) * sp.Integer(10) ** -10,
        "double precision": sp.Integer(2) ** -55,
        "single precision": sp.Integer(2) ** -26,
    }
)
"""Half of the 1 + tanh at which a correctly rounded tanh becomes -1."""

RESOLVED = Hypothesis("epsilon is below the largest possible share", epsilon < 1 / (1 + sp.exp(-8)))
TEN_DIGITS = Hypothesis("resolution of ten digits", sp.Eq(epsilon, 1 / (1 + sp.exp(24))))


def share() -> Judgement:
    """(22) as a share of p_max, in the form to compute with."""
    claim = sp.Eq((1 + sp.tanh(4 - 2 / f_c)) / 2, 1 / (1 + sp.exp(4 / f_c - 8)))
    return Identity(claim)(assume(SLOPED), name="share of p_max")


def always() -> Judgement:
    """The note's criterion holds without condition."""
    claim = sp.StrictGreaterThan(sp.tanh(4 - 2 / f_c), -1)
    return Arithmetic(claim)(assume(SLOPED), name="the criterion always holds")


def growing() -> Judgement:
    """The asymptotic pressure grows with f_c."""
    value = share().claim.rhs
    claim = sp.Eq(sp.diff(value, f_c), 4 / f_c**2 * value * (1 - value))
    return Identity(claim)(assume(SLOPED), name="slope of the share")


def threshold() -> Judgement:
    """A demand on the pressure is a demand on f_c."""
    bound = 4 / (8 + sp.log(1 / epsilon - 1))
    claim = sp.Equivalent(sp.Gt(share().claim.rhs, epsilon), sp.Gt(f_c, bound))
    rare = Arithmetic(sp.Gt(1 / epsilon - 1, sp.exp(-8)))(assume(RESOLVED))
    x = sp.Dummy("x", real=True)
    level = Monotone(sp.Lambda(x, sp.log(x)))(rare)
    return Threshold(claim, f_c)(assume(ROUGHENING), level, name="threshold")


def eighth() -> Judgement:
    """f_c > 1/8 is a demand on the size of the asymptotic pressure."""
    resolution = assume(TEN_DIGITS)
    special = substitute(threshold(), resolution)
    return forget(discharge(special, RESOLVED, resolution), TEN_DIGITS)


def threshold_at(resolution: sp.Expr) -> sp.Expr:
    """Return the least f_c whose asymptotic pressure an arithmetic can tell from zero.

    >>> round(float(threshold_at(RESOLUTIONS["double precision"])), 9)
    0.086724449
    """
    return threshold_bound().subs(epsilon, resolution)


def threshold_bound() -> sp.Expr:
    """Return the bound of ``threshold`` as an expression in epsilon."""
    said = threshold().claim
    (bound,) = (part.lesser for part in (said.left, said.right) if part.greater == f_c)
    return bound


def results() -> dict[str, Proved]:
    """Return what f_c > 1/8 means."""
    return {
        "share": share(),
        "criterion": always(),
        "share-slope": growing(),
        "threshold": threshold(),
        "one-eighth": eighth(),
    }
