"""Static solution, scaled: a form of the closed solution that floating point can evaluate.

Overview
    exp(-2 x_inf) and Ei(-2 beta/sigma) overflow where their product is harmless.  With
    z = -2 beta/sigma and E = ln(p_max/p - 1) = z - 2 x_inf, both of them moderate or harmless,
    the primitive of exp(E) is sigma exp(E) (1 - z exp(-z) Ei(z)).  Its last factor is a bounded
    function of one variable, which behaves as -1/z for large z: written as such, the primitive
    has a limit for f_c -> 0.
Key results
    scaled_primitive   the identity
    formulas           what ``wear`` evaluates
"""

from __future__ import annotations

import sympy as sp

from ..codegen.formulas import Formula, formula_module
from ..note.condensed import bearing_only
from ..rules.algebra import Insert, inserted, substitute
from ..rules.assumption import assume, defined
from ..symbols import symbols
from .first_integral import log_odds
from .regimes import largest_wear
from .static_solution import MOVING, load_offset, primitive

h, U_a, u_c, sigma, sigma_c0, f_c, beta, x_inf, M = symbols(
    "h U_a u_c sigma sigma_c0 f_c beta x_inf M"
)
z, E = sp.symbols("z E", real=True)
"""The argument of Ei, and the logarithm of p_max/p - 1."""

u, load, log_ratio, size, gap, remainder, bounded, offset = sp.symbols(
    "u U_a exponent roughness gap remainder bounded offset", real=True
)
"""Names in the generated code."""

argument = defined(z, -2 * beta / sigma)
exponent = defined(E, z - 2 * x_inf)


_remainder = sp.Add(1, -(z * sp.exp(-z) * sp.Ei(z)))

scaled_primitive = Insert(
    sp.Eq(sp.exp(-2 * x_inf) * sp.Add(*primitive(sigma)), sigma * sp.exp(E) * _remainder)
)(exponent, argument, assume(MOVING), name="scaled primitive")
"""The primitive of exp(-2 x_inf - 2 beta/sigma), without factors that overflow."""

static_solution_scaled = (scaled_primitive, exponent, argument)


def _of_numbers(expr: sp.Expr) -> sp.Expr:
    """Write an expression with the plain symbols of generated code."""
    model = bearing_only().model
    closure = substitute(model.closure, model.wear_of_pin).claim.rhs
    expr = expr.subs(h, closure.subs(symbols("U_c")[0], 0)).subs(sigma, sigma_c0 + f_c * u_c)
    return expr.xreplace({u_c: u, U_a: load})


def formulas() -> tuple[Formula, ...]:
    """Return what the closed solution needs, besides Ei."""
    primitive = scaled_primitive.claim.rhs.xreplace({_remainder: remainder}) / f_c
    near = primitive.xreplace({sigma: size, E: log_ratio})
    return (
        Formula(
            "largest_wear",
            (),
            inserted(largest_wear.claim.rhs, (bearing_only().model.slip,)),
            "wear of one cycle under the largest pressure",
        ),
        Formula("roughness", (u,), _of_numbers(sigma), "roughness of the bearing"),
        Formula(
            "exponent",
            (u, load),
            _of_numbers(-log_odds.claim.rhs),
            "logarithm of p_max/p - 1 on a rigid support",
        ),
        Formula(
            "offset",
            (u, load),
            _of_numbers(sp.expand(f_c * 2 * load_offset.claim.rhs) / sigma),
            "the argument z of Ei times -f_c, which stays finite for f_c -> 0",
        ),
        Formula(
            "primitive",
            (log_ratio, size, remainder),
            near,
            "integral of exp(exponent) over u, with remainder = 1 - z exp(-z) Ei(z)",
        ),
        Formula(
            "primitive_far",
            (log_ratio, size, bounded, offset),
            (near / remainder * f_c) * bounded / offset,
            "the same for large z, with bounded = -z remainder",
        ),
        Formula("cycles", (u, gap), (u + gap) / M, "cycles to the wear u, gap being that integral"),
    )


def module() -> str:
    """Return the source of the generated module."""
    origin = ("first-integral", "static-solution", "static-solution-scaled")
    return formula_module("Static solution, without the exponential integral.", origin, formulas())
