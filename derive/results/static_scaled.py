"""Static solution, scaled: a form of the closed solution that floating point can evaluate.

Overview
    exp(-2 x_inf) and Ei(-2 beta/sigma) overflow where their product is harmless.  With
    z = -2 beta/sigma and E = ln(p_max/p - 1) = z - 2 x_inf, both of them moderate or harmless,
    the primitive of exp(E) is sigma exp(E) (1 - z exp(-z) Ei(z)).  Its last factor is a bounded
    function of one variable, which behaves as -1/z for large z: written as such, the primitive
    has a limit for f_c -> 0.
Key results
    scaled_primitive   the identity
"""

from __future__ import annotations

import sympy as sp

from ..equations import Proved
from ..kernel import Judgement
from ..rules.algebra import Insert
from ..rules.assumption import assume, defined
from ..symbols import symbols
from .static_solution import MOVING, primitive

sigma, beta, x_inf = symbols("sigma beta x_inf")
z, E = sp.symbols("z E", real=True)
"""The argument of Ei, and the logarithm of p_max/p - 1."""

argument = defined(z, -2 * beta / sigma)
exponent = defined(E, z - 2 * x_inf)


def scaled_primitive() -> Judgement:
    """The primitive of exp(-2 x_inf - 2 beta/sigma), without factors that overflow."""
    remainder = sp.Add(1, -(z * sp.exp(-z) * sp.Ei(z)))
    claim = sp.Eq(sp.exp(-2 * x_inf) * sp.Add(*primitive(sigma)), sigma * sp.exp(E) * remainder)
    return Insert(claim)(exponent, argument, assume(MOVING), name="scaled primitive")


def results() -> dict[str, Proved]:
    """Return the scaled form."""
    return {"static-solution-scaled": (scaled_primitive(), exponent, argument)}
