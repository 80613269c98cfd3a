"""Direct integration: against references, against itself, against what must not change."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from wear import direct
from wear.binding import bind
from wear.direct.problem import Setting, scaled_ode, widest_step
from wear.direct.step import Meter, leg
from wear.load import Constant, Sine
from wear.scene import Scene, load_scene
from wear.solver import solve

from .reference_scenes import REFERENCE, made, reference_scene

ROUNDOFF = float(np.finfo(float).eps)


def integrate(scene: Scene, cycles, rtol, method="DOP853"):
    return direct.integrate(bind(scene), scene.load, cycles, rtol, method)


def true_errors(name, result):
    reference = [REFERENCE[name][cycle] for cycle in result.cycles]
    return np.abs(result.u / np.array(reference) - 1.0)


@pytest.mark.parametrize(
    ("name", "rtol", "cycles"),
    [
        *((name, rtol, [1, 10]) for name in ("S1", "S3d", "S6", "S8_1") for rtol in (1e-6, 1e-10)),
        *((name, rtol, [1, 10]) for name in ("S2", "S3a", "S4") for rtol in (1e-3, 1e-8, 1e-14)),
        *((name, 1e-6, [100]) for name in ("S4", "S6")),
    ],
)
def test_the_estimate_is_not_below_the_true_error_and_says_what_is_reached(name, rtol, cycles):
    """Roundoff and SciPy's smallest tolerance end what can be."""
    result = integrate(reference_scene(name), cycles, rtol)
    assert np.all(true_errors(name, result) <= result.error)
    assert bool(np.max(result.error) <= rtol) is (rtol > 1e-13)
    assert result.stopped is None


@pytest.mark.parametrize(
    ("name", "method"),
    [
        *(("S2", method) for method in direct.METHODS if method != "DOP853"),
        ("S3d", "Radau"),  # two rough solids, of which the Jacobian knows
        ("S3d", "LSODA"),
        ("S7", "BDF"),
    ],
)
def test_every_method_keeps_the_promise(name, method):
    """In one cycle: how errors add up from cycle to cycle does not depend on the method."""
    result = integrate(reference_scene(name), [1], 1e-7, method)
    assert np.all(true_errors(name, result) <= result.error)
    assert np.all(result.error <= 1e-7)


@pytest.mark.parametrize(
    ("method", "order"), [("RK23", 3), ("RK45", 5), ("DOP853", 8), ("Radau", 5)]
)
def test_steps_of_fixed_length_converge_with_the_order_of_the_method(method, order):
    """On half a cycle (over a whole one the errors of a smooth periodic function cancel)."""
    scene = reference_scene("S2")
    of = scaled_ode(bind(scene), scene.load)
    exact = leg(of, 0.0, 0.0, 0.4, Setting("DOP853", 1e-13, 1.0), Meter(), 1e-3).u
    counts = (8, 12, 16, 24) if order == 8 else (32, 64, 128)
    errors = [
        leg(of, 0.0, 0.0, 0.4, Setting(method, 1.0, 1.0), Meter(), 0.4 / count).u / exact - 1.0
        for count in counts
    ]
    slope = np.polyfit(np.log(counts), np.log(np.abs(errors)), 1)[0]
    assert -slope == pytest.approx(order, abs=0.6)


@pytest.mark.parametrize("factor", [1e-6, 0.125, 1e6])
def test_another_unit_of_length_scales_the_wear(factor):
    """Pressures and the dimensionless numbers stay."""
    lengths = {"roughness": 3.6e-4 * factor, "closure": 1.08e-3 * factor}
    scene = made(load=Sine(5e-4 * factor, 0.06), **lengths)
    found = integrate(scene.with_({"motion.radius_mm": 22.0 * factor}), [1, 10], 1e-10)
    want = [factor * REFERENCE["S2"][cycle] for cycle in (1, 10)]
    np.testing.assert_allclose(found.u, want, rtol=2e-11)


@settings(max_examples=8)
@given(factor=st.floats(0.01, 100.0))
def test_wear_coefficient_and_period_trade_off(factor):
    """K enters as K T only, and so does the rotation speed."""
    slow, fast = made(1e-5 * factor), made(1e-5, load=Sine(5e-4, 0.06 * factor))
    one, other = (integrate(scene, [1, 5], 1e-8) for scene in (slow, fast))
    np.testing.assert_allclose(one.u, other.u, rtol=2e-8)


@settings(max_examples=8)
@given(
    f_c=st.integers(-50, 1000).map(lambda thousandth: thousandth / 1000),
    log_K=st.floats(-7, -3),
    amplitude=st.floats(1e-9, 2e-3),
    closure=st.floats(1e-5, 2e-3),
    method=st.sampled_from(["RK45", "Radau", "LSODA"]),
)
def test_methods_agree_on_drawn_scenes(f_c, log_K, amplitude, closure, method):
    scene = made(10.0**log_K, f_c, Sine(amplitude, 0.06), closure=closure)
    one, other = (integrate(scene, [1, 3], 1e-6, name) for name in ("DOP853", method))
    assume(one.stopped is None and other.stopped is None)  # the roughness may vanish
    allowed = (one.error + other.error) * one.u
    assert np.all(np.abs(one.u - other.u) <= allowed)


def test_steps_resolve_the_pulses_of_a_large_swing():
    """U = 10 h_0: pulses of a hundredth of a period once the contact is worn in."""
    scene = made(f_c=0.0, load=Sine(1.08e-2, 0.06))
    of = scaled_ode(bind(scene), scene.load)
    deviation = math.sqrt(3.6e-4 / (4 * 4 * math.pi**2 * 1.08e-2))  # of exp(4 U_a/sigma)
    assert deviation < 0.015
    assert 0.0 < widest_step(of, 0.0, 1.0) <= deviation
    one, other = (integrate(scene, [1, 10], 1e-7, name) for name in ("DOP853", "LSODA"))
    assert np.all(np.abs(one.u / other.u - 1.0) <= one.error + other.error)


def test_without_a_pulse_steps_may_be_long():
    scene = reference_scene("S7")
    assert isinstance(scene.load, Constant)
    assert widest_step(scaled_ode(bind(scene), scene.load), 0.0, 100.0) == 100.0


def test_the_end_of_the_model_is_told_with_what_there_is():
    """f_c < 0 and always in contact: the roughness of the only rough surface reaches zero."""
    result = integrate(made(1e-3, -0.5, Constant(3e-3, 0.06)), [0, 1000], 1e-8)
    assert result.cycles == (0,)
    assert "has become smooth at u_c = 0.00072 mm" in result.stopped


def test_the_fresh_state_costs_nothing():
    result = integrate(reference_scene("S2"), [0], 1e-10)
    assert result.u.tolist() == [0.0]
    assert result.error.tolist() == [0.0]
    assert result.cost.cycles_integrated == 0


@pytest.mark.parametrize("name", ["section4", "section4-cutoff"])
def test_progress_is_told_from_cycle_to_cycle(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("wear.progress.SILENT", 0.0)
    monkeypatch.setattr("wear.progress.APART", 0.0)
    told: list[str] = []
    solve(load_scene(name), [4], 1e-6, "DOP853", progress=told.append)
    first = [text for text in told if text.startswith("DOP853, run 1: cycle ")]
    cycles = [int(text.split()[4]) for text in first]
    assert cycles == sorted(cycles)
    assert set(cycles) >= {0, 1, 2, 3}
    assert all(text.endswith(" s left") and " of 4, about " in text for text in told)


@pytest.mark.filterwarnings("error")
def test_a_law_without_a_largest_pressure_overflows_quietly():
    """The closure is far below zero; the rate grows beyond all numbers and wear ends it."""
    scene = load_scene("section4").with_({"contact.law": "exponential", "load.amplitude_mm": 1.0})
    assert np.isfinite(solve(scene, [1, 2], rtol=1e-6).u_c).all()
