"""Sensitivities and identification against the reference values of section 4."""

import pytest
import sympy as sp

from derive import catalogue
from derive.results.sensitivities import coefficient_from_wear, slope_from_wear
from derive.symbols import symbols
from tests.derive.section_4 import M, agrees, number
from tests.references import VALUES

KNOWN = VALUES["sec4_f0.25"]
QUARTER = {symbols("M")[0]: M, symbols("p_inf")[0]: sp.Float(KNOWN["p_inf_MPa"], 32)}


@pytest.mark.parametrize(
    ("identifier", "key"),
    [("elasticity-slope", "elasticity_f"), ("sensitivity-slope", "du_cum_df")],
)
def test_sensitivities_to_the_roughness_growth(identifier: str, key: str) -> None:
    claim = catalogue.equation(identifier).statements[0].claim
    assert agrees(number(claim.rhs, QUARTER), KNOWN[key], digits=27)


def test_the_single_changes_that_would_give_the_printed_wear_per_cycle() -> None:
    printed = {symbols("M")[0]: M, symbols("u_cum")[0]: sp.Rational("2.35e-5")}
    assert agrees(number(slope_from_wear.claim.rhs, printed), KNOWN["f_for_2.35e-5"], digits=28)
    gain = number(coefficient_from_wear.claim.rhs * 10**6, printed)
    assert agrees(gain, KNOWN["factor_on_K_for_2.35e-5"], digits=28)
