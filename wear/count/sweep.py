"""Many scenes at once: the cycle count of `wear.count` with the scenes as one more axis.

Every scene has a mesh of phase and panels of its own. A scene that this does not resolve, by the
same estimate as for one scene, is solved by itself.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from wear.count import abel, tabulated, wear_after
from wear.count.cycle import (
    Settings,
    first_edges,
    settings,
)
from wear.count.many import Many, ManyDrives
from wear.count.many_meshes import plain, resolved
from wear.count.many_panels import ManyPanels, fill
from wear.count.panels import SAFETY
from wear.count.rounding import roundoff_of
from wear.count.scan import LEAST, SHARP, SHIFT, roughness_limits
from wear.numerics.collocation import (
    CycleSolution,
)
from wear.numerics.gauss import (
    BoolArray,
    FloatArray,
    IntArray,
)
from wear.numerics.tolerances import (
    TINY,
)

if TYPE_CHECKING:
    from wear.scene import Scene

TOGETHER = 1024  # scenes
FIRST = (0, 3, 30)  # cycles integrated one by one: none where they change the density little
MARGIN = 4.0  # of a rough look ahead
ITERATED = 0.1  # of the error asked for: what the iteration over a cycle may leave
JUDGED = 0.01  # of that: what the iteration of the judge may leave
SAMPLES = np.array([0.0, 0.15, 0.3, 0.45, 0.6, 0.8, 1.0])  # of the way in y: there a mesh must suit
SMALL = 0.5  # step in ln(u + scale): then panels may begin with it
LONGEST, STEPS = 30.0, 60  # of the look ahead, in ln(1 + u/scale)


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
    if not scenes:
        none = np.empty((0, len(cycles)))
        return Sweep(none, none, np.empty(0, dtype=bool))
    parts = [
        _together(scenes[at : at + TOGETHER], cycles, rtol)
        for at in range(0, len(scenes), TOGETHER)
    ]
    return Sweep(*(np.concatenate(arrays) for arrays in zip(*parts, strict=True)))


def _together(scenes: Sequence[Scene], cycles: FloatArray, rtol: float) -> Sweep:
    """Some scenes in one set of arrays; what they miss, one by one."""
    from wear.model import bind, bind_many

    loads = [scene.periodic_load for scene in scenes]
    many = Many(bind_many(scenes), loads, [first_edges(load) for load in loads])
    wear, error = np.empty((len(scenes), len(cycles))), np.full((len(scenes), len(cycles)), np.inf)
    alone = np.full(len(scenes), True)
    for first in FIRST:
        left = np.flatnonzero(alone)
        if many.model.ends_at_3_sigma or len(left) == 0:
            break
        with np.errstate(all="ignore"):  # a scene that overflows here is solved by itself
            wear[left], error[left] = _solve(many.take(left), cycles, rtol, first)
        alone = ~np.all(error <= rtol, axis=1)
    for i in np.flatnonzero(alone).tolist():
        single = wear_after(bind(scenes[i]), loads[i], cycles, rtol)
        wear[i], error[i] = single.u_c, single.error
    return Sweep(wear, error, alone)


class Plan(NamedTuple):
    """For each of some scenes (scenes,): the wear `end` (mm) that its panels must reach and their
    `shift` (mm), the `pace` of the first cycle, the step it makes in ln(u + scale), and the
    `change` of the density that it makes."""

    shift: FloatArray
    end: FloatArray
    pace: FloatArray
    change: FloatArray

    def take(self, which: IntArray) -> Plan:
        """That for some of the scenes."""
        return Plan(*(array[which] for array in self))


def _solve(
    many: Many, cycles: FloatArray, rtol: float, first: int
) -> tuple[FloatArray, FloatArray]:
    """Wear (scenes, cycles) and its estimated relative error, infinite where out of reach; panels
    follow after the `first` cycles."""
    shape = (len(many.loads), len(cycles))
    wear, error = np.full(shape, np.nan), np.full(shape, np.inf)
    plan = _scan(many, MARGIN * max(float(np.max(cycles)), LEAST))
    # Scenes that wear alike take as many iterations.
    chosen = np.argsort(plan.pace)
    if first == 0:
        chosen = chosen[(plan.change[chosen] <= SHARP) & (plan.pace[chosen] <= SMALL)]
    many, plan, size = many.take(chosen), plan.take(chosen), settings(rtol)
    scale = plan.shift / SHIFT
    samples = scale[:, None] * np.expm1(np.log1p(plan.end / scale)[:, None] * SAMPLES)
    for which, edges, run in resolved(many, samples, first, size, ITERATED * rtol):
        some = many.take(which)
        maps = Maps(
            some.on(edges, size.phase_nodes, ITERATED * rtol),
            some.on(edges, size.finer_nodes, JUDGED * ITERATED * rtol),
        )
        begun = _begun(maps, run) if run else _fresh(len(which))
        found = _solve_group(maps, plan.take(which), begun, cycles, size)
        peak = np.array([[load.maximum] for load in some.loads])
        told = np.where(np.isfinite(found[0]), found[0], 0.0)
        rounding = roundoff_of(some.model, np.broadcast_to(peak, told.shape), told)
        wear[chosen[which]], error[chosen[which]] = found[0], found[1] + rounding
    return wear, np.where(np.isfinite(error), error, np.inf)


class Maps(NamedTuple):
    """The one-cycle map twice: `coarse` gives the result, `fine` judges it."""

    coarse: ManyDrives
    fine: ManyDrives


class Begun(NamedTuple):
    """The wear `added` by each of the first cycles (scenes, k), and the estimated `error` of the
    wear after each, mm: infinite if they cannot be trusted."""

    added: FloatArray
    error: FloatArray

    @property
    def wear(self) -> FloatArray:
        """The wear (scenes, k) after each, mm."""
        return np.cumsum(self.added, axis=1)

    def take(self, which: IntArray) -> Begun:
        """Those of some scenes."""
        return Begun(self.added[which], self.error[which])


def _fresh(scenes: int) -> Begun:
    """No cycle yet."""
    return Begun(np.empty((scenes, 0)), np.empty((scenes, 0)))


def _begun(maps: Maps, run: CycleSolution) -> Begun:
    """The first cycles `run` by the coarse map, judged by the fine one."""
    before = np.cumsum(run.increment, axis=1) - run.increment
    judged = maps.fine.advance(before, run.guess(maps.fine.over.phases.shape[-1]))
    missed = np.abs(judged.increment - run.increment)
    # What both meshes miss, and what the iterations of the judge may have left.
    missed += (
        np.sum(maps.fine.overlooked(before, judged), axis=2)
        + judged.iteration_error * run.increment
    )
    missed[~np.all(run.converged & judged.converged, axis=1)] = np.inf
    growth = maps.coarse.growth(before[..., None, None] + run.inside)
    return Begun(run.increment, _carried(SAFETY * missed, growth))


def _solve_group(
    maps: Maps, plan: Plan, begun: Begun, cycles: FloatArray, size: Settings
) -> tuple[FloatArray, FloatArray]:
    """Wear (scenes, cycles) and its estimated relative error but for rounding, of scenes whose
    meshes of phase have as many intervals."""
    wear, error = np.full((2, len(plan.end), len(cycles)), np.inf)
    scene = np.flatnonzero(np.isfinite(begun.error).all(axis=1))
    if len(scene) == 0:
        return wear, error
    starts = np.sum(begun.added[scene], axis=1)
    ends = np.maximum(plan.end[scene], 2 * starts)
    blank = np.zeros((len(scene), size.panel_nodes)), np.full(len(scene), np.inf)
    panels = fill(*maps, ManyPanels(scene, plan.shift[scene], starts, ends, *blank), size)
    for some in _alike(panels):
        which = np.unique(some.scene)
        wear[which], error[which] = _evaluate(some, begun.take(which), cycles)
    return wear, error


def _alike(panels: ManyPanels) -> Iterator[ManyPanels]:
    """The panels, together those of scenes with as many of them."""
    _, inverse, counts = np.unique(panels.scene, return_inverse=True, return_counts=True)
    for number in np.unique(counts):
        yield panels.where(counts[inverse] == number)


def _scan(many: Many, cycles: float) -> Plan:
    """How far panels must reach: to where the frozen rate puts `cycles`, roughly."""
    fresh = np.zeros((len(many.loads), 1))
    scale = many.model.fields(fresh, fresh).sigma / 4
    limit = np.log1p(roughness_limits(many.model, 1e12 * scale) / scale)
    step = np.minimum(LONGEST, limit) / STEPS
    ahead = step * np.arange(STEPS + 1)
    wear = scale * np.expm1(ahead)
    added = np.empty_like(wear)
    for which, edges in plain(many):
        added[which] = many.take(which).on(edges, 10).frozen(wear[which])
    density = -np.log(np.log1p(added / (wear + scale)) + TINY)
    # Between two points the density is taken as exponential in y.
    rise = np.diff(density, axis=1)
    rise = np.where(np.abs(rise) < 1e-6, 1e-6, rise)
    begin = np.exp(density[:, :-1]) * step / rise
    counts = np.cumsum(begin * np.expm1(rise), axis=1)
    part = np.minimum(np.sum(counts < cycles, axis=1), STEPS - 1)
    at = (np.arange(len(scale)), part)
    missing = cycles - np.where(part > 0, counts[at[0], part - 1], 0.0)
    share = np.log1p(missing / begin[at]) / rise[at]
    y = np.minimum(ahead[at] + share * step[:, 0], limit[:, 0])
    pace = np.exp(-density[:, 0])
    change = pace * np.abs(rise[:, 0]) / step[:, 0]
    return Plan(SHIFT * scale[:, 0], scale[:, 0] * np.expm1(y), pace, change)


def _evaluate(
    panels: ManyPanels, begun: Begun, cycles: FloatArray
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
        lost[:, k * parts - 1] += abel.junctions(before, after)  # the count is shifted at once
    lost = SAFETY * lost + table.missed.reshape(gain.shape)
    share = (late - np.take_along_axis(begins, part, axis=1)) / np.take_along_axis(gain, part, 1)
    missed = np.take_along_axis(np.cumsum(lost, axis=1) - lost, part, axis=1)
    missed += np.clip(share, 0.0, 1.0) * np.take_along_axis(lost, part, axis=1)
    if number > 0:
        missed += begun.error[:, -1:] / tabulated.first_pace(table).reshape(gain.shape)[:, :1]
    error = pace * missed
    error[out_of_reach] = np.inf

    early = cycles <= number
    index = cycles[early].astype(int) - 1
    wear[:, early], error[:, early] = begun.wear[:, index], begun.error[:, index]
    return wear, error / wear


def _carried(missed: FloatArray, growth: FloatArray) -> FloatArray:
    """The error (scenes, k) of the wear after each of the first cycles: what each has missed, and
    what the ones before have, which grows with the wear."""
    error = missed.copy()
    for k in range(1, error.shape[1]):
        error[:, k] += error[:, k - 1] * growth[:, k]
    return error
