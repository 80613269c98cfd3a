"""Regimes: the wear of one solid in the long run for f_c = 0 and f_c < 0, without cutoff.

Overview
    f_c > 0 is the steady regime.  For f_c = 0 the argument of tanh decreases with the wear without
    bound, the rate is close to its exponential tail, and wear grows like the logarithm of the
    cycles.  For f_c < 0 the roughness would vanish at the wear sigma_c0/|f_c|.  There the gap
    at the peak of the load is h* = h_0 + sigma_c0/|f_c| - max U_a.  If it is open, wear
    saturates at that depth, logarithmically slowly; if the load closes it, roughness vanishes in
    finite time; and if the peak of the load just closes it, in finite time if the peak is smooth.
Key results
    tail               the rate is below its exponential tail, by a factor that tends to 1
    logarithmic_wear   f_c = 0: the wear of the tail, under a sine load
    saturating_wear    f_c < 0, h* > 0: the number of cycles to a roughness, static load
    closed_gap         the rate at the peak of the load, where h* < 0
"""

from __future__ import annotations

import sympy as sp

from ..claims import landau_o
from ..equations import stated
from ..hypotheses import CONSTANT, KEPT, SINE, SLOPED, SMOOTHING
from ..laws import TANH
from ..note.condensed import bearing_only
from ..rules.algebra import Consequence, Insert, Solve, substitute
from ..rules.assumption import assume, defined
from ..rules.drift import LeadingTerm, LogarithmicGrowth
from ..rules.growth import AtInfinity, unbounded
from ..rules.inequalities import Arithmetic, Threshold
from ..rules.limits import forever
from ..rules.solutions import ByParts, Separate
from ..symbols import rate, symbols, t
from .steady_state import closure, roughness

h_0, U_a, u_c, U, N, M, h_star, T = symbols("h_0 U_a u_c U N M h_star T")
sigma_c0, sigma_c, f_c, p_max, K_c, H_c, V = symbols("sigma_c0 sigma_c f_c p_max K_c H_c V")
(sigma_s,) = symbols("sigma_s")

law = bearing_only().rigid
"""Eq. (13), solved for the rate."""

grown, rough = bearing_only().roughness_of_bearing, bearing_only().rough
"""The roughness of the bearing, and the premise that it does not vanish."""

largest_wear = defined(M, K_c * V * T * p_max / (3 * H_c))
smoothing = assume(SMOOTHING)

_tail = K_c * V * p_max / (3 * H_c) * sp.exp(8 - 4 * closure / roughness)
tail = Consequence(sp.Lt(rate("u_c"), _tail))(
    Arithmetic(sp.Lt(law.claim.rhs, _tail))(grown, rough), law, name="tail of the rate"
)
"""The rate is below its exponential tail."""

# f_c = 0: the integral of the tail is a logarithm
_kept, _sine = assume(KEPT), assume(SINE)
kept = substitute(law, _kept)
"""The rate of a bearing that keeps its roughness."""

_scale = sigma_c0 / 4
_bounded = Arithmetic(sp.Le(sp.Abs(U_a), U))(_sine)
_deep = unbounded(kept, _bounded, name="growth")
_value = K_c * V * p_max / (3 * H_c) * sp.exp(8 - 4 * h_0 / sigma_c0)
_level = _value / (1 + sp.exp(8 - 4 * closure / sigma_c0))
_faded = AtInfinity(sp.Eq(forever(_level), _value), sp.exp(-u_c / _scale))(_deep, _bounded)
_growth = sp.Eq(forever(rate("u_c") * sp.exp((u_c - U_a) / _scale)), _value)
_worn = LogarithmicGrowth(_scale)(Consequence(_growth)(_faded, kept), _sine)
logarithmic_wear = substitute(_worn, Solve(K_c)(largest_wear), name="logarithmic wear")
"""Wear for f_c = 0 after N cycles of a sine load."""

# f_c < 0 under a static load: cycles as an integral over the roughness
odds = sp.exp(4 * h_star / sigma_s + 4 / f_c - 8)
"""p_max/p - 1 at a roughness."""

_falling = Consequence(sp.Eq(rate("u_c"), M / T / (1 + odds.subs(sigma_s, sigma_c))))(
    law,
    Solve(u_c)(grown, smoothing),
    largest_wear,
    defined(
        h_star,
        h_0 - sigma_c0 / f_c - U_a,
        assume(CONSTANT),
        smoothing,
    ),
    name="rate at a roughness",
)
_whole = sp.Integral(1 + odds, (sigma_s, sigma_c0, sigma_c))
_time = Separate(sp.Eq(f_c * M * t / T, _whole))(
    _falling, Solve(u_c)(grown, smoothing), bearing_only().start[4], rough, smoothing
)
_cycles = Consequence(sp.Eq(f_c * M * N, _whole))(_time, defined(N, t / T))
_by_parts = ByParts(sigma_s - sigma_s**2 / (4 * h_star) * odds, sigma_s / (2 * h_star) * odds)
(_shown,) = stated("saturating-wear")
saturating_wear = LeadingTerm(
    sp.Eq(_shown.lhs, _shown.rhs - landau_o(sp.S.One, sigma_c, sp.S.Zero))
)(_by_parts(_cycles, rough, smoothing), rough, smoothing, name="saturating wear")
"""The number of cycles to the roughness sigma_c."""

_bound = K_c * V * p_max / (3 * H_c) * TANH.ratio(1 / f_c)
_overlap = sp.Gt(U_a, h_0 - sigma_c0 / f_c)
_faster = Threshold(sp.Equivalent(sp.Gt(law.claim.rhs, _bound), _overlap), U_a)(
    assume(SLOPED), Arithmetic(sp.Gt(roughness, 0))(grown, rough)
)
closed_gap = substitute(
    _faster, Insert(sp.Eq(law.claim.rhs, rate("u_c")))(law), name="rate while the gap is closed"
)
"""The rate exceeds a positive constant exactly while the load closes the gap h*."""
