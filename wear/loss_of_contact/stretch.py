"""Stretches of wear on which the increments of a cycle are known, with the count of cycles."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from wear.loss_of_contact.increments import Increments, Span, frame_of
from wear.loss_of_contact.parts import ENOUGH, OnPanels, on_a_line, solved
from wear.loss_of_contact.plan import Problem
from wear.numerics.gauss import FloatArray, IntArray
from wear.orbit.iterates import cells

CALM = 24.0  # cycles that the distance to a grazing wear would last: then Abel's equation is solved
MOST_WALKED = 120  # cycles on a series that are taken one by one
LOOKS = 65  # at a series, for how many cycles it takes
MOST_POOR = 8  # times that panels may hold too few cycles


class Stretch(NamedTuple):
    """A `span` on which the increments are known by their `series`, up to `end` in z; and, if it
    takes many cycles, those `counted`."""

    span: Span
    series: Increments
    end: float
    counted: OnPanels | None


def stretch(span: Span, series: Increments, problem: Problem) -> Stretch:
    """Return the stretch of a span, with its count if cycles are many."""
    coordinate = span.coordinate
    begin, end = coordinate.at(np.array([span.start, span.end])).tolist()
    end = series.end if span.tends else end
    for attempt in range(MOST_POOR):
        looks, gains, calm = _looks(series, begin, end)
        if np.sum(gains) < MOST_WALKED:
            break
        number = float(np.sum(gains[calm[0] : calm[-1]])) if len(calm) else 0.0
        if number >= 2 * ENOUGH * problem.size.panel_nodes:
            first, last = float(looks[calm[0]]), float(looks[calm[-1]])
            before = float(np.sum(gains[looks[1:] <= series.frame.starts[-1]]))
            line = before > ENOUGH * problem.size.panel_nodes
            count, poor = _counted(span, series, first, last, line, problem)
            if not poor or attempt == MOST_POOR - 1:
                return Stretch(span, series, end, count)
            begin = first
        # It is too early for panels: some cycles more are taken one by one.
        wear = float(coordinate.wear(np.array(begin)))
        begin = float(coordinate.at(np.array(series.walk(wear, end, 2 * MOST_WALKED)[-1])))
        if not begin < end:
            break
    return Stretch(span, series, end, None)


def _looks(series: Increments, begin: float, end: float) -> tuple[FloatArray, FloatArray, IntArray]:
    """Return values of z from one to another, how many cycles it takes between them, about, and at
    which of them the increments are small."""
    coordinate = series.coordinate
    shift = coordinate.shift
    width = np.log1p([(end - begin) / (begin + shift)])
    whole = frame_of(coordinate, np.array([begin]), width)
    t = np.linspace(-1.0, 1.0, LOOKS)
    looks = whole.states(t)[0]
    lasts = (looks + shift) / coordinate.step(looks, series.at(looks))
    gains = (lasts[1:] + lasts[:-1]) / 2 * np.diff(whole.y_at(t)[0])
    return looks, gains, np.flatnonzero(lasts >= CALM)


def _counted(
    span: Span, series: Increments, first: float, last: float, line: bool, problem: Problem
) -> tuple[OnPanels, bool]:
    """Return the count by Abel's equation from one z to another, at last on a `line` to the limit
    wear if that is to be; and whether it is poor."""
    tends = span.tends and last >= series.end * (1 - 1e-9)
    limit_wear = problem.limit_wear if tends else None
    line &= limit_wear is not None
    last = float(series.frame.starts[-1]) if line else last
    panels, residual, poor = solved(series, first, last, problem.size)
    if line:
        panels, residual = on_a_line(panels, residual, series)
    return OnPanels(cells(panels), panels, residual, series, limit_wear, line), poor
