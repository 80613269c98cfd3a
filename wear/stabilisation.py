"""Stabilisation: the number of cycles after which wear is steady, by the note's criterion.

Key results
    TOLERANCE    the criterion
    settled      the cycles after which the mean pressure of a cycle meets it
"""

from __future__ import annotations

import numpy as np

from wear.faults import AccuracyError
from wear.numerics.gauss import FloatArray
from wear.quantities import MOST_CYCLES
from wear.scene import Scene
from wear.solver import solve

TOLERANCE = 1e-6
"""The note's criterion: relative distance of the wear rate from its limit."""

_AGREES = 0.02  # relative: up to which the leading term tells when the wear has settled
_GRID, _REFINEMENTS = 40, 3  # points and passes of the search for that: to one part in a thousand


def settled(scene: Scene, pressure: float, leading: float | None) -> float | None:
    """Return the cycles after which the mean pressure of a cycle stays within the criterion.

    ``leading`` follows from the leading term of the approach, ``A/(N u_cum)``.  Where a small A
    lets higher orders rule at that number of cycles, the solution is searched instead.
    """
    if leading is None or leading > MOST_CYCLES:
        return leading

    def excess(cycles: FloatArray) -> FloatArray:
        try:
            mean = solve(scene, np.rint(cycles), rtol=1e-12).pressures.mean
        except AccuracyError:  # of an extreme scene
            mean = np.full(cycles.shape, np.nan)
        return np.abs(mean / pressure - 1.0) / TOLERANCE

    if abs(float(excess(np.array([leading]))[0]) - 1.0) < _AGREES:
        return leading
    grid = np.geomspace(1.0, MOST_CYCLES, _GRID)
    for _ in range(_REFINEMENTS):
        grid = np.unique(np.rint(grid))
        values = excess(grid)
        outside = np.flatnonzero(values > 1.0)
        if not len(outside) or outside[-1] == len(grid) - 1:
            return leading if len(outside) or np.isnan(values).any() else float(grid[0])
        grid = np.geomspace(grid[outside[-1]], grid[outside[-1] + 1], _GRID)
    return float(grid[-1])
