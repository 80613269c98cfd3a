"""One cycle of many scenes at once: the one-cycle map with the scenes as the first axis.

Every scene has a load and a mesh of phase of its own; scenes go together whose meshes have as many
intervals.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from wear.count.cycle import Settings, growth, pace
from wear.load import Load, sampled
from wear.model import Model
from wear.numerics.collocation import (
    NOISE,
    CycleSolution,
    InitialGuess,
    endpoint_defect,
    iterate,
    unresolved,
)
from wear.numerics.gauss import (
    BoolArray,
    FloatArray,
    IntArray,
    Mesh,
    integral,
    mesh,
)

IN_CACHE = 12000  # numbers of an array that stays in the processor's cache, with some others

Which = slice | IntArray


class Many(NamedTuple):
    """Scenes of one variant: the `model` of all, its constants of shape (scenes, 1), the load of
    each and where that cuts its cycle, `plain_edges`."""

    model: Model
    loads: Sequence[Load]
    plain_edges: Sequence[FloatArray]

    def take(self, which: IntArray) -> Many:
        """Some of the scenes."""
        loads, edges = ([own[i] for i in which.tolist()] for own in (self.loads, self.plain_edges))
        return Many(self.model.select(which), loads, edges)

    def on(self, edges: FloatArray, m: int, tolerance: float = NOISE) -> ManyDrives:
        """A cycle of each scene on its mesh, with edges (scenes, q + 1)."""
        over = mesh(edges[:, None], m)
        phases = np.concatenate([over.phases.reshape(len(edges), -1), edges], axis=1)
        displacement = sampled(self.loads, phases)
        at_edges = displacement[:, None, -edges.shape[1] :]
        displacement = displacement[:, : -edges.shape[1]].reshape(over.phases.shape)
        period = np.array([load.period for load in self.loads])[:, None, None, None]
        model = self.model.reshaped((-1, 1, 1, 1))
        return ManyDrives(model, period, over, displacement, at_edges, tolerance)


class ManyDrives(NamedTuple):
    """A cycle of many scenes; the constants of the model have the shape (scenes, 1, 1, 1), the
    edges of the meshes (scenes, 1, q + 1)."""

    model: Model
    period: FloatArray  # (scenes, 1, 1, 1), s
    over: Mesh
    displacement: FloatArray  # (scenes, 1, q, m), mm
    at_edges: FloatArray  # (scenes, 1, q + 1), mm: the displacement there
    tolerance: float

    def rate(self, u: FloatArray) -> FloatArray:
        """Wear rate in mm per cycle at wear `u` (scenes, k, q, m) or (scenes, k, 1, 1)."""
        rate: FloatArray = self.model.rate(u, self.displacement)
        return self.period * rate

    def rate_per_interval(self, u: FloatArray, near: FloatArray | None = None) -> FloatArray:
        """Wear rate in mm per interval at wear `u` (scenes, k, q, m), sought from one `near` by."""
        return pace(self.model, u, self.displacement, self.period, self.over, near)

    def take(self, which: Which) -> ManyDrives:
        """Some of the scenes."""
        edges, lengths, phases, rule = self.over
        over = Mesh(edges[which], lengths[which], phases[which], rule)
        return ManyDrives(
            self.model.select(which),
            self.period[which],
            over,
            self.displacement[which],
            self.at_edges[which],
            self.tolerance,
        )

    def interval(self, i: int) -> ManyDrives:
        """The part over one interval of the meshes."""
        return self._replace(
            over=self.over.interval(i),
            displacement=self.displacement[:, :, i : i + 1],
            at_edges=self.at_edges[:, :, i : i + 2],
        )

    def overlooked(self, starts: FloatArray, run: CycleSolution) -> FloatArray:
        """What each interval may conceal (scenes, k, q), in mm, by a change of the rate between an
        end and the nodes, over the cycles of `run` from the `starts` (scenes, k)."""
        added = run.rate @ self.over.rule.weights * self.over.lengths
        wear = starts[..., None] + np.cumsum(np.insert(added, 0, 0.0, axis=-1), axis=-1)
        model = self.model.reshaped((-1, 1, 1))
        rate = self.period[..., 0] * model.rate(wear, self.at_edges)
        return endpoint_defect(run.rate, rate[..., :-1], rate[..., 1:], self.over)

    def several(self, number: int) -> CycleSolution:
        """Some cycles on end from no wear: the guess for one is where those before lead."""
        start = np.zeros((len(self.displacement), 1))
        runs = [self.advance(start)]
        grown = np.zeros_like(runs[0].inside)
        while len(runs) < number:
            last = runs[-1]
            start = start + last.increment
            apart = last.increment[..., None, None] + grown
            runs.append(self.advance(start, InitialGuess(last.inside + grown, last.rate, apart)))
            grown = runs[-1].inside - last.inside
        return CycleSolution(
            np.concatenate([run.increment for run in runs], axis=1),
            np.concatenate([run.inside for run in runs], axis=1),
            np.concatenate([run.rate for run in runs], axis=1),
            sum(run.evaluations for run in runs),
            np.logical_and.reduce([run.converged for run in runs]),
            np.concatenate([run.iteration_error for run in runs], axis=1),
        )

    def rough(self, run: CycleSolution, size: Settings) -> BoolArray:
        """Which intervals (scenes, q) do not resolve the rate in the first cycles, or hide a change
        of it at an end."""
        rough = unresolved(run.rate, self.over, size.phase_tolerance)
        starts = np.cumsum(run.increment, axis=1) - run.increment
        allowed = size.strict_tolerance * run.increment[..., None]
        rough |= np.any(self.overlooked(starts, run) > allowed, axis=1)
        return rough & run.converged

    def growth(self, wear: FloatArray) -> FloatArray:
        """By how much cycles with the `wear` (scenes, k, q, m) inside change a small difference in
        it."""
        return growth(self.model, wear, self.displacement, self.period, self.over)

    def in_cache(self, starts: int) -> Iterator[slice]:
        """Scenes a few at a time, with so many starts each."""
        scenes = max(1, IN_CACHE // (starts * self.displacement[0].size))
        for at in range(0, len(self.displacement), scenes):
            yield slice(at, at + scenes)

    def rough_frozen(self, wear: FloatArray, tolerance: float) -> BoolArray:
        """Which intervals (scenes, q) do not resolve the rate at frozen `wear` (scenes, k), mm."""
        parts = []
        for some in self.in_cache(wear.shape[1]):
            part = self.take(some)
            parts.append(unresolved(part.rate(wear[some, :, None, None]), part.over, tolerance))
        return np.concatenate(parts)

    def frozen(self, wear: FloatArray) -> FloatArray:
        """Wear (mm) that a cycle would add to each `wear` (scenes, k) without feedback."""
        parts = []
        for some in self.in_cache(wear.shape[1]):
            part = self.take(some)
            parts.append(integral(part.rate(wear[some, :, None, None]), part.over))
        return np.concatenate(parts)

    def advance(self, starts: FloatArray, near: InitialGuess | None = None) -> CycleSolution:
        """Wear added by a cycle from each start (scenes, k)."""
        runs = []
        for some in self.in_cache(starts.shape[1]):
            guess = None if near is None else InitialGuess(*(array[some] for array in near))
            runs.append(iterate(self.take(some), starts[some], guess))
        return CycleSolution(
            np.concatenate([run.increment for run in runs]),
            np.concatenate([run.inside for run in runs]),
            np.concatenate([run.rate for run in runs]),
            sum(run.evaluations for run in runs),
            np.concatenate([run.converged for run in runs]),
            np.concatenate([run.iteration_error for run in runs]),
        )
