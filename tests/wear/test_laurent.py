"""Laurent series: a ring, with roots and exponentials, in which generated code can run."""

from __future__ import annotations

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.wear.reference_scenes import tables
from wear.laurent import Laurent, NotSteady
from wear.model import bind
from wear.scene import scene_from_tables

TERMS = 8
COEFFICIENTS = st.lists(st.floats(-2.0, 2.0), min_size=TERMS, max_size=TERMS).map(np.array)


def _series(values: np.ndarray, valuation: int) -> Laurent:
    values = values.copy()
    values[0] = 1.0 + abs(values[0])
    return Laurent(values, valuation)


def _close(left: Laurent, right: Laurent, scale: float = 1.0) -> None:
    lowest = min(left.valuation, right.valuation)
    assert left.from_power(lowest) == pytest.approx(right.from_power(lowest), abs=1e-9 * scale)


@given(COEFFICIENTS, COEFFICIENTS, st.integers(-2, 2))
def test_division_undoes_multiplication(a: np.ndarray, b: np.ndarray, valuation: int) -> None:
    left, right = _series(a, valuation), _series(b, 1)
    size = float(np.max(np.abs((left / right).coefficients)))
    _close((left / right) * right, left, scale=1.0 + size)


@given(COEFFICIENTS)
def test_the_root_squares_to_its_argument(a: np.ndarray) -> None:
    series = _series(a, -2)
    root = np.sqrt(series)
    assert root.valuation == -1
    _close(root * root, series, scale=1.0 + float(np.max(np.abs(root.coefficients))) ** 2)


@given(COEFFICIENTS)
def test_exponentials_multiply_where_exponents_add(a: np.ndarray) -> None:
    series = Laurent(a)
    _close(np.exp(series) * np.exp(-series), Laurent.variable(TERMS) * 0.0 + 1.0, scale=1e6)


def test_numbers_may_stand_on_either_side() -> None:
    e = Laurent.variable(4)
    for two in (2, 2.0, np.float64(2.0), np.array(2.0)):
        for found in (two + e, e + two):
            assert found.coefficients == pytest.approx([2.0, 1.0, 0.0, 0.0])
        assert (two - e).coefficients == pytest.approx([2.0, -1.0, 0.0, 0.0])
        assert (two / e).valuation == -1


def test_what_has_no_series_is_said() -> None:
    e = Laurent.variable(4)
    with pytest.raises(NotSteady):
        np.exp(1.0 / e)
    with pytest.raises(NotSteady):
        np.sqrt(e)
    assert NotImplemented is e.__array_ufunc__(np.sin, "__call__", e)


def test_the_minimum_looks_at_the_limit() -> None:
    e = Laurent.variable(4)
    assert np.minimum(3.0 + e, 709) is not None
    assert np.minimum(3.0 + e, 709).coefficients[1] == 1.0
    assert np.minimum(800.0 + e, 709).coefficients[1] == 0.0
    assert np.minimum(1.0 / e, 709).limit == 709.0
    assert np.minimum(-1.0 / e, 709).valuation == -1


def test_generated_code_gives_the_taylor_coefficients_of_its_rate() -> None:
    """Against mpmath's numerical differentiation of the same law, typed here on purpose."""
    scene = scene_from_tables(tables(f_c=0.4))
    model = bind(scene)
    e = Laurent.variable(6)
    found = model.module.rate(1.0 / e - 9e-4, 2e-4, model.constants).coefficients

    def share(small: mpmath.mpf) -> mpmath.mpf:
        gap = mpmath.mpf("1.08e-3") - mpmath.mpf("2e-4") - mpmath.mpf("9e-4")
        rough = mpmath.mpf("3.6e-4") - mpmath.mpf("0.4") * mpmath.mpf("9e-4")
        ratio = (gap * small + 1) / (rough * small + mpmath.mpf("0.4"))
        return 1 / (1 + mpmath.exp(4 * ratio - 8))

    with mpmath.workdps(60):
        expected = mpmath.taylor(share, 0, 5)
    rate = float(model.constants.largest_rate)
    assert found / rate == pytest.approx([float(x) for x in expected[:6]], rel=1e-10, abs=1e-24)
