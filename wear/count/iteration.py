"""The integral equation of one cycle, solved for many starts at once.

On each interval of phase v = integral of rate(u + v) is collocated at Gauss-Legendre nodes; v, the
wear since the start, is carried as such, so that an increment of 1e-12 of the wear keeps all its
digits.
"""

from typing import NamedTuple, Protocol

import numpy as np

from wear.count.arithmetic import ROUNDOFF, TINY
from wear.count.collocation import (
    BoolArray,
    FloatArray,
    IntArray,
    Mesh,
    between_nodes,
    integral,
    running,
)

NOISE = 8 * ROUNDOFF  # what rounding alone changes from one iteration to the next
GRAIN = 4 * ROUNDOFF  # of the wear: changes below tell no slope, for they drown in its rounding
MOST_ITERATIONS = 60
PATIENCE = 8  # iterations that may diverge at first


class Paced(Protocol):
    """A stretch of time, on a mesh, with the pace of wear in it."""

    @property
    def over(self) -> Mesh: ...

    @property
    def tolerance(self) -> float:
        """Relative error of the increment at which the iteration may end."""

    def pace(self, u: FloatArray, near: FloatArray | None = None) -> FloatArray:
        """Wear rate in mm per interval of the mesh at wear `u` (..., k, q, m), or (..., k, 1, 1)
        if frozen, sought from a pace `near` by."""


class Cycle(Paced, Protocol):
    """One cycle of one scene or of many, on a mesh of phase."""

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

    def take(self, which: IntArray) -> "Advance":
        """What those of some scenes did."""
        increment, inside, rate, evaluations, converged, left = self
        return Advance(
            increment[which], inside[which], rate[which], evaluations, converged[which], left[which]
        )

    def near(self, m: int) -> Near:
        """The same as a guess for a mesh with `m` nodes on each interval."""
        matrix = between_nodes(self.inside.shape[-1], m)
        apart = np.zeros_like(self.inside[..., :1, :1])
        return Near(self.inside @ matrix, self.rate @ matrix, apart)


def advance(cycle: Cycle, starts: FloatArray, near: Near | None = None) -> Advance:
    """Wear added over the mesh of `cycle`, for each start (..., k).

    All intervals at once where the iteration converges, which takes a wear that changes the
    pressure moderately within the mesh; else one interval after the other.
    """
    run = iterate(cycle, starts, near)
    if run.converged.all() or run.converged.shape[-1] == 1:
        return run
    return _one_by_one(cycle, starts, run.evaluations)


def iterate(cycle: Paced, starts: FloatArray, near: Near | None = None) -> Advance:
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
