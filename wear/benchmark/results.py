"""Results of a benchmark: times at equal true error, ratios, sentences, tables, curves, files."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Mapping, Sequence
from functools import cache
from importlib.resources import files
from typing import Any, NamedTuple

import numpy as np

from wear.benchmark import Measurement, StartUp, Status, grouped
from wear.benchmark.machine import footer
from wear.figure_data import TimingCurve
from wear.quantities import in_short

COMMITTED = files("wear").joinpath("data", "speed.json")
SHOWN_SCENE = "section4"  # in the sentences and the figures
FEWEST_DRAWN = 4  # methods in a figure
DIGITS = (6, 10)
EXPLANATION = (
    "Time to so many correct digits (d digits: a true relative error of at most 1e-d) against the "
    "number of cycles N; in brackets the ratio to the fastest. ~: what it would have taken at the "
    "loosest tolerance, not tried; off by: the best true error that was reached."
)
WORDS = ("scene", "method", "what happened")  # headings of columns of words
LEAST_ERROR = float(np.finfo(float).eps) / 2  # relative, that a figure shows
YEAR = 3.15576e7  # s
UNITS = (  # upper limit in s, unit in s, name
    (1e-3, 1e-6, "µs"),
    (1.0, 1e-3, "ms"),
    (120.0, 1.0, "s"),
    (7200.0, 60.0, "min"),
    (172800.0, 3600.0, "h"),
    (YEAR, 86400.0, "days"),
)


def best(runs: Sequence[Measurement], digits: int) -> tuple[Measurement, ...]:
    """Return each method's fastest run with a true relative error of at most 10^-digits, fastest
    first; `runs` are those of one scene and number of cycles."""
    good = [run for run in runs if abs(run.error) <= 10.0**-digits and run.repeats]
    fastest: dict[str, Measurement] = {}
    for run in sorted(good, key=lambda run: run.seconds):
        fastest.setdefault(run.method, run)
    return tuple(fastest.values())


def cell(runs: Sequence[Measurement], method: str, digits: int) -> str:
    """Return a method's time to some digits with its ratio to the fastest, or its outcome."""
    ranking = best(runs, digits)
    for run in ranking:
        if run.method == method:
            ratio = run.seconds / ranking[0].seconds
            return duration(run.seconds) + ("" if ratio == 1.0 else f" ({_rounded(ratio)}x)")
    own = [run for run in runs if run.method == method]
    errors = [abs(run.error) for run in own if math.isfinite(run.error)]
    waits = [run.seconds for run in own if run.status is Status.SKIPPED]
    if waits:
        return f"~ {duration(min(waits))}"
    if errors:
        return f"off by {magnitude(min(errors))}"
    return "-"


def duration(seconds: float) -> str:
    """Return a time in a suitable unit.

    >>> duration(0.00213), duration(47.0), duration(9e4), duration(3e5), duration(4e9)
    ('2.1 ms', '47 s', '25 h', '3.5 days', '127 years')
    """
    for limit, unit, name in UNITS:
        if seconds < limit:
            return f"{_rounded(seconds / unit)} {name}"
    return f"{_rounded(seconds / YEAR)} years"


def magnitude(error: float) -> str:
    """Return the size of a relative error in words.

    >>> magnitude(0.41), magnitude(-2.3e-7), magnitude(17.0)
    ('41 %', '2e-7', '17-fold')
    """
    if abs(error) >= 10.0:
        return f"{_rounded(abs(error))}-fold"
    if abs(error) >= 0.01:
        return f"{_rounded(100.0 * abs(error))} %"
    return f"{abs(error):.0e}".replace("e-0", "e-")


def _rounded(number: float) -> str:
    return f"{number:.2g}" if number < 99.5 else f"{number:.0f}"


class Result(NamedTuple):
    """A benchmark: its measurements, start-ups and circumstances, as in the JSON document.

    `import_seconds` are those of each method in a new process, `not_installed` the packages that
    peers lack, `machine` the facts of `wear.benchmark.machine.machine`.
    """

    machine: Mapping[str, Any]
    measurements: tuple[Measurement, ...]
    start_up: tuple[StartUp, ...]
    import_seconds: Mapping[str, float]
    not_installed: Mapping[str, Sequence[str]]

    @property
    def shown(self) -> list[Measurement]:
        """Return the runs of the scene of the sentences and the figures."""
        return [run for run in self.measurements if run.scene == SHOWN_SCENE]

    @property
    def absences(self) -> list[str]:
        """Return a line for each method that could not take part."""
        return [
            f"{method}: not measured, {' and '.join(packages)} not installed"
            for method, packages in self.not_installed.items()
        ]


class TextTable(NamedTuple):
    """A caption, a heading a column and rows of text."""

    caption: str
    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


def sentences(runs: Sequence[Measurement], digits: int = 6) -> tuple[str, ...]:
    """Return a sentence for each number of cycles: the fastest method to some digits, its time."""
    texts = []
    for cycles, group in grouped(runs, "cycles").items():
        ranking, count = best(group, digits), in_short(cycles, 5)
        if not ranking:
            texts.append(f"{count} cycles, {digits} digits: no method tried reaches them.")
            continue
        first, *others = ranking
        rest = "no other method reached them within its time limit"
        if others:
            ratio = others[0].seconds / first.seconds
            rest = f"{others[0].method} takes {_rounded(ratio)} times as long"
        texts.append(
            f"For {digits} digits of the wear after {count} {'cycle' if cycles == 1 else 'cycles'} "
            f"use {first.method}: it takes {duration(first.seconds)}; {rest}."
        )
    return tuple(texts)


def comparable(runs: Sequence[Measurement]) -> dict[int, list[Measurement]]:
    """Return the runs by number of cycles, beyond one, where enough methods have run to compare
    them."""
    return {
        cycles: group
        for cycles, group in grouped(runs, "cycles").items()
        if cycles > 1 and len({run.method for run in group if run.repeats}) >= FEWEST_DRAWN
    }


def curves(runs: Sequence[Measurement]) -> list[TimingCurve]:
    """Return the completed runs of one case, by method and ascending tolerance; errors of zero are
    shown at the resolution of double precision."""
    shown = [run for run in runs if run.repeats and math.isfinite(run.error)]
    timings = []
    for name, own in grouped(shown, "method").items():
        own.sort(key=lambda run: run.tolerance)
        errors = np.array([max(abs(run.error), LEAST_ERROR) for run in own])
        missed = np.array([run.status is not Status.MET for run in own])
        timings.append(TimingCurve(name, errors, np.array([run.seconds for run in own]), missed))
    return timings


def curves_by_cycles(runs: Sequence[Measurement], digits: int) -> list[TimingCurve]:
    """Return each method's time to a number of digits against the number of cycles, with the
    expected time of the first number of cycles that was skipped."""
    timings = []
    for name, of_method in grouped(runs, "method").items():
        points = []
        for cycles, own in grouped(of_method, "cycles").items():
            waits = [run.seconds for run in own if run.status is Status.SKIPPED]
            if reached := best(own, digits):
                points.append((cycles, reached[0].seconds, False))
            elif waits and points:
                points.append((cycles, min(waits), True))
        if points:
            timings.append(TimingCurve(name, *map(np.array, zip(*points, strict=True))))
    return timings


def speed_table(runs: Sequence[Measurement], digits: int) -> TextTable:
    """Return the table of methods against numbers of cycles of one scene."""
    by_cycles = grouped(runs, "cycles")
    rows = [
        (method, *(cell(group, method, digits) for group in by_cycles.values()))
        for method in grouped(runs, "method")
    ]
    header = ("method", *(f"N = {in_short(n, 5)}" for n in by_cycles))
    return TextTable(f"{runs[0].scene}, {digits} digits", header, tuple(rows))


def start_table(result: Result) -> TextTable:
    """Return the table of start-up times: imports in a new process, preparation for a scene."""
    rows = []
    for method, starts in grouped(result.start_up, "method").items():
        ready = [start.seconds for start in starts]
        imports = result.import_seconds.get(method)
        shown = "-" if imports is None else duration(imports)
        rows.append((method, shown, duration(min(ready)), duration(max(ready))))
    header = ("method", "imports", "ready, least", "ready, most")
    return TextTable("Start-up, apart from the times above", header, tuple(rows))


def failure_table(runs: Sequence[Measurement]) -> TextTable:
    """Return the table of silently wrong runs, by more than a percent: the worst of each method
    and scene."""
    wrong = [run for run in runs if run.status is Status.WRONG]
    worst = {(run.method, run.scene): run for run in sorted(wrong, key=lambda r: abs(r.error))}
    rows = [
        (run.method, run.scene, in_short(run.cycles, 5), f"{run.tolerance:g}", f"{run.error:+.0%}")
        for run in wrong
        if run is worst[run.method, run.scene]
    ]
    header = ("method", "scene", "cycles", "tolerance", "true error")
    return TextTable("Silently wrong by more than a percent", header, tuple(rows))


def tables(result: Result) -> tuple[TextTable, ...]:
    """Return all tables, those of the scenes first."""
    scenes = grouped(result.measurements, "scene").values()
    every = [speed_table(runs, digits) for digits in DIGITS for runs in scenes]
    every += [failure_table(result.measurements), start_table(result)]
    return tuple(table for table in every if table.rows)


def markdown_table(table: TextTable) -> str:
    """Return a table in Markdown, its columns of words left-aligned."""
    rule = ["---" if name in WORDS else "---:" for name in table.header]
    lines = [table.header, rule, *table.rows]
    return "\n".join("| " + " | ".join(entries) + " |" for entries in lines)


def markdown(result: Result) -> str:
    """Return the computed part of a page: sentences on one scene, tables, the machine."""
    parts = ["\n".join(f"- {sentence}" for sentence in sentences(result.shown)), EXPLANATION]
    for table in tables(result):
        parts += [f"**{table.caption}**", markdown_table(table)]
    return "\n\n".join([*parts, *result.absences, f"*{footer(result.machine)}*"]) + "\n"


def csv_text(rows: Sequence[NamedTuple]) -> str:
    """Return rows as CSV below the names of their fields; floats round-trip, None is empty."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    if rows:
        writer.writerow(rows[0]._fields)
    writer.writerows(rows)
    return stream.getvalue()


@cache
def committed() -> Result:
    """Return the benchmark of documentation and report, which `make bench` renews."""
    data = json.loads(COMMITTED.read_text(encoding="utf-8"))
    measurements = tuple(
        Measurement(**row)._replace(
            status=Status(row["status"]), error=math.nan if row["error"] is None else row["error"]
        )
        for row in data["measurements"]
    )
    start_up = tuple(StartUp(**row) for row in data["start_up"])
    times, absent = data["import_seconds"], data["not_installed"]
    return Result(data["machine"], measurements, start_up, times, absent)


def document(result: Result) -> dict[str, Any]:
    """Return the JSON document of `wear bench`."""
    return {
        "machine": result.machine,
        "sentences": sentences(result.shown),
        "measurements": [run._asdict() for run in result.measurements],
        "start_up": [start._asdict() for start in result.start_up],
        "import_seconds": result.import_seconds,
        "not_installed": result.not_installed,
    }
