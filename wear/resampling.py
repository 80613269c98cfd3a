"""Resampling of a measured load: as few rows as the requested accuracy of the wear allows.

Rows are merged by weighted least squares, which preserves the mean of the load over every section,
so that noise changes the wear in second order only. The error of merging is computed: the largest
difference of the wear under both loads within a cycle, relative to the wear of the cycle, without
feedback, over wears from zero to the deepest. Neither offset nor trend is removed.
"""

from __future__ import annotations

import dataclasses
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from wear.binding import bind
from wear.equation import WearEquation, growth
from wear.load import ForceTable, Table
from wear.model import Model
from wear.numerics.floating_point import TINY
from wear.numerics.gauss import FloatArray, mesh
from wear.quantities import SMALLEST
from wear.scene import Scene

LoadTable = Table | ForceTable

FEWEST_ROWS = 64  # a load with fewer costs next to nothing
NODES = 6  # between two rows, to compute the error of merging
SHARE = 0.25  # of the requested error, for merging
STEPS = (128, 64, 32, 16, 8, 6, 4, 3, 2)  # rows that are merged into one
WEARS = np.concatenate([[0.0], np.geomspace(0.01, 1e4, 8)])  # in roughnesses


class Resampling(NamedTuple):
    """A scene with fewer rows, the resulting relative `error` of its wear, and notices."""

    scene: Scene
    error: float
    notices: tuple[str, ...]

    def wear_error(self, wear: FloatArray) -> FloatArray:
        """Return the relative error of wears (n,), larger where the wear accelerates."""
        if not self.error:
            return np.zeros(wear.shape)
        model, load = bind(self.scene), self.scene.periodic_load
        grown = [growth(model, load, 0.0, u) if u > 0.0 else 0.0 for u in wear.tolist()]
        return self.error * np.array(grown)

    def count_error(self, cycles: FloatArray) -> FloatArray:
        """Return the relative error of whole numbers of cycles (n,): of whole cycles."""
        known = np.where(np.isfinite(cycles), cycles, 0.0)
        return np.asarray(np.ceil(self.error * known) / np.maximum(known, 1.0))


def resampled(scene: Scene, rtol: float) -> Resampling:
    """Return a scene whose measured load has as few rows as `rtol` allows.

    Only rows of a file with `resample = true` are merged, and none where contact may be lost: there
    the wear depends on single rows.
    """
    load = scene.load
    if not isinstance(load, LoadTable) or load.source is None or not load.source.resample:
        return Resampling(scene, 0.0, ())
    if len(load.times_s) < FEWEST_ROWS or scene.contact.ends_at_3_sigma:
        return Resampling(scene, 0.0, ())
    model, rows = bind(scene), len(load.times_s) - 1
    for step in (step for step in STEPS if rows >= FEWEST_ROWS * step / 2):
        fewer = _merged(load, step)
        error = _changed(model, load, fewer)
        if error <= SHARE * rtol:
            notice = (
                f"{rows} rows of the load are merged to {len(fewer.times_s) - 1}, which changes "
                f"the wear by at most {error:.1e} of it; resample = false keeps all"
            )
            return Resampling(dataclasses.replace(scene, load=fewer), error, (notice,))
    return unmerged(scene)


def unmerged(scene: Scene) -> Resampling:
    """Return a scene with all rows of its load."""
    assert isinstance(scene.load, LoadTable)
    rows = len(scene.load.times_s) - 1
    notice = f"all {rows} rows of the load are kept: fewer would change the wear by more than rtol"
    return Resampling(scene, 0.0, (notice,))


@lru_cache(maxsize=64)  # many scenes with one load share its merged rows
def _merged(load: LoadTable, step: int) -> LoadTable:
    """Return the periodic line with every `step`-th row as a corner, by least squares."""
    from scipy.sparse import csr_array, diags_array
    from scipy.sparse.linalg import spsolve

    times, values = np.asarray(load.times_s), np.asarray(load.rows)
    corners = np.append(times[:-1:step], times[-1])
    number, rows = len(corners) - 1, len(times) - 1
    place = np.searchsorted(corners, times[:-1], side="right") - 1
    share = (times[:-1] - corners[place]) / np.diff(corners)[place]
    at = np.arange(rows)
    hats = csr_array(
        (
            np.concatenate([1.0 - share, share]),
            (np.tile(at, 2), np.concatenate([place, (place + 1) % number])),
        ),
        shape=(rows, number),
    )
    lengths = np.diff(times)
    weights = diags_array((lengths + np.roll(lengths, 1)) / 2)
    levels = spsolve((hats.T @ weights @ hats).tocsc(), hats.T @ (weights @ values[:-1]))
    levels[np.abs(levels) < SMALLEST] = 0.0  # rounding errors where the load is zero
    closed = tuple(np.append(levels, levels[0]).tolist())
    fewer = tuple(corners.tolist())
    if isinstance(load, ForceTable):
        return dataclasses.replace(load, times_s=fewer, forces_N=tuple(max(0.0, x) for x in closed))
    return dataclasses.replace(load, times_s=fewer, values_mm=closed)


def _changed(model: Model, load: LoadTable, fewer: LoadTable) -> float:
    """Return the largest difference of the wear under two loads within a cycle, relative to its
    wear."""
    equation = WearEquation(model, (load,))
    wears = np.minimum(float(equation.scale[0]) * WEARS, float(equation.limit[0]))
    over = mesh(np.append(load.kinks, 1.0), NODES)
    starts = wears[None, :, None, None]
    rates = (equation.rate(starts, each(over.phases)[None, None])[0] for each in (load, fewer))
    exact, merged = ((rate @ over.rule.weights) * over.lengths for rate in rates)
    difference = np.abs(np.cumsum(exact, axis=1) - np.cumsum(merged, axis=1))
    return float(np.max(np.max(difference, axis=1) / (np.sum(exact, axis=1) + TINY)))
