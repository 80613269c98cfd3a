"""Ordinary scenes that once took minutes, or were refused; and analysis against numerics."""

import json
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tests.judges import honest, true_wear
from tests.references import DATA
from tests.wear.reference_scenes import made
from tests.wear.test_cycle_count import between
from tests.wear.test_cycle_loss_of_contact import loads, supported, with_load
from wear import cycles as count
from wear import direct
from wear.binding import bind
from wear.faults import AccuracyError
from wear.load import Harmonics, Sine, Table
from wear.loss_of_contact.increments import Coordinate, IncrementSeries, SeriesDomain
from wear.regime import asymptote
from wear.scene import Scene, load_scene
from wear.solver import solve

SLOW = json.loads((DATA / "slow.json").read_text())
CYCLES: list[int] = SLOW["cycles"]
RESOLVED = 1e-11
MOST_CYCLES_INTEGRATED = 4000


def scene_of(i: int) -> Scene:
    """The scene of that number, its table of rows as a load."""
    tables: dict[str, Any] = json.loads(json.dumps(SLOW["scenes"][i]["scene"]))
    load = tables["load"]
    if load["kind"] != "table":
        return Scene.from_dict(tables)
    rows = load["rows"]
    tables["load"] = {"kind": "sine", "amplitude_mm": 1e-4, "period_s": rows[-1][0]}
    times, values = zip(*rows, strict=True)
    return replace(Scene.from_dict(tables), load=Table(times, values))


@pytest.mark.parametrize("i", [1, 2, 5, 7])
def test_slow_wear_with_loss_of_contact_is_counted(i):
    found = solve(scene_of(i), CYCLES, rtol=RESOLVED)
    assert np.all(found.error <= RESOLVED)
    assert found.cost["cycles_integrated"] <= MOST_CYCLES_INTEGRATED


@pytest.mark.parametrize(("i", "cycle"), [(0, 1456392), (3, 1855967), (6, 247238)])
def test_the_cycle_of_arrest_is_known_to_analysis_and_to_numerics(i, cycle):
    scene = scene_of(i)
    found = asymptote(scene)
    assert found.arrest_cycle == cycle
    counted = solve(scene, sorted({*CYCLES, cycle - 1, cycle, 10**12}), rtol=1e-12)
    assert counted.cost["cycles_integrated"] <= MOST_CYCLES_INTEGRATED
    assert np.all(counted.error <= RESOLVED)
    wear = dict(zip(counted.cycles.tolist(), counted.u_c.tolist(), strict=True))
    before, after, long_after = (wear[n] for n in (cycle - 1, cycle, 10**12))
    assert before < after == long_after
    assert after == pytest.approx(found.arrest_wear_mm, rel=1e-13)


def agree(scene: Scene) -> None:
    """The long-time formulas and the wear after many cycles."""
    found = asymptote(scene)
    wear = solve(scene, [10**9, 10**12], rtol=1e-12).u_c
    if found.regime == "arrest":
        assert found.arrest_wear_mm is not None
        assert np.all(wear <= found.arrest_wear_mm * (1 + 1e-12))
        if found.arrest_cycle is not None and found.arrest_cycle < 10**9:
            assert wear == pytest.approx(found.arrest_wear_mm, rel=1e-12)
    elif found.offset_mm is not None:
        steady, drift = found.wear_per_cycle_mm, found.log_coefficient_mm
        assert steady is not None
        assert drift is not None
        # What is left of the expansion falls like 1/u; rounding of u grows with it.
        left = wear[0] - steady * 1e9 - drift * np.log(1e9) - found.offset_mm
        size = scene.initial_roughness + abs(found.offset_mm) + abs(drift) * np.log(1e9)
        assert abs(left) <= 1e3 * size**2 / wear[0] + 1e-14 * wear[0]


def test_the_offset_is_read_once_contact_is_never_lost():
    agree(scene_of(5))


def test_a_series_goes_on_to_a_limit_wear_without_its_rounding():
    """All of its terms gave increments that fall like w^5 where they fall like w."""
    scene = load_scene("section4-cutoff").with_(
        {
            "bearing.roughness_growth": 1 / 3 - 6e-5,
            "bearing.roughness_mm": 5.4879e-4,
            "bearing.wear_coefficient": 1.0084e-5,
            "contact.closure_mm": 8.939569e-4,
            "contact.max_pressure_MPa": 235.674,
        }
    )
    times = np.array([0.0, 0.277498, 0.386864, 0.398226, 0.400463, 1.0]) * 0.06
    values = (2.01e-5, -5.40083e-4, -9.006427e-6, -4.141381e-4, 4.3198511e-4, 2.01e-5)
    scene = replace(scene, load=Table(tuple(times.tolist()), values))
    cycles = np.array([3.0, 3.2, 3.4, 3.6, 4.0]) * 1e6
    limit = asymptote(scene).arrest_wear_mm
    assert limit is not None
    left = limit - count.sweep([scene], cycles, 1e-13).u_c[0]
    falls = -np.diff(np.log(left)) / np.diff(cycles)
    assert falls == pytest.approx(falls[0], rel=1e-4)


def test_at_a_flat_peak_the_approach_to_the_limit_wear_has_its_error():
    """There the increments fall like d^(5/4), which is no power of the series' coordinate."""
    flat = Harmonics(-3.9e-4, (9.7e-4, -2.425e-4), (), 0.06)
    scene = made(
        5e-9, 0.0, flat, roughness=5.5e-4, closure=1.46e-4, law="exponential", k=1850.0, cutoff=True
    )
    coarse, fine = (count.sweep([scene], [10**8, 10**9, 10**10], rtol) for rtol in (1e-5, 1e-13))
    assert honest(coarse.u_c, coarse.error, fine.u_c, fine.error)


def test_a_count_with_loss_of_contact_ends_where_the_roughness_vanishes():
    """A cycle led beyond that wear, where plans without an end were made for ever."""
    load = Harmonics(1.62e-4, (3.45e-4,), (3.46e-4,), 0.06)
    scene = made(1e-11, -0.67, load, roughness=6.63e-5, closure=5.54e-5, cutoff=True)
    assert asymptote(scene).regime == "finite-time"
    wear, error = count.sweep([scene], [10, 10**9], 1e-9)
    assert error[0, 0] <= 1e-9
    assert wear[0, 1] == pytest.approx(6.63e-5 / 0.67, rel=0.02)
    assert error[0, 1] == np.inf


def test_a_grazing_wear_that_rounding_hides_ends_the_series_before_it():
    """At f = 1/3 with a rough pin the series became no number, and 1e8 cycles were walked."""
    pin = {"wear_coefficient": 0.0, "roughness_mm": 9.22e-6, "roughness_growth": 0.0}
    sine = Sine(-1.82e-6, 0.06)
    scene = made(1e-11, 1 / 3, sine, roughness=4.397e-5, pin=pin, cutoff=True)
    coarse, fine = (count.sweep([scene], [10**7, 10**9], rtol) for rtol in (1e-7, 1e-11))
    assert np.all(fine.error <= 1e-11)
    assert honest(coarse.u_c, coarse.error, fine.u_c, fine.error)


def test_contact_that_no_step_resolves_ends_with_its_reason():
    """Wear that closes the gap without end, by the exponential law: steps shrank for ever."""
    phases = np.array([0.0, 5.6e-7, 0.406, 0.40600063, 0.74554, 0.74554054, 1.0])
    values = (-4.08e-6, -2.11e-6, 1.86e-6, 1.79e-6, 6.4e-7, 1.03e-6, -4.08e-6)
    pin = {"wear_coefficient": 9.4e-8, "roughness_mm": 0.0, "roughness_growth": 0.0}
    scene = made(
        5.7e-9, 0.05, Table(tuple((0.06 * phases).tolist()), values), roughness=7.98e-5,
        closure=1.478e-4, law="exponential", pin=pin, cutoff=True,
    )  # fmt: skip
    found = count.sweep([scene], [1, 50, 9000], 1e-4)
    assert np.all(found.error[0, :2] <= 1e-4)


@settings(max_examples=8)
@given(loads(), between(-7.5, -4), between(-0.2, 1.0), st.booleans(), st.booleans())
def test_analysis_and_numerics_agree_on_random_scenes(load, K, f_c, pin, exponential):
    scene = with_load(load, 10**K, f_c, pin)
    if exponential:
        scene = scene.with_({"contact.law": "exponential"})
    assume(float(bind(scene).margin(0.0, load.maximum)) > 1e-6)
    try:
        agree(scene)
    except AccuracyError:  # said, with status 3: there is nothing to compare
        assume(False)


def test_a_trial_far_beyond_a_series_is_given_up():
    """There the increment would overflow."""
    span = SeriesDomain(Coordinate(0.0), 1.0, 2.0, 1.0, 0.0)
    steep = np.array([[0.0, 500.0]])
    series = IncrementSeries(span, span.grid, np.ones(1), steep, np.zeros((1, 6)))
    assert series.walk(3.0, 9.0, 5) == ([3.0], [])


@settings(max_examples=4)
@given(between(-8.5, -7.9), between(-0.2, 0.6), between(-4.3, -3.3))
def test_two_rough_solids_on_a_nearly_rigid_support(K, f_c, swing):
    scene = supported(10**K, f_c, True, 5e10, Sine(10**swing, 0.06))
    assume(float(bind(scene).margin(0.0, scene.periodic_load.maximum)) > 1e-6)
    found = count.wear_after(bind(scene), scene.periodic_load, np.array([1.0, 2.0]), 1e-12)
    assert honest(found.u_c, found.error, true_wear(scene, [1, 2]))


@pytest.mark.parametrize("cycles", [[10.0, 300.0], [10.0, 300.0, 1e8]])
def test_wear_that_runs_away_to_full_contact(cycles):
    """Nearly all cycles lie in the last thousandth of the coordinate: they were walked one by one,
    without an end; and a range of wear whose first panels had failed was taken for a whole one."""
    load = Table((0.0, 0.02, 0.04, 0.06), (-6.675e-5, -2.64e-5, 6.11e-5, -6.675e-5))
    pin = {"wear_coefficient": 1e-6}
    scene = made(5.732e-8, 0.0743, load, roughness=1.0476e-4, closure=2.692e-4, law="exponential",
                 pin=pin, cutoff=True)  # fmt: skip
    found = count.wear_after(bind(scene), load, np.array(cycles), 1e-9)
    want = direct.integrate(bind(scene), load, [10, 300], 1e-6)
    assert np.all(found.error <= 1e-9)
    assert honest(found.u_c[:2], found.error[:2], want.u, want.error)
