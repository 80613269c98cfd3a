"""Inside the cycles: what interpolation gives is what integration gives."""

import tracemalloc

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tests.wear.reference_scenes import REFERENCE, reference_scene, tables
from wear.count import inside
from wear.count.collocation import FloatArray, mesh
from wear.count.cycle import drive
from wear.count.inside import Inside, fields_inside
from wear.model import bind
from wear.scene import Scene, builtin_names, load_scene, scene_from_tables

PHASES = np.linspace(0.0, 1.0, 21)
SCENES = [name for name in builtin_names() if not load_scene(name).contact.cutoff]
SCENES += ["S1", "S2", "S4", "S7", "S8_2"]


def scene_of(name: str) -> Scene:
    return reference_scene(name) if name in REFERENCE else load_scene(name)


def history(scene: Scene, cycles: FloatArray, phases: FloatArray = PHASES) -> Inside:
    """All chunks as one."""
    parts = list(fields_inside(bind(scene), scene.periodic_load, cycles, phases))
    fields = [
        np.concatenate(column) for column in zip(*(part.fields for part in parts), strict=True)
    ]
    return Inside(
        np.concatenate([part.cycles for part in parts]),
        phases,
        np.concatenate([part.u for part in parts]),
        type(parts[0].fields)(*fields),
        np.concatenate([part.error for part in parts]),
    )


def integrated(scene: Scene, start: float) -> FloatArray:
    """Wear (mm) at PHASES of one cycle by collocation between every two of them."""
    edges = np.unique(np.concatenate([PHASES, np.linspace(0.0, 1.0, 241)]))
    over = mesh(edges, 12)
    run = drive(bind(scene), scene.periodic_load, over).advance(np.array(start))
    added = np.cumsum(run.rate @ over.rule.weights * over.lengths)
    at = np.searchsorted(edges, PHASES[1:] - 1e-9) - 1
    return start + np.concatenate([[0.0], added[at]])


@pytest.mark.parametrize("name", SCENES)
def test_interpolated_cycles_are_integrated_ones(name: str) -> None:
    scene = scene_of(name)
    found = history(scene, np.array([0.0, 3.0, 5.0, 17.0, 300.0, 8999.0]))
    for row, error in zip(found.u, found.error, strict=True):
        expected = integrated(scene, row[0])
        assert_allclose(row, expected, rtol=1e-12, atol=0)
        assert np.max(np.abs(row - expected)) <= error * row[-1]
    assert np.all(found.error <= 2e-12)  # rounding in the deep tail included


@pytest.mark.parametrize("name", ["S1", "S4"])
def test_a_cycle_ends_where_the_next_begins(name: str) -> None:
    wear = history(reference_scene(name), np.arange(2000.0), np.array([0.0, 1.0])).u
    assert_allclose(wear[:-1, 1], wear[1:, 0], rtol=1e-12)
    assert_allclose(
        wear[[9, 99, 999], 1], [REFERENCE[name][n] for n in (10, 100, 1000)], rtol=1e-12
    )


def test_chunks_do_not_change_the_history() -> None:
    scene = reference_scene("S5")
    model, load = bind(scene), scene.periodic_load
    cycles = np.arange(0.0, 500.0, 7.0)
    (whole,) = fields_inside(model, load, cycles, PHASES)
    parts = list(fields_inside(model, load, cycles, PHASES, chunk=10 * len(PHASES)))
    assert len(parts) == 8
    # Another number of rows, another order of summation: the last digit may differ.
    assert_allclose(np.concatenate([part.u for part in parts]), whole.u, rtol=1e-15)
    assert np.array_equal(whole.fields.p, model.fields(whole.u, load(PHASES)).p)


def test_memory_is_bounded_by_the_chunk(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(inside, "BATCH", 200)
    scene = reference_scene("S2")
    model, load, phases = bind(scene), scene.periodic_load, np.linspace(0.0, 1.0, 50)
    prepared = inside.course(model, load, 5_000.0, phases)
    peaks = []
    for number in (500, 500, 5_000):  # the first fills what is kept for good
        tracemalloc.start()
        for part in inside.states(model, load, prepared, np.arange(float(number)), chunk=1000):
            assert part.u.shape == (20, 50)
        peaks.append(tracemalloc.get_traced_memory()[1] - 8 * number)
        tracemalloc.stop()
    assert peaks[2] <= 2.0 * peaks[1]


def test_few_cycles_and_any_order() -> None:
    wear = history(reference_scene("S2"), np.array([2.0, 0.0, 1.0])).u
    assert_allclose(wear[1, -1], REFERENCE["S2"][1], rtol=1e-13)
    assert_allclose(wear[2, -1], wear[0, 0], rtol=1e-13)
    assert_allclose(wear[1, -1], wear[2, 0], rtol=1e-13)


def test_no_wear_inside_cycles_without_pressure() -> None:
    made = tables()
    made["contact"]["closure_mm"] = 1.0
    found = history(scene_from_tables(made, "far"), np.array([0.0, 1e6]))
    assert not found.u.any()
    assert not found.error.any()
