"""Inside the cycles: the wear and the fields at any phases of any cycles."""

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from wear.cycles import Stage, stages
from wear.equation import WearEquation
from wear.faults import AccuracyError, UsageError
from wear.load import HistoryLoad, Loading
from wear.loss_of_contact.dense_output import SwitchedDenseOutput, switched_dense_output
from wear.model import Fields, Model
from wear.numerics.gauss import FloatArray
from wear.numerics.initial_value import SAFETY
from wear.numerics.tolerances import TINY
from wear.orbit.dense_output import DenseOutput, PhaseIncrements, dense_output
from wear.orbit.iterates import Iterates
from wear.quantities import columns_of
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

    def columns(self) -> dict[str, FloatArray]:
        """Return the quantities by their names in files, (n, m), the error (n,)."""
        wear, error = {"bearing_wear_mm": self.u}, {"error_estimate": self.error}
        return wear | columns_of(self.fields) | error


def fields_inside(
    model: Model,
    load: Loading,
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
    for stretch in stages(model, load, cycles[-1] + 1.0, rtol):
        for begin, end, within in _dense(model, stretch, phases, rtol, cycles):
            wanted = cycles[(cycles >= begin) & (cycles < end)]
            part = _Part(model, stretch, within, phases, begin)
            for at in range(0, len(wanted), BATCH):
                yield from part.rows(wanted[at : at + BATCH], rows, rtol)
    if stretch.ends <= cycles[-1]:
        raise AccuracyError(f"the wear after {stretch.ends:.0f} cycles could not be found")


def _dense(
    model: Model, stretch: Stage, phases: FloatArray, rtol: float, cycles: FloatArray
) -> Iterator[tuple[float, float, DenseOutput | SwitchedDenseOutput]]:
    """Yield the parts of a stretch in which some of the `cycles` lie: from which cycle to which,
    that excluded, and what these add up to the phases."""
    if model.ends_at_3_sigma:
        if np.any((cycles >= stretch.begins) & (cycles < stretch.ends)):
            within = switched_dense_output(model, stretch.load, phases, rtol)
            yield stretch.begins, stretch.ends, within
        return
    equation, segments = WearEquation(model, (stretch.load,)), stretch.found.orbit.segments
    begins = [stretch.begins + float(segment.begins[0]) for segment in segments]
    observable = model.pressure if model.compliant else None
    for begin, end, segment in zip(begins, [*begins[1:], stretch.ends], segments, strict=True):
        if np.any((cycles >= begin) & (cycles < end)):
            assert isinstance(segment.iterates, Iterates)
            yield begin, end, dense_output(equation, segment.iterates, phases, rtol, observable)


class _Part(NamedTuple):
    """A part of a stretch, from the cycle that it `begins` with, and what its cycles add up to
    some `phases`."""

    model: Model
    stretch: Stage
    within: DenseOutput | SwitchedDenseOutput
    phases: FloatArray
    begins: float

    def rows(self, cycles: FloatArray, at_once: int, rtol: float) -> Iterator[Inside]:
        """Return the states in `cycles` (n,), so many cycles at once."""
        # Where the wear rate rises or contact grazes, an error grows within the cycle.
        ends = np.unique(np.concatenate([cycles, cycles + 1.0]))
        wear, wrong = self.stretch.after(ends)
        first, last = np.searchsorted(ends, cycles), np.searchsorted(ends, cycles + 1.0)
        starts, wrong = wear[first], np.maximum(wrong[first], wrong[last])
        for at in range(0, len(cycles), at_once):
            here = slice(at, at + at_once)
            added = self.within.added(cycles[here] - self.begins, starts[here])
            u = starts[here, None] + added.increment
            absolute = wrong[here] + SAFETY * added.error
            error = np.nan_to_num(absolute / (wear[last[here]] + TINY), nan=np.inf)
            yield Inside(cycles[here], self.phases, u, self.fields(u, added, rtol), error)

    def fields(self, u: FloatArray, added: PhaseIncrements, rtol: float) -> Fields:
        """Return all fields; on a compliant support from the interpolated pressure, if right."""
        load = self.stretch.load
        if added.observable is not None and np.max(added.observable_error) <= rtol:
            return self.model.fields_under(added.observable, u, load(self.phases))
        return fields_under_load(
            self.model, u, load(self.phases), load.slope(self.phases) / load.period
        )
