"""Any du/dt = f(u, t) with periodic f: the state after any number of cycles.

Example
-------
Paris's law of crack growth, da/dN = C (dK)^m with dK = Y ds sqrt(pi a), is a rate that repeats with
every load cycle and grows with the state; its closed form for m = 4 is 1/a = 1/a_0 - c N.

>>> c, a_0 = 1e-4, 1.0
>>> def growth(a, t):
...     return 2 * c * a**2 * np.sin(np.pi * t) ** 2
>>> found = count_cycles(growth, [1, 1000, 9000], start=a_0, scale=a_0, period=1.0, limit=20.0)
>>> bool(np.all(np.abs(found.u * (1 / a_0 - c * np.array([1, 1000, 9000])) - 1) <= found.error))
True
"""

from __future__ import annotations

import numbers
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from wear.numerics.collocation import Tangent
from wear.numerics.floating_point import ROUNDOFF, TINY
from wear.numerics.gauss import FloatArray, mesh
from wear.orbit.period_map import Selection
from wear.orbit.problem import Cost
from wear.orbit.segments import Orbit, orbit

Rate = Callable[[FloatArray, FloatArray], FloatArray]
CONDITION = 8.0  # roundoffs of a rate, at least
NOISE_STATES = 8  # from which the noise of a rate is estimated
FEW_NODES = 8  # of phase, between breakpoints
EARLIER = 1000  # numbers of cycles for a lower bound of states near their limit
DIFFERENCE = 1e-6  # of the state and its scale: half the distance for a difference quotient
MOST, LARGEST_RTOL = 1e12, 0.1  # cycles, and a relative accuracy
_POSITIVE = "a positive number"
_EXPECTED = {
    "period": _POSITIVE,
    "start": "zero or a positive number",
    "scale": _POSITIVE,
    "limit": _POSITIVE,
    "rtol": f"a positive number up to {LARGEST_RTOL}",
}


class StatesAfter(NamedTuple):
    """The states `u` (n,) after the requested cycles, their estimated relative `error`, and the
    cost."""

    u: FloatArray
    error: FloatArray
    cost: Cost


@dataclass(frozen=True)
class _General:
    """One equation du/dt = f(u, t); its forcing is the phase itself."""

    f: Rate
    period: float
    scale: FloatArray
    limit: FloatArray
    breakpoints: list[FloatArray]
    scenes: int = 1

    @property
    def some_phases(self) -> FloatArray:
        """Return a few phases between breakpoints."""
        return mesh(self.breakpoints[0], FEW_NODES).phases.ravel()

    def take(self, rows: Selection) -> _General:
        return self

    def forcing(self, phases: FloatArray) -> FloatArray:
        return phases

    def rate(
        self,
        u: FloatArray,
        forcing: FloatArray,
        lengths: FloatArray | float = 1.0,
        near: Tangent | None = None,
    ) -> FloatArray:
        return self.period * lengths * np.asarray(self.f(u, self.period * forcing))

    def slope(self, u: FloatArray, forcing: FloatArray) -> FloatArray:
        step = DIFFERENCE * (np.abs(u) + self.scale)
        more, less = (self.rate(u + sign * step, forcing) for sign in (1.0, -1.0))
        return (more - less) / (2 * step)

    def roundoff(self, u: FloatArray) -> FloatArray:
        """Return the relative error of the rate by rounding: its noise, from fourth differences
        (Moré & Wild 2011), and its change with the last digit of the state."""
        apart = DIFFERENCE * (u + self.scale)[..., None, None]
        steps = np.arange(NOISE_STATES)[:, None]
        rate = self.rate(u[..., None, None] + apart * steps, self.some_phases)
        beside = self.rate(u[..., None, None] * (1.0 - ROUNDOFF), self.some_phases)[..., 0, :]
        by_state = np.max(np.abs(rate[..., 0, :] - beside), axis=-1)
        noise = np.sqrt(np.mean(np.diff(rate, 4, axis=-2) ** 2, axis=(-2, -1)) / 70)
        largest = np.max(np.abs(rate), axis=(-2, -1)) + TINY
        relative: FloatArray = (noise + by_state) / largest
        return np.clip(relative, CONDITION * ROUNDOFF, 1.0)


def count_cycles(
    f: Rate,
    cycles: ArrayLike,
    *,
    period: float,
    start: float,
    scale: float,
    breakpoints: Sequence[float] = (),
    rtol: float = 1e-10,
    limit: float = np.inf,
) -> StatesAfter:
    """Return the states of du/dt = f(u, t), f of the given period in t, after whole `cycles`.

    Parameters
    ----------
    f
        The rate, for arrays of u and t that broadcast; not negative, smooth in u.
    cycles
        Whole numbers up to 1e12, in any order, or one.
    start
        The state before the first cycle, not negative.
    scale
        The change of the state that changes the rate by a factor of order one, roughly: it says how
        panels are laid out, and no result depends on it.
    breakpoints
        Times in (0, period) at which f is not smooth in t. A pulse that is shorter than a hundredth
        of the period is sure to be seen only between two of them.
    rtol
        Requested relative error of the states; where it is missed the estimated error says so.
    limit
        States from here on have no meaning. If f vanishes here, no state goes beyond it, and one
        that is nearer to it than its own error is set to it.

    Raises
    ------
    ValueError
        with all faults of the request; if f gives no finite number at the start.
    """
    given = {"period": period, "start": start, "scale": scale, "rtol": rtol, "limit": limit}
    if faults := [*_faults(f, cycles, given, breakpoints)]:
        raise ValueError("\n".join(faults))
    cuts = np.array([0.0, *(time / period for time in sorted(breakpoints)), 1.0])
    equation = _General(f, period, np.array([scale]), np.array([limit]), [cuts])
    requested = np.atleast_1d(np.asarray(cycles, dtype=float))[None]
    with np.errstate(all="ignore"):  # trial states far off the solution may overflow
        orbits = orbit(equation, np.max(requested, axis=1), rtol, np.array([start]), np.zeros(1))
        u, error = orbits.after(requested)
        if limit < np.inf and not np.any(equation.rate(np.array(limit), equation.some_phases)):
            u, error = _at_most(limit, u, error, requested, orbits)
    return StatesAfter(u[0], error[0], orbits.cost)


def _faults(
    f: Rate, cycles: ArrayLike, given: Mapping[str, float], breakpoints: Sequence[float]
) -> Iterator[str]:
    """Yield the faults of a request, each with its remedy."""
    wanted = _finite(cycles)
    if wanted.ndim > 1 or not wanted.size or np.any(wanted != np.clip(np.rint(wanted), 0, MOST)):
        yield f"cycles: give whole numbers from 0 to {MOST:g}"
    valid = {name: _positive(number) for name, number in given.items()}
    valid["start"] |= given["start"] == 0.0
    valid["limit"] |= given["limit"] == np.inf
    valid["rtol"] = valid["rtol"] and given["rtol"] <= LARGEST_RTOL
    wrong = [name for name in given if not valid[name]]
    yield from (f"{name}: {given[name]!r} is not {_EXPECTED[name]}" for name in wrong)
    if wrong:
        return
    if given["start"] > given["limit"]:
        yield f"start: {given['start']!r} is beyond the limit"
    cuts, period = _finite(breakpoints), given["period"]
    if cuts.ndim != 1 or not np.all((cuts > 0.0) & (cuts < period)):
        yield "breakpoints: give a list of times between 0 and the period"
    u, t = np.full((2, 1), float(given["start"])), np.array([0.0, 0.5, 1.0]) * period
    with np.errstate(all="ignore"):
        rate = np.asarray(f(u, t))
    if rate.shape != (2, 3) or not np.all(np.isfinite(rate)):
        yield "f: give a finite rate for each of u and t, arrays that broadcast"
    elif np.any(rate < 0.0):
        yield "f: is negative at the start"


def _positive(given: object) -> bool:
    return isinstance(given, numbers.Real) and 0.0 < float(given) < np.inf


def _finite(given: Any) -> FloatArray:
    """Return a number or numbers as an array, NaN where they are none."""
    try:
        array = np.asarray(given, dtype=float)
    except (TypeError, ValueError):
        return np.array([np.nan])
    return np.where(np.isfinite(array), array, np.nan)


def _at_most(
    limit: float, u: FloatArray, error: FloatArray, cycles: FloatArray, orbits: Orbit
) -> tuple[FloatArray, FloatArray]:
    """Return the states u (1, n) after `cycles` and their errors, below a limit at which the rate
    vanishes: the limit itself, where its distance from an earlier state is less than the error."""
    earlier = np.floor(np.geomspace(1.0, max(np.max(cycles), 1.0), EARLIER))[None]
    state, uncertain = orbits.after(earlier)
    bound = np.maximum.accumulate(np.fmax(state * (1.0 - uncertain), 0.0), axis=1)
    before = np.searchsorted(earlier[0], cycles, side="right") - 1
    distance = np.where(before >= 0, 1.0 - bound[0, before] / limit, np.inf)
    near = ~(error <= distance)
    return np.where(near, limit, u), np.where(near, distance, error)
