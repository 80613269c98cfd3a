r"""Plain text of the derivation as prose: formulas typeset, numbers as numbers.

Titles, remarks and evidence are written as one types them into a terminal: ``h/sigma -> 1/f_c``,
``4.6e-8 mm``, ``(16)``. On a page they read better typeset, and each number says where it comes
from.
"""

from __future__ import annotations

import re
from collections.abc import Container, Iterator

from derive.typeset.reading import Part, read
from wear.report.document import Code, Given, Inline, Math, Number, Prose, Reference, Text

_MARK = re.compile(
    r"``(?P<code>[^`]+)``"
    r"|(?:Eqs?\. |(?<![\w)]))\((?P<equation>\d+[a-g]?|[a-z]{3,}(?:-[a-z]+)*)\)"
    r"|\b(?P<claim>C\d+)\b"
)
#: The line that is meant where the number of a system is given.
_MEANT = {"16": "16b", "17": "17b"}


def plain(text: str, source: str, labels: Container[str] = ()) -> Prose:
    """The text as prose; `source` says where its numbers come from.

    An equation's number or id in brackets and a claim's id become links if their labels are among
    `labels`.

    >>> plain("u_cum is 2.5e-5 mm", "the note")[1:]
    (Text(text=' is '), Number(value=2.5e-05, digits=2, unit='', source='the note'), \
Text(text=' mm'))
    """
    nodes: list[Inline] = []
    end = 0
    for mark in _MARK.finditer(text):
        nodes += _between(text[end : mark.start()], source)
        nodes.append(_marked(mark, source, labels))
        end = mark.end()
    return (*nodes, *_between(text[end:], source))


def _marked(mark: re.Match[str], source: str, labels: Container[str]) -> Inline:
    """Code, a link, or what stands in brackets as it is."""
    if mark["code"]:
        return Code(mark["code"])
    if mark["claim"]:
        label = f"claim:{mark['claim']}"
        return Reference(label) if label in labels else _words(mark[0], source)
    named = mark["equation"]
    for label in (f"eq:{_MEANT.get(named, named)}", f"eq:{named}a"):
        if label in labels:
            return Reference(label)
    return _words(mark[0], source)


def _between(text: str, source: str) -> Iterator[Inline]:
    for part in read(text):
        yield _node(part, source)


def _node(part: Part, source: str) -> Inline:
    match part.kind:
        case "formula":
            return Math(part.text)
        case "number":
            return number(part.text, source)
        case "identifier":
            return Code(part.text)
        case "words":
            return _words(part.text, source)


def _words(text: str, source: str) -> Inline:
    """What is only words; digits that belong to a name (``1e(20)``) stay with them."""
    return Given(text, source) if any(map(str.isdigit, text)) else Text(text)


def number(digits: str, source: str) -> Number:
    """A number as it is written, with as many significant digits.

    >>> number("1.50e-3", "run").digits
    3
    """
    mantissa = digits.lower().partition("e")[0].lstrip("+-")
    if digits.lstrip("+-").isdigit():
        return Number(int(digits), len(mantissa), source=source)
    significant = len(mantissa.replace(".", "").lstrip("0")) or 1
    return Number(float(digits), significant, source=source)
