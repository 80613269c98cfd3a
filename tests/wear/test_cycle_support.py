"""The cutoff on a compliant support, judged in multiple precision: soft to very stiff."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tests.independent_support import SupportJudge
from tests.judges import problem
from tests.wear.reference_scenes import SHARP, made, sine
from tests.wear.test_cycle_count import between
from tests.wear.test_cycle_loss_of_contact import agrees_with_the_judge, loads, supported
from wear import cycles as count
from wear import direct
from wear.binding import bind
from wear.load import Harmonics, Table
from wear.loss_of_contact.edge import edge_of_contact
from wear.loss_of_contact.switching import phase_of
from wear.scene import load_scene

SINE = sine(2e-4)
STEPS = Table((0.0, 0.25, 0.5, 0.75, 1.0), (1.2e-6, 1.2e-6, 2.25e-5, 2.25e-5, 1.2e-6))
WAVES = Harmonics(2e-5, (1e-4, -6e-5), (1.5e-4, 4e-5), 0.06)


@pytest.mark.parametrize(
    ("K", "f_c", "k", "loads"),
    [
        (1e-6, 0.25, 1e4, (SINE, STEPS)),
        (1e-5, 0.5, 1e5, (SHARP, STEPS)),  # contact becomes permanent
        (1e-3, -0.05, 1e6, (WAVES, SHARP)),
        (1e-2, 0.1, 1e7, (SINE, WAVES)),
        (1e-1, 0.2, 1e9, (SHARP, STEPS)),  # the margin is emptied in 1e-7 of a cycle
    ],
)
def test_the_count_agrees_with_the_judge(K, f_c, k, loads):
    for load in loads:
        agrees_with_the_judge(supported(K, f_c, False, k, load), [1, 3], 1e-8)


@settings(max_examples=3)
@given(loads(), between(-8, -1), between(-0.2, 1.0), st.booleans(), between(2, 9))
def test_drawn_scenes_agree_with_the_judge(load, K, f_c, pin, k):
    assume(not pin or K + k < 3)  # the judge takes small steps there
    scene = supported(10**K, f_c, pin, 10**k, load)
    assume(float(bind(scene).margin(0.0, load.maximum)) > 1e-6)
    agrees_with_the_judge(scene, [1, 2], 1e-7)


def test_two_rough_solids_on_a_very_stiff_support():
    scene = supported(3e-2, 0.1, True, 1e7, SINE)
    model, load = bind(scene), scene.periodic_load
    found = count.wear_after(model, load, np.array([1.0, 2.0, 1000.0]), 1e-9)
    want = direct.integrate(model, load, [1, 2], 1e-8, "Radau", np.inf)
    assert np.all(found.error <= 1e-9)
    assert np.all(np.abs(found.u_c[:2] / want.u - 1) <= found.error[:2] + want.error)
    assert found.cost.rhs_evaluations < 30_000


def test_the_judge_has_two_ways_that_agree():
    """One rough solid: the closed form, and the Taylor series that two of them need."""

    class Stepping(SupportJudge):
        def linear(self, phase: object, end: object) -> object:
            return self.stepped(self.held_series, self.passed, phase, end)  # type: ignore[arg-type]

    data = problem(supported(1e-4, 0.1, False, 1e6, WAVES))
    judges = SupportJudge(data), Stepping(data)
    for judge in judges:
        judge.cycle()
    assert judges[0].wear == pytest.approx(judges[1].wear, rel=1e-18)


def test_contact_that_begins_just_below_a_smooth_peak_is_found():
    """There Newton's method on the load only halves the distance at first."""
    edge = edge_of_contact(bind(supported(1e-2, 0.1, False, 1e7, SINE)), SINE)
    below = SINE.maximum * (1 - np.logspace(-14, -1, 14))
    rise = edge.pieces.take(np.zeros(len(below), dtype=int))
    assert np.max(np.abs(SINE(phase_of(SINE, rise, below)) - below)) < 1e-19


def test_at_a_plateau_wear_on_springs_fades_within_a_cycle():
    """As exp(-decay tau), which rounding ends in the first cycle: even so it does not stop."""
    scene = supported(4e-4, -0.1, True, 4e5, STEPS)
    found = count.wear_after(bind(scene), STEPS, np.array([1.0, 1e9]), 1e-10)
    assert found.notices == ("wear approaches its limit; within rounding from cycle 1 on",)
    assert np.all(found.error <= 1e-10)


def test_a_margin_that_is_rounding_ends_the_iteration():
    """After the first cycle all that changes on the plateau is the last digit."""
    times, values = (0.0, 0.25, 0.5, 0.75, 1.0), (2.85e-4, 2.85e-4, 1e-4, 1e-4, 2.85e-4)
    scene = made(9.36e-5, 0.13, Table(times, values), closure=8.27e-4, k=1.04e8, cutoff=True)
    agrees_with_the_judge(scene, [1, 2], 1e-9)
    found = count.wear_after(bind(scene), scene.periodic_load, np.array([1.0]), 1e-9)
    assert found.cost.rhs_evaluations < 30_000


def test_two_rough_solids_at_rest_on_a_plateau():
    """All nodes of a part see a margin that is nothing but rounding."""
    times, values = (0.0, 0.25, 0.5, 0.75, 1.0), (2.85e-4, 2.85e-4, 1e-4, 1e-4, 2.85e-4)
    scene = supported(5.72e-3, -0.181, True, 9.6e8, Table(times, values))
    model, load = bind(scene), scene.periodic_load
    found = count.wear_after(model, load, np.array([1.0, 1e6]), 1e-8)
    # There the peak just fails to make contact.
    rest = model.margin(found.u_c, load.maximum) / model.margin_slope(found.u_c, load.maximum)
    assert np.all(np.abs(rest) <= 4e-15 * found.u_c)
    assert np.all(found.error <= 1e-8)
    assert found.cost.rhs_evaluations < 50_000


@pytest.mark.parametrize(
    ("name", "swing", "k", "most"),
    [
        ("section4-cutoff", 1e-12, 5e10, 1e-13),
        ("section4-cutoff", 1e-13, 5e10, 1e-13),
        ("section5-cutoff", 1e-13, 1e6, 1e-3),  # a cycle adds less than the margin's rounding
    ],
)
def test_a_tiny_load_leaves_no_estimate_infinite(name, swing, k, most):
    """What cannot be counted lies short of the limit."""
    support, load = supported(1e-6, 0.25, False, k).support, sine(swing)
    scene = replace(load_scene(name), support=support, load=load)
    found = count.wear_after(bind(scene), load, np.array([1e3, 1e9, 1e12]), 1e-7)
    assert np.all(found.error <= most)
