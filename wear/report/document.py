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
_NAMES = {
    "eq": "Eq.\u00a0({})", "sec": "Section\u00a0{}", "app": "Appendix\u00a0{}",
    "fig": "Figure\u00a0{}", "tab": "Table\u00a0{}", "claim": "claim\u00a0{}",
    "der": "derivation of\u00a0({})", "ref": "[{}]",
}  # fmt: skip
"""The words of a reference, by the kind of its label."""


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


class Mark(NamedTuple):
    """The number of a label in the text, and the label that its link leads to."""

    number: str
    target: str

    @property
    def kind(self) -> str:
        """Return the kind of the label: eq, sec, app, fig, tab, claim, der or ref."""
        return self.target.partition(":")[0]

    @property
    def bare(self) -> str:
        """Return the number alone, for a list of references."""
        return {"eq": f"({self.number})", "ref": self.name}.get(self.kind, self.number)

    @property
    def name(self) -> str:
        """Return the words of a reference, with no-break spaces.

        >>> Mark("8", "eq:8").name.replace(chr(0xa0), " ")
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
            if heading.type == "heading_open" and mark and mark.kind != "der":
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
        given = list(self._numbered())
        marks = {label: Mark(number, label) for label, number in given}
        for equation in self.shown:
            shown = f"eq:{equation.id}"
            for other in equation.also:
                number = other if _NOTE.fullmatch(other) else marks[shown].number
                marks[f"eq:{other}"] = Mark(number, shown)
        for label, identifier in given:
            if label.startswith("der:"):
                marks[label] = Mark(marks[f"eq:{identifier}"].number, label)
        twice = [label for label, n in Counter(label for label, _ in given).items() if n > 1]
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

        def mention(label: str, where: str) -> None:
            if label.startswith("eq:") and label in self.marks:
                sources.setdefault(self.marks[label].target, {})[where] = None

        claim = ""
        for token in self.tokens:
            label = str(token.meta.get("label", ""))
            if token.type == "heading_open" and label.startswith("der:"):
                mention(f"eq:{label[4:]}", label)
            if token.type in ("heading_open", "tr_close", "table_close"):
                claim = ""
            for piece in token.children or ():
                if piece.type == "target" and piece.content.startswith("claim:"):
                    claim = piece.content
                if piece.type == "reference" and claim:
                    mention(piece.content, claim)
        return {label: tuple(labels) for label, labels in sources.items()}

    def _references(self) -> Iterator[str]:
        for token in inline(self.tokens):
            if token.type == "reference":
                yield token.content

    def _numbered(self) -> Iterator[tuple[str, str]]:
        """Yield every label with its number; for a derivation, the id of its equation."""
        counts: Counter[str] = Counter()

        def following(kind: str) -> str:
            counts[kind] += 1
            return str(counts[kind])

        for token in self.tokens:
            label = str(token.meta.get("label", ""))
            kind, _, identifier = label.partition(":")
            if token.type == "heading_open" and kind == "der":
                yield label, identifier
            elif token.type == "heading_open" and label:
                is_part = token.tag != "h2"
                counts[kind] += not is_part
                counts["part"] = counts["part"] + 1 if is_part else 0
                whole = str(counts[kind]) if kind == "sec" else chr(ord("A") + counts[kind] - 1)
                yield label, whole + f".{counts['part']}" * is_part
            elif token.type == "caption_open" and label:
                yield label, following("tab")
            elif token.type == "fence" and token.info == "equations":
                for name in token.content.split():
                    own = "" if _NOTE.fullmatch(name) else OWN_EQUATION.format(following("eq"))
                    yield f"eq:{name}", own or name
            for piece in token.children or ():
                if piece.type == "image":
                    yield str(piece.attrs["src"]), following("fig")
                elif piece.type == "target":
                    yield piece.content, piece.content.partition(":")[2]
        for place, key in enumerate(self.works, start=1):
            if key in REFERENCES:
                yield f"ref:{key}", str(place)
