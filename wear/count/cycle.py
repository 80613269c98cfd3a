"""The one-cycle map u -> P(u): the wear that one cycle adds, for many starts at once.

A cycle is cut into intervals of phase; on each the solution is collocated at Gauss-Legendre nodes
and the integral equation v = integral of rate(u + v, U_a) is solved by iteration over all nodes and
all starts together. The wear v since the start is carried as such, so that an increment
of 1e-12 of the wear keeps all its digits.
"""

from typing import NamedTuple, Protocol

import numpy as np

from wear.count.collocation import (
    BoolArray,
    FloatArray,
    Mesh,
    between_nodes,
    integral,
    mesh,
    running,
)
from wear.load import Load
from wear.model import Model

ROUNDOFF = float(np.finfo(float).eps)
TINY = float(np.finfo(float).tiny)
MOST_INTERVALS = 256  # of one cycle
NOISE = 8 * ROUNDOFF  # what rounding alone changes from one iteration to the next
NOISE_AT_ENDS = 1e-12  # of a series extrapolated to the ends of its interval
GRAIN = 4 * ROUNDOFF  # of the wear: changes below tell no slope, for they drown in its rounding
MOST_ITERATIONS = 60
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
    phase_nodes, panel_nodes = (24, 48) if rtol < 1e-8 else (14, 24)
    return Settings(
        phase_nodes,
        phase_tolerance=max(1e-2 * rtol, ROUNDOFF),
        panel_nodes=panel_nodes,
        tail_tolerance=max(rtol / 4, 1e-12),
        residual_tolerance=max(rtol / 4, 30 * ROUNDOFF),
    )


class Cycle(Protocol):
    """One cycle of one scene or of many, on a mesh of phase."""

    @property
    def over(self) -> Mesh: ...

    @property
    def tolerance(self) -> float:
        """Relative error of the increment at which the iteration may end."""

    def pace(self, u: FloatArray, near: FloatArray | None = None) -> FloatArray:
        """Wear rate in mm per interval of the mesh at wear `u` (..., k, q, m), or (..., k, 1, 1)
        if frozen, sought from a pace `near` by."""

    def interval(self, i: int) -> "Cycle":
        """The part over one interval of the mesh."""


class Near(NamedTuple):
    """What is known nearly: the wear `inside` the cycle (..., k, q, m) in mm, and the `rate` (mm
    per cycle, same shape) where the wear was by `apart` (mm, broadcasts) less than it will be."""

    inside: FloatArray
    rate: FloatArray
    apart: FloatArray


class Advance(NamedTuple):
    """What cycles did: `increment` (..., k) mm; at the nodes (..., k, q, m) the wear since the
    start `inside` (mm) and the `rate` (mm per cycle); the number of right-hand sides evaluated; on
    which intervals (..., q) the iteration converged; and the relative error of the increments
    (..., k) that it may have `left`."""

    increment: FloatArray
    inside: FloatArray
    rate: FloatArray
    evaluations: int
    converged: BoolArray
    left: FloatArray

    def near(self, m: int) -> Near:
        """The same as a guess for a mesh with `m` nodes on each interval."""
        matrix = between_nodes(self.inside.shape[-1], m)
        apart = np.zeros_like(self.inside[..., :1, :1])
        return Near(self.inside @ matrix, self.rate @ matrix, apart)


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

    def advance(self, starts: FloatArray, near: Near | None = None) -> Advance:
        """Wear added by one cycle from each start, mm, any shape; from a guess with the shape
        (starts.size, q, m)."""

    def frozen(self, wear: FloatArray) -> FloatArray:
        """Wear (mm) added by one cycle if the rate did not feel it, any shape."""

    def several(self, start: float, number: int) -> Advance:
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

    def pace(self, u: FloatArray, near: FloatArray | None = None) -> FloatArray:
        """Wear rate in mm per interval at wear `u` (..., q, m), sought from a pace `near` by."""
        return pace(self.model, u, self.displacement, self.load.period, self.over, near)

    @property
    def most_intervals(self) -> int:
        """Where refining stops: the load is too rough to be resolved."""
        return MOST_INTERVALS

    def on(self, over: Mesh) -> "Drive":
        """The same on another mesh."""
        return self._replace(over=over, displacement=self.load(over.phases))

    def resolved(self, wear: FloatArray, m: int, tolerance: float) -> "Drive":
        """On a mesh of m nodes an interval that resolves the rate at each wear (k,)."""
        return self.on(resolve(self.model, self.load, wear, m, tolerance))

    def advance(self, starts: FloatArray, near: Near | None = None) -> Advance:
        """Wear added over the mesh from each start, any shape."""
        run = advance(self, starts.ravel(), near)
        shape = (*starts.shape, *self.over.phases.shape)
        return run._replace(
            increment=run.increment.reshape(starts.shape),
            inside=run.inside.reshape(shape),
            rate=run.rate.reshape(shape),
            left=run.left.reshape(starts.shape),
        )

    def frozen(self, wear: FloatArray) -> FloatArray:
        """Wear (mm) added over the mesh if the rate did not feel it."""
        return integral(self.rate(wear[..., None, None]), self.over)

    def several(self, start: float, number: int) -> Advance:
        """Cycles on end, all at once on copies of the mesh of one."""
        over = self.over
        edges = np.concatenate([over.edges[:-1] + k for k in range(number)] + [[float(number)]])
        run = advance(self.on(mesh(edges, len(over.rule.nodes))), np.array([start]))
        rate = run.rate.reshape(number, *over.phases.shape)
        added = integral(rate, over)
        before = np.cumsum(added) - added
        return Advance(
            added,
            run.inside.reshape(rate.shape) - before[:, None, None],
            rate,
            run.evaluations,
            np.logical_and.reduce(run.converged.reshape(number, -1), axis=0),
            np.repeat(run.left, number),
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
    """Which intervals (..., q) do not resolve the rate (..., k, q, m) of every start.

    Gauss quadrature leaves what two truncated series have in common: on an interval, the square of
    its last Legendre coefficients over its largest. That is held against the increment.
    """
    flat = rate.reshape(-1, rate.shape[-1])
    series = np.abs(flat @ over.rule.coefficients.T).reshape(rate.shape)
    largest = np.max(series, axis=-1) + TINY
    last = np.max(series[..., -3:], axis=-1)
    left = last**2 / largest * over.lengths
    # Rounding of the largest coefficients looks like a tail: it is none.
    left[largest * ROUNDOFF * 100 > last] = 0.0
    rough: BoolArray = np.any(left > tolerance * integral(rate, over)[..., None], axis=-2)
    return rough


def hidden(
    rate: FloatArray, left: FloatArray, right: FloatArray, over: Mesh, tolerance: float
) -> BoolArray:
    """Which intervals (..., q) hide a change of the rate (..., k, q, m) between an end and the
    nodes; `left` and `right` (..., k, q) are the rates at their ends.

    Fast wear may have opened the gap before the first node: then nothing but the rate at the start
    of the interval tells. The measure is that of `unresolved`.
    """
    m = rate.shape[-1]
    series = (rate.reshape(-1, m) @ over.rule.coefficients.T).reshape(rate.shape)
    apart = np.maximum(
        np.abs(series @ (-1.0) ** np.arange(m) - left), np.abs(np.sum(series, axis=-1) - right)
    )
    largest = np.max(np.abs(series), axis=-1) + TINY
    missed = apart * (apart / largest) * over.lengths
    missed[apart < NOISE_AT_ENDS * largest] = 0.0
    rough: BoolArray = np.any(missed > tolerance * integral(rate, over)[..., None], axis=-2)
    return rough


def refined(over: Mesh, rough: BoolArray) -> Mesh:
    """The mesh with the intervals `rough` (q,) cut in two."""
    middles = (over.edges[:-1] + over.edges[1:])[rough] / 2
    return mesh(np.sort(np.concatenate([over.edges, middles])), len(over.rule.nodes))


def advance(cycle: Cycle, starts: FloatArray, near: Near | None = None) -> Advance:
    """Wear added over the mesh of `cycle`, for each start (..., k).

    All intervals at once where the iteration converges, which takes a wear that changes the
    pressure moderately within the mesh; else one interval after the other.
    """
    run = iterate(cycle, starts, near)
    if run.converged.all() or run.converged.shape[-1] == 1:
        return run
    return _one_by_one(cycle, starts, run.evaluations)


def iterate(cycle: Cycle, starts: FloatArray, near: Near | None = None) -> Advance:
    """Solve v = integral of rate(u + v) by Newton's method with the slope of the last two rates.

    It ends when the next change, foretold from the last contraction, is below the tolerance. Wear
    that rises from start to start feels itself less and less: the last starts are done first, and
    the iteration goes on with those before.
    """
    lengths, u = cycle.over.lengths[..., None], starts[..., None, None]
    evaluations = 0
    if near is None:
        before = cycle.pace(u)
        evaluations = before.size
        v, contraction = _guess(starts, running(before))
        apart = v
    else:
        v, before, apart = near.inside, near.rate * lengths, near.apart
        contraction = np.ones(starts.shape)
    inside, rates, remainder = np.empty_like(v), np.empty_like(v), np.empty(starts.shape)
    going, last = starts.shape[-1], None
    for iteration in range(MOST_ITERATIONS):
        wear = u + v
        rate = cycle.pace(wear, before)
        evaluations += rate.size
        slope = rate - before
        slope *= apart
        apart = apart * apart
        apart += (GRAIN * wear[..., -1:, -1:]) ** 2 + TINY
        slope /= apart
        missing = running(rate)
        missing -= v
        step = _solved(slope, missing)
        v = v + step
        change = np.max(np.abs(step).reshape(*step.shape[:-2], -1), axis=-1)
        change /= np.abs(v[..., -1, -1]) + TINY
        if last is not None:
            contraction = change / last
        elif near is None:
            contraction = np.maximum(contraction, change)  # what is foretold may be too good
        next_change = change * np.minimum(contraction, 1.0)
        done = next_change <= cycle.tolerance
        if iteration > PATIENCE:
            done |= ~(contraction < 1.0)
        more = np.nonzero(~done)[-1]
        left = int(more.max()) + 1 if len(more) and iteration + 1 < MOST_ITERATIONS else 0
        if left < going:
            remainder[..., left:going] = next_change[..., left:]
            inside[..., left:going, :, :] = v[..., left:, :, :]
            part = (..., slice(left, None), slice(None), slice(None))
            rates[..., left:going, :, :] = (rate[part] + slope[part] * step[part]) / lengths
        if left == 0:
            break
        v, before, apart, u = (x[..., :left, :, :] for x in (v, rate, step, u))
        last, going = np.minimum(change, 1.0)[..., :left] + TINY, left
    converged = np.all(remainder <= cycle.tolerance, axis=-1)[..., None]
    everywhere = np.repeat(converged, lengths.shape[-2], axis=-1)
    return Advance(integral(rates, cycle.over), inside, rates, evaluations, everywhere, remainder)


def _guess(starts: FloatArray, frozen: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The wear inside cycles from the `starts` (..., k), from what it is without feedback: `frozen`
    (..., k, q, m); and by how much the first step of the iteration will reduce the error (..., k),
    zero where that is not known.

    If the rate fell by a factor e over the wear 1/a, the wear would be ln(1 + a frozen)/a.
    """
    ends = frozen[..., -1, -1]
    feedback = np.zeros(starts.shape)
    if starts.shape[-1] > 2:
        fall = -np.diff(np.log(ends)) / np.diff(starts)
        feedback[..., 1:-1] = (fall[..., 1:] + fall[..., :-1]) / 2
        feedback[..., 0], feedback[..., -1] = fall[..., 0], fall[..., -1]
        feedback *= ends
        feedback[~np.isfinite(feedback)] = 0.0
        np.clip(feedback, -1.0, 20.0, out=feedback)
    shape = (feedback / (2 * ends + TINY))[..., None, None]
    return frozen / (1.0 + shape * frozen), feedback**2


def _solved(slope: FloatArray, missing: FloatArray) -> FloatArray:
    """The solution x of x = missing + integral of slope x, all (..., q, m)."""
    factor = running(slope)
    np.exp(factor, out=factor)
    part = slope * missing
    part /= factor
    x = running(part)
    x *= factor
    x += missing
    return x


def _one_by_one(cycle: Cycle, starts: FloatArray, evaluations: int) -> Advance:
    """The iteration on each interval of the mesh in its turn."""
    parts: list[Advance] = []
    added = np.zeros(starts.shape)
    for i in range(cycle.over.lengths.shape[-1]):
        run = iterate(cycle.interval(i), starts + added)
        parts.append(run._replace(inside=added[..., None, None] + run.inside))
        added = added + run.increment
        evaluations += run.evaluations
    return Advance(
        added,
        np.concatenate([part.inside for part in parts], axis=-2),
        np.concatenate([part.rate for part in parts], axis=-2),
        evaluations,
        np.concatenate([part.converged for part in parts], axis=-1),
        np.sum([part.left for part in parts], axis=0),
    )
