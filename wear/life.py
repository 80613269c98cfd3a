"""Life: the number of cycles to a wear depth, also beyond the 1e12 cycles that are counted.

Within 1e12 cycles the number is that of the engine. Beyond, wear that becomes steady is
extrapolated by its asymptote, Eqs. (21) and (22) with the logarithmic term; wear whose proved limit
is below the depth never reaches it.
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterable
from enum import Enum
from typing import NamedTuple

import numpy as np

from wear import cycles as engine
from wear.binding import bind
from wear.faults import AccuracyError, Faults
from wear.load import Blocks
from wear.load.spans import most_cycles
from wear.numerics.gauss import FloatArray
from wear.quantities import MOST_CYCLES
from wear.regime import Asymptote, asymptote
from wear.request import ONE_PERIOD, check_rtol, obstacle, wear_depths
from wear.resampling import resampled
from wear.scene import Scene, as_scene
from wear.solver import solve
from wear.states import notices_of_wear

MOST_ITERATIONS = 50  # for the cycles to a depth by the asymptote
MOST_SHOWN = 5  # depths, where a life is shown in a line
LARGEST_ERROR = 1e-3  # of an extrapolation that is reported
NO_DIGIT = 1.0  # relative error of a number that is not known


class Reached(Enum):
    """How a wear depth relates to the numbers of cycles."""

    COUNTED = "counted"
    EXTRAPOLATED = "extrapolated"  # by the asymptote, beyond 1e12 cycles
    LATER = "> 1e12"
    UNKNOWN = "unknown"  # within 1e12 cycles, but the error is as large as the number
    NEVER = "never"  # wear ends below
    LOAD_ENDS = "load ends"


class Life(NamedTuple):
    """The whole numbers of `cycles` (n,) to each `wear_mm` (n,), NaN if unknown; their estimated
    relative `error` (n,); the way in which each was found; and notices."""

    wear_mm: tuple[float, ...]
    cycles: FloatArray
    error: FloatArray
    reached: tuple[Reached, ...]
    notices: tuple[str, ...] = ()

    def __repr__(self) -> str:
        texts = [
            f"{wear:.6g} mm after {cycles:.6g} cycles" if cycles == cycles
            else f"{wear:.6g} mm: {way.value}"
            for wear, cycles, way in zip(self.wear_mm, self.cycles, self.reached, strict=True)
        ]  # fmt: skip
        rest = [f"{len(texts) - MOST_SHOWN} more"] if len(texts) > MOST_SHOWN else []
        return f"<Life: {'; '.join(texts[:MOST_SHOWN] + rest)}>"


def cycles_until(
    scene: Scene | str | os.PathLike[str], wear_mm: float | Iterable[float], rtol: float = 1e-10
) -> Life:
    """Return the number of cycles to each depth of bearing wear.

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
        if a depth is negative or no number, or the load does not repeat.

    >>> life = cycles_until("section4", [1e-3, 5e4])
    >>> [f"{cycles:.4e}" for cycles in life.cycles], [way.value for way in life.reached]
    (['1.4000e+02', '1.0786e+12'], ['counted', 'extrapolated'])
    """
    scene, faults = as_scene(scene), Faults()
    depths = wear_depths(wear_mm, faults)
    check_rtol(rtol, faults)
    if (against := obstacle(scene)) is not None:
        faults.append(f"cycles cannot be counted: {against}; {ONE_PERIOD}")
    faults.stop_if_any()
    fewer, model = resampled(scene, rtol), bind(scene)
    counted = engine.first_passage(model, fewer.scene.load, np.array(depths), rtol - fewer.error)
    cycles, error = counted.cycles.copy(), counted.error + fewer.count_error(counted.cycles)
    reached = [Reached.COUNTED] * len(depths)
    known = np.isfinite(cycles) & (error < NO_DIGIT)
    if not known.all():
        within = np.isfinite(cycles)
        cycles[~known], error[~known], ways = _beyond(scene, np.array(depths)[~known], rtol)
        for place, way in zip(np.flatnonzero(~known).tolist(), ways, strict=True):
            reached[place] = Reached.UNKNOWN if within[place] and way is not Reached.NEVER else way
        cycles[within & ~known] = error[within & ~known] = np.nan
    ends = np.isfinite(cycles)
    notices = notices_of_wear(scene, cycles[ends].tolist(), np.array(depths)[ends])
    return Life(depths, cycles, error, tuple(reached), notices)


def _beyond(
    scene: Scene, depths: FloatArray, rtol: float
) -> tuple[FloatArray, FloatArray, list[Reached]]:
    """Return the cycles to depths (k,) that are not reached within 1e12 cycles, or by the load,
    their relative errors, and the way in which each was found."""
    cycles, error = np.full((2, len(depths)), np.nan)
    if isinstance(scene.load, Blocks):
        ends = most_cycles(scene.load) < MOST_CYCLES
        return cycles, error, [Reached.LOAD_ENDS if ends else Reached.LATER] * len(depths)
    try:
        far = asymptote(scene)
        limits = (far.arrest_wear_mm, far.saturation_wear_mm)
        never = depths > min((limit for limit in limits if limit is not None), default=np.inf)
        if far.wear_per_cycle_mm and not never.all():
            cycles, error = _extrapolated(scene, far.wear_per_cycle_mm, far, depths, rtol)
    except AccuracyError:
        never = np.full(len(depths), False)
    found = np.isfinite(cycles) & (error < LARGEST_ERROR) & ~never
    ways = [
        Reached.EXTRAPOLATED if good else Reached.NEVER if ends else Reached.LATER
        for good, ends in zip(found.tolist(), never.tolist(), strict=True)
    ]
    return np.where(found, cycles, np.nan), np.where(found, error, np.nan), ways


@np.errstate(all="ignore")  # a number of cycles may exceed the range of doubles
def _extrapolated(
    scene: Scene, rate: float, far: Asymptote, depths: FloatArray, rtol: float
) -> tuple[FloatArray, FloatArray]:
    """Return the cycles to depths (k,) by the asymptote, and their relative errors by its misfit in
    the last counted decade."""
    drift = far.log_coefficient_mm or 0.0
    counted = solve(scene, (MOST_CYCLES // 10, MOST_CYCLES), rtol)
    before, last = counted.u_c.tolist()
    expected = rate * (MOST_CYCLES - MOST_CYCLES // 10) + drift * math.log(10.0)
    misfit = abs(last - before - expected) / expected
    cycles = np.full(len(depths), float(MOST_CYCLES))
    for _ in range(MOST_ITERATIONS):
        drifted = drift * np.log(cycles / MOST_CYCLES)
        more = np.maximum(0.0, (depths - last - drifted) / rate)
        cycles = np.where(np.isfinite(cycles), MOST_CYCLES + more, np.inf)
    return cycles, misfit + counted.error[1] * last / (rate * cycles)
