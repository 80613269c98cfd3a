"""The plan of a count with loss of contact: where series of the increments are wanted.

By wear that is frozen over a cycle: good enough for a plan, and cheap. What the plan misses, the
misfit of the series and the residual of Abel's equation report.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from wear.equation import WearEquation
from wear.load import Load
from wear.loss_of_contact.arrest import LimitWear
from wear.loss_of_contact.grazing import fades, grazing_wears, limit_wear_of
from wear.loss_of_contact.increments import Coordinate, Span
from wear.loss_of_contact.requests import FROZEN, Asking, Request, without_feedback
from wear.loss_of_contact.switching import Edge
from wear.model import Model
from wear.numerics.gauss import FloatArray
from wear.numerics.tolerances import ROUNDOFF, TINY
from wear.orbit.period_map import Settings, settings

LEAST = 200.0  # the last panel reaches this count at least: panels are long against a cycle
STEP, STEPS_AHEAD = 0.2, 180  # in ln(u + scale)
SHIFT = 12.0  # of panels, over the scale: then one serves every regime to the end
FEWEST = 8.0  # cycles between two grazing wears for which a series pays
BEGINS = 0.03  # of the increment at a grazing wear: how far beyond it a series begins
ENDS = 0.7  # of the distance that is left: the largest increment for which a series is wanted
BEFORE = 0.95  # of the way to a grazing wear: the longest last cycle on a series
NEXT = 0.05  # of an increment: how near to a branch point a series ends
GRAIN = 4096.0  # roundoffs of the wear: the smallest distance at which cycles are counted
FACTOR, STEPS = 0.25, 21  # of distances at which one looks ahead
NEAR, NEARER = 8, 10  # of these: there a power of the distance shows
ROOT = 0.5
LEAST_LEFT = 1e-5  # of the distance to a limit wear: from there to it a series in its root goes on
RESOLVED = 1e3  # times the uncertainty of the limit wear: a distance that is known
AHEAD = 1.3  # of the cycles asked for: how far one looks ahead


class Grazing(NamedTuple):
    """A grazing wear `at` (mm), which rounding leaves an `uncertainty`; the branch points of the
    map `before` it, as starts that come nearer see them, and `behind`, as those beyond it do; and
    what a cycle adds there."""

    at: float
    before: float
    behind: float
    added: float
    uncertainty: float


class Problem(NamedTuple):
    """What is ahead of a count: the `stops` at grazing wears, rising; the `limit_wear` if wear
    tends to the last of them for ever; the wear `end` (mm) beyond which nothing has a meaning."""

    model: Model
    load: Load
    stops: list[Grazing]
    limit_wear: LimitWear | None
    end: float
    scale: float
    rtol: float
    size: Settings
    deadline: float


def problem_of(
    model: Model, load: Load, edge: Edge, rtol: float, deadline: float
) -> Asking[Problem]:
    """Return what is ahead of a count to the relative accuracy `rtol`."""
    equation = WearEquation(model, (load,))
    scale, end = float(equation.scale[0]), float(equation.limit[0])
    grazing = [each for each in grazing_wears(model, load, edge, scale) if each.wear < end]
    limit_wear = limit_wear_of(model, load, grazing[-1].wear) if grazing else None
    if limit_wear is not None and not fades(model, load, edge, limit_wear.wear):
        limit_wear = None
    # Contact grazes when the pieces before have added their part: the map has its branch point
    # where a cycle starts that much earlier.
    wear = np.array([each.wear for each in grazing])
    parts = yield Request(FROZEN, wear)
    slope = np.abs(model.margin_slope(wear, load.maximum)) + TINY
    uncertainty = ROUNDOFF * model.margin_terms(wear, load.maximum + 0.0 * wear) / slope
    stops = []
    for each, added, blur in zip(grazing, parts, uncertainty.tolist(), strict=True):
        part, whole = float(np.sum(added[: each.before])), each.before == len(added)
        tends = limit_wear is not None and each.wear == limit_wear.wear
        before = each.wear - (0.0 if tends else part)
        behind = each.wear - (0.0 if whole else part)
        stops.append(Grazing(each.wear, before, behind, float(np.sum(added)), blur))
    size = settings(rtol)
    return Problem(model, load, stops, limit_wear, end, scale, rtol, size, deadline)


def planned(problem: Problem, wear: float, cycles: float) -> Asking[tuple[list[Span], float]]:
    """Plan where increments are wanted from a `wear` (mm) on, for so many `cycles` about; return
    also the wear up to which that is a plan."""
    stops = problem.stops
    ahead = [stop for stop in stops if stop.at > wear * (1 + 8 * ROUNDOFF)]
    last = next((stop for stop in reversed(stops) if stop not in ahead), None)
    looks = yield from _looks([wear, *(stop.at for stop in ahead)], [stop.before for stop in ahead])
    spans: list[Span] = []
    counted, wanted, begin = 0.0, AHEAD * max(cycles, LEAST), wear
    for i, stop in enumerate(ahead):
        if counted > wanted:
            return spans, begin
        lefts, rights, outwards, onwards = (part[i] for part in looks)
        half = begin + lefts[0]
        numbers = counted + np.cumsum((lefts / outwards)[::-1])[::-1] * -np.log(FACTOR)
        if numbers[0] > wanted:
            half = begin + float(lefts[np.sum(numbers > wanted) - 1])
            return [*spans, *_outwards(problem, last, begin, half)], half
        number = -np.log(FACTOR) * float(np.sum(lefts / outwards + rights / onwards))
        if number >= FEWEST:
            if outwards[-1] < ENDS * (stop.at - begin):
                spans += _outwards(problem, last, begin, half)
            spans += _towards(problem, stop, half, rights, onwards)
        counted, begin, last = counted + number, stop.at, stop
    if counted > wanted or (problem.limit_wear is not None and ahead):
        return spans, begin if counted > wanted else np.inf
    added = yield from without_feedback(np.array([begin * (1 + 1e-9)]))
    if not added[0] > 0.0:
        return spans, np.inf
    reach = yield from look_ahead(problem, begin, max(cycles - counted, LEAST))
    half = begin if last is None else min(begin + problem.scale, (begin + reach) / 2)
    spans += [*_outwards(problem, last, begin, half), *_outwards(problem, None, half, reach)]
    return spans, reach  # wear that is not frozen may take more cycles to there, and fewer


def _looks(
    ends: list[float], branches: list[float]
) -> Asking[tuple[FloatArray, FloatArray, FloatArray, FloatArray]]:
    """Distances (stretches, k) out from the wear at the one end of every stretch, and before the
    branch point at the other, both from its middle on and shrinking; and what cycles add there."""
    begin, end = np.array(ends[:-1]), np.array(ends[1:])
    branch, half = np.array(branches), (begin + end) / 2
    shrinking = FACTOR ** np.arange(STEPS)
    lefts = (half - begin)[:, None] * shrinking
    rights = np.maximum(branch - half, TINY)[:, None] * shrinking
    wear = np.stack([begin[:, None] + lefts, branch[:, None] - rights])
    outwards, onwards = (yield from without_feedback(wear)) + TINY
    return lefts, rights, outwards, onwards


def _outwards(problem: Problem, last: Grazing | None, begin: float, end: float) -> list[Span]:
    """Return the span from the wear `begin` to `end` (mm), beyond the `last` grazing wear."""
    if last is None or begin > last.at + problem.scale:
        shift = SHIFT * problem.scale
        span = Span(Coordinate(0.0, False, shift), begin, end, 1.0, shift)
    else:
        beyond = last.at + max(BEGINS * last.added, GRAIN * ROUNDOFF * last.at)
        root = math.sqrt(SHIFT * problem.scale)
        span = Span(Coordinate(last.behind), max(begin, beyond), end, 0.5, root)
    return [span] if span.start < span.end else []


def _towards(
    problem: Problem, stop: Grazing, half: float, left: FloatArray, added: FloatArray
) -> list[Span]:
    """Return the span from the wear `half` (mm) on the way to a grazing wear; a cycle adds so much
    (k,) where so much is `left`, mm."""
    coordinate, root = Coordinate(stop.before, True), math.sqrt(SHIFT * problem.scale)
    falls = math.log(added[NEAR] / added[NEARER]) / ((NEARER - NEAR) * -math.log(FACTOR))
    power = round(2 * falls) / 2 if math.isfinite(falls) else ROOT
    if problem.limit_wear is not None and stop.at == problem.limit_wear.wear:
        calm = added < ENDS * left
        if not calm.any():
            return []
        first = float(left[np.argmax(calm)])
        nearest = max(LEAST_LEFT * first, RESOLVED * stop.uncertainty)
        vanishes = 2 * min(max(power, 1.0), 2.0)
        ends = stop.at - first, stop.at - nearest
        span = Span(coordinate, *ends, -0.5, root, stop.uncertainty, vanishes, True)
        return [span] if nearest < first else []
    least = np.maximum(added / BEFORE - (stop.at - stop.before), NEXT * added)
    least = np.maximum(least + 2 * added**2 / problem.scale, GRAIN * ROUNDOFF * stop.at)
    enough = left >= least
    if not enough[0]:
        return []
    nearest = len(left) - 1 if enough.all() else int(np.argmin(enough)) - 1
    end = stop.before - float(min(left[nearest], least[nearest]))
    way = (1.0, 0.0) if power else (-0.5, root)
    return [Span(coordinate, half, end, *way, stop.uncertainty)] if half < end else []


def look_ahead(problem: Problem, start: float, cycles: float) -> Asking[float]:
    """Return the wear (mm) where the frozen rate puts `cycles` from `start` on, roughly, and no
    more than makes sense."""
    y, end = STEP * np.arange(STEPS_AHEAD), problem.end
    if np.isfinite(end):
        y = np.linspace(0.0, np.log1p((end - start) / (start + problem.scale)), STEPS_AHEAD)
    wear: FloatArray = start + (start + problem.scale) * np.expm1(y)
    added = yield from without_feedback(wear)
    density = np.minimum(-np.log(added + TINY), 650.0)
    rise = np.diff(density)
    rise = np.where(np.abs(rise) < 1e-6, 1e-6, rise)
    # Between two points the density is taken as exponential in the wear.
    parts = np.exp(density[:-1]) * np.expm1(rise) / rise * np.diff(wear)
    counts = np.concatenate([[0.0], np.cumsum(parts)])
    wanted = 1.3 * max(cycles, LEAST)
    last = int(np.searchsorted(counts, wanted)) - 1
    if last >= len(parts):
        return float(wear[-1])
    share = np.log1p((wanted - counts[last]) / parts[last] * np.expm1(rise[last])) / rise[last]
    return float(wear[last] + share * (wear[last + 1] - wear[last]))
