"""Expansion for long times: the steady state is approached with a logarithm.

Overview
    One worn solid with f_c > 0 under U_a = U sin(2 pi t/T).  The roughness sigma = sigma_c0 +
    f_c u_c grows without bound, and in powers of 1/sigma the rate is steady wear plus a series
    with periodic coefficients.  Averaging order by order separates the growth m of the
    roughness from its oscillation w_n within a cycle.  The first drift c_1 makes the wear leave
    every straight line like A ln t: (19) is no asymptote of u_c, while (21) is its slope.
Key results
    Expansion.drift(n)        c_1 to c_4
    Expansion.oscillation(n)  w_1, w_2
    Expansion.slow_time       tau as a function of m, to order 1/m^3
    log-drift                 the drift as a limit, proved on the way to (19)
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import sympy as sp

from ..claims import Drift, Oscillation, Term, landau_o
from ..equations import Proved, stated
from ..kernel import Judgement
from ..note.stabilised import Stabilised
from ..rules.assumption import assume, defined
from ..rules.averages import EXPANSION, OFFSET, SATURATION, Averaging, SlowTime, term_of
from ..rules.reading import SINE
from ..symbols import symbols
from .steady_state import steady_state

(f_c,) = symbols("f_c")
rho, m = symbols("rho m")
(u_cum,) = symbols("u_cum")

MEANING = "sigma = m + w_1/m + w_2/m^2 + ... with dm/dtau = rho (1 + c_1/m + ...)"

offset = defined(*OFFSET.args)
saturation = defined(*SATURATION.args)
growth = defined(rho, f_c * u_cum)


@dataclass(frozen=True)
class Expansion:
    """The expansion for the note's law, a rigid support and a sine load."""

    def drift(self, n: int) -> Judgement:
        """Growth of the roughness at order 1/m^n."""
        return self._term(Drift, n, stated("expansion-drift")[n - 1])

    def oscillation(self, n: int) -> Judgement:
        """Oscillation of the roughness at order 1/m^n."""
        return self._term(Oscillation, n, stated("expansion-oscillation")[n - 1])

    def _term(self, kind: type[Term], n: int, claim: sp.Equality) -> Judgement:
        pressure = steady_state().pressure_at_wear
        term = term_of(kind, n, pressure.claim.rhs)
        name = defined(claim.lhs, term, f"{claim.lhs} by definition, in {MEANING}")
        meaning = (assume(SINE), name, offset, saturation)
        return Averaging(claim)(pressure, *meaning, name="term of the expansion")

    @cached_property
    def slow_time(self) -> Judgement:
        """The number of cycles as a function of the averaged roughness."""
        drifts = tuple(self.drift(n) for n in (1, 2, 3, 4))
        (shown,) = stated("expansion")
        claim = sp.Eq(shown.lhs, shown.rhs - landau_o(m**-3))
        return SlowTime(claim)(*drifts, assume(EXPANSION), name="slow time")


def results() -> dict[str, Proved]:
    """Return the expansion and the coefficient of the drift."""
    expansion = Expansion()
    drifts = (expansion.drift(n) for n in (1, 2, 3, 4))
    return {
        "log-drift": Stabilised().asymptote,
        "expansion-drift": (*drifts, offset, saturation, growth),
        "expansion-oscillation": tuple(expansion.oscillation(n) for n in (1, 2)),
        "expansion": expansion.slow_time,
    }
