"""Nonlinear least squares: the parameters with the smallest sum of squared residuals."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from wear.faults import Faults, UsageError
from wear.fitting.model import FitModel, Linearised
from wear.fitting.readings import Specimen
from wear.load import Blocks
from wear.load.spans import span
from wear.numerics.floating_point import TINY
from wear.numerics.gauss import FloatArray
from wear.numerics.rows import stacked, take
from wear.regime import fresh_wear_per_cycle, steady_wear_per_cycle

SEARCH_RANGE = 20.0  # e-folds, or multiples of a parameter's size, around the scene
GROWTHS, GROWTH_RTOL = (0.02, 1.0), 0.01  # of roughness: range and accuracy of a start
LEAST_LATE_RATE = 1e-3  # of the mean wear per cycle: least wear per cycle in the last readings
CURVE_POINTS = 49  # of the wear of a start, to be compared with the readings
FOLDS = (-4.0, -2.0, 2.0, 4.0)  # e-folds from the wear coefficients of the scene to other starts
DESCENTS = 3  # from the best starts
ACCURACY = 1e-3  # of the variance: accuracy of the least sum of squares
SMALL_GAIN = 0.01  # of the variance: after a smaller gain the first failing step ends a descent
MOST_STEPS = 60
DAMPING, MOST_DAMPING = 1e-3, 1e8  # of a Gauss-Newton step: first, and where a descent ends


def descend(
    model: FitModel,
    starts: Linearised,
    box: tuple[FloatArray, FloatArray],
    say: Callable[[str], None] = lambda _: None,
) -> Linearised:
    """Return the points of least squares near each start, in a box given by its centre and half
    widths (p,).

    Levenberg and Marquardt's method (J. Nocedal, S. J. Wright, *Numerical Optimization*, Springer
    2006, section 10.3) with a damping for every start: each round is one batch of scenes, of those
    that still descend.
    """
    low, high = box[0] - box[1], box[0] + box[1]
    found, number = starts, starts.residuals.shape[1]
    damping, gain = np.tile([[DAMPING], [np.inf]], len(starts.theta))
    active = np.arange(len(starts.theta))
    for _ in range(MOST_STEPS):
        say(f"least sum of squares: {found.costs.min():.6g}, searches left: {len(active)}")
        here = take(found, active)
        trial = model(np.clip(here.theta + _step(here, damping[active]), low, high))
        better = trial.costs < here.costs
        change, variance, improved = here.costs - trial.costs, here.costs / number, active[better]
        gain[improved] = change[better]
        converged = np.abs(change) <= ACCURACY * variance
        converged |= ~better & (gain[active] <= SMALL_GAIN * variance)
        found = found.with_rows(improved, take(trial, better))
        damping[active] *= np.where(better, 0.1, 8.0)
        active = active[~(converged | (damping[active] > MOST_DAMPING))]
        if not len(active):
            break
    return found


def _step(at: Linearised, damping: FloatArray) -> FloatArray:
    """Return the damped steps (m, p) to the least sums of squares of the linearised model."""
    normal = np.swapaxes(at.slope, 1, 2) @ at.slope
    diagonal = np.einsum("mii->mi", normal)  # a view
    diagonal += damping[:, None] * diagonal + np.where(diagonal > 0.0, 0.0, 1.0)
    gradient = np.einsum("mnp,mn->mp", at.slope, at.residuals)
    return np.asarray(-np.linalg.solve(normal, gradient[..., None])[..., 0])


def estimate(model: FitModel, say: Callable[[str], None]) -> Linearised:
    """Return the point of least squares, from several starts.

    These are the scene itself, the scene with the roughness growth of `_starting_growth` if that is
    free, both with wear coefficients by `_with_matched_pace`, which need not suit where another
    solid wears too, and the scene with smaller and larger ones. Raises `UsageError` if no start has
    any wear, or a parameter has no influence.
    """
    centre = model.start()
    growths = np.array([p.key.endswith(".roughness_growth") for p in model.parameters])
    starts = centre[None]
    if growths.any():
        starts = np.array([centre, np.where(growths, _starting_growth(model), centre)])
    first = model(starts)
    finite = np.all(np.abs(first.residuals) < model.residuals.missing, axis=1)
    if not finite.any():
        raise UsageError("no start leads to a scene with wear: correct the scene")
    idle = np.all(first.slope == 0.0, axis=(0, 1))
    parameters = zip(model.parameters, idle.tolist(), strict=True)
    Faults(f"free: {p}: has no influence" for p, none in parameters if none).stop_if_any()
    worn = np.array([p.key.endswith(".wear_coefficient") for p in model.parameters])
    others = centre + np.outer(FOLDS, worn) if worn.any() else np.empty((0, len(centre)))
    others = np.concatenate([_with_matched_pace(model, starts[finite]), others])
    costs = np.concatenate([first.costs, model.cost(others)])
    best = np.argsort(costs, kind="stable")[:DESCENTS]
    new = model(others[best[best >= len(starts)] - len(starts)])
    starting = stacked([take(first, best[best < len(starts)]), new])
    found = descend(model, starting, (centre, SEARCH_RANGE * model.scale(centre)), say)
    return take(found, np.array([np.argmin(found.costs)]))


def _starting_growth(model: FitModel) -> float:
    """Return the roughness growth at which the ratio of the steady wear per cycle, (21), to the
    initial one is that in the readings.

    Readings that begin late or end early show less of the decrease: then the growth is too large.
    """
    from scipy.optimize import brentq

    specimen, scene = model.specimens[0], model.scenes(model.start())[0]
    scene = replace(scene, load=span(scene.load, 0).load)
    keys = {p.key for p in model.parameters if p.key.endswith(".roughness_growth")}
    cycles, wear = specimen.cycles, np.maximum(specimen.wear_mm, TINY)
    middle = (len(wear) - 1) // 2
    late = (wear[-1] - wear[middle]) / max(cycles[-1] - cycles[middle], 1.0)
    ratio = max(late, LEAST_LATE_RATE * wear[-1] / cycles[-1]) * cycles[0] / wear[0]
    initial = fresh_wear_per_cycle(scene)

    def excess(growth: float) -> float:
        changed = scene.with_(dict.fromkeys(keys, growth))
        return float(steady_wear_per_cycle(changed) - ratio * initial)

    low, high = GROWTHS
    if not excess(low) < 0.0 < excess(high):
        return low if excess(low) >= 0.0 else high
    return float(brentq(excess, low, high, rtol=GROWTH_RTOL))


def _with_matched_pace(model: FitModel, starts: FloatArray) -> FloatArray:
    """Return the starts with free wear coefficients multiplied by the delay of their wear.

    Averaged over a cycle, wear depends on the product of wear coefficient and cycles alone (the
    first order of the method of averaging), so that one count serves all wear coefficients.
    """
    last = max(s.cycles[-1] for s in model.specimens)
    # Blocks are counted one by one: no farther than they were read.
    farthest = 1e12 if not isinstance(model.scene.load, Blocks) else last
    grid = np.rint(np.geomspace(1.0, farthest, CURVE_POINTS))
    level, _ = model.log_wear(starts, [grid] * len(model.specimens), derivatives=False)
    level = level.reshape(len(starts), len(model.specimens), -1)
    matched = starts.copy()
    for start, curves in zip(matched, np.fmax.accumulate(level, axis=2), strict=True):
        pairs = list(zip(model.specimens, curves, strict=True))
        for i, p in enumerate(model.parameters):
            if p.key.endswith(".wear_coefficient"):
                start[i] += np.mean(
                    [_mean_log_delay(s, grid, u) for s, u in pairs if p.specimen in ("", s.name)]
                )
    return matched[np.isfinite(matched).all(axis=1)]


def _mean_log_delay(specimen: Specimen, grid: FloatArray, log_wear: FloatArray) -> float:
    """Return the mean logarithm of a ratio of cycles: of those at which a curve over a `grid` of
    cycles reaches the measured wear, to those of the readings."""
    read = np.log(np.maximum(specimen.wear_mm, 1e-30))
    log_cycles = np.interp(read, log_wear, np.log(grid))
    return float(np.mean(log_cycles - np.log(specimen.cycles)))
