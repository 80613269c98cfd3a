"""A rough look ahead with the wear frozen over each cycle: how far it goes, where panels end.

Frozen wear makes the increment of a cycle a plain integral. That is too coarse for a result and
good enough for a plan; what the plan misses, the residual of Abel's equation finds.
"""

import numpy as np

from wear.count.cutoff import CutoffCycle
from wear.model import Model
from wear.numerics.gauss import (
    FloatArray,
)
from wear.numerics.tolerances import (
    TINY,
)
from wear.orbit.period_map import settings

LEAST = 200.0  # the last panel reaches this count at least: panels are long against a cycle
STEP, STEPS = 0.2, 180  # in ln(u + scale)
SHIFT = 12.0  # of panels, over the scale: then one serves every regime to the end
ROUGH = settings(1e-3)._replace(phase_nodes=10)
NEARLY = 0.99  # of the wear at which the roughness vanishes


def roughness_scale(model: Model) -> float:
    """Return a wear (mm) that changes the pressure by a factor of order 1: a quarter of the
    roughness."""
    return float(model.fields(np.array(0.0), np.array(0.0)).sigma) / 4


def roughness_limit(model: Model, upto: float) -> float:
    """Nearly the wear (mm) at which the equivalent roughness vanishes; infinite if it does not."""
    return float(roughness_limits(model, np.array([upto]))[0])


def roughness_limits(model: Model, upto: FloatArray) -> FloatArray:
    """Return the same of each of many scenes (scenes, 1).

    The roughness of one solid is linear in the wear; that of two never vanishes.
    """
    start, end = (model.fields(wear, np.zeros_like(wear)).sigma for wear in (0.0 * upto, upto))
    lost = np.where(end <= 0, start - end, 1.0)
    return np.where(end <= 0, NEARLY * upto * start / lost, np.inf)


def frozen_density(cycle: CutoffCycle, wear: FloatArray) -> FloatArray:
    """ln dn/du with the wear (mm, any shape) frozen over a cycle."""
    result: FloatArray = -np.log(cycle.frozen(wear) + TINY)
    return result


def scan(cycle: CutoffCycle, scale: float, start: float, cycles: float, limit: float) -> FloatArray:
    """Return the wear (k,) in mm, rising from `start` to where the frozen rate puts `cycles`,
    roughly, and no higher than `limit`; the rate changes over wear of the `scale` (mm)."""
    y = STEP * np.arange(STEPS)
    if np.isfinite(limit):
        y = np.linspace(0.0, np.log1p((limit - start) / (start + scale)), STEPS)
    wear: FloatArray = start + (start + scale) * np.expm1(y)
    cycle = cycle.resolved(ROUGH)
    density = np.minimum(frozen_density(cycle, wear), 650.0)
    rise = np.diff(density)
    rise = np.where(np.abs(rise) < 1e-6, 1e-6, rise)
    # Between two points the density is taken as exponential in the wear.
    parts = np.exp(density[:-1]) * np.expm1(rise) / rise * np.diff(wear)
    counts = np.concatenate([[0.0], np.cumsum(parts)])
    wanted = 1.3 * max(cycles, LEAST)
    last = int(np.searchsorted(counts, wanted)) - 1
    if last >= len(parts):
        return wear
    share = np.log1p((wanted - counts[last]) / parts[last] * np.expm1(rise[last])) / rise[last]
    end = wear[last] + share * (wear[last + 1] - wear[last])
    ahead: FloatArray = np.append(wear[: last + 1], end)
    return ahead
