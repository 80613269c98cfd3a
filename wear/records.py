"""The wear along a measured history: straight lines between its rows, many at once.

A record is not periodic: its cycles cannot be counted. But on a line the rate is smooth, so that
few Gauss nodes suffice, and a thousand lines are one mesh for `wear.numerics.initial_value`.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from wear.equation import WearEquation, roundoff
from wear.load import HistoryLoad
from wear.model import Model
from wear.numerics.floating_point import ROUNDOFF
from wear.numerics.gauss import FloatArray, mesh
from wear.numerics.initial_value import Rules, StoppedError, integrate
from wear.orbit.period_map import PeriodMap
from wear.orbit.problem import Cost
from wear.outcome import Outcome

METHOD = "collocation"
NODES, FINER_NODES = 8, 12  # on each line: for the result, and for its error estimate
NEARLY = 0.9  # of the wear at which the roughness vanishes
STRICTER = 0.01  # tolerance on lines, over the requested accuracy


@np.errstate(all="ignore")  # trial states far off the solution may overflow
def follow(
    model: Model,
    load: HistoryLoad,
    cycles: Sequence[int],
    rtol: float,
    deadline: float = np.inf,
) -> Outcome:
    """Return the wear after whole numbers of `cycles`, in any order, along a history, without loss
    of contact.

    After the `deadline` (`time.monotonic()`) or on Ctrl-C the cycles reached by then are kept.
    """
    marks = tuple(sorted(set(cycles)))
    ends = load.time_at(np.array(marks))
    times = np.union1d(np.append(load.breakpoints(0.0, ends[-1]), 0.0), ends)
    asked = np.isin(times[1:], ends)
    equation = WearEquation(model, (load,))  # type: ignore[arg-type]  # all that it asks of one
    limit = float(equation.limit[0])

    def sampled(edges: FloatArray, m: int, tolerance: float) -> PeriodMap:
        over, levels = mesh(edges[None, None], m), load(edges)
        # Straight between the levels at the ends: no rounding of the time enters.
        forcing = levels[:-1, None] + np.diff(levels)[:, None] * over.rule.nodes
        return PeriodMap(equation, over, forcing[None, None], tolerance)

    def rounding(wear: float) -> float:
        return float(roundoff(model, np.array([load.maximum]), np.array([wear]))[0])

    u, error = ([0.0], [0.0]) if ends[0] == 0.0 else ([], [])
    evaluations, stopped, interrupted, number = 0, None, False, 0
    rules = Rules(NODES, FINER_NODES, STRICTER * rtol)
    try:
        for part in integrate(sampled, times, 0.0, rules, rounding, limit, deadline):
            here = asked[number : number + len(part.increment)]
            u += part.increment[here].tolist()
            error += part.error[here].tolist()
            number += len(here)
            evaluations += part.evaluations
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
