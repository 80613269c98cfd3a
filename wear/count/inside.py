"""Inside the cycles: the wear and the fields at any phases of any cycles."""

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from wear.count.blocks import growth
from wear.count.build import CycleCount
from wear.count.course import Added, Course, course
from wear.count.course_cutoff import CutoffCourse, cutoff_course
from wear.count.panels import SAFETY
from wear.count.stage import Stage, Stages, evaluate_stages
from wear.count.stages import counted_stages
from wear.direct.sequence import span
from wear.faults import AccuracyError, UsageError
from wear.load import AperiodicLoad, HistoryLoad, Load
from wear.model import Fields, Model
from wear.numerics.gauss import (
    FloatArray,
)
from wear.numerics.tolerances import (
    TINY,
)
from wear.states import fields_under_load

CHUNK = 32_000  # states computed at once: their arrays stay in the processor's cache
BATCH = 10_000  # cycles of which the wear at the start is found at once


class Inside(NamedTuple):
    """A chunk of a history: whole `cycles` (n,), `phases` (m,) in [0, 1], bearing wear `u` (n, m)
    in mm at (cycles + phases) T, all `fields` (n, m), in mm and MPa, and the estimated `error`
    (n,) of u, relative to the wear at the end of the cycle."""

    cycles: FloatArray
    phases: FloatArray
    u: FloatArray
    fields: Any
    error: FloatArray


def fields_inside(
    model: Model,
    load: Load | AperiodicLoad,
    cycles: FloatArray,
    phases: FloatArray,
    rtol: float = 1e-12,
    chunk: int = CHUNK,
) -> Iterator[Inside]:
    """The state at every phase of every cycle, some `chunk` states at a time.

    Parameters
    ----------
    load
        One that repeats, or blocks of such.
    cycles
        Whole numbers of cycles (n,) that lie behind, each less than the load has.
    phases
        In [0, 1], (m,), of the cycle that begins then.

    Yields
    ------
    Inside
        rows of the history, by rising numbers of cycles; memory is bounded by the chunk.

    Raises
    ------
    AccuracyError
        if the wear that a block begins with could not be found.
    UsageError
        if the cycles cannot be counted.
    """
    if isinstance(load, HistoryLoad):
        raise UsageError("the load does not repeat: its cycles cannot be counted")
    cycles, phases = np.sort(np.asarray(cycles, dtype=float)), np.asarray(phases, dtype=float)
    rows = max(1, chunk // max(1, len(phases)))
    for stretch in _stretches(model, load, float(cycles[-1]), rtol):
        stages = stretch.found.stages
        begins = stretch.begins + np.array([stage.begins for stage in stages])
        for stage, begin, end in zip(
            stages, begins, np.append(begins[1:], stretch.ends), strict=True
        ):
            wanted = cycles[(cycles >= begin) & (cycles < end)]
            if len(wanted) == 0:
                continue
            part = _Part(
                model, stretch, _within(model, stretch, stage, phases, rtol), phases, begin
            )
            for at in range(0, len(wanted), BATCH):
                yield from part.rows(wanted[at : at + BATCH], rows, rtol)


class _Stretch(NamedTuple):
    """Cycles from `begins` to `ends`, that excluded, of one load that repeats, counted in stages
    from wear that may be wrong by `inherited` (mm)."""

    load: Load
    begins: float
    ends: float
    found: Stages
    inherited: float


def _stretches(
    model: Model, load: Load | AperiodicLoad, last: float, rtol: float
) -> Iterator[_Stretch]:
    """The way to cycle `last` and over it, block by block."""
    wear, missed, done = 0.0, 0.0, 0
    while done <= last:
        acting, until = span(load, done)
        length = min(float(until), last + 1.0) - done
        found = counted_stages(model, acting, length, rtol, wear)
        after, error = (float(x[0]) for x in evaluate_stages(found, np.array([length])))
        missed *= growth(model, acting, wear, after)
        yield _Stretch(acting, float(done), done + length, found, missed)
        wear, missed, done = after, missed + error * after, until
        if done <= last and not missed < np.inf:
            raise AccuracyError(f"the wear after {done} cycles could not be found")


def _within(
    model: Model, stretch: _Stretch, stage: Stage, phases: FloatArray, rtol: float
) -> Course | CutoffCourse:
    """What cycles of the stage add up to the phases."""
    if isinstance(stage.counted, CycleCount) and not model.ends_at_3_sigma:
        return course(model, stretch.load, stage.counted, phases, rtol)
    return cutoff_course(model, stretch.load, phases, rtol)


class _Part(NamedTuple):
    """A stage of a stretch, from the cycle that it `begins` with, and what its cycles add up to
    some `phases`."""

    model: Model
    stretch: _Stretch
    within: Course | CutoffCourse
    phases: FloatArray
    begins: float

    def rows(self, cycles: FloatArray, at_once: int, rtol: float) -> Iterator[Inside]:
        """The states in `cycles` (n,), so many cycles at once."""
        # Where wear gathers pace or contact ends at a touch, an error grows within the cycle.
        ends = np.unique(np.concatenate([cycles, cycles + 1.0]))
        wear, wrong = self._before(ends)
        first, last = np.searchsorted(ends, cycles), np.searchsorted(ends, cycles + 1.0)
        starts, wrong = wear[first], np.maximum(wrong[first], wrong[last])
        for at in range(0, len(cycles), at_once):
            here = slice(at, at + at_once)
            added = self.within.added(cycles[here] - self.begins, starts[here])
            u = starts[here, None] + added.wear
            missed = wrong[here] + SAFETY * added.missed
            error = np.nan_to_num(missed / (wear[last[here]] + TINY), nan=np.inf)
            yield Inside(cycles[here], self.phases, u, self.fields(u, added, rtol), error)

    def _before(self, cycles: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The wear after `cycles` (n,) and what it may be wrong by, mm."""
        wear, error = evaluate_stages(self.stretch.found, cycles - self.stretch.begins)
        return wear, error * wear + self.stretch.inherited

    def fields(self, u: FloatArray, added: Added, rtol: float) -> Fields:
        """All fields; on a compliant support from the interpolated pressure where that is right."""
        load = self.stretch.load
        if added.pressure is not None and np.max(added.off) <= rtol:
            return self.model.fields_under(added.pressure, u, load(self.phases))
        return fields_under_load(
            self.model, u, load(self.phases), load.slope(self.phases) / load.period
        )
