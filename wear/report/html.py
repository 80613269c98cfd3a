"""The document as one page: no network, formulas as MathML with their own font.

Overview
    `page` writes the file. Tokens of Markdown are written by markdown-it; each of ours has a macro
    in ``templates/blocks.html``, named after it; `drawing` prepares a figure for the page. The
    frame is ``templates/page.html``, the style ``assets/report.css``; a few lines of
    ``assets/report.js`` mark the section that is being read.
On the page
    Landmarks and a link that skips to the content; headings in order without gaps; figures that
    are announced by their description; headed rows and columns.
"""

from __future__ import annotations

import base64
import hashlib
import re
from functools import partial
from html import escape
from importlib.resources import files

from derive.templates import templates
from derive.typeset import mathml
from wear.cite import listed
from wear.report.document import Document
from wear.report.number import grouped
from wear.report.writer import Writer

_ASSETS = files("wear.report").joinpath("assets")

_NOT_FOR_A_PAGE = re.compile(
    r"<\?xml.*?\?>|<!DOCTYPE.*?>|<!--.*?-->|<metadata>.*?</metadata>|<style.*?</style>", re.DOTALL
)
_ROOT = re.compile(r"<svg\b([^>]*)>")
_SIZE = re.compile(r'\s(?:width|height)="[^"]*"')
_WIDTH = re.compile(r'\bwidth="([\d.]+)pt"')
_ID = re.compile(r'\bid="([^"]+)"')
_USE = re.compile(r'((?:xlink:)?href="#|url\(#)([^")]+)')
#: Ink and paper of the figures follow the colours of the page, so that dark mode works. (Shapes
#: without a colour are black: they take the fill of the root.)
_INK = {"#000000": "currentColor", "#ffffff": "var(--paper)"}


def _base64(content: bytes) -> str:
    return base64.b64encode(content).decode()


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
    """Return the style sheet of a page, with the font of its formulas."""
    font = _base64(_ASSETS.joinpath("stix-two-math.woff2").read_bytes())
    return asset("report.css").replace(
        "url(stix-two-math.woff2)", f"url(data:font/woff2;base64,{font})"
    )


def drawing(svg: str, label: str, description: str) -> str:
    """Return a figure as an element of the page.

    Its ids begin with `label` (two figures may use the same ids), black and white become the ink
    and paper of the page, the style sheet gets its width on paper as ``--points``, and it is
    announced as one image with `description`.
    """
    body = _NOT_FOR_A_PAGE.sub("", svg).strip()
    root = _ROOT.search(body)
    if root is None or "viewBox" not in root[1]:
        raise ValueError(f"{label}: not an SVG document with a viewBox")
    prefix = re.sub(r"[^A-Za-z0-9]", "-", label)
    body = _ID.sub(rf'id="{prefix}-\1"', body)
    body = _USE.sub(rf"\1{prefix}-\2", body)
    for colour, meaning in _INK.items():
        body = re.sub(colour, meaning, body, flags=re.IGNORECASE)
    width = _WIDTH.search(root[1])
    size = f' style="--points:{float(width[1]):.0f}"' if width else ""
    attributes = f'role="img" fill="currentColor" aria-label="{escape(description)}"{size}'
    return _ROOT.sub(lambda match: f"<svg {attributes}{_SIZE.sub('', match[1])}>", body, count=1)


TEMPLATES = templates("wear.report")
TEMPLATES.filters |= {
    "e": escape,
    "text": partial(escape, quote=False),
    "words": lambda text: text.replace("-", " "),
    "hash": lambda script: f"sha256-{_base64(hashlib.sha256(script.encode()).digest())}",
    "formula": mathml.inline,
    "display": mathml.block,
    "drawing": drawing,
    "listed": listed,
    "grouped": partial(grouped, separator="\u202f"),
}
