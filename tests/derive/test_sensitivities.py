"""Sensitivities and identification against the reference values of section 4."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import sympy as sp

from derive import catalogue
from derive.note.stabilised import wear_per_cycle
from derive.results.sensitivities import coefficient_from_wear, slope_from_wear
from derive.symbols import symbols

VALUES = json.loads((Path(__file__).parents[1] / "data" / "values.json").read_text())["sec4_f0.25"]
u_cum, p_inf, p_max, K_c, H_c, V, T, f_c, M = symbols("u_cum p_inf p_max K_c H_c V T f_c M")
SLIP = 22 * 2000 * sp.pi / 30
DATA = {
    K_c: sp.Rational("1e-6"),
    H_c: sp.Integer(200),
    p_max: sp.Integer(300),
    T: sp.Rational("0.06"),
    V: SLIP,
    M: 44 * sp.pi / 10**6,
}
QUARTER = {**DATA, f_c: sp.Rational(1, 4), p_inf: sp.Float(VALUES["p_inf_MPa"], 32)}


def _right(identifier: str) -> sp.Expr:
    return catalogue.equation(identifier).statements[0].claim.rhs


def test_wear_per_cycle_of_section_4() -> None:
    found = sp.N(wear_per_cycle.claim.rhs.subs(QUARTER), 40)
    assert abs(found / sp.Float(VALUES["u_cum_mm"], 40) - 1) < 1e-28


@pytest.mark.parametrize(
    ("identifier", "key"),
    [("elasticity-slope", "elasticity_f"), ("sensitivity-slope", "du_cum_df")],
)
def test_sensitivities_to_the_roughness_growth(identifier: str, key: str) -> None:
    found = sp.N(_right(identifier).subs(QUARTER), 40)
    assert abs(found / sp.Float(VALUES[key], 40) - 1) < 1e-27


def test_the_single_changes_that_would_give_the_printed_wear_per_cycle() -> None:
    printed = {u_cum: sp.Rational("2.35e-5"), f_c: sp.Rational(1, 4)}
    slope = sp.N(slope_from_wear.claim.rhs.subs(printed).subs(DATA), 40)
    assert abs(slope / sp.Float(VALUES["f_for_2.35e-5"], 40) - 1) < 1e-28
    gain = sp.N(coefficient_from_wear.claim.rhs.subs(printed).subs(DATA) * 10**6, 40)
    assert abs(gain / sp.Float(VALUES["factor_on_K_for_2.35e-5"], 40) - 1) < 1e-28
