"""The count of cycles n(u) of one scene: exact first cycles, then Abel's equation on panels.

The steps: a rough scan of the frozen rate says how far the wear can go; a mesh of phase is chosen;
the first cycles are integrated; the one-cycle increments at the nodes of all panels are found in
one vectorised collocation; Abel's equation turns them into n(u). A finer one-cycle map off the
nodes gives the error estimate and says what to refine. See docs/method.md.
"""

from typing import NamedTuple

import numpy as np

from wear.count import abel
from wear.count.collocation import BoolArray, FloatArray, Mesh, chebyshev_nodes, mesh
from wear.count.cutoff import margin_terms, one_cycle
from wear.count.cycle import (
    ROUNDOFF,
    TINY,
    Cost,
    OneCycle,
    Settings,
    refined,
    settings,
    unresolved,
)
from wear.count.first import Opening, opening
from wear.count.scan import halves, roughness_limit, roughness_scale, scan
from wear.faults import UsageError
from wear.load import Load
from wear.model import Model

CHECKS = np.array([-0.99, -0.2, 0.9])  # positions off the nodes of a panel
MOST_ROUNDS = 12  # of refinement
MOST_PANELS = 200
MOST_EVALUATIONS = 20_000_000  # then no finer mesh is tried: the estimate tells what is missed
NO_DIGIT = 0.1  # relative error
SAFETY = 3.0  # on measured discrepancies
NONE: FloatArray = np.empty(0)


class CycleCount(NamedTuple):
    """u(N) for every N of a range, with its inverse and its error.

    `first` mm is the wear after 0, 1, ... whole cycles, integrated exactly, `first_error` (mm) its
    estimated error; `table` holds n(u) beyond, `count_error` its estimated error in cycles where
    each part starts and where the last one ends. Without a table the wear stays as it is.
    """

    first: FloatArray
    first_error: FloatArray
    table: abel.Count | None
    panels: abel.Panels | None
    count_error: FloatArray
    over: Mesh  # of phase, on which all this was found
    limit: float  # mm: wear beyond has no meaning
    cost: Cost

    @property
    def last_wear(self) -> float:
        """The wear (mm) up to which it counts."""
        return float(self.first[-1]) if self.table is None else self.table.last_wear

    @property
    def pace(self) -> float:
        """The wear (mm) that its first cycle adds."""
        return float(np.sum(np.diff(self.first[:2])))


class Maps(NamedTuple):
    """The one-cycle map twice: `coarse` gives the result, `fine` judges it."""

    coarse: OneCycle
    fine: OneCycle


class Solved(NamedTuple):
    """Panels between wear `starts` and `ends` (mm) with Abel's equation solved on them: `series`
    (panels, m) and the greatest `residual` (panels,) off the nodes."""

    starts: FloatArray
    ends: FloatArray
    series: FloatArray
    residual: FloatArray

    def where(self, chosen: BoolArray) -> "Solved":
        """Some of the panels."""
        return Solved(*(array[chosen] for array in self))

    def joined(self, other: "Solved") -> "Solved":
        """Both, in rising order."""
        both = [np.concatenate(pair) for pair in zip(self, other, strict=True)]
        order = np.argsort(both[0])
        return Solved(*(array[order] for array in both))

    def panels(self, shift: float) -> abel.Panels:
        """The panels with their density."""
        across = abel.widths(shift, self.starts, self.ends)
        return abel.Panels(shift, self.starts, across, self.series)


def solve_panels(
    both: Maps, shift: float, starts: FloatArray, ends: FloatArray, size: Settings
) -> tuple[Solved, BoolArray, Cost]:
    """Solve Abel's equation with the coarse map, and test it off the nodes with the fine one.

    Returns also the intervals of phase (q,) to be refined, should the fault lie there.
    """
    across = abel.widths(shift, starts, ends)
    wear = abel.panel_wear(shift, starts, across, chebyshev_nodes(size.panel_nodes))
    ahead = both.coarse.advance(wear)
    panels = abel.solve(shift, starts, across, ahead.increment)
    check = abel.panel_wear(shift, starts, across, CHECKS)
    fine = both.fine.advance(check)
    residual = np.max(np.abs(abel.residual(panels, CHECKS, fine.increment)), axis=1)
    cost = Cost(wear.size + check.size, ahead.evaluations + fine.evaluations)
    solved = Solved(starts, ends, panels.series, residual)
    rough = ~ahead.converged
    worst = ~(residual <= size.residual_tolerance)
    if worst.any():
        again = both.coarse.advance(check[worst])
        cost = cost.plus(again.increment.size, again.evaluations)
        apart = np.max(np.abs(again.increment / fine.increment[worst] - 1.0))
        if not apart < size.residual_tolerance / 4:
            rates = again.rate.reshape(-1, *again.rate.shape[-2:])
            rough |= unresolved(rates, both.coarse.over, size.phase_tolerance)
            rough |= ~rough.any()
    return solved, rough, cost


class Filled(NamedTuple):
    """Panels with Abel's equation solved, or the intervals `rough` (q,) of phase to refine first;
    `cost` is that of all so far."""

    solved: Solved
    rough: BoolArray
    cost: Cost


def fill(both: Maps, shift: float, edges: FloatArray, size: Settings, cost: Cost) -> Filled:
    """Solve panels between `edges` (mm), and cut those with too large a residual."""
    starts, ends = edges[:-1], edges[1:]
    done = Solved(NONE, NONE, np.empty((0, size.panel_nodes)), NONE)
    for rounds in range(MOST_ROUNDS):
        fresh, rough, spent = solve_panels(both, shift, starts, ends, size)
        cost = cost.plus(*spent)
        worst = ~(fresh.residual <= size.residual_tolerance)
        last = rounds == MOST_ROUNDS - 1 or len(done.starts) + len(starts) > MOST_PANELS
        if rough.any() or last or not worst.any():
            break
        done = done.joined(fresh.where(~worst))
        starts, ends = halves(shift, starts[worst], ends[worst])
    return Filled(done.joined(fresh), rough, cost)


def onward(table: abel.Count, cycles: float, limit: float) -> FloatArray | None:
    """Ends (mm) of one more panel, if the table does not reach `cycles`; `limit` (mm) is the
    greatest wear that has a meaning."""
    missing, end = cycles - table.last_cycles, table.last_wear
    if not (missing > 0 and end < 0.999999 * limit):  # not with what is no number either
        return None
    further = np.clip(1.2 * missing * table.length[-1] / table.gain[-1], 0.1, 1.0)
    offset = table.offset[-1] * np.exp(table.length[-1])
    return np.array([end, min(end + offset * np.expm1(further), limit)])


def build(model: Model, load: Load, cycles: float, rtol: float, start: float = 0.0) -> CycleCount:
    """The count of cycles from wear `start` (mm), up to `cycles` at least.

    Raises
    ------
    UsageError
        for a model with cutoff, whose map has kinks: see `wear.count.stages`.
    """
    if model.cutoff:
        raise UsageError("only the wear after whole cycles can be counted with a cutoff")
    limit = roughness_limit(model, 1e12 * roughness_scale(model))
    return build_upto(one_cycle(model, load), model, load, cycles, rtol, start, limit)


def build_upto(
    cycle: OneCycle,
    model: Model,
    load: Load,
    cycles: float,
    rtol: float,
    start: float,
    limit: float,
) -> CycleCount:
    """The count from wear `start` up to `cycles`, or up to the wear `limit` (mm)."""
    size = settings(rtol)
    shift = roughness_scale(model)
    reach = scan(cycle, shift, start, cycles, limit)
    samples = reach[:: max(1, len(reach) // 6)]
    cycle = cycle.resolved(samples, size.phase_nodes, size.phase_tolerance)
    cost = Cost(0, 0)
    while True:
        first = opening(cycle, shift, reach, limit, cycles, size)
        over = first.over
        cost = cost.plus(*first.cost)
        if first.edges is None:
            error = exact_error(model, load, first)
            return CycleCount(first.wear, error, None, None, NONE, over, limit, cost)
        both = Maps(cycle.on(over), cycle.on(mesh(over.edges, size.finer_nodes)))
        filled = fill(both, shift, first.edges, size, cost)
        table = abel.count(filled.solved.panels(shift), float(first.cycles))
        while not filled.rough.any() and (edges := onward(table, cycles, limit)) is not None:
            more = fill(both, shift, edges, size, filled.cost)
            filled = more._replace(solved=filled.solved.joined(more.solved))
            table = abel.count(filled.solved.panels(shift), float(first.cycles))
        cost = filled.cost
        spent = len(over.lengths) >= cycle.most_intervals or cost.rhs_evaluations > MOST_EVALUATIONS
        if spent or not filled.rough.any():
            return _judged(model, load, first, filled.solved, shift, limit, cost)
        cycle = cycle.on(refined(over, filled.rough))


def exact_error(model: Model, load: Load, exact: Opening) -> FloatArray:
    """Estimated error (mm) of cycles that were integrated one by one."""
    lost = roundoff(model, load, exact.wear[1:]) * np.diff(exact.wear)
    lost = np.concatenate([[0.0], np.cumsum(lost)])
    return SAFETY * exact.error + lost + ROUNDOFF * exact.wear


def _judged(
    model: Model,
    load: Load,
    first: Opening,
    solved: Solved,
    shift: float,
    limit: float,
    cost: Cost,
) -> CycleCount:
    """The count with its error: of the first cycles, of the density, at junctions, by rounding."""
    panels = solved.panels(shift)
    table = abel.count(panels, float(first.cycles))
    parts = len(table.length) // len(panels.starts)
    missed = np.cumsum(np.repeat(solved.residual, parts) * table.gain)
    at_junctions = np.cumsum(
        np.concatenate([[0.0], abel.junctions(panels.take(slice(-1)), panels.take(slice(1, None)))])
    )
    error = SAFETY * np.concatenate([[0.0], missed + np.repeat(at_junctions, parts)])
    ends = np.append(table.cycles, table.last_cycles)
    error += roundoff(model, load, np.append(table.wear, table.last_wear)) * ends
    first_error = exact_error(model, load, first)
    error += first_error[-1] / abel.first_pace(table)[0]
    return CycleCount(first.wear, first_error, table, panels, error, first.over, limit, cost)


def roundoff(model: Model, load: Load, wear: FloatArray) -> FloatArray:
    """Relative error by rounding of the rate at the peak of the load, and of where contact ends."""
    peak = np.full_like(wear, load.maximum)
    error = roundoff_of(model, peak, wear)
    if model.cutoff and not model.compliant:
        terms = margin_terms(model, wear) + abs(load.maximum)
        error += np.minimum(ROUNDOFF * terms / (np.abs(model.margin(wear, peak)) + TINY), 1e-9)
    return error


def roundoff_of(model: Model, displacement: FloatArray, wear: FloatArray) -> FloatArray:
    """Relative error of the rate by rounding: its condition with respect to the closure's terms."""
    closure = model.fields(wear, displacement).h
    terms = np.abs(closure) + 2 * wear + np.abs(displacement)
    steepness = np.abs(model.slope(wear, displacement)) / (model.rate(wear, displacement) + TINY)
    result: FloatArray = ROUNDOFF * (4 + steepness * terms)
    return result


def evaluate(counted: CycleCount, cycles: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Wear (mm) after `cycles` and its estimated relative error, infinite where out of reach."""
    early = cycles < len(counted.first) if counted.table else np.full(cycles.shape, True)
    index = np.minimum(np.where(early, cycles, 0), len(counted.first) - 1).astype(int)
    wear, error = counted.first[index], counted.first_error[index]
    table = counted.table
    if table is not None and not early.all():
        late = cycles[~early]
        wear[~early], pace = abel.wear_after(table, late, abel.part_of(table.cycles, late))
        ends = np.append(table.cycles, table.last_cycles)
        error[~early] = pace * np.interp(late, ends, counted.count_error)
    error = error / np.where(wear > 0, wear, 1.0)
    # A discretisation that has not a digit right does not tell its error either.
    told = (wear < (1 - 1e-9) * counted.limit) & (error < NO_DIGIT)
    return np.minimum(wear, counted.limit), np.where(told, error, np.inf)


def until(counted: CycleCount, wear: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Whole cycles after which each wear (mm) is first reached, infinite where the count ends
    before, and the estimated error in cycles."""
    count = np.searchsorted(counted.first * (1 + 4 * ROUNDOFF), wear, side="left").astype(float)
    error = np.zeros(wear.shape)
    late = wear > counted.first[-1] * (1 + 4 * ROUNDOFF)
    count[late] = np.inf
    table = counted.table
    within = late & (wear <= counted.last_wear)
    if table is not None and within.any():
        found = abel.cycles_until(table, wear[within])
        ends = np.append(table.cycles, table.last_cycles)
        missed = np.interp(found, ends, counted.count_error)
        # A wear that is reached at the very end of a cycle must not ask for another one.
        count[within] = np.ceil(found - missed)
        error[within] = missed
    return count, error
