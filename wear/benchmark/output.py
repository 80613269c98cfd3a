"""The forms of a benchmark's result: text for the terminal, Markdown, CSV, JSON."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from wear.benchmark import Measurement, StartUp
from wear.benchmark.machine import footer
from wear.benchmark.summary import (
    at,
    cell,
    cycle_count,
    cycles_of,
    duration,
    sentences,
    silent_failures,
    unique,
)


class Result(NamedTuple):
    """A benchmark with all that belongs to it.

    `imports` are the seconds that each method's imports take in a fresh process, `absent` what a
    peer needs and is not installed, `facts` those of `wear.benchmark.machine.machine`.
    """

    runs: tuple[Measurement, ...]
    starts: tuple[StartUp, ...]
    imports: Mapping[str, float]
    absent: Mapping[str, tuple[str, ...]]
    facts: Mapping[str, Any]


DIGITS = (6, 10)
EXPLANATION = (
    "Time to so many correct digits (d digits: a true relative error of at most 1e-d) against the "
    "number of cycles N; in brackets the ratio to the fastest. ~: what it would have taken at the "
    "loosest tolerance, not tried; off by: the best true error that was reached."
)


WORDS = ("scene", "method", "what happened")  # headings of columns of words


class Table(NamedTuple):
    """A caption, a heading a column and rows of text."""

    caption: str
    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


def speed_table(runs: Sequence[Measurement], scene: str, digits: int) -> Table:
    """Methods against numbers of cycles."""
    here = [run for run in runs if run.scene == scene]
    counts = cycles_of(here)
    rows = [
        (method, *(cell(at(here, scene, n), method, digits) for n in counts))
        for method in unique([run.method for run in here])
    ]
    header = ("method", *(f"N = {cycle_count(n)}" for n in counts))
    return Table(f"{scene}, {digits} digits", header, tuple(rows))


def start_table(result: Result) -> Table:
    """What happens once: imports in a fresh process, then getting ready for a scene."""
    rows = []
    for method in unique([start.method for start in result.starts]):
        ready = [start.seconds for start in result.starts if start.method == method]
        imports = result.imports.get(method)
        shown = "-" if imports is None else duration(imports)
        rows.append((method, shown, duration(min(ready)), duration(max(ready))))
    header = ("method", "imports", "ready, least", "ready, most")
    return Table("Start-up, apart from the times above", header, tuple(rows))


def failure_table(runs: Sequence[Measurement]) -> Table:
    """Answers that were wrong without a word."""
    rows = [
        (run.method, run.scene, cycle_count(run.cycles), f"{run.tolerance:g}", f"{run.error:+.0%}")
        for run in silent_failures(runs)
    ]
    header = ("method", "scene", "cycles", "tolerance", "true error")
    return Table("Wrong by more than a percent without a word", header, tuple(rows))


def tables(result: Result) -> tuple[Table, ...]:
    """All tables, those of the scenes first."""
    scenes = unique([run.scene for run in result.runs])
    made = [speed_table(result.runs, scene, digits) for digits in DIGITS for scene in scenes]
    made += [failure_table(result.runs), start_table(result)]
    return tuple(table for table in made if table.rows)


def markdown_table(table: Table) -> str:
    """A table of Markdown, its columns of words left-aligned."""
    rule = ["---" if name in WORDS else "---:" for name in table.header]
    lines = [table.header, rule, *table.rows]
    return "\n".join("| " + " | ".join(entries) + " |" for entries in lines)


def markdown(result: Result, scene: str) -> str:
    """The part of a page that is computed: sentences on one scene, tables, the machine."""
    parts = ["\n".join(f"- {sentence}" for sentence in sentences(result.runs, scene))]
    parts.append(EXPLANATION)
    for table in tables(result):
        parts += [f"**{table.caption}**", markdown_table(table)]
    parts += absences(result)
    parts.append(f"*{footer(dict(result.facts))}*")
    return "\n\n".join(parts) + "\n"


def absences(result: Result) -> list[str]:
    """A line for each method that could not take part."""
    return [
        f"{method}: not measured, {' and '.join(packages)} not installed"
        for method, packages in result.absent.items()
    ]


def csv_text(rows: Sequence[NamedTuple]) -> str:
    """A line a row below the names of the fields; floats round-trip, None is empty."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    if rows:
        writer.writerow(rows[0]._fields)
    writer.writerows(rows)
    return stream.getvalue()


def document(result: Result, scene: str) -> dict[str, Any]:
    """The JSON document of `wear bench`."""
    return {
        "machine": dict(result.facts),
        "sentences": list(sentences(result.runs, scene)),
        "measurements": [run._asdict() for run in result.runs],
        "start_up": [start._asdict() for start in result.starts],
        "import_seconds": dict(result.imports),
        "not_installed": {name: list(packages) for name, packages in result.absent.items()},
    }
