"""The one-cycle map u -> P(u): the wear that one cycle adds, for many starts at once.

A cycle is cut into intervals of phase and solved on them by collocation.
"""

from itertools import pairwise
from typing import NamedTuple, Protocol

import numpy as np

from wear.load import Load
from wear.model import Model
from wear.numerics.collocation import (
    NOISE,
    CycleSolution,
    InitialGuess,
    iterate,
    refined,
    unresolved,
)
from wear.numerics.gauss import (
    FloatArray,
    Mesh,
    integral,
    mesh,
)
from wear.numerics.tolerances import (
    ROUNDOFF,
)

MOST_INTERVALS = 256  # of one cycle
COARSEST = 1e-6  # relative error: coarser meshes of phase would not tell what they miss


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
    phase_tolerance: float  # of `unresolved`, which mostly tells ten times the error and more
    strict_tolerance: float  # of what nothing else would tell, or mend
    panel_nodes: int  # on each panel of wear
    tail_tolerance: float  # of the frozen density on a panel
    residual_tolerance: float  # of Abel's equation

    @property
    def finer_nodes(self) -> int:
        """Nodes on each interval of phase for the map that judges."""
        return self.phase_nodes + 6


def settings(rtol: float) -> Settings:
    """Few nodes for few digits: what is cheapest for `rtol` on smooth loads."""
    phase_nodes, panel_nodes = (24, 48) if rtol < 1e-8 else (16, 24)
    return Settings(
        phase_nodes=phase_nodes,
        phase_tolerance=max(2 * min(rtol, COARSEST), ROUNDOFF),
        strict_tolerance=max(1e-2 * min(rtol, COARSEST), ROUNDOFF),
        panel_nodes=panel_nodes,
        tail_tolerance=max(rtol / 4, 1e-12),
        residual_tolerance=max(rtol / 4, 30 * ROUNDOFF),
    )


class OneCycle(Protocol):
    """The one-cycle map of a scene, on a mesh that can be changed."""

    @property
    def over(self) -> Mesh: ...

    @property
    def most_intervals(self) -> int:
        """Where refining stops."""

    def on(self, over: Mesh) -> "OneCycle":
        """The same on another mesh."""

    def resolved(self, wear: FloatArray, size: Settings) -> "OneCycle":
        """On a mesh that suits the wear values (k,), mm."""

    def advance(self, starts: FloatArray, near: InitialGuess | None = None) -> CycleSolution:
        """Wear added by one cycle from each start, mm, any shape (...); from a guess with the shape
        (..., q, m)."""

    def frozen(self, wear: FloatArray) -> FloatArray:
        """Wear (mm) added by one cycle if the rate did not feel it, any shape."""

    def several(self, start: float, number: int) -> CycleSolution:
        """Some cycles on end; increments have shape (number,), the rest (number, q, m), the wear
        inside each cycle since its own start."""


class Drive(NamedTuple):
    """A model under a load, sampled at the phases of a mesh: all that one cycle needs."""

    model: Model
    load: Load
    over: Mesh
    displacement: FloatArray  # (q, m), mm
    tolerance: float = NOISE

    def rate(self, u: FloatArray) -> FloatArray:
        """Wear rate in mm per cycle at wear `u` (..., q, m)."""
        rate: FloatArray = self.model.rate(u, self.displacement)
        return self.load.period * rate

    def rate_per_interval(self, u: FloatArray, near: FloatArray | None = None) -> FloatArray:
        """Wear rate in mm per interval at wear `u` (..., q, m), sought from a pace `near` by."""
        return pace(self.model, u, self.displacement, self.load.period, self.over, near)

    @property
    def most_intervals(self) -> int:
        """Where refining stops: the load is too rough to be resolved."""
        return MOST_INTERVALS

    def on(self, over: Mesh) -> "Drive":
        """The same on another mesh."""
        return self._replace(over=over, displacement=self.load(over.phases))

    def resolved(self, wear: FloatArray, size: Settings) -> "Drive":
        """On a mesh that resolves the rate at each wear (k,)."""
        nodes, tolerance = size.phase_nodes, size.phase_tolerance
        return self.on(resolve(self.model, self.load, wear, nodes, tolerance))

    def advance(self, starts: FloatArray, near: InitialGuess | None = None) -> CycleSolution:
        """Wear added over the mesh from each start, any shape."""
        if near is not None:
            near = InitialGuess(*(array.reshape(starts.size, *array.shape[-2:]) for array in near))
        run = iterate(self, starts.ravel(), near)
        shape = (*starts.shape, *self.over.phases.shape)
        return run._replace(
            increment=run.increment.reshape(starts.shape),
            inside=run.inside.reshape(shape),
            rate=run.rate.reshape(shape),
            iteration_error=run.iteration_error.reshape(starts.shape),
        )

    def growth(self, wear: FloatArray) -> FloatArray:
        """By how much cycles with the `wear` (..., q, m) inside change a small difference in it."""
        return growth(self.model, wear, self.displacement, self.load.period, self.over)

    def frozen(self, wear: FloatArray) -> FloatArray:
        """Wear (mm) added over the mesh if the rate did not feel it."""
        return integral(self.rate(wear[..., None, None]), self.over)

    def several(self, start: float, number: int) -> CycleSolution:
        """Cycles on end, all at once on copies of the mesh of one."""
        over = self.over
        edges = np.concatenate([over.edges[:-1] + k for k in range(number)] + [[float(number)]])
        run = iterate(self.on(mesh(edges, len(over.rule.nodes))), np.array([start]))
        rate = run.rate.reshape(number, *over.phases.shape)
        added = integral(rate, over)
        before = np.cumsum(added) - added
        return CycleSolution(
            added,
            run.inside.reshape(rate.shape) - before[:, None, None],
            rate,
            run.evaluations,
            np.logical_and.reduce(run.converged.reshape(number, -1), axis=0),
            np.repeat(run.iteration_error, number),
        )

    def interval(self, i: int) -> "Drive":
        """The part over one interval of the mesh."""
        return self._replace(over=self.over.interval(i), displacement=self.displacement[i : i + 1])


def pace(
    model: Model,
    u: FloatArray,
    displacement: FloatArray,
    period: float | FloatArray,
    over: Mesh,
    near: FloatArray | None,
) -> FloatArray:
    """Wear rate in mm per interval of the mesh `over`, sought from a pace `near` by."""
    scale = period * over.lengths[..., None]
    known = near / scale if model.compliant and near is not None else None
    result: FloatArray = model.rate(u, displacement, known) * scale
    return result


def growth(
    model: Model,
    wear: FloatArray,
    displacement: FloatArray,
    period: float | FloatArray,
    over: Mesh,
) -> FloatArray:
    """The factor (...) by which a small difference in the `wear` (..., q, m) changes over the mesh
    `over`: the solution of the linearised equation."""
    factor: FloatArray = np.exp(integral(period * model.slope(wear, displacement), over))
    return factor


def drive(model: Model, load: Load, over: Mesh) -> Drive:
    """Sample the load on a mesh."""
    return Drive(model, load, over, load(over.phases))


def first_edges(load: Load) -> FloatArray:
    """Ends of intervals that no node may straddle (kinks), should cluster at (peaks), or where a
    smooth pulse ends, about: a quarter of the way to the next peak."""
    inner = {*load.kinks, *load.peaks}
    if not load.kinks and load.minimum < load.maximum:
        for peak, after in pairwise([*load.peaks, load.peaks[0] + 1.0]):
            quarter = (after - peak) / 4
            inner |= {(peak + quarter) % 1.0, (after - quarter) % 1.0}
    return np.array([0.0, *sorted(x for x in inner if 1e-9 < x < 1.0 - 1e-9), 1.0])


def resolve(model: Model, load: Load, starts: FloatArray, m: int, tolerance: float) -> Mesh:
    """A mesh of m nodes an interval on which the rate at each frozen wear (k,) is resolved."""
    over = mesh(first_edges(load), m)
    while len(over.lengths) < MOST_INTERVALS:
        rough = unresolved(drive(model, load, over).rate(starts[:, None, None]), over, tolerance)
        if not rough.any():
            break
        over = refined(over, rough)
    return over
