r"""Formulas in plain text, typeset in LaTeX.

Overview
    Titles, remarks and evidence are written as ``h/sigma -> 1/f_c`` or ``4.6e-8 mm``.  One regular
    expression defines formulas: sides with relations between them, sums of products of names,
    small numbers and brackets.  A formula must contain a name of the model, a relation or a power;
    a single letter that may be a word is a word.  A number with a point, an exponent or three
    digits is a result, and not part of a formula.
Key results
    read       the fragments of a text
    in_latex   a text with its formulas in LaTeX
    Fragment   words, a formula, a number, or a name that is none of the model's
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from typing import Literal, NamedTuple

from ..symbols import QUANTITIES

_NAMES = {name: quantity.latex for name, quantity in QUANTITIES.items()} | {
    "phi": r"\phi", "pi": r"\pi", "oo": r"\infty", "K": "K", "Q": "Q", "F": "F",
    "f_ij": "f_{ij}", "f_i": "f_i", "a_n": "a_n", "c_n": "c_n", "w_n": "w_n",
}  # fmt: skip
_RELATIONS = {"<=": r"\le", ">=": r"\ge", "!=": r"\ne", "->": r"\to", "=": "=", "<": "<", ">": ">"}
_FUNCTIONS = ("tanh", "ln", "sin", "cos", "max", "min")
_AMBIGUOUS = "aAIidmgb"
"""Letters that are more often words than symbols."""


def _any(words: Iterable[str]) -> str:
    return f"(?:{'|'.join(sorted(map(re.escape, words), key=len, reverse=True))})"


_END = r"(?![\w'])"
_WORDS = r"[A-Za-z]+'[A-Za-z]*|[A-Za-z]{2,}(?:-[A-Za-z]{2,})+|(?:[A-Za-z]\.){2,}"
_IDENTIFIER = rf"(?<![A-Za-z\d])(?!{_any(_NAMES)}{_END})[A-Za-z]+(?:[_-][A-Za-z]+)*[_-]?\d[\w\-]*"
_NUMBER = r"(?:(?<!\w)[-+])?(?<![\w.])\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w]|\.\d)"
_RESULT = rf"(?=[-+]?(?:\d+[.e]|\d{{3}})){_NUMBER}"
_RELATION = r"(?: ?(?:<=|>=|!=|->|=) ?| [<>] )"
_KNOWN = rf"(?<![\w'])(?![{_AMBIGUOUS}]{_END}){_any(_NAMES)}{_END}"
_BARE = rf"(?:{_any(_NAMES)}|[A-Za-z])"
_NAME = rf"(?<![\w']){_BARE}{_END}"
_SLOPE = rf"\bd ?{_BARE}/d ?{_BARE}{_END}"
_FUNCTION = rf"(?<!\w){_any(_FUNCTIONS)}{_END}"
_SMALL = r"(?<![\w.])\d{1,2}(?!\d|\.\d|e[-+]?\d|[A-Za-z]\w)"
_SURE, _UNSURE = 0xE000, 0xF000
"""Private characters for brackets with a formula inside, and with a possible formula."""
_GROUP = "[\ue000-\uf8ff]"
_ATOM = rf"(?:{_SLOPE}|{_NAME}{_GROUP}?+|{_SMALL}|<{_NAME}>|{_GROUP})"
_POWER = rf"{_ATOM}(?:\^-?{_ATOM})?"
_FACTOR = rf"(?:{_FUNCTION} ?)?{_POWER}"


def _sum(beside: str) -> str:
    """Return the regular expression of a sum; ``beside`` is that of a factor's neighbour."""
    product = rf"{_FACTOR}(?: ?[*/] ?{_FACTOR}| ?(?={beside}){_FACTOR})*"
    return rf"[-+]?{product}(?:(?: [-+] |[-+]){product})*"


_INSIDE = _sum(r"[A-Za-z\ue000-\uefff]")
_OUTSIDE = _sum(rf"(?![{_AMBIGUOUS}]{_END})[A-Za-z\ue000-\uefff]")
_BRACKETS = re.compile(rf"\({_INSIDE}(?:, ?{_INSIDE})*\)|\[{_INSIDE}\]|\|{_INSIDE}\|")
_PART = re.compile(
    rf"(?P<identifier>{_IDENTIFIER})|(?P<words>{_WORDS})|(?P<number>{_RESULT})"
    rf"|(?P<formula>(?:(?<=\d){_RELATION})?{_OUTSIDE}(?:{_RELATION}{_OUTSIDE})*"
    rf"(?:{_RELATION}(?={_RESULT}))?)"
)
_CERTAIN = re.compile(rf"{_KNOWN}|{_SLOPE}|{_FUNCTION}|\^|\d/|<{_NAME}>|{_RELATION}")
_NUMBER_ALONE = re.compile(rf"[-+]?{_NUMBER}")
_TOKEN = re.compile(
    rf"(?P<slope>\bd ?(?P<above>{_BARE})/d ?(?P<below>{_BARE}){_END})|(?P<function>{_FUNCTION}) ?"
    rf"|(?P<name>{_NAME})|\^(?P<power>-?(?:\w+|{_GROUP}))|<(?P<mean>{_NAME})>"
    rf"|(?P<relation>{_RELATION})|(?P<product> ?[*/] ?)|(?P<group>{_GROUP})"
)


class Fragment(NamedTuple):
    """A part of a text: unchanged words, a formula in LaTeX, a number or another name."""

    kind: Literal["words", "formula", "number", "identifier"]
    text: str


def read(text: str) -> tuple[Fragment, ...]:
    """Return the fragments of a text; a number is never inside words or a formula's side.

    >>> [part.text for part in read("at h = 3 sigma, for f_c = 0.25 and a load")]
    ['at ', 'h = 3 \\\\bar{\\\\sigma}', ', for ', 'f_c =', ' ', '0.25', ' and a load']
    """
    groups: list[str] = []
    if re.search(_GROUP, text):
        return (Fragment("words", text),)

    def fold(brackets: re.Match[str]) -> str:
        groups.append(brackets[0])
        first = _SURE if _is_certain(_unfolded(brackets[0], groups)) else _UNSURE
        return chr(first + len(groups) - 1)

    while (folded := _BRACKETS.sub(fold, text)) != text:
        text = folded
    return tuple(part for part in _parts(text, groups) if part.text)


def in_latex(text: str) -> str:
    r"""Return the text with its formulas in LaTeX.

    >>> print(in_latex("terms of order 2 in 1/m, with f_c = d sigma_c/d u_c"))
    terms of order 2 in $1/m$, with $f_c = \mathrm{d}\sigma_c/\mathrm{d}u_c$
    """
    return "".join(f"${part.text}$" if part.kind == "formula" else part.text for part in read(text))


def _is_certain(text: str) -> bool:
    """Return whether a match is a formula, not words that resemble one."""
    return _CERTAIN.search(text) is not None


def _parts(text: str, groups: Sequence[str]) -> Iterator[Fragment]:
    """Yield the fragments of a text in which private characters replace brackets."""
    end = 0
    for match in _PART.finditer(text):
        kind, inside = str(match.lastgroup), _unfolded(match[0], groups)
        if kind == "words" or (kind == "formula" and not _is_certain(inside)):
            if not _NUMBER_ALONE.fullmatch(inside):
                continue
            kind = "number"
        yield from _words(text[end : match.start()], groups)
        shown = _latex(match[0], groups).strip() if kind == "formula" else inside
        yield Fragment(kind, shown)  # type: ignore[arg-type]
        yield Fragment("words", " " * (kind == "formula" and match[0].endswith(" ")))
        end = match.end()
    yield from _words(text[end:], groups)


def _words(text: str, groups: Sequence[str]) -> Iterator[Fragment]:
    """Yield words, and the fragments inside their brackets."""
    for piece in re.split(f"({_GROUP})", text):
        if re.fullmatch(_GROUP, piece):
            brackets = _inner(piece, groups)
            yield Fragment("words", brackets[0])
            yield from _parts(brackets[1:-1], groups)
            yield Fragment("words", brackets[-1])
        else:
            yield Fragment("words", piece)


def _unfolded(text: str, groups: Sequence[str]) -> str:
    """Return a text with its brackets."""
    return re.sub(_GROUP, lambda group: _unfolded(_inner(group[0], groups), groups), text)


def _inner(group: str, groups: Sequence[str]) -> str:
    return groups[(ord(group) - _SURE) % (_UNSURE - _SURE)]


def _latex(text: str, groups: Sequence[str]) -> str:
    """Return a formula in LaTeX."""

    def symbol(name: str) -> str:
        return _NAMES.get(name, name)

    def write(token: re.Match[str]) -> str:
        if token["slope"]:
            return rf"\mathrm{{d}}{symbol(token['above'])}/\mathrm{{d}}{symbol(token['below'])}"
        if token["function"]:
            return rf"\{token['function']} "
        if token["name"]:
            return r"\mathrm{e}" if token[0] == "e" else symbol(token[0])
        if token["power"]:
            inner = _latex(token["power"], groups)
            inner = inner[1:-1] if inner.startswith("(") else inner
            return f"^{inner}" if len(inner) == 1 else f"^{{{inner}}}"
        if token["mean"]:
            return rf"\langle {symbol(token['mean'])}\rangle"
        if token["relation"]:
            return f" {_RELATIONS[token[0].strip()]} "
        if token["product"]:
            return r"\," if "*" in token[0] else "/"
        brackets = _latex(_inner(token[0], groups), groups)
        return rf"\lvert {brackets[1:-1]}\rvert" if brackets[0] == "|" else brackets

    return _TOKEN.sub(write, text)
