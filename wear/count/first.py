"""The first cycles, integrated one by one: until panels are long against a cycle."""

from typing import NamedTuple

import numpy as np

from wear.count.collocation import FloatArray, Mesh, mesh
from wear.count.cycle import Cost, OneCycle, Settings, refined, unresolved
from wear.count.scan import plan_panels

BLOCK = 5  # cycles integrated at once
MOST_FIRST = 120
MOST_EXACT = 1000


class Opening(NamedTuple):
    """`wear` (k + 1,) mm after 0, 1, ... k whole cycles with its estimated `error` (mm); the mesh
    that resolves these cycles; and the ends of the panels to come (mm), if any are needed."""

    wear: FloatArray
    error: FloatArray
    over: Mesh
    edges: FloatArray | None
    cost: Cost

    @property
    def cycles(self) -> int:
        """How many cycles were integrated."""
        return len(self.wear) - 1


def opening(
    cycle: OneCycle, shift: float, reach: FloatArray, limit: float, cycles: float, size: Settings
) -> Opening:
    """Integrate the first cycles from the wear `reach[0]` (mm), until `cycles` or until panels up
    to `reach[-1]` span as many cycles as they have coefficients each: then n on a panel cannot
    hide an oscillation. A cycle that adds nothing ends it too, nothing will change any more; and
    wear beyond `limit` (mm), which has no meaning."""
    exact = Opening(reach[:1], np.zeros(1), cycle.over, None, Cost(0, 0))
    end = reach[-1]
    while True:
        exact, pace = more_cycles(cycle, exact, size)
        last = exact.wear[-1]
        if exact.cycles >= cycles or last >= limit or not pace > 0:
            return exact
        end = max(end, min(limit, last + 10 * BLOCK * pace))
        edges, counts = plan_panels(
            cycle.on(exact.over), shift, last, end, size.panel_nodes, size.tail_tolerance
        )
        if exact.cycles >= MOST_FIRST or np.all(counts >= size.panel_nodes):
            return exact._replace(edges=edges)


def exact_cycles(
    cycle: OneCycle, start: float, limit: float, cycles: float, size: Settings
) -> Opening:
    """Integrate cycle after cycle from wear `start` (mm) until `cycles`, until the wear passes
    `limit` (mm), or until a cycle adds nothing."""
    exact = Opening(np.array([start]), np.zeros(1), cycle.over, None, Cost(0, 0))
    pace = 1.0
    while exact.cycles < min(cycles, MOST_EXACT) and exact.wear[-1] <= limit and pace > 0:
        exact, pace = more_cycles(cycle, exact, size)
    return exact


def more_cycles(cycle: OneCycle, exact: Opening, size: Settings) -> tuple[Opening, float]:
    """BLOCK more cycles, on a mesh refined until it resolves them; the wear added by the last."""
    over, cost = exact.over, exact.cost
    while True:
        run = cycle.on(over).several(float(exact.wear[-1]), BLOCK)
        cost = cost.plus(BLOCK, run.evaluations)
        rough = unresolved(run.rate, over, size.phase_tolerance) | ~run.converged
        if not rough.any() or len(over.lengths) >= cycle.most_intervals:
            break
        over = refined(over, rough)
    wear = np.append(exact.wear, exact.wear[-1] + np.cumsum(run.increment))
    judged = cycle.on(mesh(over.edges, size.finer_nodes)).advance(wear[-BLOCK - 1 : -1])
    apart = np.cumsum(np.abs(judged.increment - run.increment))
    if not run.converged.all():
        apart[:] = np.inf
    error = np.append(exact.error, exact.error[-1] + apart)
    cost = cost.plus(BLOCK, judged.evaluations)
    return Opening(wear, error, over, None, cost), float(run.increment[-1])
