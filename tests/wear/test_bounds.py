"""Rigorous bounds: they contain references and solutions, and are as tight as promised."""

import math

import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from derive.results.comparison import STRIP as DERIVED_STRIP
from tests.wear.reference_scenes import REFERENCE, made, reference_scene
from wear.bounds import STRIP, Enclosure, static_bounds, wear_bounds
from wear.faults import UsageError
from wear.load import Harmonics, Sine
from wear.solver import solve

SCENES = [name for name in REFERENCE if name != "S4"]


def contains(bounds: Enclosure, wear: float) -> bool:
    return bounds.low <= wear <= bounds.high


@pytest.mark.parametrize("name", SCENES)
def test_bounds_contain_the_reference_values(name):
    cycles = [1, 10, 100]
    for count, bounds in zip(cycles, wear_bounds(reference_scene(name), cycles), strict=True):
        assert contains(bounds, REFERENCE[name][count]), count


def test_bounds_of_section_4_are_tight():
    (first, tenth, later) = wear_bounds(made(), [1, 10, 1000])
    assert first.high / first.low < 1.16
    assert tenth.high / tenth.low < 1.07
    assert later.high / later.low < 1.0008
    assert contains(later, REFERENCE["S2"][1000])


def test_bounds_under_a_constant_load_close_as_the_wear_slows_down():
    early, late = wear_bounds(reference_scene("S7"), [10, 300])
    assert late.high / late.low < early.high / early.low < 1.1


def test_bounds_contain_what_equidistant_phases_miss():
    """Hardly any wear, under a load so large that 64 phases resolve its pulse to 6e-4 only."""
    scene = made(1e-9, 0.05, Sine(3e-3, 0.06))
    (bounds,) = wear_bounds(scene, [1])
    assert contains(bounds, float(solve(scene, [1], rtol=1e-10).u_c[0]))


def test_a_compliant_support_wears_less_than_a_rigid_one():
    rigid, compliant = wear_bounds(made(), [20])[0], wear_bounds(made(k=1e5), [20])[0]
    assert compliant.high == rigid.high
    assert compliant.low < rigid.low


def test_the_strip_is_the_derived_one():
    assert float(sp.N(DERIVED_STRIP, 20)) == STRIP


SLOPES = st.floats(-0.2, 1.0).filter(lambda f: abs(f) > 1e-3)


def to_a_picometre(length: float) -> float:
    """A length in mm that a scene file may hold: not nearly nothing."""
    return round(length, 9)


@settings(max_examples=60)
@given(
    slope=SLOPES,
    wear_coefficient=st.floats(1e-8, 2e-6),
    pin=st.booleans(),
    first=st.floats(-4e-4, 4e-4).map(to_a_picometre),
    second=st.floats(-2e-4, 2e-4).map(to_a_picometre),
    mean=st.floats(-2e-4, 2e-4).map(to_a_picometre),
)
def test_bounds_contain_the_solution(slope, wear_coefficient, pin, first, second, mean):
    load = Harmonics(mean, (first,), (second, first / 2), 0.06)
    scene = made(wear_coefficient, slope, load, pin=pin)
    (bounds,) = wear_bounds(scene, [3])
    assert contains(bounds, float(solve(scene, [3], rtol=1e-10).u_c[0]))


@settings(max_examples=15)
@given(amplitude=st.floats(1e-9, 1.5e-3), pin=st.booleans())
def test_a_larger_load_never_gives_less_wear(amplitude, pin):
    scene = made(load=Sine(amplitude, 0.06), pin=pin)
    (static,) = static_bounds(scene, [2])
    assert contains(static, float(solve(scene, [2], rtol=1e-9).u_c[0]))


@pytest.mark.parametrize("cycles", [[0], [1.5], [-1], [math.nan], ["a"], None])
def test_only_whole_cycles(cycles):
    with pytest.raises(UsageError, match="whole number"):
        wear_bounds(made(), cycles)


def test_more_cycles_than_anybody_waits_for_are_refused():
    with pytest.raises(UsageError, match="up to 1000000 of them"):
        wear_bounds(made(), [1, 10**12])


def test_what_has_no_bounds_is_told():
    with pytest.raises(UsageError, match="does not end at 3 sigma"):
        wear_bounds(made(cutoff=True), [1])
    force = {"kind": "force", "force_N": 10.0, "period_s": 1.0}
    area = {"contact.width_mm": 1.0, "contact.length_mm": 1.0}
    with pytest.raises(UsageError, match="a given displacement"):
        wear_bounds(made().with_({"load": force, **area}), [1])
