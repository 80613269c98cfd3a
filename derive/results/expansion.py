"""Expansion for long times: the steady state is approached with a logarithm.

Overview
    One worn solid with f_c > 0 under U_a = U sin(2 pi t/T).  The roughness sigma = sigma_c0 +
    f_c u_c grows without bound, and in powers of 1/sigma the rate is steady wear plus a series
    with periodic coefficients.  Averaging order by order separates the growth m of the
    roughness from its oscillation w_n within a cycle.  The first drift c_1, unless b_0 = 0, makes
    the wear leave every straight line like A ln t: (19) is no asymptote of u_c, while (21) is its
    slope.
Key results
    drift(n)         c_1 to c_4
    oscillation(n)   w_1, w_2
    expansion        tau as a function of m, to order 1/m^3
    log_drift        the drift as a limit, proved for the correction of (19)
"""

from __future__ import annotations

from functools import cache

import sympy as sp

from ..claims import Drift, Oscillation, landau_o
from ..equations import stated
from ..hypotheses import ROUGHENING, SINE
from ..kernel import Judgement
from ..note.stabilised import asymptote
from ..rules.assumption import assume, defined
from ..rules.averages import (
    EXPANSION,
    OFFSET,
    SATURATION,
    Averaging,
    OrderEquation,
    SlowTime,
    term_of,
)
from ..symbols import symbol, symbols
from .steady_state import steady_state

(f_c,) = symbols("f_c")
rho, m = symbols("rho m")
(u_cum,) = symbols("u_cum")

_roughens = assume(ROUGHENING)
offset = defined(OFFSET.lhs, OFFSET.rhs, _roughens)
saturation = defined(SATURATION.lhs, SATURATION.rhs, _roughens)
growth = defined(rho, f_c * u_cum, _roughens)


def order(n: int) -> Judgement:
    """Return the equation of c_n and w_n from the terms with 1/m^n."""
    pressure = steady_state().pressure_at_wear
    names = (
        defined(name, term_of(kind, k, pressure.claim.rhs), _roughens)
        for k in range(1, n + 1)
        for kind, name in ((Drift, symbol(f"c_{k}")), (Oscillation, symbol(f"w_{k}")))
    )
    facts = (assume(SINE), offset, saturation, *names)
    return OrderEquation(sp.Integer(n))(pressure, *facts, name=f"terms with 1/m^{n}")


@cache
def drift(n: int) -> Judgement:
    """Return the growth of the roughness at order 1/m^n."""
    claim, below = stated("expansion-drift")[n - 1], map(oscillation, range(1, n - 1))
    return Averaging(claim)(order(n), *below, name="drift")


@cache
def oscillation(n: int) -> Judgement:
    """Return the oscillation of the roughness at order 1/m^n."""
    claim, below = stated("expansion-oscillation")[n - 1], map(oscillation, range(1, n))
    return Averaging(claim)(order(n), drift(n), *below, name="oscillation")


log_drift = asymptote

_drifts = tuple(map(drift, (1, 2, 3, 4)))
expansion_drift = (*_drifts, offset, saturation, growth)
expansion_oscillation = tuple(map(oscillation, (1, 2)))

(_shown,) = stated("expansion")
expansion = SlowTime(sp.Eq(_shown.lhs, _shown.rhs - landau_o(m**-3, m, sp.oo)))(
    *_drifts, assume(EXPANSION), name="slow time"
)
"""The number of cycles as a function of the averaged roughness."""
