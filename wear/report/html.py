"""The document as one page: no network, formulas as MathML with their own font.

Overview
    `page` writes the whole file. Tokens that Markdown knows are written by markdown-it; each of
    ours has a method here, named after it. The frame is ``templates/page.html``, the look
    ``assets/report.css``; a few lines of ``assets/report.js`` mark the section that is being read.
On the page
    Landmarks and a link that skips to the content; headings in order without gaps; figures that
    are announced by their description; headed rows and columns.
"""

from __future__ import annotations

import base64
import hashlib
from collections.abc import Mapping, Sequence
from html import escape
from importlib.resources import files
from numbers import Integral
from typing import Any, ClassVar

import jinja2
from markdown_it.token import Token

from wear.cite import REFERENCES, listed
from wear.report import mathml, svg
from wear.report.document import Document
from wear.report.number import grouped
from wear.report.text import Writer

_CLOSING = tuple(".,;:)?")
_ASSETS = files("wear.report").joinpath("assets")


def _hash(script: str) -> str:
    return "sha256-" + base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()


TEMPLATES = jinja2.Environment(
    loader=jinja2.PackageLoader("wear.report"),
    undefined=jinja2.StrictUndefined,
    autoescape=False,
    trim_blocks=True,
)
TEMPLATES.filters |= {
    "words": lambda text: text.replace("-", " "),
    "hash": _hash,
    "formula": mathml.inline,
}


def page(document: Document) -> str:
    """Return the document as a self-contained HTML file.

    Raises
    ------
    ValueError
        for references that lead nowhere and formulas outside the subset of `wear.report.mathml`.
    """
    writer = _Writer(document)
    body = writer.written(document.text.tokens)
    return TEMPLATES.get_template("page.html").render(
        title=document.title,
        style=style(),
        script=asset("report.js"),
        contents=writer.contents,
        body=body + writer.end_of_sections(0),
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


class _Writer(Writer):
    """Writes tokens as HTML."""

    plain: ClassVar[Mapping[str, str]] = {
        "figures_open": '<div class="figures">\n', "figures_close": "</div>\n",
        "caption_close": "</div></caption>\n", "softbreak": "\n",
        "table_open": "",  # the caption has opened it, and the box in which it scrolls
        "table_close": "</table></div>\n",
    }  # fmt: skip

    def __init__(self, document: Document) -> None:
        super().__init__()
        self._document = document
        self._blocks: Any = TEMPLATES.get_template("blocks.html").module
        self._open: list[int] = []  # levels of the sections that are open
        self.contents: list[tuple[Any, str, int]] = []

    # sections

    def end_of_sections(self, level: int) -> str:
        """Close the sections of this level and below."""
        closed = ""
        while self._open and self._open[-1] >= level:
            self._open.pop()
            closed += "</section>\n"
        return closed

    def heading_open(self, tokens: Sequence[Token], i: int, *_: Any) -> str:
        """A section begins with its heading."""
        token = tokens[i]
        level = int(token.tag[1])
        ended = self.end_of_sections(level)
        if "label" not in token.meta:
            return f"{ended}<{token.tag}>"
        self._open.append(level)
        mark = self._document.marks[token.meta["label"]]
        start = f'{ended}<section id="{mark.target}">\n<{token.tag}>'
        if mark.kind == "derivation":
            return start
        self.contents.append((mark, self.inside(tokens[i + 1].children), level))
        return f'{start}<span class="numeral">{mark.number}</span> '

    # blocks

    def fence(self, tokens: Sequence[Token], i: int, *_: Any) -> str:
        """Equations, a formula, the works cited, or code."""
        token = tokens[i]
        if token.info == "equations":
            return "".join(map(self._equation, token.content.split()))
        if token.info == "math":
            return f'<div class="formula">{mathml.block(token.content.strip())}</div>\n'
        if token.info == "works":
            marks = self._document.marks
            works = [
                (marks[f"ref:{key}"], listed(REFERENCES[key]), REFERENCES[key].fields.get("doi"))
                for key in self._document.works
            ]
            return str(self._blocks.works(works))
        return (
            f'<pre role="region" aria-label="Commands" tabindex="0">{escape(token.content)}</pre>\n'
        )

    def _equation(self, identifier: str) -> str:
        found = self._document.equations[identifier]
        mark = self._document.marks[f"eq:{identifier}"]
        printed = mathml.block(found.printed) if found.printed else ""
        mentions = " · ".join(
            self._link(label) for label in self._document.mentions.get(mark.target, ())
        )
        formula = mathml.block(found.latex)
        return str(
            self._blocks.equation(
                found, mark, self.of_line(found.title), mentions, formula, printed
            )
        )

    def image(self, tokens: Sequence[Token], i: int, *_: Any) -> str:
        """A figure with its caption."""
        mark = self._document.marks[str(tokens[i].attrs["src"])]
        description = str(tokens[i].attrs["title"])
        drawing = svg.inline(self._document.figures[mark.target].svg, mark.target, description)
        caption = self.inside(tokens[i].children)
        return str(self._blocks.figure(mark, drawing, caption))

    def caption_open(self, tokens: Sequence[Token], i: int, *_: Any) -> str:
        """A table begins with its caption."""
        mark = self._document.marks[tokens[i].meta["label"]]
        return (
            f'<div class="scroll" id="{mark.target}" role="region" aria-label="{mark.name}" '
            f'tabindex="0"><table><caption><div><b>{mark.name}.</b> '
        )

    def th_open(self, tokens: Sequence[Token], i: int, *_: Any) -> str:
        """The heading of a column."""
        return f'<th scope="col" class="{tokens[i].meta["kind"]}">'

    def td_open(self, tokens: Sequence[Token], i: int, *_: Any) -> str:
        """A cell; the first of a row is its heading."""
        meta = tokens[i].meta
        return (
            f'<th scope="row" class="{meta["kind"]}">'
            if meta["first"]
            else (f'<td class="{meta["kind"]}">')
        )

    def td_close(self, tokens: Sequence[Token], i: int, *_: Any) -> str:
        """The end of a cell."""
        start = max(j for j in range(i) if tokens[j].type == "td_open")
        return "</th>\n" if tokens[start].meta["first"] else "</td>\n"

    # inside lines

    def math(self, tokens: Sequence[Token], i: int, *_: Any) -> str:
        """A formula; it stays on the line of the punctuation behind it."""
        formula = mathml.inline(tokens[i].content)
        behind = tokens[i + 1].content[:1] if i + 1 < len(tokens) else ""
        if behind in _CLOSING and behind and tokens[i + 1].type == "text":
            return f'<span class="kept">{formula}{behind}</span>'
        return formula

    def text(self, tokens: Sequence[Token], i: int, *_: Any) -> str:
        """Words, without the punctuation that a formula has taken."""
        words = tokens[i].content
        taken = i > 0 and tokens[i - 1].type == "math" and words[:1] in _CLOSING
        return escape(words[taken:], quote=False)

    def reference(self, tokens: Sequence[Token], i: int, *_: Any) -> str:
        """A link by kind and number, or by the number alone."""
        return self._link(tokens[i].content, bare=tokens[i].meta["bare"])

    def _link(self, label: str, *, bare: bool = False) -> str:
        mark = self._document.marks[label]
        return f'<a href="#{mark.target}">{mark.bare if bare else mark.name}</a>'

    def target(self, tokens: Sequence[Token], i: int, *_: Any) -> str:
        """The place that links to a claim lead to."""
        mark = self._document.marks[tokens[i].content]
        return f'<b id="{mark.target}">{mark.number}</b>'

    def verdict(self, tokens: Sequence[Token], i: int, *_: Any) -> str:
        """A verdict, coloured."""
        said = tokens[i].content
        return f'<span class="badge {said}">{said.replace("-", " ")}</span>'

    def number(self, tokens: Sequence[Token], i: int, *_: Any) -> str:
        """A number that was computed; a pointer on it shows by what."""
        node = self._document.text.numbers[int(tokens[i].content)]
        digits, exponent = node.decimal
        shown = grouped(digits, "\u202f")
        if exponent is not None:
            shown += f"\u202f×\u202f10<sup>{exponent}</sup>"
        unit = f"\u00a0{escape(node.unit, quote=False)}" if node.unit else ""
        value = int(node.value) if isinstance(node.value, Integral | int) else float(node.value)
        shown = shown.replace("-", "\u2212")
        return f'<data value="{value!r}" title="{escape(node.source)}">{shown}{unit}</data>'
