"""Life: the number of cycles to a wear depth, also beyond what can be counted one by one.

Within 1e12 cycles the number is that of the engine. Beyond, wear that is steady in the end is
extrapolated by its asymptote, Eqs. (21) and (22) with the logarithmic term; wear that is proved to
end below the depth never reaches it.
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterable
from enum import Enum
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from wear import cycles as engine
from wear.faults import AccuracyError, UsageError
from wear.history import History
from wear.load import Blocks
from wear.load.spans import most_cycles
from wear.model import bind
from wear.quantities import MOST_CYCLES
from wear.regime import Asymptote, asymptote
from wear.request import check_rtol, obstacle, wear_depths
from wear.resampling import resampled
from wear.scene import Scene, as_scene
from wear.solver import solve
from wear.states import fields_at, result_notices

MOST_ITERATIONS = 50
MOST_SHOWN = 5  # depths, where a life is shown in a line
LARGEST_ERROR = 1e-3  # of an extrapolation that is worth a number


class Reached(Enum):
    """How a wear depth relates to the numbers of cycles."""

    COUNTED = "counted"
    EXTRAPOLATED = "extrapolated"  # by the asymptote, beyond 1e12 cycles
    LATER = "> 1e12"
    NEVER = "never"  # wear ends below
    LOAD_ENDS = "load ends"


class Life(NamedTuple):
    """After how many whole `cycles` (n,) each `wear_mm` (n,) is reached, no number where that is
    not known; the estimated relative `error` (n,) of the numbers; how each was found; and what is
    worth knowing of them."""

    wear_mm: tuple[float, ...]
    cycles: NDArray[np.float64]
    error: NDArray[np.float64]
    reached: tuple[Reached, ...]
    notices: tuple[str, ...] = ()

    def __repr__(self) -> str:
        told = [
            f"{wear:.6g} mm after {cycles:.6g} cycles" if cycles == cycles
            else f"{wear:.6g} mm: {way.value}"
            for wear, cycles, way in zip(self.wear_mm, self.cycles, self.reached, strict=True)
        ]  # fmt: skip
        rest = [f"{len(told) - MOST_SHOWN} more"] if len(told) > MOST_SHOWN else []
        return f"<Life: {'; '.join(told[:MOST_SHOWN] + rest)}>"


def cycles_until(
    scene: Scene | str | os.PathLike[str], wear_mm: float | Iterable[float], rtol: float = 1e-10
) -> Life:
    """Return after how many cycles the bearing has worn by each depth.

    Parameters
    ----------
    scene
        A scene, the name of a built-in one, or a path.
    wear_mm
        Depths of wear, mm; or one depth.
    rtol
        Requested relative accuracy of the wear.

    Raises
    ------
    UsageError
        if a depth is no positive number, or the load does not repeat.

    >>> life = cycles_until("section4", [1e-3, 5e4])
    >>> [f"{cycles:.4e}" for cycles in life.cycles], [way.value for way in life.reached]
    (['1.4000e+02', '1.0786e+12'], ['counted', 'extrapolated'])
    """
    scene = as_scene(scene)
    depths = _checked(scene, wear_mm, rtol)
    fewer, model = resampled(scene, rtol), bind(scene)
    found = engine.cycles_until(model, fewer.scene.load, np.array(depths), rtol - fewer.error)
    cycles, error = found.cycles.copy(), found.error + fewer.error
    known = np.isfinite(cycles) & np.isfinite(error)
    reached = [Reached.COUNTED] * len(depths)
    if not known.all():
        beyond = _Beyond(scene, rtol)
        for place in np.flatnonzero(~known):
            cycles[place], error[place], reached[place] = beyond(depths[place])
    ends = [depth for depth, count in zip(depths, cycles, strict=True) if math.isfinite(count)]
    u = np.array(ends)
    fields = fields_at(model, scene, [0] * len(ends), u)
    judged = result_notices(model, scene, fields, cycles[np.isfinite(cycles)].tolist(), u)
    return Life(depths, cycles, error, tuple(reached), (*scene.notices, *judged))


def _checked(scene: Scene, wear_mm: float | Iterable[float], rtol: float) -> tuple[float, ...]:
    faults: list[str] = []
    depths = wear_depths(wear_mm, faults)
    check_rtol(rtol, faults)
    if (against := obstacle(scene)) is not None:
        faults.append(f"cycles cannot be counted: {against}")
    if faults:
        raise UsageError("\n".join(faults))
    return tuple(map(float, depths))


class _Beyond:
    """What becomes of wear that 1e12 cycles, or the load, do not bring about."""

    def __init__(self, scene: Scene, rtol: float) -> None:
        self.scene, self.rtol = scene, rtol
        self.blocks = isinstance(scene.load, Blocks)

    @cached_property
    def far(self) -> Asymptote | None:
        """Return the asymptote, None where it could not be found."""
        try:
            return asymptote(self.scene)
        except AccuracyError:
            return None

    @cached_property
    def counted(self) -> History | None:
        """Return the last decade that is counted, None where it could not be."""
        try:
            return solve(self.scene, (MOST_CYCLES // 10, MOST_CYCLES), self.rtol)
        except AccuracyError:
            return None

    def __call__(self, depth: float) -> tuple[float, float, Reached]:
        """Return the cycles to a depth, their relative error and how they were found."""
        if self.blocks:
            ends = most_cycles(self.scene.load) < MOST_CYCLES
            return math.nan, math.nan, Reached.LOAD_ENDS if ends else Reached.LATER
        far = self.far
        limits = () if far is None else (far.arrest_wear_mm, far.saturation_wear_mm)
        if any(limit is not None and depth > limit for limit in limits):
            return math.nan, math.nan, Reached.NEVER
        cycles, error = self._extrapolated(depth)
        if not error < LARGEST_ERROR:
            return math.nan, math.nan, Reached.LATER
        return cycles, error, Reached.EXTRAPOLATED

    def _extrapolated(self, depth: float) -> tuple[float, float]:
        """Return the cycles by the asymptote, and their error by its misfit in the last decade."""
        if self.far is None or not self.far.wear_per_cycle_mm or self.counted is None:
            return math.nan, math.inf
        rate, drift = self.far.wear_per_cycle_mm, self.far.log_coefficient_mm or 0.0
        before, last = self.counted.u_c.tolist()
        expected = rate * (MOST_CYCLES - MOST_CYCLES // 10) + drift * math.log(10.0)
        misfit = abs(last - before - expected) / expected
        cycles = float(MOST_CYCLES)
        for _ in range(MOST_ITERATIONS):
            drifted = drift * math.log(cycles / MOST_CYCLES)
            cycles = MOST_CYCLES + max(0.0, (depth - last - drifted) / rate)
            if not math.isfinite(cycles):
                return math.nan, math.inf
        return cycles, misfit + float(self.counted.error[1]) * last / (rate * cycles)
