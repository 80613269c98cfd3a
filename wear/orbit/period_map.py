"""The period map u -> P(u) = u + D(u) of du/dt = f(u, t), for many scenes and many starts.

Overview
    A cycle is one unit of the phase. It is cut into intervals on which the rate is smooth; the
    increment D is found by collocation on all of them at once and never formed as a difference.
    Arrays are (scenes, starts, intervals, nodes); one scene is a batch of one.
Key results
    Equation     the equation: its rate with period one in the phase, and the derivative of that
    PeriodMap    increments, their derivative and errors, on a mesh that can be refined
    resolved     meshes that resolve the rate at given states
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple, Protocol

import numpy as np

from wear.numerics.collocation import (
    NOISE,
    CycleSolution,
    InitialGuess,
    Tangent,
    endpoint_defect,
    guess_without_feedback,
    iterate,
    solve,
    truncation_error,
    unresolved,
)
from wear.numerics.floating_point import ROUNDOFF, TINY
from wear.numerics.gauss import BoolArray, FloatArray, IntArray, Mesh, integral, mesh, product
from wear.numerics.initial_value import SAFETY, Endpoints, Rules, StoppedError, integrate
from wear.numerics.rows import stacked, take

COARSEST = 1e-6  # relative error: coarser meshes of phase have no valid error estimate
LOOSEST = 1e-4  # relative error: a looser count saves nothing
MANY_DIGITS = 1e-8  # relative error: below, series with more nodes are cheaper than more intervals
MOST_INTERVALS = 256  # of one cycle, or, if that is more,
MOST_CUTS = 8  # times those between its breakpoints
FEW_NODES = 8  # on each interval of phase
MANY_BREAKPOINTS = 30  # of one cycle: so close that between two of them FEW_NODES suffice
MOST_VIOLENT = 1_000_000  # evaluations of the rate, for an interval of a violent cycle
NUMBERS = (1, 2, 3, 6, 12, 24, 48, 96, 192)  # of intervals, so that many scenes share a number
MOST_AT_ONCE = 10_000_000  # rates of a scene under a long record
IN_CACHE = 12000  # numbers in an array that stays in the processor's cache beside a few others
# Of `truncation_error`: in 99 of 100 random scenes the error is less than three times that.
TAIL_SHARE = 1 / 12
NEARLY = 0.9  # of the limit: a cycle that cannot be followed beyond would pass it

Selection = slice | IntArray


class Settings(NamedTuple):
    """Sizes of the discretisation for a requested relative error."""

    phase_nodes: int  # on each interval of phase
    phase_tolerance: float  # of `unresolved`, which mostly exceeds the error tenfold
    endpoint_tolerance: float  # of errors that no other estimate shows
    panel_nodes: int  # on each panel of states
    tail_tolerance: float  # of the density without feedback on a panel
    residual_tolerance: float  # of Abel's equation
    iteration_tolerance: float  # of the period map

    @property
    def finer_nodes(self) -> int:
        """Return the nodes on each interval of phase for the map that judges."""
        return self.phase_nodes + 6


def settings(rtol: float, breakpoints: Sequence[FloatArray] = ()) -> Settings:
    """Return the cheapest sizes for `rtol` where the forcing is smooth between `breakpoints` of
    each scene."""
    phase_nodes, panel_nodes = (24, 48) if rtol < MANY_DIGITS else (16, 24)
    if min(map(len, breakpoints), default=0) > MANY_BREAKPOINTS:
        phase_nodes = FEW_NODES
    return Settings(
        phase_nodes=phase_nodes,
        phase_tolerance=max(2 * min(rtol, COARSEST), ROUNDOFF),
        endpoint_tolerance=max(1e-2 * min(rtol, COARSEST), ROUNDOFF),
        panel_nodes=panel_nodes,
        tail_tolerance=max(4 * rtol, 1e-12),
        residual_tolerance=max(min(rtol, LOOSEST) / 4, 30 * ROUNDOFF),
        iteration_tolerance=NOISE,
    )


class Equation(Protocol):
    """Scenes of du/dphase = f(u, g(phase)) with period one; f and g broadcast over arrays of shape
    (scenes, starts, intervals, nodes)."""

    @property
    def scenes(self) -> int: ...

    @property
    def breakpoints(self) -> Sequence[FloatArray]:
        """Return the phases from 0 to 1 of each scene between which the forcing is smooth."""

    def take(self, rows: Selection) -> Equation:
        """Return some of the scenes, each perhaps several times."""

    def forcing(self, phases: FloatArray) -> FloatArray:
        """Return g at phases (scenes, ...), in the same shape."""

    def rate(
        self,
        u: FloatArray,
        forcing: FloatArray,
        lengths: FloatArray | float = 1.0,
        near: Tangent | None = None,
    ) -> FloatArray:
        """Return du/dphase times `lengths`; the end of a tangent `near` may help."""

    def slope(self, u: FloatArray, forcing: FloatArray) -> FloatArray:
        """Return the derivative of the rate with respect to u."""


class PeriodMap(NamedTuple):
    """The period map of the scenes of an equation on a mesh of phase, with edges (scenes, 1,
    q + 1), or (1, 1, q + 1) for all; `forcing` (scenes, 1, q, m) is sampled at its nodes."""

    equation: Equation
    over: Mesh
    forcing: FloatArray
    tolerance: float = NOISE  # relative, of the iteration

    @property
    def scenes(self) -> int:
        """Return the number of scenes."""
        return self.equation.scenes

    @property
    def full(self) -> bool:
        """Return whether the mesh has the largest permitted number of intervals."""
        intervals = int(self.over.lengths.shape[-1])
        if intervals < MOST_INTERVALS:
            return False
        return intervals >= MOST_CUTS * max(map(len, self.equation.breakpoints))

    def take(self, rows: Selection) -> PeriodMap:
        """Return some of the scenes, each perhaps several times; one scene broadcasts."""
        if self.scenes == 1:
            return self
        over, forcing = self.over, self.forcing
        if len(forcing) > 1:
            over = Mesh(over.edges[rows], over.lengths[rows], over.phases[rows], over.rule)
            forcing = forcing[rows]
        return PeriodMap(self.equation.take(rows), over, forcing, self.tolerance)

    def finer(self, size: Settings) -> PeriodMap:
        """Return the map with more nodes that judges this one."""
        tolerance = max(NOISE, self.tolerance / 100)
        return period_map(self.equation, self.over.edges[:, 0], size.finer_nodes, tolerance)

    def interval(self, i: int) -> PeriodMap:
        """Return the part over one interval of the mesh."""
        return self._replace(over=self.over.interval(i), forcing=self.forcing[:, :, i : i + 1])

    def rate_per_interval(self, u: FloatArray, near: Tangent | None = None) -> FloatArray:
        """Return the rate times the length of each interval."""
        return self.equation.rate(u, self.forcing, self.over.lengths[..., None], near)

    def advance(
        self,
        starts: FloatArray,
        guess: InitialGuess | None = None,
        frozen: FloatArray | None = None,
    ) -> CycleSolution:
        """Return the increments of a cycle from each start (scenes, k), from a guess or from the
        rate without feedback, `frozen` (scenes, k, q, m), if one of them is known."""
        runs = []
        for rows in self._in_cache(starts):
            maps, near = self.take(rows), None if guess is None else take(guess, rows)
            if frozen is not None:
                near = guess_without_feedback(starts[rows], frozen[rows], maps.over)
            runs.append(maps._solved(starts[rows], near))
        return stacked(runs)._replace(evaluations=sum(run.evaluations for run in runs))

    def _solved(self, starts: FloatArray, guess: InitialGuess | None) -> CycleSolution:
        """Return the cycles from the starts (scenes, k), a few starts at a time under a long
        record: the iteration needs a dozen arrays."""
        parts = min(self._parts(starts), starts.shape[1])
        if parts == 1:
            return solve(self, starts, guess)
        runs = []
        for some in np.array_split(np.arange(starts.shape[1]), parts):
            near = guess and InitialGuess(*(array[:, some] for array in guess))
            runs.append(solve(self, starts[:, some], near))
        return CycleSolution(
            np.concatenate([run.increment for run in runs], axis=1),
            np.concatenate([run.inside for run in runs], axis=1),
            np.concatenate([run.rate for run in runs], axis=1),
            sum(run.evaluations for run in runs),
            np.all([run.converged for run in runs], axis=0),
            np.concatenate([run.iteration_error for run in runs], axis=1),
        )

    def _parts(self, u: FloatArray) -> int:
        """Return in how many parts the rates at states (scenes, k) are evaluated."""
        return 1 + int(u[0].size * self.forcing[0].size) // MOST_AT_ONCE

    def rate_without_feedback(self, u: FloatArray) -> FloatArray:
        """Return the rate (scenes, k, q, m) in cycles, the state frozen at each u (scenes, k)."""
        rates = []
        for rows in self._in_cache(u):
            maps = self.take(rows)
            rates.append(maps.equation.rate(u[rows, :, None, None], maps.forcing))
        return np.concatenate(rates)

    def increment_without_feedback(self, u: FloatArray) -> FloatArray:
        """Return the increments (scenes, k) of cycles with that rate."""
        some = np.array_split(u, min(self._parts(u), u.shape[1]), axis=1)
        each = [integral(self.rate_without_feedback(part), self.over) for part in some]
        return np.concatenate(each, axis=1)

    def consecutive(self, starts: FloatArray, number: int) -> CycleSolution:
        """Return a `number` of consecutive cycles from each start (scenes,), all at once on copies
        of the mesh; the increments (scenes, number) are those of single cycles."""
        over, (q, m) = self.over, self.forcing.shape[-2:]
        edges = [over.edges[..., :-1] + k for k in range(number)]
        edges.append(over.edges[..., -1:] + (number - 1))
        tiled = self._replace(
            over=mesh(np.concatenate(edges, axis=-1), m),
            forcing=np.tile(self.forcing, (1, 1, number, 1)),
        )
        run = iterate(tiled, starts[:, None])
        shape = (len(starts), number, q, m)
        rate = run.rate.reshape(shape)
        increment = integral(rate, over)
        before = np.cumsum(increment, axis=1) - increment
        return CycleSolution(
            increment,
            run.inside.reshape(shape) - before[..., None, None],
            rate,
            run.evaluations,
            run.converged,
            np.repeat(run.iteration_error, number, axis=1),
        )

    def derivative(self, starts: FloatArray, run: CycleSolution) -> FloatArray:
        """Return dP/du (scenes, k), the Floquet multiplier, along cycles from the `starts`."""
        slope = self.slope(starts[..., None, None] + run.inside)
        result: FloatArray = np.exp(integral(slope, self.over))
        return result

    def slope(self, u: FloatArray) -> FloatArray:
        """Return the derivative of the rate with respect to u at states u (scenes, k, q, m)."""
        return self.equation.slope(u, self.forcing)

    def violent_cycle(
        self, start: float, limit: float, size: Settings
    ) -> tuple[float, float, float, float, int]:
        """Return the increment of a cycle of one scene from the state `start`, its error, the
        derivative dP/du, the response to a relative error of the rate, and the number of right-hand
        sides evaluated; the state stays below the `limit`."""
        evaluations, last_values = 0, [0.0, np.inf, 1.0, 0.0]
        try:
            for last in self.integrated(start, limit, size):
                evaluations += last.evaluations
                last_values = [float(array[-1]) for array in last[:4]]
        except StoppedError as end:
            reached = limit if end.state > NEARLY * limit else end.state
            return reached - start, np.inf, 1.0, 0.0, evaluations
        increment, error, derivative, response = last_values
        return increment, error / SAFETY, derivative, response, evaluations

    def cut_for(self, start: float, limit: float, size: Settings) -> PeriodMap:
        """Return the map of one scene on a mesh that resolves a cycle from the state `start`,
        however violent, which stays below the `limit`; or raise a `StoppedError`."""
        parts = [last.edges for last in self.integrated(start, limit, size)]
        edges = np.unique(np.concatenate(parts))
        return period_map(self.equation, edges[None], size.phase_nodes, self.tolerance)

    def integrated(self, start: float, limit: float, size: Settings) -> Iterator[Endpoints]:
        """Integrate a cycle of one scene from the state `start`, part after part, by cutting the
        mesh wherever that is needed."""

        def sampled(edges: FloatArray, m: int, tolerance: float) -> PeriodMap:
            return period_map(self.equation, edges[None], m, tolerance)

        rules = Rules(size.phase_nodes, size.finer_nodes, size.endpoint_tolerance)
        edges = self.over.edges.ravel()
        return integrate(sampled, edges, start, rules, limit=limit, most=MOST_VIOLENT)

    def endpoint_defect(self, starts: FloatArray, run: CycleSolution) -> FloatArray:
        """Return the error at the ends of each interval (scenes, k, q) in the cycles from the
        `starts`."""
        added = product(run.rate, self.over.rule.weights) * self.over.lengths
        added = np.concatenate([np.zeros_like(added[..., :1]), added], axis=-1)
        u = (starts[..., None] + np.cumsum(added, axis=-1))[..., None]
        rate = self.equation.rate(u, self.equation.forcing(self.over.edges)[..., None])[..., 0]
        return endpoint_defect(run.rate, rate[..., :-1], rate[..., 1:], self.over)

    def unresolved(self, starts: FloatArray, run: CycleSolution, size: Settings) -> BoolArray:
        """Return which intervals (scenes, q) do not resolve the rate in the cycles from the
        `starts`, or hide a change of it at an end."""
        coarse = unresolved(run.rate, self.over, size.phase_tolerance) | ~run.converged[:, None]
        hidden = self.endpoint_defect(starts, run)
        allowed = size.endpoint_tolerance * run.increment[..., None]
        return np.asarray(coarse | np.any(hidden > allowed, axis=1))

    def phase_error(self, run: CycleSolution) -> FloatArray:
        """Return the approximate relative errors (scenes, k) of increments by the mesh of phase.

        The error of a mesh changes its sign with the state; it may vanish at a few states.
        """
        error: FloatArray = np.sum(truncation_error(run.rate, self.over), axis=-1)
        return TAIL_SHARE * error / (run.increment + TINY)

    def refined(self, marked: BoolArray) -> Iterator[tuple[IntArray, PeriodMap]]:
        """Yield the scenes with `marked` intervals (scenes, q), grouped by the size of their
        meshes, and their period maps with these intervals cut in two."""
        rows, m = np.flatnonzero(marked.any(axis=1)), len(self.over.rule.nodes)
        edges = np.broadcast_to(self.over.edges[:, 0], (len(marked), marked.shape[1] + 1))
        for which, finer in _cut_alike(edges[rows], marked[rows]):
            scenes = self.equation.take(rows[which])
            yield rows[which], period_map(scenes, finer, m, self.tolerance)

    def _in_cache(self, starts: FloatArray) -> Iterator[slice]:
        """Yield the scenes in slices that stay in the cache with all their starts."""
        scenes = max(1, IN_CACHE // (starts.shape[1] * self.forcing[0].size))
        for at in range(0, len(starts), scenes):
            yield slice(at, at + scenes)


def period_map(
    equation: Equation, edges: FloatArray, m: int, tolerance: float = NOISE
) -> PeriodMap:
    """Return the period map with m nodes on each interval between edges (scenes, q + 1)."""
    over = mesh(edges[:, None], m)
    return PeriodMap(equation, over, equation.forcing(over.phases), tolerance)


def by_size(breakpoints: Sequence[FloatArray]) -> Iterator[tuple[IntArray, FloatArray]]:
    """Yield the scenes grouped by their number of breakpoints (q + 1,), and these as edges."""
    sizes = np.array([len(edges) for edges in breakpoints])
    for size in np.unique(sizes):
        which = np.flatnonzero(sizes == size)
        yield which, np.stack([breakpoints[i] for i in which.tolist()])


def resolved(
    equation: Equation,
    breakpoints: Sequence[FloatArray],
    states: FloatArray,
    size: Settings,
    tolerance: FloatArray | None = None,
) -> Iterator[tuple[IntArray, PeriodMap]]:
    """Yield groups of scenes with meshes that resolve the rate at the `states` (scenes, k) to the
    `tolerance` (scenes,), that of `size` by default, cut at least at the `breakpoints` (q + 1,) of
    each."""
    if tolerance is None:
        tolerance = np.full(len(states), size.phase_tolerance)
    todo = {edges.shape[1]: [(which, edges)] for which, edges in by_size(breakpoints)}
    while todo:
        parts = todo.pop(min(todo))  # cutting only adds intervals: none comes back to this number
        which, edges = (np.concatenate(arrays) for arrays in zip(*parts, strict=True))
        scenes = equation.take(which)
        maps = period_map(scenes, edges, size.phase_nodes, size.iteration_tolerance)
        rate = maps.rate_without_feedback(states[which])
        marked = unresolved(rate, maps.over, tolerance[which, None, None])
        if maps.full:
            marked[:] = False
        calm = np.flatnonzero(~marked.any(axis=1))
        if len(calm):
            yield which[calm], maps.take(calm)
        rest = np.flatnonzero(marked.any(axis=1))
        for group, finer in _cut_alike(edges[rest], marked[rest]):
            todo.setdefault(finer.shape[1], []).append((which[rest[group]], finer))


def _cut_alike(edges: FloatArray, marked: BoolArray) -> Iterator[tuple[IntArray, FloatArray]]:
    """Yield groups of scenes with equally many intervals, and their edges (scenes, q + 1) with the
    `marked` intervals (scenes, q) cut in two.

    If there are several scenes, their longest intervals are cut as well until their number is one
    of NUMBERS, so that groups are large.
    """
    cuts = np.sum(marked, axis=1)
    for more in np.unique(cuts).tolist():
        which = np.flatnonzero(cuts == more)
        finer = _cut(edges[which], marked[which])
        if len(edges) > 1:
            wanted = finer.shape[1] - 1
            finer = _cut_longest(finer, min((n for n in NUMBERS if n >= wanted), default=0))
        yield which, finer


def _cut(edges: FloatArray, marked: BoolArray) -> FloatArray:
    """Return edges (scenes, q + 1) with the `marked` intervals cut in two, equally many a scene."""
    middles = np.where(marked, (edges[:, 1:] + edges[:, :-1]) / 2, np.inf)
    finer = np.sort(np.concatenate([edges, middles], axis=1), axis=1)
    return finer[:, : edges.shape[1] + int(np.sum(marked[0]))]


def _cut_longest(edges: FloatArray, number: int) -> FloatArray:
    """Return edges with the longest intervals cut in two until there are `number` of them."""
    while edges.shape[1] - 1 < number:
        lengths = np.diff(edges, axis=1)
        longest = np.arange(lengths.shape[1]) == np.argmax(lengths, axis=1)[:, None]
        edges = _cut(edges, longest)
    return edges
