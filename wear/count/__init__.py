"""Any number of cycles from a few: wear after N cycles, and cycles until a wear.

Abel's equation for the cycle count, see docs/method.md; the load repeats.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from wear.count.cycle import Cost
from wear.count.scan import LEAST
from wear.count.stage import Stages, evaluate_stages
from wear.count.stages import counted_stages
from wear.load import Load
from wear.model import Model
from wear.numerics.gauss import (
    FloatArray,
)

MOST_CYCLES = 1e12


class Wear(NamedTuple):
    """Wear `u_c` (mm) after the cycles asked for, and its estimated relative error."""

    u_c: FloatArray
    error: FloatArray
    cost: Cost
    notices: tuple[str, ...]


# Trial states far off the solution may overflow; what is no number fails the estimate of error.
@np.errstate(all="ignore")
def wear_after(
    model: Model,
    load: Load,
    cycles: FloatArray,
    rtol: float,
    start: float = 0.0,
    deadline: float = np.inf,
) -> Wear:
    """Wear u_c after whole numbers of cycles (any shape), to relative accuracy `rtol`.

    `start` is the wear (mm) before the first of them. After the `deadline` (`time.monotonic()`)
    nothing is refined any more. Where the accuracy was not reached the estimated error says so.
    """
    cycles = np.asarray(cycles, dtype=float)
    most = float(np.max(cycles, initial=0.0))
    found = counted_stages(model, load, most, rtol, start, deadline)
    wear, error = evaluate_stages(found, cycles)
    return Wear(wear, error, found.cost, tuple(_notices(model, found, wear)))


def _notices(model: Model, found: Stages, wear: FloatArray) -> Iterator[str]:
    """What there is to tell beside the wear (mm)."""
    limit = found.stages[-1].counted.limit
    if np.any(wear >= (1 - 1e-9) * limit):
        yield f"the roughness vanishes near u_c = {limit:.4g} mm: the model ends"
    elif found.arrest is not None and model.ends_at_3_sigma:
        # On springs the pressure vanishes with the distance that is left, and no cycle is the last.
        fades = found.arrest.fades or (model.compliant and found.arrest.cycle > 0)
        yield str(found.arrest._replace(fades=fades))
    elif found.arrest is not None:
        yield f"from cycle {found.arrest.cycle} on a cycle adds less than can be told"


class Cycles(NamedTuple):
    """Whole numbers of cycles after which a wear is first reached, infinite where it is not, and
    the estimated relative error of the count."""

    cycles: FloatArray
    error: FloatArray
    cost: Cost


@np.errstate(all="ignore")
def cycles_until(
    model: Model,
    load: Load,
    wear: FloatArray,
    rtol: float,
    start: float = 0.0,
    most: float = MOST_CYCLES,
    begun_with: float = 0.0,
) -> Cycles:
    """After how many whole cycles from wear `start` (mm) the wear u_c (mm, any shape) is reached,
    up to `most` cycles. What is reached but for the estimated error of the count, that of the start
    included (`begun_with`, mm), counts as reached."""
    wear = np.asarray(wear, dtype=float)
    reach, cost = min(LEAST, most), Cost(0, 0)
    while True:
        found = counted_stages(model, load, reach, rtol, start, begun_with=begun_with)
        cost = cost.plus(*found.cost)
        if reach >= most or found.arrested or np.max(wear, initial=0.0) <= found.last_wear:
            break
        reach = min(reach * 1e3, most)
    count, error = np.full(wear.shape, np.inf), np.zeros(wear.shape)
    for stage in reversed(found.stages):
        after, missed = stage.cycles_until(wear)
        here = after <= most
        count[here] = after[here]
        error[here] = missed[here] / np.maximum(count[here], 1.0)
    return Cycles(count, error, cost)
