"""The cycle count in stages: with a cutoff between the wears at which contact grazes.

Where the edge of contact passes a turning point of the load, or the phase at which cycles begin,
the one-cycle map has a kink, and where it passes the highest point wear ends. No panel may hold a
kink: panels end shortly before it, a few exact cycles lead across, and the count begins anew. A
stage counts from its own start.
"""

import numpy as np

from wear.count.approach import count_between_kinks
from wear.count.cutoff import cutoff_cycle
from wear.count.stage import Stages
from wear.load import Load
from wear.model import Model


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
    return count_between_kinks(cutoff_cycle(model, load), cycles, rtol, start, deadline, begun_with)
