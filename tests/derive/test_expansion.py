"""The long-time expansion: its order by the fall of what it leaves, on histories to 24 digits."""

from itertools import pairwise

import mpmath
import pytest
import sympy as sp

from derive.averaging import collected, mean, z
from derive.kernel import Judgement
from derive.laws import TANH
from derive.note.stabilised import asymptote
from derive.results import expansion
from derive.results.compliant import drift_coefficient
from derive.symbols import symbols
from derive.zero import is_zero
from tests.derive.section_4 import SECTION_4, M, agrees, number
from tests.references import VALUES

sigma_c0, h_0, f_c, U, k = symbols("sigma_c0 h_0 f_c U k")
b_0, theta, rho, tau, p_inf, U_mean = symbols("b_0 theta rho tau p_inf U_mean")

HALF = {1000: "u(1000T)", 100000: "u(100000T)"}
"""Cycles for which the wear at f_c = 1/2 is known to 24 digits."""


def _of_section_4(statement: Judgement, slope: sp.Expr) -> mpmath.mpf:
    saturation = sp.tanh(4 - 2 / slope)
    names = {
        b_0: SECTION_4[sigma_c0] / slope - SECTION_4[h_0],
        theta: saturation,
        rho: slope * M * (1 + saturation) / 2,
    }
    known = {f_c: slope, tau: sp.S.Zero}
    return mpmath.mpf(number(statement.claim.rhs.subs(names), known))


def _offset(wear: mpmath.mpf, cycles: int, slope: sp.Expr, order: int) -> mpmath.mpf:
    """Return B from the wear at a cycle, by the expansion cut after 1/m^order."""
    c = [mpmath.mpf(0)] * 5
    for n in range(1, order + 1):
        c[n] = _of_section_4(expansion.drift(n), slope)
    waves = [_of_section_4(expansion.oscillation(n), slope) for n in (1, 2)][: order - 1]
    growth = mpmath.mpf(sp.N(slope * M * (1 + sp.tanh(4 - 2 / slope)) / 2, 40))
    start = mpmath.mpf(sp.N(SECTION_4[sigma_c0], 40))
    roughness = start + mpmath.mpf(sp.N(slope, 40)) * wear
    m = roughness
    for _ in range(20):
        m = roughness - sum(w / m**n for n, w in enumerate(waves, 1))
    second = c[2] - c[1] ** 2 if order > 1 else 0
    third = c[1] ** 3 - 2 * c[1] * c[2] + c[3] if order > 2 else 0
    fourth = c[1] ** 4 - 3 * c[1] ** 2 * c[2] + 2 * c[1] * c[3] + c[2] ** 2 - c[4]
    kept = m - c[1] * mpmath.log(m / growth) + second / m + third / (2 * m**2)
    kept -= fourth / (3 * m**3) if order > 3 else 0
    return (kept - growth * cycles - start) / mpmath.mpf(sp.N(slope, 40))


@pytest.mark.parametrize("order", [1, 2, 3, 4])
def test_what_the_expansion_leaves_falls_with_its_order(order: int) -> None:
    slope = sp.Rational(1, 2)
    known = mpmath.mpf(VALUES["asymptotic_constants"]["f0.5_K1e-6"]["B"].split()[0])
    with mpmath.workdps(40):
        left = [
            abs(_offset(mpmath.mpf(VALUES["sec4_f0.5_variant"][key]), n, slope, order) - known)
            for n, key in HALF.items()
        ]
    # w_3/m^3, which is not among the results, stays behind at the fourth order
    rate = mpmath.log10(left[0] / left[1]) / 2
    assert float(rate) == pytest.approx(min(order, 3), abs=0.1)
    assert left[1] < (1e-6, 1e-11, 1e-13, 1e-15)[order - 1]


def test_the_limit_and_the_expansion_give_one_drift() -> None:
    """Proved as a limit on the way to (19), and found again as c_1/f_c."""
    limit = asymptote.claim.value.subs(U_mean, 0)
    names = {b_0: sigma_c0 / f_c - h_0, theta: sp.tanh(4 - 2 / f_c)}
    assert is_zero(limit - expansion.drift(1).claim.rhs.subs(names) / f_c)


def test_where_the_drift_is_least() -> None:
    """Of bearings that start at h_0 = 3 sigma_0."""
    claim = drift_coefficient(TANH).claim.rhs.subs({h_0: 3 * sigma_c0, U_mean: 0, p_inf: 0})
    drift = claim.subs({name: SECTION_4[name] for name in (sigma_c0, U)})
    known = VALUES["identification"]
    turning = sp.Float(known["f_turning_of_A_log(h0=3s0)"], 30)
    assert abs(sp.N(drift.subs(f_c, turning) / sp.Float(known["A_min"], 30) - 1, 30)) < 1e-17
    assert abs(sp.N(sp.diff(drift, f_c).subs(f_c, turning), 30)) < 1e-18


def test_a_softer_support_lowers_the_drift() -> None:
    claim = drift_coefficient(TANH).claim.rhs.subs({**SECTION_4, p_inf: sp.Rational(1, 10)})
    *values, limit = (sp.N(claim.subs(k, at), 30) for at in (10**4, 10**6, 10**9, sp.oo))
    assert all(low < high for low, high in pairwise([*values, limit]))
    assert agrees(limit, VALUES["sec4_f0.25"]["A_log_mm"], digits=25)


def test_averaging_in_closed_form_for_any_load() -> None:
    """c_3 is a mean; c_4 has two correlations more.  Two harmonics, all amplitudes symbolic."""
    a, turns = sp.symbols("a1:9", real=True), 2 * sp.pi * sp.I
    first, second = (x + y * (z + 1 / z) + w * (z**2 - z**-2) for x, y, w in (a[:3], a[3:6]))
    third, fourth = (x + y * (z - 1 / z) for x, y in ((a[6], a[0]), (a[7], a[1])))
    drift, waves = [sp.S.One], [sp.S.Zero]
    for n in (1, 2, 3, 4):
        known = sp.expand(collected((sp.S.One, first, second, third, fourth), drift, waves, n))
        drift.append(mean(known))
        rest = ((c, c.as_coeff_exponent(z)[1]) for c in sp.Add.make_args(known - drift[n]))
        waves.append(rho * sp.Add(*(c / (turns * power) for c, power in rest if c != 0)))
    primitive = (a[1] * (z - 1 / z) + a[2] / 2 * (z**2 + z**-2)) / turns
    correlation = sp.expand(rho**2 * primitive**2 - rho * second * primitive).coeff(z, 0)
    assert sp.expand(drift[3] - a[6]) == 0
    assert sp.expand(drift[4] - a[7] - correlation) == 0
