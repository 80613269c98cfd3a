"""Few digits asked for, an estimate that holds: where coarse meshes once agreed by chance.

Each scene is one on which the estimate was below the true error.
"""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.judges import honest
from tests.wear.reference_scenes import constant, made, sine
from tests.wear.test_cycle_count import counted
from wear.binding import bind
from wear.cycles import first_passage, sweep, wear_after
from wear.load import Block, Blocks, Constant, Harmonics
from wear.numerics.gauss import FloatArray
from wear.scene import Scene

CYCLES = np.array([1, 2, 3, 5, 7, 10, 15, 20, 30, 50, 100, 200, 500, 1e3, 3e3, 1e4, 1e5, 1e8, 1e12])


def keeps_its_word(of: Scene, rtol: float) -> None:
    """Compare a count and a sweep with a count of nearly all digits."""
    want, found = (counted(of, CYCLES, tolerance) for tolerance in (1e-13, rtol))
    swept = sweep([of], CYCLES, rtol)
    for wear, error in ((found.u_c, found.error), (swept.u_c[0], swept.error[0])):
        assert honest(wear, error, want.u_c, want.error)
        assert np.all(error <= rtol)


SOFT = made(1.4e-9, 0.3275, constant(5e-6), roughness=3.88e-4, closure=1.165e-3, k=278.0)
LATE = made(5.62e-7, 1 / 3, constant(1.22e-3), roughness=7.75e-4, closure=5.72e-3, k=544.0)
THREE = Harmonics(0.0, (), (7.24e-4, 4.12e-4, -1.64e-3), 0.06)
ONCE_WRONG = {
    # most cycles of a long run lie at the end of the last panel
    "soft": (SOFT, 1e-2, 1e-3),
    "late": (LATE, 1e-2, 1e-3),
    # two meshes agreed by chance: neither resolves the first cycles
    "violent": (made(0.2, 0.25, constant(1e-4), closure=1.08e-3, pin=True), 1e-3),
    "sharp": (made(1e-9, 1.05, sine(9.04e-4), roughness=2.26e-4, closure=6.77e-4, k=4.3e5), 1e-3),
    # a first cycle that takes most of the way was left to panels, 0.03 cycles out
    "far at once": (made(1.84e-4, 0.587, constant(7.8e-5), closure=2.64e-4), 1e-2),
    "farther": (made(9.8e-3, 0.55, constant(3.25e-3), closure=8.7e-4), 1e-3),
    # the error of a junction of panels was told over some cycles behind it, little by little
    "junction": (
        made(3.786e-4, 0.1315, sine(2.167e-5), roughness=7.44e-5, closure=2.232e-4, k=454.5), 1e-4,
    ),
    # in wear that gathers pace what sweeps miss grows by more than the last increment did
    "gathers pace": (
        made(6.97e-5, 0.953, sine(1.312e-5), roughness=4.18e-4, closure=1.622e-3, pin=True), 1e-2,
    ),
    # what the mesh of phase misses changes its sign, and was looked at where it vanishes
    "few wears": (made(8.66e-9, 0.702, sine(5.35e-4), closure=1.08e-3, k=1640.0, pin=True), 1e-6),
    "few more": (made(2.93e-8, 0.601, sine(1.14e-3), closure=1.08e-3, k=1.04e4), 1e-9),
    "fewer": (made(2.04e-7, 0.652, sine(1.35e-3), closure=1.08e-3, k=1.32e4), 1e-7),
    "three waves": (made(9.61e-9, 0.852, THREE, closure=1.08e-3, k=2.68e5), 1e-7),
}  # fmt: skip


@pytest.mark.parametrize("name", ONCE_WRONG)
def test_what_was_once_wrong_by_more_than_its_estimate(name):
    of, *tolerances = ONCE_WRONG[name]
    for rtol in tolerances:
        keeps_its_word(of, rtol)


def lives_hold(of: Scene, load: Constant | Blocks, cycles: FloatArray, rtol: float) -> FloatArray:
    """Count the cycles to the wear after some cycles; return their errors."""
    model = bind(of)
    wear = wear_after(model, load, cycles, 1e-13).u_c
    found = first_passage(model, load, wear, rtol)
    assert np.all(np.abs(found.cycles / cycles - 1) <= found.error + 1e-13)
    return found.error


@pytest.mark.parametrize("of", [SOFT, LATE], ids=["soft", "late"])
def test_the_error_of_the_cycles_until_a_wear_spans_least_and_largest(of):
    """The least count is told: the largest is off by twice what the count may be wrong by."""
    lives_hold(of, of.periodic_load, np.array([1e3, 1e5, 1e8, 1e12]), 1e-2)


def test_cycles_until_a_wear_know_the_error_that_a_block_begins_with():
    """Cycles integrated one by one are wrong by it as well."""
    load = Blocks((Block(SOFT.periodic_load, 10**8), Block(constant(1e-5), 10**8)))
    assert np.all(lives_hold(SOFT, load, np.array([1e8 + 1, 1e8 + 3, 1.1e8]), 1e-2) <= 1e-2)


SHORT = made(2.218e-6, 0.05877, constant(4.37e-4), roughness=1.004e-4, closure=3.012e-4, k=620.3)


@pytest.mark.parametrize("rtol", [1e-2, 1e-3])
@pytest.mark.parametrize("slow", [-1e-4, -2e-4])
def test_a_wear_that_one_block_may_just_reach_or_the_next_one_late(slow, rtol):
    """The next block hardly wears: there the same small wear takes ten times as many cycles."""
    load = Blocks((Block(SHORT.periodic_load, 38000), Block(constant(slow), 10**9)))
    cycles = 38000 * np.array([0.5, 1.0, 1.001, 1.1, 2.0, 11.0])
    assert np.all(np.isfinite(lives_hold(SHORT, load, cycles, rtol)))


def test_a_wear_that_may_never_be_reached_has_no_certain_count():
    """The next blocks do not wear at all."""
    never = Block(constant(-1.0), 1000)
    load = Blocks((Block(SHORT.periodic_load, 38000), never, never))
    assert np.isinf(lives_hold(SHORT, load, np.array([1e3, 38000]), 1e-2)).tolist() == [False, True]


@settings(max_examples=12)
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
    keeps_its_word(made(10**K, f_c, sine(10**swing), closure=1.08e-3, k=10**k, pin=pin), rtol)
