"""The plan of a count with loss of contact: where series of the increments are wanted.

By wear that is frozen over a cycle: good enough for a plan, and cheap. What the plan misses, the
misfit of the series and the residual of Abel's equation report.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from wear.count.cutoff import CutoffCycle, Maps
from wear.count.increments import Coordinate, Span
from wear.count.kinks import Kink, fades, kinks, rest_of
from wear.count.scan import LEAST, SHIFT, roughness_limit, roughness_scale, scan
from wear.count.tail import Rest
from wear.load import Load
from wear.model import Model
from wear.numerics.gauss import FloatArray, mesh
from wear.numerics.tolerances import ROUNDOFF, TINY
from wear.orbit.period_map import Settings, settings

FEWEST = 8.0  # cycles between two grazing wears for which a series pays
BEGINS = 0.03  # of the increment at a grazing wear: how far beyond it a series begins
ENDS = 0.7  # of the distance that is left: the largest increment for which a series is wanted
BEFORE = 0.95  # of the way to a grazing wear: the longest last cycle on a series
NEXT = 0.05  # of an increment: how near to a branch point a series ends
GRAIN = 4096.0  # roundoffs of the wear: the smallest distance at which cycles are counted
FACTOR, STEPS = 0.25, 21  # of distances at which one looks ahead
FARTHEST = 1e12  # roughnesses
AHEAD = 1.3  # of the cycles asked for: how far one looks ahead


class Way(NamedTuple):
    """What is ahead: the `kinks`, rising; the `rest` if wear tends to the last of them for ever;
    the wear `end` (mm) beyond which nothing has a meaning. The maps of a cycle: `plain`, for frozen
    wear, and `both`, resolved."""

    plain: CutoffCycle
    both: Maps
    kinks: list[Kink]
    rest: Rest | None
    end: float
    scale: float
    rtol: float
    size: Settings
    deadline: float

    @property
    def model(self) -> Model:
        """Return the model."""
        return self.plain.model

    @property
    def limit(self) -> float:
        """Return the grazing wear (mm) to which wear tends for ever, if any."""
        return self.rest.wear if self.rest else np.inf

    @property
    def load(self) -> Load:
        """Return the load."""
        return self.plain.load


def prepared(cycle: CutoffCycle, rtol: float, deadline: float) -> Way:
    """Return what is ahead of a count to the relative accuracy `rtol`."""
    model, load, size = cycle.model, cycle.load, settings(rtol)
    scale = roughness_scale(model)
    end = roughness_limit(model, FARTHEST * scale)
    grazing = [kink for kink in kinks(cycle, scale) if kink.wear < end]
    rest = rest_of(model, load, grazing[-1].wear) if grazing else None
    if rest is not None and not fades(cycle, rest.wear):
        rest = None
    coarse = cycle.resolved(size)
    finer = coarse.on(mesh(coarse.over.edges, size.finer_nodes))
    return Way(cycle, Maps(coarse, finer), grazing, rest, end, scale, rtol, size, deadline)


class Stop(NamedTuple):
    """A grazing wear `at` (mm), which rounding leaves an `uncertainty`; the branch points of the
    map `before` it, as starts that come nearer see them, and `behind`, as those beyond it do; and
    what a cycle adds there."""

    at: float
    before: float
    behind: float
    added: float
    uncertainty: float


def _stops(way: Way) -> list[Stop]:
    """Return all grazing wears. Contact grazes when the pieces before have added their part: the
    map has its branch point where a cycle starts that much earlier."""
    if not way.kinks:
        return []
    wear = np.array([kink.wear for kink in way.kinks])
    upto = way.plain.frozen_upto(wear)
    peak = np.array([way.load.maximum])
    slope = np.abs(way.model.margin_slope(wear, peak)) + TINY
    uncertainty = ROUNDOFF * way.model.margin_terms(wear, peak) / slope
    found = []
    for i, kink in enumerate(way.kinks):
        part, whole = upto[kink.before, i], kink.before == len(upto) - 1
        before = kink.wear - (0.0 if kink.wear == way.limit else part)
        behind = kink.wear - (0.0 if whole else part)
        found.append(Stop(kink.wear, before, behind, float(upto[-1, i]), float(uncertainty[i])))
    return found


def planned(way: Way, wear: float, cycles: float) -> tuple[list[Span], float]:
    """Plan where increments are wanted from a `wear` (mm) on, for so many `cycles` about; return
    also the wear up to which that is a plan."""
    stops = _stops(way)
    ahead = [stop for stop in stops if stop.at > wear * (1 + 8 * ROUNDOFF)]
    last = next((stop for stop in reversed(stops) if stop not in ahead), None)
    looks = _looks(way, [wear, *(stop.at for stop in ahead)], [stop.before for stop in ahead])
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
            return [*spans, *_outwards(way, last, begin, half)], half
        number = -np.log(FACTOR) * float(np.sum(lefts / outwards + rights / onwards))
        if number >= FEWEST:
            if outwards[-1] < ENDS * (stop.at - begin):
                spans += _outwards(way, last, begin, half)
            spans += _towards(way, stop, half, rights, onwards)
        counted, begin, last = counted + number, stop.at, stop
    if counted > wanted or (way.rest is not None and ahead):
        return spans, begin if counted > wanted else np.inf
    if not way.plain.frozen(np.array([begin * (1 + 1e-9)]))[0] > 0.0:
        return spans, np.inf
    reach = float(scan(way.plain, way.scale, begin, max(cycles - counted, LEAST), way.end)[-1])
    half = begin if last is None else min(begin + way.scale, (begin + reach) / 2)
    spans += [*_outwards(way, last, begin, half), *_outwards(way, None, half, reach)]
    return spans, reach  # wear that is not frozen may take more cycles to there, and fewer


def _looks(
    way: Way, ends: list[float], branches: list[float]
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Distances (stretches, k) out from the wear at the one end of every stretch, and before the
    branch point at the other, both from its middle on and shrinking; and what cycles add there."""
    begin, end = np.array(ends[:-1]), np.array(ends[1:])
    branch, half = np.array(branches), (begin + end) / 2
    shrinking = FACTOR ** np.arange(STEPS)
    lefts = (half - begin)[:, None] * shrinking
    rights = np.maximum(branch - half, TINY)[:, None] * shrinking
    wear = np.stack([begin[:, None] + lefts, branch[:, None] - rights])
    outwards, onwards = way.plain.frozen(wear) + TINY
    return lefts, rights, outwards, onwards


def _outwards(way: Way, last: Stop | None, begin: float, end: float) -> list[Span]:
    """Return the span from the wear `begin` to `end` (mm), beyond the `last` grazing wear."""
    if last is None or begin > last.at + way.scale:
        span = Span(Coordinate(0.0, False, SHIFT * way.scale), begin, end)
    else:
        beyond = last.at + max(BEGINS * last.added, GRAIN * ROUNDOFF * last.at)
        span = Span(Coordinate(last.behind), max(begin, beyond), end)
    return [span] if span.start < span.end else []


def _towards(way: Way, stop: Stop, half: float, left: FloatArray, added: FloatArray) -> list[Span]:
    """Return the span from the wear `half` (mm) on the way to a grazing wear; a cycle adds so much
    (k,) where so much is `left`, mm."""
    coordinate = Coordinate(stop.before, True)
    if way.rest is not None and stop.at == way.rest.wear:
        calm = added < ENDS * left
        end = way.rest.wear - way.rest.nearest
        begin = stop.at - float(left[np.argmax(calm)]) if calm.any() else end
        return [Span(coordinate, begin, end, stop.uncertainty, True)] if begin < end else []
    least = np.maximum(added / BEFORE - (stop.at - stop.before), NEXT * added)
    least = np.maximum(least + 2 * added**2 / way.scale, GRAIN * ROUNDOFF * stop.at)
    enough = left >= least
    if not enough[0]:
        return []
    nearest = len(left) - 1 if enough.all() else int(np.argmin(enough)) - 1
    end = stop.before - float(min(left[nearest], least[nearest]))
    return [Span(coordinate, half, end, stop.uncertainty)] if half < end else []
