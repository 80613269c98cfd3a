"""Least squares: the parameters with which a model is nearest to the readings."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from wear.faults import UsageError
from wear.fitting.model import LOST, Model
from wear.fitting.readings import FloatArray, Specimen

SEARCHED = 20.0  # e-folds, or multiples of a parameter's size, around the scene
GROWTHS = (0.08, 0.15, 0.25, 0.4)  # of roughness, to start from
DECADES = np.geomspace(1.0, 1e12, 49)  # cycles after which a start is compared with the readings
FOLLOWED = 4  # starts
ROUGHLY, CLOSELY = 1e-4, 1e-6  # of the sum of squares: how closely its least is sought
DAMPING, HOPELESS = 1e-3, 1e8  # of a Gauss-Newton step: first, and where none descends


def follow(
    model: Model,
    starts: FloatArray,
    fixed: NDArray[np.bool_],
    box: tuple[FloatArray, FloatArray],
    accuracy: float,
    most: int,
    say: Callable[[str], None] = lambda _: None,
) -> tuple[FloatArray, FloatArray]:
    """Return points (m, p) of least squares near each start and their sums of squares (m,),
    with the `fixed` (m, p) parameters held, in a box given by its centre and half widths (p,).

    Levenberg and Marquardt's method (J. Nocedal, S. J. Wright, *Numerical Optimization*,
    Springer 2006, section 10.3) with a damping for every start: each round is one batch of
    scenes, of those that still descend by more than the `accuracy` of their sum of squares.
    """
    low, high = box[0] - box[1], box[0] + box[1]
    points = np.where(fixed, starts, np.clip(starts, low, high))
    off, slope = model(points)
    costs = np.sum(off**2, axis=1)
    damping, todo = np.full(len(points), DAMPING), np.arange(len(points))
    for _ in range(most):
        say(f"least sum of squares: {costs.min():.6g}, searches left: {len(todo)}")
        J = np.where(fixed[todo, None], 0.0, slope[todo])
        normal = np.swapaxes(J, 1, 2) @ J
        diagonal = np.einsum("mii->mi", normal)  # a view
        diagonal += damping[todo, None] * diagonal + np.where(diagonal > 0.0, 0.0, 1.0)
        step = np.linalg.solve(normal, -np.einsum("mnp,mn->mp", J, off[todo])[..., None])
        trial = np.clip(points[todo] + step[..., 0], low, high)
        trial = np.where(fixed[todo], points[todo], trial)
        trial_off, trial_slope = model(trial)
        trial_costs = np.sum(trial_off**2, axis=1)
        better = trial_costs < costs[todo]
        little = np.abs(costs[todo] - trial_costs) <= accuracy * costs[todo]
        won = todo[better]
        points[won], costs[won] = trial[better], trial_costs[better]
        off[won], slope[won] = trial_off[better], trial_slope[better]
        damping[todo] *= np.where(better, 0.1, 8.0)
        todo = todo[~(little | (damping[todo] > HOPELESS))]
        if not len(todo):
            break
    return points, costs


def estimate(model: Model, say: Callable[[str], None]) -> FloatArray:
    """Return the point (p,) of least squares, from several starts.

    Each start has another roughness growth, where that is shared and free. What else is free of
    wear coefficients and roughnesses then follows from the readings, see `_in_pace` and
    `_in_proportion`. Raises `UsageError` where no start has any wear, or a parameter no influence.
    """
    starts = _starts(model)
    off, slope = model(starts)
    fine = np.all(np.abs(off) < LOST, axis=1)
    if not fine.any():
        raise UsageError("no start leads to a scene with wear: correct the scene")
    idle = np.all(slope == 0.0, axis=(0, 1))
    if idle.any():
        names = [str(p) for p, none in zip(model.parameters, idle, strict=True) if none]
        raise UsageError("\n".join(f"free: {name}: has no influence" for name in names))
    starts = np.concatenate(
        [starts, _in_pace(model, starts[fine]), _in_proportion(model, starts[fine])]
    )
    best = starts[np.argsort(model.cost(starts), kind="stable")[:FOLLOWED]]
    centre = model.start()
    box = centre, SEARCHED * model.scale(centre)
    near, costs = follow(model, best, np.zeros(best.shape, dtype=bool), box, ROUGHLY, 30, say)
    return settle(model, near[np.argmin(costs)], box, say)


def settle(
    model: Model,
    start: FloatArray,
    box: tuple[FloatArray, FloatArray],
    say: Callable[[str], None] = lambda _: None,
) -> FloatArray:
    """Return the point (p,) of least squares next to a point."""
    none = np.zeros((1, len(start)), dtype=bool)
    points, _ = follow(model, start[None], none, box, CLOSELY, 60, say)
    return np.asarray(points[0])


def _starts(model: Model) -> FloatArray:
    """Return the scene's own point, and those with other roughness growths."""
    own = model.start()
    growths = [p.key.endswith(".roughness_growth") for p in model.parameters]
    return np.unique([own, *(np.where(growths, growth, own) for growth in GROWTHS)], axis=0)


def _in_pace(model: Model, starts: FloatArray) -> FloatArray:
    """Return the starts with free wear coefficients as much larger as their wear is late.

    Averaged over a cycle, wear depends on the product of wear coefficient and cycles alone (the
    first order of the method of averaging), so that one count has all wear coefficients.
    """
    level, _ = model.log_wear(starts, [DECADES] * len(model.specimens))
    level = level.reshape(len(starts), len(model.specimens), -1)
    paced = starts.copy()
    for start, curves in zip(paced, np.fmax.accumulate(level, axis=2), strict=True):
        pairs = list(zip(model.specimens, curves, strict=True))
        for i, p in enumerate(model.parameters):
            if p.key.endswith(".wear_coefficient"):
                start[i] += np.mean([_late(s, u) for s, u in pairs if p.specimen in ("", s.name)])
    return paced[np.isfinite(paced).all(axis=1)]


def _late(specimen: Specimen, log_wear: FloatArray) -> float:
    """Return the mean logarithm of the cycles at which a curve over the DECADES has the wear that
    was read, over the cycles at which it was."""
    read = np.log(np.maximum(specimen.wear_mm, 1e-30))
    there = np.interp(read, log_wear, np.log(DECADES))
    return float(np.mean(there - np.log(specimen.cycles)))


def _in_proportion(model: Model, starts: FloatArray) -> FloatArray:
    """Return the starts with free roughnesses as much larger as the last wear read is."""
    level, _ = model.log_wear(starts, [s.cycles[-1:] for s in model.specimens])
    wear = np.array([max(s.wear_mm[-1], 1e-30) for s in model.specimens])
    off = np.log(wear) - level
    scaled = starts.copy()
    for i, p in enumerate(model.parameters):
        if p.key.endswith(".roughness_mm"):
            own = [p.specimen in ("", s.name) for s in model.specimens]
            scaled[:, i] += off[:, own].mean(axis=1)
    return scaled
