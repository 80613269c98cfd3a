"""Section 4 and what replaces its false steps, against numbers that were found independently."""

from itertools import pairwise

import mpmath
import pytest
import sympy as sp

from derive import catalogue
from derive.equations import Status
from derive.kernel import chain, replay_fault
from derive.laws import EXPONENTIAL, GENERAL, TANH
from derive.note import stabilised
from derive.results import cutoff, cutoff_two_solids, regimes, two_solids, validity
from derive.results.steady_state import SteadyState
from derive.symbols import symbol
from tests.derive.section_4 import agrees, number
from tests.references import VALUES

STATUS = {
    Status.DERIVED: ("14", "15", "16a", "17a", "17b", "18", "21", "22"),
    Status.CORRECTED: ("11", "12", "16b", "19"),
    Status.DEFINITION: ("20",),
}


@pytest.mark.parametrize("status", STATUS)
def test_the_status_of_each_equation_of_section_4(status):
    for identifier in STATUS[status]:
        assert catalogue.equation(identifier).status is status, identifier


@pytest.mark.parametrize("law", [TANH, EXPONENTIAL, GENERAL], ids=lambda law: law.name)
def test_the_limit_is_proved_for_every_law(law):
    steady = SteadyState(law)
    for step in chain(steady.pressure, steady.wear_per_cycle):
        assert replay_fault(step) is None, step.relation


def test_wear_per_cycle_and_pressure_of_section_4():
    section_4 = VALUES["sec4_f0.25"]
    assert agrees(number(stabilised.wear_per_cycle.claim.rhs), section_4["u_cum_mm"])
    assert agrees(number(stabilised.pressure.claim.rhs), section_4["p_inf_MPa"])


@pytest.mark.parametrize(
    ("slope", "reference"), [("1/4", "0.0057580683832485130861216608317042"), ("1/2", "-0.00144")]
)
def test_the_logarithmic_drift(slope, reference):
    assert agrees(number(stabilised.asymptote.claim.value, f_c=slope), reference)


def test_the_bracket_of_16_is_a_constant_that_is_not_zero():
    bracket = stabilised.constant_bracket.claim.rhs.subs(symbol("U_a"), 0)
    assert agrees(number(bracket), "-1.8e-4")


PIN = {"f_a": "1/20", "kappa": "1/3", "sigma_a0": "6.5e-5"}


@pytest.mark.parametrize(("opening", "name"), [(False, "printed"), (True, "physical")])
def test_two_solids_of_sections_3_and_5(opening, name):
    solids, values = two_solids.TwoSolids(opening=opening), VALUES["two_solids"]
    definitions = {s.claim.lhs: s.claim.rhs for s in solids.definitions}
    limit = 4 - 2 * (symbol("g") / symbol("q")).subs(definitions)
    assert agrees(number(limit, f_c="-1/20", **PIN), values[f"x_inf_{name}_sign"])
    wear = solids.rate.claim.value.subs(definitions) * symbol("T")
    assert agrees(number(wear, f_c="-1/20", **PIN), values[f"u_cum_{name}_sign"])
    depth = cutoff_two_solids.arrest_depth_two_solids.claim.rhs.subs(definitions)
    closure = {symbol("h_0"): 3 * sp.sqrt(sp.Rational("6.5e-5") ** 2 + sp.Rational("3.6e-4") ** 2)}
    for section, slope in (("sec3", "-1/20"), ("sec5", "1/20")):
        reference = VALUES["cutoff"][f"{section}_{name}_u_stop"].split()[0]
        assert agrees(number(depth.subs(closure), f_c=slope, **PIN), reference, digits=28)


@pytest.mark.parametrize(
    ("slope", "reference"), [("1/4", "0.002"), ("-1/20", "0.00043478260869565217391304347826087")]
)
def test_arrest_depth_of_one_solid(slope, reference):
    assert agrees(number(cutoff.arrest_depth.claim.rhs, f_c=slope), reference)


def test_one_solid_is_the_case_of_two():
    depth = cutoff_two_solids.arrest_depth_two_solids.claim.rhs
    single = {symbol("sigma_a0"): 0, symbol("g"): 1, symbol("q"): symbol("f_c")}
    single[symbol("p_1")] = symbol("f_c") * symbol("sigma_c0")
    assert agrees(number(depth.subs(single)), "0.002")


def test_wear_per_cycle_for_one_third():
    wear = cutoff.one_third.claim.rhs.subs(symbol("d"), sp.Rational(1, 2))
    assert agrees(number(wear, f_c="1/3"), VALUES["cutoff"]["u_cum_f_1/3"])


@pytest.mark.parametrize(
    ("name", "key"),
    [
        ("ten digits", "f_10digit_rounded"),
        ("double precision", "f_float64"),
        ("single precision", "f_float32"),
    ],
)
def test_thresholds(name, key):
    bound = validity.threshold_at(validity.RESOLUTIONS[name])
    assert agrees(sp.N(bound, 40), VALUES["thresholds"][key])


def test_the_threshold_of_doubles_is_where_a_correctly_rounded_tanh_becomes_minus_one():
    bound = float(validity.threshold_at(validity.RESOLUTIONS["double precision"]))
    with mpmath.workdps(60):
        for slope, lost in ((bound * (1 - 1e-12), True), (bound * (1 + 1e-12), False)):
            rounded = float(mpmath.tanh(4 - 2 / mpmath.mpf(slope)))
            assert (1.0 + rounded == 0.0) is lost


def test_one_eighth():
    said = validity.one_eighth.claim
    bounds = {said.left.lesser, said.right.lesser}
    assert bounds == {sp.Rational(1, 8), 1 / (1 + sp.exp(24))}


def test_saturating_wear_approaches_the_static_solution():
    """The law for f_c < 0 against quadrature of dN/ds; the relative distance falls like s."""
    law = regimes.saturating_wear.claim.rhs
    decline, start, gap, wear = (mpmath.mpf(v) for v in ("0.05", "3.6e-4", "8.28e-3", "1.38e-4"))
    distances = []
    with mpmath.workdps(30):
        for share in (8, 16, 32):
            s = start / share

            def slowness(v: mpmath.mpf) -> mpmath.mpf:
                return 1 + mpmath.exp(4 * gap / v - 8 - 4 / decline)

            grid = [s * mpmath.mpf(2) ** (mpmath.mpf(j) / 8) for j in range(8 * 8 + 1)]
            grid = [v for v in grid if v < start] + [start]
            exact = mpmath.quad(slowness, grid) / (decline * wear)
            data = {"h_star": gap, "sigma_c": s, "M": wear, "f_c": -decline}
            values = {symbol(name): sp.Float(str(value), 30) for name, value in data.items()}
            claimed = mpmath.exp(mpmath.mpf(sp.N(law.subs(values), 30)))
            distances.append(float(abs(claimed / exact - 1)))
    assert distances[0] < 0.02
    assert [a / b for a, b in pairwise(distances)] == pytest.approx([2, 2], rel=0.1)
