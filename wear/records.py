"""The wear along a measured history: straight lines between its rows, many at once.

A record is not periodic: its cycles cannot be counted. But on a line the rate is smooth, so that
few Gauss nodes suffice, and a thousand lines are one mesh for `wear.numerics.initial_value`. With
loss of contact a few hundred lines are one cycle of `wear.loss_of_contact.period_map`.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from wear.equation import WearEquation, roundoff
from wear.load import HistoryLoad, HistoryPart
from wear.loss_of_contact.edge import edge_of_contact
from wear.loss_of_contact.period_map import SwitchedPeriodMap, switched_period_map
from wear.loss_of_contact.roundoff import roundoff as rounding_of
from wear.loss_of_contact.switching import roughness
from wear.model import Model
from wear.numerics.floating_point import ROUNDOFF
from wear.numerics.gauss import BoolArray, FloatArray, mesh
from wear.numerics.initial_value import SAFETY, SHORTEST, Rules, StoppedError, integrate
from wear.orbit.period_map import PeriodMap, settings
from wear.orbit.problem import Cost
from wear.outcome import Outcome
from wear.progress import Pace

METHOD = "collocation"
NODES, FINER_NODES = 8, 12  # on each line: for the result, and for its error estimate
NEARLY = 0.9  # of the wear at which the roughness vanishes
STRICTER = 0.01  # tolerance on lines, over the requested accuracy
LINES = 512  # taken as a cycle, where contact is lost
APART = 1e-9  # of roughness and wear: a small difference


class _Reached(NamedTuple):
    """The `wear` (k,), mm, at requested times, its `error` (k,), mm, the right-hand sides evaluated
    since the times before, and the time (s) reached."""

    wear: FloatArray
    error: FloatArray
    evaluations: int
    time: float


class _Times(NamedTuple):
    """The ends of lines (n + 1,), s, and which of them (n,), but for the first, are requested."""

    edges: FloatArray
    requested: BoolArray


@np.errstate(all="ignore")  # trial states far off the solution may overflow
def follow(
    model: Model,
    load: HistoryLoad,
    cycles: Sequence[int],
    rtol: float,
    deadline: float = np.inf,
    progress: Callable[[str], None] = lambda _: None,
) -> Outcome:
    """Return the wear after whole numbers of `cycles`, in any order, along a history.

    After the `deadline` (`time.monotonic()`) or on Ctrl-C the cycles reached by then are kept.
    After two seconds `progress` is called at intervals.
    """
    pace = Pace(progress)
    marks = tuple(sorted(set(cycles)))
    ends = load.time_at(np.array(marks))
    edges = np.union1d(np.append(load.breakpoints(0.0, ends[-1]), 0.0), ends)
    times = _Times(edges, np.isin(edges[1:], ends))
    limit = float(WearEquation(model, (load,)).limit[0])  # type: ignore[arg-type]
    along = _with_loss_of_contact if model.ends_at_3_sigma else _in_contact
    u, error = ([0.0], [0.0]) if ends[0] == 0.0 else ([], [])
    evaluations, stopped, interrupted = 0, None, False
    pace.begin("cycle", marks[-1])
    try:
        for part in along(model, load, times, rtol, limit, deadline):
            u += part.wear.tolist()
            error += part.error.tolist()
            evaluations += part.evaluations
            pace.at(part.time / load.period_s)
    except StoppedError as end:
        stopped = f"the wear could not be followed beyond u_c = {end.state:.6g} mm"
        if end.state > NEARLY * limit:
            stopped = f"the roughness vanishes near u_c = {limit:.4g} mm: the model ends"
    except TimeoutError:
        stopped, interrupted = "the time limit has passed", True
    except KeyboardInterrupt:
        stopped, interrupted = "interrupted", True
    reached, wear = marks[: len(u)], np.array(u)
    relative = np.where(wear > 0.0, np.array(error) / wear + ROUNDOFF, 0.0)
    cost = Cost(2 * max(reached, default=0), evaluations)
    return Outcome(METHOD, reached, wear, relative, cost, (), stopped, interrupted)


def _in_contact(
    model: Model, load: HistoryLoad, times: _Times, rtol: float, limit: float, deadline: float
) -> Iterator[_Reached]:
    """Yield the wear at requested times, below a `limit` (mm), where contact is not lost."""
    equation = WearEquation(model, (load,))  # type: ignore[arg-type]  # all that it asks of one

    def sampled(edges: FloatArray, m: int, tolerance: float) -> PeriodMap:
        over, levels = mesh(edges[None, None], m), load(edges)
        # Straight between the levels at the ends: no rounding of the time enters.
        forcing = levels[:-1, None] + np.diff(levels)[:, None] * over.rule.nodes
        return PeriodMap(equation, over, forcing[None, None], tolerance)

    def rounding(wear: float) -> float:
        return float(roundoff(model, np.array([load.maximum]), np.array([wear]))[0])

    rules, number = Rules(NODES, FINER_NODES, STRICTER * rtol), 0
    for part in integrate(sampled, times.edges, 0.0, rules, rounding, limit, deadline):
        here = times.requested[number : number + len(part.increment)]
        time_reached = float(part.edges[-1])
        yield _Reached(part.increment[here], part.error[here], part.evaluations, time_reached)
        number += len(here)


def _with_loss_of_contact(
    model: Model, load: HistoryLoad, times: _Times, rtol: float, limit: float, deadline: float
) -> Iterator[_Reached]:
    """Yield the wear at requested times, below a `limit` (mm), where contact is lost on the way:
    many lines at once are taken as a cycle, half of them where that fails."""
    edges, wear, error = times.edges, 0.0, 0.0
    scale, requested = float(roughness(model, np.zeros(1))[0]), edges[1:][times.requested]
    shortest = SHORTEST * np.max(np.diff(edges), initial=0.0)
    cuts = np.union1d(np.arange(0, len(edges), LINES), np.flatnonzero(times.requested) + 1)
    todo = [edges[first : last + 1] for first, last in pairwise(cuts.tolist())][::-1]
    while todo:
        if time.monotonic() > deadline:
            raise TimeoutError
        part = todo.pop()
        cycle = _as_a_cycle(model, load, part, rtol)
        apart = APART * (scale + wear)
        run = cycle.advance(np.array([wear, wear + apart]), np.zeros(2, dtype=np.intp))
        added, beside = run.increment.tolist()
        if not run.converged.all() or not wear + added < limit:
            if part[-1] - part[0] <= shortest:
                raise StoppedError(wear)
            todo += _halves(part)[::-1]
            continue
        (rounded,) = rounding_of(cycle.cycles, [np.array([wear, wear + added])])
        local = SAFETY * float(run.error[0]) + float(rounded.of_cycles[0]) * added
        error = error * abs(1.0 + (beside - added) / apart) + local
        wear += added
        here = np.isin(part[-1:], requested)
        after, uncertain = np.array([[wear], [error]])[:, here]
        yield _Reached(after, uncertain, run.evaluations, float(part[-1]))


def _as_a_cycle(
    model: Model, load: HistoryLoad, edges: FloatArray, rtol: float
) -> SwitchedPeriodMap:
    """Return the map of the lines of a history between `edges` (s)."""
    part = HistoryPart(load, edges, edges[0], edges[-1] - edges[0])
    edge = edge_of_contact(model, part)
    size = settings(rtol, [edge.pieces.begin])
    return switched_period_map([model], [part], [edge], size.phase_nodes, size.endpoint_tolerance)


def _halves(edges: FloatArray) -> list[FloatArray]:
    """Return the lines between `edges` in two halves; of a single line the halves of it."""
    if len(edges) == 2:
        edges = np.insert(edges, 1, (edges[0] + edges[1]) / 2)
    middle = len(edges) // 2
    return [edges[: middle + 1], edges[middle:]]
