"""Blocks of loads: what is joined without a change of load is as if never cut."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tests.wear.reference_scenes import REFERENCE, SINE, made, reference_scene
from wear import cycles as count
from wear.binding import bind
from wear.cycles import first_passage, wear_after
from wear.load import Block, Blocks, Load, Sine, Table


def test_equal_blocks_are_one_load() -> None:
    scene = reference_scene("S2")
    load = scene.periodic_load
    blocks = Blocks((Block(load, 7), Block(load, 93)), repeat=10)
    cycles = np.array([0.0, 1.0, 10.0, 100.0, 1000.0])
    found = wear_after(bind(scene), blocks, cycles, 1e-12)
    want = [0.0, *(REFERENCE["S2"][n] for n in (1, 10, 100, 1000))]
    assert_allclose(found.u_c, want, rtol=1e-13)
    assert np.all(np.abs(found.u_c[1:] / want[1:] - 1) <= found.error[1:])
    assert np.all(found.error <= 1e-12)


def test_blocks_follow_one_another() -> None:
    scene = reference_scene("S5")
    model, first, second = bind(scene), scene.periodic_load, Sine(8e-4, 0.03)
    blocks = Blocks((Block(first, 50), Block(second, 1000)))
    found = wear_after(model, blocks, np.array([20.0, 550.0]), 1e-11)
    begun = count.wear_after(model, first, np.array([20.0, 50.0]), 1e-11)
    gone_on = count.wear_after(model, second, np.array([500.0]), 1e-11, float(begun.u_c[1]))
    assert_allclose(found.u_c, [begun.u_c[0], gone_on.u_c[0]], rtol=1e-14)
    assert found.error[1] >= gone_on.error[0]


def test_cycles_until_a_wear_across_blocks() -> None:
    scene = reference_scene("S5")
    model, load = bind(scene), scene.periodic_load
    blocks = Blocks((Block(load, 50), Block(Sine(8e-4, 0.03), 1000)))
    cycles = np.array([20.0, 50.0, 51.0, 550.0])
    wear = wear_after(model, blocks, cycles, 1e-11).u_c
    found = first_passage(model, blocks, np.append(wear, 1.0), 1e-11)
    assert found.cycles.tolist() == [*cycles.tolist(), np.inf]


@pytest.mark.parametrize(
    ("load", "first"),
    [(SINE, 10**5), (SINE, 10**8), (Table((0.0, 0.02, 0.06), (0.0, 5e-4, 0.0)), 10**7)],
    ids=["early", "late", "sharp"],
)
def test_a_block_that_begins_near_the_limit_wear_is_counted(load: Load, first: int) -> None:
    """Its cycles were taken one by one, until there were too many: status 3."""
    model = bind(made(1e-6, 0.25, load, k=1e5, cutoff=True))
    blocks = Blocks((Block(load, first), Block(load, 10**10 - first)))
    found = wear_after(model, blocks, np.array([1e10]), 1e-11)
    whole = wear_after(model, load, np.array([1e10]), 1e-11)
    assert found.error[0] <= 1e-11
    assert abs(found.u_c[0] / whole.u_c[0] - 1) <= found.error[0] + whole.error[0]
