"""One pass that numbers the document and finds who mentions what.

Both writers use it, so that a label has the same number on the page and in LaTeX.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Literal, assert_never

from wear.report.document import (
    Claim,
    Claims,
    Document,
    Equation,
    Figure,
    Labelled,
    Reference,
    Section,
    Steps,
    Table,
    Work,
    is_label,
)
from wear.report.walk import all_prose, labelled, prose

Kind = Literal["section", "equation", "figure", "table", "claim", "derivation", "work"]

#: Number of an equation that the note does not have.
OWN_EQUATION = "D.{}"


@dataclass(frozen=True)
class Mark:
    """What stands for a label in the text."""

    kind: Kind
    number: str

    @property
    def bare(self) -> str:
        """The number alone, as it stands in a list of references."""
        match self.kind:
            case "equation":
                return f"({self.number})"
            case "work":
                return f"[{self.number}]"
        return self.number

    @property
    def name(self) -> str:
        """The words of a reference, with no-break spaces.

        >>> Mark("equation", "8").name.replace(chr(0xa0), " ")
        'Eq. (8)'
        """
        match self.kind:
            case "section":
                return f"Section\u00a0{self.number}"
            case "equation":
                return f"Eq.\u00a0({self.number})"
            case "figure":
                return f"Figure\u00a0{self.number}"
            case "table":
                return f"Table\u00a0{self.number}"
            case "claim":
                return f"claim\u00a0{self.number}"
            case "derivation":
                return f"derivation of\u00a0({self.number})"
            case "work":
                return self.bare
        assert_never(self.kind)


def number(document: Document) -> dict[str, Mark]:
    """The mark of every label.

    Raises `ValueError` with all faults at once: labels used twice or malformed, numbers of
    equations used twice, references to labels that are not there.
    """
    marks: dict[str, Mark] = {}
    for section, numeral in _sections(document.sections, ""):
        marks[section.label] = Mark("section", numeral)
    counts: Counter[str] = Counter()
    for node in labelled(document):
        match node:
            case Equation(number=given):
                marks[node.label] = Mark("equation", given or _own(counts))
            case Figure():
                marks[node.label] = Mark("figure", _next(counts, "figure"))
            case Table() | Claims():
                marks[node.label] = Mark("table", _next(counts, "table"))
            case Claim(id=identity):
                marks[node.label] = Mark("claim", identity)
            case Work():
                marks[node.label] = Mark("work", _next(counts, "work"))
            case Section() | Steps():
                pass
            case _:
                assert_never(node)
    for node in labelled(document):
        if isinstance(node, Steps) and node.of in marks:
            marks[node.label] = Mark("derivation", marks[node.of].number)
    if faults := list(_faults(document, marks)):
        raise ValueError("the document does not hold together:\n  " + "\n  ".join(faults))
    return marks


def mentions(node: Labelled) -> tuple[str, ...]:
    """The labels that a node's prose refers to, each once, in reading order."""
    if isinstance(node, Section):
        return ()
    found = [] if not isinstance(node, Steps) else [node.of]
    for text in prose(node):
        found += [piece.label for piece in text if isinstance(piece, Reference)]
    return tuple(dict.fromkeys(found))


def mentioned_by(document: Document) -> dict[str, tuple[str, ...]]:
    """For every equation, claim and derivation, what refers to it: of an equation its own
    derivation, claims, figures and tables.

    Derivations of other equations that use it are left out: they would be most of the page.
    """
    found: dict[str, list[str]] = {}
    nodes = tuple(labelled(document))
    told = {node.label for node in nodes if isinstance(node, Equation | Claim | Steps)}
    for node in nodes:
        if isinstance(node, Claims):
            continue  # its claims speak for themselves
        for label in told.intersection(mentions(node)):
            if not isinstance(node, Steps) or node.of == label:
                found.setdefault(label, []).append(node.label)
    return {label: tuple(sources) for label, sources in found.items()}


def _sections(sections: tuple[Section, ...], prefix: str) -> Iterator[tuple[Section, str]]:
    for position, section in enumerate(sections, start=1):
        numeral = f"{prefix}{position}"
        yield section, numeral
        inner = tuple(block for block in section.blocks if isinstance(block, Section))
        yield from _sections(inner, f"{numeral}.")


def _next(counts: Counter[str], kind: str) -> str:
    counts[kind] += 1
    return str(counts[kind])


def _own(counts: Counter[str]) -> str:
    return OWN_EQUATION.format(_next(counts, "equation"))


def _faults(document: Document, marks: Mapping[str, Mark]) -> Iterator[str]:
    labels = Counter(node.label for node in labelled(document))
    for label, times in labels.items():
        if times > 1:
            yield f"label {label!r} is used {times} times"
        if not is_label(label):
            yield f"label {label!r}: use letters, digits, ':', '.' and '-', and a letter first"
    for label, mark in marks.items():
        if mark.kind == "section" and mark.number.count(".") > 2:
            yield f"section {label!r} is nested deeper than three levels"
    files = Counter(node.file for node in labelled(document) if isinstance(node, Figure))
    yield from (f"two figures are written as {f!r}" for f, times in files.items() if times > 1)
    equations = Counter(mark.number for mark in marks.values() if mark.kind == "equation")
    yield from (f"two equations are numbered ({n})" for n, times in equations.items() if times > 1)
    for node in labelled(document):
        if isinstance(node, Steps) and node.of not in labels:
            yield f"derivation {node.label!r} is of {node.of!r}, which is not in the document"
    for text in all_prose(document):
        for piece in text:
            if isinstance(piece, Reference) and piece.label not in labels:
                yield f"reference to {piece.label!r}, which is not in the document"
