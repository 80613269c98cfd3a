"""Every load as a sequence of periodic loads, each over a range of cycles.

A load made of blocks is periodic in each block. A measured history is taken cycle by cycle, with a
kink at every row, where an integrator stops: `wear.records` takes many rows at once.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from wear.load.blocks import Blocks
from wear.load.periodic import Load
from wear.load.piecewise_linear import HistoryLoad, history_cycle

FOREVER = 1 << 62

Loading = Load | Blocks | HistoryLoad
"""The loads of a scene, periodic or not."""


class LoadSpan(NamedTuple):
    """A load that is periodic up to cycle `until`, and its `place` in the scene file."""

    load: Load
    until: int
    place: str = "load"


def span(load: Loading, cycle: int) -> LoadSpan:
    """Return the load that acts from the start of a cycle (counted from 0), with its last cycle; at
    the end of blocks the last of them."""
    if isinstance(load, HistoryLoad):
        return LoadSpan(history_cycle(load, cycle), cycle + 1)
    if not isinstance(load, Blocks):
        return LoadSpan(load, FOREVER)
    rounds, rest = divmod(min(cycle, load.cycles - 1), load.cycles_of_round)
    ends = np.cumsum([block.cycles for block in load.blocks])
    at = int(np.searchsorted(ends, rest, side="right"))
    until = rounds * load.cycles_of_round + int(ends[at])
    return LoadSpan(load.blocks[at].load, until, f"load.blocks[{at}]")


def most_cycles(load: Loading) -> int:
    """Return the number of whole cycles of the load."""
    return int(load.cycles * (1.0 + 1e-12)) if isinstance(load, Blocks | HistoryLoad) else FOREVER
