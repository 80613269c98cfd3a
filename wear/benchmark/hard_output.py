"""The hard catalogue's result as tables."""

from __future__ import annotations

import math
from collections.abc import Sequence

from wear.benchmark import Status
from wear.benchmark.hard import Hard, worst
from wear.benchmark.output import Table, markdown_table
from wear.benchmark.summary import cycle_count, magnitude, unique

LEGEND = (
    "Largest true relative error over the numbers of cycles tried. told: the method said that it "
    "did not reach its tolerance; slow: its time limit passed; missed, wrong: it was beyond its "
    "tolerance and did not say so (wrong: by more than a percent); estimate: its own error "
    "estimate was smaller than the error."
)


def overview(found: Sequence[Hard]) -> Table:
    """Scenes against methods."""
    methods = unique([entry.method for entry in found])
    rows = []
    for scene in unique([entry.scene for entry in found]):
        entries = [worst(found, scene, method) for method in methods]
        rows.append((scene, *map(_cell, entries)))
    tolerances = {entry.method: f"{entry.method}\n{entry.tolerance:g}" for entry in found}
    return Table("Hard cases", ("scene", *(tolerances[name] for name in methods)), tuple(rows))


def _cell(entry: Hard | None) -> str:
    if entry is None:
        return "-"
    if not math.isfinite(entry.error):
        return entry.status
    size = magnitude(entry.error) if entry.error else "0"
    if not entry.honest:
        return f"{size} estimate"
    return size if entry.status is Status.MET else f"{size} {entry.status}"


def failures(found: Sequence[Hard]) -> Table:
    """How methods failed: once a scene and method, at its worst."""
    rows = []
    for scene in unique([entry.scene for entry in found]):
        for method in unique([entry.method for entry in found]):
            entry = worst(found, scene, method)
            if entry is not None and (entry.status is not Status.MET or not entry.honest):
                rows.append((scene, cycle_count(entry.cycles), method, _how(entry)))
    return Table("How they fail", ("scene", "cycles", "method", "what happened"), tuple(rows))


def _how(entry: Hard) -> str:
    if entry.honest:
        return entry.remark
    return f"claims an error of {entry.estimate:.1e}, has one of {abs(entry.error):.1e}"


def markdown(found: Sequence[Hard], footer: str) -> str:
    """The part of the hard-case page that is computed."""
    table = overview(found)
    flat = table._replace(header=tuple(head.replace("\n", " ") for head in table.header))
    parts = [LEGEND, markdown_table(flat), "**How they fail**", markdown_table(failures(found))]
    return "\n\n".join([*parts, f"*{footer}*"]) + "\n"
