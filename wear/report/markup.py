r"""Plain text of the derivation as Markdown: formulas and numbers typeset, equations referred to.

Titles, remarks and evidence are written as one types them into a terminal: ``h/sigma -> 1/f_c``,
``4.6e-8 mm``, ``(16)``, ``C36``.
"""

from __future__ import annotations

import re
from collections.abc import Container

from derive.typeset.reading import Fragment, read
from wear.report.number import TextNumber, grouped

_MARK = re.compile(
    r"``(?P<code>[^`]+)``"
    r"|(?:Eqs?\. |(?<![\w)]))\((?P<equation>\d+[a-g]?|[a-z]{3,}(?:-[a-z]+)*)\)"
    r"|\b(?P<claim>C\d+)\b"
)
_SPECIAL = re.compile(r"([\\`*_\[\]<>$|{}#&])")
_OPENING = re.compile(r"^((?:\d+|Table)?)([-+=~.):])")
"""What begins a list, a rule, a listing or a caption in a paragraph of its own."""
#: The line of a system that its number stands for.
_MEANT = {"16": "16b", "17": "17b"}


def escaped(text: str) -> str:
    r"""Return plain words as Markdown, in one line.

    >>> print(escaped("sigma_c0 * 2"))
    sigma\_c0 \* 2
    """
    return _SPECIAL.sub(r"\\\1", re.sub(r"\s*\n\s*", " ", text))


def paragraphs(text: str) -> str:
    r"""Return plain words, in paragraphs that empty lines separate, as Markdown.

    >>> print(paragraphs("- new\n  pin\n\n1. of C45"))
    \- new pin
    <BLANKLINE>
    1\. of C45
    """
    parts = re.split(r"\n\s*\n", text.strip())
    return "\n\n".join(_OPENING.sub(r"\1\\\2", escaped(part.strip())) for part in parts)


def markup(text: str, labels: Container[str] = ()) -> str:
    r"""Return the text as Markdown.

    An equation's number or id in brackets and a claim's id become references if their labels are
    among `labels`.

    >>> print(markup("u_cum is 2.5e-5 mm by (21)", {"eq:21"}))
    $u_{\mathrm{cum}}$ is $2.5\times10^{-5}$ mm by [eq:21]
    """
    shown, end = "", 0
    for mark in _MARK.finditer(text):
        shown += _between(text[end : mark.start()]) + _marked(mark, labels)
        end = mark.end()
    return shown + _between(text[end:])


def _marked(mark: re.Match[str], labels: Container[str]) -> str:
    """Return code, a reference, or brackets with their content unchanged."""
    if mark["code"]:
        return f"`{mark['code']}`"
    if mark["claim"]:
        return f"[claim:{mark[0]}]" if f"claim:{mark[0]}" in labels else escaped(mark[0])
    named = mark["equation"]
    for label in (f"eq:{_MEANT.get(named, named)}", f"eq:{named}a"):
        if label in labels:
            return f"[{label}]"
    return escaped(mark[0])


def _between(text: str) -> str:
    return "".join(map(_part, read(text)))


def _part(part: Fragment) -> str:
    match part.kind:
        case "formula":
            return f"${part.text}$"
        case "number":
            return number(part.text)
        case "identifier":
            return f"`{part.text}`"
        case "words":
            return escaped(part.text)


def number(digits: str) -> str:
    r"""Return a number as it is written, its power of ten typeset.

    >>> print(number("1.50e-3"), number("123456"))
    $0.00150$ $123\,456$
    """
    if digits.lstrip("+-").isdigit():
        return f"${grouped(digits, chr(92) + ',')}$"
    mantissa = digits.lower().partition("e")[0].lstrip("+-")
    significant = len(mantissa.replace(".", "").lstrip("0")) or 1
    return f"${TextNumber(float(digits), 'as written', significant).latex}$"
