"""Any number of cycles: against reference values, an independent integrator, and identities."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from tests.judges import honest, true_wear
from tests.wear.reference_scenes import REFERENCE, made, reference_scene, reference_wear
from wear import cycles as count
from wear.binding import bind
from wear.load import Constant, Harmonics
from wear.numerics.gauss import FloatArray
from wear.scene import Scene


def counted(
    scene: Scene, cycles: FloatArray, rtol: float, start: float = 0.0, deadline: float = np.inf
) -> count.Wear:
    return count.wear_after(bind(scene), scene.periodic_load, cycles, rtol, start, deadline)


@pytest.mark.parametrize("rtol", [1e-6, 1e-9, 1e-12, 1e-13])
@pytest.mark.parametrize("name", REFERENCE)
def test_reference_values(name, rtol):
    cycles, want = reference_wear(name)
    found = counted(reference_scene(name), cycles, rtol)
    assert np.all(found.error <= rtol)
    assert honest(found.u_c, found.error, want)


@pytest.mark.parametrize("name", ["S1", "S2", "S4"])
def test_cost_does_not_grow_with_the_cycles(name):
    scene = reference_scene(name)
    costs = [counted(scene, np.array([n]), 1e-12).cost for n in (1e3, 1e6, 1e9, 1e12)]
    assert max(cost.cycles_integrated for cost in costs) <= 160
    assert counted(scene, np.array([9000.0]), 1e-12).cost.cycles_integrated <= 80


def between(low: float, high: float) -> st.SearchStrategy[float]:
    """A thousand steps: no denormals, which a scene file refuses."""
    return st.integers(0, 1000).map(lambda i: low + (high - low) * i / 1000)


@st.composite
def scenes(draw: st.DrawFn) -> Scene:
    """Scenes far beyond the note's: wear fast and slow, loads of a few harmonics."""
    roughness = 10 ** draw(between(-4, -3))
    swing = roughness * 10 ** draw(between(-1.5, 0.4))
    K = 10 ** draw(between(-8, -3))
    half = between(-0.5, 0.5)
    load = Harmonics(
        swing * draw(half), (swing * draw(half),), (swing, swing * draw(between(-0.3, 0.3))), 0.06
    )
    pin = draw(st.booleans()) and {
        "wear_coefficient": K * 10 ** draw(between(-1, 0.6)),
        "roughness_mm": roughness * draw(between(0.1, 1)),
        "roughness_growth": draw(between(-0.2, 0.3)),
    }
    f_c, closure = draw(between(-0.3, 0.6)), roughness * draw(between(0, 8))
    k = draw(st.none() | between(3, 8).map(lambda e: 10**e))
    scene = made(K, f_c, load, roughness=roughness, closure=closure, pin=pin, k=k)
    return scene.with_({"contact.pin_wear_opens_gap": bool(pin) and draw(st.booleans())})


@settings(max_examples=10)
@given(scene=scenes(), rtol=st.sampled_from([1e-6, 1e-9, 1e-12]))
def test_drawn_scenes_against_an_independent_integrator(scene, rtol):
    cycles = [1, 5]
    found = counted(scene, np.array(cycles, dtype=float), rtol)
    want = true_wear(scene, cycles)
    assert honest(found.u_c, found.error, want)


@pytest.mark.parametrize(("name", "cycles"), [("S2", [1, 10]), ("S8_1", [1])])
def test_the_independent_integrator_agrees_with_the_references(name, cycles):
    want = [REFERENCE[name][cycle] for cycle in cycles]
    assert_allclose(true_wear(reference_scene(name), cycles), want, rtol=1e-15)


@pytest.mark.parametrize("first", [3.0, 40.0, 5000.0])
def test_cycles_add_up(first):
    """Going on from the wear after some cycles gives what going through gives."""
    scene = reference_scene("S5")
    through = counted(scene, np.array([first, first + 700.0]), 1e-12)
    on = counted(scene, np.array([700.0]), 1e-12, start=float(through.u_c[0]))
    assert_allclose(on.u_c[0], through.u_c[1], rtol=1e-13)


@given(cycles=st.integers(1, 10**12))
@settings(max_examples=20)
@example(cycles=5)
@example(cycles=6)
def test_cycles_until_a_wear_is_the_inverse(cycles):
    scene = reference_scene("S4")
    model, load = bind(scene), scene.periodic_load
    wear = counted(scene, np.array([float(cycles)]), 1e-12).u_c
    found = count.first_passage(model, load, wear, 1e-12)
    assert abs(found.cycles[0] - cycles) <= 2e-12 * cycles


def test_wear_that_is_never_reached_takes_for_ever():
    scene = reference_scene("S6")
    found = count.first_passage(bind(scene), scene.periodic_load, np.array([1e-5, 7e-3, 0.0]), 1e-9)
    assert found.cycles.tolist() == [1.0, np.inf, 0.0]


def test_no_pressure_no_wear():
    found = counted(made(closure=1.0), np.array([0.0, 1.0, 1e12]), 1e-9)
    assert found.u_c.tolist() == [0.0, 0.0, 0.0]
    assert "adds less" in found.notices[0]


def test_vanishing_roughness_is_said_and_not_solved():
    """With f < 0 and the pin pressed in, the roughness is gone after finitely many cycles."""
    found = counted(made(f_c=-0.5, load=Constant(2e-3, 0.06)), np.array([1.0, 1e6]), 1e-9)
    assert found.error[0] < 1e-9
    assert found.error[1] == np.inf
    assert "roughness vanishes" in found.notices[0]
    assert found.u_c[1] <= 3.6e-4 / 0.5
