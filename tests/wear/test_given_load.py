"""Loads that are forces, problem (i): wear is the integral of the force, by formulas typed here."""

import dataclasses
import json
import math
from pathlib import Path

import numpy as np
import pytest

import wear
from derive.note.problems import problem_i
from derive.symbols import symbol
from tests.judges import honest
from wear.binding import bind
from wear.cycles import cycles_to_depth, sweep
from wear.inside import fields_inside

EXAMPLES = Path(__file__).parents[2] / "docs" / "examples"
AREA = {"contact.width_mm": 20.0, "contact.length_mm": 30.0}
FORCE = {"kind": "force", "force_N": 3000.0, "period_s": 0.06}
RAMP = {"kind": "force", "times_s": [0.0, 0.02, 0.05], "forces_N": [0.0, 6000.0, 0.0]}


def pressed(name: str = "section4", load: dict[str, object] = FORCE) -> wear.Scene:
    return wear.load_scene(name).with_({**AREA, "load": load})


def archard(scene: wear.Scene, mean_force: float, cycles: float) -> float:
    """K p V t/(3 H)."""
    of = scene.bearing
    slip = 2.0 * math.pi * scene.motion.speed_rpm / 60.0 * scene.motion.radius_mm
    time = cycles * scene.periodic_load.period
    return of.wear_coefficient * mean_force / 600.0 * slip * time / (3.0 * of.hardness_MPa)


@pytest.mark.parametrize("name", ["section4", "section3-physical", "soft-support"])
@pytest.mark.parametrize(("load", "mean"), [(FORCE, 3000.0), (RAMP, 3000.0)])
def test_wear_is_the_integral_of_the_force(name: str, load: dict[str, object], mean: float) -> None:
    scene = pressed(name, load)
    cycles = [1, 777, 10**9]
    history = wear.solve(scene, cycles, rtol=1e-12)
    expected = [archard(scene, mean, n) for n in cycles]
    assert history.u_c == pytest.approx(expected, rel=2e-13)
    assert history.pressures.mean == pytest.approx(mean / 600.0, rel=1e-12)
    assert history.pressures.contact_fraction.tolist() == [1.0] * 3
    per_cycle = wear.asymptote(scene).wear_per_cycle_mm
    assert per_cycle == pytest.approx(archard(scene, mean, 1), rel=1e-14)
    assert wear.cycles_until(scene, expected[1] * (1 - 1e-9)).cycles.tolist() == [777.0]
    direct = wear.solve(scene, [2], rtol=1e-10, method="DOP853")
    assert direct.u_c[0] == pytest.approx(archard(scene, mean, 2), rel=1e-10)


def test_wear_much_deeper_than_a_small_force_is_large_is_known_as_well() -> None:
    """A force in N is no length: with the condition of a displacement nothing was known here, and
    the first cycles were less exact than promised."""
    scene = pressed(load={**FORCE, "force_N": 3e-3}).with_({"bearing.wear_coefficient": 1e-3})
    cycles = [1, 2, 777, 10**12]
    history = wear.solve(scene, cycles, rtol=1e-12)
    expected = np.array([archard(scene, 3e-3, n) for n in cycles])
    assert honest(history.u_c, history.error, expected)


def test_closure_and_displacement_are_those_of_problem_i() -> None:
    scene = pressed("soft-support")
    history = wear.solve(scene, [5000])
    closure, displacement = (step.claim for step in problem_i[-2:])
    numbers = {symbol(name): value for name, value in scene.parameters().items() if name != "T"}
    fields = {
        symbol(name): float(getattr(history, name)[0])
        for name in ("u_c", "sigma_c", "h", "p", "R_a", "U_c")
    } | {symbol("sigma"): float(history.sigma_c[0]), symbol("u_a"): 0.0}
    for claim, found in ((closure, history.h), (displacement, history.U_a)):
        assert found is not None
        expected = float(claim.rhs.subs(fields).subs(numbers))
        assert found[0] == pytest.approx(expected, rel=1e-12)
        assert claim.lhs in (symbol("h"), symbol("U_a"))


def test_pressures_are_known_at_a_closure_of_zero() -> None:
    history = wear.solve(pressed().with_({"contact.closure_mm": 0.0}), [3])
    assert history.pressures.mean == pytest.approx([5.0], rel=1e-12)
    assert history.pressures.peak == pytest.approx([5.0], rel=1e-12)


def test_the_closure_under_deep_wear_keeps_its_digits() -> None:
    """It is known from the pressure alone; wear less displacement had one digit here."""
    scene = pressed().with_({"bearing.roughness_growth": 0.0, "bearing.roughness_mm": 1e-8})
    history = wear.solve(scene.with_({"contact.closure_mm": 1e-8}), [1, 10**12])
    assert history.u_c[1] > 1e10 * 1e-8
    ratio = 2.0 + math.log(300.0 / 5.0 - 1.0) / 4.0
    assert history.h == pytest.approx([ratio * 1e-8] * 2, rel=1e-13)


def test_the_displacement_brings_the_force_about() -> None:
    scene = pressed("section3")
    u, force = np.array([0.0, 1e-3]), np.array([50.0, 100_000.0])
    displacement = bind(scene).displacement(u, force)  # type: ignore[attr-defined]
    back = bind(wear.load_scene("section3")).fields(u, displacement)
    assert back.p * 600.0 == pytest.approx(force, rel=1e-11)


def test_many_scenes_of_both_problems_go_together() -> None:
    scenes = [pressed(), wear.load_scene("section4"), pressed(load=RAMP), pressed("section3")]
    found = sweep(scenes, np.array([1.0, 1e5]), rtol=1e-10)
    alone = [wear.solve(scene, [1, 1e5], rtol=1e-10).u_c for scene in scenes]
    np.testing.assert_allclose(found.u_c, alone, rtol=1e-10)
    depths = cycles_to_depth([scenes[0], scenes[3]], np.array([1e-3])).cycles
    assert depths.tolist() == [[math.ceil(1e-3 / archard(scenes[0], 3000.0, 1))]] * 2


def test_inside_a_cycle_the_wear_follows_the_force() -> None:
    scene = pressed(load=RAMP)
    phases = np.array([0.0, 0.2, 0.4, 1.0])
    (part,) = fields_inside(scene, 10, phases)
    assert part.fields.U_c is None  # the support is rigid
    share = np.array([0.0, 0.1, 0.4, 1.0])  # of the triangle's area
    assert part.u[0] == pytest.approx(archard(scene, 3000.0, 1) * (10.0 + share), rel=1e-12)
    assert part.fields.p[0] == pytest.approx([0.0, 5.0, 10.0, 0.0], abs=1e-12)


def test_without_force_the_closure_is_unknown() -> None:
    history = wear.solve(pressed(load=RAMP), [1])
    assert np.isnan(history.h[0])
    assert json.loads(json.dumps(history.as_json(), allow_nan=False))["closure_mm"] == [None]


def test_gradient_of_the_rate_is_that_of_differences() -> None:
    scene = pressed("soft-support")
    model, u = bind(scene), np.array([1e-3])
    found = model.rate_gradient(u, 3000.0)
    keys = {"b": "contact.width_mm", "L": "contact.length_mm", "R": "motion.radius_mm",
            "K_c": "bearing.wear_coefficient", "H_c": "bearing.hardness_MPa"}  # fmt: skip
    for name, key in keys.items():
        value, step = scene.parameters()[name], 1e-5
        less, more = (
            bind(scene.with_({key: value * (1 + sign * step)})).rate(u, 3000.0)[0]
            for sign in (-1, 1)
        )
        assert found[name][0] * 2 * step * value == pytest.approx(more - less, rel=1e-9)
    assert found["U_a"][0] * 3000.0 == pytest.approx(model.rate(u, 3000.0)[0], rel=1e-14)
    assert found["h_0"][0] == found["p_max"][0] == found["k"][0] == 0.0


def test_rows_of_a_load_cell_are_read_in_its_units(tmp_path: Path) -> None:
    (tmp_path / "cell.csv").write_text("t_s,R_a_kN\n0,0\n0.02,6\n0.05,0\n")
    table = {"kind": "force", "file": "cell.csv", "columns": ["t_s", "R_a_kN"], "unit": "kN"}
    scene = wear.Scene.from_dict({**pressed().to_tables(), "load": table}, folder=tmp_path)
    assert isinstance(scene.load, wear.ForceTable)
    assert scene.load.forces_N == (0.0, 6000.0, 0.0)
    assert wear.solve(scene, [9]).u_c == pytest.approx(archard(scene, 3000.0, 9), rel=1e-13)


@pytest.mark.parametrize(
    ("changes", "problem"),
    [
        ({"contact.width_mm": None, "contact.length_mm": None}, "needs width_mm and length_mm"),
        ({"load.force_N": 180_000.0}, "beyond p_max b L = 180000 N"),
        ({"load.force_N": -1.0}, "negative"),
        ({"contact.ends_at_3_sigma": True}, "the pressure is given"),
        ({"load": {**RAMP, "forces_N": [0.0, -1.0, 0.0]}}, "give forces >= 0"),
        ({"load": {**RAMP, "forces_N": [0.0, 1.0, 2.0]}}, "jumps at the seam"),
    ],
)
def test_what_a_force_cannot_be_is_a_fault(changes: dict[str, object], problem: str) -> None:
    with pytest.raises(wear.SceneError, match=problem):
        pressed().with_(changes)


def test_every_door_checks_the_force() -> None:
    with pytest.raises(wear.SceneError, match="beyond p_max b L"):
        dataclasses.replace(pressed(), load=wear.Force(force_N=1e6, period_s=1.0))


def test_friction_takes_its_share_of_the_pressure() -> None:
    scene = wear.load_scene(EXAMPLES / "force.toml")
    found = wear.solve(scene, [0, 3]).columns()
    way = math.pi * 22.0 * 2 * 2000.0 / 60.0 * 0.06
    assert found["sliding_distance_mm"][1] == pytest.approx(way, rel=1e-14)
    assert found["friction_work_mJ_per_mm2"][1] == pytest.approx(0.12 * 5.5 * way, rel=1e-12)
    assert found["friction_work_mJ"][1] == pytest.approx(0.12 * 3300.0 * way, rel=1e-12)
    assert np.isnan(found["friction_work_mJ"][0])
    without = wear.solve(pressed(), [1]).columns()
    assert not [name for name in without if name.startswith(("friction", "sliding"))]
