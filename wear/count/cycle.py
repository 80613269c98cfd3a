"""The one-cycle map u -> P(u): the wear that one cycle adds, for many starts at once.

A cycle is cut into intervals of phase; on each the solution is collocated at Gauss-Legendre nodes
and the integral equation v = integral of rate(u + v, U_a) is solved by Picard iteration over all
nodes and all starts together. The wear v since the start is carried as such, so that an increment
of 1e-12 of the wear keeps all its digits.
"""

from typing import NamedTuple, Protocol

import numpy as np

from wear.count.collocation import BoolArray, FloatArray, Mesh, integral, mesh, running_integral
from wear.load import Load
from wear.model import Model

ROUNDOFF = float(np.finfo(float).eps)
TINY = float(np.finfo(float).tiny)
MOST_INTERVALS = 256  # of one cycle
NOISE = 8 * ROUNDOFF  # what rounding alone changes from one iteration to the next
MOST_ITERATIONS = 60  # Picard converges like Lambda^k / k!: 60 cover Lambda = 15 over a mesh
PATIENCE = 8  # iterations that may diverge at first


class Cost(NamedTuple):
    """What a result took: starts times cycles integrated, right-hand sides evaluated."""

    cycles_integrated: int
    rhs_evaluations: int

    def plus(self, cycles: int, evaluations: int) -> "Cost":
        """The cost after so much more work."""
        return Cost(self.cycles_integrated + cycles, self.rhs_evaluations + evaluations)


class Settings(NamedTuple):
    """Sizes of the discretisation for a requested relative error."""

    phase_nodes: int  # on each interval of phase
    phase_tolerance: float
    panel_nodes: int  # on each panel of wear
    tail_tolerance: float  # of the frozen density on a panel
    residual_tolerance: float  # of Abel's equation

    @property
    def finer_nodes(self) -> int:
        """Nodes on each interval of phase for the map that judges."""
        return self.phase_nodes + 6


def settings(rtol: float) -> Settings:
    """Few nodes for few digits: what is cheapest for `rtol` on smooth loads."""
    phase_nodes, panel_nodes = (24, 24) if rtol < 1e-9 else (14, 16)
    return Settings(
        phase_nodes,
        phase_tolerance=max(1e-2 * rtol, ROUNDOFF),
        panel_nodes=panel_nodes,
        tail_tolerance=max(2 * rtol, 1e-12),
        residual_tolerance=max(rtol / 4, 30 * ROUNDOFF),
    )


class Cycle(Protocol):
    """One cycle of one scene or of many, on a mesh of phase."""

    @property
    def over(self) -> Mesh: ...

    @property
    def displacement(self) -> FloatArray: ...

    def rate(self, u: FloatArray, near: FloatArray | None = None) -> FloatArray:
        """Wear rate in mm per cycle at wear `u` (..., q, m), sought from a rate `near` by."""

    def interval(self, i: int) -> "Cycle":
        """The part over one interval of the mesh."""


class OneCycle(Protocol):
    """The one-cycle map of a scene, on a mesh that can be changed."""

    @property
    def over(self) -> Mesh: ...

    @property
    def most_intervals(self) -> int:
        """Where refining stops."""

    def on(self, over: Mesh) -> "OneCycle":
        """The same on another mesh."""

    def resolved(self, wear: FloatArray, m: int, tolerance: float) -> "OneCycle":
        """On a mesh of m nodes an interval that suits the wear values (k,), mm."""

    def advance(self, starts: FloatArray) -> "Advance":
        """Wear added by one cycle from each start, any shape."""

    def frozen(self, wear: FloatArray) -> FloatArray:
        """Wear (mm) added by one cycle if the rate did not feel it, any shape."""

    def several(self, start: float, number: int) -> "Advance":
        """Some cycles on end; increments have shape (number,), rates (number, q, m)."""


class Drive(NamedTuple):
    """A model under a load, sampled at the phases of a mesh: all that one cycle needs."""

    model: Model
    load: Load
    over: Mesh
    displacement: FloatArray  # (q, m), mm

    def rate(self, u: FloatArray, near: FloatArray | None = None) -> FloatArray:
        """Wear rate in mm per cycle at wear `u` (..., q, m), sought from a rate `near` by."""
        known = None if near is None else near / self.load.period
        rate: FloatArray = self.model.rate(u, self.displacement, known)
        return self.load.period * rate

    @property
    def most_intervals(self) -> int:
        """Where refining stops: the load is too rough to be resolved."""
        return MOST_INTERVALS

    def on(self, over: Mesh) -> "Drive":
        """The same on another mesh."""
        return drive(self.model, self.load, over)

    def resolved(self, wear: FloatArray, m: int, tolerance: float) -> "Drive":
        """On a mesh of m nodes an interval that resolves the rate at each wear (k,)."""
        return self.on(resolve(self.model, self.load, wear, m, tolerance))

    def advance(self, starts: FloatArray) -> "Advance":
        """Wear added over the mesh from each start."""
        return advance(self, starts)

    def frozen(self, wear: FloatArray) -> FloatArray:
        """Wear (mm) added over the mesh if the rate did not feel it."""
        return integral(self.rate(wear[..., None, None]), self.over)

    def several(self, start: float, number: int) -> "Advance":
        """Cycles on end, all at once on copies of the mesh of one."""
        over = self.over
        edges = np.concatenate([over.edges[:-1] + k for k in range(number)] + [[float(number)]])
        run = advance(self.on(mesh(edges, len(over.rule.nodes))), np.array(start))
        rate = run.rate.reshape(number, *over.phases.shape)
        return Advance(
            integral(rate, over),
            run.inside.reshape(rate.shape),
            rate,
            run.evaluations,
            np.logical_and.reduce(run.converged.reshape(number, -1), axis=0),
        )

    def interval(self, i: int) -> "Drive":
        """The part over one interval of the mesh."""
        return self._replace(over=self.over.interval(i), displacement=self.displacement[i : i + 1])


class Advance(NamedTuple):
    """What cycles did: `increment` (...) mm; at the nodes (..., q, m) the wear since the start
    `inside` (mm) and the `rate` (mm per cycle); the number of right-hand sides evaluated; and on
    which intervals (q,) the iteration converged."""

    increment: FloatArray
    inside: FloatArray
    rate: FloatArray
    evaluations: int
    converged: BoolArray


def drive(model: Model, load: Load, over: Mesh) -> Drive:
    """Sample the load on a mesh."""
    return Drive(model, load, over, load(over.phases))


def first_edges(load: Load) -> FloatArray:
    """Ends of intervals that no node may straddle (kinks) or should cluster at (peaks)."""
    inner = {phase for phase in (*load.kinks, *load.peaks) if 1e-9 < phase < 1.0 - 1e-9}
    return np.array([0.0, *sorted(inner), 1.0])


def resolve(model: Model, load: Load, starts: FloatArray, m: int, tolerance: float) -> Mesh:
    """A mesh of m nodes an interval on which the rate at each frozen wear (k,) is resolved."""
    over = mesh(first_edges(load), m)
    while len(over.lengths) < MOST_INTERVALS:
        rough = unresolved(drive(model, load, over).rate(starts[:, None, None]), over, tolerance)
        if not rough.any():
            break
        over = refined(over, rough)
    return over


def unresolved(rate: FloatArray, over: Mesh, tolerance: float) -> BoolArray:
    """Which intervals (q,) do not resolve the rate (k, q, m) of every start.

    Gauss quadrature leaves what two truncated series have in common: on an interval, the square of
    its last Legendre coefficients over its largest. That is held against the increment.
    """
    series = np.abs(rate @ over.rule.coefficients.T)
    largest = np.max(series, axis=-1) + TINY
    left = np.max(series[..., -3:], axis=-1) ** 2 / largest * over.lengths
    # Rounding of the largest coefficients looks like a tail: it is none.
    left[largest * ROUNDOFF * 100 > np.max(series[..., -3:], axis=-1)] = 0.0
    rough: BoolArray = np.any(left > tolerance * integral(rate, over)[:, None], axis=0)
    return rough


def refined(over: Mesh, rough: BoolArray) -> Mesh:
    """The mesh with the intervals `rough` (q,) cut in two."""
    middles = (over.edges[:-1] + over.edges[1:])[rough] / 2
    return mesh(np.sort(np.concatenate([over.edges, middles])), len(over.rule.nodes))


def advance(cycle: Cycle, starts: FloatArray) -> Advance:
    """Wear added over the mesh of `cycle`, for each start (...).

    All intervals at once where Picard iteration converges, which takes a wear that changes the
    pressure moderately within the mesh; else one interval after the other.
    """
    run = _picard(cycle, starts)
    if run.converged.all() or len(cycle.over.lengths) == 1:
        return run
    return _one_by_one(cycle, starts, run.evaluations)


def _picard(cycle: Cycle, starts: FloatArray) -> Advance:
    """Iterate v = integral of rate(u + v) until the next change, foretold from the last
    contraction, is below the roundoff of the increment."""
    u = starts[..., None, None]
    rate = cycle.rate(u + np.zeros_like(cycle.displacement))
    inside = running_integral(rate, cycle.over)
    evaluations = rate.size
    last, converged = 1.0, False
    for iteration in range(MOST_ITERATIONS):
        rate = cycle.rate(u + inside, rate)
        evaluations += rate.size
        fresh = running_integral(rate, cycle.over)
        end = fresh[..., -1, -1]
        change = float(np.max(np.abs(end - inside[..., -1, -1]) / (end + TINY)))
        inside = fresh
        # A change that was large, or grew, foretells nothing.
        converged = change * min(1.0, change / min(last, 1.0)) <= ROUNDOFF or change <= NOISE
        if converged or not change < 1e30 or (iteration > PATIENCE and change > last):
            break
        last = change
    everywhere = np.full(len(cycle.over.lengths), converged)
    return Advance(integral(rate, cycle.over), inside, rate, evaluations, everywhere)


def _one_by_one(cycle: Cycle, starts: FloatArray, evaluations: int) -> Advance:
    """Picard iteration on each interval of the mesh in its turn."""
    shape = (*starts.shape, *cycle.over.phases.shape)
    inside, rate = np.empty(shape), np.empty(shape)
    converged = np.empty(len(cycle.over.lengths), dtype=bool)
    added = np.zeros(starts.shape)
    for i in range(len(converged)):
        part = cycle.interval(i)
        run = _picard(part, starts + added)
        inside[..., i, :] = added[..., None] + run.inside[..., 0, :]
        rate[..., i, :] = run.rate[..., 0, :]
        converged[i] = run.converged[0]
        added = added + run.increment
        evaluations += run.evaluations
    return Advance(added, inside, rate, evaluations, converged)
