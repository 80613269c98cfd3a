"""How far a cycle jump may go: its error against its length, measured and predicted.

    python docs/bench/how_far.py

writes how-far.md and how-far.svg beside this file.  No clock is read: every run gives the same.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
from jumps import Cycles, cycles_of, extrapolated

from wear.benchmark.methods import Case, cases
from wear.benchmark.results import TextTable, markdown_table
from wear.quantities import in_short

HERE = Path(__file__).resolve().parent
SCENE, CYCLES = "section4", (9000, 10**6)
LENGTHS = (3, 10, 30, 100, 300, 1000)  # cycles
SHARES = (0.3, 0.1, 0.03, 0.01)  # of the roughness
MOST_JUMPS = 3000


class Row(NamedTuple):
    """A way to jump: how many cycles it integrates, its relative error and that of the rule."""

    kind: str
    length: float
    cycles: int
    integrated: int
    error: float
    predicted: float


def fixed(cycles: Cycles, case: Case, length: int) -> Row:
    """Return the row of jumps over so many cycles.

    They count (L - 1)/2 ln(D_0/D) cycles too many: L (L - 1) |D'|/2 a jump.
    """
    first, last = cycles.wear(0.0), cycles.wear(case.wear)
    late = (length - 1) / 2 * math.log(first / last)
    return _row("fixed", length, cycles, case, lambda *_: length, late * last / case.wear)


def adaptive(cycles: Cycles, case: Case, share: float) -> Row:
    """Return the row of jumps that wear off this share of the roughness.

    They count s/2 times the integral of sigma d(1/D) cycles too many; sigma is linear in the wear.
    """
    first, last = cycles.wear(0.0), cycles.wear(case.wear)
    fresh, worn = cycles.roughness(0.0), cycles.roughness(case.wear)
    grown = (worn - fresh) * case.cycles * last / case.wear
    predicted = share / 2 * (worn - fresh * last / first - grown) / case.wear

    def length(u: float, wear: float) -> float:
        return share * cycles.roughness(u) / wear

    return _row("adaptive", share, cycles, case, length, predicted)


def _row(
    kind: str,
    reach: float,
    cycles: Cycles,
    case: Case,
    length: Callable[[float, float], float],
    predicted: float,
) -> Row:
    wear, jumps = extrapolated(cycles, case.cycles, length)
    return Row(kind, reach, case.cycles, jumps, wear / case.wear - 1, predicted)


def measured() -> Iterator[Row]:
    """Return a row for each way to jump and number of cycles."""
    for case in cases("speed", [SCENE], CYCLES):
        cycles = cycles_of(case.scene)
        for length in LENGTHS:
            if case.cycles / length <= MOST_JUMPS:
                yield fixed(cycles, case, length)
        for share in SHARES:
            yield adaptive(cycles, case, share)


def table(rows: list[Row]) -> TextTable:
    """Return the rows as a table."""
    header = ("cycles", "jump", "integrated", "error", "by the rule")
    return TextTable(
        "How far",
        header,
        tuple(
            (in_short(row.cycles, 5), _jump(row), str(row.integrated), *map(_percent, row[4:]))
            for row in rows
        ),
    )


def _jump(row: Row) -> str:
    return f"{row.length} cycles" if row.kind == "fixed" else f"{row.length:g} of the roughness"


def _percent(error: float) -> str:
    return f"{100 * error:.2g} %" if abs(error) < 1 else f"{error + 1:.2g}-fold"


def figure(rows: list[Row]) -> bytes:
    """Draw the error against the number of cycles integrated, for both ways to jump."""
    from wear.figure_style import COLUMN_AND_HALF, canvas, encoded, stroke, styled

    with styled():
        drawn, axes = canvas(COLUMN_AND_HALF, 0.6 * COLUMN_AND_HALF)
        for family, (kind, number) in enumerate(dict.fromkeys((r.kind, r.cycles) for r in rows)):
            own = [row for row in rows if (row.kind, row.cycles) == (kind, number)]
            look = stroke(family, 0)
            x = np.array([row.integrated for row in own])
            dots = look | {"linestyle": "", "label": f"{kind}, {in_short(number, 5)} cycles"}
            axes.loglog(x, [row.error for row in own], **dots)
            lines = look | {"marker": "", "linewidth": 0.8}
            axes.loglog(x, [row.predicted for row in own], **lines)
        axes.set(xlabel="Cycles integrated", ylabel="Relative error of the wear")
        axes.legend()
    return encoded(drawn, ".svg")


if __name__ == "__main__":
    found = list(measured())
    (HERE / "how-far.md").write_text(markdown_table(table(found)) + "\n", encoding="utf-8")
    (HERE / "how-far.svg").write_bytes(figure(found))
