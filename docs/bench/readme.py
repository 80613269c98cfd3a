"""Bring the times that README.md shows up to the last benchmark.

wear bench --peers -o docs/bench
python docs/bench/readme.py
"""

from __future__ import annotations

import re
from pathlib import Path

HERE = Path(__file__).resolve().parent
README = HERE.parents[1] / "README.md"
RATIO = re.compile(r" \([\d.]+x\)$")


def tables(text: str) -> list[str]:
    """Return the Markdown tables of a text."""
    return re.findall(r"(?:^\|.*\n)+", text, re.MULTILINE)


def cells(line: str) -> list[str]:
    """Return the entries of a row."""
    return [cell.strip() for cell in line.strip("|").split("|")]


def renewed(shown: str, measured: str) -> str:
    """Return a table with the rows and columns of `shown` and the entries of `measured`."""
    head, rule, *rows = shown.splitlines()
    names, _, *found = map(cells, measured.splitlines())
    entries = {row[0]: dict(zip(names, row, strict=True)) for row in found}
    lines = [head, rule]
    for row in rows:
        entry = entries[cells(row)[0]]
        wanted = [RATIO.sub("", entry[column]) for column in cells(head)]
        lines.append("| " + " | ".join(wanted) + " |")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    readme = README.read_text(encoding="utf-8")
    speed = (HERE / "speed.md").read_text(encoding="utf-8")
    shown = tables(readme.partition("Ten correct digits")[2])[0]
    measured = tables(speed.partition("**section4, 10 digits**")[2])[0]
    README.write_text(readme.replace(shown, renewed(shown, measured)), encoding="utf-8")
