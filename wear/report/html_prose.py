"""Inline nodes as HTML: words, formulas, numbers with their source, links to labels."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from html import escape
from itertools import pairwise
from numbers import Integral
from typing import assert_never

from wear.report import mathml
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

_CLOSING = tuple(".,;:)?")


@dataclass(frozen=True)
class Page:
    """What the blocks of a page share."""

    marks: Mapping[str, Mark]
    mentioned_by: Mapping[str, tuple[str, ...]]


def prose(here: Page, content: Prose) -> str:
    """Inline nodes as HTML; a formula stays on the line of the punctuation behind it."""
    shown = [_inline(here, piece) for piece in content]
    for i, (piece, behind) in enumerate(pairwise(content)):
        if isinstance(piece, Math) and isinstance(behind, Text) and behind.text[:1] in _CLOSING:
            shown[i] = f'<span class="kept">{shown[i]}{behind.text[0]}</span>'
            shown[i + 1] = escape(behind.text[1:], quote=False)
    return "".join(shown)


def _inline(here: Page, piece: Inline) -> str:
    match piece:
        case Text(text) | Given(text):
            return escape(text, quote=False)
        case Emphasis(text):
            return f"<em>{escape(text, quote=False)}</em>"
        case Code(text):
            return f"<code>{escape(text, quote=False)}</code>"
        case Math(latex):
            return mathml.inline(latex)
        case Reference(label, bare):
            return link(here, label, bare=bare)
        case Link(text, url):
            return f'<a href="{escape(url)}">{escape(text, quote=False)}</a>'
        case Number():
            return _number(piece)
    assert_never(piece)


def _number(node: Number) -> str:
    digits, exponent = node.decimal
    shown = grouped(digits, "\u202f")
    if exponent is not None:
        shown += f"\u202f×\u202f10<sup>{exponent}</sup>"
    shown = shown.replace("-", "\u2212")
    if node.unit:
        shown += f"\u00a0{escape(node.unit, quote=False)}"
    return f'<data value="{_plain(node.value)!r}" title="{escape(node.source)}">{shown}</data>'


def _plain(value: float) -> float:
    """The number as Python's own, whose form is plain digits; NumPy's is not."""
    return int(value) if isinstance(value, Integral) else float(value)


def link(here: Page, label: str, *, bare: bool = False) -> str:
    """A link to a label, named by its kind and number, or by the number alone."""
    mark = here.marks[label]
    return f'<a href="#{label}">{mark.bare if bare else mark.name}</a>'
