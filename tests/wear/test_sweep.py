"""Sweeps: every scene as if it were alone."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tests.judges import honest
from tests.wear.reference_scenes import REFERENCE, made, reference_scene
from wear.binding import bind
from wear.cycles import cycles_to_depth, sweep, wear_after
from wear.life import cycles_until
from wear.load import Block, Blocks, Constant, Harmonics, Load, Sine, Table
from wear.numerics.gauss import FloatArray
from wear.regime import asymptote
from wear.scene import Scene, load_scene
from wear.solver import solve

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


def test_loads_of_all_kinds_go_together():
    """Their meshes of phase differ, in the number of intervals too."""
    loads = [
        Sine(5e-4, 0.06),
        Constant(4e-4, 0.02),
        Harmonics(0.0, (), (4e-4, 0.0, 2e-4), 0.1),
        Sine(-6e-4, 0.06),
    ]
    as_alone([made(load=load) for load in loads], CYCLES, 1e-9)


def test_panels_are_as_many_as_a_scene_needs():
    """1e12 cycles take more of them than the two that every scene begins with."""
    scenes = [made(f_c=f) for f in (0.05, 0.2, 0.35)]
    as_alone(scenes, np.array([1e3, 1e12]), 1e-8)


@pytest.mark.parametrize(
    ("K", "f_c", "load"),
    [
        (0.1784, 0.4116, Harmonics(0.0, (3.194e-4,), (), 0.5186)),
        (0.1678, 0.4846, Constant(3.338e-4, 0.5337)),
    ],
)
def test_wear_that_opens_the_gap_before_the_first_node_is_not_overlooked(K, f_c, load):
    """The two maps agree there, for neither sees it."""
    as_alone([made(K, f_c, load)], CYCLES, 1e-4)


@pytest.mark.parametrize("k", [None, 1e4])
def test_scenes_of_a_wide_range(k):
    """Wear coefficients over three decades, swings over one, up to a hundred million cycles."""
    drawn = np.random.default_rng(7).uniform(size=(40, 3))
    scenes = [
        made(10 ** (-8 + 3 * K), 0.05 + 0.35 * f, Sine(2e-4 * 10**U, 0.06), k=k)
        for K, f, U in drawn
    ]
    as_alone(scenes, np.array([1.0, 1e3, 1e8]), 1e-7)


def test_a_hard_scene_does_not_disturb_the_others():
    """Pulses of a hundredth of a period and fast wear."""
    narrow = made(1e-2, load=Sine(1.08e-2, 0.06))
    found = sweep([reference_scene("S2"), narrow], CYCLES, 1e-10)
    assert np.all(found.error <= 1e-10)
    assert_allclose(found.u_c[0], [REFERENCE["S2"][int(n)] for n in CYCLES], rtol=1e-10)


def test_scenes_of_different_kinds_are_mixed_in_one_call():
    """Variants, loss of contact and blocks; each as by itself."""
    blocks = Blocks((Block(Sine(5e-4, 0.06), 20), Block(Sine(3e-4, 0.03), 300)), 30)
    scenes = [reference_scene(name) for name in ("S1", "S2", "S8_1", "S5", "S8_2")]
    scenes += [load_scene("section4-cutoff"), replace(made(), load=blocks)]
    as_alone(scenes, CYCLES, 1e-9)


def test_a_sharp_density_is_judged_by_more_nodes_than_it_was_solved_with():
    """Wear that takes off: within a cycle the density changes by orders of magnitude, and the same
    quadrature twice told nothing of that. It came to light beside a scene of sharp density."""
    drawn = [(2.77e-3, 0.7424, 3.352e-3, 1.145e-5), (2.482e-4, 0.36384, 1.58474e-3, 4.002e-5)]
    scenes = [
        made(K, f_c, Constant(value, 0.06), closure=closure, pin=True)
        for K, f_c, closure, value in drawn
    ]
    as_alone(scenes, np.array([1.0, 30.0, 200.0, 1e3, 1e12]), 1e-8)


# Far beyond these cycles the rate underflows to zero, where there is no density.
FADING = made(4.324113e-7, -0.1988934, Sine(1.587736e-4, 0.06), roughness=2.055677e-4,
              closure=2.5677618e-4)  # fmt: skip
# Between its ends a count missed what it met there.
MISSED_ON_THE_WAY = made(9.7268339e-7, 0.54323347, Sine(2.6236185e-4, 0.06), roughness=1.772079e-4,
                         closure=9.4937768e-4)  # fmt: skip


@pytest.mark.parametrize("drawn", [FADING, MISSED_ON_THE_WAY])
def test_the_request_is_met_by_wear_of(drawn):
    as_alone([drawn, made()], np.array([3.0, 3000.0, 1e8]), 1e-7)


@pytest.mark.parametrize("seed", [1, 2])
def test_variants_may_be_mixed_in_any_order(seed):
    """Batches that are joined on the way hold their scenes in any order."""
    rng = np.random.default_rng(seed)
    scenes = []
    for pin, k in ((False, None), (True, None), (False, 1e5)):
        for _ in range(12):
            waves = 4e-4 * rng.uniform(0.2, 1.0, rng.integers(1, 4))
            K, f_c = 10 ** rng.uniform(-8, -4), rng.uniform(-0.2, 0.5)
            roughness = 3.6e-4 * 10 ** rng.uniform(-0.3, 0.3)
            load = Harmonics(0.0, (), tuple(waves.tolist()), 0.06)
            scenes.append(made(K, f_c, load, roughness=roughness, pin=pin, k=k))
    order = rng.permutation(len(scenes))
    as_alone([scenes[i] for i in order], np.array([3.0, 3000.0, 1e8]), 1e-7)


def test_scenes_that_lose_contact_are_as_if_alone_in_any_order():
    """Loads of one kind go together, rising and falling at different phases; some come twice."""
    rng = np.random.default_rng(3)

    def load(kind: str) -> Load:
        swing = 4e-4 * rng.uniform(0.7, 1.2)
        if kind == "sine":
            return Sine(swing * rng.choice([-1.0, 1.0]), 0.06)
        waves = tuple((swing * rng.uniform(0.2, 0.6, rng.integers(1, 4))).tolist())
        return Harmonics(0.0, waves[:1], waves, 0.03)

    scenes = []
    for kind, k in (("sine", None), ("harmonics", None), ("sine", 1e5)):
        for _ in range(3):
            K, f_c, acting = 10 ** rng.uniform(-8, -5), rng.uniform(-0.2, 0.5), load(kind)
            closure = 1.08e-3 * rng.uniform(0.6, 1.0)
            scenes.append(made(K, f_c, acting, closure=closure, k=k, cutoff=True))
    for rows in rng.uniform(-4e-4, 5e-4, (2, 4)):
        table = Table((0.0, 0.01, 0.02, 0.03, 0.06), (*rows, rows[0]))
        scenes.append(made(load=table, cutoff=True))
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


def test_no_depths_take_no_cycles():
    assert cycles_to_depth(["section4"], []).cycles.shape == (1, 0)


def test_no_scenes_have_no_wear():
    found = sweep([], CYCLES)
    assert found.u_c.shape == found.error.shape == (0, len(CYCLES))


def test_depths_that_springs_near_are_counted():
    """Wear tends to a limit; every depth below it is reached."""
    scene = load_scene("section4-cutoff", ["bearing.roughness_growth=0.05",
                       "support.stiffness_MPa_per_mm=100"])  # fmt: skip
    depths = asymptote(scene).arrest_wear_mm * np.array([0.3, 0.9, 0.99, 0.999, 1.001])
    together = cycles_to_depth([scene, load_scene("section4-cutoff")], depths)
    alone = cycles_until(scene, depths)
    assert np.isfinite(together.cycles[0]).tolist() == [True] * 4 + [False]
    assert_allclose(together.cycles[0, :4], alone.cycles[:4].astype(float), rtol=1e-6)


def test_an_edge_of_contact_in_the_last_bits_of_the_cycle():
    """A cut one rounding error before the end of the cycle has its middle at the end."""
    scene = load_scene("section4-cutoff", [
        "contact.closure_in_sigma=3", "pin.hardness_MPa=600", "pin.wear_coefficient=1.5e-7",
        "bearing.roughness_mm=0.0014854", "pin.roughness_mm=0.0004645", "pin.roughness_growth=0.13",
        "bearing.roughness_growth=0.33", "load.amplitude_mm=0.000911",
    ])  # fmt: skip
    wear = solve(scene, [10], rtol=1e-9).u_c
    assert_allclose(wear, solve(scene, [10], method="DOP853", rtol=1e-10).u_c, rtol=1e-7)
