"""`derive list`: every equation: id, status, section, title.

examples:
  derive list            ids, statuses, sections and titles
  derive list --json     the same for another program
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from derive import terminal
from derive.command_line import Answer, Options, Parser


def add_arguments(parser: Parser) -> None:
    """Declare nothing: the command has no arguments."""


def execute(options: Options) -> Answer:  # noqa: ARG001  # it has none
    """Return the catalogue."""
    from derive import catalogue

    rows = [
        {
            "id": e.id,
            "section": e.section,
            "title": e.title,
            "status": e.status.value,
            "conditions": list(dict.fromkeys(c.stated for c in e.conditions)),
        }
        for e in catalogue.all_equations()
    ]
    return Answer(rows, lambda: "\n".join(_lines(rows)))


def _lines(rows: Sequence[Mapping[str, Any]]) -> Iterator[str]:
    """Yield a line for each equation, and the number of equations of each status."""
    widths = [max(len(str(row[key])) for row in rows) for key in ("id", "status", "section")]
    for row in rows:
        cells = (str(row[key]) for key in ("id", "status", "section"))
        padded = "  ".join(cell.ljust(width) for cell, width in zip(cells, widths, strict=True))
        yield f"{padded}  {row['title']}"
    statuses = Counter(row["status"] for row in rows)
    counts = ", ".join(f"{number} {status}" for status, number in statuses.most_common())
    yield f"\n{terminal.count(len(rows), 'equation')}: {counts}"
