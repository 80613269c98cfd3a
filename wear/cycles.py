"""Any number of cycles from a few: wear after N cycles, and the cycles to a wear depth.

Overview
    The load of a scene repeats, or consists of blocks that do. One scene is a batch of one; scenes
    of one variant of the model are solved together. See docs/method.md.
Key results
    wear_after      wear after whole numbers of cycles
    cycles_until    cycles to a wear depth
    sweep           the wear of many scenes after the same cycles
    cycles_to_depth the cycles of many scenes to the same wear depths
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from wear.counted import IDLES, Counted, End
from wear.equation import WearEquation, equation_of
from wear.faults import UsageError
from wear.load import Blocks, Constant, Load, Loading, Table
from wear.load.spans import most_cycles, span
from wear.loss_of_contact.count import Wanted, counted_stages
from wear.model import Model, bind
from wear.orbit.iterates import Iterates
from wear.orbit.plan import LEAST
from wear.orbit.problem import Cost
from wear.orbit.segments import Orbit, joined, orbit
from wear.progress import Pace
from wear.resampling import resampled

if TYPE_CHECKING:
    from wear.scene import Scene

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.intp]

MOST_CYCLES = 1e12
FARTHER = 1e3  # times as many cycles are counted where a wear depth was not reached
TOGETHER = 1024  # scenes in one set of arrays
KINKS = 16  # of a load: fewer scenes with more go together, for arrays of the same size
PHASES = np.arange(256) / 256  # of a cycle, for its mean rate


class Wear(NamedTuple):
    """Wear `u_c` (mm) after the cycles asked for, and its estimated relative error."""

    u_c: FloatArray
    error: FloatArray
    cost: Cost
    notices: tuple[str, ...]


class Cycles(NamedTuple):
    """Whole numbers of cycles after which a wear is first reached, infinite where it is not, and
    the estimated relative error of the count."""

    cycles: FloatArray
    error: FloatArray
    cost: Cost


class Sweep(NamedTuple):
    """Bearing wear `u_c` (scenes, cycles) in mm and its estimated relative `error`."""

    u_c: FloatArray
    error: FloatArray


class CyclesToDepth(NamedTuple):
    """Whole numbers of `cycles` (scenes, depths) after which each wear is first reached, infinite
    where it is not within 1e12 cycles, and their estimated relative `error`."""

    cycles: FloatArray
    error: FloatArray


# Trial states far off the solution may overflow; what is no number fails the estimate of error.
@np.errstate(all="ignore")
def count_cycles(
    model: Model,
    load: Load,
    cycles: float,
    rtol: float,
    start: float = 0.0,
    start_error: float = 0.0,
    deadline: float = np.inf,
) -> Counted:
    """Count up to `cycles` of a load that repeats, from the wear `start` (mm), known up to
    `start_error`; after the `deadline` (`time.monotonic()`) nothing is refined any more."""
    if model.ends_at_3_sigma:
        return counted_stages([Wanted(model, load, cycles, start, start_error)], rtol, deadline)[0]
    one, equation = np.ones(1), WearEquation(model, (load,))
    found = orbit(equation, cycles * one, rtol, start * one, start_error * one, deadline)
    last = found.segments[-1]
    if not found.at_rest[0]:
        return Counted(found, None)
    assert isinstance(last.counted, Iterates)
    return Counted(found, End(int(last.begins[0]) + last.counted.first_idle_cycle, 0, IDLES))


def wear_after(
    model: Model,
    load: Loading,
    cycles: FloatArray,
    rtol: float,
    start: float = 0.0,
    deadline: float = np.inf,
) -> Wear:
    """Return the wear u_c (mm) after whole numbers of cycles (n,), to relative accuracy `rtol`.

    The load repeats or consists of blocks; `start` is the wear (mm) before. An error that a block
    starts with is carried on, in proportion to the wear rate where that grows: two solutions of one
    equation keep their distance in time. After the `deadline` (`time.monotonic()`) nothing is
    refined and no other block begun; wear in a block that was not begun is no number, with an
    infinite error. Where the accuracy was not reached the estimated error says so.
    """
    cycles = np.asarray(cycles, dtype=float)
    last = float(np.max(cycles, initial=0.0))
    u, error = np.full(cycles.shape, np.nan), np.full(cycles.shape, np.inf)
    missed, done, cost = 0.0, 0, Cost(0, 0)
    notices: list[str] = []
    while True:
        acting, until, _ = span(load, done)
        end = min(float(until), last)
        here = (cycles >= done) & (cycles <= end)
        wanted = np.append(cycles[here], end) - done
        found = count_cycles(model, acting, end - done, rtol, start, deadline=deadline)
        with np.errstate(all="ignore"):
            wear, relative = found.after(wanted)
            absolute = np.where(np.isfinite(relative), relative * wear, np.inf)
        if missed:
            absolute += missed * growth(model, acting, start, float(wear[-1]))
        u[here] = wear[:-1]
        error[here] = (absolute / np.where(wear > 0, wear, 1.0))[:-1]
        start, missed = float(wear[-1]), float(absolute[-1])
        cost = cost.plus(*found.cost)
        notices += [_since(text, done) for text in found.notices(wear)]
        if end >= last or not missed < np.inf or time.monotonic() > deadline:
            return Wear(u, error, cost, tuple(dict.fromkeys(notices)))
        done = until


def cycles_until(model: Model, load: Loading, wear: FloatArray, rtol: float) -> Cycles:
    """Return the whole cycles after which each wear u_c (mm, (n,)) is first reached, infinite where
    it is not within the load or 1e12 cycles, and the estimated relative error of their number.

    What is reached but for the estimated error counts as reached. If a block did not, one after it
    does, at its own rate: that is part of the error.
    """
    wear = np.asarray(wear, dtype=float)
    count, error = np.full(wear.shape, np.inf), np.zeros(wear.shape)
    start, missed, done, cost = 0.0, 0.0, 0, Cost(0, 0)
    most = min(MOST_CYCLES, float(most_cycles(load)))
    doubtful = np.full(wear.shape, False)
    while (np.isinf(count) | doubtful).any() and done < most:
        acting, until, _ = span(load, done)
        length = min(float(until), most) - done
        still = np.isinf(count)
        if doubtful.any():
            late = _until(model, acting, wear[doubtful], rtol, max(start - missed, 0.0), length)
            largest = done + late.cycles * (1.0 + late.error)
            known = np.where(np.isfinite(largest), largest / count[doubtful] - 1.0, 0.0)
            error[doubtful] = np.maximum(error[doubtful], known)
            doubtful[doubtful] = np.isinf(largest)
            cost = cost.plus(*late.cost)
        found = _until(model, acting, wear[still], rtol, start, length, missed)
        count[still] = done + found.cycles
        own = np.where(np.isfinite(found.cycles), found.cycles, 0.0)  # what the error refers to
        error[still] = found.error * np.maximum(own, 1.0) / np.maximum(done + own, 1.0)
        cost = cost.plus(*found.cost)
        if until < most:
            ended = wear_after(model, acting, np.array([length]), rtol, start)
            begun, start = start, float(ended.u_c[0])
            missed *= growth(model, acting, begun, start)
            missed += float(ended.error[0]) * start
            doubtful = np.isfinite(count) & (wear > start - missed)
        done = until
    error[doubtful] = np.inf
    return Cycles(count, error, cost)


def _until(
    model: Model,
    load: Load,
    wear: FloatArray,
    rtol: float,
    start: float,
    most: float,
    start_error: float = 0.0,
) -> Cycles:
    """Return the cycles under a load that repeats, up to `most`, from the wear `start` (mm)."""
    reach, cost = min(LEAST, most), Cost(0, 0)
    while True:
        found = count_cycles(model, load, reach, rtol, start, start_error)
        cost = cost.plus(*found.cost)
        if reach >= most or found.ended or np.max(wear, initial=0.0) <= found.last_wear:
            break
        reach = min(reach * FARTHER, most)
    with np.errstate(all="ignore"):
        count, missed = found.until(wear)
    late = count > most
    count[late], missed[late] = np.inf, 0.0
    return Cycles(count, np.where(late, 0.0, missed / np.maximum(count, 1.0)), cost)


def growth(model: Model, load: Load, start: float, end: float) -> float:
    """Return by how much a small difference in wear grows between `start` and `end`; at least 1."""
    U_a = load(PHASES)
    before, after = (float(np.mean(model.rate(u, U_a))) for u in (start, end))
    return max(1.0, after / before) if before > 0.0 else 1.0


def _since(notice: str, done: int) -> str:
    """Return a notice of one block, whose cycles are counted from its start."""
    return f"in the block after {done} cycles: {notice}" if done else notice


def sweep(
    scenes: Sequence[Scene | str | os.PathLike[str]],
    cycles: FloatArray | Iterable[float] | float,
    rtol: float = 1e-7,
    progress: Callable[[str], None] = lambda _: None,
) -> Sweep:
    """Return the wear of many scenes, or their names, after the same whole numbers of cycles (n,).

    Scenes of one variant of the model whose loads repeat are solved together; variants may be
    mixed. After two seconds `progress` is told now and then how many scenes are done.

    >>> found = sweep(["section5-k1e-7", "section5", "section5-k1e-5", "section5-k1e-4"], [1, 9000])
    >>> [f"{wear:.6e}" for wear in found.u_c[:, 1]]
    ['1.129447e-03', '1.635357e-03', '2.201233e-03', '2.844174e-03']
    """
    from wear.scene import as_scene
    from wear.solver import is_number, whole_cycles

    faults: list[str] = []
    numbers = np.array(whole_cycles(cycles, faults), dtype=float)
    if not is_number(rtol) or not 0.0 < rtol <= 0.1:
        faults.append(f"rtol: {rtol!r} is not between 0 and 0.1")
    if isinstance(scenes, str) or not isinstance(scenes, Sequence):
        faults.append("scenes: give a list of them")
    if faults:
        raise UsageError("\n".join(faults))
    last = float(np.max(numbers, initial=0.0))

    def together(some: Sequence[Scene]) -> Answer:
        return _orbit(some, last, rtol).after(np.tile(numbers, (len(some), 1)))

    def alone(scene: Scene) -> Answer:
        return wear_after(bind(scene), scene.load, numbers, rtol)[:2]

    fewer = [resampled(as_scene(scene), rtol) for scene in scenes]
    some = [each.scene for each in fewer]
    u, error = _each(some, len(numbers), together, alone, Pace(progress))
    for row, each in enumerate(fewer):
        error[row] += each.missed(u[row])
    return Sweep(u, error)


def cycles_to_depth(
    scenes: Sequence[Scene],
    wear: FloatArray,
    rtol: float = 1e-7,
    progress: Callable[[str], None] = lambda _: None,
) -> CyclesToDepth:
    """Return the whole cycles after which each of many scenes first reaches each wear (n,), mm.

    After two seconds `progress` is told now and then how many scenes are done.

    >>> from wear.scene import load_scene
    >>> scenes = [load_scene("section4"), load_scene("section5")]
    >>> cycles_to_depth(scenes, np.array([1e-3])).cycles.tolist()
    [[140.0], [484.0]]
    """
    wear = np.asarray(wear, dtype=float)

    def together(some: Sequence[Scene]) -> Answer:
        count, error = np.full((2, len(some), len(wear)), np.inf)
        todo, reach = np.arange(len(some)), LEAST
        while len(todo):
            reach = min(reach * FARTHER, MOST_CYCLES)
            found = _orbit([some[i] for i in todo.tolist()], reach, rtol)
            cycles, missed = found.until(np.broadcast_to(wear, (len(todo), len(wear))))
            cycles[cycles > reach] = np.inf
            count[todo], error[todo] = cycles, missed / np.maximum(cycles, 1.0)
            more = np.isinf(cycles).any(axis=1) & ~found.at_rest
            todo = todo[more] if reach < MOST_CYCLES else todo[:0]
        return count, np.where(np.isinf(count), 0.0, error)

    def alone(scene: Scene) -> Answer:
        return cycles_until(bind(scene), scene.load, wear, rtol)[:2]

    fewer = [resampled(scene, rtol) for scene in scenes]
    some = [each.scene for each in fewer]
    count, error = _each(some, len(wear), together, alone, Pace(progress))
    return CyclesToDepth(count, error + np.array([[each.error] for each in fewer]))


Answer = tuple[FloatArray, FloatArray]


def _orbit(scenes: Sequence[Scene], cycles: float, rtol: float) -> Orbit:
    """Return the orbit of scenes of one variant, so many cycles of each."""
    if scenes[0].contact.ends_at_3_sigma:
        wanted = [Wanted(bind(scene), scene.periodic_load, cycles) for scene in scenes]
        return joined([found.orbit for found in counted_stages(wanted, rtol)])
    none = np.zeros(len(scenes))
    return orbit(equation_of(scenes), cycles + none, rtol, none, none)


@np.errstate(all="ignore")
def _each(
    scenes: Sequence[Scene],
    number: int,
    together: Callable[[Sequence[Scene]], Answer],
    alone: Callable[[Scene], Answer],
    pace: Pace,
) -> Answer:
    """Return two numbers (scenes, number) of every scene: of those of one variant `together`, of
    those whose load consists of blocks each `alone`."""
    first, second = np.empty((2, len(scenes), number))
    pace.begin("scene", len(scenes))
    done = 0
    for which in groups(scenes):
        some = [scenes[i] for i in which.tolist()]
        lone = isinstance(some[0].load, Blocks)
        first[which], second[which] = alone(some[0]) if lone else together(some)
        done += len(which)
        pace.at(done)
    return first, second


def groups(scenes: Sequence[Scene]) -> Iterator[IntArray]:
    """Return which scenes are solved together: those of one variant whose loads repeat, no more
    than go together; with loss of contact only those under loads that are all straight between
    corners, or all waves; a scene with a load in blocks is alone."""
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
