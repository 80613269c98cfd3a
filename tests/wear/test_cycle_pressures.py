"""Pressures over a cycle, by SciPy's integration of one cycle and quadrature on a fine grid."""

import json
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

from wear.binding import bind
from wear.cycle_pressures import cycle_pressures
from wear.load import Block, Blocks, Constant, Harmonics, HistoryLoad, Sine, Table
from wear.scene import Scene, load_scene
from wear.solver import solve

from .reference_scenes import made

GRID = np.linspace(0.0, 1.0, 100_001)
SAW = Table((0.0, 0.01, 0.025, 0.06), (0.0, 5e-4, -2e-4, 0.0))
TWO = Harmonics(1e-4, (2e-4,), (0.0, 3e-4), 0.06)


def reference(scene: Scene, cycle: int) -> tuple[float, float]:
    """Peak and mean pressure (MPa) of a cycle, from the wear with which it begins."""
    model, load = bind(scene), scene.periodic_load
    start = float(solve(scene, [cycle - 1], 1e-12).u_c[0])

    def rate(phase: float, added: Any) -> Any:
        return load.period * model.rate(start + added, load(phase))

    edges = np.unique([0.0, *load.kinks, 1.0])
    wear, phases, added = [], [], np.zeros(1)
    for begin, end in pairwise(edges):
        inner = GRID[(begin < GRID) & (end > GRID)]
        at = np.concatenate([[begin], inner, [end]])
        found = solve_ivp(
            rate, (begin, end), added, "DOP853", at, max_step=0.01, rtol=1e-12, atol=1e-22
        )
        added = found.y[:, -1]
        wear.append(start + found.y[0])
        phases.append(at)
    pressure = [model.fields(u, load(x)).p for u, x in zip(wear, phases, strict=True)]
    mean = sum(np.trapezoid(p, x) for p, x in zip(pressure, phases, strict=True))
    return max(float(np.max(p)) for p in pressure), float(mean)


SCENES = {
    "section4": load_scene("section4"),
    "section3": load_scene("section3"),
    "springs": made(1e-5, k=1e5),
    "fast": made(1e-4),
    "saw": replace(load_scene("section4"), load=SAW),
    "harmonics": replace(load_scene("section4"), load=TWO),
    "constant": replace(load_scene("section4"), load=Constant(5e-4, 0.06)),
}


@pytest.mark.parametrize("name", SCENES)
def test_peak_and_mean_are_those_of_a_fine_grid(name: str) -> None:
    cycles = np.array([1.0, 2.0, 300.0, 1e6])
    found = cycle_pressures(SCENES[name], cycles, 1e-10)
    expected = np.array([reference(SCENES[name], int(cycle)) for cycle in cycles])
    assert_allclose(found.peak, expected[:, 0], rtol=1e-7)
    assert_allclose(found.mean, expected[:, 1], rtol=1e-7)
    assert np.all(found.contact_fraction == 1.0)


def test_the_mean_is_what_archard_integrates() -> None:
    """The wear of 1000 cycles is K_c/(3 H_c) times the way of a cycle times all their means."""
    scene = SCENES["section4"]
    means = cycle_pressures(scene, np.arange(1.0, 1001.0), 1e-10).mean
    speed = 2.0 * np.pi * 22.0 * 2000.0 / 60.0
    wear = 1e-6 / (3.0 * 200.0) * speed * 0.06 * np.sum(means)
    assert wear == pytest.approx(solve(scene, 1000).u_c[0], rel=1e-9)


def test_the_share_of_contact_is_that_of_the_margin() -> None:
    """So little wear that the closure is the fresh one: contact where U sin > h_0 - 3 sigma."""
    scene = made(1e-20, closure=1.3e-3, cutoff=True)
    found = cycle_pressures(scene, np.array([1.0, 50.0]), 1e-10)
    share = 0.5 - np.arcsin((1.3e-3 - 3.0 * 3.6e-4) / 5e-4) / np.pi
    assert_allclose(found.contact_fraction, share, rtol=1e-6)
    sigma, h = 3.6e-4, 1.3e-3 - 5e-4 * np.sin(2.0 * np.pi * GRID)
    pressure = np.where(h <= 3.0 * sigma, 150.0 * (1.0 + np.tanh(4.0 - 2.0 * h / sigma)), 0.0)
    assert_allclose(found.mean, np.trapezoid(pressure, GRID), rtol=1e-4)  # the grid's
    assert_allclose(found.peak, np.max(pressure), rtol=1e-9)


def test_contact_gets_shorter_and_is_lost() -> None:
    found = cycle_pressures(load_scene("section4-cutoff"), np.array([1.0, 100.0, 1e4]), 1e-8)
    assert 0.5 > found.contact_fraction[0] > found.contact_fraction[1] > 0.0
    assert [row[2] for row in found] == [0.0, 0.0, 0.0]


def test_contact_that_does_not_end_lasts_where_the_pressure_is_too_small_for_a_number() -> None:
    scene = load_scene("section4").with_({"load.amplitude_mm": 0.1})
    found = cycle_pressures(scene, np.array([1.0]), 1e-10)
    assert found.contact_fraction[0] == 1.0
    assert found.peak[0] == pytest.approx(scene.contact.max_pressure_MPa, rel=1e-9)


def test_each_block_has_its_own_cycles() -> None:
    parts = (Block(Sine(2e-4, 0.06), 3), Block(Sine(5e-4, 0.03), 5))
    scene = replace(SCENES["section4"], load=Blocks(parts))
    found = cycle_pressures(scene, np.array([3.0, 4.0]), 1e-10)
    small = replace(scene, load=parts[0].load)
    assert found.mean[0] == pytest.approx(reference(small, 3)[1], rel=1e-7)
    assert found.peak[1] > 3.0 * found.peak[0]


@pytest.mark.parametrize(
    "changes", [{}, {"k": 1e5, "pin": True}, {"cutoff": True}, {"k": 1e5, "cutoff": True}]
)
def test_a_history_of_equal_cycles_is_a_table(changes: dict[str, Any]) -> None:
    scene, number = made(1e-5, load=SAW, **changes), 3
    times = np.concatenate(
        [[0.0], *(SAW.period * k + np.array(SAW.times_s[1:]) for k in range(number))]
    )
    values = (SAW.values_mm[0], *(SAW.values_mm[1:] * number))
    record = HistoryLoad(tuple(times.tolist()), values, SAW.period)
    found, want = (
        cycle_pressures(each, np.array([0.0, 1.0, 3.0]), 1e-10)
        for each in (replace(scene, load=record), scene)
    )
    assert np.isnan(found.peak[0])
    assert want.mean[2] != want.mean[1]
    for one, other in zip(found, want, strict=True):
        assert_allclose(one[1:], other[1:], rtol=1e-9)


def test_there_is_no_cycle_before_the_first() -> None:
    history = solve("section4", [0, 1])
    assert np.isnan(history.pressures.peak).tolist() == [True, False]
    assert history.as_json()["peak_pressure_MPa"] == [None, pytest.approx(243.2804655519, rel=1e-9)]


def test_reactions_follow_the_pressures() -> None:
    sized = SCENES["section4"].with_({"contact.width_mm": 20.0, "contact.length_mm": 69.0})
    document = json.loads(json.dumps(solve(sized, [1, 10]).as_json()))
    for name in ("peak", "mean"):
        force = np.array(document[f"{name}_pin_reaction_N"])
        assert_allclose(force, 20.0 * 69.0 * np.array(document[f"{name}_pressure_MPa"]), rtol=1e-15)


def test_a_run_that_was_stopped_has_none() -> None:
    history = replace(solve("section4", [1]), stopped=True)
    assert history.as_json()["mean_pressure_MPa"] == [None]
