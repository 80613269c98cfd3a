"""The orbit of a scene that may lose contact, and where wear ends."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from wear.loss_of_contact.arrest import TabulatedCount
from wear.numerics.gauss import BoolArray, FloatArray, IntArray
from wear.orbit.iterates import NEARLY, Iterates
from wear.orbit.problem import Cost
from wear.orbit.segments import Orbit, Segment


class Unresolved(NamedTuple):
    """The way from the wear `start` to `last_state` (1,), mm, so short that double precision does
    not resolve the cycles that it takes, some `reach` of them (1,)."""

    start: FloatArray
    last_state: FloatArray
    reach: FloatArray

    def take(self, rows: IntArray) -> Unresolved:
        """Return the same: it is of one scene."""
        return self

    @property
    def limit(self) -> FloatArray:
        """Return that the model goes on."""
        return np.full(1, np.inf)

    @property
    def at_rest(self) -> BoolArray:
        """Return that wear goes on."""
        return np.full(1, False)

    @property
    def whole_cycles(self) -> FloatArray:
        """Return how many whole cycles it counts."""
        return np.ceil(self.reach)

    @property
    def first_increment(self) -> FloatArray:
        """Return the wear (mm) that a cycle adds."""
        return (self.last_state - self.start) / self.reach

    def after(self, cycles: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the wear (mm) after `cycles` (1, c), and its relative error."""
        wear = np.minimum(self.start + cycles * self.first_increment, self.last_state)
        return wear, (self.last_state - self.start) / wear

    def until(self, wear: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the whole cycles after which each wear (mm, (1, c)) is reached, infinite beyond,
        and the error in cycles."""
        count = np.ceil(np.maximum(wear - self.start, 0.0) / self.first_increment)
        return np.where(wear > self.last_state, np.inf, count), self.reach + np.zeros(wear.shape)


class Arrest(NamedTuple):
    """The `cycle`, counted from 1, in which wear stops for good, known up to `uncertain`; if it
    `fades`, that from which on double precision does not tell it from its end."""

    cycle: int
    uncertain: int
    fades: bool = False

    def __str__(self) -> str:
        spread = f" (± {self.uncertain})" if self.uncertain else ""
        if self.fades:
            return f"wear approaches its limit; within rounding from cycle {self.cycle}{spread} on"
        return f"wear stops for good in cycle {self.cycle}{spread}"


class CountToArrest(NamedTuple):
    """The `orbit` of one scene, and whether wear has stopped for good at its end; it is then known
    up to the relative error `at_rest`, whatever the error of the cycles before."""

    orbit: Orbit
    arrested: bool
    at_rest: float
    fades: bool
    compliant: bool

    @property
    def cost(self) -> Cost:
        """Return what it took."""
        return self.orbit.cost

    @property
    def segments(self) -> tuple[Segment, ...]:
        """Return the segments of the orbit."""
        return self.orbit.segments

    @property
    def last_wear(self) -> float:
        """Return the wear (mm) up to which it counts."""
        return float(self.segments[-1].counted.last_state[0])

    @property
    def arrest(self) -> Arrest | None:
        """When wear stops, if it does within the cycles counted and their error is known."""
        last = self.segments[-1]
        begins, counted = int(last.begins[0]), last.counted
        if not self.arrested or not np.isfinite(last.inherited[0]):
            return None
        # A segment that begins at rest does not tell how long it took to get there.
        moving = [float(s.blur[0]) for s in self.segments if s.counted.first_increment[0] > 0]
        uncertainty = max([float(last.blur[0]), *moving[-1:]])
        if not np.isfinite(uncertainty):
            return None
        if isinstance(counted, TabulatedCount):
            ran = int(counted.whole_cycles[0])
            return Arrest(begins + ran, round(uncertainty + float(counted.count_error[-1])), True)
        if not isinstance(counted, Iterates) or not np.isfinite(counted.transient_error).all():
            return None
        return Arrest(begins + counted.first_idle_cycle, round(uncertainty), self.fades)

    @property
    def ended(self) -> bool:
        """Return whether wear has stopped for good."""
        return self.arrested

    def after(self, cycles: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the wear (mm) after `cycles` (n,) and its estimated relative error, infinite where
        out of reach."""
        wear, error = (found[0] for found in self.orbit.after(cycles[None]))
        arrest, last = self.arrest, self.segments[-1]
        if arrest is None:
            error[cycles > last.begins + last.counted.whole_cycles + 1.0] = np.inf
        elif np.isfinite(self.at_rest):
            error[cycles >= arrest.cycle + 2 * arrest.uncertain] = self.at_rest
        return wear, error

    def until(self, wear: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the whole cycles to each wear (mm, (n,)), infinite where it is not reached, and
        their error in cycles."""
        count, error = self.orbit.until(wear[None])
        return count[0], error[0]

    def notices(self, wear: FloatArray) -> Iterator[str]:
        """Return what is worth knowing beside the wear (mm)."""
        arrest, limit = self.arrest, float(self.segments[-1].counted.limit[0])
        if np.any(wear >= NEARLY * limit):
            yield f"the roughness vanishes near u_c = {limit:.4g} mm: the model ends"
        elif arrest is not None:
            # On springs the pressure vanishes with the distance that is left: no cycle is the last.
            fades = arrest.fades or (self.compliant and arrest.cycle > 0)
            yield str(arrest._replace(fades=fades))
