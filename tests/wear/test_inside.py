"""Inside the cycles: what interpolation gives is what integration gives."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tests.wear.reference_scenes import REFERENCE, reference_scene, tables
from wear.count import inside
from wear.count.collocation import FloatArray, mesh
from wear.count.cycle import advance, drive
from wear.model import bind
from wear.scene import scene_from_tables

PHASES = np.linspace(0.0, 1.0, 21)


def integrated(name: str, start: float) -> FloatArray:
    """Wear (mm) at PHASES of one cycle by collocation between every two of them."""
    scene = reference_scene(name)
    over = mesh(PHASES, 16)
    run = advance(drive(bind(scene), scene.periodic_load, over), np.array(start))
    added = np.cumsum(run.rate @ over.rule.weights * over.lengths)
    return start + np.concatenate([[0.0], added])


@pytest.mark.parametrize("name", ["S1", "S2", "S4", "S7", "S8_2"])
def test_interpolated_cycles_are_integrated_ones(name: str) -> None:
    scene = reference_scene(name)
    cycles = np.array([0.0, 3.0, 5.0, 17.0, 300.0, 8999.0])
    prepared = inside.course(bind(scene), scene.periodic_load, 8999.0, PHASES)
    wear = inside.wear_inside(prepared, cycles)
    for row, start in zip(wear, wear[:, 0], strict=True):
        assert_allclose(row, integrated(name, start), rtol=1e-12, atol=0)


@pytest.mark.parametrize("name", ["S1", "S4"])
def test_a_cycle_ends_where_the_next_begins(name: str) -> None:
    scene = reference_scene(name)
    prepared = inside.course(bind(scene), scene.periodic_load, 2000.0, np.array([0.0, 1.0]))
    wear = inside.wear_inside(prepared, np.arange(2000.0))
    assert_allclose(wear[:-1, 1], wear[1:, 0], rtol=1e-12)
    assert_allclose(
        wear[[9, 99, 999], 1], [REFERENCE[name][n] for n in (10, 100, 1000)], rtol=1e-12
    )


def test_chunks_do_not_change_the_history() -> None:
    scene = reference_scene("S5")
    model, load = bind(scene), scene.periodic_load
    cycles = np.arange(0.0, 500.0, 7.0)
    (whole,) = inside.fields_inside(model, load, cycles, PHASES)
    parts = list(inside.fields_inside(model, load, cycles, PHASES, chunk=10 * len(PHASES)))
    assert len(parts) == 8
    assert np.array_equal(np.concatenate([part.u for part in parts]), whole.u)
    assert np.array_equal(np.concatenate([part.fields.p for part in parts]), whole.fields.p)
    assert np.array_equal(whole.fields.p, model.fields(whole.u, load(PHASES)).p)


def test_few_cycles_and_any_order() -> None:
    scene = reference_scene("S2")
    prepared = inside.course(bind(scene), scene.periodic_load, 2.0, PHASES)
    wear = inside.wear_inside(prepared, np.array([2.0, 0.0, 1.0]))
    assert_allclose(wear[1, -1], REFERENCE["S2"][1], rtol=1e-13)
    assert_allclose(wear[2, -1], wear[0, 0], rtol=1e-13)


def test_no_wear_inside_cycles_without_pressure() -> None:
    made = tables()
    made["contact"]["closure_mm"] = 1.0
    scene = scene_from_tables(made, "far")
    prepared = inside.course(bind(scene), scene.periodic_load, 1e6, PHASES)
    assert not inside.wear_inside(prepared, np.array([0.0, 1e6])).any()
