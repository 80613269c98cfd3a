"""The document tree: what the report says, apart from how it is written.

Overview
    A document is a tree of frozen nodes. Inline nodes make up prose, blocks make up sections.
    `wear.report.numbering` gives every label its number, `wear.report.audit` finds numbers that
    nobody computed, and the writers `wear.report.html` and `wear.report.tex` turn the same tree
    into a page and into LaTeX.
Rules
    A label is unique in the document, made of letters, digits and ``: . -``, and starts with a
    letter: ``eq:21``, ``fig:wear``, ``claim:C24``, ``ref:archard1953``.
    A number in running text is a `Number` with the name of the computation that it came from.
    Digits that are no result (a version, a year, a unit) are a `Given` with the reason.
    LaTeX of formulas keeps to the subset described in `wear.report.display`.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field
from numbers import Integral
from typing import TypeAlias

_LABEL = re.compile(r"[A-Za-z][A-Za-z0-9:.\-]*")


@dataclass(frozen=True)
class Text:
    """Plain words."""

    text: str


@dataclass(frozen=True)
class Emphasis:
    """Words that carry stress."""

    text: str


@dataclass(frozen=True)
class Code:
    """A name or command, set in a fixed pitch."""

    text: str


@dataclass(frozen=True)
class Math:
    """A formula inside a line of text."""

    latex: str


@dataclass(frozen=True)
class Reference:
    """A link to a label, shown by its kind and number: Eq. (8), Figure 2, claim C24, [3]; `bare` by
    the number alone, for the second and later of a list."""

    label: str
    bare: bool = False


@dataclass(frozen=True)
class Link:
    """A link to somewhere outside the document."""

    text: str
    url: str


@dataclass(frozen=True)
class Given:
    """Words with digits that are no result of the run; `reason` says what they are."""

    text: str
    reason: str


@dataclass(frozen=True)
class Number:
    """A number that the run computed.

    `digits` counts significant digits, `unit` is plain text such as ``mm`` or ``MPa/mm``, and
    `source` names the computation. Integers below a million are shown in full.

    >>> Number(4.63554742752e-8, 4, "mm", source="equation 21").decimal
    ('4.636', -8)
    >>> Number(9000, 4, source="scene").decimal
    ('9000', None)
    """

    value: float
    digits: int
    unit: str = ""
    source: str = field(kw_only=True)

    def __post_init__(self) -> None:
        if not math.isfinite(self.value):
            raise ValueError(
                f"a number in the text must be finite, got {self.value} ({self.source})"
            )
        if self.digits < 1:
            raise ValueError(f"a number needs at least one digit, got {self.digits}")
        if not self.source:
            raise ValueError(f"the number {self.value} does not say where it comes from")

    @property
    def decimal(self) -> tuple[str, int | None]:
        """Digits, with a sign if negative, and the power of ten if there is one."""
        if isinstance(self.value, Integral) and abs(self.value) < 10**6:
            return str(int(self.value)), None
        if self.value == 0.0:
            return "0", None
        mantissa, _, power = f"{self.value:.{self.digits - 1}e}".partition("e")
        exponent = int(power)
        if -4 < exponent < 6:
            return f"{self.value:.{max(self.digits - 1 - exponent, 0)}f}", None
        return mantissa, exponent


def grouped(digits: str, separator: str) -> str:
    """Integers of more than four digits in groups of three.

    >>> grouped("123456", " "), grouped("9000", " "), grouped("1.23456", " ")
    ('123 456', '9000', '1.23456')
    """
    is_long = "." not in digits and len(digits.lstrip("-")) > 4
    return f"{int(digits):,}".replace(",", separator) if is_long else digits


Inline: TypeAlias = Text | Emphasis | Code | Math | Reference | Link | Given | Number
Prose: TypeAlias = tuple[Inline, ...]


@dataclass(frozen=True)
class Paragraph:
    """Sentences."""

    content: Prose


@dataclass(frozen=True)
class Items:
    """A list, with numbers before the entries if their order matters."""

    entries: tuple[Prose, ...]
    ordered: bool = False


@dataclass(frozen=True)
class Equation:
    """A displayed formula.

    `number` is shown in parentheses; leave it empty for a result of the project's own, which is
    then numbered D.1, D.2, ... `status` is one of the statuses of `derive`, `printed` the form in
    the note where that is not the derived one, `macro` the name (letters only) of its macro in
    ``equations.tex``.
    """

    label: str
    latex: str
    number: str = ""
    title: Prose = ()
    status: str = ""
    printed: str = ""
    macro: str = ""


@dataclass(frozen=True)
class Figure:
    """A drawing as SVG and PDF. `description` tells it to those who do not see it, `file` is the
    stem of its file names."""

    label: str
    caption: Prose
    description: str
    svg: str
    pdf: bytes = field(repr=False)
    file: str


@dataclass(frozen=True)
class Column:
    """A column of a table: its heading, whether it holds numbers (set to the right), and its share
    of the text width where its cells are sentences that need several lines."""

    heading: Prose
    numeric: bool = False
    width: float = 0.0


@dataclass(frozen=True)
class Table:
    """Rows of cells; the first cell of a row is its heading. `long` tables may span pages."""

    label: str
    caption: Prose
    columns: tuple[Column, ...]
    rows: tuple[tuple[Prose, ...], ...]
    long: bool = False

    def __post_init__(self) -> None:
        wrong = [i for i, row in enumerate(self.rows) if len(row) != len(self.columns)]
        if wrong:
            raise ValueError(
                f"table {self.label}: {len(self.columns)} columns, but rows {wrong} have "
                f"{[len(self.rows[i]) for i in wrong]} cells"
            )


@dataclass(frozen=True)
class Claim:
    """A claim of the note with its verdict and the evidence for it."""

    id: str
    where: Prose
    statement: Prose
    verdict: str
    evidence: Prose

    @property
    def label(self) -> str:
        return f"claim:{self.id}"


@dataclass(frozen=True)
class Claims:
    """The ledger, or a part of it."""

    label: str
    caption: Prose
    claims: tuple[Claim, ...]


@dataclass(frozen=True)
class Step:
    """One move of a derivation: what is done, what comes out, and how that was checked."""

    text: Prose
    latex: str = ""
    check: Prose = ()


@dataclass(frozen=True)
class Steps:
    """The derivation of the equation `of`, folded until a reader asks for it."""

    label: str
    of: str
    steps: tuple[Step, ...]


@dataclass(frozen=True)
class Work:
    """A work that the text cites: author, title, where and when it appeared."""

    label: str
    entry: Prose


@dataclass(frozen=True)
class Bibliography:
    """The works that the text cites; each is numbered by its place."""

    works: tuple[Work, ...]


@dataclass(frozen=True)
class Listing:
    """Commands or code, verbatim. `description` is its accessible name."""

    code: str
    description: str


@dataclass(frozen=True)
class Section:
    """A heading and what stands under it; sections nest at most three deep."""

    label: str
    title: str
    blocks: tuple[Block, ...]


Block: TypeAlias = (
    Paragraph
    | Items
    | Equation
    | Figure
    | Table
    | Claims
    | Steps
    | Bibliography
    | Listing
    | Section
)
Labelled: TypeAlias = Equation | Figure | Table | Claims | Claim | Steps | Work | Section


@dataclass(frozen=True)
class Document:
    """A report. `subtitle` and `abstract` stand before the first section."""

    title: str
    subtitle: Prose
    abstract: Prose
    sections: tuple[Section, ...]
    colophon: Prose = ()


def is_label(text: str) -> bool:
    """Whether both writers can use it as a target of links."""
    return _LABEL.fullmatch(text) is not None
