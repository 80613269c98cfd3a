"""SVG figures made fit to stand inside the page."""

from __future__ import annotations

import re
from html import escape

_NOT_FOR_A_PAGE = re.compile(
    r"<\?xml.*?\?>|<!DOCTYPE.*?>|<!--.*?-->|<metadata>.*?</metadata>|<style.*?</style>", re.DOTALL
)
_ROOT = re.compile(r"<svg\b([^>]*)>")
_SIZE = re.compile(r'\s(?:width|height)="[^"]*"')
_WIDTH = re.compile(r'\bwidth="([\d.]+)pt"')
_ID = re.compile(r'\bid="([^"]+)"')
_USE = re.compile(r'((?:xlink:)?href="#|url\(#)([^")]+)')
#: (What has no colour in the file is black: the root's fill takes care of that.)
#: Ink and paper of the figures follow the colours of the page, so that dark mode works.
_INK = {"#000000": "currentColor", "#ffffff": "var(--paper)"}


def inline(svg: str, label: str, description: str) -> str:
    """The figure as an element of the page.

    Its ids begin with `label` (two figures may use the same ids), black and white become the ink
    and paper of the page, its width on paper is told to the style sheet as ``--points``, and it is
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
