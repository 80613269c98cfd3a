"""What counts a run of cycles: stages, one after the other, each from its own start."""

from typing import NamedTuple

import numpy as np

from wear.count.build import CycleCount, evaluate, until
from wear.count.cycle import Cost
from wear.count.tail import Between
from wear.numerics.gauss import (
    FloatArray,
)
from wear.numerics.tolerances import (
    TINY,
)


class Leap(NamedTuple):
    """The way from the wear `start` to `last_wear` (mm), so short that double precision does not
    tell the cycles apart that it takes, some `reach` of them."""

    start: float
    last_wear: float
    reach: float
    cost: Cost = Cost(0, 0)
    limit: float = np.inf

    @property
    def ran(self) -> float:
        """How many whole cycles it counts."""
        return float(np.ceil(self.reach))

    @property
    def pace(self) -> float:
        """The wear (mm) that a cycle adds."""
        return (self.last_wear - self.start) / self.reach

    @property
    def rests(self) -> bool:
        """Wear goes on."""
        return False

    def wear_after(self, cycles: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Wear (mm) after `cycles`, and its relative error."""
        wear = np.minimum(self.start + cycles * self.pace, self.last_wear)
        return wear, (self.last_wear - self.start) / wear

    def cycles_until(self, wear: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Whole cycles after which each wear (mm) is reached, infinite beyond, and the error."""
        count = np.ceil(np.maximum(wear - self.start, 0.0) / self.pace)
        return np.where(wear > self.last_wear, np.inf, count), np.full(wear.shape, self.reach)


class Stage(NamedTuple):
    """A count from `begins` cycles on, up to `adrift`, with the error (mm) of the wear that
    it begins with."""

    begins: float
    counted: CycleCount | Between | Leap
    inherited: float
    adrift: float = 0.0

    @property
    def blur(self) -> float:
        """By how many cycles its count may be out."""
        pace = self.counted.pace
        return self.adrift + (self.inherited / pace if pace > 0 else 0.0)

    @property
    def ends(self) -> bool:
        """Whether wear is over after it."""
        return self.counted.rests

    @property
    def ran(self) -> float:
        """How many whole cycles it counts."""
        if not isinstance(self.counted, CycleCount):
            return self.counted.ran
        return float(len(self.counted.first) - 1)

    @property
    def drift(self) -> float:
        """By how many cycles the stages after it may begin off."""
        return self.adrift + (self.counted.reach if isinstance(self.counted, Leap) else 0.0)

    def wear_after(self, cycles: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Wear (mm) after `cycles` since the fresh state, and its estimated relative error."""
        since = cycles - self.begins
        if isinstance(self.counted, CycleCount):
            wear, error = evaluate(self.counted, since)
        else:
            wear, error = self.counted.wear_after(since)
        return wear, error + self.inherited / (wear + TINY)

    def cycles_until(self, wear: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Whole cycles since the fresh state after which each wear (mm) is first reached, infinite
        where the count ends before, and the estimated error in cycles."""
        if isinstance(self.counted, CycleCount):
            after, missed = until(self.counted, wear)
        else:
            after, missed = self.counted.cycles_until(wear)
        return self.begins + after, missed + self.blur


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
    fades: bool = False

    @property
    def last_wear(self) -> float:
        """The wear (mm) up to which it counts."""
        return self.stages[-1].counted.last_wear

    @property
    def arrest(self) -> Arrest | None:
        """When wear stops, if it does within the cycles counted and their error is known."""
        last = self.stages[-1]
        if not self.arrested or not np.isfinite(last.inherited):
            return None
        # A stage that begins at rest does not tell how long it took to get there.
        moving = [stage.blur for stage in self.stages if stage.counted.pace > 0]
        blur = max([last.blur, *moving[-1:]])
        if not np.isfinite(blur):
            return None
        if isinstance(last.counted, Between):
            return Arrest(int(last.begins + last.ran), round(blur + last.counted.uncertainty), True)
        if isinstance(last.counted, Leap) or not np.isfinite(last.counted.first_error).all():
            return None
        idle = int(np.argmax(np.diff(last.counted.first) <= 0))
        return Arrest(int(last.begins) + idle, round(blur), self.fades)


def evaluate_stages(found: Stages, cycles: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Wear (mm) after `cycles` and its estimated relative error, infinite where out of reach."""
    wear, error = np.zeros(cycles.shape), np.zeros(cycles.shape)
    begins = np.array([stage.begins for stage in found.stages])
    which = np.maximum(np.searchsorted(begins, cycles, side="right") - 1, 0)
    for i, stage in enumerate(found.stages):
        mine = which == i
        if mine.any():
            wear[mine], error[mine] = stage.wear_after(cycles[mine])
    last = found.stages[-1]
    if found.arrest is not None:
        rests = cycles >= found.arrest.cycle + 2 * found.arrest.uncertain
        error[rests] = found.at_rest if np.isfinite(found.at_rest) else error[rests]
    else:
        error[cycles > last.begins + last.ran + 1.0] = np.inf
    return wear, error
