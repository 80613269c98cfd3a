"""A parsed report: its text with the equations and figures that it shows, all numbered.

Both writers take the numbers from here, so that a label has the same number on the page and in
LaTeX.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

from markdown_it.token import Token

from wear.cite import REFERENCES
from wear.report.text import Tokens, inline

if TYPE_CHECKING:
    from matplotlib.figure import Figure

OWN_EQUATION = "D.{}"
"""Number of an equation that the note does not have."""
_NOTE = re.compile(r"\d+[a-g]?")
_KINDS = {
    "eq": "equation", "sec": "section", "app": "appendix", "fig": "figure", "tab": "table",
    "claim": "claim", "der": "derivation", "ref": "work",
}  # fmt: skip
_NAMES = {
    "equation": "Eq.\u00a0({})", "section": "Section\u00a0{}", "appendix": "Appendix\u00a0{}",
    "figure": "Figure\u00a0{}", "table": "Table\u00a0{}", "claim": "claim\u00a0{}",
    "derivation": "derivation of\u00a0({})", "work": "[{}]",
}  # fmt: skip


@dataclass(frozen=True)
class DisplayedEquation:
    """A displayed formula with its title and hypotheses in Markdown.

    `status` is one of the statuses of `derive`, `printed` the form in the note where that is not
    the derived one, `macro` the name of its macro in ``equations.tex``; `also` are the ids of
    identical equations, `where` are the definitions of its symbols, a line of formulas each.
    """

    id: str
    latex: str
    title: str = ""
    status: str = ""
    printed: str = ""
    macro: str = ""
    also: tuple[str, ...] = ()
    where: tuple[str, ...] = ()


class FigureFiles(NamedTuple):
    """A drawing for pages and for LaTeX."""

    svg: str
    pdf: bytes


def drawn(drawings: Mapping[str, Figure]) -> Mapping[str, FigureFiles]:
    """Return figures by label; the names are those of the files, too."""
    from wear.figure_style import encoded  # a text without figures needs no matplotlib

    return {
        f"fig:{name}": FigureFiles(encoded(each, ".svg").decode(), encoded(each, ".pdf"))
        for name, each in drawings.items()
    }


@dataclass(frozen=True)
class Mark:
    """The kind and number of a label in the text, and the label that its link leads to."""

    kind: str
    number: str
    target: str

    @property
    def bare(self) -> str:
        """Return the number alone, for a list of references."""
        if self.kind == "equation":
            return f"({self.number})"
        return self.name if self.kind == "work" else self.number

    @property
    def name(self) -> str:
        """Return the words of a reference, with no-break spaces.

        >>> Mark("equation", "8", "eq:8").name.replace(chr(0xa0), " ")
        'Eq. (8)'
        """
        return _NAMES[self.kind].format(self.number)


@dataclass(frozen=True)
class Document:
    """A text, as tokens, with all equations (by id) and figures (by label) that it may show."""

    tokens: Tokens
    equations: Mapping[str, DisplayedEquation]
    figures: Mapping[str, FigureFiles]

    @property
    def title(self) -> str:
        """Return the heading of the first level."""
        return next(b.content for a, b in pairwise(self.tokens) if a.tag == "h1")

    @property
    def contents(self) -> Iterator[tuple[Mark, list[Token], int]]:
        """Yield the mark, title and level of every section except derivations."""
        for heading, title in pairwise(self.tokens):
            mark = self.marks.get(heading.meta.get("label", ""))
            if heading.type == "heading_open" and mark and mark.kind != "derivation":
                yield mark, title.children or [], int(heading.tag[1])

    @property
    def shown(self) -> Iterator[DisplayedEquation]:
        """Yield the equations that the text shows, in reading order."""
        for token in self.tokens:
            if token.type == "fence" and token.info == "equations":
                yield from (self.equations[identifier] for identifier in token.content.split())

    @cached_property
    def marks(self) -> Mapping[str, Mark]:
        """Return the mark of every label.

        Raises
        ------
        ValueError
            with all faults at once: labels used twice, equations shown twice, references to
            unknown labels.
        """
        given = list(self._marks())
        marks = {mark.target: mark for mark in given}
        for mark in given:
            if mark.kind == "derivation":
                derived = marks[f"eq:{mark.number}"]
                marks[mark.target] = Mark(mark.kind, derived.number, mark.target)
        for equation in self.shown:
            for other in equation.also:
                label = f"eq:{other}"
                marks[label] = Mark("equation", _own(other, marks, equation), f"eq:{equation.id}")
        twice = [label for label, n in Counter(mark.target for mark in given).items() if n > 1]
        faults = [f"{label!r} is used more than once" for label in twice]
        faults += [
            f"no {label!r} to refer to" for label in self._references() if label not in marks
        ]
        if faults:
            raise ValueError("the references of the document fail:\n  " + "\n  ".join(faults))
        return marks

    @cached_property
    def works(self) -> tuple[str, ...]:
        """Return the keys of the works in the order in which the text cites them."""
        cited = (label for label in self._references() if label.startswith("ref:"))
        return tuple(dict.fromkeys(label.removeprefix("ref:") for label in cited))

    @cached_property
    def mentions(self) -> Mapping[str, tuple[str, ...]]:
        """Return for every equation its derivation and the claims that refer to it."""
        sources: dict[str, dict[str, None]] = {}
        for where, label in self._places():
            if where and label.startswith("eq:") and label in self.marks:
                sources.setdefault(self.marks[label].target, {})[where] = None
        return {label: tuple(labels) for label, labels in sources.items()}

    def _references(self) -> Iterator[str]:
        for token in inline(self.tokens):
            if token.type == "reference":
                yield token.content

    def _places(self) -> Iterator[tuple[str, str]]:
        """Yield the derivation or claim around each reference, and the label of the reference."""
        where = ""
        for token in self.tokens:
            if token.type in ("heading_open", "tr_close", "table_close"):
                where = str(token.meta.get("label", ""))
                where = where if where.startswith("der:") else ""
                if where:
                    yield where, f"eq:{where[4:]}"
            for piece in token.children or ():
                if piece.type == "target" and piece.content.startswith("claim:"):
                    where = piece.content
                if piece.type == "reference" and where.startswith("claim:"):
                    yield where, piece.content

    def _marks(self) -> Iterator[Mark]:
        counts: Counter[str] = Counter()
        for token in self.tokens:
            if token.type == "heading_open" and "label" in token.meta:
                yield _heading(token, counts)
            elif token.type == "caption_open" and "label" in token.meta:
                yield _next("table", token.meta["label"], counts)
            elif token.type == "fence" and token.info == "equations":
                for identifier in token.content.split():
                    number = identifier if _NOTE.fullmatch(identifier) else ""
                    yield _next("equation", f"eq:{identifier}", counts, number)
            for piece in token.children or ():
                if piece.type == "image":
                    yield _next("figure", str(piece.attrs["src"]), counts)
                elif piece.type == "target":
                    kind, _, number = piece.content.partition(":")
                    yield Mark(_KINDS[kind], number, piece.content)
        for place, key in enumerate(self.works, start=1):
            if key in REFERENCES:
                yield Mark("work", str(place), f"ref:{key}")


def _own(identifier: str, marks: Mapping[str, Mark], same: DisplayedEquation) -> str:
    """Return the number of an equation that is identical to one that is shown."""
    return identifier if _NOTE.fullmatch(identifier) else marks[f"eq:{same.id}"].number


def _next(kind: str, label: str, counts: Counter[str], number: str = "") -> Mark:
    if not number:
        counts[kind] += 1
        number = str(counts[kind])
        number = OWN_EQUATION.format(number) if kind == "equation" else number
    return Mark(kind, number, label)


def _heading(token: Token, counts: Counter[str]) -> Mark:
    """Return the mark of a heading: 1, 1.1, A, A.1, or that of the equation derived below it."""
    label = str(token.meta["label"])
    kind = _KINDS[label.partition(":")[0]]
    if kind == "derivation":
        return Mark(kind, label[4:], label)
    if token.tag == "h2":
        counts[kind] += 1
        counts["part"] = 0
    else:
        counts["part"] += 1
    numeral = str(counts[kind]) if kind == "section" else chr(ord("A") + counts[kind] - 1)
    return Mark(kind, numeral + f".{counts['part']}" * (token.tag != "h2"), label)
