"""Many scenes at once: the cycle count of `wear.count` with the scenes as one more axis.

All scenes share the mesh of phase and the number of panels; every scene has panels of its own. A
scene that this does not resolve, by the same estimate as for one scene, is solved by itself.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from wear.count import abel, wear_after
from wear.count.collocation import BoolArray, FloatArray, Mesh, chebyshev_nodes, integral, mesh
from wear.count.cycle import TINY, Settings, advance, first_edges, refined, settings, unresolved
from wear.count.first import BLOCK
from wear.count.panels import CHECKS, SAFETY
from wear.count.rounding import roundoff_of
from wear.count.scan import LEAST, SPLIT
from wear.load import Load
from wear.model import Model

if TYPE_CHECKING:
    from wear.scene import Scene

TOGETHER = 16  # scenes whose arrays stay in the processor's cache
PANELS = 2
MOST_INTERVALS = 6  # of phase: what needs more is solved by itself
SCAN = np.linspace(0.0, 30.0, 61)  # ln(1 + u/shift) of the look ahead


class Sweep(NamedTuple):
    """Bearing wear `u_c` (scenes, cycles) in mm and its estimated relative `error`; `alone`
    (scenes,) tells which scenes were solved by themselves."""

    u_c: FloatArray
    error: FloatArray
    alone: BoolArray


class ManyDrives(NamedTuple):
    """A model of many scenes, constants of shape (scenes, 1), each under a load of its own."""

    model: Model
    period: FloatArray  # (scenes, 1, 1, 1), s
    over: Mesh
    displacement: FloatArray  # (scenes, 1, q, m), mm

    def rate(self, u: FloatArray, near: FloatArray | None = None) -> FloatArray:
        """Wear rate in mm per cycle at wear `u` (scenes, k, q, m), sought from a rate `near` by."""
        wear, displacement = np.broadcast_arrays(u, self.displacement)
        flat = (len(u), -1)
        known = None if near is None else (near / self.period).reshape(flat)
        rate: FloatArray = self.model.rate(wear.reshape(flat), displacement.reshape(flat), known)
        return self.period * rate.reshape(wear.shape)

    def interval(self, i: int) -> ManyDrives:
        """The part over one interval of the mesh."""
        one = self.displacement[:, :, i : i + 1]
        return self._replace(over=self.over.interval(i), displacement=one)


def sweep(scenes: Sequence[Scene], cycles: FloatArray, rtol: float = 1e-7) -> Sweep:
    """Wear of many scenes after the same whole numbers of cycles (n,), at least 1.

    The scenes must need the same variant of the model, have periodic loads. With a cutoff each is
    solved by itself.

    Raises
    ------
    UsageError
        if the scenes need different variants.

    >>> from wear.scene import load_scene
    >>> names = ["section5-k1e-7", "section5", "section5-k1e-5", "section5-k1e-4"]
    >>> found = sweep([load_scene(name) for name in names], np.array([1.0, 9000.0]))
    >>> [f"{wear:.6e}" for wear in found.u_c[:, 1]]
    ['1.129447e-03', '1.635357e-03', '2.201233e-03', '2.844174e-03']
    """
    cycles = np.asarray(cycles, dtype=float)
    parts = [
        _together(scenes[at : at + TOGETHER], cycles, rtol)
        for at in range(0, len(scenes), TOGETHER)
    ]
    return Sweep(*(np.concatenate(arrays) for arrays in zip(*parts, strict=True)))


def _together(scenes: Sequence[Scene], cycles: FloatArray, rtol: float) -> Sweep:
    """A few scenes in one set of arrays; what they miss, one by one."""
    from wear.model import bind, bind_many

    loads = [scene.periodic_load for scene in scenes]
    model = bind_many(scenes)
    wear, error = np.empty((len(scenes), len(cycles))), np.full((len(scenes), len(cycles)), np.inf)
    if not model.cutoff:
        with np.errstate(all="ignore"):  # a scene that overflows here is solved by itself
            wear, error = _solve(model, loads, cycles, settings(rtol))
    alone = ~np.all(error <= rtol, axis=1)
    for i in np.flatnonzero(alone):
        single = wear_after(bind(scenes[int(i)]), loads[i], cycles, rtol)
        wear[i], error[i] = single.u_c, single.error
    return Sweep(wear, error, alone)


def _drives(model: Model, loads: Sequence[Load], over: Mesh, repeat: int = 1) -> ManyDrives:
    """Sample every load on the mesh, or on so many copies of it on end."""
    period = np.array([load.period for load in loads])[:, None, None, None]
    displacement = np.stack([load(over.phases) for load in loads])[:, None]
    if repeat > 1:
        edges = np.concatenate([over.edges[:-1] + k for k in range(repeat)] + [[float(repeat)]])
        over = mesh(edges, len(over.rule.nodes))
        displacement = np.tile(displacement, (1, 1, repeat, 1))
    return ManyDrives(model, period, over, displacement)


def _solve(
    model: Model, loads: Sequence[Load], cycles: FloatArray, size: Settings
) -> tuple[FloatArray, FloatArray]:
    """Wear (scenes, cycles) and its estimated relative error, infinite where out of reach."""
    count = len(loads)
    shift = model.fields(np.zeros((count, 1)), np.zeros((count, 1))).sigma[:, 0] / 4
    edges = np.unique(np.concatenate([first_edges(load) for load in loads]))
    end = _scan(_drives(model, loads, mesh(edges, 10)), shift, float(np.max(cycles)))
    over = _resolve(model, loads, mesh(edges, size.phase_nodes), end, size)

    block = _drives(model, loads, over, BLOCK)
    run = advance(block, np.zeros((count, 1)))
    added = (run.rate @ over.rule.weights * block.over.lengths).reshape(count, BLOCK, -1).sum(-1)
    first = np.cumsum(added, axis=1)

    starts, ends = _panel_ends(first[:, -1], end, shift)
    wide_shift = np.repeat(shift, PANELS)
    across = abel.widths(wide_shift, starts, ends)
    nodes = abel.panel_wear(wide_shift, starts, across, chebyshev_nodes(size.panel_nodes))
    ahead = advance(_drives(model, loads, over), nodes.reshape(count, -1))
    panels = abel.solve(wide_shift, starts, across, ahead.increment.reshape(nodes.shape))

    checks = abel.panel_wear(wide_shift, starts, across, CHECKS)
    fine = _drives(model, loads, mesh(over.edges, size.finer_nodes))
    begins = np.concatenate([np.zeros((count, 1)), first[:, :-1]], axis=1)
    judged = advance(fine, np.concatenate([begins, checks.reshape(count, -1)], axis=1))
    residual = abel.residual(panels, CHECKS, judged.increment[:, BLOCK:].reshape(checks.shape))
    first_error = SAFETY * np.cumsum(np.abs(judged.increment[:, :BLOCK] - added), axis=1)

    wear, error = _evaluate(panels, np.max(np.abs(residual), axis=1), first, first_error, cycles)
    peak = np.array([[load.maximum] for load in loads])
    error += roundoff_of(model, np.broadcast_to(peak, wear.shape), wear)
    if not (run.converged.all() and ahead.converged.all() and judged.converged.all()):
        error[:] = np.inf
    return wear, np.where(np.isfinite(error), error, np.inf)


def _resolve(
    model: Model, loads: Sequence[Load], over: Mesh, end: FloatArray, size: Settings
) -> Mesh:
    """A mesh that resolves the rate of every scene, fresh and worn, if few intervals can."""
    wear = np.stack([np.zeros(len(end)), end], axis=1)
    while len(over.lengths) < MOST_INTERVALS:
        rate = _drives(model, loads, over).rate(wear[..., None, None])
        rough = unresolved(rate.reshape(-1, *over.phases.shape), over, size.phase_tolerance)
        if not rough.any():
            break
        over = refined(over, rough)
    return over


def _scan(cycle: ManyDrives, shift: FloatArray, cycles: float) -> FloatArray:
    """The wear (scenes,) at which the frozen rate puts `cycles`, roughly."""
    wear = shift[:, None] * np.expm1(SCAN)
    added = integral(cycle.rate(wear[..., None, None]), cycle.over)
    density = -np.log(np.log1p(added / (wear + shift[:, None])) + TINY)
    rise = np.diff(density, axis=1)
    rise = np.where(np.abs(rise) < 1e-6, 1e-6, rise)
    parts = np.exp(density[:, :-1]) * np.expm1(rise) / rise * np.diff(SCAN)
    counts = np.log(np.cumsum(parts, axis=1))
    wanted = np.log(1.3 * max(cycles, LEAST))
    y = [np.interp(wanted, row, SCAN[1:]) for row in counts]
    return shift * np.expm1(y)


def _panel_ends(
    start: FloatArray, end: FloatArray, shift: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Starts and ends (scenes * PANELS,) of panels in wear (mm), the first ones shorter."""
    end = np.maximum(end, start + 0.05 * (start + shift))
    share = np.concatenate([[0.0], SPLIT ** np.arange(PANELS - 1, -1, -1.0)])
    y = np.log1p((end - start) / (start + shift))[:, None] * share
    edges = start[:, None] + (start + shift)[:, None] * np.expm1(y)
    return edges[:, :-1].ravel(), edges[:, 1:].ravel()


def _evaluate(
    panels: abel.Panels,
    residual: FloatArray,
    first: FloatArray,
    first_error: FloatArray,
    cycles: FloatArray,
) -> tuple[FloatArray, FloatArray]:
    """Wear of each scene after `cycles`, and its relative error but for rounding."""
    scenes = len(first)
    table = abel.count(panels, 0.0)
    gain = table.gain.reshape(scenes, -1)
    begins = BLOCK + np.concatenate([np.zeros((scenes, 1)), np.cumsum(gain, axis=1)], axis=1)
    table = table._replace(cycles=begins[:, :-1].ravel())

    late = np.maximum(cycles, float(BLOCK))
    part = np.sum(begins[:, 1:, None] <= late, axis=1)
    out_of_reach = part >= gain.shape[1]
    part = np.minimum(part, gain.shape[1] - 1)
    flat = (part + gain.shape[1] * np.arange(scenes)[:, None]).ravel()
    wear, pace = abel.wear_after(table, np.tile(late, scenes), flat)
    wear, pace = wear.reshape(part.shape), pace.reshape(part.shape)

    missed = np.cumsum(
        np.repeat(residual, gain.size // len(residual)).reshape(gain.shape) * gain, 1
    )
    left, right = panels.take(slice(0, None, PANELS)), panels.take(slice(1, None, PANELS))
    missed = SAFETY * (missed + abel.junctions(left, right)[:, None])
    first_pace = (
        table.length * table.offset / (table.series[:, ::2].sum(1) - table.series[:, 1::2].sum(1))
    )
    missed += (first_error[:, -1] / first_pace.reshape(gain.shape)[:, 0])[:, None]
    error = pace * np.take_along_axis(missed, part, axis=1)
    error[out_of_reach] = np.inf

    early = cycles <= BLOCK
    index = cycles[early].astype(int) - 1
    wear[:, early], error[:, early] = first[:, index], first_error[:, index]
    return wear, error / wear
