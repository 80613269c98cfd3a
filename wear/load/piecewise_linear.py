"""Piecewise linear displacements and forces, given by rows: periodic tables, measured histories."""

from __future__ import annotations

import dataclasses
import math
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar, Self, TypeVar

import numpy as np
from pydantic import Field, model_validator
from pydantic_core import ArgsKwargs

from wear.load.csv_file import ForceFile, HistoryFile, RowsFile, TableFile, order_faults, read_rows
from wear.load.periodic import inside, within_cycle
from wear.numerics.gauss import FloatArray
from wear.quantities import unit_of
from wear.validation import EntryError, Positive, Reals, SceneTable, table, wrong

T = TypeVar("T", "Table", "ForceTable", "HistoryLoad")
SEAM_TOLERANCE = 1e-9  # of the swing: a period of computed values closes up to their roundoff


class Lines:
    """Values on straight lines between rows, given by their abscissae and values."""

    if TYPE_CHECKING:

        @cached_property
        def _abscissae(self) -> FloatArray: ...

        @cached_property
        def _values(self) -> FloatArray: ...

    @cached_property
    def minimum(self) -> float:
        return float(np.min(self._values))

    @cached_property
    def maximum(self) -> float:
        return float(np.max(self._values))

    @cached_property
    def mean(self) -> float:
        areas = 0.5 * np.diff(self._abscissae) * (self._values[1:] + self._values[:-1])
        return math.fsum(areas.tolist()) / float(self._abscissae[-1] - self._abscissae[0])

    def _interpolated(self, at: FloatArray) -> FloatArray:
        """Return the values on the straight lines between the rows."""
        return np.asarray(np.interp(at, self._abscissae, self._values))

    def _slope(self, at: FloatArray) -> FloatArray:
        """Return the slope at each abscissa; at a row, that of the line to its right."""
        slopes = np.diff(self._values) / np.diff(self._abscissae)
        line = np.searchsorted(self._abscissae, at, side="right") - 1
        return np.asarray(slopes[np.clip(line, 0, len(slopes) - 1)])


@table("")
class _Rows(Lines, SceneTable):
    """Values at times in s that rise from 0; `value_field` names the field of the values."""

    value_field: ClassVar[str] = "values_mm"
    times_s: Reals = Field(description="times of the rows, from 0")

    @property
    def rows(self) -> tuple[float, ...]:
        """Return the value of each row, in mm, or in N for a force."""
        values: tuple[float, ...] = getattr(self, self.value_field)
        return values

    @cached_property
    def _values(self) -> FloatArray:
        return np.asarray(self.rows)

    @cached_property
    def _abscissae(self) -> FloatArray:
        """Return the abscissae of the rows: their times."""
        return np.asarray(self.times_s)

    def __repr__(self) -> str:
        values, duration, unit = self.rows, self.times_s[-1], unit_of(self.value_field)
        within = f"{min(values):g} to {max(values):g} {unit} in {duration:g} s"
        return f"<{type(self).__name__}: {len(values)} rows, {within}>"

    @model_validator(mode="after")
    def _check_order(self) -> Self:
        rows = len(self.times_s)
        if rows < 2 or len(self.rows) != rows:
            problem = f"there are {rows} times and {len(self.rows)} values"
            raise wrong(problem, "give as many of both, from 2 on", "times_s")
        if faults := order_faults(np.asarray(self.times_s)):
            raise EntryError(*((("times_s",), problem, remedy) for _, problem, remedy in faults))
        return self


@table("")
class _PeriodicRows(_Rows):
    """Straight lines between rows over one period; the first row, at t = 0, is also the last."""

    @model_validator(mode="after")
    def _check_closed(self) -> Self:
        first, last = self.rows[0], self.rows[-1]
        if first != last:
            problem = f"the load jumps at the seam from {last!r} to {first!r}"
            raise wrong(problem, "repeat the first in the last row", self.value_field)
        return self

    @cached_property
    def _abscissae(self) -> FloatArray:
        """Return the abscissae of the rows: their phases."""
        return np.asarray(self.times_s) / self.period

    def __call__(self, phase: FloatArray | float) -> FloatArray:
        return self._interpolated(within_cycle(phase))

    def slope(self, phase: FloatArray | float) -> FloatArray:
        return self._slope(within_cycle(phase) % 1.0)

    def gradient(self, phase: FloatArray) -> dict[str, FloatArray]:
        at, rows = within_cycle(phase), np.eye(len(self.rows))
        rows[0, -1] = 1.0  # the seam
        hats = (np.interp(at, self._abscissae, row) for row in rows[:-1])
        return {f"{self.value_field}[{j}]": hat for j, hat in enumerate(hats)}

    @property
    def period_s(self) -> float:
        """Return T; notices look at it as at that of other loads."""
        return self.times_s[-1]

    @property
    def period(self) -> float:
        return self.period_s

    @cached_property
    def kinks(self) -> tuple[float, ...]:
        return tuple(self._abscissae[:-1].tolist())

    @cached_property
    def peaks(self) -> tuple[float, ...]:
        rises = np.sign(np.diff(self._values))
        moving = np.flatnonzero(rises)
        if len(moving) == 0:
            return (0.0,)
        falls_next = (rises[moving] > 0.0) & (rises[np.roll(moving, -1)] < 0.0)
        return tuple(np.sort(self._abscissae[moving[falls_next] + 1] % 1.0).tolist())


@table("")
class Table(_PeriodicRows):
    """U_a in mm by straight lines between rows over one period.

    `times_s` runs from 0 to the period. `source` is the file of the rows, if any.

    >>> saw = Table((0.0, 0.5, 2.0), (0.0, 1e-3, 0.0))
    >>> saw.period, saw.kinks, saw.peaks, float(saw(0.125))
    (2.0, (0.0, 0.25), (0.25,), 0.0005)
    """

    values_mm: Reals = Field(description="U_a at these times")
    source: TableFile | None = Field(default=None, exclude=True)
    __repr__ = _Rows.__repr__


@table("")
class ForceTable(_PeriodicRows):
    """R_a in N by straight lines between rows over one period."""

    value_field: ClassVar[str] = "forces_N"
    forces_N: Reals = Field(description="R_a at these times")
    source: ForceFile | None = Field(default=None, exclude=True)
    __repr__ = _Rows.__repr__

    @model_validator(mode="after")
    def _check_sign(self) -> Self:
        if self.minimum < 0.0 or self.maximum == 0.0:
            problem = f"the force goes from {self.minimum:g} to {self.maximum:g} N"
            raise wrong(problem, "give forces >= 0, not all of them zero", "forces_N")
        return self


@table("")
class HistoryLoad(_Rows):
    """Straight lines between measured rows, from t = 0 to the last row; it does not repeat.

    Its phase is the time in s; `period_s` only counts cycles. Times outside the rows are a
    `UsageError`.
    """

    period: ClassVar[float] = 1.0

    values_mm: Reals = Field(description="U_a at these times")
    period_s: Positive = Field(description="time of a cycle")
    source: HistoryFile | None = Field(default=None, exclude=True)
    __repr__ = _Rows.__repr__

    @model_validator(mode="after")
    def _check_duration(self) -> Self:
        if self.cycles < 1.0 - SEAM_TOLERANCE:
            problem = f"is longer than the rows, which end at t_s = {self.duration!r}"
            raise wrong(problem, "give the time of a cycle, or drop it", "period_s")
        return self

    def __call__(self, time: FloatArray | float) -> FloatArray:
        return self._interpolated(inside(time, self.duration))

    def slope(self, time: FloatArray | float) -> FloatArray:
        return self._slope(inside(time, self.duration))

    def breakpoints(self, start: float, end: float) -> FloatArray:
        first = np.searchsorted(self._abscissae, start, side="right")
        return self._abscissae[first : np.searchsorted(self._abscissae, end, side="left")]

    @property
    def duration(self) -> float:
        return self.times_s[-1]

    @property
    def cycles(self) -> float:
        return self.duration / self.period_s

    def time_at(self, cycles: FloatArray | float) -> FloatArray:
        """Return the time in s after numbers of cycles."""
        return inside(np.asarray(cycles) * self.period_s, self.duration)


class HistoryPart(Lines):
    """A part of a measured history, by lines between `times` (s), as a function of the phase: the
    time since `start` over a `period`, both in s."""

    peaks: ClassVar[tuple[float, ...]] = ()  # all of them are kinks

    def __init__(
        self, history: HistoryLoad, times: FloatArray, start: float, period: float
    ) -> None:
        self.period = period
        self._abscissae, self._values = (times - start) / period, history(times)

    def __call__(self, phase: FloatArray | float) -> FloatArray:
        return self._interpolated(np.asarray(phase))

    def slope(self, phase: FloatArray | float) -> FloatArray:
        return self._slope(np.asarray(phase))

    def gradient(self, phase: FloatArray) -> dict[str, FloatArray]:
        """Return no derivatives: the rows of a history are no parameters."""
        return {}

    @property
    def kinks(self) -> tuple[float, ...]:
        return tuple(self._abscissae[1:-1].tolist())


def history_cycle(history: HistoryLoad, first: int) -> HistoryPart:
    """Return the cycle of a measured history that begins after `first` cycles."""
    start, end = history.time_at(np.minimum([first, first + 1], history.cycles)).tolist()
    times = np.array([start, *history.breakpoints(start, end), end])
    if start == end:  # after the last cycle: its last line
        times = np.array(history.times_s[-2:])
    return HistoryPart(history, times, start, history.period_s)


def load_from_file(form: RowsFile, folder: Path | None) -> Table | ForceTable | HistoryLoad:
    """Return the load of a CSV file, or raise pydantic's `ValidationError` with all its faults."""
    rows = read_rows(form, folder)
    times, values = rows.times, rows.values
    source = dataclasses.replace(form, sha256=rows.sha256)
    if isinstance(source, HistoryFile):
        period = form.period_s or float(times[-1])
        return _validated(HistoryLoad, _floats(times), _floats(values), period, source)
    assert isinstance(source, TableFile)
    times, values = _one_period(times, values, form.period_s, source.repeat)
    if isinstance(source, ForceFile):
        return _validated(ForceTable, _floats(times), _floats(values), source)
    return _validated(Table, _floats(times), _floats(values), source)


def _validated(kind: type[T], *fields: object) -> T:
    """Return a load of these fields; unlike its constructor, raise pydantic's `ValidationError`."""
    validator = kind.__pydantic_validator__  # type: ignore[attr-defined]
    load: T = validator.validate_python(ArgsKwargs(fields))
    return load


def _floats(array: FloatArray) -> tuple[float, ...]:
    return tuple(array.tolist())


def _one_period(
    times: FloatArray, values: FloatArray, period: float | None, repeat: bool
) -> tuple[FloatArray, FloatArray]:
    """Return rows over one period, the last of which repeats the first: those of the file, or
    to `repeat` a record those before the end of the period, closed by a straight line."""
    last, step = float(times[-1]), float(np.median(np.diff(times))) if repeat else 0.0
    period = last + step if period is None else period
    slack = SEAM_TOLERANCE * period
    if repeat and period > last + step + slack:
        problem = f"the record ends at t_s = {last!r}, before the period does"
        raise wrong(problem, "give a shorter period, or drop period_s", "period_s")
    if not repeat and period < last - slack:
        problem = f"the rows run to t_s = {last!r}, past the period"
        remedy = "drop period_s or correct it, or take one period of the record by repeat = true"
        raise wrong(problem, remedy, "period_s")
    kept = times < period - slack if repeat else times < max(last, period - slack)
    if repeat and not kept[1]:
        problem = f"is not longer than the time from row to row, {float(times[1])!r} s"
        raise wrong(problem, "give the time of a period, in s", "period_s")
    first, end = values[[0, -1]].tolist()
    if not repeat and not kept[-1] and abs(end - first) > SEAM_TOLERANCE * np.ptp(values):
        problem = f"the load jumps at the seam from {end!r} to {first!r}"
        remedy = "repeat the first value in the last row, give a later period_s, or repeat = true"
        raise wrong(problem, remedy, "file")
    return np.append(times[kept], period), np.append(values[kept], first)
