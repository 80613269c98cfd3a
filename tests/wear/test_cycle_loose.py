"""Few digits asked for, an estimate that holds: where coarse meshes once agreed by chance.

Each scene is one on which the estimate was below the true error.
"""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.wear.reference_scenes import made
from tests.wear.test_cycle_count import counted
from wear.binding import bind
from wear.cycles import cycles_until, sweep, wear_after
from wear.load import Block, Blocks, Constant, Harmonics, Sine
from wear.scene import Scene

CYCLES = np.array([1.0, 2.0, 6.0, 20.0, 1e3, 1e5, 1e8, 1e12])


def constant(value_mm: float) -> Constant:
    return Constant(value_mm, 0.06)


def sine(amplitude_mm: float) -> Sine:
    return Sine(amplitude_mm, 0.06)


SOFT = made(1.4e-9, 0.3275, constant(5e-6), roughness=3.88e-4, closure=1.165e-3, k=278.0)
LATE = made(5.62e-7, 1 / 3, constant(1.22e-3), roughness=7.75e-4, closure=5.72e-3, k=544.0)


@pytest.mark.parametrize("rtol", [1e-2, 1e-3])
@pytest.mark.parametrize("of", [SOFT, LATE], ids=["soft", "late"])
def test_the_end_of_the_last_panel_is_looked_at(of, rtol):
    """Most cycles of a long run lie there."""
    exact, found = counted(of, CYCLES, 1e-13), counted(of, CYCLES, rtol)
    true = np.abs(found.u_c / exact.u_c - 1)
    assert np.all(true <= found.error + exact.error)
    assert np.all(found.error <= rtol)


VIOLENT = made(0.2, 0.25, constant(1e-4), closure=1.08e-3, pin=True)
SHARP = made(1e-9, 1.05, sine(9.04e-4), roughness=2.26e-4, closure=6.77e-4, k=4.3e5)


@pytest.mark.parametrize("of", [VIOLENT, SHARP], ids=["violent", "sharp"])
def test_two_meshes_that_agree_by_chance_tell_no_error(of):
    """Neither resolves the first cycles: what the rates at the ends of intervals say is added."""
    exact, found = counted(of, CYCLES, 1e-13), counted(of, CYCLES, 1e-3)
    true = np.abs(found.u_c / exact.u_c - 1)
    assert np.all(true <= found.error + exact.error)
    assert np.all(found.error <= 1e-3)


@pytest.mark.parametrize("of", [SOFT, LATE], ids=["soft", "late"])
def test_the_error_of_the_cycles_until_a_wear_spans_least_and_largest(of):
    """The least count is told: the largest is off by twice what the count may be wrong by."""
    cycles = np.array([1e3, 1e5, 1e8, 1e12])
    wear = counted(of, cycles, 1e-13).u_c
    found = cycles_until(bind(of), of.load, wear, 1e-2)
    assert np.all(np.abs(found.cycles / cycles - 1) <= found.error + 1e-13)


def test_cycles_until_a_wear_know_the_error_that_a_block_begins_with():
    """Cycles integrated one by one are wrong by it as well."""
    model = bind(SOFT)
    load = Blocks((Block(SOFT.periodic_load, 10**8), Block(constant(1e-5), 10**8)))
    cycles = np.array([1e8 + 1, 1e8 + 3, 1.1e8])
    wear = wear_after(model, load, cycles, 1e-13).u_c
    found = cycles_until(model, load, wear, 1e-2)
    true = np.abs(found.cycles / cycles - 1)
    assert np.all(true <= found.error + 1e-13)
    assert np.all(found.error <= 1e-2)


SHORT = made(2.218e-6, 0.05877, constant(4.37e-4), roughness=1.004e-4, closure=3.012e-4, k=620.3)


@pytest.mark.parametrize("rtol", [1e-2, 1e-3])
@pytest.mark.parametrize("slow", [-1e-4, -2e-4])
def test_a_wear_that_one_block_may_just_reach_or_the_next_one_late(slow, rtol):
    """The next block hardly wears: there the same small wear takes ten times as many cycles."""
    model, number = bind(SHORT), 38000
    load = Blocks((Block(SHORT.periodic_load, number), Block(constant(slow), 10**9)))
    cycles = number * np.array([0.5, 1.0, 1.001, 1.1, 2.0, 11.0])
    wear = wear_after(model, load, cycles, 1e-13).u_c
    found = cycles_until(model, load, wear, rtol)
    assert np.all(np.abs(found.cycles / cycles - 1) <= found.error + 1e-12)
    assert np.all(np.isfinite(found.error))


def test_a_wear_that_may_never_be_reached_has_no_certain_count():
    """The next blocks do not wear at all."""
    model, number = bind(SHORT), 38000
    never = Block(constant(-1.0), 1000)
    load = Blocks((Block(SHORT.periodic_load, number), never, never))
    wear = wear_after(model, load, np.array([1e3, number]), 1e-13).u_c
    found = cycles_until(model, load, wear, 1e-2)
    assert np.isinf(found.error).tolist() == [False, True]


@pytest.mark.parametrize(
    ("K", "f_c", "closure", "value", "rtol"),
    [(1.84e-4, 0.587, 2.64e-4, 7.8e-5, 1e-2), (9.8e-3, 0.55, 8.7e-4, 3.25e-3, 1e-3)],
)
def test_a_first_cycle_that_goes_far_is_not_left_to_panels(K, f_c, closure, value, rtol):
    """It changes the pace little, but takes most of the way: the count was out by 0.03 cycles."""
    of = made(K, f_c, constant(value), closure=closure)
    want = counted(of, CYCLES, 1e-13).u_c
    swept, found = sweep([of], CYCLES, rtol), counted(of, CYCLES, rtol)
    assert np.all(np.abs(found.u_c / want - 1) <= found.error + 1e-14)
    assert np.all(np.abs(swept.u_c[0] / want - 1) <= swept.error[0] + 1e-14)


FEW = np.array([1, 2, 3, 5, 7, 10, 15, 20, 30, 50, 100, 200, 500, 1e3, 3e3, 1e4, 1e12])


def holds(of: Scene, rtol: float) -> bool:
    """Whether counts and sweeps are as good as they tell."""
    want = counted(of, FEW, 1e-13)
    swept, found = sweep([of], FEW, rtol), counted(of, FEW, rtol)
    good = np.abs(found.u_c / want.u_c - 1) <= found.error + want.error
    good &= np.abs(swept.u_c[0] / want.u_c - 1) <= swept.error[0] + want.error
    return bool(good.all())


def test_a_junction_of_panels_shifts_the_count_at_once():
    """Its error was told over some cycles behind it, little by little."""
    assert holds(
        made(3.786e-4, 0.1315, sine(2.167e-5), roughness=7.44e-5, closure=2.232e-4, k=454.5), 1e-4
    )


def test_what_sweeps_miss_grows_as_the_wear_does():
    """In wear that gathers pace it grows by more than the last increment did."""
    assert holds(
        made(6.97e-5, 0.953, sine(1.312e-5), roughness=4.18e-4, closure=1.622e-3, pin=True), 1e-2
    )


THREE = Harmonics(0.0, (), (7.24e-4, 4.12e-4, -1.64e-3), 0.06)


@pytest.mark.parametrize(
    ("K", "f_c", "load", "k", "pin", "rtol"),
    [
        (8.66e-9, 0.702, sine(5.35e-4), 1640.0, True, 1e-6),
        (2.93e-8, 0.601, sine(1.14e-3), 1.04e4, False, 1e-9),
        (2.04e-7, 0.652, sine(1.35e-3), 1.32e4, False, 1e-7),
        (9.61e-9, 0.852, THREE, 2.68e5, False, 1e-7),
    ],
)
def test_what_the_mesh_of_phase_misses_for_few_wears_is_told(K, f_c, load, k, pin, rtol):
    """It changes its sign as the wear grows, and was looked at where it vanishes."""
    assert holds(made(K, f_c, load, closure=1.08e-3, k=k, pin=pin), rtol)


@settings(max_examples=24)
@given(
    K=st.floats(-9.0, -5.5),
    f_c=st.floats(0.55, 1.05),
    swing=st.floats(-4.0, -2.7),
    k=st.floats(3.0, 6.0),
    pin=st.booleans(),
    rtol=st.sampled_from([1e-6, 1e-7, 1e-9]),
)
def test_contact_that_gets_short_on_springs(K, f_c, swing, k, pin, rtol):
    """Where one drawn scene of a hundred was wrong by more than its estimate."""
    assert holds(made(10**K, f_c, sine(10**swing), closure=1.08e-3, k=10**k, pin=pin), rtol)
