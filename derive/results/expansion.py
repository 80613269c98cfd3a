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
from functools import cached_property, partial

import sympy as sp

from ..claims import Drift, Oscillation, Term, landau_o
from ..equations import Equation, beyond
from ..kernel import Judgement
from ..note.stabilised import Stabilised, drift_and_wear
from ..rules.assumption import assume, defined
from ..rules.averages import EXPANSION, OFFSET, SATURATION, Averaging, SlowTime, term_of
from ..rules.limits import forever
from ..rules.reading import SINE
from ..symbols import symbol, symbols, t
from ..typeset.display import as_written
from .steady_state import steady_state

h_0, sigma_c0, f_c, U, T = symbols("h_0 sigma_c0 f_c U T")
b_0, theta, rho, tau, m, s_0 = symbols("b_0 theta rho tau m s_0")
u_c, u_cum, A = symbols("u_c u_cum A")
c_1, c_2, c_3, c_4 = symbols("c_1 c_2 c_3 c_4")

MEANING = "sigma = m + w_1/m + w_2/m^2 + ... with dm/dtau = rho (1 + c_1/m + ...)"

offset = defined(*OFFSET.args)
saturation = defined(*SATURATION.args)
growth = defined(rho, f_c * u_cum)


def _drifts() -> dict[int, sp.Expr]:
    """Return c_1 to c_4, as an author writes them; ``Averaging`` proves them."""
    rest = 1 - theta
    third = (3 * theta**2 - 1) * (3 * U**2 + 2 * b_0**2)
    fourth = (3 * theta**2 - 2) * sp.Add(3 * U**4, 24 * U**2 * b_0**2, 8 * b_0**4)
    return {
        1: 2 * rest * b_0,
        2: -(2 * theta * rest * (U**2 + 2 * b_0**2)),
        3: sp.Rational(4, 3) * rest * b_0 * third,
        4: sp.Add(
            rest**2 * U**2 * rho**2 / (2 * sp.pi**2),
            -(sp.Rational(2, 3) * theta * rest * fourth),
        ),
    }


def _oscillations() -> dict[int, sp.Expr]:
    """Return w_1 and w_2, as an author writes them; ``Averaging`` proves them."""
    rest, angle = 1 - theta, 2 * sp.pi * tau
    waves = sp.Add(
        sp.pi * U * theta * sp.sin(4 * sp.pi * tau),
        8 * sp.pi * b_0 * theta * sp.cos(angle),
        -(rho * sp.sin(angle)),
    )
    return {
        1: -(rest * U * rho / sp.pi * sp.cos(angle)),
        2: rest * U * rho / (2 * sp.pi**2) * waves,
    }


def _slow_time() -> sp.Expr:
    """Return rho tau + s_0 as a function of m."""
    fourth = sp.Add(c_1**4, -(3 * c_1**2 * c_2), 2 * c_1 * c_3, c_2**2, -c_4)
    return sp.Add(
        m,
        -(c_1 * sp.log(m / rho)),
        sp.Add(c_2, -(c_1**2)) / m,
        sp.Add(c_1**3, -(2 * c_1 * c_2), c_3) / (2 * m**2),
        -(fourth / (3 * m**3)),
    )


@dataclass(frozen=True)
class Expansion:
    """The expansion for the note's law, a rigid support and a sine load."""

    def drift(self, n: int) -> Judgement:
        """Growth of the roughness at order 1/m^n."""
        return self._term(Drift, n, sp.Eq(symbol(f"c_{n}"), _drifts()[n]))

    def oscillation(self, n: int) -> Judgement:
        """Oscillation of the roughness at order 1/m^n."""
        return self._term(Oscillation, n, sp.Eq(symbol(f"w_{n}"), _oscillations()[n]))

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
        claim = sp.Eq(rho * tau + s_0, _slow_time())
        return SlowTime(claim)(*drifts, assume(EXPANSION), name="slow time")


def equations() -> tuple[Equation, ...]:
    """Return the expansion and the coefficient of the drift."""
    expansion = Expansion()
    result = partial(beyond, "long times")
    terms = (*(expansion.drift(n) for n in (1, 2, 3, 4)), offset, saturation, growth)
    waves = tuple(expansion.oscillation(n) for n in (1, 2))
    with as_written():
        steps = tuple(sp.Eq(symbol(f"c_{n}"), value) for n, value in _drifts().items())
        shifted = sp.Eq(b_0, sp.Add(sigma_c0 / f_c, -h_0))
        drifts = (*steps, shifted, saturation.relation, growth.relation)
        swings = tuple(sp.Eq(symbol(f"w_{n}"), value) for n, value in _oscillations().items())
        slow = sp.Eq(rho * tau + s_0, sp.Add(_slow_time(), landau_o(m**-3)))
        line = u_cum * t / T
        logarithm = sp.Eq(forever(sp.Add(u_c, -line) / sp.log(t / T)), A)
    drift, where = Stabilised().asymptote, drift_and_wear()
    return (
        result("log-drift", "logarithmic drift of the wear", drift, logarithm, where),
        result("expansion-drift", "drift of the averaged roughness", terms, drifts),
        result("expansion-oscillation", "oscillation within a cycle", waves, swings),
        result("expansion", "cycles and averaged roughness", expansion.slow_time, slow),
    )
