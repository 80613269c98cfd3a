"""Long-time behaviour: published values, every regime, and agreement with the solver."""

import math
from typing import Any

import mpmath
import numpy as np
import pytest
import scipy.special
from hypothesis import example, given, settings
from hypothesis import strategies as st

from tests.references import VALUES
from wear import cycles
from wear.binding import bind
from wear.cycle_means import cycle_mean
from wear.generated import asymptotics as formula
from wear.load import Harmonics, Sine, Table
from wear.regime import Asymptote, asymptote
from wear.scene import builtin_names, load_scene
from wear.scene_orbit import SceneOrbit
from wear.solver import solve


def _asymptote(name: str, *overrides: str) -> Asymptote:
    return asymptote(load_scene(name, overrides))


def _published(group: str, key: str) -> float:
    return float(VALUES[group][key])


def test_section_4():
    found = _asymptote("section4")
    assert found.regime == "steady"
    assert found.tanh_argument == -4.0
    assert found.wear_per_cycle_mm == pytest.approx(_published("sec4_f0.25", "u_cum_mm"), rel=2e-15)
    assert found.pressure_MPa == pytest.approx(_published("sec4_f0.25", "p_inf_MPa"), rel=1e-15)
    assert found.log_coefficient_mm == pytest.approx(
        _published("sec4_f0.25", "A_log_mm"), rel=2e-15
    )


@pytest.mark.parametrize(
    ("name", "sign"), [("section3", "printed"), ("section3-physical", "physical")]
)
def test_two_solids(name, sign):
    found = _asymptote(name)
    assert found.tanh_argument == pytest.approx(
        _published("two_solids", f"x_inf_{sign}_sign"), rel=1e-15
    )
    # the data are doubles: their rounding counts 2 |x_inf| times
    assert found.wear_per_cycle_mm == pytest.approx(
        _published("two_solids", f"u_cum_{sign}_sign"), rel=2e-14
    )


@pytest.mark.parametrize(
    ("name", "overrides", "depth", "cycle"),
    [
        ("section4-cutoff", (), 0.002, 2045),
        ("section4-cutoff", ("bearing.roughness_growth=-0.05",), 0.00043478260869565217, 342),
        ("section3-cutoff", (), 0.000622179713311576220, 491),
        ("section5-cutoff", (), 0.000980449714835624807, 824),
        ("section3-cutoff", ("contact.pin_wear_opens_gap=true",), 0.000339874441997526118, 271),
        ("section5-cutoff", ("contact.pin_wear_opens_gap=true",), 0.000424901542324972828, 350),
    ],
)
def test_arrest(name, overrides, depth, cycle):
    found = _asymptote(name, *overrides)
    assert found.regime == "arrest"
    assert found.arrest_wear_mm == pytest.approx(depth, rel=1e-14)
    assert found.arrest_cycle == cycle
    (wear,) = solve(load_scene(name, overrides), [cycle + 100], rtol=1e-9).u_c
    assert wear == pytest.approx(depth, rel=1e-9)


def test_an_arrest_that_cannot_be_counted_is_not_told(monkeypatch):
    """A count whose error is infinite says neither when wear stops nor that it goes on."""
    count = cycles.count_scenes

    def missed(*arguments: Any) -> list[SceneOrbit]:
        (found,) = count(*arguments)
        last = found.orbit.segments[-1]._replace(start_error=np.array([np.inf]))
        segments = (*found.orbit.segments[:-1], last)
        return [SceneOrbit(found.orbit._replace(segments=segments), None)]

    monkeypatch.setattr(cycles, "count_scenes", missed)
    found = _asymptote("section4-cutoff")
    assert found.arrest_cycle is None
    assert found.arrest_wear_mm == pytest.approx(0.002, rel=1e-14)
    assert any("cannot be counted" in text for text in found.notices)


def test_one_third_with_cutoff():
    found = _asymptote("f-one-third")
    assert found.regime == "steady"
    assert found.wear_per_cycle_mm == pytest.approx(_published("cutoff", "u_cum_f_1/3"), rel=1e-14)


PULSE = Table((0.0, 0.03, 0.030006, 0.030012, 0.06), (0.0, 0.0, 5e-4, 0.0, 0.0))


@pytest.mark.parametrize(
    "changed",
    [
        {},
        {"contact.closure_mm": 1.25e-3},
        *({"support": {"stiffness_MPa_per_mm": k}} for k in (10.0, 1565.0, 1e5)),
        {"contact.closure_mm": 1.25e-3, "load": PULSE},
    ],
)
def test_at_one_third_the_solver_finds_the_rate(changed):
    scene = load_scene("f-one-third").with_(changed)
    first, last = solve(scene, [5 * 10**11, 10**12], rtol=1e-12).u_c
    rate = asymptote(scene).wear_per_cycle_mm
    assert (last - first) / 5e11 == pytest.approx(rate, rel=2e-7)


@pytest.mark.parametrize("sharpness", [0.01, 1.0, 1e3, 1e6, 1e9])
def test_means_over_a_cycle_miss_no_peak(sharpness):
    def peaked(load):
        return cycle_mean(load, lambda U: np.exp(sharpness * (U - 1.0)), scale=1.0 / sharpness)

    line = -math.expm1(-sharpness) / sharpness
    assert peaked(Sine(1.0, 1.0)) == pytest.approx(scipy.special.ive(0, sharpness), rel=1e-8)
    assert peaked(Table((0.0, 0.5, 1.0), (0.0, 1.0, 0.0))) == pytest.approx(line, rel=1e-8)


@pytest.mark.parametrize(
    ("name", "overrides", "regime"),
    [
        ("f-zero", (), "logarithmic"),
        ("roughness-vanishing", (), "saturating"),
        ("f-tiny-negative", (), "saturating"),
        ("f-tiny-positive", (), "steady"),
        ("f-just-above-one-third", (), "steady"),
        ("roughness-vanishing", ("load.kind=constant", "load.value_mm=0.01"), "finite-time"),
        ("pin-wears-faster", (), "steady"),
        ("equal-wear", (), "steady"),
        ("section3", ("bearing.roughness_growth=0.0", "pin.roughness_growth=0.0"), "logarithmic"),
    ],
)
def test_regimes(name, overrides, regime):
    assert _asymptote(name, *overrides).regime == regime


@pytest.mark.parametrize("name", builtin_names())
def test_every_scene_has_an_answer(name):
    """Also where the panel towards infinity is out of the range of a double."""
    regimes = ("steady", "logarithmic", "saturating", "finite-time", "arrest")
    assert asymptote(name).regime in regimes


def test_a_roughness_that_falls_below_zero_is_told():
    """A limit or a depth of arrest beyond that wear is not one of the note's model."""
    thin = [f"bearing.roughness{end}" for end in ("_growth=-0.2", "_mm=1e-5")]
    thin += ["pin.roughness_growth=0.1"]
    for name, overrides, depth in (
        ("section3", (), "0.0072"), ("section5-cutoff", thin, "5e-05"),
    ):  # fmt: skip
        told = [text for text in _asymptote(name, *overrides).notices if "is negative" in text]
        assert len(told) == 1
        assert f"roughness of the bearing is negative beyond u_c = {depth} mm" in told[0]
    for name in ("section3-cutoff", "section5", "f-tiny-negative"):
        assert not any("is negative" in text for text in _asymptote(name).notices)


def test_a_gap_that_opens_a_billion_times_faster_than_roughness_grows():
    """exp(4 h/sigma) overflows even decimals of any exponent."""
    found = asymptote(load_scene("section4", ["bearing.roughness_growth=1e-20"]))
    assert (found.regime, found.wear_per_cycle_mm) == ("steady", 0.0)


def test_thresholds():
    assert formula.slope_threshold(epsilon=1 / (1 + math.exp(24))) == pytest.approx(
        0.125, rel=1e-14
    )
    double = formula.slope_threshold(epsilon=2.0**-55)
    assert double == pytest.approx(_published("thresholds", "f_float64"), rel=1e-15)


@settings(max_examples=30)
@given(st.floats(1e-3, 100.0), st.sampled_from([-1.0, 1.0]))
def test_long_time_formulas_are_good_to_a_few_ulp(slope, sign):
    """f_c from 0.001 to 100, both signs (a rough pin that does not wear makes both steady)."""
    found = _asymptote(
        "section3", f"bearing.roughness_growth={sign * slope!r}", "pin.wear_coefficient=0.0"
    )
    with mpmath.workdps(60):
        exact = 300 / (1 + mpmath.exp(4 / mpmath.mpf(slope) - 8))
        if exact > mpmath.mpf(2) ** -1022:
            assert abs(mpmath.mpf(found.pressure_MPa) / exact - 1) < 4 * 2.0**-53
        else:
            assert found.pressure_MPa == pytest.approx(float(exact), abs=1e-322)
    assert math.isfinite(found.log_coefficient_mm or 0.0)


@pytest.mark.parametrize(
    ("name", "overrides", "cycles"),
    [
        ("section4", ("bearing.roughness_growth=0.5",), 10**9),
        ("section4", ("bearing.roughness_growth=0.5", "support.stiffness_MPa_per_mm=1e5"), 10**9),
        ("section4", ("bearing.roughness_growth=0.6", "contact.law=exponential"), 10**9),
        ("section3", ("bearing.roughness_growth=0.4", "pin.roughness_growth=0.2"), 10**9),
    ],
)
def test_the_solver_approaches_rate_and_drift(name, overrides, cycles):
    """Increment per cycle -> u_cum (1 + A/(N u_cum)), so N (increment/u_cum - 1) -> A/u_cum."""
    scene = load_scene(name, overrides)
    found = asymptote(scene)
    rate, drift = found.wear_per_cycle_mm, found.log_coefficient_mm
    assert rate is not None
    assert drift is not None
    wear = solve(scene, [cycles // 1000, cycles], rtol=1e-13).u_c
    few, many = cycles // 1000, cycles
    measured = (wear[1] - wear[0] - rate * (many - few)) / math.log(many / few)
    assert measured == pytest.approx(drift, rel=2e-2)
    assert wear[1] / many == pytest.approx(rate, rel=1e-3)


def test_logarithmic_wear_meets_the_solver():
    scene = load_scene("f-zero")
    found = asymptote(scene)
    (wear,) = solve(scene, [10**9], rtol=1e-10).u_c
    assert found.log_coefficient_mm is not None
    assert found.offset_mm is not None
    assert wear == pytest.approx(
        found.log_coefficient_mm * math.log(1e9) + found.offset_mm, rel=1e-4
    )


def test_the_load_factor_does_not_overflow():
    found = _asymptote("f-zero", "load.amplitude_mm=0.5")
    assert np.isfinite(found.offset_mm)


@settings(max_examples=15)
@given(
    f=st.tuples(st.integers(-40, 60), st.integers(-40, 60)),
    pin=st.tuples(st.integers(0, 1000), st.floats(-8.0, -5.0)),
    mean=st.integers(-3000, 6000),
    opening=st.booleans(),
)
@example(f=(0, 0), pin=(0, -5.0), mean=0, opening=False)
@example(f=(22, 5), pin=(65, -6.0), mean=3000, opening=True)
def test_two_solids_arrest_where_the_margin_is_first_lost(f, pin, mean, opening):
    """Peaks of the load beyond the closure, where there is no gap at first, among them."""
    load = {"kind": "harmonics", "mean_mm": mean * 1e-6, "sine_mm": [1e-4], "period_s": 0.06}
    scene = load_scene("section3-cutoff").with_(
        {
            "bearing.roughness_growth": f[0] / 100,
            "pin.roughness_growth": f[1] / 100,
            "pin.roughness_mm": pin[0] * 1e-6,
            "pin.wear_coefficient": 10 ** pin[1],
            "contact.pin_wear_opens_gap": opening,
            "load": load,
        }
    )
    model, peak = bind(scene), scene.periodic_load.maximum
    found = asymptote(scene)
    end = found.saturation_wear_mm or 1e3
    depth = found.arrest_wear_mm if found.regime == "arrest" else None
    reach = end if depth is None else depth * (1 - 1e-9)
    wear = np.geomspace(1e-7, max(reach, 1e-7), 20_000)
    if depth != 0.0:
        assert np.all(model.margin(wear, peak) > -1e-15 * (1.0 + wear))
    if depth is not None:
        assert depth >= 0.0
        assert model.margin(depth * (1 + 1e-6), peak) <= 1e-15


@pytest.mark.parametrize("slope", [1 / 3, 0.3333, 0.3334, 0.4])
def test_wear_has_settled_when_it_is_said_to_have(slope):
    """Near f_c = 1/3 the coefficient of ln N vanishes, and higher orders rule."""
    scene = load_scene("section4", [f"bearing.roughness_growth={slope}"])
    found = asymptote(scene)
    settled = round(found.cycles_to_stabilise["mean_rate_within_1e-6"])
    cycles = np.array([settled // 2, settled, 10 * settled])
    excess = solve(scene, cycles, rtol=1e-12).pressures.mean / found.pressure_MPa - 1.0
    assert abs(excess[0]) > 1.5e-6
    assert abs(excess[1]) == pytest.approx(1e-6, rel=0.02)
    assert abs(excess[2]) < 2e-7


def test_roughness_that_a_sharp_peak_just_exhausts_does_not_vanish():
    """h* is 0: near a smooth peak the roughness vanishes in finite time, near a corner or on
    springs never."""
    scene = load_scene("section4").with_(
        {"bearing.roughness_mm": 2.0**-11, "bearing.roughness_growth": -0.5,
         "contact.closure_mm": 2.0**-10}
    )  # fmt: skip
    triangle = Table((0.0, 0.03, 0.06), (0.0, 2.0**-9, 0.0))
    smooth = Harmonics(2.0**-10, (-(2.0**-10),), (), 0.06)
    assert asymptote(scene.with_({"load": triangle})).regime == "saturating"
    assert asymptote(scene.with_({"load": smooth})).regime == "finite-time"
    springs = scene.with_({"load": smooth, "support.stiffness_MPa_per_mm": 1e5})
    found = asymptote(springs)
    assert found.regime == "saturating"
    assert "like a power of the cycles" in found.notices[-1]
