"""One cycle of violent wear: interval after interval of phase, each cut in two until it is sound.

Where wear opens the gap within a small part of a cycle, Picard iteration over the cycle diverges
and no mesh made beforehand suits. The first cycles may be such; wear that has opened the gap is
slow.
"""

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from wear.count.cycle import Drive, Settings
from wear.numerics.collocation import (
    CycleSolution,
    endpoint_defect,
    hidden,
    unresolved,
)
from wear.numerics.gauss import (
    BoolArray,
    FloatArray,
    mesh,
)
from wear.numerics.tolerances import (
    TINY,
)

SHORTEST = 1e-12  # of a cycle


class Marched(NamedTuple):
    """The wear `added` (mm) by a cycle, its estimated error `missed` (mm), the factor `growth` by
    which the cycle changes a small difference in wear, its `response` (mm) to a relative error of
    the rate, at most, and the number of right-hand sides."""

    added: float
    missed: float
    growth: float
    response: float
    evaluations: int


def march(cycle: Drive, start: float, limit: float, size: Settings) -> Marched:
    """Integrate one cycle from the wear `start` (mm), or up to the wear `limit` (mm) where that is
    reached before; the mesh of `cycle` says where intervals end at least."""
    todo = list(pairwise(cycle.over.edges.tolist()))[::-1]
    done = Marched(0.0, 0.0, 1.0, 0.0, 0)
    while todo and start + done.added < limit:
        begin, end = todo.pop()
        edges = np.array([begin, end])
        part = cycle.on(mesh(edges, size.phase_nodes))
        at = np.array(start + done.added)
        run = part.advance(at)
        done = done._replace(evaluations=done.evaluations + run.evaluations)
        own = float(run.increment)
        share = 1.0 + done.added / (own + TINY)
        loose, strict = share * size.phase_tolerance, share * size.strict_tolerance
        sound = run.converged.all() and float(at) + own < limit
        sound = sound and not unresolved(run.rate[None], part.over, loose).any()
        sound = sound and not overlooked(part, float(at), run, strict).any()
        if not sound and end - begin > SHORTEST:
            middle = (begin + end) / 2
            todo += [(middle, end), (begin, middle)]
            continue
        finer = cycle.on(mesh(edges, size.finer_nodes))
        judged = finer.advance(at)
        apart = abs(float(judged.increment) - own) if sound else np.inf
        apart += float(overlooked_wear(finer, float(at), judged)[0])
        growth = float(part.growth(float(at) + run.inside))
        done = Marched(
            done.added + own,
            done.missed * growth + apart,
            done.growth * growth,
            done.response * growth + own * max(growth, 1.0),
            done.evaluations + judged.evaluations,
        )
    return done


def overlooked(cycle: Drive, start: float, run: CycleSolution, tolerance: float) -> BoolArray:
    """Which intervals (q,) of phase hide a change of the rate between an end and the nodes, over
    the cycles of `run` on end (..., q, m) from wear `start` (mm)."""
    return hidden(*_with_ends(cycle, start, run), cycle.over, tolerance)


def overlooked_wear(cycle: Drive, start: float, run: CycleSolution) -> FloatArray:
    """What such changes may make of the wear (mm) that each of the cycles adds, (k,)."""
    missed: FloatArray = np.sum(
        endpoint_defect(*_with_ends(cycle, start, run), cycle.over), axis=-1
    )
    return missed


def _with_ends(
    cycle: Drive, start: float, run: CycleSolution
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """The rates (k, q, m) of cycles on end, and those where their intervals begin and end (k, q),
    in mm per cycle."""
    over = cycle.over
    q, m = over.phases.shape
    rate = run.rate.reshape(-1, q, m)
    added = (rate @ over.rule.weights * over.lengths).ravel()
    wear = start + np.concatenate([[0.0], np.cumsum(added)])
    phases = np.append(np.tile(over.edges[:-1], len(rate)), over.edges[-1])
    at_edges = cycle.load.period * cycle.model.rate(wear, cycle.load(phases))
    return rate, at_edges[:-1].reshape(-1, q), at_edges[1:].reshape(-1, q)
