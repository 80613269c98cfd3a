"""Any number of cycles from a few: wear after N cycles, and the cycles to a wear depth.

Overview
    The load of a scene repeats, or consists of blocks that do. One scene is a batch of one; scenes
    of one variant of the model are solved together. See docs/method.md.
Key results
    wear_after      wear after whole numbers of cycles
    first_passage   cycles to a wear depth
    sweep           the wear of many scenes after the same cycles
    cycles_to_depth the cycles of many scenes to the same wear depths
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import NamedTuple

import numpy as np

from wear.binding import bind
from wear.equation import WearEquation, equation_of, growth
from wear.faults import Faults
from wear.load import Blocks, Constant, Load, Loading, Table
from wear.load.spans import most_cycles, span
from wear.loss_of_contact.count import CountRequest, count_scenes
from wear.loss_of_contact.edge import edge_of_contact, edges_of_contact
from wear.model import Model
from wear.numerics.gauss import FloatArray, IntArray
from wear.orbit.iterates import Iterates
from wear.orbit.plan import LEAST
from wear.orbit.problem import Cost
from wear.orbit.segments import Orbit, joined, orbit
from wear.progress import Pace
from wear.quantities import MOST_CYCLES
from wear.request import checked_scenes, wear_depths, whole_cycles
from wear.resampling import Resampling, resampled, unmerged
from wear.scene import Scene
from wear.scene_orbit import IDLES, End, SceneOrbit

GRACE = 5.0  # s after a deadline for the cycle at work
FARTHER = 1e3  # times as many cycles are counted where a wear depth was not reached
TOGETHER = 1024  # scenes in one set of arrays
KINKS = 16  # of a load: of scenes with more, fewer go together


class Wear(NamedTuple):
    """Wear `u_c` (mm) after the cycles asked for, and its estimated relative error."""

    u_c: FloatArray
    error: FloatArray
    cost: Cost
    notices: tuple[str, ...]


class Sweep(NamedTuple):
    """Bearing wear `u_c` (scenes, cycles) in mm and its estimated relative `error`."""

    u_c: FloatArray
    error: FloatArray


class CyclesToDepth(NamedTuple):
    """Whole numbers of `cycles` (..., depths) after which each wear is first reached, infinite
    where it is not within 1e12 cycles, and their estimated relative `error`."""

    cycles: FloatArray
    error: FloatArray


# Trial states far off the solution may overflow; NaN fails the error estimate.
@np.errstate(all="ignore")
def orbit_of_scene(
    model: Model,
    load: Load,
    cycles: float,
    rtol: float,
    start: float = 0.0,
    deadline: float = np.inf,
    deepest: float = np.inf,
) -> SceneOrbit:
    """Return the orbit of a scene over up to `cycles` of a load that repeats, from the wear `start`
    (mm), or until it exceeds a wear `deepest` (mm), or a little later; after the `deadline`
    (`time.monotonic()`) nothing is refined, and soon a `TimeoutError` ends the cycle at work."""
    if model.ends_at_3_sigma:
        edge = edge_of_contact(model, load)
        request = CountRequest(model, load, edge, cycles, start, deepest=deepest)
        return count_scenes([request], rtol, deadline, GRACE)[0]
    one, equation = np.ones(1), WearEquation(model, (load,), deadline=deadline + GRACE)
    states = orbit(equation, cycles * one, rtol, start * one, 0.0 * one, deadline)
    last = states.segments[-1]
    if not states.at_rest[0] or np.isinf(states.after(np.full((1, 1), cycles))[1][0, 0]):
        return SceneOrbit(states, None)
    assert isinstance(last.iterates, Iterates)
    return SceneOrbit(states, End(int(last.begins[0]) + last.iterates.first_idle_cycle, 0, IDLES))


class Stage(NamedTuple):
    """Cycles from `begins` to `ends` of one load that repeats, and their `solution`; the error of
    the wear before propagates into them as `start_error` (mm)."""

    load: Load
    begins: int
    ends: float
    solution: SceneOrbit
    start_error: float

    def after(self, cycles: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the wear (mm) after some of the cycles (n,), and its error (mm)."""
        with np.errstate(all="ignore"):
            wear, relative = self.solution.after(cycles - self.begins)
            absolute = np.where(np.isfinite(relative), relative * wear, np.inf)
        return wear, absolute + self.start_error

    def until(self, wear: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the cycles after which each wear (mm, (n,)) is reached, infinite where it is not,
        and their own error in cycles."""
        with np.errstate(all="ignore"):
            count, uncertain = self.solution.until(wear)
        count = self.begins + count
        late = count > self.ends
        return np.where(late, np.inf, count), np.where(late, 0.0, uncertain)

    def notices(self, wear: FloatArray) -> Iterator[str]:
        """Yield the notices on the wear (mm)."""
        after = f"in the block after {self.begins} cycles: "
        for text in self.solution.notices(wear):
            yield after * (self.begins > 0) + text


def stages(
    model: Model,
    load: Loading,
    last: float,
    rtol: float,
    start: float = 0.0,
    deadline: float = np.inf,
    deepest: float = np.inf,
) -> Iterator[Stage]:
    """Yield the stages of a load up to cycle `last`, from the wear `start` (mm) on; of a load that
    repeats, up to a wear `deepest` (mm).

    The error with which a block starts is carried on, in proportion to the wear rate where that
    grows: two solutions of one equation keep their distance in time. No block follows one whose
    error is unknown, or that ended after the `deadline`.
    """
    start_error, done = 0.0, 0
    while True:
        acting, until, _ = span(load, done)
        ends = min(float(until), last)
        try:
            solution = orbit_of_scene(model, acting, ends - done, rtol, start, deadline, deepest)
        except TimeoutError:
            return
        stage = Stage(acting, done, ends, solution, 0.0)
        if ends >= last and not start_error:
            yield stage
            return
        end, error = (float(x[0]) for x in stage.after(np.array([ends])))
        if start_error:
            start_error *= growth(model, acting, start, end)
        yield stage._replace(start_error=start_error)
        start, start_error, done = end, start_error + error, until
        if ends >= last or not start_error < np.inf or time.monotonic() > deadline:
            return


def wear_after(
    model: Model,
    load: Loading,
    cycles: FloatArray,
    rtol: float,
    start: float = 0.0,
    deadline: float = np.inf,
) -> Wear:
    """Return the wear u_c (mm) after whole numbers of cycles (n,), to relative accuracy `rtol`.

    The load repeats or consists of blocks; `start` is the wear (mm) before. After the `deadline`
    (`time.monotonic()`) nothing is refined and no further block begun; the wear in blocks that were
    not begun is NaN, with an infinite error. Where the accuracy was not reached the estimated error
    exceeds `rtol`.
    """
    cycles = np.asarray(cycles, dtype=float)
    u, error = np.full(cycles.shape, np.nan), np.full(cycles.shape, np.inf)
    cost, notices = Cost(0, 0), dict[str, None]()
    for stage in stages(model, load, np.max(cycles, initial=0.0), rtol, start, deadline):
        here = (cycles >= stage.begins) & (cycles <= stage.ends)
        wear, absolute = stage.after(np.append(cycles[here], stage.ends))
        u[here], error[here] = wear[:-1], (absolute / np.where(wear > 0, wear, 1.0))[:-1]
        cost = cost.plus(*stage.solution.cost)
        notices |= dict.fromkeys(stage.notices(wear))
    return Wear(u, error, cost, tuple(notices))


def first_passage(model: Model, load: Loading, wear: FloatArray, rtol: float) -> CyclesToDepth:
    """Return the whole cycles after which each wear u_c (mm, (n,)) is first reached, infinite where
    it is not within the load or 1e12 cycles, and the estimated relative error of their number.

    A wear counts as reached as soon as it lies within the estimated error; the error spans the
    cycles until it is reached for certain, perhaps in another block.
    """
    wear = np.asarray(wear, dtype=float)
    count, error = np.full(wear.shape, np.inf), np.zeros(wear.shape)
    doubtful = np.full(wear.shape, False)
    for stage in _as_far_as_needed(model, load, wear, rtol):
        reached, uncertain = stage.until(wear)
        certain = stage.until(wear + stage.start_error)[0] if stage.start_error else reached
        if isinstance(load, Blocks) and stage.ends < most_cycles(load):
            end, absolute = stage.after(np.array([stage.ends]))
            certain = np.where(wear > end - absolute, np.inf, certain)  # perhaps in another block
        new = np.isinf(count) & np.isfinite(reached)
        count[new], error[new] = reached[new], uncertain[new]
        doubtful |= new
        known = doubtful & np.isfinite(certain)
        error[known] = np.maximum(error[known], certain[known] - count[known])
        doubtful &= ~known
        if np.isfinite(count).all() and not doubtful.any():
            break
    error[doubtful] = np.inf
    return CyclesToDepth(count, error / np.maximum(count, 1.0))


def _as_far_as_needed(
    model: Model, load: Loading, wear: FloatArray, rtol: float
) -> Iterator[Stage]:
    """Yield the blocks of a load; or, of a load that repeats, one stage with ever more cycles until
    it reaches the deepest wear (mm)."""
    most = float(min(MOST_CYCLES, most_cycles(load)))
    if isinstance(load, Blocks):
        yield from stages(model, load, most, rtol)
        return
    reach, deepest = LEAST, float(np.max(wear, initial=0.0))
    while True:
        (stage,) = stages(model, load, reach, rtol, deepest=deepest)
        solution = stage.solution
        if reach >= most or solution.ended or deepest <= solution.last_wear:
            break
        reach = min(reach * FARTHER, most)
    yield stage._replace(ends=most)


def sweep(
    scenes: Sequence[Scene | str | os.PathLike[str]],
    cycles: FloatArray | Iterable[float] | float,
    rtol: float = 1e-7,
    progress: Callable[[str], None] = lambda _: None,
) -> Sweep:
    """Return the wear of many scenes, or their names, after the same whole numbers of cycles (n,).

    Scenes of one variant of the model whose loads repeat are solved together; variants may be
    mixed. After two seconds `progress` is called at intervals with the number of scenes done.

    >>> found = sweep(["section5-k1e-7", "section5", "section5-k1e-5", "section5-k1e-4"], [1, 9000])
    >>> [f"{wear:.6e}" for wear in found.u_c[:, 1]]
    ['1.129447e-03', '1.635357e-03', '2.201233e-03', '2.844174e-03']
    """
    faults = Faults()
    numbers = np.array(whole_cycles(cycles, faults), dtype=float)
    known = checked_scenes(scenes, rtol, faults, numbers.tolist())
    fewer = [resampled(scene, rtol) for scene in known]
    last = float(np.max(numbers, initial=0.0))

    def together(group: Sequence[Scene]) -> ValueAndError:
        return _orbit(group, last, rtol).after(np.tile(numbers, (len(group), 1)))

    def alone(scene: Scene) -> ValueAndError:
        return wear_after(bind(scene), scene.load, numbers, rtol)[:2]

    u, error = _in_groups(fewer, len(numbers), together, alone, progress)
    for row, resampling in enumerate(fewer):
        error[row] += resampling.wear_error(u[row])
    # Where wear accelerates, the error by merged rows grows.
    again = [row for row, each in enumerate(fewer) if each.error and not max(error[row]) <= rtol]
    if again:
        whole = [unmerged(known[row]) for row in again]
        u[again], error[again] = _in_groups(whole, len(numbers), together, alone, progress)
    return Sweep(u, error)


def cycles_to_depth(
    scenes: Sequence[Scene | str | os.PathLike[str]],
    wear: FloatArray | Iterable[float] | float,
    rtol: float = 1e-7,
    progress: Callable[[str], None] = lambda _: None,
) -> CyclesToDepth:
    """Return the whole cycles after which each of many scenes, or their names, first reaches each
    wear (n,), mm.

    After two seconds `progress` is called at intervals with the number of scenes done.

    >>> cycles_to_depth(["section4", "section5"], 1e-3).cycles.tolist()
    [[140.0], [484.0]]
    """
    faults = Faults()
    depths = np.array(wear_depths(wear, faults))
    fewer = [resampled(scene, rtol) for scene in checked_scenes(scenes, rtol, faults)]

    def together(group: Sequence[Scene]) -> ValueAndError:
        count, error = np.full((2, len(group), len(depths)), np.inf)
        todo, reach = np.arange(len(group)), LEAST
        while len(todo):
            reach = min(reach * FARTHER, float(MOST_CYCLES))
            deepest = np.max(depths, initial=0.0)
            orbit = _orbit([group[i] for i in todo.tolist()], reach, rtol, deepest)
            cycles, uncertain = orbit.until(np.broadcast_to(depths, (len(todo), len(depths))))
            farthest = np.where(orbit.at_rest, MOST_CYCLES, reach)  # at rest all is counted
            cycles[cycles > farthest[:, None]] = np.inf
            count[todo], error[todo] = cycles, uncertain / np.maximum(cycles, 1.0)
            more = np.isinf(cycles).any(axis=1) & ~orbit.at_rest
            todo = todo[more] if reach < MOST_CYCLES else todo[:0]
        return count, np.where(np.isinf(count), 0.0, error)

    def alone(scene: Scene) -> ValueAndError:
        return first_passage(bind(scene), scene.load, depths, rtol)

    count, error = _in_groups(fewer, len(depths), together, alone, progress)
    merged = [each.count_error(row) for each, row in zip(fewer, count, strict=True)]
    return CyclesToDepth(count, error + np.array(merged))


ValueAndError = tuple[FloatArray, FloatArray]


def _orbit(scenes: Sequence[Scene], cycles: float, rtol: float, deepest: float = np.inf) -> Orbit:
    """Return the orbits of scenes of one variant, over as many `cycles` each, or until the wear
    exceeds `deepest` (mm)."""
    if scenes[0].contact.ends_at_3_sigma:
        models, loads = [bind(scene) for scene in scenes], [scene.periodic_load for scene in scenes]
        parts = zip(models, loads, edges_of_contact(models, loads), strict=True)
        requests = [CountRequest(*part, cycles, deepest=deepest) for part in parts]
        return joined([solution.orbit for solution in count_scenes(requests, rtol)])
    none = np.zeros(len(scenes))
    return orbit(equation_of(scenes), cycles + none, rtol, none, none)


@np.errstate(all="ignore")
def _in_groups(
    wanted: Sequence[Resampling],
    number: int,
    together: Callable[[Sequence[Scene]], ValueAndError],
    alone: Callable[[Scene], ValueAndError],
    progress: Callable[[str], None],
) -> ValueAndError:
    """Return values and errors (scenes, number): of scenes of one variant all `together`, of a
    scene with blocks of loads `alone`."""
    scenes, pace, done = [resampling.scene for resampling in wanted], Pace(progress), 0
    value, error = np.empty((2, len(scenes), number))
    pace.begin("scene", len(scenes))
    for which in groups(scenes):
        group = [scenes[i] for i in which.tolist()]
        single = isinstance(group[0].load, Blocks)
        value[which], error[which] = alone(group[0]) if single else together(group)
        done += len(which)
        pace.at(done)
    return value, error


def groups(scenes: Sequence[Scene]) -> Iterator[IntArray]:
    """Yield the scenes that are solved together: those of one variant whose loads repeat, in
    groups of limited size; with loss of contact only those under loads that are all straight
    between corners, or all waves. A scene with blocks of loads is alone."""
    kinds: dict[object, list[int]] = {}
    for i, scene in enumerate(scenes):
        kind: object = scene.variant
        if isinstance(scene.load, Blocks):
            kind = i
        elif scene.contact.ends_at_3_sigma:
            kind = scene.variant, isinstance(scene.load, (Table, Constant))
        kinds.setdefault(kind, []).append(i)
    for which in kinds.values():
        most = max(len(getattr(scenes[i].load, "kinks", ())) for i in which)
        few = max(1, TOGETHER // max(1, most // KINKS))
        for at in range(0, len(which), few):
            yield np.array(which[at : at + few])
