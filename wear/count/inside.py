"""Inside the cycles: the wear and the fields at any phases of any cycles.

What a cycle adds up to a phase depends on the wear at its start alone, and smoothly: it is found
once at the nodes of the panels of the cycle count and interpolated to the cycles wanted. No cycle
between is integrated, and the cost hardly depends on how many are wanted.
"""

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from wear.count import abel
from wear.count.build import CycleCount, build, evaluate
from wear.count.collocation import (
    FloatArray,
    Mesh,
    chebyshev_analysis,
    chebyshev_nodes,
    chebyshev_values,
)
from wear.count.cycle import ROUNDOFF, Advance, advance, drive, refined, unresolved
from wear.load import Load
from wear.model import Model

CHUNK = 1_000_000  # states computed at once
FINEST = ROUNDOFF**2  # a running integral needs the rate itself resolved, not its quadrature


class Inside(NamedTuple):
    """A chunk of a history: whole `cycles` (n,), `phases` (m,) in [0, 1], bearing wear `u` (n, m)
    in mm at (cycles + phases) T, and all `fields` (n, m), in mm and MPa."""

    cycles: FloatArray
    phases: FloatArray
    u: FloatArray
    fields: Any


class Course(NamedTuple):
    """How wear grows within a cycle, ready for interpolation.

    `first` (k, phases) mm is what has been added in each of the first cycles; `series` (panels, m,
    phases) holds Chebyshev coefficients in y of what is added in a cycle that starts on a panel.
    """

    counted: CycleCount
    phases: FloatArray
    first: FloatArray
    series: FloatArray


def course(
    model: Model, load: Load, last: float, phases: FloatArray, rtol: float = 1e-12
) -> Course:
    """Prepare for cycles up to `last` and for `phases` (m,) in [0, 1]."""
    counted = build(model, load, last + 1.0, rtol)
    first = counted.first[:-1] if counted.table else counted.first
    panels = counted.panels
    m = 0 if panels is None else panels.series.shape[1]
    nodes = np.empty((0, m))
    if panels is not None:
        nodes = abel.panel_wear(panels.shift, panels.starts, panels.widths, chebyshev_nodes(m))
    run, over = _resolved(model, load, counted.over, np.concatenate([first, nodes.ravel()]))
    added = _at_phases(run, over, phases)
    later = added[len(first) :].reshape(*nodes.shape, len(phases))
    series = chebyshev_analysis(m) @ later if m else later
    return Course(counted, phases, added[: len(first)], series)


def _resolved(model: Model, load: Load, over: Mesh, starts: FloatArray) -> tuple[Advance, Mesh]:
    """One cycle from each start, on a mesh that resolves the rate at every phase."""
    while True:
        run = advance(drive(model, load, over), starts)
        rough = unresolved(run.rate, over, FINEST)
        if not rough.any() or len(over.lengths) > 64:
            return run, over
        over = refined(over, rough)


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


def wear_inside(prepared: Course, cycles: FloatArray) -> FloatArray:
    """Bearing wear (mm) at the prepared phases of each of `cycles` (n,), shape (n, phases)."""
    counted = prepared.counted
    starts, _ = evaluate(counted, cycles)
    wear = np.repeat(starts[:, None], len(prepared.phases), axis=1)
    early = cycles < len(prepared.first)
    wear[early] += prepared.first[cycles[early].astype(int)]
    panels = counted.panels
    if panels is None:
        return wear
    late = ~early
    panel = abel.part_of(panels.starts, starts)
    for p in np.unique(panel[late]):
        chosen = late & (panel == p)
        y = np.log1p((starts[chosen] - panels.starts[p]) / (panels.starts[p] + panels.shift))
        basis = chebyshev_values(2 * y / panels.widths[p] - 1, prepared.series.shape[1])
        wear[chosen] += basis @ prepared.series[p]
    return wear


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
    displacement = load(phases)
    rows = max(1, chunk // max(1, len(phases)))
    for at in range(0, len(cycles), rows):
        part = cycles[at : at + rows]
        wear = wear_inside(prepared, part)
        yield Inside(part, phases, wear, model.fields(wear, displacement))
