"""Runs of text as LaTeX: words, mathematics, numbers, links."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import assert_never

from wear.report.document import (
    Code,
    Emphasis,
    Given,
    Inline,
    Link,
    Math,
    Number,
    Prose,
    Reference,
    Text,
    grouped,
)
from wear.report.numbering import Mark
from wear.report.tex_text import escape

#: What is not numbered by LaTeX, but named where it stands.
_NAMED = ("claim", "derivation", "work")
_THIN_SPACE = r"\,"


@dataclass(frozen=True)
class Context:
    """What the text refers to."""

    marks: Mapping[str, Mark]
    mentioned_by: Mapping[str, tuple[str, ...]]


def prose(here: Context, content: Prose) -> str:
    """Inline nodes as LaTeX."""
    return "".join(_inline(here, piece) for piece in content)


def _inline(here: Context, piece: Inline) -> str:
    match piece:
        case Text(text) | Given(text):
            return escape(text)
        case Emphasis(text):
            return f"\\emph{{{escape(text)}}}"
        case Code(text):
            return f"\\texttt{{{_breakable(text)}}}"
        case Math(latex):
            return f"${latex}$"
        case Reference(label, bare):
            return bare_link(here, label) if bare else link(here, label)
        case Link(text, url):
            return f"\\href{{{_url(url)}}}{{{escape(text)}}}"
        case Number():
            return _number(piece)
    assert_never(piece)


def _breakable(code: str) -> str:
    """Code that may be broken after the signs that join its parts."""
    return "".join(escape(c) + (r"\allowbreak{}" if c in "/._-=" else "") for c in code)


def _url(url: str) -> str:
    return url.replace("\\", "/").replace("%", r"\%").replace("#", r"\#").replace("&", r"\&")


def _number(node: Number) -> str:
    digits, exponent = node.decimal
    power = "" if exponent is None else f"\\times10^{{{exponent}}}"
    unit = f"~{escape(node.unit)}" if node.unit else ""
    return f"${grouped(digits, _THIN_SPACE)}{power}${unit}"


def link(here: Context, label: str) -> str:
    """A link with the kind of its target: "Figure 2"."""
    mark = here.marks[label]
    if mark.kind in _NAMED:
        return f"\\linkto{{{label}}}{{{escape(mark.name)}}}"
    return f"\\cref{{{label}}}"


def bare_link(here: Context, label: str) -> str:
    """A link with the number alone."""
    mark = here.marks[label]
    if mark.kind in _NAMED:
        return f"\\linkto{{{label}}}{{{mark.bare}}}"
    return f"\\hyperref[{label}]{{{mark.bare}}}"
