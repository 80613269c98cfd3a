"""A rough look ahead with the wear frozen over each cycle: how far it goes, where panels end.

Frozen wear makes the increment of a cycle a plain integral. That is too coarse for a result and
good enough for a plan; what the plan misses, the residual of Abel's equation finds.
"""

import numpy as np

from wear.count.abel import Shift, panel_wear, widths
from wear.count.collocation import FloatArray, chebyshev_analysis, chebyshev_nodes
from wear.count.cycle import TINY, OneCycle
from wear.model import Model

LEAST = 200.0  # the last panel reaches this count at least: panels are long against a cycle
STEP, STEPS = 0.2, 180  # in y = ln(u + shift)
SPLIT = 0.4  # of a panel, in y: the density is sharper at low wear
MOST_PLANNED = 150  # panels
FASTER = 2.0  # than on average may be the pace at the end of a panel
NEARLY = 0.99  # of the wear at which the roughness vanishes


def roughness_scale(model: Model) -> float:
    """A wear (mm) that changes the pressure by a factor of order 1: a quarter of the roughness."""
    return float(model.fields(np.array(0.0), np.array(0.0)).sigma) / 4


def roughness_limit(model: Model, upto: float) -> float:
    """Nearly the wear (mm) at which the equivalent roughness vanishes; infinite if it does not.

    The roughness of one solid is linear in the wear; that of two never vanishes.
    """
    start, end = model.fields(np.array([0.0, upto]), np.zeros(2)).sigma
    return float(NEARLY * upto * start / (start - end)) if end <= 0 else np.inf


def frozen_density(cycle: OneCycle, shift: float, wear: FloatArray) -> FloatArray:
    """ln dn/dy with the wear (mm, any shape) frozen over a cycle."""
    result: FloatArray = -np.log(np.log1p(cycle.frozen(wear) / (wear + shift)) + TINY)
    return result


def scan(cycle: OneCycle, shift: float, start: float, cycles: float, limit: float) -> FloatArray:
    """Wear (k,) in mm, rising from `start` to where the frozen rate puts `cycles`, roughly, and no
    higher than `limit`."""
    y = STEP * np.arange(STEPS)
    if np.isfinite(limit):
        y = np.linspace(0.0, np.log1p((limit - start) / (start + shift)), STEPS)
    wear: FloatArray = start + (start + shift) * np.expm1(y)
    cycle = cycle.resolved(wear[::8], 10, 1e-3)
    density = np.minimum(frozen_density(cycle, shift, wear), 650.0)
    rise = np.diff(density)
    rise = np.where(np.abs(rise) < 1e-6, 1e-6, rise)
    # Between two points the density is taken as exponential in y.
    parts = np.exp(density[:-1]) * np.expm1(rise) / rise * np.diff(y)
    counts = np.concatenate([[0.0], np.cumsum(parts)])
    wanted = 1.3 * max(cycles, LEAST)
    last = int(np.searchsorted(counts, wanted)) - 1
    if last >= len(parts):
        return wear
    share = np.log1p((wanted - counts[last]) / parts[last] * np.expm1(rise[last])) / rise[last]
    offset = wear[last] + shift
    end = wear[last] + offset * np.expm1(share * np.log((wear[last + 1] + shift) / offset))
    reach: FloatArray = np.append(wear[: last + 1], end)
    return reach


def plan_panels(
    cycle: OneCycle, shift: float, start: float, end: float, m: int, tolerance: float
) -> tuple[FloatArray, FloatArray]:
    """Ends (in mm of wear) of panels on which m coefficients resolve the frozen density, and
    roughly how many cycles each takes; no more than it would at the pace of its end, since the
    last node looks a cycle beyond."""
    nodes, analysis = chebyshev_nodes(m), chebyshev_analysis(m)[-2:].T
    done: list[tuple[float, float]] = []
    starts, ends = np.array([start]), np.array([end])
    while len(starts):
        across = widths(shift, starts, ends)
        density = frozen_density(cycle, shift, panel_wear(shift, starts, across, nodes))
        tail = np.max(np.abs(density @ analysis), axis=1)
        density = np.exp(np.minimum(density, 650.0))
        cycles, at_end = across * np.mean(density, axis=1), FASTER * across * density[:, -1]
        rough = (tail > tolerance) | ((cycles > 2 * m) & (at_end < m))
        rough &= len(done) + len(starts) < MOST_PLANNED
        cycles = np.minimum(cycles, at_end)
        done.extend(zip(starts[~rough], cycles[~rough], strict=True))
        starts, ends = halves(shift, starts[rough], ends[rough])
    ordered = np.array(sorted(done))
    return np.append(ordered[:, 0], end), ordered[:, 1]


def halves(shift: Shift, starts: FloatArray, ends: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Every panel cut in two."""
    middles = starts + (starts + shift) * np.expm1(SPLIT * widths(shift, starts, ends))
    return np.concatenate([starts, middles]), np.concatenate([middles, ends])
