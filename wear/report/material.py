"""What the sections of the paper are made from: equations, runs, ledger, and how they are cited."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from wear.report.document import Block, Figure, Number, Paragraph

#: The relative resolution of a double, below which an error is none.
ROUNDOFF = sys.float_info.epsilon

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Drawn

    from derive.equations import Equation
    from wear.benchmark import Measurement
    from wear.report.claims import Entry
    from wear.report.runs import Runs
    from wear.report.verification import Verification


@dataclass(frozen=True)
class Material:
    """All that was computed for the report."""

    equations: Sequence[Equation]
    verification: Verification
    runs: Runs
    ledger: Sequence[Entry]
    speed: Sequence[Measurement]
    shown: Mapping[str, tuple[Block, ...]]

    def show(self, *identifiers: str) -> tuple[Block, ...]:
        """The equations of these ids with their derivations."""
        return tuple(block for identifier in identifiers for block in self.shown[identifier])

    def value(self, identifier: str, **data: float) -> float:
        """The right-hand side of an equation for numbers, by the names of its symbols."""
        formula = next(one for one in self.equations if one.id == identifier).relation.rhs
        return float(formula.subs({symbol: data[symbol.name] for symbol in formula.free_symbols}))

    def verdicts(self, verdict: str) -> int:
        """How many claims have a verdict."""
        return sum(str(entry.finding.verdict) == verdict for entry in self.ledger)


def drawn(label: str, figure: Drawn, caption: Paragraph, description: str, file: str) -> Figure:
    """A figure of the paper from a matplotlib figure."""
    from wear.figure_style import pdf, svg

    return Figure(label, caption.content, description, svg(figure), pdf(figure), file)


def mm(value: float, digits: int, source: str) -> Number:
    """A length in mm."""
    return Number(float(value), digits, "mm", source=source)


def count(value: float, source: str) -> Number:
    """A number of things or cycles, in full."""
    return Number(int(value), 12, source=source)
