r"""Plain text of the derivation as prose: names of quantities as formulas, numbers as numbers.

Titles, remarks and evidence are written as one types them into a terminal: ``h/sigma -> 1/f_c``,
``4.6e-8 mm``, ``(16)``. On a page they read better typeset, and each number says where it comes
from.
"""

from __future__ import annotations

import re
from collections.abc import Container

from derive.symbols import QUANTITIES
from wear.report.document import Code, Given, Inline, Math, Number, Prose, Reference, Text

#: Names of quantities that are words, articles or units first.
_WORDS = {"A", "m", "d", "g", "b"}
_MARK = re.compile(
    r"``(?P<code>[^`]+)``"
    r"|(?:Eqs?\. )?\((?P<equation>\d+[a-g]?|[a-z]+(?:-[a-z]+)+)\)"
    r"|\bd ?(?P<above>[A-Za-z]+(?:_[A-Za-z0-9]+)?)/d ?(?P<below>[A-Za-z]+(?:_[A-Za-z0-9]+)?)\b"
    r"|\b(?P<name>[A-Za-z]+(?:_[A-Za-z0-9]+)?)\b(?P<start>\(0\))?(?:\^(?P<power>\d))?"
    r"|(?<![\w.\-])(?P<number>[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?)(?![\w]|\.\d)"
    r"|(?P<sign>->|<=|>=|!=|(?<=\w)\*(?=\w))"
)
_WITH_DIGITS = re.compile(r"\b[A-Za-z]+(?:[_-]?[A-Za-z]+)*[_-]?\d[\w\-]*")
#: The line that is meant where the number of a system is given.
_MEANT = {"16": "16b", "17": "17b"}
_SIGNS = {"->": r"\to", "<=": r"\le", ">=": r"\ge", "!=": r"\ne", "*": r"\,"}
_FUNCTIONS = {
    "tanh": r"\tanh", "phi": r"\phi", "ln": r"\ln", "sin": r"\sin", "cos": r"\cos", "pi": r"\pi",
    "oo": r"\infty", "K": "K",
    "f_ij": "f_{ij}", "f_i": "f_i", "a_n": "a_n", "c_n": "c_n", "w_n": "w_n",
}  # fmt: skip


def plain(text: str, source: str, labels: Container[str] = ()) -> Prose:
    """The text as prose; `source` says where its numbers come from.

    An equation's number or id in brackets becomes a link if its label is among `labels`.

    >>> plain("u_cum is 2.5e-5 mm", "the note")[1:]
    (Text(text=' is '), Number(value=2.5e-05, digits=2, unit='', source='the note'), \
Text(text=' mm'))
    """
    nodes: list[Inline] = []
    end = place = 0
    while place < len(text):
        found = _WITH_DIGITS.match(text, place)
        mark = _MARK.match(text, place)
        node: Inline | None = None
        if mark is not None:
            node = _node(mark, source, labels)
            place = mark.end()
        if node is None and found is not None and found[0] not in QUANTITIES:
            node, mark, place = Code(found[0]), found, found.end()
        if mark is None:
            place += 1
        elif node is not None:
            nodes += _words(text[end : mark.start()], source)
            nodes.append(node)
            end = place
    return (*nodes, *_words(text[end:], source))


def _words(text: str, source: str) -> list[Inline]:
    """What is only words; digits that belong to a name (``1e(20)``) stay with them."""
    if not text:
        return []
    return [Given(text, source) if any(map(str.isdigit, text)) else Text(text)]


def _node(mark: re.Match[str], source: str, labels: Container[str]) -> Inline | None:
    """What stands for a mark; None for a word that is only a word."""
    if mark["code"]:
        return Code(mark["code"])
    if mark["equation"]:
        return _reference(mark["equation"], labels)
    if mark["above"]:
        above, below = (_symbol(mark[part]) for part in ("above", "below"))
        known = above is not None and below is not None
        return Math(rf"\mathrm{{d}}{above}/\mathrm{{d}}{below}") if known else None
    if mark["name"]:
        symbol = None if mark["name"] in _WORDS else _symbol(mark["name"])
        power = f"^{{{mark['power']}}}" if mark["power"] else ""
        return None if symbol is None else Math(symbol + (mark["start"] or "") + power)
    if mark["number"]:
        return number(mark["number"], source)
    return Math(_SIGNS[mark["sign"]])


def _reference(identifier: str, labels: Container[str]) -> Inline | None:
    for label in (f"eq:{_MEANT.get(identifier, identifier)}", f"eq:{identifier}a"):
        if label in labels:
            return Reference(label)
    return None


def _symbol(name: str) -> str | None:
    if name in _FUNCTIONS:
        return _FUNCTIONS[name]
    return QUANTITIES[name].latex if name in QUANTITIES else None


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
