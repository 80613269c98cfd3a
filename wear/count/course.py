"""What a cycle adds up to given phases, as a function of the wear at its start.

It depends on that wear alone, and smoothly: it is found once at the nodes of the panels of the
cycle count and interpolated to the cycles wanted. No cycle between is integrated.
"""

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from wear.count import abel, tabulated
from wear.count.build import CycleCount
from wear.count.checks import CHECKS
from wear.count.cycle import (
    MOST_INTERVALS,
    Drive,
    Settings,
    drive,
    first_edges,
    settings,
)
from wear.count.march import march
from wear.count.panels import NONE, SAFETY
from wear.count.rounding import roundoff
from wear.count.scan import SHIFT, halves, roughness_scale
from wear.load import Load
from wear.model import Model
from wear.numerics.chebyshev import (
    chebyshev_analysis,
    chebyshev_nodes,
    chebyshev_values,
)
from wear.numerics.collocation import (
    CycleSolution,
    refined,
)
from wear.numerics.gauss import (
    BoolArray,
    FloatArray,
    Mesh,
    integral,
    mesh,
)
from wear.numerics.tolerances import (
    ROUNDOFF,
    TINY,
)

MOST_ROUNDS = 6  # of cutting panels


class Added(NamedTuple):
    """What cycles add up to the phases (n, m), in mm, what that may have `missed` (n,), in mm; and
    with a compliant support the `pressure` (n, m) in MPa and by how much, relatively, that may be
    `off` (n,)."""

    wear: FloatArray
    missed: FloatArray
    pressure: FloatArray | None
    off: FloatArray


class Panels(NamedTuple):
    """What cycles add that start between the wears `starts` and `ends` (panels,), mm: Chebyshev
    coefficients `series` (panels, m, columns) at their positions, what these may have `missed`
    (panels,), mm, and by how much the pressure may be `off` (panels,).

    There is a column for the wear (mm) at each phase, and with a compliant support another for the
    logarithm of the pressure (MPa) there.
    """

    starts: FloatArray
    ends: FloatArray
    series: FloatArray
    missed: FloatArray
    off: FloatArray

    def where(self, chosen: BoolArray) -> "Panels":
        """Some of the panels."""
        return Panels(*(array[chosen] for array in self))

    def joined(self, other: "Panels") -> "Panels":
        """Both, in rising order."""
        both = [np.concatenate(pair) for pair in zip(self, other, strict=True)]
        order = np.argsort(both[0])
        return Panels(*(array[order] for array in both))


class Course(NamedTuple):
    """How wear grows within a cycle up to some phases, ready for interpolation.

    `first` (k, columns) is what has been added in each of the first cycles and `first_missed` (k,)
    mm its estimated error; the `panels` tell what later ones add.
    """

    first: FloatArray
    first_missed: FloatArray
    shift: float
    panels: Panels
    compliant: bool

    def added(self, cycles: FloatArray, starts: FloatArray) -> Added:
        """What each of `cycles` (n,) adds, counted from the first; `starts` (n,) is the wear
        before, mm."""
        columns = np.zeros((len(cycles), self.first.shape[1]))
        missed, off = np.zeros((2, len(cycles)))
        early = cycles < len(self.first)
        index = cycles[early].astype(int)
        columns[early] = self.first[index]
        missed[early] = self.first_missed[index]
        panels = self.panels
        if len(panels.starts):  # else no cycle adds anything any more
            across = abel.widths(self.shift, panels.starts, panels.ends)
            panel = np.where(early, -1, tabulated.part_of(panels.starts, starts))
            for p in np.unique(panel[~early]):
                chosen = panel == p
                t = abel.positions(self.shift, panels.starts[p], across[p], starts[chosen])
                basis = chebyshev_values(t, panels.series.shape[1])
                columns[chosen] = basis @ panels.series[p]
                missed[chosen], off[chosen] = panels.missed[p], panels.off[p]
        if not self.compliant:
            return Added(columns, missed, None, off)
        wear, logarithm = np.split(columns, 2, axis=1)
        return Added(wear, missed, np.exp(logarithm), off)


@np.errstate(all="ignore")  # of trial states far off; what is no number fails the estimate of error
def course(
    model: Model, load: Load, counted: CycleCount, phases: FloatArray, rtol: float
) -> Course:
    """Prepare for the cycles that are `counted` and for `phases` (m,) in [0, 1]."""
    size, shift = settings(rtol), SHIFT * roughness_scale(model)
    # The first cycle is not interpolated even if panels begin with it.
    first = counted.first[: max(1, len(counted.first) - 1)] if counted.table else counted.first
    cycle = drive(model, load, mesh(counted.over.edges, size.finer_nodes))
    cycle, added = _resolved(cycle, first, np.append(phases, 1.0), rtol)
    added, whole = added[:, :-1], added[:, -1]
    missed = np.max(np.abs(_judged(cycle, first, phases, size) - added), axis=1)
    known = np.diff(counted.first)[: len(first)]  # two meshes that agree may both be wrong
    missed[: len(known)] = np.maximum(missed[: len(known)], np.abs(whole[: len(known)] - known))
    # Violent wear; beyond the limit, where the roughness is negative, there is another solution.
    sound = (first + whole < counted.limit) & (SAFETY * missed <= rtol * (first + whole))
    for i in np.flatnonzero(~sound):
        added[i], missed[i] = _marched(model, load, float(first[i]), counted.limit, phases, size)
    missed += roundoff(model, load, first) * np.max(added, axis=1, initial=0.0)
    columns = _with_pressure(model, first, added, load(phases))
    panels = _panels(cycle, counted, shift, phases, rtol)
    return Course(columns, missed, shift, panels, model.compliant)


def _panels(
    cycle: Drive, counted: CycleCount, shift: float, phases: FloatArray, rtol: float
) -> Panels:
    """The panels of the count, cut in two where a phase needs it: there what a cycle adds depends
    on the wear more sharply than at its end."""
    size, known, number = settings(rtol), counted.panels, len(phases)
    columns = number * (2 if cycle.model.compliant else 1)
    done = Panels(NONE, NONE, np.empty((0, size.panel_nodes, columns)), NONE, NONE)
    if known is None:
        return done
    displacement = cycle.load(phases)
    starts = known.starts
    ends = starts + (starts + shift) * np.expm1(known.widths)
    for rounds in range(MOST_ROUNDS):
        across = abel.widths(shift, starts, ends)
        nodes = abel.panel_wear(shift, starts, across, chebyshev_nodes(size.panel_nodes))
        checks = abel.panel_wear(shift, starts, across, CHECKS)
        cycle, added = _resolved(cycle, nodes.ravel(), phases, rtol)
        added = _with_pressure(cycle.model, nodes.ravel(), added, displacement)
        series = chebyshev_analysis(size.panel_nodes) @ added.reshape(*nodes.shape, columns)
        judged = _judged(cycle, checks.ravel(), phases, size)
        judged = _with_pressure(cycle.model, checks.ravel(), judged, displacement)
        interpolated = chebyshev_values(CHECKS, size.panel_nodes) @ series
        apart = np.max(np.abs(judged.reshape(*checks.shape, -1) - interpolated), axis=1)
        missed = np.max(apart[:, :number], axis=1)
        off = SAFETY * np.max(apart[:, number:], axis=1, initial=0.0)
        fresh = Panels(starts, ends, series, missed, off)
        # No cycle ends with less wear than the first adds.
        rough = ~(SAFETY * missed <= rtol / 4 * np.maximum(starts, counted.pace))
        if not rough.any() or rounds == MOST_ROUNDS - 1:
            break
        done = done.joined(fresh.where(~rough))
        starts, ends = halves(shift, starts[rough], ends[rough])
    return done.joined(fresh)


def _marched(
    model: Model, load: Load, start: float, limit: float, phases: FloatArray, size: Settings
) -> tuple[FloatArray, float]:
    """Wear (mm) added up to each phase (m,) by one cycle from the wear `start`, taken interval by
    interval, and what that may have missed (mm)."""
    edges, added, missed, wrong = first_edges(load), [0.0], 0.0, 0.0
    marks = np.unique(np.concatenate([[0.0], phases]))
    for begin, end in pairwise(marks.tolist()):
        inner = edges[(edges > begin) & (edges < end)]
        over = mesh(np.concatenate([[begin], inner, [end]]), size.phase_nodes)
        part = march(drive(model, load, over), start + added[-1], limit, size)
        added.append(added[-1] + part.added)
        missed = missed * part.growth + part.missed
        wrong = max(wrong, missed)
    return np.array(added)[np.searchsorted(marks, phases)], wrong


def _with_pressure(
    model: Model, starts: FloatArray, added: FloatArray, displacement: FloatArray
) -> FloatArray:
    """The columns of a course, from the wear added (starts, phases)."""
    if not model.compliant:
        return added
    pressure = model.pressure(starts[:, None] + added, displacement)
    return np.concatenate([added, np.log(pressure + TINY)], axis=1)


def _resolved(
    cycle: Drive, starts: FloatArray, phases: FloatArray, rtol: float
) -> tuple[Drive, FloatArray]:
    """Wear added up to each phase, shape (starts, phases), no number where that is not found; and
    the mesh that resolves the rate at every phase: first as if the rate did not feel the wear of
    the cycle, which costs least, then as it is."""
    tolerance = max(rtol, ROUNDOFF)
    rough = _unresolved(cycle.rate(starts[:, None, None]), cycle.over, tolerance)
    while rough.any() and len(cycle.over.lengths) < MOST_INTERVALS:
        cycle = cycle.on(refined(cycle.over, rough))
        rough = _unresolved(cycle.rate(starts[:, None, None]), cycle.over, tolerance)
    while True:
        run = cycle.advance(starts)
        rough = _unresolved(run.rate, cycle.over, tolerance) | ~run.converged
        if not rough.any() or len(cycle.over.lengths) >= MOST_INTERVALS:
            lost = 0.0 if run.converged.all() else np.nan
            return cycle, _at_phases(run, cycle.over, phases) + lost
        cycle = cycle.on(refined(cycle.over, rough))


def _unresolved(rate: FloatArray, over: Mesh, tolerance: float) -> BoolArray:
    """Which intervals (q,) hold a rate (k, q, m) whose running integral is not resolved.

    Unlike its integral over the interval, that is no better than its interpolant.
    """
    series = np.abs(rate @ over.rule.coefficients.T)
    tail, largest = np.max(series[..., -3:], axis=-1), np.max(series, axis=-1)
    left = tail * over.lengths > tolerance * integral(rate, over)[:, None]
    rough: BoolArray = np.any(left & (tail > 100 * ROUNDOFF * largest), axis=0)
    return rough


def _judged(cycle: Drive, starts: FloatArray, phases: FloatArray, size: Settings) -> FloatArray:
    """Wear added up to each phase, shape (starts, phases), by a second discretisation."""
    again = cycle.on(mesh(cycle.over.edges, 2 * size.finer_nodes - size.phase_nodes))
    return _at_phases(again.advance(starts), again.over, phases)


def _at_phases(run: CycleSolution, over: Mesh, phases: FloatArray) -> FloatArray:
    """Wear added up to each phase, shape (starts, phases)."""
    interval = np.clip(
        np.searchsorted(over.edges, phases, side="right") - 1, 0, len(over.lengths) - 1
    )
    x = (phases - over.edges[interval]) / over.lengths[interval]
    # The rate's Legendre series, integrated from the start of the interval.
    series = (run.rate @ over.rule.coefficients.T) * over.lengths[:, None]
    weights = np.polynomial.legendre.legvander(2 * x - 1, series.shape[-1])
    k = np.arange(series.shape[-1])
    below = np.concatenate([-np.ones((len(x), 1)), weights[:, : len(k) - 1]], axis=1)
    primitives = (weights[:, 1:] - below) / (2 * (2 * k + 1))
    within = np.einsum("spk,pk->sp", series[:, interval, :], primitives)
    before = np.cumsum((run.rate @ over.rule.weights) * over.lengths, axis=-1)
    before = np.concatenate([np.zeros((len(before), 1)), before[:, :-1]], axis=1)
    result: FloatArray = before[:, interval] + within
    return result
