"""`solve`: the wear of a scene after any numbers of cycles, by the best method for it."""

from __future__ import annotations

import os
import time
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from typing import Any

import numpy as np

from wear import direct, records
from wear.binding import bind
from wear.cycles import wear_after
from wear.faults import AccuracyError, Interrupted
from wear.history import History
from wear.load import HistoryLoad
from wear.model import Model
from wear.orbit.problem import Cost
from wear.outcome import Outcome
from wear.request import checked_request, obstacle
from wear.resampling import resampled, unmerged
from wear.scene import Scene, as_scene
from wear.states import fields_at, result_notices

AFFORDABLE_CYCLES = 1000  # `auto` integrates up to so many one by one if the cycle count fails
FIELDS = ("u_a", "sigma_c", "sigma_a", "h", "p", "U_c")  # of a model, as a history has them
DIRECT_LIMIT = 1e-11  # the accuracy that integrating them one by one can reach


def solve(
    scene: Scene | str | os.PathLike[str],
    cycles: float | Iterable[float],
    rtol: float = 1e-10,
    method: str = "auto",
    time_limit: float | None = None,
    progress: Callable[[str], None] = lambda _: None,
) -> History:
    """Solve a scene for its state after numbers of load cycles.

    Parameters
    ----------
    scene
        A scene, the name of a built-in one, or the path of a scene file.
    cycles
        Whole numbers from 0 (the fresh state) to 1e12, in any order; or one such number.
    rtol
        Requested relative error of the bearing's wear.
    method
        "auto", "abel" (any number of cycles from a few; the load must repeat),
        "collocation" (a measured history, many of its rows at once) or one of SciPy's integrators,
        which go through every cycle.
    time_limit
        Seconds after which to stop with the cycles reached by then.
    progress
        Called with a line of text on the progress of an integration of more than two seconds.

    Raises
    ------
    UsageError
        if the request makes no sense, with all its faults at once.
    AccuracyError
        if `rtol` was not reached; `best` is the most accurate history.
    Interrupted
        on Ctrl-C or at the time limit; `history` has the cycles reached by then.

    >>> history = solve("section4", [1, 10], rtol=1e-6)
    >>> [f"{wear:.4e}" for wear in history.u_c]
    ['3.0253e-05', '2.3692e-04']
    """
    start = time.monotonic()
    scene = as_scene(scene)
    requested = checked_request(scene, cycles, rtol, method, time_limit)
    model = bind(scene)
    deadline = np.inf if time_limit is None else start + time_limit
    fewer = resampled(scene, rtol)
    while True:
        allowed = rtol - fewer.error
        wear = _solved(model, fewer.scene, requested, allowed, method, deadline, progress)
        error = wear.error + fewer.wear_error(wear.u)
        if wear.interrupted or not fewer.error or np.all(error <= rtol):
            break
        fewer = unmerged(scene)  # where wear accelerates, the error by merged rows grows
    wear = wear._replace(error=error, notices=(*fewer.notices, *wear.notices))
    history = _history(scene, model, requested, wear, rtol, time.monotonic() - start)
    if wear.interrupted:
        raise Interrupted(_reached(wear), history)
    worst = float(np.max(history.error, initial=0.0))
    if wear.stopped or not worst <= rtol:
        shortfall = f"{wear.method}: the estimated error is {worst:.1e}, {rtol:.1e} was requested"
        raise AccuracyError(_reached(wear) if wear.stopped else shortfall, history)
    return history


def _methods(
    scene: Scene, method: str, wanted: tuple[int, ...], rtol: float
) -> tuple[tuple[str, str], ...]:
    """Return the methods to try in turn, each with its reason (none if the user chose it)."""
    if method != "auto":
        return ((method, ""),)
    against = obstacle(scene)
    if against is not None:
        return (("collocation", against),)
    first = ("abel", "the load repeats")
    if max(wanted) > AFFORDABLE_CYCLES or rtol < DIRECT_LIMIT:
        return (first,)
    return (first, ("DOP853", "the cycle count missed the requested accuracy"))


def _solved(
    model: Model,
    scene: Scene,
    wanted: tuple[int, ...],
    rtol: float,
    method: str,
    deadline: float,
    progress: Callable[[str], None],
) -> Outcome:
    """Return the result of the first method that meets the request, or the one with the smallest
    error."""
    results: list[Outcome] = []
    for name, reason in _methods(scene, method, wanted, rtol):
        if name == "abel":
            wear = _by_abel(model, scene, wanted, rtol, deadline)
        elif name == "collocation":
            assert isinstance(scene.load, HistoryLoad)
            wear = records.follow(model, scene.load, wanted, rtol, deadline, progress)
        else:
            wear = direct.integrate(model, scene.load, wanted, rtol, name, deadline, progress)
        if reason:
            wear = wear._replace(notices=(f"auto: {name}, because {reason}", *wear.notices))
        results.append(wear)
        if wear.interrupted or (wear.stopped is None and _worst(wear) <= rtol):
            return wear
    complete = [wear for wear in results if wear.stopped is None]
    return min(complete or results, key=_worst)


def _worst(wear: Outcome) -> float:
    return float(np.max(np.nan_to_num(wear.error, nan=np.inf), initial=0.0))


def _by_abel(
    model: Model, scene: Scene, wanted: tuple[int, ...], rtol: float, deadline: float
) -> Outcome:
    cycles = tuple(sorted(set(wanted)))
    nothing = Outcome("abel", (), np.empty(0), np.empty(0), Cost(0, 0))
    try:
        wear = wear_after(model, scene.load, np.array(cycles, float), rtol, deadline=deadline)
    except KeyboardInterrupt:
        return nothing._replace(stopped="interrupted", interrupted=True)
    except (AccuracyError, ArithmeticError, ValueError) as fault:  # LinAlgError is a ValueError
        return nothing._replace(stopped=f"the cycles could not be counted ({fault})")
    late = not np.all(wear.error <= rtol) and time.monotonic() > deadline
    reached = np.isfinite(wear.error if late else wear.u_c)
    outcome = nothing._replace(
        cycles=tuple(cycle for cycle, known in zip(cycles, reached, strict=True) if known),
        u=wear.u_c[reached],
        error=wear.error[reached],
        cost=Cost(*map(int, wear.cost)),
        notices=wear.notices,
    )
    if late:
        return outcome._replace(stopped="the time limit has passed", interrupted=True)
    stopped = None if reached.all() else "the cycles beyond could not be counted"
    return outcome._replace(stopped=stopped)


def _reached(wear: Outcome) -> str:
    last = f"cycle {wear.cycles[-1]}" if wear.cycles else "no requested cycle"
    return f"{wear.method}: {wear.stopped}; {last} was reached"


def _history(
    scene: Scene, model: Model, wanted: tuple[int, ...], wear: Outcome, rtol: float, seconds: float
) -> History:
    """Return all fields at the requested cycles that were reached, in the order of the request."""
    place = {cycle: at for at, cycle in enumerate(wear.cycles)}
    cycles = [cycle for cycle in wanted if cycle in place]
    order = [place[cycle] for cycle in cycles]
    u, error = wear.u[order], wear.error[order]
    fields = fields_at(model, scene, cycles, u)
    found: dict[str, Any] = {name: getattr(fields, name, None) for name in FIELDS}
    return History(
        definition=scene,
        cycles=np.array(cycles, dtype=np.int64),
        u_c=u,
        **found,
        error=error,
        method=wear.method,
        rtol=rtol,
        cost=wear.cost._asdict(),
        seconds=seconds,
        notices=(
            *_repeated(wanted),
            *scene.notices,
            *wear.notices,
            *result_notices(model, scene, fields, cycles, u),
        ),
        stopped=wear.stopped is not None,
    )


def _repeated(wanted: Sequence[int]) -> tuple[str, ...]:
    """Return a notice on numbers of cycles that were requested more than once."""
    twice = [str(cycle) for cycle, times in Counter(wanted).items() if times > 1]
    shown = ", ".join(twice[:10]) + (", ..." if len(twice) > 10 else "")
    return (f"cycles: {shown} given more than once",) if twice else ()
