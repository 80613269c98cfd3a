"""`solve`: the wear of a scene after any numbers of cycles, by the method that suits."""

from __future__ import annotations

import math
import numbers
import os
import time
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from wear import direct, records
from wear.checked import MOST_CYCLES
from wear.faults import AccuracyError, Interrupted, UsageError
from wear.history import History
from wear.load import HistoryLoad
from wear.load.spans import most_cycles
from wear.orbit.problem import Cost
from wear.outcome import Outcome
from wear.states import displacement_of, fields_at, reaction_of, result_notices

if TYPE_CHECKING:
    from wear.model import Model
    from wear.scene import Scene

__all__ = ["METHODS", "MOST_CYCLES", "solve"]

METHODS = ("auto", "abel", "collocation", *direct.METHODS)
LEAST_RTOL, LARGEST_RTOL = 1e-15, 0.1
AFFORDABLE_CYCLES = 1000  # that auto integrates one by one where the cycle count fails
DIRECT_LIMIT = 1e-11  # of the accuracy that integrating them one by one can reach


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
        Seconds after which to stop with what there is.
    progress
        Is told in words how far an integration is that takes more than two seconds.

    Raises
    ------
    UsageError
        if the request makes no sense, all that is wrong with it at once.
    AccuracyError
        if `rtol` was not reached; `best` is the history that was.
    Interrupted
        on Ctrl-C or at the time limit; `history` has the cycles that were reached.

    >>> history = solve("section4", [1, 10], rtol=1e-6)
    >>> [f"{wear:.4e}" for wear in history.u_c]
    ['3.0253e-05', '2.3692e-04']
    """
    from wear.model import bind
    from wear.resampling import resampled
    from wear.scene import as_scene

    start = time.monotonic()
    scene = as_scene(scene)
    wanted = checked_request(scene, cycles, rtol, method, time_limit)
    model = bind(scene)
    deadline = np.inf if time_limit is None else start + time_limit
    fewer = resampled(scene, rtol)
    wear = _solved(model, fewer.scene, wanted, rtol - fewer.error, method, deadline, progress)
    error = wear.error + fewer.missed(wear.u)
    wear = wear._replace(error=error, notices=(*fewer.notices, *wear.notices))
    history = _history(scene, model, wanted, wear, rtol, time.monotonic() - start)
    if wear.interrupted:
        raise Interrupted(_reached(wear), history)
    worst = float(np.max(history.error, initial=0.0))
    if wear.stopped or not worst <= rtol:
        missed = f"{wear.method}: the estimated error is {worst:.1e}, {rtol:.1e} was requested"
        raise AccuracyError(_reached(wear) if wear.stopped else missed, history)
    return history


def checked_request(
    scene: Scene,
    cycles: float | Iterable[float],
    rtol: float,
    method: str,
    time_limit: float | None,
) -> tuple[int, ...]:
    """The numbers of cycles as integers; everything that is wrong with the request at once."""
    faults: list[str] = []
    wanted = whole_cycles(cycles, faults)
    if not is_number(rtol) or not LEAST_RTOL <= rtol <= LARGEST_RTOL:
        faults.append(f"rtol: {rtol!r} is not between 1e-15 and 0.1")
    if method not in METHODS:
        faults.append(f"method: {method!r} is none of {', '.join(METHODS)}")
    elif method == "abel" and obstacle(scene) is not None:
        faults.append(f"method: abel is not for this scene: {obstacle(scene)}; take auto")
    elif method == "collocation" and not _is_smooth_history(scene):
        faults.append("method: collocation is for a measured history without cutoff; take auto")
    if time_limit is not None and not (is_number(time_limit) and time_limit > 0.0):
        faults.append(f"time_limit: {time_limit!r} is no positive number of seconds")
    if max(wanted, default=0) > most_cycles(scene.load):
        faults.append(f"cycles: the load ends after {most_cycles(scene.load)} whole cycles")
    if faults:
        raise UsageError("\n".join(faults))
    return wanted


def whole_cycles(
    cycles: float | Iterable[float], faults: list[str], least: int = 0
) -> tuple[int, ...]:
    """Return numbers of cycles, or one, as integers; what is none of them is among the `faults`."""
    wanted = tuple(_whole(number, faults, least) for number in _several(cycles))
    if not wanted:
        faults.append("cycles: give at least one number of cycles")
    return wanted


def _several(given: Any) -> Iterable[Any]:
    """Return the numbers of a list, an array, a series of pandas or xarray, or one as a list."""
    if hasattr(given, "to_numpy"):
        given = given.to_numpy()
    if isinstance(given, np.ndarray | np.generic):
        given = given.tolist()
    return given if isinstance(given, Iterable) and not isinstance(given, str | bytes) else [given]


def is_number(given: object) -> bool:
    """Return whether something is a real number and no truth value."""
    return isinstance(given, numbers.Real) and not isinstance(given, bool)


def _whole(number: float, faults: list[str], least: int) -> int:
    if not is_number(number) or not least <= number <= MOST_CYCLES or number != int(number):
        faults.append(f"cycles: {number!r} is no whole number from {least} to 1e12")
        return least
    return int(number)


def wear_depths(wear_mm: float | Iterable[float], faults: list[str]) -> tuple[float, ...]:
    """Return depths of wear in mm, or one; what is none of them is among the `faults`."""
    depths = tuple(_several(wear_mm))
    faults += [
        f"wear: {depth!r} is no depth in mm; give a number >= 0"
        for depth in depths
        if not (is_number(depth) and 0.0 <= depth < math.inf)
    ]
    return depths


def obstacle(scene: Scene) -> str | None:
    """Why cycles of this scene cannot be counted, None if they can."""
    if isinstance(scene.load, HistoryLoad):
        return "the load does not repeat"
    return None


def _is_smooth_history(scene: Scene) -> bool:
    """Whether the load is a measured history, and contact does not jump."""
    return isinstance(scene.load, HistoryLoad) and not scene.contact.ends_at_3_sigma


def _methods(
    scene: Scene, method: str, wanted: tuple[int, ...], rtol: float
) -> tuple[tuple[str, str], ...]:
    """The methods to try in turn, each with the reason to tell (none if the user chose it)."""
    if method != "auto":
        return ((method, ""),)
    against = obstacle(scene)
    if against is not None:
        return (("collocation" if _is_smooth_history(scene) else "DOP853", against),)
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
    """The first method's result that meets the request, or that with the smallest error."""
    results: list[Outcome] = []
    for name, reason in _methods(scene, method, wanted, rtol):
        if name == "abel":
            wear = _by_abel(model, scene, wanted, rtol, deadline)
        elif name == "collocation":
            assert isinstance(scene.load, HistoryLoad)
            wear = records.follow(model, scene.load, wanted, rtol, deadline)
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
    from wear.cycles import wear_after

    cycles = tuple(sorted(set(wanted)))
    nothing = Outcome("abel", (), np.empty(0), np.empty(0), Cost(0, 0))
    try:
        found = wear_after(
            model, scene.load, np.array(cycles, dtype=float), rtol, deadline=deadline
        )
    except KeyboardInterrupt:
        return nothing._replace(stopped="interrupted", interrupted=True)
    except (AccuracyError, ArithmeticError, ValueError) as fault:  # LinAlgError is a ValueError
        return nothing._replace(stopped=f"the cycles could not be counted ({fault})")
    late = not np.all(found.error <= rtol) and time.monotonic() > deadline
    reached = np.isfinite(found.error if late else found.u_c)
    outcome = nothing._replace(
        cycles=tuple(cycle for cycle, known in zip(cycles, reached, strict=True) if known),
        u=found.u_c[reached],
        error=found.error[reached],
        cost=Cost(*map(int, found.cost)),
        notices=found.notices,
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
    """All fields at the requested cycles that were reached, in the order of the request."""
    place = {cycle: at for at, cycle in enumerate(wear.cycles)}
    cycles = [cycle for cycle in wanted if cycle in place]
    order = [place[cycle] for cycle in cycles]
    u, error = wear.u[order], wear.error[order]
    fields = fields_at(model, scene, cycles, u)
    return History(
        cycles=np.array(cycles, dtype=np.int64),
        u_c=u,
        u_a=getattr(fields, "u_a", None),
        sigma_c=fields.sigma_c,
        sigma_a=getattr(fields, "sigma_a", None),
        h=fields.h,
        p=fields.p,
        error=error,
        U_c=getattr(fields, "U_c", None),
        R_a=reaction_of(scene, fields.p),
        U_a=displacement_of(model, scene, u),
        scene=scene.title or scene.name,
        definition=scene,
        variant=scene.variant.name,
        operations=model.operations,
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
    """Which numbers of cycles were asked for more than once."""
    twice = [str(cycle) for cycle, times in Counter(wanted).items() if times > 1]
    shown = ", ".join(twice[:10]) + (", ..." if len(twice) > 10 else "")
    return (f"cycles: {shown} given more than once",) if twice else ()
