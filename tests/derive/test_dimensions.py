"""Dimensions are checked from the vocabulary, on both sides of everything."""

from fractions import Fraction

import pytest
import sympy as sp

from derive import catalogue
from derive.dimensions import DimensionError, dimension, dimension_fault, parse_unit
from derive.symbols import QUANTITIES, rate, symbol, symbols

u_c, h, sigma, p, k, t = (*symbols("u_c h sigma p k"), symbol("t"))


def test_units_are_read() -> None:
    assert parse_unit("MPa/mm") == (-1, 0, 1)
    assert parse_unit("MPa mm^2") == (2, 0, 1)
    assert parse_unit("1") == (0, 0, 0)


def test_every_unit_of_the_vocabulary_is_readable() -> None:
    powers = [power for quantity in QUANTITIES.values() for power in parse_unit(quantity.unit)]
    assert all(isinstance(power, Fraction) for power in powers)


def test_a_rate_is_a_length_per_time() -> None:
    assert dimension(rate("u_c")) == (1, -1, 0)
    assert dimension(sp.sqrt(u_c**2)) == (1, 0, 0)


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
