"""Dimensions are checked from the vocabulary, on both sides of everything."""

import pytest
import sympy as sp

from derive import catalogue
from derive.dimensions import BASE, DimensionError, dimension, dimension_fault, parse_unit
from derive.symbols import QUANTITIES, rate, symbol, symbols

mm, s, MPa = BASE
u_c, h, sigma, p, k, t = (*symbols("u_c h sigma p k"), symbol("t"))


def test_units_are_read() -> None:
    assert parse_unit("MPa/mm") == MPa / mm
    assert parse_unit("MPa mm^2") == MPa * mm**2
    assert parse_unit("1") == 1


def test_every_unit_of_the_vocabulary_is_readable() -> None:
    for quantity in QUANTITIES.values():
        assert parse_unit(quantity.unit).free_symbols <= {*BASE}, quantity


def test_a_rate_is_a_length_per_time() -> None:
    assert dimension(rate("u_c")) == mm / s
    assert dimension(sp.sqrt(u_c**2)) == mm


@pytest.mark.parametrize(
    "wrong",
    [
        sp.Eq(h, u_c / sigma),
        sp.Eq(h, u_c + p),
        sp.Eq(h, u_c.subs(t, sigma)),  # at no time
        sp.Eq(p, k),
        sp.Eq(sigma, sp.sqrt(sigma)),
        sp.Eq(rate("u_c"), u_c),
        sp.Eq(h / sigma, sp.tanh(h)),
        sp.Lt(h, p),
        sp.Eq(p, sp.Piecewise((p, h < p), (0, True))),
    ],
    ids=str,
)
def test_what_does_not_fit_is_told(wrong: sp.Basic) -> None:
    assert dimension_fault(wrong) is not None


def test_zero_fits_any_dimension() -> None:
    assert dimension_fault(sp.Eq(h, 0, evaluate=False)) is None


def test_a_function_of_a_length_is_an_error() -> None:
    with pytest.raises(DimensionError):
        dimension(sp.exp(h))


def test_every_equation_is_homogeneous_as_derived_and_as_printed() -> None:
    for equation in catalogue.all_equations():
        for relation in (*equation.claims, *equation.printed, *equation.shown_in_full):
            assert dimension_fault(relation) is None, equation.id


def test_turns_per_minute_are_a_frequency() -> None:
    assert QUANTITIES["n"].unit == "rpm"
    assert parse_unit("rpm") == parse_unit("1/s")
