"""Stretches of wear on which the increments of a cycle are known, with the count of cycles."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from wear.loss_of_contact.arrest import TO_ROUNDOFF
from wear.loss_of_contact.increments import Increments
from wear.loss_of_contact.parts import ENOUGH, OnPanels, solved
from wear.loss_of_contact.plan import Problem
from wear.numerics.gauss import FloatArray, IntArray
from wear.orbit import abel
from wear.orbit.iterates import cells

WIDEST = 12.0  # panel of a count to a limit wear, in ln z: what derivatives are smooth on
CALM = 24.0  # cycles that the distance to a grazing wear would last: then Abel's equation is solved
MOST_WALKED = 120  # cycles on a series that are taken one by one
LOOKS = 65  # at a series, for how many cycles it takes
MOST_POOR = 8  # times that panels may hold too few cycles


class Stretch(NamedTuple):
    """A stretch of wear on which the increments are known by their `series`, up to `end` in z; and,
    if it takes many cycles, those `counted`."""

    series: Increments
    end: float
    counted: OnPanels | None


def stretch(series: Increments, problem: Problem) -> Stretch:
    """Return the stretch of a series, with its count if cycles are many."""
    span, coordinate = series.span, series.coordinate
    begin, end = coordinate.at(np.array([span.start, span.end])).tolist()
    end = 1.0 / (TO_ROUNDOFF * coordinate.origin) if span.tends else end
    for attempt in range(MOST_POOR):
        looks, gains, calm = _looks(series, begin, end)
        if np.sum(gains) < MOST_WALKED:
            break
        number = float(np.sum(gains[calm[0] : calm[-1]])) if len(calm) else 0.0
        fewest = ENOUGH * problem.size.panel_nodes
        if number >= 2 * fewest:
            edges = looks[calm[[0, -1]]]
            to_limit = span.tends and edges[1] >= end * (1 - 1e-9)
            limit_wear = problem.limit_wear if to_limit else None
            if limit_wear is not None:  # derivatives of cycles are known up to a distance
                known = 1.0 / limit_wear.nearest
                before = np.sum(gains[(looks[1:] <= known) & (looks[1:] > edges[0])])
                if fewest < before < number - fewest:
                    pieces = math.ceil(math.log(known / edges[0]) / WIDEST)
                    edges = np.append(np.geomspace(edges[0], known, pieces + 1), edges[1])
            panels, residual, poor = solved(series, edges, problem.size)
            if not poor or attempt == MOST_POOR - 1:
                count = OnPanels(cells(panels), panels, residual, series, limit_wear)
                return Stretch(series, end, count)
            begin = float(edges[0])
        # It is too early for panels: some cycles more are taken one by one.
        wear = float(coordinate.wear(np.array(begin)))
        begin = float(coordinate.at(np.array(series.walk(wear, end, 2 * MOST_WALKED)[-1])))
        if not begin < end:
            break
    return Stretch(series, end, None)


def _looks(series: Increments, begin: float, end: float) -> tuple[FloatArray, FloatArray, IntArray]:
    """Return values of z from one to another, how many cycles it takes between them, about, and at
    which of them the increments are small."""
    coordinate = series.coordinate
    shift = coordinate.shift
    whole = abel.frame(shift, np.array([begin]), np.array([end]))
    t = np.linspace(-1.0, 1.0, LOOKS)
    looks = whole.states(t)[0]
    lasts = (looks + shift) / coordinate.step(looks, series.at(looks))
    gains = (lasts[1:] + lasts[:-1]) / 2 * np.diff(whole.y_at(t)[0])
    return looks, gains, np.flatnonzero(lasts >= CALM)
