"""The wear that a cycle adds between two grazing wears: a series, from a few cycles integrated.

Where contact grazes a turning point of the load the one-cycle map has a branch point: the time of
contact begins or ends like a root of the distance d to that wear. In ln d such a root is entire.
So between two grazing wears the logarithm of the increment D(u) is a Chebyshev series of few
coefficients: in ln(u - a) on the way out of one, in -ln(b - u) on the way to the next, and in
u/(u + c) far from both. All nodes of all stretches are cycles that are integrated at once. What
follows, Abel's equation and single cycles, asks the series.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from typing import NamedTuple

import numpy as np

from wear.loss_of_contact.requests import COARSE, Asking, Request
from wear.numerics.chebyshev import chebyshev_analysis, chebyshev_nodes, chebyshev_values
from wear.numerics.gauss import FloatArray, IntArray
from wear.numerics.rows import take
from wear.orbit.abel import Frame
from wear.orbit.iterates import cell_of
from wear.orbit.panels import CHECKS, SPLIT
from wear.orbit.problem import Cost

MOST_ROUNDS = 6  # of cutting panels: those that are not resolved then are not used
GRAIN = 16.0  # times the uncertainty of a distance: what rounding may make of the increment
WIDE = 2.0  # panel, in ln(z + shift): it is cut in the middle of that
FAR_OFF = 1e3  # times the tolerance: then a panel is cut in four, else in two
USABLE = 10.0  # times the tolerance: the estimate of error reports the rest
EASED = 10.0  # at most: an error of the distance is a smaller one of the wear


class Coordinate(NamedTuple):
    """A function z of the wear u (mm) that rises with it: u - origin, or 1/(origin - u) if the
    origin lies `ahead`. Series run in ln z without a `shift`, else in z/(z + shift)."""

    origin: float
    ahead: bool = False
    shift: float = 0.0

    def at(self, wear: FloatArray) -> FloatArray:
        """Return z at each wear (mm)."""
        return np.asarray(1.0 / (self.origin - wear) if self.ahead else wear - self.origin)

    def wear(self, z: FloatArray) -> FloatArray:
        """Return the wear (mm) at each z."""
        return np.asarray(self.origin - 1.0 / z if self.ahead else z + self.origin)

    def step(self, z: FloatArray, increment: FloatArray) -> FloatArray:
        """Return by how much z rises as the wear does by an `increment` (mm)."""
        if not self.ahead:
            return increment
        taken = z * increment
        return np.asarray(z * taken / (1.0 - taken))

    def rate(self, z: FloatArray, rate: FloatArray) -> FloatArray:
        """Return the wear per cycle (mm) where z rises at the `rate` per cycle."""
        return np.asarray(rate / z**2 if self.ahead else rate)


def frame_of(coordinate: Coordinate, starts: FloatArray, widths: FloatArray) -> Frame:
    """Return panels of z from `starts` (p,), `widths` wide in ln(z + shift)."""
    return Frame(np.full(len(starts), coordinate.shift), starts, widths)


class Increments(NamedTuple):
    """ln(D/level) on a `frame` of panels of z: Chebyshev `series` (p, m) less a `level` (p,), mm;
    `misfit` (p, 6) is the relative difference to cycles from the CHECKS, and what these have
    missed."""

    coordinate: Coordinate
    frame: Frame
    level: FloatArray
    series: FloatArray
    misfit: FloatArray

    @property
    def end(self) -> float:
        """Return the z at which the last panel ends."""
        return float(self.frame.ends[-1])

    def _located(self, z: FloatArray) -> tuple[IntArray, FloatArray]:
        """Return the panel that holds each z (k,), or the nearest, and the position on it."""
        i = cell_of(self.frame.starts, z)
        return i, take(self.frame, i).positions(z[:, None])[:, 0]

    def at(self, z: FloatArray) -> FloatArray:
        """Return the wear (mm) that a cycle adds from each z (any shape)."""
        i, t = self._located(z.ravel())
        basis = chebyshev_values(t, self.series.shape[1])
        increment = self.level[i] * np.exp(np.einsum("ij,ij->i", basis, self.series[i]))
        return np.asarray(increment.reshape(z.shape))

    def missed(self, z: FloatArray) -> FloatArray:
        """Return the relative error of the increment at each z (k,): the larger misfit of the two
        checks next to it."""
        i, t = self._located(z)
        after = np.clip(np.searchsorted(CHECKS, t), 1, len(CHECKS) - 1)
        return np.asarray(np.maximum(self.misfit[i, after], self.misfit[i, after - 1]))

    def walk(self, wear: float, end: float, most: float) -> list[float]:
        """Return the wear (mm) before and after each cycle from `wear` until z passes `end`, or
        until there are `most`."""
        origin, ahead, shift = self.coordinate
        starts, widths = self.frame.starts.tolist(), self.frame.widths.tolist()
        series, level = [row[::-1] for row in self.series.tolist()], self.level.tolist()
        walked, left = [wear], origin - wear
        z = 1.0 / left if ahead else -left
        while z < end and len(walked) <= most:
            i = max(bisect_right(starts, z) - 1, 0)
            y = math.log1p((z - starts[i]) / (starts[i] + shift))
            part = math.expm1(-y) / math.expm1(-widths[i]) if shift else y / widths[i]
            twice = 4.0 * part - 2.0
            last = before = 0.0
            for coefficient in series[i]:  # Clenshaw
                last, before = coefficient + twice * last - before, last
            left -= level[i] * math.exp(last - before * twice / 2.0)
            if not math.isfinite(left) or (ahead and left <= 0.0):
                break
            walked.append(origin - left)
            z = 1.0 / left if ahead else -left
        return walked

    def on_a_line(self, width: float) -> Increments:
        """Return the same with one panel more, `width` wide in ln z, on which ln D goes on as a
        straight line of slope -1, as in geometric decay. What the last slope differs by is its
        misfit."""
        last_width = float(self.frame.widths[-1])
        e_fold = min(1.0, last_width)
        t = 1.0 - 2.0 * e_fold / last_width * np.array([1.0, 0.0])
        before, last = chebyshev_values(t, self.series.shape[1]) @ self.series[-1]
        slope = (last - before) / e_fold
        power = -np.clip(np.round(-2 * slope) / 2, 1.0, 2.0)
        line = np.zeros((1, self.series.shape[1]))
        line[0, :2] = power * width / 2
        return Increments(
            self.coordinate,
            self.frame.with_panel(self.end, width),
            np.append(self.level, self.level[-1] * np.exp(last)),
            np.concatenate([self.series, line]),
            np.vstack([self.misfit, np.full(len(CHECKS), abs(slope - power))]),
        )


class Span(NamedTuple):
    """Where increments are wanted: from the wear `start` to `end` (mm) in a coordinate, whose
    origin rounding leaves an `uncertainty` (mm); and on to it if wear `tends` there for ever."""

    coordinate: Coordinate
    start: float
    end: float
    uncertainty: float = 0.0
    tends: bool = False


class _Task(NamedTuple):
    """A panel to be fitted, from `start` to `end` in z, of a `span`."""

    span: Span
    start: float
    end: float

    def pieces(self, number: int) -> list[_Task]:
        """Return the panel cut in two, or in four."""
        half = middle(self.span.coordinate.shift, self.start, self.end)
        two = [self._replace(end=half), self._replace(start=half)]
        return two if number == 2 else [part for task in two for part in task.pieces(2)]


class _Panel(NamedTuple):
    """A panel of `Increments`, up to the z where it ends."""

    start: float
    width: float
    level: float
    series: FloatArray
    misfit: FloatArray
    end: float


def fitted(
    spans: list[Span], number: int, tolerance: float
) -> Asking[tuple[list[tuple[Span, Increments]], Cost]]:
    """Fit the increments on every span, with `number` coefficients on each panel, to a relative
    `tolerance`: the panels of all spans at once, those that miss it cut in pieces. Return the parts
    of the spans on which they are known."""
    todo = [
        _Task(span, *span.coordinate.at(np.array([span.start, span.end])).tolist())
        for span in spans
    ]
    found: dict[Span, list[_Panel]] = {span: [] for span in spans}
    cost, analysis = Cost(0, 0), chebyshev_analysis(number).T
    nodes, basis = chebyshev_nodes(number), chebyshev_values(CHECKS, number).T
    for rounds in range(MOST_ROUNDS):
        if not todo:
            break
        starts, ends = (
            np.array(column) for column in zip(*(task[1:] for task in todo), strict=True)
        )
        shift = np.array([task.span.coordinate.shift for task in todo])
        widths = np.log1p((ends - starts) / (starts + shift))
        wear = _wear(todo, widths, np.append(nodes, CHECKS))
        run = yield Request(COARSE, wear.ravel())
        increment, checks = np.hsplit(run.increment.reshape(wear.shape), [number])
        cost = cost.plus(wear.size, run.evaluations)
        level = increment[:, number // 2]
        series = np.log(increment / level[:, None]) @ analysis
        misfit = np.abs(level[:, None] * np.exp(series @ basis) / checks - 1.0)
        misfit += (run.missed / run.increment).reshape(wear.shape)[:, number:]
        again: list[_Task] = []
        for i, task in enumerate(todo):
            off = float(np.max(misfit[i] / _allowed(task.span, wear[i, number:], tolerance)))
            if not off <= 1.0 and rounds < MOST_ROUNDS - 1:
                again += task.pieces(2 if off < FAR_OFF else 4)
            elif off <= USABLE:
                panel = (task.start, widths[i], level[i], series[i], misfit[i], task.end)
                found[task.span].append(_Panel(*panel))
        todo = again
    return [known for span in spans for known in _joined(span, found[span])], cost


def _allowed(span: Span, wear: FloatArray, tolerance: float) -> FloatArray:
    """Return the relative errors of the increment from each wear (k,) that are accepted."""
    origin, ahead, _ = span.coordinate
    if not ahead:
        return np.full_like(wear, tolerance)
    left = origin - wear
    eased = tolerance * np.clip(origin / left, 1.0, EASED)
    return np.asarray(np.maximum(eased, GRAIN * span.uncertainty / left))


def _joined(span: Span, panels: list[_Panel]) -> list[tuple[Span, Increments]]:
    """Return the panels that follow each other, together."""
    runs: list[list[_Panel]] = []
    for panel in sorted(panels, key=lambda panel: panel.start):
        if runs and runs[-1][-1].end == panel.start:
            runs[-1].append(panel)
        else:
            runs.append([panel])
    last = max((panel.end for panel in panels), default=0.0)
    known = []
    for run in runs:
        starts, widths, *columns, ends = (np.array(column) for column in zip(*run, strict=True))
        begin, end = span.coordinate.wear(np.array([run[0].start, run[-1].end])).tolist()
        whole = span.tends and ends[-1] == last
        part = span._replace(start=begin, end=end, tends=whole)
        frame = frame_of(span.coordinate, starts, widths)
        known.append((part, Increments(span.coordinate, frame, *columns)))
    return known


def middle(shift: float, start: float, end: float) -> float:
    """Return the z at which a panel is to be cut in two."""
    width = math.log1p((end - start) / (start + shift))
    part = -math.log1p(SPLIT * math.expm1(-width)) if shift and width < WIDE else width / 2
    return start + (start + shift) * math.expm1(part)


def _wear(tasks: list[_Task], widths: FloatArray, t: FloatArray) -> FloatArray:
    """Return the wear (tasks, len(t)) at positions of panels."""
    rows = []
    for task, width in zip(tasks, widths, strict=True):
        coordinate = task.span.coordinate
        z = frame_of(coordinate, np.array([task.start]), np.array([width])).states(t)
        rows.append(coordinate.wear(z[0]))
    return np.array(rows)
