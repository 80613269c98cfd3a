"""Measured histories: many rows at once, against integrators that take them one by one."""

import dataclasses
import itertools
import math
import types
from typing import Any

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from tests.independent import wear_after
from tests.judges import ROUNDING, honest, judge_of, problem
from tests.wear.reference_scenes import made
from tests.wear.test_cycle_count import between
from wear import direct, records
from wear.binding import bind
from wear.faults import AccuracyError, Interrupted, UsageError
from wear.load import Constant, HistoryLoad
from wear.numerics.collocation import iterate
from wear.numerics.gauss import FloatArray
from wear.outcome import Outcome
from wear.records import follow
from wear.scene import Scene
from wear.solver import solve

PERIOD = 1 / 16  # s: times that are sums of powers of two have no roundoff
VARIANTS: dict[str, dict[str, Any]] = {
    "one solid": {},
    "two solids": {"pin": True, "f_c": -0.05},
    "on springs": {"k": 1e5},
    "two on springs": {"pin": True, "k": 1e4, "K": 1e-4},
    "fast": {"K": 1e-2},
}


def record(cycles: int, rows: int = 64, swing: float = 5e-4) -> HistoryLoad:
    """Uneven cycles of many rows each, with noise."""
    noise = np.random.default_rng(7).standard_normal(cycles * rows + 1)
    phase = np.arange(cycles * rows + 1) / rows
    depth = 1 + 0.3 * np.sin(phase)
    level = swing * (depth * np.sin(2 * np.pi * phase) + 0.02 * noise)
    return history(PERIOD * phase, level)


def history(times: Any, levels: Any) -> HistoryLoad:
    return HistoryLoad(tuple(map(float, times)), tuple(map(float, levels)), PERIOD)


def scene(load: HistoryLoad, **changes: Any) -> Scene:
    return dataclasses.replace(made(**changes), load=load)


def followed(load: HistoryLoad, cycles: list[int], rtol: float = 1e-12, **changes: Any) -> Outcome:
    return follow(bind(scene(load, **changes)), load, cycles, rtol)


def truth(of: Scene, load: HistoryLoad) -> float:
    """The wear at the end of a record of one second, by the independent integrator."""
    rows = tuple(zip(load.times_s, load.values_mm, strict=True))
    data = problem(dataclasses.replace(of, load=Constant(0.0, 1.0)))
    data = dataclasses.replace(data, period=1.0, mean=0.0, rows=rows)
    return wear_after(judge_of(of)(data), [1])[1]


@st.composite
def drawn_records(draw: st.DrawFn) -> Scene:
    """Few rows, far apart or close together, under wear slow and violent."""
    roughness = 10 ** draw(between(-4, -3))
    of = made(
        10 ** draw(between(-8, -1)),
        draw(between(-0.3, 0.6)),
        pin=draw(st.booleans()),
        k=draw(st.none() | between(3, 8).map(lambda e: 10**e)),
        roughness=roughness,
        closure=roughness * draw(between(0, 8)),
        cutoff=draw(st.booleans()),
    )
    swing = roughness * 10 ** draw(between(-1.5, 1))
    inner = draw(st.lists(st.integers(1, 4095), min_size=1, max_size=12, unique=True))
    times = np.array([0, *sorted(inner), 4096]) / 4096
    levels = swing * np.array([draw(between(-2, 2)) for _ in times])
    load = HistoryLoad(tuple(times.tolist()), tuple(levels.tolist()), 1.0)
    return dataclasses.replace(of, load=load)


@settings(max_examples=24)
@given(drawn_records(), st.sampled_from([1e-6, 1e-9, 1e-12]))
def test_drawn_records_against_an_independent_integrator(drawn: Scene, rtol: float) -> None:
    assert isinstance(drawn.load, HistoryLoad)
    found = follow(bind(drawn), drawn.load, [1], rtol)
    if found.stopped is not None:
        assert "roughness vanishes" in found.stopped
        return
    # Under violent wear rounding alone may exceed 1e-12: the estimate says so, and `solve` refuses.
    assert found.error[0] <= (rtol if rtol > 1e-12 else 1e-9)
    want = truth(drawn, drawn.load)
    assert found.u[0] == want == 0.0 or honest(found.u, found.error, np.array([want]))


def test_contact_at_the_very_end_of_a_line_is_not_missed() -> None:
    """Other lines wear so much that the needle does not show between the nodes; further rows close
    to the contact make it a line of its own."""
    times, levels = np.array([0.0, 0.25, 0.5, 0.75, 1.0]), [5e-4, 4e-4, -10.0, 4e-4, 5e-4]
    short = 1e-4  # s
    more = np.sort(np.append(times, [0.25 + short, 0.75 - short]))
    without = followed(history(times, [5e-4, 4e-4, -10.0, -10.0, -10.0]), [4]).u[0]
    one = followed(history(times, levels), [16])
    two = followed(history(more, np.interp(more, times, levels)), [16])
    assert_allclose(one.u, two.u, rtol=1e-10)
    assert one.u[0] - without > 1e-3 * without
    assert one.error[0] <= 1e-12


@pytest.mark.parametrize("name", VARIANTS)
def test_rows_on_the_lines_change_nothing(name: str) -> None:
    load = record(30)
    times, levels = np.array(load.times_s), np.array(load.values_mm)
    middle, half = times[:-1] + np.diff(times) / 2, (levels[:-1] + levels[1:]) / 2
    at = np.arange(1, len(times))
    more = history(np.insert(times, at, middle), np.insert(levels, at, half))
    one, two = (followed(rows, [1, 30], **VARIANTS[name]) for rows in (load, more))
    assert_allclose(one.u, two.u, rtol=2e-14)


def test_what_is_asked_for_changes_nothing() -> None:
    """Cycles that end between rows, alone and among others, in any order."""
    load = dataclasses.replace(record(30), period_s=0.0601)
    all_of_them = followed(load, list(range(31)))
    assert all_of_them.cycles == tuple(range(31))
    for cycle in (0, 1, 7, 30):
        alone = followed(load, [cycle])
        assert_allclose(alone.u, all_of_them.u[[cycle]], rtol=1e-14)
    assert followed(load, [30, 1, 7, 1]).cycles == (1, 7, 30)
    assert all_of_them.u[0] == all_of_them.error[0] == 0.0


def test_a_pause_out_of_contact_only_delays() -> None:
    load = record(10)
    away = -1.0  # mm
    times, levels = np.array(load.times_s) + PERIOD, np.array([away, *load.values_mm[1:]])
    early = history(np.append(0.0, times), np.append(away, levels))
    late = history(np.append(0.0, times + 4 * PERIOD), np.append(away, levels))
    one, two = followed(early, [1, 2, 11]), followed(late, [5, 6, 15])
    assert one.u[0] == two.u[0] == 0.0
    assert_allclose(one.u, two.u, rtol=1e-14)


def test_no_contact_no_wear() -> None:
    found = followed(record(3), [0, 1, 3], K=1e-6)
    assert np.all(np.diff(found.u) > 0)
    away = history((0.0, 1.0), (-2.0, -1.0))
    found = followed(away, [1, 16])
    assert found.u.tolist() == found.error.tolist() == [0.0, 0.0]
    assert found.stopped is None


def test_lines_converge_as_gauss_collocation_does(monkeypatch: pytest.MonkeyPatch) -> None:
    """Two nodes on each line: the error falls by 2^4 where lines are half as long, and is known."""
    monkeypatch.setattr(records, "NODES", 2)
    monkeypatch.setattr(records, "FINER_NODES", 3)
    load = record(2, rows=16)
    want = float(followed_exactly(load, 2))
    times, errors = np.array(load.times_s), []
    for _ in range(5):
        rows = HistoryLoad(tuple(times.tolist()), tuple(load(times).tolist()), PERIOD)
        found = followed(rows, [2], 100.0, K=1e-5)
        true = abs(found.u[0] - want)
        assert true <= found.error[0] * found.u[0] <= 30 * true
        errors.append(true)
        times = np.sort(np.append(times, (times[:-1] + times[1:]) / 2))
    rates: FloatArray = np.log2(np.array(errors[1:-1]) / errors[2:])
    assert_allclose(rates, 4.0, atol=0.3)


def test_what_early_rows_miss_is_not_forgotten(monkeypatch: pytest.MonkeyPatch) -> None:
    """Few nodes over rows that wear, then a long rest under a low pressure."""
    busy = record(2, rows=16)
    rest = np.linspace(2, 34, 513)[1:]
    times = np.append(busy.times_s, PERIOD * rest)
    load = history(times, np.append(busy.values_mm, np.full(rest.shape, -5e-4)))
    want = followed(load, [34], 1e-12).u[0]
    monkeypatch.setattr(records, "NODES", 2)
    monkeypatch.setattr(records, "FINER_NODES", 3)
    found = followed(load, [34], 0.1)
    assert 1e-8 < abs(found.u[0] / want - 1) <= found.error[0] <= 1e-3


def test_rounding_is_counted() -> None:
    """Where the pressure is exp(-500) of the largest its exponent's last digit decides; no wear is
    felt there, so that the rate is known."""
    model = bind(made(closure=0.05))
    largest = 1e-6 * (math.pi * 22.0 * 2000.0 / 30) * 300.0 / (3 * 200.0)
    worst = 0.0
    for level in np.linspace(0.0, 5e-3, 40):
        load = history((0.0, 1.0), (level, level))
        found = follow(model, load, [16], 1e-12)
        with mpmath.workdps(40):
            h = mpmath.mpf(0.05) - mpmath.mpf(load.values_mm[0])
            want = largest / (1 + mpmath.exp(4 * h / mpmath.mpf(3.6e-4) - 8))
            true = float(abs(found.u[0] / want - 1))
        assert true <= found.error[0] <= 1e-12
        worst = max(worst, true)
    assert worst > 10 * ROUNDING


def followed_exactly(load: HistoryLoad, cycles: int) -> float:
    scene_of = scene(load, K=1e-5)
    found = direct.integrate(bind(scene_of), load, [cycles], 1e-12)
    return float(found.u[0])


def test_out_of_time_the_cycles_so_far_are_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    load = record(20)
    whole = followed(load, [*range(1, 21)])
    clock = itertools.count()
    monkeypatch.setattr(
        "wear.numerics.initial_value.time", types.SimpleNamespace(monotonic=lambda: next(clock))
    )
    found = follow(bind(scene(load)), load, [*range(1, 21)], 1e-12, deadline=2.5)
    assert found.stopped == "the time limit has passed"
    assert found.interrupted
    assert found.cycles == tuple(range(1, 8))  # 64, 128 and 256 rows
    assert found.u.tolist() == whole.u[:7].tolist()
    assert found.error.tolist() == whole.error[:7].tolist()


@pytest.mark.parametrize("cutoff", [False, True])
def test_no_time_at_all_reaches_no_cycle(cutoff: bool) -> None:
    with pytest.raises(Interrupted, match="time limit has passed; no requested cycle was reached"):
        solve(scene(record(20), cutoff=cutoff), [20], time_limit=1e-9)


def test_an_interrupt_keeps_the_cycles_so_far(monkeypatch: pytest.MonkeyPatch) -> None:
    calls = 0

    def interrupted(*arguments: Any) -> Any:
        nonlocal calls
        calls += 1
        if calls > 4:  # two rules for each part
            raise KeyboardInterrupt
        return iterate(*arguments)

    monkeypatch.setattr("wear.numerics.initial_value.iterate", interrupted)
    load = record(20)
    with pytest.raises(Interrupted, match="interrupted; cycle 3 was reached") as stop:
        solve(scene(load), [1, 2, 3, 20])
    assert stop.value.history.cycles.tolist() == [1, 2, 3]


def test_a_trial_state_without_a_pressure_is_no_end() -> None:
    """Violent wear on stiff springs: the iteration over all lines runs away, to -1e12 mm."""
    stiff = {"closure": 0.0003160310487783073, "k": 1.0634538522847895e7}
    of = made(0.0019065965263269193, 0.0, law="exponential", **stiff)
    levels = (0.00149725, 0.00012321, 0.00178868)
    load = HistoryLoad((0.0, 0.5, 1.0), levels, 1.0)
    found = follow(bind(of), load, [1], 1e-9)
    assert found.stopped is None
    assert abs(found.u[0] / truth(of, load) - 1) <= found.error[0] <= 1e-9


@pytest.mark.parametrize("cutoff", [False, True])
def test_where_the_roughness_vanishes_the_record_ends(cutoff: bool) -> None:
    load = dataclasses.replace(history((0.0, 1.0), (0.0, 1e-2)), period_s=1 / 64)
    with pytest.raises(AccuracyError, match="roughness vanishes") as fault:
        solve(scene(load, K=1e-5, f_c=-0.2, cutoff=cutoff), [1, 64])
    best = fault.value.best
    assert best is not None
    assert best.cycles.tolist() == [1]
    assert best.error[0] <= 1e-10


def test_what_auto_takes_and_what_it_may_be_told() -> None:
    load = record(2)
    found = solve(scene(load), [1, 2])
    assert found.method == "collocation"
    assert "auto: collocation, because the load does not repeat" in found.notices
    assert solve(scene(load, cutoff=True), [1], 1e-6).method == "collocation"
    with pytest.raises(UsageError, match="collocation is for a measured history"):
        solve(made(), [1], method="collocation")
    with pytest.raises(UsageError, match="the last whole cycle of the load is 2"):
        solve(scene(load), [3])


@pytest.mark.parametrize("name", ["two solids", "on springs"])
def test_how_many_lines_are_taken_at_once_changes_nothing(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where contact is lost, each part of the record is a cycle of its own; one may have none."""
    load, lossy = record(10), {**VARIANTS[name], "cutoff": True}
    pause = dataclasses.replace(
        load, values_mm=(*load.values_mm[:200], *[-1.0] * 300, *load.values_mm[500:])
    )
    asked = [*range(11)]
    want = [followed(rows, asked, **lossy) for rows in (load, pause)]
    direct_ones = [
        direct.integrate(bind(scene(rows, **lossy)), rows, asked, 1e-11) for rows in (load, pause)
    ]
    monkeypatch.setattr(records, "LINES", 7)
    for rows, whole, judge in zip((load, pause), want, direct_ones, strict=True):
        parts = followed(rows, asked, **lossy)
        assert honest(parts.u[1:], parts.error[1:], whole.u[1:], whole.error[1:])
        assert honest(whole.u[1:], whole.error[1:], judge.u[1:], judge.error[1:])
        assert np.all(parts.error <= 1e-12)
    at_rest = want[1].u
    assert at_rest[3] < at_rest[4] == at_rest[7] < at_rest[10]


def test_the_cost_is_a_few_evaluations_a_row() -> None:
    load = record(200)
    found = followed(load, [200], 1e-10)
    assert found.cost.rhs_evaluations < 100 * len(load.times_s)
