"""Speed against true error: methods on cases of known wear, interleaved, medians.

Every method first solves every case once, from few cycles to many, while the expected time of a run
is below the cap; then rounds over all short runs follow until the time is used up. Start-up
(import, binding, compilation) is measured separately. Nothing is left out: wrong answers and runs
that were too long are results.
"""

from __future__ import annotations

import math
import statistics
import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any, NamedTuple, TypeVar

from wear.benchmark.methods import Answer, Case, Method, Run, UnsuitableError

ROUNDING = 4e-15  # errors below count as zero
WRONG = 1e-2  # relative error from which an answer is wrong
NO_ANSWER = Answer(math.nan)
LEAST_GROWTH = 0.5  # power of the cycles with which the time of a next run grows at least

Row = TypeVar("Row")


def grouped(rows: Iterable[Row], by: str) -> dict[Any, list[Row]]:
    """Return rows by the value of a field in order of appearance, numbers of cycles ascending."""
    groups: dict[Any, list[Row]] = {}
    for row in rows:
        groups.setdefault(getattr(row, by), []).append(row)
    return dict(sorted(groups.items())) if by == "cycles" else groups


class Effort(NamedTuple):
    """The effort of a measurement, in seconds of processor time: the largest expected time of a run
    is `cap`; runs of up to `repeated` are repeated in at most `rounds`, in a time of `rest`."""

    cap: float
    repeated: float
    rounds: int
    rest: float


QUICK = Effort(cap=0.5, repeated=0.05, rounds=5, rest=3.0)
DEFAULT = Effort(cap=1.5, repeated=0.25, rounds=7, rest=20.0)
FULL = Effort(cap=20.0, repeated=1.0, rounds=9, rest=300.0)


class Status(StrEnum):
    """The outcome of a run."""

    MET = "met"  # the true error is within the tolerance
    MISSED = "missed"  # it is not, and the method did not report it
    WRONG = "wrong"  # by more than a percent, and the method did not report it
    REPORTED = "reported"  # the method reports that it failed
    STOPPED = "slow"  # the time limit has passed
    SKIPPED = "skipped"  # it would have taken longer than the cap
    UNSUITABLE = "unsuitable"  # the method cannot solve such a scene


class Measurement(NamedTuple):
    """A method on a case at a tolerance; the defaults are those of a case that was not run.

    `seconds` is the median of `repeats` runs (the expected time if skipped), `error` the true
    signed relative error, `estimate` the method's own; NaN or None where there is none.
    """

    method: str
    scene: str
    cycles: int
    tolerance: float
    seconds: float = math.nan
    repeats: int = 0
    error: float = math.nan
    estimate: float | None = None
    evaluations: int | None = None
    status: Status = Status.SKIPPED
    remark: str = ""

    @property
    def honest(self) -> bool:
        """Return whether the method's own estimate, if it has one, bounds its true error."""
        unknown = self.estimate is None or not math.isfinite(self.error)
        return unknown or abs(self.error) <= max(self.estimate or 0.0, ROUNDING)


class StartUp(NamedTuple):
    """Seconds that a method takes once for each scene: bind, compile, run one cycle."""

    method: str
    scene: str
    seconds: float


@dataclass
class TimedRun:
    """A run to be repeated, its last answer, and the seconds of its repetitions so far."""

    method: Method
    case: Case
    tolerance: float
    run: Run
    answer: Answer = NO_ANSWER
    seconds: list[float] = field(default_factory=list)

    def once(self) -> None:
        """Run once and record the processor time, which excludes other programs."""
        start = time.process_time()
        self.answer = self.run(self.case.cycles, self.tolerance)
        self.seconds.append(time.process_time() - start)


def measurement(
    method: str, case: Case, tolerance: float, seconds: Sequence[float], answer: Answer
) -> Measurement:
    """Return the measurement of runs with these `seconds`, of which it has the median."""
    error = answer.wear / case.wear - 1.0
    return Measurement(
        method, case.name, case.cycles, tolerance, statistics.median(seconds), len(seconds), error,
        answer.estimate, answer.evaluations, *judge(error, tolerance, answer),
    )  # fmt: skip


def judge(error: float, tolerance: float, answer: Answer = NO_ANSWER) -> tuple[Status, str]:
    """Return the status of a true relative error and a remark, given what the method reports.

    >>> judge(-0.41, 1e-3)
    (<Status.WRONG: 'wrong'>, 'silently off by -41 %')
    """
    if answer.stopped:
        return Status.STOPPED, answer.complaint
    if answer.complaint or not math.isfinite(error):
        return Status.REPORTED, answer.complaint or "no number"
    if abs(error) <= max(tolerance, ROUNDING):
        return Status.MET, ""
    if abs(error) <= WRONG:
        return Status.MISSED, f"true error {abs(error) / tolerance:.2g} times the tolerance"
    return Status.WRONG, f"silently off by {100.0 * error:+.3g} %"


def benchmark(
    methods: Sequence[Method],
    cases: Sequence[Case],
    effort: Effort = DEFAULT,
    progress: Callable[[str], None] = lambda _: None,
) -> tuple[tuple[Measurement, ...], tuple[StartUp, ...]]:
    """Measure `methods` on `cases`, those of a scene by rising cycles, and the start-up of each.

    `progress` is called with a line at each step.
    """
    runs: list[TimedRun] = []
    starts: list[StartUp] = []
    not_run: list[Measurement] = []
    for method in methods:
        progress(f"{method.name}: first runs")
        for name, of_scene in grouped(cases, "name").items():
            start = time.process_time()
            try:
                run = method.prepare(of_scene[0].scene)
                run(1, method.tolerances[0])  # with imports and compilation at the first use
                starts.append(StartUp(method.name, name, time.process_time() - start))
                for tolerance in method.tolerances:
                    tried, skipped = _first_runs(method, run, of_scene, tolerance, effort.cap)
                    runs += tried
                    not_run += skipped
            except UnsuitableError as fault:
                for case in of_scene:
                    lacking = Measurement(method.name, name, case.cycles, math.nan)
                    not_run.append(lacking._replace(status=Status.UNSUITABLE, remark=str(fault)))
    _repeat([run for run in runs if run.seconds[0] <= effort.repeated], effort, progress)
    measured = (
        # of several runs the first one, a warm-up, does not count
        measurement(r.method.name, r.case, r.tolerance, r.seconds[1:] or r.seconds, r.answer)
        for r in runs
    )
    return (*measured, *not_run), tuple(starts)


def _first_runs(
    method: Method, run: Run, cases: Sequence[Case], tolerance: float, cap: float
) -> tuple[list[TimedRun], list[Measurement]]:
    """Solve from few cycles to many, until the expected time of a run exceeds the cap; return what
    was run and what was not."""
    tried: list[TimedRun] = []
    skipped = []
    for case in cases:
        expected = _expected(tried, case.cycles) if method.steps else 0.0
        if expected > cap:
            remark = f"would take some {expected:.2g} s"
            left_out = Measurement(method.name, case.name, case.cycles, tolerance, expected)
            skipped.append(left_out._replace(remark=remark))
        else:
            tried.append(TimedRun(method, case, tolerance, run))
            tried[-1].once()
    return tried, skipped


def _expected(before: Sequence[TimedRun], cycles: int) -> float:
    """Return the expected seconds, from the growth of the time between the last two runs."""
    if not before:
        return 0.0
    last = before[-1]
    growth = 1.0
    if len(before) > 1:
        ratio = last.seconds[0] / before[-2].seconds[0]
        growth = math.log(max(ratio, 1.0)) / math.log(last.case.cycles / before[-2].case.cycles)
        growth = min(max(growth, LEAST_GROWTH if growth > 0.1 else 0.0), 1.0)
    return float(last.seconds[0] * (cycles / last.case.cycles) ** growth)


def _repeat(runs: Sequence[TimedRun], effort: Effort, progress: Callable[[str], None]) -> None:
    """Repeat the runs in rounds, so that a busy machine disturbs all methods alike."""
    begin = time.process_time()
    for number in range(1, effort.rounds + 1):
        progress(f"round {number} of {effort.rounds}")
        for run in runs:
            if time.process_time() - begin > effort.rest:
                return
            run.once()
