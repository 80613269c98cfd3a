"""The first cycles, integrated one by one: until panels are long against a cycle."""

from typing import NamedTuple

import numpy as np

from wear.count.cutoff import CutoffCycle
from wear.count.cycle import Cost, Drive, OneCycle, Settings
from wear.count.march import march, overlooked, overlooked_wear
from wear.count.request import Request
from wear.count.scan import SHIFT, plan_panels, scan
from wear.numerics.collocation import (
    refined,
    unresolved,
)
from wear.numerics.gauss import (
    FloatArray,
    Mesh,
    mesh,
)
from wear.numerics.tolerances import (
    TINY,
)

BLOCK = 5  # cycles integrated at once
MOST_FIRST = 120
MOST_EXACT = 1000
NONE: FloatArray = np.empty(0)


class Each(NamedTuple):
    """What each of some cycles did, (k,): the wear `added` (mm), what was `missed` of it (mm,
    estimated), the factor `growth` by which a small difference in wear changes, and the `response`
    (mm) to a relative error of the rate, at most."""

    added: FloatArray
    missed: FloatArray
    growth: FloatArray
    response: FloatArray


class Opening(NamedTuple):
    """The first cycles: `wear` (k + 1,) mm after 0, 1, ... k of them; what each did; the mesh that
    resolves them; and the ends of the panels to come (mm), if any are needed."""

    wear: FloatArray
    each: Each
    over: Mesh
    edges: FloatArray | None
    cost: Cost

    @property
    def cycles(self) -> int:
        """How many cycles were integrated."""
        return len(self.each.added)

    @property
    def pace(self) -> float:
        """The wear (mm) that the last of them adds."""
        return float(self.each.added[-1])

    def then(self, more: Each, over: Mesh, cost: Cost) -> "Opening":
        """Some cycles more; `cost` is that of all."""
        wear = np.append(self.wear, self.wear[-1] + np.cumsum(more.added))
        each = Each(*(np.append(*both) for both in zip(self.each, more, strict=True)))
        return Opening(wear, each, over, None, cost)


def fresh(cycle: OneCycle, start: float) -> Opening:
    """No cycle yet."""
    return Opening(np.array([start]), Each(NONE, NONE, NONE, NONE), cycle.over, None, Cost(0, 0))


def opening(
    begun: Opening,
    cycle: OneCycle,
    shift: float,
    reach: FloatArray,
    request: Request,
    size: Settings,
) -> Opening:
    """Integrate first cycles on from those `begun`, twice as many at least, until the cycles
    requested or until panels towards `reach[-1]` (mm) span as many cycles as they have coefficients
    each: then n on a panel cannot hide an oscillation. A cycle that adds nothing ends it too,
    nothing will change any more; and wear beyond the limit, which has no meaning. Without panels it
    may end early. None is integrated where panels may begin at once."""
    exact, end = begun, float(reach[-1])
    if begun.cycles == 0 and begun.edges is None and request.cycles > BLOCK:
        edges = _at_once(cycle, shift, float(begun.wear[-1]), end, size)
        if edges is not None:
            return exact._replace(edges=edges)
    while True:
        before = exact.cycles
        exact = more_cycles(cycle, exact, request.limit, size)
        last, pace = float(exact.wear[-1]), exact.pace
        if exact.cycles >= request.cycles or last >= request.limit or not pace > 0:
            return exact._replace(edges=None)
        if last + 10 * BLOCK * pace > end:  # wear has outrun the scan
            cycles = request.cycles - exact.cycles
            end = float(scan(cycle, shift / SHIFT, last, cycles, request.limit)[-1])
        edges, counts = plan_panels(cycle, shift, last, end, size.panel_nodes, size.tail_tolerance)
        long = counts >= size.panel_nodes
        usable = len(long) if long.all() else int(np.argmin(long))
        left = MOST_FIRST - exact.cycles
        calm = exact.cycles - before == BLOCK
        # Where wear gathers pace panels become short again, perhaps far ahead.
        enough = exact.cycles >= 2 * begun.cycles
        if enough and calm and (long.all() or np.sum(counts[:usable]) > left):
            return exact._replace(edges=edges[: usable + 1])
        if left <= 0 or request.late:
            return exact._replace(edges=None)


def _at_once(
    cycle: OneCycle, shift: float, start: float, end: float, size: Settings
) -> FloatArray | None:
    """The ends of panels (mm) from the `start`, if each spans as many cycles as it has coefficients
    and the first cycle is a small part of the way: then no node can overlook what wear does."""
    if not isinstance(cycle, Drive) or not TINY < cycle.frozen(np.array(start)) < shift / SHIFT:
        return None
    edges, counts = plan_panels(cycle, shift, start, end, size.panel_nodes, size.tail_tolerance)
    return edges if np.all(counts >= size.panel_nodes) else None


def exact_cycles(
    cycle: OneCycle, start: float, limit: float, cycles: float, size: Settings
) -> Opening:
    """Integrate cycle after cycle from wear `start` (mm) until `cycles`, until the wear passes
    `limit` (mm), or until a cycle adds nothing."""
    exact = fresh(cycle, start)
    while exact.cycles < min(cycles, MOST_EXACT) and exact.wear[-1] <= limit:
        exact = more_cycles(cycle, exact, np.inf, size)
        if not exact.pace > 0:
            break
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
        starts = np.append(start, wear[:-1])
        sound = run.converged.all() and wear[-1] < limit
        if isinstance(at, Drive) and not sound:
            return _one_cycle(at, exact, limit, size, evaluations)
        full = len(over.lengths) >= cycle.most_intervals
        rough = unresolved(run.rate, over, size.phase_tolerance) | ~run.converged
        if isinstance(at, Drive):
            rough |= overlooked(at, start, run, size.strict_tolerance)
        if full or not rough.any():
            finer = at.on(mesh(over.edges, size.finer_nodes))
            judged = finer.advance(starts, run.guess(size.finer_nodes))
            evaluations += judged.evaluations
            missed = np.abs(judged.increment - run.increment)
            if isinstance(finer, Drive):  # what both meshes miss
                missed += overlooked_wear(finer, start, judged)
            if not (sound and judged.converged.all()):
                missed[:] = np.inf
            if full or not np.any(missed > size.residual_tolerance * wear):
                break
            rough[:] = True
        over = refined(over, rough)
    growth = np.ones(BLOCK)
    if isinstance(at, CutoffCycle):
        growth = at.growth(starts)
    elif isinstance(at, Drive):
        growth = at.growth(starts[:, None, None] + run.inside)
    response = run.increment * np.maximum(growth, 1.0)
    if isinstance(at, CutoffCycle):
        response = at.response(run.increment, growth)
    cost = exact.cost.plus(2 * BLOCK, evaluations)
    return exact.then(Each(run.increment, missed, growth, response), over, cost)


def _one_cycle(
    cycle: Drive, exact: Opening, limit: float, size: Settings, evaluations: int
) -> Opening:
    """One more cycle, interval by interval, after so many right-hand sides of another try."""
    one = march(cycle, float(exact.wear[-1]), limit, size)
    cost = exact.cost.plus(BLOCK + 1, evaluations + one.evaluations)
    return exact.then(Each(*np.array(one[:4])[:, None]), exact.over, cost)
