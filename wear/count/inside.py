"""Inside the cycles: the wear and the fields at any phases of any cycles.

What a cycle adds up to a phase depends on the wear at its start alone, and smoothly: it is found
once at the nodes of the panels of the cycle count and interpolated to the cycles wanted. No cycle
between is integrated, and the cost hardly depends on how many are wanted.
"""

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from wear.count import abel
from wear.count.build import CycleCount, cycle_count, evaluate
from wear.count.collocation import (
    BoolArray,
    FloatArray,
    Mesh,
    chebyshev_analysis,
    chebyshev_nodes,
    chebyshev_values,
    integral,
    mesh,
)
from wear.count.cycle import (
    MOST_INTERVALS,
    ROUNDOFF,
    TINY,
    Advance,
    Cost,
    Drive,
    Settings,
    drive,
    refined,
    settings,
)
from wear.count.panels import CHECKS, NONE, SAFETY
from wear.count.scan import halves, roughness_scale
from wear.load import Load
from wear.model import Model

CHUNK = 32_000  # states computed at once: their arrays stay in the processor's cache
MOST_ROUNDS = 6  # of cutting panels
BATCH = 10_000  # cycles of which the wear at the start is found at once


class Inside(NamedTuple):
    """A chunk of a history: whole `cycles` (n,), `phases` (m,) in [0, 1], bearing wear `u` (n, m)
    in mm at (cycles + phases) T, all `fields` (n, m), in mm and MPa, and the estimated `error`
    (n,) of u, relative to the wear at the end of the cycle."""

    cycles: FloatArray
    phases: FloatArray
    u: FloatArray
    fields: Any
    error: FloatArray


class Panels(NamedTuple):
    """What cycles add that start between the wears `starts` and `ends` (panels,), mm: Chebyshev
    coefficients `series` (panels, m, columns) in y = ln(u + shift), and what these may have
    `missed` (panels,), mm."""

    starts: FloatArray
    ends: FloatArray
    series: FloatArray
    missed: FloatArray

    def where(self, chosen: BoolArray) -> "Panels":
        """Some of the panels."""
        return Panels(*(array[chosen] for array in self))

    def joined(self, other: "Panels") -> "Panels":
        """Both, in rising order."""
        both = [np.concatenate(pair) for pair in zip(self, other, strict=True)]
        order = np.argsort(both[0])
        return Panels(*(array[order] for array in both))


class Course(NamedTuple):
    """How wear grows within a cycle up to `phases`, ready for interpolation.

    `first` (k, columns) mm is what has been added in each of the first cycles and `first_missed`
    (k,) mm its estimated error; the `panels` tell what later ones add. There is a column for each
    phase, and with a compliant support another with the logarithm of the pressure (MPa) there, from
    which that is sought.
    """

    counted: CycleCount
    phases: FloatArray
    first: FloatArray
    first_missed: FloatArray
    shift: float
    panels: Panels
    cost: Cost


@np.errstate(all="ignore")  # of trial states far off; what is no number fails the estimate of error
def course(
    model: Model, load: Load, last: float, phases: FloatArray, rtol: float = 1e-12
) -> Course:
    """Prepare for cycles up to `last` and for `phases` (m,) in [0, 1]."""
    counted = cycle_count(model, load, last + 1.0, rtol)
    size, shift = settings(rtol), roughness_scale(model)
    first = counted.first[:-1] if counted.table else counted.first
    cycle = drive(model, load, mesh(counted.over.edges, size.finer_nodes))
    cycle, run = _resolved(cycle, first, max(rtol, ROUNDOFF))
    added = _at_phases(run, cycle.over, phases)
    apart = _judged(cycle, first, phases, size) - added
    rounding = np.diff(counted.first_error, append=counted.first_error[-1])
    missed = np.max(np.abs(apart), axis=1) + rounding[: len(first)]
    added = _with_pressure(model, first, added, load(phases))
    if not run.converged.all():
        missed[:] = np.inf
    cost = counted.cost.plus(2 * len(first), 2 * run.evaluations)
    panels, cost = _panels(cycle, counted, shift, phases, rtol, cost)
    return Course(counted, phases, added, missed, shift, panels, cost)


def _panels(
    cycle: Drive,
    counted: CycleCount,
    shift: float,
    phases: FloatArray,
    rtol: float,
    cost: Cost,
) -> tuple[Panels, Cost]:
    """The panels of the count, cut in two where a phase needs it: there what a cycle adds depends
    on the wear more sharply than at its end."""
    size, known = settings(rtol), counted.panels
    columns = len(phases) * (2 if cycle.model.compliant else 1)
    done = Panels(NONE, NONE, np.empty((0, size.panel_nodes, columns)), NONE)
    if known is None:
        return done, cost
    displacement = cycle.load(phases)
    starts = known.starts
    ends = starts + (starts + shift) * np.expm1(known.widths)
    for rounds in range(MOST_ROUNDS):
        across = abel.widths(shift, starts, ends)
        nodes = abel.panel_wear(shift, starts, across, chebyshev_nodes(size.panel_nodes))
        checks = abel.panel_wear(shift, starts, across, CHECKS)
        cycle, run = _resolved(cycle, nodes.ravel(), max(rtol, ROUNDOFF))
        cost = cost.plus(nodes.size + checks.size, 2 * run.evaluations)
        added = _at_phases(run, cycle.over, phases)
        added = _with_pressure(cycle.model, nodes.ravel(), added, displacement)
        series = chebyshev_analysis(size.panel_nodes) @ added.reshape(*nodes.shape, columns)
        judged = _judged(cycle, checks.ravel(), phases, size).reshape(*checks.shape, -1)
        interpolated = chebyshev_values(CHECKS, size.panel_nodes) @ series
        apart = judged - interpolated[..., : len(phases)]
        missed = np.max(np.abs(apart), axis=(1, 2))
        if not run.converged.all():
            missed[:] = np.inf
        fresh = Panels(starts, ends, series, missed)
        rough = ~(SAFETY * missed <= rtol / 4 * starts)
        if not rough.any() or rounds == MOST_ROUNDS - 1:
            break
        done = done.joined(fresh.where(~rough))
        starts, ends = halves(shift, starts[rough], ends[rough])
    return done.joined(fresh), cost


def _with_pressure(
    model: Model, starts: FloatArray, added: FloatArray, displacement: FloatArray
) -> FloatArray:
    """The columns of a course, from the wear added (starts, phases)."""
    if not model.compliant:
        return added
    pressure = model.pressure(starts[:, None] + added, displacement)
    return np.concatenate([added, np.log(pressure + TINY)], axis=1)


def _resolved(cycle: Drive, starts: FloatArray, tolerance: float) -> tuple[Drive, Advance]:
    """One cycle from each start (k,), on a mesh that resolves the rate at every phase: first as if
    the rate did not feel the wear of the cycle, which costs least, then as it is."""
    rough = _unresolved(cycle.rate(starts[:, None, None]), cycle.over, tolerance)
    while rough.any() and len(cycle.over.lengths) < MOST_INTERVALS:
        cycle = cycle.on(refined(cycle.over, rough))
        rough = _unresolved(cycle.rate(starts[:, None, None]), cycle.over, tolerance)
    while True:
        run = cycle.advance(starts)
        rough = _unresolved(run.rate, cycle.over, tolerance) | ~run.converged
        if not rough.any() or len(cycle.over.lengths) >= MOST_INTERVALS:
            return cycle, run
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


def _at_phases(run: Advance, over: Mesh, phases: FloatArray) -> FloatArray:
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


def _added(
    prepared: Course, cycles: FloatArray, starts: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """The columns (n, columns) of a course for each of `cycles` (n,), and what the interpolation
    may have missed (n,), in mm; `starts` (n,) is the wear before."""
    added = np.zeros((len(cycles), prepared.first.shape[1]))
    missed = np.zeros(len(cycles))
    early = cycles < len(prepared.first)
    index = cycles[early].astype(int)
    added[early] = prepared.first[index]
    missed[early] = prepared.first_missed[index]
    panels, shift = prepared.panels, prepared.shift
    if len(panels.starts) == 0:
        return added, missed  # no cycle adds anything any more
    across = abel.widths(shift, panels.starts, panels.ends)
    panel = np.where(early, -1, abel.part_of(panels.starts, starts))
    for p in np.unique(panel[~early]):
        chosen = panel == p
        y = np.log1p((starts[chosen] - panels.starts[p]) / (panels.starts[p] + shift))
        basis = chebyshev_values(2 * y / across[p] - 1, panels.series.shape[1])
        added[chosen] = basis @ panels.series[p]
        missed[chosen] = panels.missed[p]
    return added, missed


def fields_inside(
    model: Model,
    load: Load,
    cycles: FloatArray,
    phases: FloatArray,
    rtol: float = 1e-12,
    chunk: int = CHUNK,
) -> Iterator[Inside]:
    """The state at every phase of every cycle, some `chunk` states at a time.

    Parameters
    ----------
    cycles
        Whole numbers of cycles (n,) that lie behind, in any order.
    phases
        In [0, 1], (m,).

    Yields
    ------
    Inside
        consecutive rows of the history; memory is bounded by the chunk.
    """
    cycles, phases = np.asarray(cycles, dtype=float), np.asarray(phases, dtype=float)
    prepared = course(model, load, float(np.max(cycles)), phases, rtol)
    yield from states(model, load, prepared, cycles, chunk)


def states(
    model: Model, load: Load, prepared: Course, cycles: FloatArray, chunk: int = CHUNK
) -> Iterator[Inside]:
    """What `fields_inside` yields, of a course that has been prepared."""
    m = len(prepared.phases)
    displacement = load(prepared.phases)
    rows = max(1, chunk // max(1, m))
    for begin in range(0, len(cycles), BATCH):
        batch = cycles[begin : begin + BATCH]
        starts, error = evaluate(prepared.counted, batch)
        for at in range(0, len(batch), rows):
            here = slice(at, at + rows)
            added, missed = _added(prepared, batch[here], starts[here])
            u = starts[here, None] + added[:, :m]
            near = np.exp(added[:, m:]) if model.compliant else None
            fields = model.fields(u, displacement, near)
            wrong = error[here] * starts[here] + SAFETY * missed
            relative = wrong / (np.max(u, axis=1) + TINY)
            yield Inside(batch[here], prepared.phases, u, fields, relative)
