"""One segment of the orbits of many scenes, solved in batches.

The scenes of a batch have meshes of phase of one size and equally many integrated cycles. Solving
it shows which scenes need a finer mesh, shorter panels or more integrated cycles; those that need
the same form a new batch, together with those of other batches.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from wear.numerics.floating_point import ROUNDOFF
from wear.numerics.gauss import FloatArray, IntArray
from wear.numerics.rows import stacked, take
from wear.orbit import abel
from wear.orbit.iterates import CountTable, Iterates, count_table
from wear.orbit.panels import Layout, PanelSolution, adapt
from wear.orbit.period_map import PeriodMap, period_map, resolved, settings
from wear.orbit.plan import (
    COORDINATE_SCALE,
    LEAST,
    MARGIN,
    before_the_first,
    enough_before,
    look_ahead,
    planned,
)
from wear.orbit.problem import Cost, Problem, Request, most_evaluations
from wear.orbit.transient import BLOCK, SAFETY, Transient, extended, no_cycle

SAMPLES = np.array([0.0, 0.15, 0.3, 0.45, 0.6, 0.8, 1.0])  # of ln(u + scale): for the mesh
MOST_FIRST = 120  # cycles integrated one by one in a segment
AHEAD = 10 * BLOCK  # cycles at the last rate, over which panels extend at least
ACCEPTABLE = 10.0  # times the tolerance: a residual that refinement need not reduce further


class Batch(NamedTuple):
    """Scenes `which` with their period maps and transient; the number of integrated cycles `needed`
    before panels; the `worst` residual (s,) so far, the right-hand sides `spent` (s,), and the
    `layout` of panels to begin with, if one is known."""

    which: IntArray
    maps: PeriodMap
    transient: Transient
    needed: int
    worst: FloatArray
    spent: FloatArray
    layout: Layout | None = None

    @property
    def key(self) -> tuple[int, int, int, bool]:
        """Return the common properties of batches that can be joined."""
        intervals = self.maps.over.lengths.shape[-1]
        return (intervals, self.transient.cycles, self.needed, self.layout is None)

    def take(self, rows: IntArray, needed: int) -> Batch:
        """Return the batch of some of the scenes, with the number of cycles `needed`."""
        if len(rows) == len(self.which):
            return self._replace(needed=needed, layout=None)
        return Batch(
            self.which[rows],
            self.maps.take(rows),
            take(self.transient, rows),
            needed,
            self.worst[rows],
            self.spent[rows],
        )


class Batches:
    """The counts of one segment of some scenes, batch by batch."""

    def __init__(self, problem: Problem, request: Request, rtol: float, keep: bool) -> None:
        self.problem, self.request, self.rtol, self.keep = problem, request, rtol, keep
        self.size = size = settings(rtol, problem.breakpoints)
        self.cost = Cost(0, 0)
        self.scale, self.limit = problem.scale, problem.limit
        self.end = look_ahead(problem, request)
        begin = request.start + self.scale
        y = np.log1p((self.end - request.start) / begin)[:, None] * SAMPLES
        self.samples = request.start[:, None] + begin[:, None] * np.expm1(y)
        floor = np.max(problem.roundoff(self.samples), axis=1)
        self.tolerance = np.maximum(size.residual_tolerance, floor)
        self.phase_tolerance = np.maximum(size.phase_tolerance, floor)
        self.most = most_evaluations(problem)
        self.todo: dict[tuple[int, int, int, bool], list[Batch]] = {}

    def counts(self) -> Iterator[tuple[IntArray, Iterates]]:
        """Yield groups of scenes with their counts."""
        problem, start = self.problem, self.request.start
        for which, maps in resolved(
            problem, problem.breakpoints, self.samples, self.size, self.phase_tolerance
        ):
            zero, infinite = np.zeros(len(which)), np.full(len(which), np.inf)
            batch = Batch(which, maps, no_cycle(start[which]), 0, infinite, zero)
            self._add(batch, np.arange(len(which)), 0)
        while self.todo:
            batches = self.todo.pop(min(self.todo))
            batch = batches[0] if len(batches) == 1 else self._joined(batches)
            if batch.transient.cycles < batch.needed:
                yield from self._extended(batch)
            else:
                yield from self._on_panels(batch)

    def _add(self, batch: Batch, rows: IntArray, needed: int, **changes: Any) -> None:
        """Queue some of the scenes, if there are any, until they have the cycles `needed`."""
        if len(rows):
            chosen = batch.take(rows, needed)._replace(**changes)
            self.todo.setdefault(chosen.key, []).append(chosen)

    def _joined(self, batches: list[Batch]) -> Batch:
        """Return batches with the same key as one."""
        edges = [_edges(batch.maps, np.arange(len(batch.which))) for batch in batches]
        which, first = np.concatenate([batch.which for batch in batches]), batches[0]
        m, tolerance = len(first.maps.over.rule.nodes), first.maps.tolerance
        maps = period_map(self.problem.take(which), np.concatenate(edges), m, tolerance)
        offsets = np.cumsum([0, *(len(batch.which) for batch in batches[:-1])])
        layouts = [
            batch.layout._replace(scene=batch.layout.scene + at)
            for batch, at in zip(batches, offsets, strict=True)
            if batch.layout is not None
        ]
        return Batch(
            which,
            maps,
            stacked([batch.transient for batch in batches]),
            first.needed,
            np.concatenate([batch.worst for batch in batches]),
            np.concatenate([batch.spent for batch in batches]),
            stacked(layouts) if layouts else None,
        )

    def _extended(self, batch: Batch) -> Iterator[tuple[IntArray, Iterates]]:
        """Integrate more cycles; yield the scenes that end with them."""
        limit, tolerance = self.limit[batch.which], self.tolerance[batch.which]
        for more in extended(batch.maps, batch.transient, limit, self.size, tolerance):
            which = batch.which[more.which]
            spent = batch.spent[more.which] + more.cost.rhs_evaluations / len(which)
            self.cost = self.cost.plus(*more.cost)
            longer = Batch(
                which, more.maps, more.transient, batch.needed, batch.worst[more.which], spent
            )
            late = self.request.late and more.transient.cycles >= BLOCK
            ended = np.full(len(which), late)
            if more.transient.cycles > batch.transient.cycles:
                last = more.transient.last
                ended |= more.transient.cycles >= self.request.cycles[which]
                ended |= ~(last < self.limit[which]) | ~(more.transient.last_increment > 0)
            if ended.any():
                yield self._without_panels(longer, np.flatnonzero(ended))
            self._add(longer, np.flatnonzero(~ended), batch.needed)

    def _on_panels(self, batch: Batch) -> Iterator[tuple[IntArray, Iterates]]:
        """Solve Abel's equation on panels; yield the scenes that are accurate, and queue the others
        for refinement."""
        if batch.layout is None:
            yield from self._planned(batch)
            return
        which, number, tolerance = batch.which, batch.transient.cycles, self.tolerance[batch.which]
        fine = batch.maps.finer(self.size)
        panels, coarse, cost = adapt(
            batch.maps, fine, batch.layout, self.size, tolerance, self.keep
        )
        self.cost = self.cost.plus(*cost)
        spent = batch.spent + cost.rhs_evaluations / len(which)
        scene, residual = panels.scene, panels.residual
        worst = np.zeros(len(which))
        np.maximum.at(worst, scene, np.where(np.isnan(residual), np.inf, residual))
        marked, good = coarse.any(axis=1), worst <= tolerance
        counts = list(self._counted(batch, panels)) if number == 0 else []
        for rows, iterates in counts:
            good[rows] &= iterates.largest_error <= self.rtol
        # A residual of rounding errors does not fall with refinement.
        accepted = (batch.worst <= ACCEPTABLE * tolerance) & ~(worst < batch.worst / 2)
        accepted &= number > 0
        accepted |= (spent > self.most[which]) | (marked & batch.maps.full)
        accepted |= self.request.late and number > 0
        accepted |= good & ~marked
        for rows, maps in batch.maps.refined(coarse & ~accepted[:, None]):
            layout = _of(Layout(scene, panels.density.grid), rows)
            state = {"worst": worst[rows], "spent": spent[rows], "layout": layout}
            self._add(batch, rows, number, maps=maps, **state)
        # More cycles are integrated before panels that are too short to be cut further.
        rest = np.flatnonzero(~accepted & ~marked)
        self._add(batch, rest, max(BLOCK, 2 * number), worst=worst[rest], spent=spent[rest])
        for rows, iterates in counts or self._counted(batch, take(panels, accepted[scene])):
            kept = np.flatnonzero(accepted[rows])
            if len(kept):
                yield which[rows[kept]], iterates if len(kept) == len(rows) else iterates.take(kept)

    def _grid(self, batch: Batch) -> abel.Grid:
        """Return one panel for each scene, over the range that it must cover."""
        last, limit = batch.transient.last, self.limit[batch.which]
        ahead = AHEAD * batch.transient.last_increment if batch.transient.cycles else 0.0
        end = np.minimum(np.maximum(self.end[batch.which], last + ahead), limit)
        return abel.grid(COORDINATE_SCALE * self.scale[batch.which], last, end)

    def _planned(self, batch: Batch) -> Iterator[tuple[IntArray, Iterates]]:
        """Lay out panels that hold enough cycles, as far as possible. Queue scenes whose first
        panels hold too few for more integrated cycles, and those whose phase is not resolved on
        their panels for a finer mesh; yield those that may have neither."""
        number = batch.transient.cycles
        scenes = np.arange(len(batch.which))
        plan = planned(
            batch.maps,
            scenes,
            self._grid(batch),
            self.size,
            self.phase_tolerance[batch.which],
        )
        # Far beyond the requested cycles the rate may vanish altogether: there is no density.
        wanted = MARGIN * np.maximum(self.request.cycles[batch.which], LEAST)
        share = plan.cycles / wanted[plan.layout.scene]
        plan = take(plan, ~enough_before(share, plan.layout.scene))
        scene = plan.layout.scene
        usable = before_the_first(plan.cycles < self.size.panel_nodes, scene)
        all_usable = np.full(len(scenes), True)
        all_usable[scene[~usable]] = False
        cycles = np.zeros(len(scenes))
        np.add.at(cycles, scene[usable], plan.cycles[usable])
        # Where the rate rises panels become short again, perhaps far ahead.
        ready = all_usable | (cycles > MOST_FIRST - number)
        over = ~ready & ((number >= MOST_FIRST) | (self.request.late and number > 0))
        if over.any():
            yield self._without_panels(batch, np.flatnonzero(over))
        self._add(batch, np.flatnonzero(~ready & ~over), number + BLOCK)
        # Pulses may be narrower there than where the mesh was tried.
        marked = np.zeros((len(scenes), plan.unresolved.shape[1]), dtype=bool)
        np.logical_or.at(marked, scene[usable], plan.unresolved[usable])
        marked &= ready[:, None] & (not batch.maps.full)
        for rows, maps in batch.maps.refined(marked):
            self._add(batch, rows, number, maps=maps)
        rows = np.flatnonzero(ready & ~marked.any(axis=1))
        self._add(batch, rows, number, layout=_of(take(plan.layout, usable), rows))

    def _without_panels(self, batch: Batch, rows: IntArray) -> tuple[IntArray, Iterates]:
        """Return the integrated cycles alone."""
        which, transient = batch.which[rows], take(batch.transient, rows)
        error = self._transient_error(which, transient)
        # What a cycle adds may be less than rounding, and yet much after many.
        idle = ~(transient.last_increment > 0)
        error[idle, -1] += (transient.response[:, -1] * self.request.cycles[which])[idle]
        none = np.empty((len(rows), 0))
        limit = self.limit[which]
        edges = _edges(batch.maps, rows)
        return which, Iterates(transient.states, error, None, None, none, limit, edges)

    def _transient_error(self, which: IntArray, transient: Transient) -> FloatArray:
        """Return the errors (s, k + 1) of the integrated cycles."""
        rounding = np.empty(transient.states.shape)
        if transient.cycles:
            rounding = self.problem.take(which).roundoff(transient.states)
        start_error = self.request.start_error[which]
        return transient.error(start_error, np.maximum(rounding[:, 1:], rounding[:, :-1]))

    def _counted(self, batch: Batch, panels: PanelSolution) -> Iterator[tuple[IntArray, Iterates]]:
        """Yield the counts on panels of the scenes `rows` of the batch, grouped by the number of
        their panels."""
        scenes, inverse, counts = np.unique(panels.scene, return_inverse=True, return_counts=True)
        for number in np.unique(counts).tolist():
            rows = scenes[counts == number]
            which, transient = batch.which[rows], take(batch.transient, rows)
            error = self._transient_error(which, transient)
            own = take(panels, counts[inverse] == number)
            table = count_table(own.density, float(transient.cycles), len(rows))
            begins, ends = (x.reshape(len(rows), -1) for x in (table.u, table.ends))
            u = np.concatenate([begins, ends[:, -1:]], axis=1)
            rounding = self.problem.take(which).roundoff(u)
            of_count = count_error(own.density, own.residual, table, rounding, len(rows))
            of_count += error[:, -1:] / table.first_rate.reshape(len(rows), -1)[:, :1]
            iterates = Iterates(
                transient.states,
                error,
                table,
                own.density,
                of_count,
                self.limit[which],
                _edges(batch.maps, rows),
                own.cycles,
            )
            yield rows, iterates


def count_error(
    panels: abel.Density, residual: FloatArray, table: CountTable, rounding: FloatArray, scenes: int
) -> FloatArray:
    """Return the error (scenes, cells + 1) of n where each cell starts and where the last ends: by
    the `residual` of each panel, by the matching of panels, and by `rounding` of the rate
    (scenes, cells + 1)."""
    shape, number = (scenes, -1), len(residual)
    in_cell = table.number.reshape(shape)
    of_panel = in_cell.size // number
    error = SAFETY * np.repeat(residual, of_panel).reshape(shape) * in_cell
    error += table.truncation.reshape(shape)
    per_scene = number // scenes
    for k in range(1, per_scene):
        before = take(panels, slice(k - 1, None, per_scene))
        after = take(panels, slice(k, None, per_scene))
        # The shift acts at once, and so belongs to the last cell before.
        error[:, k * of_panel - 1] += SAFETY * abel.matching_defect(before, after)
    terms = ROUNDOFF * np.sum(np.abs(panels.series), axis=1)  # of ln(density)
    of_density = np.repeat(terms, of_panel).reshape(shape)
    error += (np.maximum(rounding[:, 1:], rounding[:, :-1]) + of_density) * in_cell
    return np.concatenate([np.zeros((scenes, 1)), np.cumsum(error, axis=1)], axis=1)


def _of(layout: Layout, rows: IntArray) -> Layout:
    """Return the panels of some scenes, which are renumbered in rising order."""
    chosen = take(layout, np.isin(layout.scene, rows))
    return chosen._replace(scene=np.searchsorted(np.sort(rows), chosen.scene))


def _edges(maps: PeriodMap, rows: IntArray) -> FloatArray:
    """Return the edges (s, q + 1) of the meshes of some scenes."""
    edges = maps.over.edges[:, 0]
    return np.repeat(edges, len(rows), axis=0) if len(edges) == 1 else np.asarray(edges[rows])
