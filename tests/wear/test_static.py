"""The closed static solution: references, 60 digits, the solver, and its own inverse."""

from __future__ import annotations

import dataclasses
import json
from pathlib import Path

import mpmath
import numpy as np
import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from tests.wear.reference_scenes import CONSTANT, REFERENCE, tables
from wear.faults import UsageError
from wear.generated import static_solution as formula
from wear.load import Constant
from wear.model import bind
from wear.scene import Scene, load_scene
from wear.solver import solve
from wear.static import StaticSolution, static_solution

EPS = float(np.finfo(float).eps)
VALUES = json.loads((Path(__file__).parents[1] / "data" / "values.json").read_text())["static"]


def _scene(slope: float = 0.25, load: float = 0.0, stiffness: float | None = None) -> Scene:
    made = tables(f_c=slope, k=stiffness, load=CONSTANT)
    return dataclasses.replace(Scene.from_dict(made), load=Constant(load, 0.06))


@pytest.mark.parametrize(
    ("scene", "key"),
    [
        (_scene(), "tau(u=3e-4;f=.25,Ua=0)"),
        (_scene(load=5e-4), "tau(u=3e-4;f=.25,Ua=5e-4)"),
        (_scene(load=-5e-4), "tau(u=3e-4;f=.25,Ua=-5e-4)"),
        (_scene(-0.05), "tau(u=3e-4;f=-.05,Ua=0)"),
        (_scene(stiffness=1e6), "finite_k(k=1e6MPa/mm,f=.25,Ua=0) tau(u=3e-4)"),
    ],
)
def test_cycles_to_a_wear(scene, key):
    assert float(static_solution(scene).cycles(3e-4)) == pytest.approx(
        float(VALUES[key]), rel=40 * EPS
    )


def test_wear_after_cycles():
    smooth = float(VALUES["u_f0(100 cycles,Ua=0)"])
    assert float(static_solution(_scene(0.0)).wear(100)) == pytest.approx(smooth, rel=8 * EPS)
    cycles = list(REFERENCE["S7"])
    found = static_solution(Scene.from_dict(tables(load=CONSTANT))).wear(cycles)
    assert found == pytest.approx(list(REFERENCE["S7"].values()), rel=8 * EPS)


def _exact(data: dict[str, float], load: float, u: float) -> mpmath.mpf:
    """The plain closed form, at as many digits as its factors that overflow need."""
    with mpmath.workdps(80 + int(4 / abs(data["f_c"]))):
        sigma, f, h = (mpmath.mpf(data[name]) for name in ("sigma_c0", "f_c", "h_0"))
        b = 2 * (sigma / f - h + mpmath.mpf(load))

        def primitive(s: mpmath.mpf) -> mpmath.mpf:
            return s * mpmath.exp(-2 * b / s) + 2 * b * mpmath.ei(-2 * b / s)

        end = sigma + f * mpmath.mpf(u)
        gap = mpmath.exp(4 / f - 8) / f * (primitive(end) - primitive(sigma))
        return mpmath.mpf(u) + gap


LOGS = st.floats(-6.0, 4.0)
DATA = {"K_c": 1e-6, "H_c": 200.0, "p_max": 300.0, "R": 22.0, "n": 2000.0, "T": 0.06}


@example(slope=-1.0, closure=3.0, load=0.0, log_wear=0.0, log_rest=-1.0)
@example(slope=-1.0, closure=3.0, load=0.0, log_wear=0.0, log_rest=-2.0)
@example(slope=-0.164, closure=0.955, load=-1.515, log_wear=0.0, log_rest=-0.0241285)
@example(slope=-1.482, closure=3.212, load=3.848, log_wear=0.0, log_rest=-2.24)
@given(
    slope=st.builds(
        lambda sign, size: sign * 10.0**size, st.sampled_from([1.0, -1.0]), st.floats(-2.5, 2.0)
    ),
    closure=st.floats(0.0, 4.0),
    load=st.floats(-3.0, 6.0),
    log_wear=LOGS,
    log_rest=st.floats(-6.0, -0.02),
)
def test_error_is_a_few_units_times_the_condition(slope, closure, load, log_wear, log_rest):
    """Up to a millionth short of the wear at which the roughness vanishes."""
    sigma = 3.6e-4
    data = {**DATA, "sigma_c0": sigma, "f_c": slope, "h_0": closure * sigma}
    solution = StaticSolution(data, load * sigma)
    wear = min(10.0**log_wear * sigma, (1.0 - 10.0**log_rest) * solution.limit)
    assume(abs(sigma / slope - data["h_0"] + load * sigma) >= 1e-9)  # or it is 0 times infinity
    exact = _exact(data, load * sigma, wear)
    found = float(solution.cycles(wear)) * solution.largest_wear
    assume(exact / mpmath.mpf(solution.largest_wear) <= 1e12)
    worn = wear / sigma
    left = 1.0 + slope * worn
    ends = (closure - load, (closure + worn - load) / left * (1.0 + abs(slope) * worn) / left)
    arguments = [4.0 * (closure - load - 1.0 / slope) / size for size in (1.0, left)]
    middle = [z for z in arguments if 0.0 < z < 40.0]
    condition = 8.0 + max(*(4.0 * abs(end) for end in ends), *middle)
    assert abs(float((mpmath.mpf(found) - exact) / exact)) <= 6 * EPS * condition


@pytest.mark.parametrize("slope", [-1e-12, 0.0, 1e-15, 1e-9])
def test_nothing_happens_at_slope_zero(slope):
    here, there = (static_solution(_scene(f)).cycles([1e-6, 3e-4]) for f in (0.0, slope))
    assert there == pytest.approx(here, rel=max(1e-14, 40 * abs(slope)))


@pytest.mark.parametrize("slope", [0.25, -0.05, 0.0, 3.0, 0.02])
@pytest.mark.parametrize("stiffness", [None, 1e4])
def test_the_inverse_inverts_up_to_1e12_cycles(slope, stiffness):
    solution = static_solution(_scene(slope, stiffness=stiffness))
    cycles = np.array([1e-3, 1.0, 9000.0, 1e6, 1e12])
    wear = solution.wear(cycles)
    assert np.all(np.diff(wear) > 0.0)
    again = solution.cycles(wear)
    conditioned = wear * np.gradient(np.log(cycles), wear)
    assert np.all(np.abs(again / cycles - 1.0) <= 1e-13 * (1.0 + np.abs(conditioned)))


@pytest.mark.parametrize("slope", [0.25, 0.02, -0.05])
@pytest.mark.parametrize("stiffness", [None, 1e5])
def test_the_solver_agrees(slope, stiffness):
    """Two ways that share no more than the scene: closed form, and whole cycles counted."""
    scene = _scene(slope, 2e-4, stiffness)
    cycles = [1, 100, 10_000, 10**8]
    history = solve(scene, cycles, rtol=1e-11)
    assert static_solution(scene).wear(cycles) == pytest.approx(history.u_c, rel=1e-11)


def test_roughness_that_vanishes_ends_the_wear():
    """With the load pressed beyond the closure, sigma reaches 0 in finite time."""
    solution = static_solution(_scene(-0.05, load=9e-3))
    assert np.isfinite(solution.cycles(0.999999 * solution.limit))
    assert solution.cycles(2.0 * solution.limit) == np.inf


def test_generated_exponent_is_that_of_the_pressure():
    scene = _scene(load=2e-4)
    pressure = bind(scene).fields(1e-4, 2e-4).p
    data = scene.parameters()
    found = formula.exponent(1e-4, 2e-4, **{n: data[n] for n in ("h_0", "sigma_c0", "f_c")})
    assert float(np.log(300.0 / pressure - 1.0)) == pytest.approx(found, rel=1e-14)


def test_scenes_without_a_closed_solution_are_refused_with_every_reason():
    with pytest.raises(UsageError, match=r"load varies.*pin"):
        static_solution(load_scene("section3"))
    with pytest.raises(UsageError, match="not negative"):
        static_solution(_scene()).cycles(-1.0)
    with pytest.raises(UsageError, match="not negative"):
        static_solution(_scene()).wear(-1.0)
