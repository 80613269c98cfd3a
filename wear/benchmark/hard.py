"""The hard catalogue: every method on scenes made to break it, with its true error.

Built-in scenes beyond the note's own, each at a few numbers of cycles of known wear. A method fails
here by being wrong, by being slow, or by having to say that it cannot; only the first is a fault.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

from wear.benchmark import ROUNDING, Status, judge
from wear.benchmark.cases import Case, cases, names
from wear.benchmark.method import Answer, UnsuitableError
from wear.benchmark.own import AS_IT_COMES, DEFAULT_TOLERANCE, SCIPY, as_it_comes, solver

EVERY_CYCLE = 100  # up to which the methods that go through every cycle are tried
STEPPED_TOLERANCE = 1e-6
COUNTED_TOLERANCE = 1e-10


class Hard(NamedTuple):
    """A method on a hard case: `error` is its true signed relative error, `estimate` its own.

    `remark` says how it failed; `seconds` is one run.
    """

    scene: str
    cycles: int
    method: str
    tolerance: float
    error: float
    estimate: float | None
    seconds: float
    status: Status
    remark: str

    @property
    def honest(self) -> bool:
        """Whether the method's own estimate, if it has one, covers its true error."""
        told = self.estimate is None or not math.isfinite(self.error)
        return told or abs(self.error) <= max(self.estimate or 0.0, ROUNDING)


def catalogue() -> tuple[Case, ...]:
    """All hard cases."""
    return cases("hard", names("hard"))


def methods_of(case: Case) -> Iterator[tuple[str, float]]:
    """The methods to try on a case, each with its tolerance."""
    yield "auto", COUNTED_TOLERANCE
    if case.cycles <= EVERY_CYCLE:
        yield from ((name, STEPPED_TOLERANCE) for name in SCIPY)
        yield from ((f"solve_ivp {name}", DEFAULT_TOLERANCE) for name in AS_IT_COMES)


def attempt(case: Case, method: str, tolerance: float, time_limit: float) -> Hard:
    """Run one method on one case."""
    plain = method.removeprefix("solve_ivp ")
    start = time.perf_counter()
    try:
        if plain != method:
            run = as_it_comes(case.scene, plain)
        else:
            run = solver(case.scene, method, time_limit)
        answer = run(case.cycles, tolerance)
        error = answer.wear / case.wear - 1.0
        status, remark = judge(error, tolerance, answer)
    except (UnsuitableError, ArithmeticError, ValueError) as fault:
        answer, error = Answer(math.nan), math.nan
        status, remark = Status.TOLD, str(fault)
    seconds = time.perf_counter() - start
    return Hard(
        case.name,
        case.cycles,
        method,
        tolerance,
        error,
        answer.estimate,
        seconds,
        status,
        remark,
    )


def hard_cases(
    chosen: Sequence[Case],
    time_limit: float = 2.0,
    progress: Callable[[str], None] = lambda _: None,
) -> tuple[Hard, ...]:
    """Try every method on every case.

    Parameters
    ----------
    time_limit
        Seconds after which a run of a method that can be stopped is.
    """
    found: list[Hard] = []
    for case in chosen:
        progress(f"{case.name}, {case.cycles} cycles")
        too_slow = {entry.method for entry in found if _ran_out(entry, case, time_limit)}
        found += [
            attempt(case, method, tolerance, time_limit)
            for method, tolerance in methods_of(case)
            if method not in too_slow
        ]
    return tuple(found)


def _ran_out(entry: Hard, case: Case, time_limit: float) -> bool:
    """Whether the method was too slow for fewer cycles of the same scene."""
    fewer = entry.scene == case.name and entry.cycles < case.cycles
    return fewer and entry.seconds > time_limit


def worst(found: Sequence[Hard], scene: str, method: str) -> Hard | None:
    """The case of a scene that shows a method from its worst side."""
    entries = [entry for entry in found if (entry.scene, entry.method) == (scene, method)]
    order = (Status.WRONG, Status.TOLD, Status.MISSED, Status.STOPPED, Status.MET)
    return min(
        entries,
        key=lambda entry: (entry.honest, order.index(entry.status), -abs(entry.error)),
        default=None,
    )
