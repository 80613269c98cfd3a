"""The first cycles, integrated one by one: until panels are long against a cycle."""

from typing import NamedTuple

import numpy as np

from wear.count.collocation import FloatArray, Mesh, mesh
from wear.count.cutoff import CutoffCycle
from wear.count.cycle import Cost, Drive, OneCycle, Settings, refined, unresolved
from wear.count.march import growth_of, march, overlooked
from wear.count.request import Request
from wear.count.scan import plan_panels, scan

BLOCK = 5  # cycles integrated at once
MOST_FIRST = 120
MOST_EXACT = 1000
NONE: FloatArray = np.empty(0)


class Opening(NamedTuple):
    """The first cycles: `wear` (k + 1,) mm after 0, 1, ... k of them, the wear `added` by each (k,)
    mm, by how much each has `missed` it (mm, estimated), and the factor `growth` (k,) by which each
    changes a small difference in wear; the mesh that resolves them; and the ends of the panels to
    come (mm), if any are needed."""

    wear: FloatArray
    added: FloatArray
    missed: FloatArray
    growth: FloatArray
    over: Mesh
    edges: FloatArray | None
    cost: Cost

    @property
    def cycles(self) -> int:
        """How many cycles were integrated."""
        return len(self.added)

    def then(
        self, added: FloatArray, missed: FloatArray, growth: FloatArray, over: Mesh, cost: Cost
    ) -> "Opening":
        """Some cycles more; `cost` is that of all."""
        wear = self.wear[-1] + np.cumsum(added)
        return Opening(
            np.append(self.wear, wear),
            np.append(self.added, added),
            np.append(self.missed, missed),
            np.append(self.growth, growth),
            over,
            None,
            cost,
        )


def fresh(cycle: OneCycle, start: float) -> Opening:
    """No cycle yet."""
    return Opening(np.array([start]), NONE, NONE, NONE, cycle.over, None, Cost(0, 0))


def opening(
    cycle: OneCycle, shift: float, reach: FloatArray, request: Request, size: Settings
) -> Opening:
    """Integrate the first cycles from the wear `reach[0]` (mm), until the cycles requested or until
    panels up to `reach[-1]` span as many cycles as they have coefficients each: then n on a panel
    cannot hide an oscillation. A cycle that adds nothing ends it too, nothing will change any
    more; and wear beyond the limit, which has no meaning."""
    exact = fresh(cycle, float(reach[0]))
    end = float(reach[-1])
    while True:
        before = exact.cycles
        exact = more_cycles(cycle, exact, request.limit, size)
        last = float(exact.wear[-1])
        pace = float(exact.added[-1])
        if exact.cycles >= request.cycles or last >= request.limit or not pace > 0:
            return exact
        if last + 10 * BLOCK * pace > end:  # wear has outrun the scan
            cycles = request.cycles - exact.cycles
            end = float(scan(cycle, shift, last, cycles, request.limit)[-1])
        edges, counts = plan_panels(cycle, shift, last, end, size.panel_nodes, size.tail_tolerance)
        calm = exact.cycles - before == BLOCK
        long = calm and np.all(counts >= size.panel_nodes)
        if long or exact.cycles >= MOST_FIRST or request.late:
            return exact._replace(edges=edges)


def exact_cycles(
    cycle: OneCycle, start: float, limit: float, cycles: float, size: Settings
) -> Opening:
    """Integrate cycle after cycle from wear `start` (mm) until `cycles`, until the wear passes
    `limit` (mm), or until a cycle adds nothing."""
    exact = fresh(cycle, start)
    pace = 1.0
    while exact.cycles < min(cycles, MOST_EXACT) and exact.wear[-1] <= limit and pace > 0:
        exact = more_cycles(cycle, exact, np.inf, size)
        pace = float(exact.added[-1])
    return exact


def more_cycles(cycle: OneCycle, exact: Opening, limit: float, size: Settings) -> Opening:
    """BLOCK more cycles, on a mesh refined until it resolves them; or one, if it is violent.

    Beyond the wear `limit` (mm) the rate has no meaning, and what is found there is no solution.
    """
    over, start, evaluations = exact.over, float(exact.wear[-1]), 0
    while True:
        at = cycle.on(over)
        run = at.several(start, BLOCK)
        evaluations += run.evaluations
        wear = start + np.cumsum(run.increment)
        sound = run.converged.all() and wear[-1] < limit
        if isinstance(at, Drive) and not sound:
            return _one_cycle(at, exact, limit, size, evaluations)
        full = len(over.lengths) >= cycle.most_intervals
        rough = unresolved(run.rate, over, size.phase_tolerance) | ~run.converged
        if isinstance(at, Drive):
            rough |= overlooked(at, start, run, size.phase_tolerance)
        if full or not rough.any():
            finer = at.on(mesh(over.edges, size.finer_nodes))
            judged = finer.advance(np.append(start, wear[:-1]))
            evaluations += judged.evaluations
            missed = np.abs(judged.increment - run.increment)
            if not (sound and judged.converged.all()):
                missed[:] = np.inf
            if full or not np.any(missed > size.residual_tolerance * wear):
                break
            rough[:] = True
        over = refined(over, rough)
    growth = np.ones(BLOCK)
    if isinstance(at, CutoffCycle):
        growth = at.growth(np.append(start, wear[:-1]))
    elif isinstance(at, Drive):
        growth = growth_of(at, start, run.inside)
    return exact.then(run.increment, missed, growth, over, exact.cost.plus(2 * BLOCK, evaluations))


def _one_cycle(
    cycle: Drive, exact: Opening, limit: float, size: Settings, evaluations: int
) -> Opening:
    """One more cycle, interval by interval, after so many right-hand sides of another try."""
    one = march(cycle, float(exact.wear[-1]), limit, size)
    cost = exact.cost.plus(BLOCK + 1, evaluations + one.evaluations)
    added, missed, growth = np.array([[one.added], [one.missed], [one.growth]])
    return exact.then(added, missed, growth, exact.over, cost)
