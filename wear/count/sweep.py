"""Many scenes at once: the cycle count of `wear.count` with the scenes as one more axis.

Every scene has a mesh of phase and panels of its own. A scene that this does not resolve, by the
same estimate as for one scene, is solved by itself.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from wear.count import abel, tabulated, wear_after
from wear.count.arithmetic import TINY
from wear.count.collocation import BoolArray, FloatArray, IntArray
from wear.count.cycle import settings
from wear.count.many import Many, plain_edges, resolved_edges
from wear.count.many_panels import ManyPanels, fill
from wear.count.panels import SAFETY
from wear.count.rounding import roundoff_of
from wear.count.scan import LEAST, SHIFT

if TYPE_CHECKING:
    from wear.scene import Scene

TOGETHER = 1024  # scenes
FIRST = (6, 30)  # cycles integrated one by one: more for scenes that this does not resolve
MARGIN = 4.0  # of a rough look ahead
ITERATED = 0.1  # of the error asked for: what the iteration over a cycle may leave
JUDGED = 0.01  # of that: what the iteration of the judge may leave
SAMPLES = np.array([0.0, 0.35, 0.5, 0.65, 1.0])  # of the way in y: there a mesh must suit
SCAN = np.linspace(0.0, 30.0, 61)  # ln(1 + u/scale) of the look ahead


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
    for first in FIRST:
        left = np.flatnonzero(alone)
        if many.model.cutoff or len(left) == 0:
            break
        with np.errstate(all="ignore"):  # a scene that overflows here is solved by itself
            wear[left], error[left] = _solve(many.take(left), cycles, rtol, first)
        alone = ~np.all(error <= rtol, axis=1)
    for i in np.flatnonzero(alone):
        single = wear_after(bind(scenes[int(i)]), many.loads[int(i)], cycles, rtol)
        wear[i], error[i] = single.u_c, single.error
    return Sweep(wear, error, alone)


def _solve(
    many: Many, cycles: FloatArray, rtol: float, first: int
) -> tuple[FloatArray, FloatArray]:
    """Wear (scenes, cycles) and its estimated relative error, infinite where out of reach; panels
    follow after the `first` cycles."""
    shape = (len(many.loads), len(cycles))
    wear, error = np.full(shape, np.nan), np.full(shape, np.inf)
    fresh = np.zeros((len(many.loads), 1))
    scale = many.model.fields(fresh, fresh).sigma[:, 0] / 4
    end, pace = _scan(many, scale, MARGIN * max(float(np.max(cycles)), LEAST))
    samples = scale[:, None] * np.expm1(np.log1p(end / scale)[:, None] * SAMPLES)
    for which, edges in resolved_edges(many, samples, settings(rtol), rtol, first):
        # Scenes that wear alike take as many iterations.
        order = np.argsort(pace[which])
        which, edges = which[order], edges[order]
        group = Group(many.take(which), edges, SHIFT * scale[which], end[which])
        wear[which], error[which] = _solve_group(group, cycles, rtol, first)
    return wear, error


class Group(NamedTuple):
    """Scenes whose meshes of phase have as many intervals, with edges (scenes, q + 1); the `shift`
    (scenes,) of the panels and where they `end` (scenes,), mm."""

    many: Many
    edges: FloatArray
    shift: FloatArray
    end: FloatArray


def _solve_group(
    group: Group, cycles: FloatArray, rtol: float, number: int
) -> tuple[FloatArray, FloatArray]:
    """Wear (scenes, cycles) and its estimated relative error, with a `number` of first cycles."""
    size = settings(rtol)
    coarse = group.many.on(group.edges, size.phase_nodes, ITERATED * rtol)
    fine = group.many.on(group.edges, size.finer_nodes, JUDGED * ITERATED * rtol)
    first = coarse.several(number)
    before = np.cumsum(first.increment, axis=1) - first.increment
    judged = fine.advance(before, first.near(size.finer_nodes))
    # What the iterations of the judge may have left, nothing else tells.
    missed = np.abs(judged.increment - first.increment) + judged.left * first.increment
    begun = _Begun(first.increment, _carried(SAFETY * missed, first.increment))

    sound = np.all(first.converged & judged.converged, axis=1)
    sound &= ~np.any(coarse.overlooked(before, first, size.phase_tolerance), axis=1)
    sound &= np.all(begun.error <= rtol * begun.wear, axis=1)
    wear, error = np.full((2, len(sound), len(cycles)), np.inf)
    scene = np.flatnonzero(sound)
    if len(scene) == 0:
        return wear, error
    blank = _first_panels(group, scene, begun.wear[scene, -1], size.panel_nodes)
    for panels in _alike(fill(coarse, fine, blank, size)):
        which = np.unique(panels.scene)
        wear[which], error[which] = _evaluate(panels, begun.take(which), cycles)
    peak = np.array([[load.maximum] for load in group.many.loads])
    told = np.where(np.isfinite(wear), wear, 0.0)
    error += roundoff_of(group.many.model, np.broadcast_to(peak, wear.shape), told)
    return wear, np.where(np.isfinite(error), error, np.inf)


class _Begun(NamedTuple):
    """The wear `added` by each of the first cycles (scenes, k), and the estimated `error` of the
    wear after each, mm."""

    added: FloatArray
    error: FloatArray

    @property
    def wear(self) -> FloatArray:
        """The wear (scenes, k) after each, mm."""
        return np.cumsum(self.added, axis=1)

    def take(self, which: IntArray) -> _Begun:
        """Those of some scenes."""
        return _Begun(self.added[which], self.error[which])


def _first_panels(group: Group, scene: IntArray, starts: FloatArray, m: int) -> ManyPanels:
    """A panel for each `scene` from its wear `starts` (mm) on."""
    shift = group.shift[scene]
    ends = np.maximum(group.end[scene], starts + 0.05 * (starts + shift))
    n = len(scene)
    return ManyPanels(scene, shift, starts, ends, np.zeros((n, m)), np.full(n, np.inf))


def _alike(panels: ManyPanels) -> Iterator[ManyPanels]:
    """The panels, together those of scenes with as many of them."""
    _, inverse, counts = np.unique(panels.scene, return_inverse=True, return_counts=True)
    for number in np.unique(counts):
        yield panels.where(counts[inverse] == number)


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


def _evaluate(
    panels: ManyPanels, begun: _Begun, cycles: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Wear (scenes, cycles) and its relative error but for rounding, of scenes with as many panels
    each."""
    scenes, number = begun.added.shape
    density = panels.density
    table = tabulated.count(density, 0.0)
    gain = table.gain.reshape(scenes, -1)
    begins = number + np.concatenate([np.zeros((scenes, 1)), np.cumsum(gain, axis=1)], axis=1)
    table = table._replace(cycles=begins[:, :-1].ravel())

    late = np.maximum(cycles, float(number))
    part = np.sum(begins[:, 1:, None] <= late, axis=1)
    out_of_reach = part >= gain.shape[1]
    part = np.minimum(part, gain.shape[1] - 1)
    flat = (part + gain.shape[1] * np.arange(scenes)[:, None]).ravel()
    wear, pace = tabulated.wear_after(table, np.tile(late, scenes), flat)
    wear, pace = wear.reshape(part.shape), pace.reshape(part.shape)

    parts = gain.size // len(panels.scene)
    lost = np.repeat(panels.residual, parts).reshape(gain.shape) * gain
    each = len(panels.scene) // scenes
    for k in range(1, each):
        before, after = (density.take(slice(i, None, each)) for i in (k - 1, k))
        lost[:, k * parts] += abel.junctions(before, after)
    missed = begun.error[:, -1] / tabulated.first_pace(table).reshape(gain.shape)[:, 0]
    lost = SAFETY * np.cumsum(lost, axis=1) + missed[:, None]
    error = pace * np.take_along_axis(lost, part, axis=1)
    error[out_of_reach] = np.inf

    early = cycles <= number
    index = cycles[early].astype(int) - 1
    wear[:, early], error[:, early] = begun.wear[:, index], begun.error[:, index]
    return wear, error / wear


def _carried(missed: FloatArray, added: FloatArray) -> FloatArray:
    """The error (scenes, BLOCK) of the wear after each of the first cycles: what each has missed,
    grown as the wear added by a cycle grows."""
    error = missed.copy()
    for k in range(1, error.shape[1]):
        error[:, k] += error[:, k - 1] * np.maximum(1.0, added[:, k] / added[:, k - 1])
    return error
