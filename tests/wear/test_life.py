"""The number of cycles to a wear depth: counted, extrapolated, or never."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tests.wear.reference_scenes import made
from wear.binding import bind
from wear.cycles import orbit_of_scene, wear_after
from wear.faults import UsageError
from wear.life import Reached, cycles_until
from wear.load import Block, Blocks, HistoryLoad, Sine, Table
from wear.scene import load_scene
from wear.solver import solve

SECTION4 = load_scene("section4")


def test_life_is_the_inverse_of_the_wear() -> None:
    """Wear that the references give after 1000 and after 9000 cycles."""
    life = cycles_until("section4", [2.0235737896319597e-03, 4.4133292056883764e-03])
    assert life.cycles.tolist() == [1000.0, 9000.0]
    assert life.reached == (Reached.COUNTED, Reached.COUNTED)
    assert cycles_until(SECTION4, 0.0).cycles.tolist() == [0.0]


def test_the_extrapolation_goes_on_where_the_count_ends() -> None:
    """Both ways give the same just above the wear of 1e12 cycles, within their errors."""
    last = float(solve(SECTION4, 10**12).u_c[0])
    life = cycles_until(SECTION4, [last * (1.0 - 1e-6), last * (1.0 + 1e-6), 5e4])
    assert life.reached == (Reached.COUNTED, Reached.EXTRAPOLATED, Reached.EXTRAPOLATED)
    assert_allclose(life.cycles[:2], [1e12 * (1.0 - 1e-6), 1e12 * (1.0 + 1e-6)], rtol=1e-9)
    assert life.cycles[2] == pytest.approx(5e4 / 4.6355474275e-8, rel=1e-4)  # issue: 1.08e12
    assert np.all(life.error < 1e-6)


def test_lives_that_are_hardly_meant_are_said(call: Any) -> None:
    assert not cycles_until("section4", 1e-3).notices
    life = cycles_until("section4", [1e-3, 5e4])
    for words in ("5e+04 mm is 2.27e+05 % of the radius", "wear beyond 1e+09 cycles"):
        assert any(words in text for text in life.notices)
    assert repr(life) == "<Life: 0.001 mm after 140 cycles; 50000 mm after 1.07862e+12 cycles>"
    line = ("run", "section4", "--cycles", "9", "--until-wear", "5e4")
    status, _, messages = call(*line)
    assert (status, "% of the radius" in messages) == (0, True)
    assert call(*line, "--strict")[0] == 2


def test_never_is_said_where_wear_ends_below() -> None:
    life = cycles_until("roughness-vanishing", [1e-3, 1.0])
    assert life.reached[1] is Reached.NEVER
    assert np.isnan(life.cycles[1])


def test_numbers_that_are_none_are_not_given() -> None:
    life = cycles_until("section4", 1e306)
    assert (life.reached, np.isnan(life.cycles[0])) == ((Reached.LATER,), True)


def test_a_number_whose_error_is_larger_than_itself_is_unknown() -> None:
    """Near a limit that is approached by geometric decay the last digit takes 1e7 times the cycles;
    it was reported as counted after 564."""
    changes = {"bearing.roughness_growth": 0.0, "contact.ends_at_3_sigma": True}
    scene = SECTION4.with_(changes | {"support.stiffness_MPa_per_mm": 1e5})
    limit = float(solve(scene, 10**12).u_c[0])
    life = cycles_until(scene, [limit * (1.0 - 1e-9), np.nextafter(limit, 0.0), 2.0 * limit])
    assert life.reached == (Reached.COUNTED, Reached.UNKNOWN, Reached.NEVER)
    assert (life.error[0] < 1e-3, np.isnan(life.cycles[1])) == (True, True)


def test_a_load_that_ends_is_said_to() -> None:
    blocks = Blocks((Block(Sine(5e-4, 0.06), 10),))
    life = cycles_until(replace(SECTION4, load=blocks), [1e-5, 1.0])
    assert life.reached == (Reached.COUNTED, Reached.LOAD_ENDS)


def test_what_is_no_depth_is_refused() -> None:
    with pytest.raises(UsageError) as refused:
        cycles_until(SECTION4, [-1.0, float("nan"), "3", True])  # type: ignore[list-item]
    assert len(str(refused.value).splitlines()) == 4
    with pytest.raises(UsageError, match="rtol: 2"):
        cycles_until(SECTION4, 1e-3, rtol=2.0)
    record = HistoryLoad((0.0, 1.0), (0.0, 0.0), 1.0)
    with pytest.raises(UsageError, match="does not repeat"):
        cycles_until(replace(SECTION4, load=record), 1e-3)


def test_no_cycle_far_beyond_the_depth_is_counted() -> None:
    """With loss of contact 200,000 cycles were counted where the depth was reached in 300."""
    wear = 5e-4 * np.sin(2 * np.pi * np.arange(40) / 40) * (1 + 0.3 * np.cos(np.arange(40) ** 2))
    load = Table(tuple((0.06 * np.arange(41) / 40).tolist()), (*wear.tolist(), float(wear[0])))
    model = bind(made(1e-6, 0.25, load, pin=True, k=1e5, cutoff=True))
    depth = wear_after(model, load, np.array([300.0]), 1e-7).u_c
    near = orbit_of_scene(model, load, 2e5, 1e-7, deepest=float(depth[0]))
    far = orbit_of_scene(model, load, 2e5, 1e-7)
    assert near.until(depth)[0].tolist() == far.until(depth)[0].tolist() == [300.0]
    assert near.cost.cycles_integrated < 0.7 * far.cost.cycles_integrated
