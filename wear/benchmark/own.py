"""The package's own methods, and SciPy as it comes, for the benchmark.

A run of an own method is all that a user waits for: binding the model, solving, checking the error
estimate and computing the fields.
"""

from __future__ import annotations

import math
import time
from typing import TYPE_CHECKING

from wear.benchmark.method import Answer, Method, Run, UnsuitableError

if TYPE_CHECKING:
    from wear.scene import Scene

LONGEST_RUN = 30.0  # s, of one that can be stopped
SCIPY = ("DOP853", "Radau", "BDF", "LSODA", "RK45")
AS_IT_COMES = ("RK45", "LSODA")
DEFAULT_TOLERANCE = 1e-3  # `solve_ivp`'s rtol


def solver(scene: Scene, method: str, time_limit: float = LONGEST_RUN) -> Run:
    """`wear.solve` by one of its methods."""
    from wear.faults import AccuracyError, Interrupted, UsageError
    from wear.solver import solve

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
        error = float(history.error[0])  # not a number where there is no estimate
        estimate = None if math.isnan(error) else error
        evaluations = history.cost["rhs_evaluations"]
        return Answer(float(history.u_c[0]), estimate, evaluations, complaint, stopped)

    return run


def as_it_comes(scene: Scene, method: str) -> Run:
    """`solve_ivp` on the raw equation with its default tolerances, which the run ignores."""
    from wear.direct.plain import plain
    from wear.load import Blocks, HistoryLoad
    from wear.model import bind

    load = scene.load
    if isinstance(load, Blocks | HistoryLoad):
        raise UnsuitableError("the load does not repeat")
    model = bind(scene)

    def run(cycles: int, _: float) -> Answer:
        found = plain(model, scene.periodic_load, cycles, method)
        return Answer(found.u, evaluations=found.rhs_evaluations)

    return run


def _own(name: str, method: str, tolerances: tuple[float, ...]) -> Method:
    steps = method in SCIPY
    imports = ("wear.solver", "scipy.integrate") if steps else ("wear.solver",)
    return Method(name, imports, lambda scene: solver(scene, method), tolerances, steps)


def _plain(method: str) -> Method:
    return Method(
        f"solve_ivp {method}, defaults",
        ("scipy.integrate",),
        lambda scene: as_it_comes(scene, method),
        (DEFAULT_TOLERANCE,),
    )


OWN = (
    _own("abel", "abel", (1e-4, 1e-6, 1e-9, 1e-12)),
    *(_own(f"wear {method}", method, (1e-4, 1e-6, 1e-9)) for method in SCIPY),
    *map(_plain, AS_IT_COMES),
)
