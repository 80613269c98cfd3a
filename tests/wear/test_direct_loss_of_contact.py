"""The cutoff: contact intervals, sliding at its edge, arrest; compliant supports that soften it."""

import math
import time

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from wear import cycles as count
from wear import direct
from wear.binding import bind
from wear.direct.loss_of_contact import Mode, first_mode, is_arrested, pieces, pressure_share
from wear.direct.problem import scaled_ode
from wear.load import Constant, Harmonics, Sine, Table
from wear.scene import Scene

from .reference_scenes import SHARP, made

LARGEST_WEAR = 44 * math.pi * 1e-6  # mm per cycle at p_max and K = 1e-6


def integrate(scene: Scene, cycles, rtol=1e-9, method="DOP853"):
    return direct.integrate(bind(scene), scene.load, cycles, rtol, method, time.monotonic() + 60)


def arrest_of(result) -> int:
    """The cycle in which wear stops for good."""
    return int(result.notices[0].removeprefix("wear stops for good in cycle "))


@pytest.mark.parametrize(
    ("f_c", "pin", "depth"),
    [
        (0.25, False, 0.002),
        (-0.05, False, 0.00043478260869565217391),
        (-0.05, True, 0.00062217971331157622036),
        (0.05, True, 0.00098044971483562480706),
    ],
)
def test_wear_stops_at_the_arrest_depth(f_c, pin, depth):
    """Sections 3 to 5 with the cutoff of Eq. (4); a hundredfold K arrests at the same depth."""
    scene = made(1e-4, f_c, pin=pin, cutoff=True)
    result = integrate(scene, [1, 1000, 10**12])
    assert result.u[-1] == pytest.approx(depth, rel=1e-14)
    assert result.u[-2] == result.u[-1]
    assert arrest_of(result) < 30
    assert result.cost.cycles_integrated <= 3 * arrest_of(result)


def test_the_cycle_of_arrest_does_not_depend_on_method_or_accuracy():
    scene = made(K=1e-4, cutoff=True)
    arrests = {
        arrest_of(integrate(scene, [100], rtol, method))
        for rtol, method in ((1e-6, "DOP853"), (1e-10, "DOP853"), (1e-6, "Radau"), (1e-6, "LSODA"))
    }
    assert arrests == {21}


def test_a_constant_load_wears_until_the_gap_opens():
    result = integrate(made(1e-4, load=Constant(5e-4, 0.06), cutoff=True), [10])
    assert result.u[0] == pytest.approx(0.002, rel=1e-14)  # (3 sigma_0 - h_0 + U_a)/(1 - 3 f)


def explicit(scene: Scene, cycles: int, steps: int) -> float:
    """Euler's method with the discontinuous rate, which converges to Filippov's solution."""
    model, period, u = bind(scene), scene.load.period, 0.0
    loads = scene.load(np.arange(steps) / steps)
    for _ in range(cycles):
        for U_a in loads:
            if model.margin(u, U_a) >= 0.0:
                u += float(model.rate(u, U_a)) * period / steps
    return u


@pytest.mark.parametrize(("f_c", "pin"), [(-0.05, False), (0.05, True)])
def test_sliding_is_the_limit_of_small_steps(f_c, pin):
    """Fast wear reaches the edge of contact in the first cycle and slides along it to the peak."""
    scene = made(1e-3, f_c, pin=pin, cutoff=True)
    wear = integrate(scene, [1]).u[0]
    for steps in (1500, 6000):  # a step at the edge wears some 6/steps of the whole
        assert explicit(scene, 1, steps) == pytest.approx(wear, rel=10 / steps)


def test_one_third_keeps_a_fixed_share_of_the_period_in_contact():
    """f_c = 1/3: contact while U_a >= h_0 - 3 sigma_0 = 0, half of the period, in every cycle."""
    scene = made(0.1, 1 / 3, cutoff=True)
    result = integrate(scene, [49, 50], 1e-9)
    pressure = 1.0 / (1.0 + math.exp(4.0))  # h/sigma tends to 1/f = 3
    assert np.diff(result.u)[0] == pytest.approx(1e5 * LARGEST_WEAR * pressure / 2, rel=4e-3)


def test_contact_becomes_permanent_above_one_third():
    """Once it is, the cutoff makes no difference to the rate."""
    scene = made(1e-3, 0.5, cutoff=True)
    model = bind(scene)
    worn = integrate(scene, [20]).u[0]
    assert np.all(model.margin(worn, scene.load(np.arange(64) / 64)) > 0.0)


@settings(max_examples=10)
@given(
    f_thousandths=st.integers(-50, 300),
    amplitude_nm=st.integers(10, 1500),
    closure_percent=st.integers(20, 100),
)
def test_drawn_scenes_stop_at_or_before_the_depth(f_thousandths, amplitude_nm, closure_percent):
    f_c, U = f_thousandths / 1000, 1e-6 * amplitude_nm
    h_0 = 1.08e-3 * closure_percent / 100
    depth = (3 * 3.6e-4 - h_0 + U) / (1 - 3 * f_c)
    scene = made(1e-3, f_c, Sine(U, 0.06), closure=h_0, cutoff=True)
    result = integrate(scene, [1, 60], 1e-7)
    if result.stopped is None:
        assert np.all(result.u <= depth * (1.0 + 1e-12))
        assert not result.notices or result.u[-1] == pytest.approx(depth, rel=1e-12)
    else:
        assert "smooth" in result.stopped
        assert depth >= 3.6e-4 / -f_c  # the roughness is used up before the contact


def test_pieces_are_monotone_and_cover_the_cycle():
    loads = (
        Sine(5e-4, 0.06),
        Sine(-5e-4, 0.06),
        Table((0.0, 0.01, 0.03, 0.05, 0.06), (0.0, 1e-3, 1e-3, -1e-3, 0.0)),
        Harmonics(1e-4, (1e-4, 3e-4), (2e-4, 0.0), 0.06),
    )
    for load in loads:
        cut = pieces(load)
        assert (cut[0].start, cut[-1].end) == (0.0, 1.0)
        for piece in cut:
            inside = np.diff(load(np.linspace(piece.start, piece.end, 40)))
            rising = inside >= -1e-15 if piece.rising else inside <= 1e-15
            assert np.all(rising)


def test_two_peaks_of_a_table_load():
    """The lower peak first wears what only it can reach, then the higher one alone is left."""
    rows = {"times_s": (0.0, 0.015, 0.03, 0.045, 0.06), "values_mm": (0.0, 3e-4, 0.0, 5e-4, 0.0)}
    scene = made(1e-4, 0.0, cutoff=True)
    result = direct.integrate(bind(scene), Table(**rows), [200], 1e-8)
    assert result.u[0] == pytest.approx(5e-4, rel=1e-12)


def test_the_pressure_at_the_edge_is_what_keeps_up_with_the_load():
    scene = made(1e-3, -0.05, cutoff=True)
    model = bind(scene)
    u = 3e-4
    edge = -float(model.margin(u, 0.0))  # the displacement that just touches
    opening = -float(model.margin_slope(u, edge) * model.rate(u, edge))
    assert pressure_share(model, u, edge + 1e-6, 0.0) == 1.0
    assert pressure_share(model, u, edge - 1e-6, 0.0) == 0.0
    assert pressure_share(model, u, edge, -1.0) == 0.0
    assert pressure_share(model, u, edge, 0.5 * opening) == pytest.approx(0.5)
    assert pressure_share(model, u, edge, 2.0 * opening) == 1.0


@pytest.mark.parametrize(("rise", "share"), [(-1e6, 0.0), (0.0, 0.0), (1e-9, 1.0), (1e6, 1.0)])
def test_at_an_edge_that_wear_does_not_open_the_load_decides(rise, share):
    """Roughness outgrows wear: no pressure is too large, however fast the load rises."""
    model = bind(made(f_c=0.5, cutoff=True))
    edge = -float(model.margin(3e-4, 0.0))
    assert pressure_share(model, 3e-4, edge, rise) == share


def test_a_gap_that_no_load_closes_never_wears():
    scene = made(load=Constant(-1e-4, 0.06), cutoff=True)
    of = scaled_ode(bind(scene), scene.load)
    assert first_mode(of, 0.0) is Mode.OPEN
    assert is_arrested(of, 0.0, Mode.OPEN, scene.load.maximum)
    result = integrate(scene, [1, 10**12])
    assert result.u.tolist() == [0.0, 0.0]
    assert (arrest_of(result), result.cost.rhs_evaluations) == (0, 0)


@pytest.mark.parametrize("k", [1e6, 1e9])
def test_kinks_of_a_compliant_support_cost_no_accuracy(k):
    """The pressure follows the support, then the contact law, then the support again."""
    scene = made(K=1e-3, cutoff=True, k=k)
    one = integrate(scene, [1, 2], 1e-10)
    other = integrate(scene, [1, 2], 1e-7, "Radau")
    assert np.all(one.error <= 1e-10)
    assert np.all(np.abs(one.u / other.u - 1.0) <= one.error + other.error)


PLATEAU = Table((0.0, 0.2, 0.4, 1.0), (0.0, 3e-4, 3e-4, 0.0))


@pytest.mark.parametrize(
    ("load", "K", "fades"),
    [
        (Sine(3e-4, 0.06), 3e-5, False),
        (PLATEAU, 3e-5, False),
        (SHARP, 3e-5, True),
        (SHARP, 1e-3, False),  # wear opens the contact faster than the load closes it
    ],
)
def test_wear_fades_at_a_sharp_peak_and_stops_elsewhere(load, K, fades):
    """The count of cycles says the same."""
    scene = made(K, 0.1, load, cutoff=True)
    result = integrate(scene, [1000], 1e-6)
    counted = count.wear_after(bind(scene), load, np.array([1e6]), 1e-6)
    if fades:
        for found in (result, counted):
            assert found.notices[0].startswith("wear approaches its limit")
    else:
        assert (
            result.notices
            == counted.notices
            == (f"wear stops for good in cycle {arrest_of(result)}",)
        )


def test_the_estimate_holds_where_the_finer_run_is_the_worse_one():
    """Steps begin anew where contact begins; of these the finer run took one that was too long."""
    scene = made(
        2.2424300854177284e-06, -0.16237859537573562, roughness=0.0003120966313618376,
        closure=0.001045217148701591, cutoff=True,
        pin={
            "hardness_MPa": 285.8232958445475, "wear_coefficient": 4.00603670547143e-07,
            "roughness_mm": 0.00018129979993784537, "roughness_growth": 0.11071161574760718,
        },
    ).with_({
        "bearing.hardness_MPa": 719.8385863157218, "contact.max_pressure_MPa": 621.9318017822781,
        "contact.pin_wear_opens_gap": True, "motion.radius_mm": 35.95921915132221,
        "motion.speed_rpm": 495.5333521500711,
    })  # fmt: skip
    inside = (0.007342757367114257, 0.01684417794112337, 0.018571598206952346)
    low, high = 0.0002900859758602966, 0.0004964523103947453
    load = Table(
        (0.0, *inside, 0.024053396452455685),
        (low, high, -0.0004962535792918345, 0.0003203377499331028, low),
    )
    model = bind(scene)
    want = count.wear_after(model, load, np.array([1.0, 2.0, 4.0]), 1e-12)
    found = direct.integrate(model, load, [1, 2, 4], 1e-9)
    assert np.all(np.abs(found.u / want.u_c - 1) <= found.error + want.error)
