"""The cycles of one scene, counted from some wear under a load that repeats; and how wear ends."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from wear.numerics.gauss import FloatArray
from wear.orbit.iterates import NEARLY
from wear.orbit.problem import Cost
from wear.orbit.segments import Orbit
from wear.outcome import STOPS

IDLES = "from cycle {} on a cycle adds less than double precision resolves"


class End(NamedTuple):
    """The `cycle`, known up to `uncertain`, in which wear ends, and in what way: one of STOPS,
    FADES, IDLES. Wear that stops does so in a cycle counted from 1."""

    cycle: int
    uncertain: int
    way: str

    def __str__(self) -> str:
        if self.cycle == 0 and self.way == STOPS:
            return "no cycle adds wear"
        spread = f" (to within {self.uncertain})" if self.uncertain else ""
        return self.way.format(f"{self.cycle}{spread}")


class SceneOrbit(NamedTuple):
    """The `orbit` of one scene, and its `end` if wear ends within the cycles counted and it is
    known when."""

    orbit: Orbit
    end: End | None

    @property
    def cost(self) -> Cost:
        """Return its cost."""
        return self.orbit.cost

    @property
    def last_wear(self) -> float:
        """Return the last wear (mm) of the orbit."""
        return float(self.orbit.segments[-1].iterates.last_state[0])

    @property
    def ended(self) -> bool:
        """Return whether wear has stopped for good."""
        return bool(self.orbit.at_rest[0])

    def after(self, cycles: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the wear (mm) after `cycles` (n,) and its estimated relative error, infinite where
        out of reach."""
        wear, error = self.orbit.after(cycles[None])
        return wear[0], error[0]

    def until(self, wear: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the whole cycles to each wear (mm, (n,)), infinite where it is not reached, and
        their error in cycles."""
        count, error = self.orbit.until(wear[None])
        return count[0], error[0]

    def notices(self, wear: FloatArray) -> Iterator[str]:
        """Yield the notices on the wear (mm)."""
        limit = float(self.orbit.segments[-1].iterates.limit[0])
        if np.any(wear >= NEARLY * limit):
            yield f"the roughness vanishes near u_c = {limit:.4g} mm: the model ends"
        elif self.end is not None:
            yield str(self.end)
