"""Cycles of equations that are no wear, against closed forms."""

import numpy as np
import pytest

from derive.time_limit import time_limit
from wear.orbit.general import count_cycles


@pytest.mark.parametrize("rtol", [1e-6, 1e-10])
def test_crack_growth_by_the_law_of_paris(rtol: float) -> None:
    """da/dN = c a^2 has the solution 1/a = 1/a_0 - c N, whatever the shape of the cycle."""
    cycles = np.array([1.0, 10.0, 1e3, 5e3, 9e3, 9.4e3])
    found = count_cycles(
        lambda a, t: 2e-4 * a**2 * np.sin(np.pi * t) ** 2,
        cycles.tolist(),
        start=1.0,
        scale=1.0,
        period=1.0,
        limit=20.0,
        rtol=rtol,
    )
    true = np.abs(found.u * (1 - 1e-4 * cycles) - 1)
    assert np.all((true <= found.error) | (true < 3e-15))
    assert np.all(found.error <= rtol)
    assert found.cost.cycles_integrated < 200


def test_a_jump_in_time_is_a_breakpoint() -> None:
    """du/dt = exp(-u) in half of each cycle: u = ln(1 + N/2)."""
    cycles = np.array([1.0, 1e3, 1e9])
    found = count_cycles(
        lambda u, t: np.where(t % 0.02 < 0.01, np.exp(-u), 0.0) / 0.02,
        cycles.tolist(),
        start=0.0,
        scale=1.0,
        period=0.02,
        breakpoints=[0.01],
    )
    assert np.all(np.abs(found.u / np.log1p(cycles / 2) - 1) <= found.error + 3e-15)
    assert np.all(found.error <= 1e-10)


def test_beyond_the_limit_nothing_is_known() -> None:
    found = count_cycles(
        lambda a, t: 1e-3 * a**2 + 0 * t, [100, 2000], start=1.0, scale=1.0, period=1.0, limit=50.0
    )
    assert found.error[0] <= 1e-10
    assert found.error[1] == np.inf


def test_states_that_rounding_keeps_from_their_limit_are_given_up():
    """Near u = 1 the rate 1 - u is but rounding: what it adds cannot be resolved, and is not."""
    found = count_cycles(
        lambda u, t: (1 - u) + 0 * t,
        [20, 30],
        period=1.0,
        start=0.0,
        scale=1.0,
        limit=1.0,
        rtol=1e-9,
    )
    assert np.all(np.abs(found.u + np.expm1(-np.array([20.0, 30.0]))) <= found.error + 3e-16)
    assert found.cost.rhs_evaluations < 100_000


def test_a_first_cycle_that_ends_in_rounding_is_given_up():
    """Twenty times as fast the limit is reached within it."""
    with time_limit(60.0, "the first cycle"):
        found = count_cycles(
            lambda u, t: 20 * (1 - u) + 0 * t, [1], period=1.0, start=0.0, scale=1.0, limit=1.0
        )
    assert (found.u.tolist(), found.error.tolist()) == ([1.0], [1.0])


@pytest.mark.parametrize("power", [1, 2])
@pytest.mark.parametrize("rate", [0.1, 1.0])
def test_states_come_to_rest_at_a_limit(power, rate):
    """With v = 1 - u the solutions of dv/dt = -c v^m are exp(-c t) and 1/(1 + c t)."""
    cycles = np.array([1.0, 100.0, 1e4, 1e6, 1e12])
    found = count_cycles(
        lambda u, t: rate * np.maximum(1 - u, 0) ** power * (1 + np.sin(2 * np.pi * t)),
        cycles.tolist(),
        period=1.0,
        start=0.0,
        scale=1.0,
        limit=1.0,
    )
    true = -np.expm1(-rate * cycles) if power == 1 else cycles * rate / (1 + cycles * rate)
    assert np.all(np.abs(found.u / true - 1) <= found.error + 1e-15)
    assert np.all(found.error < 1e-6)


def test_a_rate_that_is_noise_ends_the_search_for_digits():
    """1 + tanh(x) loses its digits where x is far below zero: du/dt is about 2 exp(-2 u) there."""
    found = count_cycles(
        lambda u, t: 1e-3 * (1 + np.tanh(4 * np.sin(2 * np.pi * t) - u)),
        [1e3, 1e12],
        period=1.0,
        start=0.0,
        scale=1.0,
    )
    far = np.log(4e9 * np.i0(8.0)) / 2  # to leading order
    assert abs(found.u[1] / far - 1) < 1e-8
    assert found.error[0] < 1e-12
    assert found.error[1] < 1e-7
    assert found.cost.rhs_evaluations < 1e8


@pytest.mark.parametrize(
    ("wrong", "names"),
    [
        ({"period": 0, "scale": -1.0}, ("period", "scale")),
        ({"period": "1", "start": [0.0], "rtol": 0.0}, ("period", "start", "rtol")),
        ({"scale": np.nan, "limit": -1.0, "rtol": 1.0}, ("scale", "rtol", "limit")),
        ({"start": 2.0, "limit": 1.0}, ("start",)),
        ({"breakpoints": [2.0]}, ("breakpoints",)),
        ({"breakpoints": 0.5}, ("breakpoints",)),
        ({"cycles": [1.5]}, ("cycles",)),
        ({"cycles": [-1.0]}, ("cycles",)),
        ({"cycles": []}, ("cycles",)),
        ({"cycles": ["a"], "start": -1.0}, ("cycles", "start")),
        ({"f": lambda *_: 1.0}, ("f",)),
        ({"f": lambda u, t: np.nan * u * t}, ("f",)),
        ({"f": lambda u, t: -1.0 + 0.0 * u * t}, ("f",)),
    ],
)
def test_every_fault_of_a_request_is_named(wrong: dict, names: tuple[str, ...]) -> None:
    """They were silent, or endless, or errors of NumPy."""
    right = {"f": lambda u, t: np.exp(-u) + 0.0 * t, "cycles": 5, "period": 1.0, "scale": 1.0}
    assert count_cycles(**right, start=0.0).u[0] == pytest.approx(np.log(6.0), rel=1e-9)
    with pytest.raises(ValueError, match=names[0]) as fault:
        count_cycles(**(right | {"start": 0.0} | wrong))
    assert [line.partition(":")[0] for line in str(fault.value).splitlines()] == [*names]
