"""The cycle count in stages: with a cutoff between the wears at which contact grazes.

Where the edge of contact passes a turning point of the load, or the phase at which cycles begin,
the one-cycle map has a kink, and where it passes the highest point wear ends. No panel may hold a
kink: panels end shortly before it, a few exact cycles lead across, and the count begins anew. A
stage counts from its own start.
"""

import time

import numpy as np

from wear.count.approach import count_between_kinks
from wear.count.build import cycle_count, evaluate
from wear.count.cutoff import CutoffCycle, one_cycle
from wear.count.cycle import Cost
from wear.count.stage import Stage, Stages
from wear.load import Load
from wear.model import Model

MOST_STAGES = 40
TIGHT = 1e-12


@np.errstate(all="ignore")
def counted_stages(
    model: Model,
    load: Load,
    cycles: float,
    rtol: float,
    start: float,
    deadline: float = np.inf,
    begun_with: float = 0.0,
) -> Stages:
    """Count from the wear `start` (mm), known up to `begun_with`, up to `cycles`, or until wear
    ends.

    After the `deadline` (`time.monotonic()`) no other stage is begun.
    """
    cycle = one_cycle(model, load)
    if not isinstance(cycle, CutoffCycle):
        return _smooth_stages(model, load, cycles, rtol, start, deadline, begun_with)
    return count_between_kinks(cycle, cycles, rtol, start, deadline, begun_with)


def _smooth_stages(
    model: Model,
    load: Load,
    cycles: float,
    rtol: float,
    start: float,
    deadline: float,
    begun_with: float,
) -> Stages:
    """Stages without a cutoff: one does, unless wear gathers pace so much that a panel would hold
    too few cycles; these are integrated, and the count begins anew."""
    done: list[Stage] = []
    begins, wear, missed, cost = 0.0, start, begun_with, Cost(0, 0)
    while True:
        counted = cycle_count(model, load, cycles - begins, rtol, wear, missed, deadline)
        done.append(Stage(begins, counted, 0.0))
        cost = cost.plus(*counted.cost)
        ran = done[-1].ran
        ends = counted.rests or not counted.last_wear < (1 - 1e-9) * counted.limit
        if (
            ends
            or begins + ran >= cycles
            or len(done) == MOST_STAGES
            or time.monotonic() > deadline
        ):
            return Stages(tuple(done), counted.rests, np.inf, cost)
        after, relative = evaluate(counted, np.array([ran]))
        begins, wear = begins + ran, float(after[0])
        missed = float(relative[0]) * wear
        if not missed < np.inf and rtol > TIGHT:
            # Where wear takes off, a small error of the count is a large one of the wear.
            again = _smooth_stages(model, load, cycles, TIGHT, start, deadline, begun_with)
            return again._replace(cost=again.cost.plus(*cost))
        if not missed < np.inf:
            return Stages(tuple(done), False, np.inf, cost)
