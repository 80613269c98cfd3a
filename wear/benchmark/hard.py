"""The hard catalogue: every method on scenes that are difficult for it, with its true error.

Built-in scenes beyond the note's own, each at a few numbers of cycles with known wear. A method
fails here if it is wrong, slow, or reports that it cannot solve; only the first is a fault.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator, Sequence
from functools import partial

from wear.benchmark import Measurement, Status, grouped, measurement
from wear.benchmark.methods import (
    DEFAULT_TOLERANCE,
    SCIPY,
    WITH_DEFAULTS,
    Answer,
    Case,
    UnsuitableError,
    solve_ivp_with_defaults,
    solver,
)
from wear.benchmark.results import TextTable, magnitude, markdown_table
from wear.quantities import in_short

LEGEND = (
    "Largest true relative error over the numbers of cycles tried. reported: the method "
    "reported that it did not reach its tolerance; slow: its time limit passed; missed, wrong: it "
    "was beyond its tolerance and did not report it (wrong: by more than a percent); estimate: its "
    "own error estimate was smaller than the error."
)
EVERY_CYCLE = 100  # cycles up to which the methods that integrate every cycle are tried
STEPPED_TOLERANCE = 1e-6
COUNTED_TOLERANCE = 1e-10


def methods_of(case: Case) -> Iterator[tuple[str, float]]:
    """Yield the methods to try on a case, each with its tolerance."""
    yield "auto", COUNTED_TOLERANCE
    if case.cycles <= EVERY_CYCLE:
        yield from ((name, STEPPED_TOLERANCE) for name in SCIPY)
        yield from ((f"solve_ivp {name}", DEFAULT_TOLERANCE) for name in WITH_DEFAULTS)


def attempt(case: Case, method: str, tolerance: float, time_limit: float) -> Measurement:
    """Run one method on one case, once."""
    plain = method.removeprefix("solve_ivp ")
    prepare = solve_ivp_with_defaults if plain != method else partial(solver, time_limit=time_limit)
    start = time.process_time()
    try:
        answer = prepare(case.scene, plain)(case.cycles, tolerance)
    except (UnsuitableError, ArithmeticError, ValueError) as fault:
        answer = Answer(math.nan, complaint=str(fault))
    return measurement(method, case, tolerance, [time.process_time() - start], answer)


def hard_cases(
    chosen: Sequence[Case],
    time_limit: float = 2.0,
    progress: Callable[[str], None] = lambda _: None,
) -> tuple[Measurement, ...]:
    """Try every method on every case.

    Parameters
    ----------
    chosen
        In ascending numbers of cycles of each scene: a method too slow for some is not tried on
        more.
    time_limit
        Seconds after which a run is stopped, if the method allows it.
    """
    entries: list[Measurement] = []
    for case in chosen:
        progress(f"{case.name}, {case.cycles} cycles")
        for method, tolerance in methods_of(case):
            fewer = [e for e in entries if (e.scene, e.method) == (case.name, method)]
            if all(entry.seconds <= time_limit for entry in fewer):
                entries.append(attempt(case, method, tolerance, time_limit))
    return tuple(entries)


def worst(entries: Sequence[Measurement]) -> Measurement:
    """Return the worst case of a method on a scene."""
    order = (Status.WRONG, Status.REPORTED, Status.MISSED, Status.STOPPED, Status.MET)
    return min(
        entries, key=lambda entry: (entry.honest, order.index(entry.status), -abs(entry.error))
    )


def overview(runs: Sequence[Measurement]) -> TextTable:
    """Return the table of scenes against methods."""
    methods = grouped(runs, "method")
    rows = []
    for scene, entries in grouped(runs, "scene").items():
        tried = {method: worst(group) for method, group in grouped(entries, "method").items()}
        rows.append((scene, *(_cell(tried.get(method)) for method in methods)))
    heads = (f"{name}\n{entries[-1].tolerance:g}" for name, entries in methods.items())
    return TextTable("Hard cases", ("scene", *heads), tuple(rows))


def _cell(entry: Measurement | None) -> str:
    if entry is None:
        return "-"
    if not math.isfinite(entry.error):
        return entry.status
    size = magnitude(entry.error) if entry.error else "0"
    if not entry.honest:
        return f"{size} estimate"
    return size if entry.status is Status.MET else f"{size} {entry.status}"


def failures(runs: Sequence[Measurement]) -> TextTable:
    """Return the table of failures: for each scene and method the worst."""
    rows = []
    for scene, entries in grouped(runs, "scene").items():
        for method, group in grouped(entries, "method").items():
            entry = worst(group)
            if entry.status is not Status.MET or not entry.honest:
                how = entry.remark
                if not entry.honest:
                    error = f"{abs(entry.error):.1e}"
                    how = f"claims an error of {entry.estimate:.1e}, has one of {error}"
                rows.append((scene, in_short(entry.cycles, 5), method, how))
    return TextTable("How they fail", ("scene", "cycles", "method", "what happened"), tuple(rows))


def markdown(runs: Sequence[Measurement], footer: str) -> str:
    """Return the computed part of the page on hard cases."""
    table = overview(runs)
    flat = table._replace(header=tuple(head.replace("\n", " ") for head in table.header))
    parts = [LEGEND, markdown_table(flat), "**How they fail**", markdown_table(failures(runs))]
    return "\n\n".join([*parts, f"*{footer}*"]) + "\n"
