"""The offset B: reference values, and one value whatever the cycle that it is read off from."""

from __future__ import annotations

import dataclasses
import json
from pathlib import Path

import numpy as np
import pytest
import sympy as sp

from derive.laws import TANH
from derive.results.compliant import drift_coefficient
from derive.results.expansion import Expansion as Symbolic
from derive.symbols import symbols
from tests.wear.reference_scenes import SINE, tables
from wear.load import Harmonics
from wear.offset import expand, offset
from wear.scene import Scene, load_scene, scene_from_tables
from wear.solver import solve

VALUES = json.loads((Path(__file__).parents[1] / "data" / "values.json").read_text())
CONSTANTS = VALUES["asymptotic_constants"]
HALF, FOUR_TENTHS = tables(f_c=0.5), tables(f_c=0.4, K=1e-4)


def _scene(made: dict[str, object]) -> Scene:
    return scene_from_tables(made)


@pytest.mark.parametrize(
    ("made", "key"), [(HALF, "f0.5_K1e-6"), (FOUR_TENTHS, "f0.4_K1e-4")], ids=["half", "fast"]
)
def test_the_constants_of_the_asymptote(made: dict[str, object], key: str) -> None:
    known, scene = CONSTANTS[key], _scene(made)
    expansion, found = expand(scene), offset(scene)
    assert expansion is not None
    assert found is not None
    assert expansion.rate == pytest.approx(float(known["R"]), rel=1e-14)
    assert expansion.log_coefficient == pytest.approx(float(known["A"]), rel=1e-13)
    true = float(known["B"].split()[0])
    assert found.value == pytest.approx(true, rel=1e-12)
    assert abs(found.value - true) <= found.error + 1e-17


def _two_solids() -> Scene:
    scene = load_scene("section5")
    assert scene.pin is not None
    return dataclasses.replace(
        scene,
        bearing=dataclasses.replace(scene.bearing, roughness_growth=0.5),
        pin=dataclasses.replace(scene.pin, roughness_growth=0.4),
    )


def _harmonics() -> Scene:
    load = Harmonics(1e-4, (2e-4, 1e-4), (3e-4, -1e-4), 0.06)
    return dataclasses.replace(_scene(HALF), load=load)


def _exponential() -> Scene:
    scene = _scene(HALF)
    return dataclasses.replace(scene, contact=dataclasses.replace(scene.contact, law="exponential"))


@pytest.mark.parametrize(
    "scene",
    [
        _scene(HALF),
        _scene(tables(f_c=0.5, k=1e5)),
        _two_solids(),
        _harmonics(),
        _exponential(),
    ],
    ids=["rigid", "compliant", "two solids", "harmonics", "exponential"],
)
def test_every_cycle_gives_the_same_offset(scene: Scene) -> None:
    cycles = (10_000, 30_000, 100_000, 300_000)
    expansion = expand(scene)
    assert expansion is not None
    wear = solve(scene, cycles, 1e-13).u_c
    found = [expansion.offset(float(u), n)[0] for u, n in zip(wear, cycles, strict=True)]
    assert np.ptp(found) <= 1e-12
    best = offset(scene)
    assert best is not None
    assert abs(best.value - found[0]) <= best.error + 1e-13


def test_the_section_4_of_the_note() -> None:
    """Steady after some ten million cycles; before, no cycle gives B."""
    found = offset(load_scene("section4"))
    assert found is not None
    assert found.cycle >= 1e6
    wear = solve(load_scene("section4"), [10**8], 1e-12).u_c[0]
    expansion = expand(load_scene("section4"))
    assert expansion is not None
    line = expansion.rate * 1e8 + expansion.log_coefficient * np.log(1e8) + found.value
    assert line == pytest.approx(wear, abs=1e-4)  # A^2 ln(N)/(R N) is left
    assert expansion.log_coefficient == pytest.approx(
        float(VALUES["sec4_f0.25"]["A_log_mm"]), rel=1e-13
    )


@pytest.mark.parametrize("scene", ["section3", "section5"])
def test_no_offset_where_the_steady_state_is_out_of_reach(scene: str) -> None:
    assert offset(load_scene(scene)) is None


@pytest.mark.parametrize("k", [None, 1e5])
def test_the_offset_with_a_cutoff_that_contact_outgrows(k: float | None) -> None:
    """Beyond some wear contact is permanent, and remembers the cycles in which it was not."""
    scene = _scene(tables(f_c=0.5, cutoff=True, k=k))
    found, without = offset(scene), offset(_scene(tables(f_c=0.5, k=k)))
    expansion = expand(scene)
    assert found is not None
    assert without is not None
    assert expansion is not None
    assert found.value < without.value
    cycles = (10_000, 300_000)
    wear = solve(scene, cycles, 1e-12).u_c
    for u, n in zip(wear, cycles, strict=True):
        assert expansion.offset(float(u), n)[0] == pytest.approx(found.value, abs=1e-12)


@pytest.mark.parametrize(
    "made",
    [
        tables(f_c=0.25, cutoff=True),
        load_scene("f-one-third").to_tables(),
    ],
    ids=["arrest", "contact in a fixed part of the cycle"],
)
def test_no_offset_with_a_cutoff_that_stays(made: dict[str, object]) -> None:
    assert offset(_scene(made)) is None


@pytest.mark.parametrize("slope", [0.0, -0.05])
def test_no_expansion_without_roughening(slope: float) -> None:
    assert expand(_scene(tables(f_c=slope))) is None


def test_numbers_and_symbols_average_alike() -> None:
    """The four drifts and two oscillations of the symbolic expansion, from the generated code."""
    names = symbols("sigma_c0 h_0 f_c U b_0 theta rho tau")
    sigma_c0, h_0, f_c, U, b_0, theta, rho, tau = names
    data = {sigma_c0: 3.6e-4, h_0: 1.08e-3, f_c: 0.4, U: SINE["amplitude_mm"], tau: 0}
    found = expand(_scene(FOUR_TENTHS))
    assert found is not None
    saturation = float(sp.tanh(4 - 2 / sp.Float("0.4")))
    data |= {b_0: 3.6e-4 / 0.4 - 1.08e-3, theta: saturation, rho: 0.4 * found.rate}
    for n in (1, 2, 3, 4):
        drift = float(Symbolic().drift(n).claim.rhs.subs(data)) / 0.4**n
        assert found.drift[n - 1] == pytest.approx(drift, rel=1e-11)
    for n in (1, 2):
        wave = float(Symbolic().oscillation(n).claim.rhs.subs(data)) / 0.4 ** (n + 1)
        assert found.wave[n - 1] == pytest.approx(wave, rel=1e-11)


def test_the_drift_on_a_compliant_support_is_the_derived_one() -> None:
    names = symbols("sigma_c0 h_0 f_c k p_inf U_mean")
    sigma_c0, h_0, f_c, k, p_inf, U_mean = names
    found = expand(_scene(tables(k=1e4)))
    assert found is not None
    pressure = 300.0 / (1.0 + np.exp(8.0))
    data = {sigma_c0: 3.6e-4, h_0: 1.08e-3, f_c: 0.25, k: 1e4, p_inf: pressure, U_mean: 0}
    expected = float(drift_coefficient(TANH).claim.rhs.subs(data))
    assert found.log_coefficient == pytest.approx(expected, rel=1e-12)
