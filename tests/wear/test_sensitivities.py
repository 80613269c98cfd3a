"""Derivatives of the wear with respect to the numbers of a scene."""

import dataclasses
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from derive.results.sensitivities import POWERS, WITHOUT_EFFECT
from wear.cycles import sweep
from wear.faults import UsageError
from wear.load import Block, Blocks, Constant, Force, Harmonics, Load, Sine, Table
from wear.loss_of_contact import tangent
from wear.parameters import parameters_of
from wear.scene import Scene, load_scene
from wear.scene.variant import KEYS
from wear.sensitivities import gradients, sensitivity

FloatArray = NDArray[np.float64]

CYCLES = np.array([1.0, 2.0, 30.0, 9000.0, 1e12])
STEP = 4e-4
METAL = Path(__file__).parents[2] / "docs" / "examples" / "metal.toml"


def _differences(scene: Scene, keys: list[str], cycles: FloatArray) -> tuple[FloatArray, ...]:
    """Return p du/dp (k, n) by differences, extrapolated to no step, and their error."""
    steps = STEP * np.array([1.0, -1.0, 0.5, -0.5])
    values = parameters_of(scene)
    moved = [scene.with_({key: values[key] * (1 + step)}) for key in keys for step in steps]
    count = sweep(moved, cycles, 1e-13)
    wear, missed = (x.reshape(len(keys), 2, 2, -1) for x in (count.u_c, count.u_c * count.error))
    wide, half = np.moveaxis((wear[:, :, 0] - wear[:, :, 1]) / (2 * steps[::2, None]), 1, 0)
    best = (4 * half - wide) / 3
    return best, STEP * np.abs(best - half) + np.sum(missed, axis=(1, 2)) * 4 / (3 * STEP)


SCENES: dict[str, tuple[str, dict[str, Any], tuple[str, ...]]] = {
    "one solid": ("section4", {}, ()),
    "two solids": (
        "section5",
        {"support.stiffness_MPa_per_mm": 1e5},
        (
            "bearing.wear_coefficient",
            "pin.roughness_growth",
            "bearing.roughness_mm",
            "contact.closure_in_sigma",
            "support.stiffness_MPa_per_mm",
        ),
    ),
    "violent first cycles": ("very-fast-wear", {}, ("bearing.wear_coefficient",)),
    "saturating": (
        "section4",
        {"bearing.roughness_growth": -0.05, "contact.law": "exponential"},
        ("bearing.roughness_growth", "load.amplitude_mm", "load.period_s"),
    ),
    "loss of contact": (
        "section4-cutoff",
        {"contact.closure_mm": 1e-3},
        ("bearing.wear_coefficient", "contact.closure_mm"),
    ),
    "sliding along the edge": (
        "chatter",
        {"contact.closure_mm": 1e-3},
        ("bearing.roughness_mm", "load.amplitude_mm"),
    ),
    "contact that first begins where a piece of the cycle does": (
        "section4-cutoff",
        {
            "bearing.wear_coefficient": 1e-4,
            "bearing.roughness_growth": 0.47,
            "contact.closure_mm": 1.27e-3,
            "load.amplitude_mm": 6.6e-4,
        },
        ("contact.closure_mm",),
    ),
    "contact held at its edge": (
        "section4-cutoff",
        {"contact.closure_mm": 1e-3, "support.stiffness_MPa_per_mm": 1e5},
        ("support.stiffness_MPa_per_mm",),
    ),
    "two solids that lose contact": (
        "section3-cutoff",
        {"contact.closure_in_sigma": 2.9},
        ("pin.wear_coefficient", "contact.closure_in_sigma"),
    ),
}


@pytest.mark.parametrize("name", SCENES)
def test_derivatives_are_those_of_differences_within_the_estimates(name: str) -> None:
    builtin, changes, some = SCENES[name]
    scene = load_scene(builtin).with_(changes)
    keys = list(some or parameters_of(scene))
    found = gradients([scene], keys, CYCLES)
    values = np.array([parameters_of(scene)[key] for key in keys])[:, None]
    reference, uncertainty = _differences(scene, keys, CYCLES)
    error, estimate = found.derivative[0] * values - reference, found.error[0] * np.abs(values)
    assert np.all(np.abs(error) <= estimate + uncertainty)
    scale = np.maximum(np.abs(reference), found.wear[0])
    assert np.all(estimate <= 1e-9 * scale)
    assert np.all(uncertainty <= 1e-8 * scale)


def test_a_loose_count_of_violent_cycles_has_derivatives_within_their_estimates() -> None:
    """With this wear coefficient the wear of the first instants changes the rate a thousandfold."""
    scene = load_scene("section4").with_(
        {"bearing.wear_coefficient": 25.6, "bearing.roughness_growth": 0.1365}
    )
    keys = ["bearing.wear_coefficient"]
    loose = gradients([scene], keys, CYCLES[:3], 1e-7)
    (reference,), _ = _differences(scene, keys, CYCLES[:3])
    assert np.all(np.abs(25.6 * loose.derivative[0, 0] - reference) <= 1e-9 * reference)
    assert np.all(loose.error[0] <= 1e-9 * loose.derivative[0])


def test_a_loose_count_that_had_to_be_repeated_has_derivatives() -> None:
    """Where the wear rate rises steeply, a loose count is repeated to more digits."""
    scene = load_scene("section5").with_(
        {"bearing.wear_coefficient": 1.257e-7, "bearing.roughness_growth": 0.02}
    )
    keys, cycles = ["bearing.wear_coefficient", "bearing.roughness_growth"], [10, 50525]
    loose, strict = (gradients([scene], keys, cycles, rtol) for rtol in (1e-7, 1e-12))
    assert np.all(np.abs(loose.derivative - strict.derivative) <= loose.error + strict.error)
    assert np.all(loose.error <= 1e-9 * np.abs(loose.derivative))


def test_a_number_of_cycles_at_which_a_piece_of_the_count_begins_has_an_estimate() -> None:
    """The count of this scene has a cell that begins after 300 cycles."""
    scene = load_scene("section4").with_(
        {
            "bearing.wear_coefficient": 5.0506897588495285e-08,
            "bearing.roughness_growth": -0.09999918392455485,
            "bearing.roughness_mm": 0.00011492843911961973,
            "contact.max_pressure_MPa": 146.59315619142515,
            "contact.closure_in_sigma": 2.52266939310735,
            "contact.ends_at_3_sigma": True,
            "load.amplitude_mm": 0.00022593265947748125,
            "support.stiffness_MPa_per_mm": 1068717.9241815845,
        }
    )
    found = gradients(
        [scene], ["load.amplitude_mm"], np.array([1.0, 10.0, 300.0, 9000.0, 1e6, 1e9, 1e12])
    )
    assert np.all(found.error[0] <= 1e-9 * np.abs(found.derivative[0]))


LOADS: dict[str, tuple[Load | Blocks, dict[str, Load | Blocks]]] = {
    "harmonics": (
        Harmonics(1e-5, (1e-4, 2e-5), (4e-4,), 0.06),
        {
            "load.mean_mm": Harmonics(1.01e-5, (1e-4, 2e-5), (4e-4,), 0.06),
            "load.cosine_mm[1]": Harmonics(1e-5, (1e-4, 2.02e-5), (4e-4,), 0.06),
        },
    ),
    "table": (
        Table((0.0, 0.01, 0.06), (1e-4, 4e-4, 1e-4)),
        {
            "load.values_mm[0]": Table((0.0, 0.01, 0.06), (1.01e-4, 4e-4, 1.01e-4)),
            "load.values_mm[1]": Table((0.0, 0.01, 0.06), (1e-4, 4.04e-4, 1e-4)),
        },
    ),
    "force": (Force(4.0, 0.06), {"load.force_N": Force(4.04, 0.06)}),
    "blocks": (
        Blocks((Block(Sine(5e-4, 0.06), 20), Block(Constant(2e-4, 0.06), 100)), repeat=2),
        {
            "load.blocks[0].amplitude_mm": Blocks(
                (Block(Sine(5.05e-4, 0.06), 20), Block(Constant(2e-4, 0.06), 100)), repeat=2
            ),
            "load.blocks[1].period_s": Blocks(
                (Block(Sine(5e-4, 0.06), 20), Block(Constant(2e-4, 0.0606), 100)), repeat=2
            ),
        },
    ),
}


@pytest.mark.parametrize("kind", LOADS)
def test_every_number_of_a_load_is_a_parameter(kind: str) -> None:
    """The derivative at both ends of a change of one percent has its mean between them."""
    load, changed = LOADS[kind]
    area = {"contact.width_mm": 1.0, "contact.length_mm": 1.0}
    scene = dataclasses.replace(load_scene("section4").with_(area), load=load)
    cycles = np.array([1.0, 150.0])
    for key, other in changed.items():
        ends = [scene, dataclasses.replace(scene, load=other)]
        found = gradients(ends, [key], cycles)
        before, after = (parameters_of(end)[key] for end in ends)
        mean = np.mean(found.derivative[:, 0], axis=0) * (after - before)
        assert found.wear[1] - found.wear[0] == pytest.approx(mean, rel=2e-4, abs=1e-18)
        assert np.all(found.derivative[:, 0, 1] != 0.0)


def test_in_the_end_elasticities_are_those_derived_of_the_wear_per_cycle() -> None:
    """(21) and (22): powers of the data, (4/f) (1 - p/p_max) for the roughness growth."""
    scene = load_scene("section4", ["support.stiffness_MPa_per_mm=1e5"])
    keys = list(parameters_of(scene))
    cycles = np.array([1e11, 1e12])
    found = gradients([scene], keys, cycles)
    elasticity = dict(
        zip(keys, found.derivative[0] * [[v] for v in parameters_of(scene).values()], strict=True)
    )
    share = 1 / (1 + np.exp(4 / 0.25 - 8))
    names = {".".join(entry): symbol for symbol, entry in KEYS.items()}
    names |= {"load.period_s": "T", "load.amplitude_mm": "U"}
    expected = {str(symbol): float(power) for symbol, power in POWERS.items()}
    expected |= {str(symbol): 0.0 for symbol in WITHOUT_EFFECT}
    expected |= {"f_c": (4 / 0.25) * (1 - share), "n": 1.0, "R": 1.0, "k": 0.0}
    tried = 0
    for key, value in elasticity.items():
        if names.get(key) in expected:
            by_cycles = value / found.wear[0] - expected[names[key]]
            assert abs(by_cycles[1]) <= 2e-4
            assert abs(by_cycles[1]) <= 0.2 * abs(by_cycles[0])  # like ln(N)/N
            tried += 1
    assert tried == 11


@pytest.mark.parametrize("stiffness", [None, 1e5])
def test_wear_that_has_stopped_depends_on_the_margin_alone(stiffness: float | None) -> None:
    """The depth of arrest is (3 sigma_0 - h_0 + U)/(1 - 3 f), whatever the wear coefficient."""
    changes = {} if stiffness is None else {"support.stiffness_MPa_per_mm": stiffness}
    found = sensitivity(load_scene("section4-cutoff").with_(changes), 1e12)
    expected = {
        "bearing.roughness_mm": 3 / (1 - 3 * 0.25),
        "bearing.roughness_growth": 3 * found.wear_mm[0] / (1 - 3 * 0.25),
        "contact.closure_mm": -1 / (1 - 3 * 0.25),
        "load.amplitude_mm": 1 / (1 - 3 * 0.25),
    }
    for key, derivative in zip(found.keys, found.derivative[:, 0], strict=True):
        assert derivative == pytest.approx(expected.get(key, 0.0), rel=1e-12, abs=1e-300)
    assert np.all(found.error[:, 0] <= 1e-11 * np.abs(found.derivative[:, 0]))


def test_derivatives_keep_their_digits_near_a_limit_wear() -> None:
    """There a cycle changes the wear so little that dP/du differs from 1 by rounding alone."""
    changes = {
        "bearing.wear_coefficient": 1.6e-8,
        "bearing.roughness_growth": 0.07,
        "contact.closure_in_sigma": 2.95,
        "contact.max_pressure_MPa": 104.0,
        "load.amplitude_mm": 3.5e-4,
        "support.stiffness_MPa_per_mm": 3e5,
    }
    scene = load_scene("section4-cutoff").with_(changes)
    keys = ["bearing.wear_coefficient", "contact.closure_in_sigma"]
    values = np.array([[changes[key]] for key in keys])
    found = gradients([scene], keys, np.array([1e6, 1e9]))
    assert np.all(found.error[0] * values <= 1e-10 * found.wear[0])


TOWARDS_THE_END: dict[str, tuple[dict[str, float], Load]] = {
    "wear that stops": (
        {
            "bearing.wear_coefficient": 1.67e-7,
            "bearing.roughness_growth": 0.276,
            "bearing.roughness_mm": 2.6e-4,
            "contact.closure_in_sigma": 2.96,
            "contact.max_pressure_MPa": 275.0,
        },
        Sine(5e-4, 0.06),
    ),
    "wear that fades": (
        {
            "bearing.wear_coefficient": 5.9e-5,
            "bearing.roughness_growth": 0.214,
            "bearing.roughness_mm": 5.85e-4,
            "contact.closure_in_sigma": 2.77,
            "contact.max_pressure_MPa": 227.0,
            "support.stiffness_MPa_per_mm": 1.97e5,
        },
        Harmonics(-6.3e-5, (-2.8e-4, 3.3e-4), (-2.5e-4, -2e-4), 0.06),
    ),
}


@pytest.mark.parametrize("end", TOWARDS_THE_END)
def test_the_end_of_wear_does_not_spoil_the_estimates_before_it(end: str) -> None:
    """There derivatives change by orders of magnitude within one panel of the count."""
    changes, load = TOWARDS_THE_END[end]
    scene = dataclasses.replace(load_scene("section4-cutoff").with_(changes), load=load)
    values = parameters_of(scene)
    found = gradients([scene], list(values), np.array([300.0, 9000.0]))
    relative = found.error[0] * np.abs([[value] for value in values.values()]) / found.wear[0]
    assert np.all(relative <= 1e-8)


def test_where_contact_grazes_at_first_it_is_said() -> None:
    assert "from one side" in sensitivity("section4-cutoff", 1).notices[0]
    scene = load_scene("section4-cutoff", ["contact.closure_mm=1e-3"])
    assert sensitivity(scene, 1).notices == ()


def test_random_scenes_agree_with_differences() -> None:
    random = np.random.default_rng(13)
    cycles = np.array([1.0, 300.0, 1e6])
    for _ in range(6):
        builtin = random.choice(["section3", "section4"])
        changes = {
            "bearing.wear_coefficient": 10 ** random.uniform(-8, -4),
            "bearing.roughness_growth": random.uniform(-0.1, 0.5),
            "bearing.roughness_mm": (sigma := 10 ** random.uniform(-4, -3)),
            "contact.closure_in_sigma": random.uniform(1.5, 3.2),
            "load.amplitude_mm": sigma * random.uniform(0.2, 2.0),
        }
        if random.random() < 0.4:
            changes["support.stiffness_MPa_per_mm"] = 10 ** random.uniform(4.5, 7.0)
        scene = load_scene(str(builtin)).with_(changes)
        values = parameters_of(scene)
        key = str(random.choice(list(values)))
        found = gradients([scene], [key], cycles)
        reference, uncertainty = _differences(scene, [key], cycles)
        error = found.derivative[0, 0] * values[key] - reference[0]
        estimate = found.error[0, 0] * abs(values[key])
        assert np.all(np.abs(error) <= estimate + uncertainty[0])
        assert np.all(estimate <= 1e-8 * np.maximum(np.abs(reference[0]), found.wear[0]))


@pytest.mark.parametrize(
    "names", [("section5", "section4", "section5-k1e-4"), ("section4-cutoff",)]
)
def test_many_scenes_have_the_derivatives_that_each_has_alone(names: tuple[str, ...]) -> None:
    scenes = [load_scene(name) for name in names]
    scenes.append(scenes[0].with_({"bearing.wear_coefficient": 3e-6}))
    keys = ["bearing.wear_coefficient", "contact.max_pressure_MPa", "load.amplitude_mm"]
    cycles = np.array([1.0, 40.0, 1e6])
    together = gradients(scenes, keys, cycles)
    for i, scene in enumerate(scenes):
        alone = gradients([scene], keys, cycles)
        apart = np.abs(together.derivative[i] - alone.derivative[0])
        assert np.all(apart <= together.error[i] + alone.error[0])
        assert np.all(together.error[i] <= 1e-9 * np.abs(together.derivative[i]))


def test_under_a_constant_load_the_period_only_serves_to_count() -> None:
    """Where the first cycle wears off the roughness many times over it is counted in parts."""
    scene = load_scene(str(METAL)).with_({"bearing.wear_coefficient": 3.0})
    keys = ["bearing.wear_coefficient", "motion.speed_rpm", "load.period_s"]
    values = np.array([3.0, 60.0, 1.0])
    found = gradients([scene], keys, np.array([1.0, 200.0, 50_000.0]))
    relative = found.derivative[0] * values[:, None] / found.wear
    assert np.all(np.abs(relative - relative[:1]) <= 1e-11)
    more, less = (scene.with_({"motion.speed_rpm": 60.0 * (1 + h)}) for h in (STEP, -STEP))
    apart = sweep([more, less], [1, 200, 50_000], 1e-13).u_c
    np.testing.assert_allclose(relative[1], np.log(apart[0] / apart[1]) / (2 * STEP), rtol=1e-6)


def test_a_number_without_influence_is_refused_with_a_remedy() -> None:
    with pytest.raises(UsageError, match=r"pin\.hardness_MPa.*\n.*did you mean load\.period_s"):
        gradients([load_scene("section4")], ["pin.hardness_MPa", "load.periods"], CYCLES)


@pytest.mark.parametrize("cycles", [[float("nan")], [1.5], -1, [1e13], []])
def test_only_whole_numbers_of_cycles_have_gradients(cycles: Any) -> None:
    with pytest.raises(UsageError, match="cycles: "):
        gradients([load_scene("section4")], ["bearing.wear_coefficient"], cycles)


def test_a_key_that_is_named_twice_is_refused() -> None:
    """And not given a derivative of zero at its first place."""
    with pytest.raises(UsageError, match="hardness_MPa is named twice"):
        gradients([load_scene("section4")], 2 * ["bearing.hardness_MPa"], 1)


def test_an_error_of_the_density_at_the_start_of_a_panel_is_in_the_estimate() -> None:
    """There the residual of Abel's equation is small, but its derivative is not."""
    changes = {
        "bearing.wear_coefficient": 3.948443764989774e-08,
        "bearing.roughness_growth": 0.15005841515030868,
        "bearing.roughness_mm": 0.0001341768439980165,
        "pin.wear_coefficient": 2.302549584653459e-06,
        "pin.roughness_growth": 0.128333121349012,
        "contact.closure_in_sigma": 3.130684795430297,
        "contact.max_pressure_MPa": 314.8172761578739,
        "load.amplitude_mm": 0.00013527360098320877,
    }
    scene, cycles = load_scene("section5").with_(changes), [20, 100, 9000]
    found, reference = sensitivity(scene, cycles), sensitivity(scene, cycles, rtol=1e-13)
    error = np.abs(found.derivative - reference.derivative)
    assert np.all(error <= found.error + reference.error)
    assert np.all(found.elasticity_error <= 1e-9)


def test_where_increments_are_a_series_their_derivatives_are_one_too(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A series takes fewer cycles than the derivatives at every node need, and gives the same."""
    changes = {"contact.closure_mm": 1e-3, "support.stiffness_MPa_per_mm": 1e5}
    scene = load_scene("section4-cutoff").with_(changes)
    cycles, taken = [300, 9000, 1e8], []
    linearise = tangent.map_derivatives

    def counted(cycle: Any, equation: Any, starts: FloatArray) -> tangent.CycleDerivatives:
        taken.append(len(starts))
        return linearise(cycle, equation, starts)

    monkeypatch.setattr(tangent, "map_derivatives", counted)
    by_series = sensitivity(scene, cycles)
    monkeypatch.setattr(tangent, "sample_wears", lambda _: np.empty(0))
    each = sensitivity(scene, cycles)
    assert taken[0] < 0.9 * taken[1]
    assert np.all(np.abs(by_series.derivative - each.derivative) <= by_series.error + each.error)
    assert np.all(by_series.elasticity_error <= 1e-11)


def test_derivatives_where_contact_begins_with_the_cycle() -> None:
    """Without wear contact begins at phase 0, and later with a little: the first node was on one
    side, all others on the other, and the error estimated as large as the derivatives."""
    scene, key = load_scene("section4-cutoff"), "contact.closure_mm"
    found, closure = sensitivity(scene, [1, 100]), scene.closure
    row = found.keys.index(key)
    assert np.nanmax(found.elasticity_error) < 1e-9
    wear = [
        sweep([scene.with_({key: closure * (1 + n * 1e-6)})], [1, 100], 1e-13).u_c[0]
        for n in range(3)
    ]
    difference = (4 * wear[1] - wear[2] - 3 * wear[0]) / (2e-6 * closure)
    np.testing.assert_allclose(found.derivative[row], difference, rtol=1e-6)
