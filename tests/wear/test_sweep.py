"""Sweeps: every scene as if it were alone."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from tests.judges import honest
from tests.wear.reference_scenes import CONSTANT, REFERENCE, SINE, reference_scene, tables
from wear.cycles import cycles_to_depth, sweep, wear_after
from wear.load import Table
from wear.model import bind
from wear.numerics.gauss import FloatArray
from wear.scene import Scene, load_scene

CYCLES = np.array([1.0, 10.0, 100.0, 1000.0, 9000.0])


def as_alone(scenes: Sequence[Scene], cycles: FloatArray, rtol: float) -> None:
    """Solve many scenes at once and compare each with what it gives by itself."""
    found = sweep(scenes, cycles, rtol)
    assert np.all(found.error <= rtol)
    for scene, wear, error in zip(scenes, found.u_c, found.error, strict=True):
        alone = wear_after(bind(scene), scene.load, cycles, 1e-12)
        assert honest(wear, error, alone.u_c, alone.error)


@pytest.mark.parametrize("rtol", [1e-7, 1e-11])
@pytest.mark.parametrize("names", [["S1"], ["S2", "S4", "S5", "S6"], ["S3a", "S3b", "S3c", "S3d"]])
def test_reference_values(names, rtol):
    found = sweep([reference_scene(name) for name in names], CYCLES, rtol)
    want = np.array([[REFERENCE[name][int(n)] for n in CYCLES] for name in names])
    assert np.all(found.error <= rtol)
    assert honest(found.u_c, found.error, want)


@settings(max_examples=5)
@given(
    st.lists(
        st.tuples(st.integers(-70, -50), st.integers(-5, 40), st.integers(2, 8)),
        min_size=1,
        max_size=20,
    )
)
def test_a_scene_does_not_feel_its_neighbours(drawn):
    scenes = [
        Scene.from_dict(
            tables(
                K=10 ** (K / 10),
                f_c=f / 100,
                load={"kind": "sine", "amplitude_mm": U * 1e-4, "period_s": 0.06},
            ),
            "drawn",
        )
        for K, f, U in drawn
    ]
    as_alone(scenes, CYCLES, 1e-8)


def test_loads_of_all_kinds_go_together():
    """Their meshes of phase differ, in the number of intervals too."""
    loads = [
        {"kind": "sine", "amplitude_mm": 5e-4, "period_s": 0.06},
        {"kind": "constant", "value_mm": 4e-4, "period_s": 0.02},
        {"kind": "harmonics", "sine_mm": [4e-4, 0.0, 2e-4], "period_s": 0.1},
        {"kind": "sine", "amplitude_mm": -6e-4, "period_s": 0.06},
    ]
    as_alone([Scene.from_dict(tables(load=load), "drawn") for load in loads], CYCLES, 1e-9)


def test_panels_are_as_many_as_a_scene_needs():
    """1e12 cycles take more of them than the two that every scene begins with."""
    scenes = [Scene.from_dict(tables(f_c=f), "drawn") for f in (0.05, 0.2, 0.35)]
    as_alone(scenes, np.array([1e3, 1e12]), 1e-8)


@pytest.mark.parametrize(
    ("K", "f_c", "load"),
    [
        (0.1784, 0.4116, {"kind": "harmonics", "cosine_mm": [3.194e-4], "period_s": 0.5186}),
        (0.1678, 0.4846, {"kind": "constant", "value_mm": 3.338e-4, "period_s": 0.5337}),
    ],
)
def test_wear_that_opens_the_gap_before_the_first_node_is_not_overlooked(K, f_c, load):
    """The two maps agree there, for neither sees it."""
    as_alone([Scene.from_dict(tables(K=K, f_c=f_c, load=load), "fast")], CYCLES, 1e-4)


@pytest.mark.parametrize("k", [None, 1e4])
def test_scenes_of_a_wide_range(k):
    """Wear coefficients over three decades, swings over one, up to a hundred million cycles."""
    drawn = np.random.default_rng(7).uniform(size=(40, 3))
    scenes = [
        Scene.from_dict(
            tables(
                K=10 ** (-8 + 3 * K),
                f_c=0.05 + 0.35 * f,
                k=k,
                load={"kind": "sine", "amplitude_mm": 2e-4 * 10**U, "period_s": 0.06},
            ),
            "wide",
        )
        for K, f, U in drawn
    ]
    as_alone(scenes, np.array([1.0, 1e3, 1e8]), 1e-7)


def test_a_hard_scene_does_not_disturb_the_others():
    """Pulses of a hundredth of a period and fast wear."""
    narrow = tables(K=1e-2, load={"kind": "sine", "amplitude_mm": 1.08e-2, "period_s": 0.06})
    found = sweep([reference_scene("S2"), Scene.from_dict(narrow, "narrow")], CYCLES, 1e-10)
    assert np.all(found.error <= 1e-10)
    assert_allclose(found.u_c[0], [REFERENCE["S2"][int(n)] for n in CYCLES], rtol=1e-10)


def test_scenes_of_different_kinds_are_mixed_in_one_call():
    """Variants, loss of contact and blocks; each as by itself."""
    blocks = {
        "kind": "blocks",
        "blocks": [
            {"kind": "sine", "amplitude_mm": 5e-4, "period_s": 0.06, "cycles": 20},
            {"kind": "sine", "amplitude_mm": 3e-4, "period_s": 0.03, "cycles": 300},
        ],
        "repeat": 30,
    }
    scenes = [reference_scene(name) for name in ("S1", "S2", "S8_1", "S5", "S8_2")]
    scenes += [load_scene("section4-cutoff"), Scene.from_dict(tables(load=blocks), "blocks")]
    as_alone(scenes, CYCLES, 1e-9)


def test_a_sharp_density_is_judged_by_more_nodes_than_it_was_solved_with():
    """Wear that takes off: within a cycle the density changes by orders of magnitude, and the same
    quadrature twice told nothing of that. It came to light beside a scene of sharp density."""
    drawn = [(2.77e-3, 0.7424, 3.352e-3, 1.145e-5), (2.482e-4, 0.36384, 1.58474e-3, 4.002e-5)]
    scenes = []
    for K, f_c, closure, value in drawn:
        made = tables(K=K, f_c=f_c, pin=True, load=CONSTANT | {"value_mm": value})
        made["contact"] |= {"closure_mm": closure}
        made["contact"].pop("closure_in_sigma", None)
        scenes.append(Scene.from_dict(made, "drawn"))
    as_alone(scenes, np.array([1.0, 30.0, 200.0, 1e3, 1e12]), 1e-8)


def smooth(r: float, f_c: float, K: float, closure: float, amplitude: float) -> Scene:
    load = {"kind": "sine", "amplitude_mm": amplitude, "period_s": 0.06}
    made = tables(K=K, f_c=f_c, load=load)
    made["bearing"] |= {"roughness_mm": r}
    made["contact"] |= {"closure_mm": closure}
    return Scene.from_dict(made, "smooth")


# Far beyond these cycles the rate underflows to zero, where there is no density.
FADING = (2.055677e-4, -0.1988934, 4.324113e-7, 2.5677618e-4, 1.587736e-4)
# Between its ends a count missed what it met there.
MISSED_ON_THE_WAY = (1.772079e-4, 0.54323347, 9.7268339e-7, 9.4937768e-4, 2.6236185e-4)


@pytest.mark.parametrize("drawn", [FADING, MISSED_ON_THE_WAY])
def test_the_request_is_met_by_wear_of(drawn):
    other = smooth(3.6e-4, 0.25, 1e-6, 1.08e-3, 5e-4)
    as_alone([smooth(*drawn), other], np.array([3.0, 3000.0, 1e8]), 1e-7)


@pytest.mark.parametrize("seed", [1, 2])
def test_variants_may_be_mixed_in_any_order(seed):
    """Jobs that are joined on the way hold their scenes in any order."""
    rng = np.random.default_rng(seed)
    scenes = []
    for pin, k in ((False, None), (True, None), (False, 1e5)):
        for _ in range(12):
            load = {
                "kind": "harmonics",
                "sine_mm": (4e-4 * rng.uniform(0.2, 1.0, rng.integers(1, 4))).tolist(),
                "period_s": 0.06,
            }
            made = tables(10 ** rng.uniform(-8, -4), rng.uniform(-0.2, 0.5), pin, k, load)
            made["bearing"] |= {"roughness_mm": 3.6e-4 * 10 ** rng.uniform(-0.3, 0.3)}
            scenes.append(Scene.from_dict(made, "drawn"))
    order = rng.permutation(len(scenes))
    as_alone([scenes[i] for i in order], np.array([3.0, 3000.0, 1e8]), 1e-7)


def test_scenes_that_lose_contact_are_as_if_alone_in_any_order():
    """Loads of one kind go together, rising and falling at different phases; some come twice."""
    rng = np.random.default_rng(3)

    def load(kind: str) -> dict[str, object]:
        swing = 4e-4 * rng.uniform(0.7, 1.2)
        if kind == "sine":
            return SINE | {"amplitude_mm": swing * rng.choice([-1.0, 1.0])}
        waves = (swing * rng.uniform(0.2, 0.6, rng.integers(1, 4))).tolist()
        return {"kind": "harmonics", "sine_mm": waves, "cosine_mm": waves[:1], "period_s": 0.03}

    scenes = []
    for kind, k in (("sine", None), ("harmonics", None), ("sine", 1e5)):
        for _ in range(3):
            made = tables(
                10 ** rng.uniform(-8, -5), rng.uniform(-0.2, 0.5), False, k, load(kind), True
            )
            made["contact"]["closure_mm"] = 1.08e-3 * rng.uniform(0.6, 1.0)
            scenes.append(Scene.from_dict(made, "drawn"))
    for rows in rng.uniform(-4e-4, 5e-4, (2, 4)):
        table = Table((0.0, 0.01, 0.02, 0.03, 0.06), (*rows, rows[0]))
        scenes.append(replace(Scene.from_dict(tables(cutoff=True), "table"), load=table))
    cycles = np.array([3.0, 3000.0, 1e8])
    alone = [wear_after(bind(scene), scene.load, cycles, 1e-11) for scene in scenes]
    order = rng.permutation(np.append(np.arange(len(scenes)), [0, 4]))
    found = sweep([scenes[i] for i in order], cycles, 1e-7)
    assert np.all(found.error <= 1e-7)
    for i, wear, error in zip(order, found.u_c, found.error, strict=True):
        assert honest(wear, error, alone[i].u_c, alone[i].error)
    depth = 0.7 * np.array([each.u_c[1] for each in alone])
    lives = cycles_to_depth([scenes[i] for i in order[:3]], depth[order[:3]], 1e-7)
    for k, i in enumerate(order[:3]):
        life = int(lives.cycles[k, k])
        ends = wear_after(bind(scenes[i]), scenes[i].load, np.array([life - 1.0, life]), 1e-11).u_c
        assert ends[0] < depth[i] <= ends[1]


def test_no_scenes_have_no_wear():
    found = sweep([], CYCLES)
    assert found.u_c.shape == found.error.shape == (0, len(CYCLES))
