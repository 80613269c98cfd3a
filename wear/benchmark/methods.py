"""The cases and methods of the benchmark.

A case is a scene with its known wear, far more accurate than double precision;
`wear/data/reference.json` describes the computation of the values, without any code of the package.
A run of the package's own method contains all that a user waits for: binding the model, solving,
checking the error estimate and computing the fields.
"""

from __future__ import annotations

import json
import math
import time
from collections.abc import Callable, Iterable
from functools import partial
from importlib.resources import files
from typing import Any, Literal, NamedTuple

from wear.binding import bind
from wear.faults import AccuracyError, Interrupted, UsageError
from wear.load import Blocks, HistoryLoad
from wear.scene import Scene, load_scene
from wear.solver import solve

REFERENCE: Any = json.loads(
    files("wear").joinpath("data", "reference.json").read_text(encoding="utf-8")
)
CYCLES = (1, 100, 9000, 10**6, 10**8)
ONE = ("section4",)
FEW = ("section3", "section4", "fast-wear")
LONGEST_RUN = 30.0  # s, if the method can be stopped
SCIPY = ("DOP853", "Radau", "BDF", "LSODA", "RK45")
WITH_DEFAULTS = ("RK45", "LSODA")
DEFAULT_TOLERANCE = 1e-3  # `solve_ivp`'s rtol


class Case(NamedTuple):
    """A scene, a number of cycles and the true wear in mm after them."""

    name: str
    scene: Scene
    cycles: int
    wear: float


def cases(
    kind: Literal["speed", "hard"],
    scenes: Iterable[str] | None = None,
    cycles: Iterable[int] | None = None,
) -> tuple[Case, ...]:
    """Return the cases of the speed comparison or of the hard catalogue, all or those of some
    scenes and numbers of cycles; the cycles of a scene rise.

    >>> [case.cycles for case in cases("speed", ["section4"], CYCLES)]
    [1, 100, 9000, 1000000, 100000000]
    """
    known = []
    for name in scenes or REFERENCE[kind]:
        entry = REFERENCE[kind][name]
        scene = load_scene(entry["scene"], entry["set"])
        for text, wear in entry["u_c_mm"].items():
            if cycles is None or int(text) in cycles:
                known.append(Case(name, scene, int(text), wear))
    return tuple(known)


class Answer(NamedTuple):
    """Wear in mm after the last cycle.

    `estimate` is the method's own estimate of the relative error and `evaluations` the number of
    right-hand sides, None if it reports none; `complaint` is empty if it reports success; `stopped`
    if its time limit passed.
    """

    wear: float
    estimate: float | None = None
    evaluations: int | None = None
    complaint: str = ""
    stopped: bool = False


Run = Callable[[int, float], Answer]
"""Solves for the wear after a number of cycles from the initial state, to a relative tolerance."""


class Method(NamedTuple):
    """A way to solve a scene.

    `imports` are the modules whose import is part of its start-up, all of which have to be
    installed. `prepare` does the work once for each scene (bind, compile) and raises
    `UnsuitableError` for a scene that the method cannot solve. `tolerances` are those to try.
    `steps`: it integrates every cycle, so that time is expected to grow with their number.
    """

    name: str
    imports: tuple[str, ...]
    prepare: Callable[[Scene], Run]
    tolerances: tuple[float, ...]
    steps: bool = True


class UnsuitableError(Exception):
    """The method cannot solve the scene, for the reason in the message."""


def solver(scene: Scene, method: str, time_limit: float = LONGEST_RUN) -> Run:
    """Return `wear.solve` with one of its methods as a run."""

    def run(cycles: int, tolerance: float) -> Answer:
        complaint, stopped, start = "", False, time.monotonic()
        try:
            history = solve(scene, [cycles], tolerance, method, time_limit)
        except UsageError as fault:
            raise UnsuitableError(str(fault)) from fault
        except Interrupted as stop:
            if time.monotonic() - start < time_limit:
                raise KeyboardInterrupt from stop  # by a person: the whole benchmark ends
            history, complaint, stopped = stop.history, str(stop), True
        except AccuracyError as miss:
            if miss.best is None:
                raise UnsuitableError(str(miss)) from miss
            history, complaint = miss.best, str(miss)
        if len(history.u_c) == 0:
            return Answer(math.nan, complaint=complaint, stopped=stopped)
        error = float(history.error[0])  # NaN where there is no estimate
        estimate = None if math.isnan(error) else error
        evaluations = history.cost["rhs_evaluations"]
        return Answer(float(history.u_c[0]), estimate, evaluations, complaint, stopped)

    return run


def solve_ivp_with_defaults(scene: Scene, method: str) -> Run:
    """Return `solve_ivp` on the equation in mm and s as a run, with its default tolerances whatever
    is requested: the first attempt of a user.

    The answer is wrong by tens of percent without a warning: the absolute tolerance, 1e-6 mm, is a
    tenth of the wear of the first cycles, and steps jump over contact pulses.
    """
    from scipy.integrate import solve_ivp

    load = scene.load
    if isinstance(load, Blocks | HistoryLoad):
        raise UnsuitableError("the load does not repeat")
    model, periodic = bind(scene), scene.periodic_load

    def right_hand_side(t: float, u: Any) -> Any:
        return model.rate(u, periodic(t / periodic.period))

    def run(cycles: int, _: float) -> Answer:
        end = cycles * periodic.period
        solution = solve_ivp(right_hand_side, (0.0, end), [0.0], method=method)
        return Answer(float(solution.y[0, -1]), evaluations=int(solution.nfev))

    return run


def _own(name: str, method: str, tolerances: tuple[float, ...]) -> Method:
    steps = method in SCIPY
    imports = ("wear.solver", "scipy.integrate") if steps else ("wear.solver",)
    return Method(name, imports, partial(solver, method=method), tolerances, steps)


OWN = (
    _own("abel", "abel", (1e-4, 1e-6, 1e-9, 1e-12)),
    *(_own(f"wear {method}", method, (1e-4, 1e-6, 1e-9)) for method in SCIPY),
    *(
        Method(
            f"solve_ivp {method}, defaults",
            ("scipy.integrate",),
            partial(solve_ivp_with_defaults, method=method),
            (DEFAULT_TOLERANCE,),
        )
        for method in WITH_DEFAULTS
    ),
)
