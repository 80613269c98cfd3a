"""Static solution: wear under a load that does not vary, in closed form.

Overview
    For constant U_a the rate depends on the wear alone, so time is the integral of 1/rate:
    half the wear over C, for the saturated pressure, plus an exponential integral for the
    excess of the gap.  For f_c = 0 the integral is elementary, with an inverse by Lambert's W.
    A compliant support is in ``static_compliant``.
Key results
    static_solution          t(u_c), f_c != 0, of either sign while sigma > 0
    static_solution_smooth   t(u_c), f_c = 0
    static_wear_smooth       u_c(t), f_c = 0
    static_solution_scaled   its primitive in a form that floating point can evaluate
References
    Ei: DLMF 6.2.5.  W: Corless et al., Adv. Comput. Math. 5 (1996) 329.
"""

from __future__ import annotations

import sympy as sp

from ..equations import stated
from ..hypotheses import CONSTANT, SLOPED, Hypothesis
from ..note.condensed import bearing_only
from ..rules.algebra import Consequence, Insert, Solve, substitute
from ..rules.assumption import assume, defined
from ..rules.inequalities import Arithmetic
from ..rules.solutions import ByParts, Lambert, Separate
from ..symbols import rate, symbols, t
from .regimes import grown, kept, rough

h_0, U_a, u_c, sigma_c, sigma_c0, f_c = symbols("h_0 U_a u_c sigma_c sigma_c0 f_c")
p_max, K_c, H_c, V, C, beta, x_inf = symbols("p_max K_c H_c V C beta x_inf")
ell, u_s, sigma, sigma_s = symbols("ell u_s sigma sigma_s")

MOVING = Hypothesis(sp.Ne(beta, 0))
"""The load is not the one under which wear is steady."""

sloped, moving, constant = map(assume, (SLOPED, MOVING, CONSTANT))
half_rate = defined(C, K_c * V * p_max / (6 * H_c))
load_offset = defined(beta, 2 * (sigma_c0 / f_c - h_0 + U_a), constant, sloped)
limit_argument = defined(x_inf, 4 - 2 / f_c, sloped)
scale = defined(ell, sigma_c0 / 8 * sp.exp(4 * (h_0 - U_a) / sigma_c0 - 8), constant)


odds = sp.exp(-2 * x_inf - 2 * beta / sigma_s)
"""p_max/p - 1 at a roughness."""


def primitive(roughness: sp.Expr) -> tuple[sp.Expr, sp.Expr]:
    """Return the two parts of a primitive of exp(-2 beta/sigma) with respect to sigma."""
    z = -2 * beta / roughness
    return roughness * sp.exp(z), 2 * beta * sp.Ei(z)


def _law(growth: sp.Expr) -> sp.Equality:
    """Return the saturated rate over one plus the odds p_max/p - 1."""
    return sp.Eq(rate("u_c"), 2 * C / (1 + growth))


start_of_wear, start_of_roughness = (bearing_only().start[place] for place in (1, 4))

worn = Solve(u_c)(grown, sloped)
"""The wear at a roughness."""

_rate = Consequence(_law(odds.subs(sigma_s, sigma_c)))(
    bearing_only().rigid, worn, half_rate, load_offset, limit_argument, name="rate"
)
_whole = sp.Integral(1 + odds, (sigma_s, sigma_c0, sigma_c))
_time = Separate(sp.Eq(2 * C * f_c * t, _whole))(
    _rate, worn, start_of_roughness, rough, sloped, moving
)
_time = ByParts(sigma_s + sigma_s * odds, -2 * beta / sigma_s * odds)(_time, rough)
_time = ByParts(sp.exp(-2 * x_inf) * primitive(sigma_s)[1])(_time, rough, moving)
_time = Arithmetic(_time.claim.map(lambda side: side / (2 * C * f_c)).relation)(_time, sloped)
time = Consequence(stated("static-solution")[0])(
    _time, grown, rough, moving, name="static solution"
)
"""The time at which the wear is u_c."""

static_solution = (time, load_offset, limit_argument, half_rate)

_growth = 4 * ell / sigma_c0 * sp.exp(4 * u_s / sigma_c0)
_rate = Consequence(_law(2 * _growth.subs(u_s, u_c)))(kept, half_rate, scale, name="rate, f_c = 0")
_whole = sp.Integral(sp.Rational(1, 2) + _growth, (u_s, 0, u_c))
time_smooth = ByParts(u_s / 2 + ell * sp.exp(4 * u_s / sigma_c0))(
    Separate(sp.Eq(C * t, _whole))(_rate, start_of_wear, constant)
)
"""The time at which the wear is u_c, for f_c = 0."""

static_solution_smooth = (time_smooth, scale, half_rate)

_grown = sp.exp(4 * u_c / sigma_c0)
_w = 8 * ell / sigma_c0 * _grown
_claim = sp.Eq(_w * sp.exp(_w), 8 * ell / sigma_c0 * sp.exp(8 * (C * t + ell) / sigma_c0))
_inverse = Solve(_grown)(Lambert(_w)(Insert(_claim)(time_smooth)))
static_wear_smooth = Solve(u_c)(substitute(time_smooth, _inverse), name="wear at a time, f_c = 0")
"""The wear at a time, for f_c = 0."""

z, xi = sp.symbols("z xi", real=True)
_argument, _exponent = defined(z, -2 * beta / sigma), defined(xi, z - 2 * x_inf)
_bounded = sp.Add(1, -(z * sp.exp(-z) * sp.Ei(z)))
_scaled = sp.Eq(sp.exp(-2 * x_inf) * sp.Add(*primitive(sigma)), sigma * sp.exp(xi) * _bounded)
static_solution_scaled = (
    Insert(_scaled)(_exponent, _argument, moving, name="scaled primitive"),
    _exponent,
    _argument,
)
"""The primitive of exp(-2 x_inf - 2 beta/sigma), without factors that overflow.

exp(-2 x_inf) and Ei(z) overflow where their product is finite.  xi = ln(p_max/p - 1) and z do not
overflow, and the last factor is a bounded function of z, about -1/z for large z.
"""
