"""The document as one page: no network, formulas as MathML with their own font.

Overview
    `page` writes the whole file. Tokens that Markdown knows are written by markdown-it; each of
    ours has a macro in ``templates/blocks.html``, named after it. The frame is
    ``templates/page.html``, the look ``assets/report.css``; a few lines of ``assets/report.js``
    mark the section that is being read.
On the page
    Landmarks and a link that skips to the content; headings in order without gaps; figures that
    are announced by their description; headed rows and columns.
"""

from __future__ import annotations

import base64
import hashlib
from functools import partial
from html import escape
from importlib.resources import files
from numbers import Integral

import jinja2

from derive.typeset import mathml
from wear.cite import listed
from wear.report import svg
from wear.report.document import Document
from wear.report.number import Number, grouped
from wear.report.writer import Writer

_ASSETS = files("wear.report").joinpath("assets")


def _hash(script: str) -> str:
    return "sha256-" + base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()


def page(document: Document) -> str:
    """Return the document as a self-contained HTML file.

    Raises
    ------
    ValueError
        for references that lead nowhere and formulas outside the subset of `derive.typeset.mathml`.
    """
    writer = Writer(document, TEMPLATES.get_template("blocks.html"))
    return TEMPLATES.get_template("page.html").render(
        title=document.title,
        style=style(),
        script=asset("report.js"),
        contents=[(mark, writer.inside(words), level) for mark, words, level in document.contents],
        body=writer.written(document.tokens),
    )


def asset(name: str) -> str:
    """Return the text of a style sheet or script of the pages."""
    return _ASSETS.joinpath(name).read_text(encoding="utf-8")


def style() -> str:
    """Return the look of a page, with the font of its formulas."""
    font = base64.b64encode(_ASSETS.joinpath("stix-two-math.woff2").read_bytes()).decode()
    return asset("report.css").replace(
        "url(stix-two-math.woff2)", f"url(data:font/woff2;base64,{font})"
    )


def _data(node: Number) -> str:
    """Return a number that was computed; a pointer on it shows by what."""
    digits, exponent = node.decimal
    shown = grouped(digits, "\u202f")
    if exponent is not None:
        shown += f"\u202f×\u202f10<sup>{exponent}</sup>"
    unit = f"\u00a0{escape(node.unit, quote=False)}" if node.unit else ""
    value = int(node.value) if isinstance(node.value, Integral | int) else float(node.value)
    shown = shown.replace("-", "\u2212")
    return f'<data value="{value!r}" title="{escape(node.source)}">{shown}{unit}</data>'


TEMPLATES = jinja2.Environment(
    loader=jinja2.PackageLoader("wear.report"),
    undefined=jinja2.StrictUndefined,
    autoescape=False,
    trim_blocks=True,
)
TEMPLATES.filters |= {
    "e": escape,
    "text": partial(escape, quote=False),
    "words": lambda text: text.replace("-", " "),
    "hash": _hash,
    "formula": mathml.inline,
    "display": mathml.block,
    "drawing": svg.inline,
    "listed": listed,
    "data": _data,
}
