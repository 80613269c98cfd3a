"""The count of cycles n(u) of one scene: exact first cycles, then Abel's equation on panels.

The steps: a rough scan of the frozen rate says how far the wear can go; a mesh of phase is chosen;
the first cycles are integrated; the one-cycle increments at the nodes of all panels are found in
one vectorised collocation; Abel's equation turns them into n(u). A finer one-cycle map off the
nodes gives the error estimate and says what to refine. See docs/method.md.
"""

from typing import NamedTuple

import numpy as np

from wear.count import abel, tabulated
from wear.count.cutoff import one_cycle
from wear.count.cycle import Cost, OneCycle, Settings, settings
from wear.count.first import Opening, fresh, opening
from wear.count.panels import NONE, SAFETY, Maps, Solved, fill
from wear.count.request import Request
from wear.count.rounding import roundoff, roundoff_of_cycles
from wear.count.scan import SHIFT, roughness_limit, roughness_scale, scan
from wear.faults import UsageError
from wear.load import Load
from wear.model import Model
from wear.numerics.collocation import (
    refined,
)
from wear.numerics.gauss import (
    FloatArray,
    Mesh,
    mesh,
)
from wear.numerics.tolerances import (
    ROUNDOFF,
    TINY,
)

MOST_EVALUATIONS = 20_000_000  # then no finer mesh is tried: the estimate tells what is missed
NEARLY = 10.0  # times the residual that is asked for
NO_DIGIT = 0.1  # relative error


class CycleCount(NamedTuple):
    """u(N) for every N of a range, with its inverse and its error.

    `first` mm is the wear after 0, 1, ... whole cycles, integrated exactly, `first_error` (mm) its
    estimated error; `table` holds n(u) beyond, `count_error` its estimated error in cycles where
    each part starts and where the last one ends. Without a table the wear stays as it is.
    """

    first: FloatArray
    first_error: FloatArray
    table: tabulated.Count | None
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
    def rests(self) -> bool:
        """Whether its last cycle adds nothing, and so no cycle after it."""
        return self.table is None and not np.sum(np.diff(self.first[-2:])) > 0

    @property
    def reach(self) -> float:
        """How many cycles it counts."""
        if self.rests:
            return np.inf
        return len(self.first) - 1.0 if self.table is None else self.table.last_cycles

    @property
    def pace(self) -> float:
        """The wear (mm) that its first cycle adds."""
        if len(self.first) == 1 and self.table is not None:
            return float(tabulated.first_pace(self.table)[0])
        return float(np.sum(np.diff(self.first[:2])))


def cycle_count(
    model: Model,
    load: Load,
    cycles: float,
    rtol: float,
    start: float = 0.0,
    begun_with: float = 0.0,
    deadline: float = np.inf,
) -> CycleCount:
    """The count of cycles from wear `start` (mm), known up to an error `begun_with` (mm), up to
    `cycles`, or as far as panels go. After the `deadline` (`time.monotonic()`) nothing is refined
    any more: the estimated error tells what is missed.

    Raises
    ------
    UsageError
        for a model with cutoff, whose map has kinks: see `wear.count.stages`.
    """
    if model.ends_at_3_sigma:
        raise UsageError("only the wear after whole cycles can be counted with a cutoff")
    limit = roughness_limit(model, 1e12 * roughness_scale(model))
    cycle = one_cycle(model, load)
    return cycle_count_upto(cycle, model, load, cycles, rtol, start, limit, begun_with, deadline)


def cycle_count_upto(
    cycle: OneCycle,
    model: Model,
    load: Load,
    cycles: float,
    rtol: float,
    start: float,
    limit: float,
    begun_with: float = 0.0,
    deadline: float = np.inf,
) -> CycleCount:
    """The count from wear `start` up to `cycles`, or up to the wear `limit` (mm)."""
    request = Request(cycles, rtol, start, limit, deadline)
    scale = roughness_scale(model)
    shift = SHIFT * scale
    reach = scan(cycle, scale, start, cycles, limit)
    samples = reach[:: max(1, len(reach) // 6)]
    size = attainable(settings(rtol), model, load, samples)
    cycle = cycle.resolved(samples, size)
    first = opening(fresh(cycle, start), cycle, shift, reach, request, size)
    over, before = cycle.over, np.inf
    while first.edges is not None:
        both = Maps(cycle.on(over), cycle.on(mesh(over.edges, size.finer_nodes)))
        filled = fill(both, shift, first.edges, size, first.cost)
        first = first._replace(cost=filled.cost)
        worst = float(np.max(filled.solved.residual, initial=0.0))
        good = worst <= size.residual_tolerance and not filled.rough.any()
        # What rounding leaves no refinement cures.
        stalled = before <= NEARLY * size.residual_tolerance and not worst < before / 2
        full = len(over.lengths) >= cycle.most_intervals
        full |= first.cost.rhs_evaluations > MOST_EVALUATIONS
        if good or stalled or full or request.late:
            break
        before = worst
        if filled.rough.any():
            over = refined(over, filled.rough)
        else:  # panels that can be cut no more: too few cycles lie behind them
            first = opening(first, cycle, shift, reach, request, size)
    error = exact_error(model, load, first, begun_with)
    if first.edges is None:
        return CycleCount(first.wear, error, None, None, NONE, first.over, limit, first.cost)
    table, count_error = judged(model, load, first, error[-1], filled.solved, shift)
    panels = filled.solved.panels(shift)
    return CycleCount(first.wear, error, table, panels, count_error, over, limit, first.cost)


def attainable(size: Settings, model: Model, load: Load, wear: FloatArray) -> Settings:
    """The settings, with no residual asked for that rounding alone exceeds at one of the wears."""
    floor = float(np.max(roundoff(model, load, wear)))
    return size._replace(residual_tolerance=max(size.residual_tolerance, floor))


def exact_error(model: Model, load: Load, exact: Opening, begun_with: float = 0.0) -> FloatArray:
    """Estimated error (mm) of cycles that were integrated one by one: what each has missed, by its
    mesh and by rounding, as the cycles after it change it."""
    lost = roundoff_of_cycles(model, load, exact.wear) * exact.each.response
    error = [begun_with]
    for missed, growth in zip(SAFETY * exact.each.missed + lost, exact.each.growth, strict=True):
        error.append(error[-1] * growth + missed)
    return np.array(error) + ROUNDOFF * exact.wear


def judged(
    model: Model, load: Load, first: Opening, begun_with: float, solved: Solved, shift: float
) -> tuple[tabulated.Count, FloatArray]:
    """The count on panels and its error (cycles) where each part starts and where the last ends:
    of the wear (mm) it begins with, of the density, at junctions, by rounding."""
    panels = solved.panels(shift)
    table = tabulated.count(panels, float(first.cycles))
    parts = len(table.length) // len(panels.starts)
    missed = SAFETY * np.repeat(solved.residual, parts) * table.gain + table.missed
    if len(panels.starts) > 1:
        at_junctions = abel.junctions(panels.take(slice(-1)), panels.take(slice(1, None)))
        # They shift the count at once, and so belong to what was missed before them.
        missed[parts - 1 : -1 : parts] += SAFETY * at_junctions
    rounding = roundoff(model, load, np.append(table.wear, table.last_wear))
    terms = np.sum(np.abs(solved.series), axis=1)  # of the logarithm of the density
    of_density = ROUNDOFF * np.repeat(terms, parts)
    missed += (np.maximum(rounding[1:], rounding[:-1]) + of_density) * table.gain
    begun = begun_with / tabulated.first_pace(table)[0]
    return table, begun + np.concatenate([[0.0], np.cumsum(missed)])


def evaluate(counted: CycleCount, cycles: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Wear (mm) after `cycles` and its estimated relative error, infinite where out of reach."""
    early = cycles < len(counted.first) if counted.table else np.full(cycles.shape, True)
    index = np.minimum(np.where(early, cycles, 0), len(counted.first) - 1).astype(int)
    wear, error = counted.first[index], counted.first_error[index]
    table = counted.table
    if table is not None and not early.all():
        late = cycles[~early]
        wear[~early], pace = tabulated.wear_after(table, late)
        ends = np.append(table.cycles, table.last_cycles)
        error[~early] = pace * np.interp(late, ends, counted.count_error)
    error = error / np.where(wear > 0, wear, 1.0)
    # A discretisation that has not a digit right does not tell its error either.
    told = (wear < (1 - 1e-9) * counted.limit) & (error < NO_DIGIT) & (cycles <= counted.reach)
    return np.minimum(wear, counted.limit), np.where(told, error, np.inf)


def until(counted: CycleCount, wear: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Whole cycles after which each wear (mm) is first reached, infinite where the count ends
    before, and the estimated error in cycles."""
    # A wear that is reached at the very end of a cycle must not ask for another one.
    told = counted.first_error <= NO_DIGIT * counted.first
    exact = counted.first + np.where(told, counted.first_error, 0.0)
    index = np.searchsorted(exact, wear, side="left")
    late = index == len(exact)
    count = np.where(late, np.inf, index)
    # From the least count to the largest, at the pace of the cycle after: that of wear slows down.
    pace = np.diff(counted.first) if len(counted.first) > 1 else np.array([counted.pace])
    after, before = np.append(pace, pace[-1]), np.append(pace[0], pace)
    after = np.where(after > 0, after, before)[: len(counted.first)]
    blur = np.where(told, 2 * counted.first_error / (after + TINY), np.inf)
    error = np.append(blur, 0.0)[index]
    table = counted.table
    within = late & (wear <= counted.last_wear)
    if table is not None and within.any():
        found = tabulated.cycles_until(table, wear[within])
        ends = np.append(table.cycles, table.last_cycles)
        missed = np.interp(found, ends, counted.count_error)
        count[within] = np.ceil(found - missed)
        error[within] = 2 * missed
    return count, error
