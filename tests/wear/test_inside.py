"""Inside the cycles: what interpolation gives is what integration gives."""

import tracemalloc
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from tests.judges import static_wear
from tests.wear.reference_scenes import REFERENCE, made, reference_scene
from wear.binding import bind
from wear.cycles import orbit_of_scene, wear_after
from wear.equation import equation_of
from wear.faults import UsageError
from wear.inside import Chunk, fields_inside
from wear.load import Block, Blocks, Constant, Harmonics, HistoryLoad, Sine, Table
from wear.loss_of_contact.contact import wear_in_contact
from wear.numerics.gauss import FloatArray
from wear.numerics.initial_value import Rules, integrate
from wear.orbit.period_map import PeriodMap, period_map
from wear.scene import Scene, builtin_names, load_scene
from wear.solver import solve

PHASES = np.linspace(0.0, 1.0, 21)
SCENES = [name for name in builtin_names() if not load_scene(name).contact.ends_at_3_sigma]
SCENES += ["S1", "S2", "S4", "S7", "S8_2"]


def scene_of(name: str) -> Scene:
    return reference_scene(name) if name in REFERENCE else load_scene(name)


def history(scene: Scene, cycles: FloatArray, phases: FloatArray = PHASES) -> Chunk:
    """All chunks as one."""
    parts = list(fields_inside(scene, cycles, phases))
    fields = [
        np.concatenate(column) for column in zip(*(part.fields for part in parts), strict=True)
    ]
    return Chunk(
        np.concatenate([part.cycles for part in parts]),
        phases,
        np.concatenate([part.u for part in parts]),
        type(parts[0].fields)(*fields),
        np.concatenate([part.error for part in parts]),
    )


def integrated(scene: Scene, start: float) -> FloatArray:
    """Wear (mm) at PHASES of one cycle by collocation between every two of them."""
    edges = np.unique(np.concatenate([PHASES, np.linspace(0.0, 1.0, 241)]))
    maps = period_map(equation_of([scene]), edges[None], 12)
    run = maps.advance(np.array([[start]]))
    added = np.cumsum(run.rate @ maps.over.rule.weights * maps.over.lengths)
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
    (whole,) = fields_inside(scene, cycles, PHASES)
    parts = list(fields_inside(scene, cycles, PHASES, chunk=10 * len(PHASES)))
    assert len(parts) == 8
    # Another number of rows, another order of summation: the last digit may differ.
    assert_allclose(np.concatenate([part.u for part in parts]), whole.u, rtol=1e-15)
    assert np.array_equal(whole.fields.p, model.fields(whole.u, load(PHASES)).p)


@pytest.mark.parametrize("name", ["S8_1", "S8_2"])
def test_the_interpolated_pressure_is_the_root(name: str) -> None:
    scene = reference_scene(name)
    found = history(scene, np.array([0.0, 5.0, 60.0, 700.0, 8999.0]))
    expected = bind(scene).fields(found.u, scene.periodic_load(PHASES))
    assert_allclose(found.fields.p, expected.p, rtol=1e-11)
    assert_allclose(found.fields.h, expected.h, rtol=1e-13)


def test_memory_is_bounded_by_the_chunk() -> None:
    scene = reference_scene("S2")
    phases = np.linspace(0.0, 1.0, 50)
    peaks = []
    for number in (500, 500, 5_000):  # the first fills what is kept for good
        cycles = np.append(np.arange(number - 1.0), 5_000.0)  # as much to prepare
        tracemalloc.start()
        for part in fields_inside(scene, cycles, phases, chunk=1000):
            assert part.u.shape == (20, 50)
        peaks.append(tracemalloc.get_traced_memory()[1] - 8 * number)
        tracemalloc.stop()
    assert peaks[2] <= 2.0 * peaks[1]


def test_the_error_refers_to_the_end_of_the_cycle() -> None:
    """No wear yet is no error without bounds."""
    for phases in (np.array([0.0]), np.array([0.0, 0.1])):
        assert np.all(history(reference_scene("S2"), np.array([0.0, 1.0]), phases).error <= 1e-12)


def test_few_cycles_come_in_order() -> None:
    found = history(reference_scene("S2"), np.array([2.0, 0.0, 1.0]))
    assert found.cycles.tolist() == [0.0, 1.0, 2.0]
    assert_allclose(found.u[0, -1], REFERENCE["S2"][1], rtol=1e-13)
    assert_allclose(found.u[:-1, -1], found.u[1:, 0], rtol=1e-13)


def marched(scene: Scene, start: float) -> FloatArray:
    """Wear (mm) at PHASES of one cycle by the adaptive integrator."""
    equation = equation_of([scene])

    def sampled(edges: FloatArray, m: int, tolerance: float) -> PeriodMap:
        return period_map(equation, edges[None], m, tolerance)

    edges = np.unique(np.concatenate([PHASES, equation.breakpoints[0]]))
    parts = integrate(sampled, edges, start, Rules(24, 30, 1e-14))
    added = np.concatenate([np.zeros(1), *(part.increment for part in parts)])
    return start + added[np.searchsorted(edges, PHASES)]


@pytest.mark.parametrize("rtol", [1e-4, 1e-12])
@pytest.mark.parametrize("K", [3.3e-3, 4e-2])
@pytest.mark.parametrize("kind", ["sine_mm", "cosine_mm"])
def test_very_fast_wear_inside_its_first_cycles(rtol: float, K: float, kind: str) -> None:
    """An error that the wear forgets within a cycle makes no negative estimate."""
    waves = (1.4e-3, 0.0, 7e-4)
    scene = made(K, 0.16, replace(Harmonics(0.0, (), (), 0.06), **{kind: waves}))
    cycles = np.array([0.0, 1.0, 2.0, 4.0, 5.0, 1e3])
    parts = fields_inside(scene, cycles, PHASES, rtol)
    for part in parts:
        for row, error in zip(part.u, part.error, strict=True):
            true = np.max(np.abs(row - marched(scene, row[0]))) / row[-1]
            assert true <= error + 5e-14  # to which the two ways agree in double precision
            assert 0 <= error <= rtol


@settings(max_examples=8)
@given(phase=st.floats(0.01, 0.99))
@pytest.mark.parametrize("name", ["S1", "S2", "S4", "S8_1", "S8_2"])
def test_a_load_shifted_in_time_shifts_the_wear(name: str, phase: float) -> None:
    """Begun at another phase, with the wear there, it goes through the same states."""
    scene = reference_scene(name)
    load, angle = scene.periodic_load, 2 * np.pi * phase
    later = Harmonics(
        0.0, (load.maximum * np.sin(angle),), (load.maximum * np.cos(angle),), load.period
    )
    cycles = np.array([0.0, 1.0, 10.0, 1e3, 1e6, 1e9])
    states = history(scene, cycles, np.array([phase]))
    begun = float(states.u[0, 0])
    found = wear_after(bind(scene), later, cycles[1:], 1e-12, begun)
    error = found.error + states.error[1:] + states.error[0]
    assert np.all(np.abs(found.u_c / states.u[1:, 0] - 1) <= error)
    assert np.all(error <= 1e-10)


@pytest.mark.parametrize("rtol", [1e-2, 1e-4])
def test_a_first_cycle_that_two_meshes_miss_alike(rtol: float) -> None:
    """Wear takes off within a hundredth of it: what the count knows of its end has a say."""
    pin = {"roughness_mm": 1.263e-5, "roughness_growth": -0.0099}
    load = Constant(3.7e-6, 0.06)
    scene = made(3.1e-3, 1.1145, load, roughness=7.577e-5, closure=2.273e-4, pin=pin)
    cycles = np.array([0.0, 1e3, 1e9])
    found, want = (next(fields_inside(scene, cycles, PHASES, x)) for x in (rtol, 1e-13))
    true = np.max(np.abs(found.u - want.u), axis=1) / want.u[:, -1]
    assert np.all(true <= found.error + want.error)
    assert np.all(found.error <= rtol)


def test_no_cycle_leads_to_negative_roughness() -> None:
    """Very fast wear had another solution beyond the wear at which the roughness vanishes."""
    scene = made(0.0126, -0.14, Constant(2e-4, 1.05), roughness=7.5e-5, closure=2.8e-4)
    cycles = np.array([0.0, 1.0, 20.0])
    found = history(scene, cycles)
    exact = static_wear(scene, cycles[:, None] + PHASES, found.u)
    true = np.max(np.abs(found.u - exact), axis=1) / exact[:, -1]
    assert np.all(true <= found.error + 1e-14)
    assert np.all(found.error <= 1e-11)


def test_wear_that_gathers_pace_is_counted_in_stages() -> None:
    """Out of contact at first, roughness grows until contact sets in: the count begins anew."""
    scene = made(0.03, 0.55, Constant(0.0, 0.06), closure=7.3 * 3.6e-4)
    cycles = np.array([0.0, 100.0, 12_823.0, 12_824.0, 12_830.0, 1e5, 1e7])
    counted = orbit_of_scene(bind(scene), scene.periodic_load, 1e7, 1e-12)
    assert len(counted.orbit.segments) > 1
    phases = np.array([0.0, 0.4, 1.0])
    found = history(scene, cycles, phases)
    exact = static_wear(scene, cycles[:, None] + phases, found.u)
    true = np.max(np.abs(found.u - exact), axis=1) / exact[:, -1]
    assert np.all(true <= found.error)
    assert np.all(found.error <= 1e-9)


ZIGZAG = Table((0.0, 0.01, 0.03, 0.06), (0.0, 5e-4, 1e-4, 0.0))
BLOCKS = Blocks((Block(Sine(2e-4, 0.06), 20), Block(Sine(5e-4, 0.03), 300)), 3)


@pytest.mark.parametrize("cutoff", [False, True])
def test_blocks_of_loads_go_on_from_each_other(cutoff: bool) -> None:
    scene = replace(made(1e-5, 0.5, cutoff=cutoff), load=BLOCKS)
    cycles = np.array([0.0, 19.0, 20.0, 100.0, 319.0, 320.0, 959.0])
    found = history(scene, cycles)
    ends = solve(scene, [*cycles, *(cycles + 1)], 1e-12)
    assert_allclose(found.u[:, 0], ends.u_c[:7], rtol=1e-12)
    assert_allclose(found.u[:, -1], ends.u_c[7:], rtol=1e-12)
    assert_allclose(found.fields.p[:, 0], ends.p[:7], rtol=1e-10)
    assert np.all(np.diff(found.u, axis=1) >= 0)
    assert np.all(found.error <= 1e-11)


CUTOFF = [load_scene(name) for name in builtin_names() if load_scene(name).contact.ends_at_3_sigma]
CUTOFF += [
    replace(made(1e-3, cutoff=True), name="slides along the edge of contact"),
    replace(made(1e-4, load=ZIGZAG, cutoff=True), name="kinks"),
]


# Short steps tell nothing of contact that is but a touch.
LONGER = [scene for scene in CUTOFF if scene.name != "grazing"]


@pytest.mark.parametrize("scene", LONGER, ids=lambda scene: scene.name)
def test_cycles_with_a_cutoff_go_through_open_closed_and_sliding_contact(scene: Scene) -> None:
    """Against very many short steps of the equation as it stands, which need no event."""
    cycles = np.array([0.0, 1.0, 7.0, 40.0])
    found = history(scene, cycles)
    assert np.all(found.error <= 1e-9)
    assert np.all(np.diff(found.u, axis=1) >= 0)
    model, load = bind(scene), scene.periodic_load
    steps = 10_000
    middles = load((np.arange(steps) + 0.5) / steps).tolist()
    u = found.u[:, 0].copy()
    largest = np.max(found.u[:, -1] - found.u[:, 0]) + 1e-30
    for step, U_a in enumerate(middles):
        if step % (steps // 20) == 0:
            assert_allclose(found.u[:, step // (steps // 20)], u, atol=1e-3 * largest, rtol=1e-12)
        speed = np.where(model.margin(u, U_a) >= 0.0, model.rate(u, U_a), 0.0)
        u += speed * load.period / steps


HELD = replace(made(k=1e4, cutoff=True), name="compliant")


@pytest.mark.parametrize("scene", [*CUTOFF, HELD], ids=lambda scene: scene.name)
def test_other_phases_do_not_change_a_cycle_with_a_cutoff(scene: Scene) -> None:
    cycles = np.array([0.0, 3.0, 60.0])
    found = history(scene, cycles, np.array([0.0, 0.2, 0.35, 1.0]))
    alone = history(scene, cycles, np.array([0.2]))
    assert_allclose(found.u[:, 1], alone.u[:, 0], rtol=1e-14)
    ends = solve(scene, [*cycles, *(cycles + 1)], 1e-8)
    apart = np.abs(found.u[:, [0, -1]] - ends.u_c.reshape(2, 3).T)
    assert np.all(apart <= (found.error[:, None] + ends.error.reshape(2, 3).T) * found.u[:, -1:])
    assert_allclose(found.fields.p[:, 0], ends.p[:3], rtol=1e-7)


@pytest.mark.parametrize("cutoff", [False, True])
@pytest.mark.parametrize("k", [None, 1e5])
def test_a_measured_history_of_equal_cycles_is_a_table(k: float | None, cutoff: bool) -> None:
    table, number = made(1e-5, load=ZIGZAG, k=k, cutoff=cutoff), 4
    times = [ZIGZAG.period * n + t for n in range(number) for t in ZIGZAG.times_s[1:]]
    values = (ZIGZAG.values_mm[0], *(ZIGZAG.values_mm[1:] * number))
    measured = replace(table, load=HistoryLoad((0.0, *times), values, ZIGZAG.period))
    one, other = (history(scene, np.array([0.0, 3.0])) for scene in (table, measured))
    assert_allclose(other.u, one.u, rtol=1e-11)
    assert_allclose(other.fields.p, one.fields.p, rtol=1e-8, atol=1e-8)
    assert np.all(other.error <= 1e-11)
    with pytest.raises(UsageError, match="the last one begins after 3"):
        history(measured, np.array([4.0]))


def test_half_a_cycle_that_only_rises() -> None:
    """One line has no kink, and no peak."""
    measured = replace(reference_scene("S2"), load=HistoryLoad((0.0, 1.0), (0.0, 1e-4), 0.5))
    assert np.all(np.diff(history(measured, np.array([1.0])).u) > 0.0)


@pytest.mark.parametrize("k", [None, 1e5])
def test_many_phases_cost_no_more_integrations(k: float | None, monkeypatch: Any) -> None:
    """The cycle was cut at every phase."""
    steps = []
    counted = wear_in_contact

    def count(*arguments: Any) -> Any:
        steps.append(1)
        return counted(*arguments)

    monkeypatch.setattr("wear.loss_of_contact.period_map.wear_in_contact", count)
    scene, at = made(1e-4, k=k, cutoff=True), []
    for phases in (np.linspace(0.0, 1.0, 5), np.linspace(0.0, 1.0, 4001)):
        steps.clear()
        found = history(scene, np.array([0.0, 2.0]), phases)
        at.append((len(steps), found.u[:, :: (len(phases) - 1) // 4]))
    assert at[1][0] <= 4 * at[0][0]
    assert_allclose(at[0][1], at[1][1], rtol=1e-12)


def test_no_wear_inside_cycles_without_pressure() -> None:
    found = history(made(closure=1.0), np.array([0.0, 1e6]))
    assert not found.u.any()
    assert not found.error.any()


@pytest.mark.parametrize(
    ("cycles", "phases", "names"),
    [
        ([np.nan], 0.5, ["cycles"]),
        ([1.5, -1], [1.5], ["cycles", "cycles", "phases"]),
        ([], [], ["cycles", "phases"]),
        (1e13, [np.nan], ["cycles", "phases"]),
        ("a", "a", ["cycles", "phases"]),
        (1, [[0.5]], ["phases"]),
    ],
)
def test_every_fault_of_a_request_is_named(cycles: Any, phases: Any, names: list[str]) -> None:
    """They were silent, or endless, or errors of NumPy, and came with the first chunk."""
    with pytest.raises(UsageError) as fault:
        fields_inside("section4", cycles, phases)
    assert [line.partition(":")[0] for line in str(fault.value).splitlines()] == names


def test_one_cycle_and_one_phase_are_a_history() -> None:
    (found,) = fields_inside("section4", 5, 0.5)
    assert found.u.shape == (1, 1)
