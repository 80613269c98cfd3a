"""The plan of a count with loss of contact: the domains of the series of increments.

It is made with the rate frozen at the initial wear of each cycle: a cheap approximation, whose
errors the misfit of the series and the residual of Abel's equation reveal.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from wear.equation import WearEquation
from wear.load import Load
from wear.loss_of_contact.arrest import LimitWear
from wear.loss_of_contact.grazing import GrazingWear, fades, grazing_wears, limit_wear_of
from wear.loss_of_contact.increments import Coordinate, SeriesDomain
from wear.loss_of_contact.queries import FROZEN_CYCLES, Coroutine, Query, without_feedback
from wear.loss_of_contact.switching import Edge
from wear.model import Model
from wear.numerics.floating_point import ROUNDOFF, TINY
from wear.numerics.gauss import FloatArray
from wear.orbit.period_map import Settings, settings
from wear.orbit.plan import LEAST, states_ahead

SHIFT = 12.0  # of panels, over the scale: then one serves every regime to the end
FEWEST = 8.0  # cycles between two grazing wears for which a series pays
STOPS_AT_ONCE = 16  # grazing wears for which the plan is made before it is known to go on
BEGINS = 0.03  # of the increment at a grazing wear: the distance beyond it where a series begins
ENDS = 0.7  # of the remaining distance: the largest increment in a series
BEFORE = 0.95  # of the distance to a grazing wear: the longest last cycle on a series
NEXT = 0.05  # of an increment: the distance before a branch point where a series ends
FACTOR, STEPS = 0.25, 21  # of the distances that are sampled ahead
PER_STEP = -math.log(FACTOR)  # from one distance to the next, in ln(distance)
NEAR, NEARER = 8, 10  # of these: they give the power of the distance
ROOT = 0.5
LEAST_LEFT = 1e-5  # of the distance to a limit wear: from there on the series is extrapolated
RESOLVED = 1e3  # times the uncertainty of the limit wear: a distance that is known
AHEAD = 1.3  # times the requested cycles are planned
BEYOND = 1 + 8 * ROUNDOFF  # times a wear: larger ones differ from it by more than rounding
JUST_BEYOND = 1 + 1e-9  # times a grazing wear: there the next cycles are sampled


class BranchPoint(NamedTuple):
    """A `grazing` wear with the branch points of the period map for initial wears below it,
    `before`, and above it, `behind`; and the wear `added` by a cycle there, all in mm."""

    grazing: GrazingWear
    before: float
    behind: float
    added: float


class _NearEnds(NamedTuple):
    """Distances (k,), mm, `beyond` the beginning of a range between two grazing wears, and `before`
    the branch point at its end, falling from half the range, or from all of it; and the increments
    of cycles there."""

    beyond: FloatArray
    before: FloatArray
    adds_beyond: FloatArray
    adds_before: FloatArray


class CountProblem(NamedTuple):
    """A count of one scene: the grazing wears `stops`, rising; the `limit_wear` if wear tends to
    the last of them; the wear `end` (mm) at which the model ends, and the `deepest` wear (mm) that
    is asked for; the `scale` of the wear, mm; and the requested relative accuracy."""

    model: Model
    load: Load
    stops: list[GrazingWear]
    limit_wear: LimitWear | None
    end: float
    deepest: float
    scale: float
    rtol: float
    size: Settings
    deadline: float


def count_problem(
    model: Model, load: Load, edge: Edge, deepest: float, rtol: float, deadline: float
) -> CountProblem:
    """Return the count of a scene up to a wear `deepest` (mm), to the relative accuracy `rtol`."""
    equation = WearEquation(model, (load,))
    scale, end = float(equation.scale[0]), float(equation.limit[0])
    stops = [each for each in grazing_wears(model, load, edge, scale) if each.wear < end]
    limit_wear = limit_wear_of(model, load, stops[-1].wear) if stops else None
    if limit_wear is not None and not fades(model, load, edge, limit_wear.wear):
        limit_wear = None
    sizes = end, deepest, scale, rtol, settings(rtol), deadline
    return CountProblem(model, load, stops, limit_wear, *sizes)


def _branch_points(
    problem: CountProblem, stops: Sequence[GrazingWear]
) -> Coroutine[list[BranchPoint]]:
    """Return the branch points of the period map that belong to some grazing wears: contact grazes
    after the increment of the pieces before, so that the map has its branch point at the initial
    wear of that cycle."""
    parts = yield Query(FROZEN_CYCLES, np.array([stop.wear for stop in stops]))
    points = []
    for stop, added in zip(stops, parts, strict=True):
        part, whole = float(np.sum(added[: stop.before])), stop.before == len(added)
        tends = problem.limit_wear is not None and stop.wear == problem.limit_wear.wear
        before = stop.wear - (0.0 if tends else part)
        behind = stop.wear - (0.0 if whole else part)
        points.append(BranchPoint(stop, before, behind, float(np.sum(added))))
    return points


def plan_domains(
    problem: CountProblem, wear: float, cycles: float
) -> Coroutine[tuple[list[SeriesDomain], float]]:
    """Return the domains of the series of increments from a `wear` (mm) on, for about so many
    `cycles`, and the wear up to which the plan reaches."""
    first = sum(stop.wear <= wear * BEYOND for stop in problem.stops)
    domains: list[SeriesDomain] = []
    counted, needed, begin = 0.0, AHEAD * max(cycles, LEAST), wear
    last: BranchPoint | None = None
    for at in range(max(first - 1, 0), len(problem.stops), STOPS_AT_ONCE):
        points = yield from _branch_points(problem, problem.stops[at : at + STOPS_AT_ONCE])
        if at < first:
            last, *points = points
        near_ends = yield from _near_ends(problem, begin, last, points)
        for stop, near in zip(points, near_ends, strict=True):
            if counted > needed or begin > problem.deepest:
                return domains, begin
            if isinstance(near, float):
                counted, begin, last = counted + near, stop.grazing.wear, stop
                continue
            half = begin + near.beyond[0]
            numbers = counted + np.cumsum((near.beyond / near.adds_beyond)[::-1])[::-1] * PER_STEP
            if numbers[0] > needed:
                half = begin + float(near.beyond[np.sum(numbers > needed) - 1])
                return [*domains, *_outwards(problem, last, begin, half)], half
            number = numbers[0] - counted + PER_STEP * np.sum(near.before / near.adds_before)
            if number >= FEWEST:
                if near.adds_beyond[-1] < ENDS * (stop.grazing.wear - begin):
                    domains += _outwards(problem, last, begin, half)
                domains += _towards(problem, stop, half, near.before, near.adds_before)
            counted, begin, last = counted + float(number), stop.grazing.wear, stop
    if counted > needed or (problem.limit_wear is not None and first < len(problem.stops)):
        return domains, begin if counted > needed else np.inf
    added = yield from without_feedback(np.array([begin * JUST_BEYOND]))
    if not added[0] > 0.0:
        return domains, np.inf
    # With the rate frozen within each cycle: with feedback it may take more cycles, or fewer.
    ahead = states_ahead(*(np.array([x]) for x in (begin, problem.scale, problem.end)))
    wanted = AHEAD * max(cycles - counted, LEAST)
    reach = float(ahead.after((yield from without_feedback(ahead.u)), np.array([wanted]))[0])
    half = begin if last is None else min(begin + problem.scale, (begin + reach) / 2)
    domains += [*_outwards(problem, last, begin, half), *_outwards(problem, None, half, reach)]
    return domains, reach


def _near_ends(
    problem: CountProblem, begin: float, last: BranchPoint | None, stops: Sequence[BranchPoint]
) -> Coroutine[list[_NearEnds | float]]:
    """Return the increments near the ends of the ranges from the wear `begin` to the first of some
    grazing wears, and from each of them to the next; for a range that is passed in a few cycles
    only their number."""
    ends = np.array([stop.grazing.wear for stop in stops])
    begins = np.concatenate([[begin], ends[:-1]])[: len(ends)]
    added = np.array([np.nan if last is None else last.added, *(stop.added for stop in stops)])
    cycles = 2 * (ends - begins) / (added[1:] + added[:-1])
    many = ~((ends - begins) / np.minimum(added[1:], added[:-1]) < FEWEST / 2)
    # From a wear that is nearer to the limit than to what lies behind, one series leads there.
    since = begin - (0.0 if last is None else last.grazing.wear)
    limit = np.nan if problem.limit_wear is None else problem.limit_wear.wear
    single = (begins == begin) & (ends == limit) & (since > ends - begins)
    half = np.where(single, begins, (begins + ends) / 2)[many]
    begin_of, branch = begins[many], np.array([stop.before for stop in stops])[many]
    shrinking = FACTOR ** np.arange(STEPS)
    beyond = (half - begin_of)[:, None] * shrinking
    before = np.maximum(branch - half, TINY)[:, None] * shrinking
    wear = np.stack([begin_of[:, None] + beyond, branch[:, None] - before])
    sampled = iter(zip(beyond, before, *((yield from without_feedback(wear)) + TINY), strict=True))
    return [
        _NearEnds(*next(sampled)) if sample else number
        for sample, number in zip(many.tolist(), cycles.tolist(), strict=True)
    ]


def _outwards(
    problem: CountProblem, last: BranchPoint | None, begin: float, end: float
) -> list[SeriesDomain]:
    """Return the domain from the wear `begin` to `end` (mm), beyond the `last` grazing wear."""
    if last is None or begin > last.grazing.wear + problem.scale:
        shift = SHIFT * problem.scale
        domain = SeriesDomain(Coordinate(0.0, False, shift), begin, end, 1.0, shift)
    else:
        beyond = last.grazing.wear + max(BEGINS * last.added, last.grazing.nearest)
        root = math.sqrt(SHIFT * problem.scale)
        domain = SeriesDomain(Coordinate(last.behind), max(begin, beyond), end, 0.5, root)
    return [domain] if domain.start < domain.end else []


def _towards(
    problem: CountProblem, stop: BranchPoint, half: float, left: FloatArray, added: FloatArray
) -> list[SeriesDomain]:
    """Return the domain from the wear `half` (mm) towards a grazing wear; a cycle has `added` (k,)
    at the distances `left` (k,), mm."""
    coordinate, root = Coordinate(stop.before, True), math.sqrt(SHIFT * problem.scale)
    falls = math.log(added[NEAR] / added[NEARER]) / ((NEARER - NEAR) * PER_STEP)
    power = round(2 * falls) / 2 if math.isfinite(falls) else ROOT
    if problem.limit_wear is not None and stop.grazing.wear == problem.limit_wear.wear:
        calm = added < ENDS * left
        if not calm.any():
            return []
        first = float(left[np.argmax(calm)])
        nearest = max(LEAST_LEFT * first, RESOLVED * stop.grazing.uncertainty)
        vanishes = 2 * min(max(power, 1.0), 2.0)
        ends = stop.grazing.wear - first, stop.grazing.wear - nearest
        domain = SeriesDomain(
            coordinate, *ends, -0.5, root, stop.grazing.uncertainty, vanishes, True
        )
        return [domain] if nearest < first else []
    least = np.maximum(added / BEFORE - (stop.grazing.wear - stop.before), NEXT * added)
    least = np.maximum(least + 2 * added**2 / problem.scale, stop.grazing.nearest)
    enough = left >= least
    if not enough[0]:
        return []
    nearest = len(left) - 1 if enough.all() else int(np.argmin(enough)) - 1
    end = stop.before - float(min(left[nearest], least[nearest]))
    way = (1.0, 0.0) if power else (-0.5, root)
    return (
        [SeriesDomain(coordinate, half, end, *way, stop.grazing.uncertainty)] if half < end else []
    )
