"""Least squares: the parameters with which a model is nearest to the readings."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from wear.faults import Faults, UsageError
from wear.fitting.model import LOST, Model
from wear.fitting.readings import Specimen
from wear.load import Blocks
from wear.load.spans import span
from wear.numerics.gauss import FloatArray
from wear.numerics.tolerances import TINY
from wear.regime import fresh_wear_per_cycle, steady_wear_per_cycle

SEARCHED = 20.0  # e-folds, or multiples of a parameter's size, around the scene
GROWTHS, NEARLY = (0.02, 1.0), 0.01  # of roughness: where a start is sought, and how closely
SLOWEST = 1e-3  # of the mean wear per cycle: what the last readings may add
LOOKS = 49  # at the wear of a start, to be compared with the readings
FOLLOWED = 3  # starts
ACCURACY = 1e-3  # of the variance: how closely the least sum of squares is sought
CRAWLING = 0.01  # of the variance: a gain that is not sought further once a step fails
MOST_STEPS = 60
DAMPING, HOPELESS = 1e-3, 1e8  # of a Gauss-Newton step: first, and where none descends


def descend(
    model: Model,
    starts: FloatArray,
    box: tuple[FloatArray, FloatArray],
    say: Callable[[str], None] = lambda _: None,
) -> tuple[FloatArray, FloatArray]:
    """Return points (m, p) of least squares near each start and their sums of squares (m,), in a
    box given by its centre and half widths (p,).

    Levenberg and Marquardt's method (J. Nocedal, S. J. Wright, *Numerical Optimization*, Springer
    2006, section 10.3) with a damping for every start: each round is one batch of scenes, of those
    that still descend.
    """
    low, high = box[0] - box[1], box[0] + box[1]
    points = np.clip(starts, low, high)
    off, slope = model(points)
    costs = np.sum(off**2, axis=1)
    damping, gain = np.tile([[DAMPING], [np.inf]], len(points))
    todo = np.arange(len(points))
    for _ in range(MOST_STEPS):
        say(f"least sum of squares: {costs.min():.6g}, searches left: {len(todo)}")
        J = slope[todo]
        normal = np.swapaxes(J, 1, 2) @ J
        diagonal = np.einsum("mii->mi", normal)  # a view
        diagonal += damping[todo, None] * diagonal + np.where(diagonal > 0.0, 0.0, 1.0)
        step = np.linalg.solve(normal, -np.einsum("mnp,mn->mp", J, off[todo])[..., None])
        trial = np.clip(points[todo] + step[..., 0], low, high)
        trial_off, trial_slope = model(trial)
        trial_costs = np.sum(trial_off**2, axis=1)
        better = trial_costs < costs[todo]
        variance, won = costs[todo] / off.shape[1], todo[better]
        gain[won] = (costs[todo] - trial_costs)[better]
        little = np.abs(costs[todo] - trial_costs) <= ACCURACY * variance
        little |= ~better & (gain[todo] <= CRAWLING * variance)
        points[won], costs[won] = trial[better], trial_costs[better]
        off[won], slope[won] = trial_off[better], trial_slope[better]
        damping[todo] *= np.where(better, 0.1, 8.0)
        todo = todo[~(little | (damping[todo] > HOPELESS))]
        if not len(todo):
            break
    return points, costs


def estimate(model: Model, say: Callable[[str], None]) -> FloatArray:
    """Return the point (p,) of least squares, from several starts.

    They are the scene itself, that with the roughness growth of `_growth`, if this is free, and
    both with wear coefficients by `_in_pace`. Raises `UsageError` where no start has any wear, or a
    parameter no influence.
    """
    own = model.start()
    growths = np.array([p.key.endswith(".roughness_growth") for p in model.parameters])
    starts = own[None]
    if growths.any():
        starts = np.array([own, np.where(growths, _growth(model), own)])
    off, slope = model(starts)
    fine = np.all(np.abs(off) < LOST, axis=1)
    if not fine.any():
        raise UsageError("no start leads to a scene with wear: correct the scene")
    idle = np.all(slope == 0.0, axis=(0, 1))
    nothing = [p for p, none in zip(model.parameters, idle, strict=True) if none]
    Faults(f"free: {p}: has no influence" for p in nothing).stop_if_any()
    starts = np.concatenate([starts, _in_pace(model, starts[fine])])
    best = starts[np.argsort(model.cost(starts), kind="stable")[:FOLLOWED]]
    points, costs = descend(model, best, (own, SEARCHED * model.scale(own)), say)
    return np.asarray(points[np.argmin(costs)])


def _growth(model: Model) -> float:
    """Return the roughness growth with which the wear of a cycle falls by as much, from the fresh
    scene to the steady state of (21), as it does in the readings.

    Readings that begin late or end early see less of the fall: then the growth is too large.
    """
    from scipy.optimize import brentq

    specimen, scene = model.specimens[0], model.scenes(model.start())[0]
    scene = replace(scene, load=span(scene.load, 0).load)
    keys = {p.key for p in model.parameters if p.key.endswith(".roughness_growth")}
    cycles, wear = specimen.cycles, np.maximum(specimen.wear_mm, TINY)
    middle = (len(wear) - 1) // 2
    late = (wear[-1] - wear[middle]) / max(cycles[-1] - cycles[middle], 1.0)
    fall = max(late, SLOWEST * wear[-1] / cycles[-1]) * cycles[0] / wear[0]
    fresh = fresh_wear_per_cycle(scene)

    def excess(growth: float) -> float:
        changed = scene.with_(dict.fromkeys(keys, growth))
        return float(steady_wear_per_cycle(changed) - fall * fresh)

    low, high = GROWTHS
    if not excess(low) < 0.0 < excess(high):
        return low if excess(low) >= 0.0 else high
    return float(brentq(excess, low, high, rtol=NEARLY))


def _in_pace(model: Model, starts: FloatArray) -> FloatArray:
    """Return the starts with free wear coefficients as much larger as their wear is late.

    Averaged over a cycle, wear depends on the product of wear coefficient and cycles alone (the
    first order of the method of averaging), so that one count has all wear coefficients.
    """
    last = max(s.cycles[-1] for s in model.specimens)
    # Blocks are counted one by one: no farther than they were read.
    whole = 1e12 if not isinstance(model.scene.load, Blocks) else last
    decades = np.rint(np.geomspace(1.0, whole, LOOKS))
    level, _ = model.log_wear(starts, [decades] * len(model.specimens))
    level = level.reshape(len(starts), len(model.specimens), -1)
    paced = starts.copy()
    for start, curves in zip(paced, np.fmax.accumulate(level, axis=2), strict=True):
        pairs = list(zip(model.specimens, curves, strict=True))
        for i, p in enumerate(model.parameters):
            if p.key.endswith(".wear_coefficient"):
                start[i] += np.mean(
                    [_late(s, decades, u) for s, u in pairs if p.specimen in ("", s.name)]
                )
    return paced[np.isfinite(paced).all(axis=1)]


def _late(specimen: Specimen, decades: FloatArray, log_wear: FloatArray) -> float:
    """Return the mean logarithm of the cycles at which a curve over the `decades` has the wear that
    was read, over the cycles at which it was."""
    read = np.log(np.maximum(specimen.wear_mm, 1e-30))
    there = np.interp(read, log_wear, np.log(decades))
    return float(np.mean(there - np.log(specimen.cycles)))
