"""The static solutions against reference values of 18 to 38 digits."""

from itertools import pairwise

import mpmath
import pytest
import sympy as sp

from derive.kernel import Judgement
from derive.results import static_compliant, static_solution
from derive.symbols import symbols, t
from tests.derive.section_4 import SECTION_4, M, agrees, number
from tests.references import VALUES

h_0, U_a, u_c, sigma_c0, f_c, C, beta, x_inf = symbols("h_0 U_a u_c sigma_c0 f_c C beta x_inf")
(ell,) = symbols("ell")
p, p_max, k = symbols("p p_max k")

CYCLES = {C: M / 2}
"""Time is counted in cycles: C T = M/2."""
SCALE = static_solution.scale.claim.rhs


def _number(statement: Judgement, slope: str, load: str, more: dict[sp.Expr, sp.Expr]) -> sp.Expr:
    offset = 2 * (sigma_c0 / f_c - h_0 + U_a)
    time = t * statement.claim.rhs / statement.claim.lhs
    plain = time.subs({beta: offset, x_inf: 4 - 2 / f_c, ell: SCALE})
    return number(plain, {**CYCLES, U_a: sp.Rational(load), **more}, f_c=slope)


@pytest.mark.parametrize(
    ("slope", "load", "key"),
    [
        ("0.25", "0", "tau(u=3e-4;f=.25,Ua=0)"),
        ("0.25", "5e-4", "tau(u=3e-4;f=.25,Ua=5e-4)"),
        ("0.25", "-5e-4", "tau(u=3e-4;f=.25,Ua=-5e-4)"),
        ("-0.05", "0", "tau(u=3e-4;f=-.05,Ua=0)"),
    ],
)
def test_cycles_to_a_wear(slope: str, load: str, key: str) -> None:
    found = _number(static_solution.time, slope, load, {u_c: sp.Rational("3e-4")})
    assert agrees(found, VALUES["static"][key], digits=28)


def test_wear_after_cycles_without_change_of_roughness() -> None:
    known = {**CYCLES, U_a: sp.S.Zero, t: sp.Integer(100)}
    found = number(static_solution.static_wear_smooth.claim.rhs.subs(ell, SCALE), known)
    assert agrees(found, VALUES["static"]["u_f0(100 cycles,Ua=0)"], digits=28)


def test_the_smooth_solution_is_the_limit_of_the_rough_one() -> None:
    wear = {u_c: sp.Rational("3e-4")}
    smooth = _number(static_solution.time_smooth, "0", "0", wear)
    gaps = [
        abs(_number(static_solution.time, slope, "0", wear) / smooth - 1)
        for slope in ("1e-3", "1e-4", "1e-5")
    ]
    for wide, narrow in pairwise(gaps):
        assert wide / narrow == pytest.approx(10.0, rel=0.05)


def test_cycles_on_a_compliant_support() -> None:
    """Parametric in the pressure: the two pressures are roots of the wear."""
    known = {**SECTION_4, **CYCLES, k: sp.Integer(10**6), U_a: sp.S.Zero}
    offset = 2 * (sigma_c0 / f_c - h_0 + U_a)
    wear = sp.lambdify(p, static_compliant.wear.claim.rhs.subs(beta, offset).subs(known), "mpmath")
    with mpmath.workdps(40):
        first = mpmath.findroot(wear, (3, 6), solver="anderson")
        last = mpmath.findroot(lambda x: wear(x) - mpmath.mpf("3e-4"), (0.5, 4), solver="anderson")
        time = (
            (static_compliant.time.claim.rhs / (2 * C))
            .subs(beta, offset)
            .subs(known)
            .subs(p.subs(t, 0), first)
        )
        found = sp.lambdify(p, time, "mpmath")(last)
        key = "finite_k(k=1e6MPa/mm,f=.25,Ua=0) tau(u=3e-4)"
        assert agrees(found, VALUES["static"][key], digits=19)


def test_the_scaled_form_equals_the_plain_one_where_both_can_be_evaluated() -> None:
    claim = static_solution.static_solution_scaled[0].claim
    z, xi, sigma = sp.Symbol("z", real=True), sp.Symbol("xi", real=True), symbols("sigma")[0]
    for argument, limit in ((-3, 2), (5, -1), (-40, 4), (60, -20)):
        size = sp.Rational(7, 10000)
        known = {sigma: size, x_inf: sp.Integer(limit), beta: -argument * size / 2}
        left = claim.lhs.subs(known)
        right = claim.rhs.subs({z: argument, xi: argument - 2 * limit}).subs(known)
        assert abs(sp.N(left / right - 1, 30)) < 1e-28
