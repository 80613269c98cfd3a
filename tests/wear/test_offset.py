"""The offset B: reference values, and the steady state read off the count of cycles."""

import dataclasses

import numpy as np
import pytest

from tests.references import VALUES
from tests.wear.reference_scenes import made
from wear.load import Harmonics
from wear.offset import offset
from wear.regime import Asymptote, asymptote
from wear.scene import Scene, load_scene
from wear.solver import solve

CONSTANTS = VALUES["asymptotic_constants"]
HALF, FOUR_TENTHS = made(f_c=0.5), made(1e-4, 0.4)


def _derived(scene: Scene) -> tuple[float, float, Asymptote]:
    """Return the rate and the drift that the formulas give, with all that they say."""
    found = asymptote(scene)
    assert found.wear_per_cycle_mm is not None
    assert found.log_coefficient_mm is not None
    return found.wear_per_cycle_mm, found.log_coefficient_mm, found


@pytest.mark.parametrize(
    ("scene", "key"), [(HALF, "f0.5_K1e-6"), (FOUR_TENTHS, "f0.4_K1e-4")], ids=["half", "fast"]
)
def test_the_constants_of_the_asymptote(scene: Scene, key: str) -> None:
    known = CONSTANTS[key]
    rate, drift, _ = _derived(scene)
    found = offset(scene, rate, drift)
    assert found is not None
    assert found.steady_state.rate == pytest.approx(float(known["R"]), rel=1e-14)
    assert found.steady_state.drift == pytest.approx(float(known["A"]), rel=1e-11)
    true = float(known["B"].split()[0])
    assert found.value == pytest.approx(true, rel=3e-11)
    assert abs(found.value - true) <= found.error


def _two_solids() -> Scene:
    scene = load_scene("section5")
    assert scene.pin is not None
    return dataclasses.replace(
        scene,
        bearing=dataclasses.replace(scene.bearing, roughness_growth=0.5),
        pin=dataclasses.replace(scene.pin, roughness_growth=0.4),
    )


@pytest.mark.parametrize(
    "scene",
    [
        HALF,
        made(f_c=0.5, k=1e5),
        _two_solids(),
        made(f_c=0.5, load=Harmonics(1e-4, (2e-4, 1e-4), (3e-4, -1e-4), 0.06)),
        made(f_c=0.5, law="exponential"),
        made(f_c=0.5, cutoff=True),
        made(f_c=0.5, cutoff=True, k=1e5),
    ],
    ids=["rigid", "compliant", "two solids", "harmonics", "exponential", "loss", "compliant loss"],
)
def test_the_steady_state_found_is_the_derived_one_and_wear_tends_to_it(scene: Scene) -> None:
    """What is left of the wear falls like ln(N)/N."""
    rate, drift, said = _derived(scene)
    found = offset(scene, rate, drift)
    assert found is not None
    assert found.steady_state.rate == pytest.approx(rate, rel=1e-13)
    assert found.steady_state.drift == pytest.approx(drift, rel=1e-9)
    assert said.offset_mm == found.value
    assert found.error <= 1e-8 * abs(found.value)
    cycles = np.array([1e5, 1e6, 1e7])
    wear = solve(scene, cycles, 1e-13).u_c
    left = np.abs(wear - rate * cycles - drift * np.log(cycles) - found.value)
    assert np.all(left[1:] < left[:-1] / 7)


def test_the_section_4_of_the_note() -> None:
    scene = load_scene("section4")
    rate, drift, said = _derived(scene)
    assert said.offset_mm is not None
    line = rate * 1e8 + drift * np.log(1e8) + said.offset_mm
    wear = solve(scene, [10**8], 1e-12).u_c[0]
    assert line == pytest.approx(wear, abs=1e-4)  # A^2 ln(N)/(R N) is left
    assert drift == pytest.approx(float(VALUES["sec4_f0.25"]["A_log_mm"]), rel=1e-13)


@pytest.mark.parametrize("scene", ["section3", "section5"])
def test_no_offset_where_the_steady_state_is_out_of_reach(scene: str) -> None:
    assert _derived(load_scene(scene))[2].offset_mm is None


def test_the_offset_remembers_that_contact_was_lost() -> None:
    found = asymptote(made(f_c=0.5, cutoff=True)).offset_mm
    without = asymptote(HALF).offset_mm
    assert found is not None
    assert without is not None
    assert found < without


@pytest.mark.parametrize(
    "scene",
    [made(f_c=0.25, cutoff=True), load_scene("f-one-third")],
    ids=["arrest", "contact in a fixed part of the cycle"],
)
def test_no_offset_with_a_cutoff_that_stays(scene: Scene) -> None:
    assert asymptote(scene).offset_mm is None
    assert offset(scene, 1e-8, 1e-3) is None
