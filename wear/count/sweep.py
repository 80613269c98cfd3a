"""Many scenes at once: the cycle count of `wear.count` with the scenes as one more axis.

Every scene has a mesh of phase and panels of its own; all have the same number of panels. A scene
that this does not resolve, by the same estimate as for one scene, is solved by itself.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from wear.count import abel, wear_after
from wear.count.collocation import (
    BoolArray,
    FloatArray,
    chebyshev_analysis,
    chebyshev_nodes,
    chebyshev_values,
)
from wear.count.cycle import TINY, Advance, Near, Settings, settings
from wear.count.first import BLOCK
from wear.count.many import Many, ManyDrives, plain_edges, resolved_edges
from wear.count.panels import CHECKS, SAFETY
from wear.count.rounding import roundoff_of
from wear.count.scan import LEAST

if TYPE_CHECKING:
    from wear.scene import Scene

TOGETHER = 256  # scenes
SPLIT = 0.55  # of the wear that is left, in y, to each panel but the first
ITERATED = 0.1  # of the error asked for: what the iteration over a cycle may leave
JUDGED = 0.01  # of that: what the iteration of the judge may leave
SCAN = np.linspace(0.0, 30.0, 61)  # ln(1 + u/shift) of the look ahead


class Plan(NamedTuple):
    """How finely scenes are resolved: `panels` of each, the `tolerance` of its mesh of phase
    relative to the error that is asked for, and the `margin` of cycles of a rough look ahead."""

    panels: int
    tolerance: float
    margin: float


# For all scenes, and for those that this does not resolve.
PLANS = (Plan(2, 10.0, 2.0), Plan(5, 0.01, 4.0))


class Sweep(NamedTuple):
    """Bearing wear `u_c` (scenes, cycles) in mm and its estimated relative `error`; `alone`
    (scenes,) tells which scenes were solved by themselves."""

    u_c: FloatArray
    error: FloatArray
    alone: BoolArray


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
    """Some scenes in one set of arrays; what they miss, one by one."""
    from wear.model import bind, bind_many

    many = Many(bind_many(scenes), [scene.periodic_load for scene in scenes])
    wear, error = np.empty((len(scenes), len(cycles))), np.full((len(scenes), len(cycles)), np.inf)
    alone = np.full(len(scenes), True)
    for plan in PLANS:
        left = np.flatnonzero(alone)
        if many.model.cutoff or len(left) == 0:
            break
        with np.errstate(all="ignore"):  # a scene that overflows here is solved by itself
            wear[left], error[left] = _solve(many.take(left), cycles, rtol, plan)
        alone = ~np.all(error <= rtol, axis=1)
    for i in np.flatnonzero(alone):
        single = wear_after(bind(scenes[int(i)]), many.loads[int(i)], cycles, rtol)
        wear[i], error[i] = single.u_c, single.error
    return Sweep(wear, error, alone)


def _solve(
    many: Many, cycles: FloatArray, rtol: float, plan: Plan
) -> tuple[FloatArray, FloatArray]:
    """Wear (scenes, cycles) and its estimated relative error, infinite where out of reach."""
    shape = (len(many.loads), len(cycles))
    wear, error = np.empty(shape), np.empty(shape)
    fresh = np.zeros((len(many.loads), 1))
    shift = many.model.fields(fresh, fresh).sigma[:, 0] / 4
    end, pace = _scan(many, shift, plan.margin * max(float(np.max(cycles)), LEAST))
    samples = np.stack([np.zeros_like(end), end], axis=1)
    nodes, tolerance = settings(rtol).phase_nodes, plan.tolerance * rtol
    for which, edges in resolved_edges(many, samples, nodes, tolerance):
        # Scenes that wear alike take as many iterations.
        order = np.argsort(pace[which])
        which, edges = which[order], edges[order]
        group = Group(many.take(which), edges, shift[which], end[which], plan.panels, tolerance)
        wear[which], error[which] = _solve_group(group, cycles, rtol)
    return wear, error


class Group(NamedTuple):
    """Scenes whose meshes of phase have as many intervals, with edges (scenes, q + 1); the `shift`
    (scenes,) of the panels, where they `end` (scenes,), mm, and how many each scene has; the
    `tolerance` of the meshes."""

    many: Many
    edges: FloatArray
    shift: FloatArray
    end: FloatArray
    panels: int
    tolerance: float


def _solve_group(group: Group, cycles: FloatArray, rtol: float) -> tuple[FloatArray, FloatArray]:
    """Wear (scenes, cycles) and its estimated relative error."""
    size = settings(rtol)
    many, scenes = group.many, len(group.shift)
    coarse = many.on(group.edges, size.phase_nodes, ITERATED * rtol)
    first = _first_cycles(coarse)
    wear_before = np.cumsum(first.increment, axis=1) - first.increment
    begun = wear_before[:, -1] + first.increment[:, -1]

    starts, ends = _panel_ends(begun, group)
    shift = np.repeat(group.shift, group.panels)
    across = abel.widths(shift, starts, ends)
    nodes = abel.panel_wear(shift, starts, across, chebyshev_nodes(size.panel_nodes))
    ahead = coarse.advance(nodes.reshape(scenes, -1))
    panels = abel.solve(shift, starts, across, ahead.increment.reshape(nodes.shape))

    checks = abel.panel_wear(shift, starts, across, CHECKS)
    fine = many.on(group.edges, size.finer_nodes, JUDGED * ITERATED * rtol)
    judged = fine.advance(
        np.concatenate([wear_before, checks.reshape(scenes, -1)], axis=1),
        _near(first, ahead, size),
    )
    # What the iterations of the judge may have left, nothing else tells.
    missed = np.abs(judged.increment[:, :BLOCK] - first.increment)
    missed += judged.left[:, :BLOCK] * first.increment
    residual = np.abs(
        abel.residual(panels, CHECKS, judged.increment[:, BLOCK:].reshape(checks.shape))
    )
    residual += judged.left[:, BLOCK:].reshape(checks.shape)
    residual += np.max(ahead.left.reshape(nodes.shape), axis=1, keepdims=True)

    wear, error = _evaluate(
        panels, np.max(residual, axis=1), first.increment, SAFETY * missed, cycles
    )
    peak = np.array([[load.maximum] for load in many.loads])
    told = np.where(np.isfinite(wear), wear, 0.0)
    error += roundoff_of(many.model, np.broadcast_to(peak, wear.shape), told)
    sound = np.all(first.converged & ahead.converged & judged.converged, axis=1)
    sound &= ~coarse.overlooked(wear_before, first, group.tolerance)
    return wear, np.where(sound[:, None] & np.isfinite(error), error, np.inf)


def _first_cycles(cycle: ManyDrives) -> Advance:
    """BLOCK cycles on end: the guess for one is where those before lead."""
    start = np.zeros((len(cycle.displacement), 1))
    runs = [cycle.advance(start)]
    grown = np.zeros_like(runs[0].inside)
    while len(runs) < BLOCK:
        last = runs[-1]
        start = start + last.increment
        apart = last.increment[..., None, None] + grown
        runs.append(cycle.advance(start, Near(last.inside + grown, last.rate, apart)))
        grown = runs[-1].inside - last.inside
    return Advance(
        np.concatenate([run.increment for run in runs], axis=1),
        np.concatenate([run.inside for run in runs], axis=1),
        np.concatenate([run.rate for run in runs], axis=1),
        sum(run.evaluations for run in runs),
        np.logical_and.reduce([run.converged for run in runs]),
        np.concatenate([run.left for run in runs], axis=1),
    )


def _near(first: Advance, ahead: Advance, size: Settings) -> Near:
    """What the first cycles do and, by interpolation, those that start at the checks, as a guess
    for the finer mesh."""
    m = size.panel_nodes
    to_checks = chebyshev_values(CHECKS, m) @ chebyshev_analysis(m)

    def joined(exact: FloatArray, nodes: FloatArray) -> FloatArray:
        scenes, _, q, phases = nodes.shape
        checks = to_checks @ nodes.reshape(scenes, -1, m, q * phases)
        return np.concatenate([exact, checks.reshape(scenes, -1, q, phases)], axis=1)

    both = first._replace(
        inside=joined(first.inside, ahead.inside), rate=joined(first.rate, ahead.rate)
    )
    return both.near(size.finer_nodes)


def _scan(many: Many, shift: FloatArray, cycles: float) -> tuple[FloatArray, FloatArray]:
    """The wear (scenes,) at which the frozen rate puts `cycles`, roughly, and the step in y of the
    first cycle."""
    wear = shift[:, None] * np.expm1(SCAN)
    added = np.empty_like(wear)
    for which, edges in plain_edges(many):
        added[which] = many.take(which).on(edges, 10).frozen(wear[which])
    density = -np.log(np.log1p(added / (wear + shift[:, None])) + TINY)
    # Between two points the density is taken as exponential in y.
    rise = np.diff(density, axis=1)
    rise = np.where(np.abs(rise) < 1e-6, 1e-6, rise)
    begin = np.exp(density[:, :-1]) * np.diff(SCAN) / rise
    counts = np.cumsum(begin * np.expm1(rise), axis=1)
    part = np.minimum(np.sum(counts < cycles, axis=1), len(SCAN) - 2)
    at = (np.arange(len(shift)), part)
    missing = cycles - np.where(part > 0, counts[at[0], part - 1], 0.0)
    y = SCAN[part] + np.log1p(missing / begin[at]) / rise[at] * (SCAN[part + 1] - SCAN[part])
    return shift * np.expm1(y), np.exp(-density[:, 0])


def _panel_ends(start: FloatArray, group: Group) -> tuple[FloatArray, FloatArray]:
    """Starts and ends (scenes * panels,) of panels in wear (mm) from the `start` (scenes,) on, the
    first ones shorter."""
    offset = start + group.shift
    share = np.append(0.0, SPLIT ** np.arange(group.panels - 1, -1, -1.0))
    y = np.log1p(np.maximum((group.end - start) / offset, 0.05))[:, None] * share
    edges = start[:, None] + offset[:, None] * np.expm1(y)
    return edges[:, :-1].ravel(), edges[:, 1:].ravel()


def _evaluate(
    panels: abel.Panels,
    residual: FloatArray,
    added: FloatArray,
    missed: FloatArray,
    cycles: FloatArray,
) -> tuple[FloatArray, FloatArray]:
    """Wear of each scene after `cycles`, and its relative error but for rounding; `added`
    (scenes, BLOCK) is that of the first cycles, and `missed` what they are wrong by, mm."""
    scenes = len(added)
    first, first_error = np.cumsum(added, axis=1), _carried(missed, added)
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

    parts = gain.size // len(residual)
    lost = np.repeat(residual, parts).reshape(gain.shape) * gain
    each = len(residual) // scenes
    for k in range(1, each):
        before, after = (panels.take(slice(i, None, each)) for i in (k - 1, k))
        lost[:, k * parts] += abel.junctions(before, after)
    begun = first_error[:, -1] / abel.first_pace(table).reshape(gain.shape)[:, 0]
    lost = SAFETY * np.cumsum(lost, axis=1) + begun[:, None]
    error = pace * np.take_along_axis(lost, part, axis=1)
    error[out_of_reach] = np.inf

    early = cycles <= BLOCK
    index = cycles[early].astype(int) - 1
    wear[:, early], error[:, early] = first[:, index], first_error[:, index]
    return wear, error / wear


def _carried(missed: FloatArray, added: FloatArray) -> FloatArray:
    """The error (scenes, BLOCK) of the wear after each of the first cycles: what each has missed,
    grown as the wear added by a cycle grows."""
    error = missed.copy()
    for k in range(1, error.shape[1]):
        error[:, k] += error[:, k - 1] * np.maximum(1.0, added[:, k] / added[:, k - 1])
    return error
