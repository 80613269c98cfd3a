"""The nomenclature has the symbols of its equations and no others, and nothing LaTeX chokes on."""

import re

import pytest

import derive
from derive.symbols import QUANTITIES
from derive.typeset.macros import nomenclature, occurring
from derive.typeset.reading import in_latex


@pytest.mark.parametrize(
    ("identifiers", "names"),
    [
        (["22"], "p_inf p_max f_c"),
        (["21"], "u_cum K_c V T p_max H_c f_c"),
        (["3", "7c"], "sigma sigma_a sigma_c U_c p k t"),
    ],
)
def test_the_symbols_of_the_equations_and_no_others(identifiers, names):
    found = occurring(derive.equation(identifier).relation for identifier in identifiers)
    assert {quantity.name for quantity in found} == set(names.split())


@pytest.mark.parametrize("quantity", QUANTITIES.values(), ids=lambda quantity: quantity.name)
def test_no_name_is_left_outside_a_formula(quantity):
    text = re.sub(r"\$.*?\$", "", in_latex(quantity.meaning))
    assert not re.search(r"[_^\\]", text)


def test_a_row_has_symbol_meaning_and_unit():
    rows = nomenclature([derive.equation("22")]).splitlines()
    assert (
        r"$f_c$ & roughness growth of the bearing, $\mathrm{d}\sigma_c/\mathrm{d}u_c$ & -- \\"
        in rows
    )
    assert r"$p_\infty$ & asymptotic contact pressure & $\mathrm{MPa}$ \\" in rows
