"""What counts a run of cycles: stages, one after the other, each from its own start."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from wear.loss_of_contact.arrest import TabulatedCount
from wear.numerics.gauss import FloatArray
from wear.numerics.tolerances import TINY
from wear.orbit.iterates import NEARLY, Iterates
from wear.orbit.segments import Cost


class Integrated(NamedTuple):
    """Cycles taken one by one: the wear (mm) after 0, 1, ... of them with its error."""

    found: Iterates

    @property
    def last_wear(self) -> float:
        """Return the wear (mm) up to which it counts."""
        return float(self.found.last_state[0])

    @property
    def limit(self) -> float:
        """Return the wear (mm) beyond which nothing has a meaning."""
        return float(self.found.limit[0])

    @property
    def ran(self) -> float:
        """Return how many cycles it counts."""
        return float(self.found.integrated_cycles)

    @property
    def first_increment(self) -> float:
        """Return the wear (mm) that its first cycle adds."""
        return float(self.found.first_increment[0])

    @property
    def rests(self) -> bool:
        """Return whether its last cycle adds nothing, and so no cycle after it."""
        return bool(self.found.at_rest[0])

    def wear_after(self, cycles: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the wear (mm) after `cycles`, and its relative error."""
        wear, error = self.found.after(cycles[None])
        return wear[0], error[0]

    def cycles_until(self, wear: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the whole cycles after which each wear (mm) is reached, infinite beyond, and the
        error in cycles."""
        count, error = self.found.until(wear[None])
        return count[0], error[0]


class UnresolvedStage(NamedTuple):
    """The way from the wear `start` to `last_wear` (mm), so short that double precision does not
    tell the cycles apart that it takes, some `reach` of them."""

    start: float
    last_wear: float
    reach: float
    limit: float = np.inf

    @property
    def ran(self) -> float:
        """Return how many whole cycles it counts."""
        return float(np.ceil(self.reach))

    @property
    def first_increment(self) -> float:
        """Return the wear (mm) that a cycle adds."""
        return (self.last_wear - self.start) / self.reach

    @property
    def rests(self) -> bool:
        """Return that wear goes on."""
        return False

    def wear_after(self, cycles: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the wear (mm) after `cycles`, and its relative error."""
        wear = np.minimum(self.start + cycles * self.first_increment, self.last_wear)
        return wear, (self.last_wear - self.start) / wear

    def cycles_until(self, wear: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the whole cycles after which each wear (mm) is reached, infinite beyond, and the
        error in cycles."""
        count = np.ceil(np.maximum(wear - self.start, 0.0) / self.first_increment)
        return np.where(wear > self.last_wear, np.inf, count), np.full(wear.shape, self.reach)


class Stage(NamedTuple):
    """A count from `begins` cycles on, up to `adrift`, with the error (mm) of the wear that
    it begins with."""

    begins: float
    counted: Integrated | TabulatedCount | UnresolvedStage
    inherited: float
    adrift: float = 0.0

    @property
    def uncertainty(self) -> float:
        """By how many cycles its count may be out."""
        first = self.counted.first_increment
        return self.adrift + (self.inherited / first if first > 0 else 0.0)

    @property
    def ends(self) -> bool:
        """Return whether wear is over after it."""
        return self.counted.rests

    @property
    def ran(self) -> float:
        """Return how many whole cycles it counts."""
        return self.counted.ran

    @property
    def drift(self) -> float:
        """By how many cycles the stages after it may begin off."""
        return self.adrift + (
            self.counted.reach if isinstance(self.counted, UnresolvedStage) else 0.0
        )

    def wear_after(self, cycles: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the wear (mm) after `cycles` since the fresh state, and its estimated relative
        error."""
        wear, error = self.counted.wear_after(cycles - self.begins)
        return wear, error + self.inherited / (wear + TINY)

    def cycles_until(self, wear: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Whole cycles since the fresh state after which each wear (mm) is first reached, infinite
        where the count ends before, and the estimated error in cycles."""
        after, missed = self.counted.cycles_until(wear)
        return self.begins + after, missed + self.uncertainty


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


class Stages(NamedTuple):
    """All stages, in order, and whether wear has stopped for good after the last one; it is then
    known up to the relative error `at_rest`, whatever the error of the cycles before."""

    stages: tuple[Stage, ...]
    arrested: bool
    at_rest: float
    cost: Cost
    fades: bool
    compliant: bool

    @property
    def last_wear(self) -> float:
        """Return the wear (mm) up to which it counts."""
        return self.stages[-1].counted.last_wear

    @property
    def arrest(self) -> Arrest | None:
        """When wear stops, if it does within the cycles counted and their error is known."""
        last = self.stages[-1]
        if not self.arrested or not np.isfinite(last.inherited):
            return None
        # A stage that begins at rest does not tell how long it took to get there.
        moving = [stage.uncertainty for stage in self.stages if stage.counted.first_increment > 0]
        uncertainty = max([last.uncertainty, *moving[-1:]])
        if not np.isfinite(uncertainty):
            return None
        if isinstance(last.counted, TabulatedCount):
            return Arrest(
                int(last.begins + last.ran), round(uncertainty + last.counted.uncertainty), True
            )
        if isinstance(last.counted, UnresolvedStage):
            return None
        counted = last.counted.found
        if not np.isfinite(counted.transient_error).all():
            return None
        return Arrest(int(last.begins) + counted.first_idle_cycle, round(uncertainty), self.fades)

    @property
    def ended(self) -> bool:
        """Return whether wear has stopped for good."""
        return self.arrested

    def after(self, cycles: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the wear (mm) after `cycles` (n,) and its estimated relative error, infinite where
        out of reach."""
        wear, error = np.zeros(cycles.shape), np.zeros(cycles.shape)
        begins = np.array([stage.begins for stage in self.stages])
        which = np.maximum(np.searchsorted(begins, cycles, side="right") - 1, 0)
        for i, stage in enumerate(self.stages):
            mine = which == i
            if mine.any():
                wear[mine], error[mine] = stage.wear_after(cycles[mine])
        arrest, last = self.arrest, self.stages[-1]
        if arrest is not None:
            rests = cycles >= arrest.cycle + 2 * arrest.uncertain
            error[rests] = self.at_rest if np.isfinite(self.at_rest) else error[rests]
        else:
            error[cycles > last.begins + last.ran + 1.0] = np.inf
        return wear, error

    def until(self, wear: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the whole cycles to each wear (mm, (n,)), infinite where it is not reached, and
        their error in cycles."""
        count, error = np.full(wear.shape, np.inf), np.zeros(wear.shape)
        for stage in reversed(self.stages):
            after, missed = stage.cycles_until(wear)
            here = np.isfinite(after)
            count[here], error[here] = after[here], missed[here]
        return count, error

    def notices(self, wear: FloatArray) -> Iterator[str]:
        """Return what is worth knowing beside the wear (mm)."""
        arrest, limit = self.arrest, self.stages[-1].counted.limit
        if np.any(wear >= NEARLY * limit):
            yield f"the roughness vanishes near u_c = {limit:.4g} mm: the model ends"
        elif arrest is not None:
            # On springs the pressure vanishes with the distance that is left: no cycle is the last.
            fades = arrest.fades or (self.compliant and arrest.cycle > 0)
            yield str(arrest._replace(fades=fades))
