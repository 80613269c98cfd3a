r"""The text of a report: Markdown with values, read into tokens.

Overview
    A report is written in Markdown (``paper.md``) and filled in by Jinja2. `parsed` returns the
    tokens of markdown-it, with the properties of their neighbours that a writer needs;
    `wear.report.html` and `wear.report.tex` make a page and LaTeX of them.
Marks, besides those of Markdown
    {{ u | number("scene 4", 5, "mm") }}
                            a `TextNumber` by its source, shown to five digits, with its unit
    {{ text | plain }}      words as they are in one line, ``paragraphs`` in several; ``markup``
                            also sets formulas and references
    $u_c$                   a formula
    [eq:21], [(eq:18)]      a reference by kind and number, or by the number alone; ``sec: app: fig:
                            tab: claim: der: ref:`` likewise
    {#tab:data}             the target of a reference: at the end of a heading or caption, or
                            anywhere in a line
    {verdict refuted}       a status or verdict
    Table: Data. {#tab:x}   the caption of the table below it; a column ``:--`` is narrow, ``---``
                            holds sentences, ``--:`` numbers
    ![Caption.](fig:wear "Description for those who do not see it.")
                            a figure; several in one paragraph stand side by side
    ```equations            the equations of these ids
    ```math                 one formula in a display, without a number
    ```works                the works that the text cites
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from importlib.resources import files
from itertools import pairwise
from typing import Any

import jinja2
from markdown_it import MarkdownIt
from markdown_it.rules_core import StateCore
from markdown_it.rules_inline import StateInline
from markdown_it.token import Token

from wear.report.markup import escaped, markup, paragraphs
from wear.report.number import TextNumber, significant

_LABEL = r"(?:eq|sec|app|fig|tab|claim|der|ref):[A-Za-z0-9.\-]+"
_MARK = re.compile(
    r"\$(?P<math>[^$]+)\$"
    rf"|\[(?P<bare>\()?(?P<reference>{_LABEL})(?(bare)\))\]"
    rf"|\{{#(?P<target>{_LABEL})\}}"
    r"|\{number (?P<number>\d+)\}|\{verdict (?P<verdict>[a-z\-]+)\}"
)
_NAMED = re.compile(rf"\s*\{{#(?P<label>{_LABEL})\}}$")
_CAPTION = "Table: "
_CLOSING = tuple(".,;:)?")
_FIGURES = re.compile(r"(?:\s*!\[(?:[^\]]|\[[^\]]*\])*\]\(fig:[^)]*\))+\s*", re.DOTALL)


Tokens = tuple[Token, ...]
"""A parsed text."""


def inline(tokens: Tokens) -> Iterator[Token]:
    """Yield all tokens inside lines, captions among them, in reading order."""
    for piece in (piece for token in tokens for piece in token.children or ()):
        yield piece
        yield from piece.children or ()


def template(name: str) -> str:
    """Return the text of a report by the name of its file, to be filled in."""
    return files("wear.report").joinpath(name).read_text(encoding="utf-8")


def parsed(template: str, values: Mapping[str, Any]) -> Tokens:
    """Return the tokens of a text with its values; a number is `meta["number"]` of its token.

    Raises
    ------
    jinja2.UndefinedError
        if the text needs an unknown value.
    """
    numbers: list[TextNumber] = []

    def shown(value: Any) -> Any:
        if not isinstance(value, TextNumber):
            return value
        numbers.append(value)
        return f"{{number {len(numbers) - 1}}}"

    environment = jinja2.Environment(
        finalize=shown, undefined=jinja2.StrictUndefined, trim_blocks=True, lstrip_blocks=True,
        keep_trailing_newline=True, autoescape=False, comment_start_string="{##",
    )  # fmt: skip
    environment.filters |= {"plain": escaped, "markup": markup, "number": _number}
    environment.filters["paragraphs"] = paragraphs
    environment.filters["cell"] = lambda text: text.replace("|", r"\|")
    source = environment.from_string(template).render(values)
    return tuple(MARKDOWN.parse(source, {"numbers": numbers}))


def _number(
    value: float, source: str, digits: int = 12, unit: str = "", most: int | None = None
) -> TextNumber:
    """Return a number of the run; with `most`, a datum with its own digits, at most so many."""
    return TextNumber(value, source, digits if most is None else significant(value, most), unit)


def line(text: str) -> Sequence[Token]:
    """Return the tokens of one line of Markdown, such as a title."""
    (inline,) = MARKDOWN.parseInline(text)
    return inline.children or ()


def _mark(state: StateInline, silent: bool) -> bool:
    """Read one of our marks inside a line."""
    match = _MARK.match(state.src, state.pos)
    if match is None:
        return False
    if not silent:
        kind = match.lastgroup or ""
        token = state.push(kind, "", 0)
        token.content = match[kind]
        token.meta["bare"] = match["bare"] is not None
        token.meta["kept"] = ""
        if kind == "number":
            token.meta["number"] = state.env["numbers"][int(token.content)]
    state.pos = match.end()
    return True


def _labels(state: StateCore) -> None:
    """Give headings and captions their labels, and find the paragraphs of figures."""
    for before, inline, after in zip(
        state.tokens, state.tokens[1:], state.tokens[2:], strict=False
    ):
        if inline.type != "inline":
            continue
        is_caption = before.type == "paragraph_open" and inline.content.startswith(_CAPTION)
        if is_caption:
            before.type, after.type = "caption_open", "caption_close"
            inline.content = inline.content.removeprefix(_CAPTION)
        label = _NAMED.search(inline.content)
        if label and (is_caption or before.type == "heading_open"):
            before.meta["label"] = after.meta["label"] = label["label"]
            inline.content = inline.content[: label.start()]
        if before.type == "paragraph_open" and _FIGURES.fullmatch(inline.content):
            before.type, after.type = "figures_open", "figures_close"


def _sections(state: StateCore) -> None:
    """Set the number of sections that end at each heading, and at the end of the text."""
    if state.inlineMode:
        return
    levels: list[int] = []  # of the sections that are open
    state.tokens.append(Token("document_close", "", 0))
    for token in state.tokens:
        if token.type in ("heading_open", "document_close"):
            level = int(token.tag[1:] or 0)
            token.meta["closes"] = sum(each >= level for each in levels)
            levels = [each for each in levels if each < level]
            levels += [level] * ("label" in token.meta)


def _columns(state: StateCore) -> None:
    """Set the kinds of columns in tables and cells: ``narrow``, ``text`` or ``numeric``."""
    kinds = {"text-align:left": "narrow", "text-align:right": "numeric", None: "text"}
    columns: list[str] = []
    for token in state.tokens:
        if token.type == "table_open":
            columns = token.meta["columns"] = []
        elif token.type == "table_close":
            token.meta["columns"] = columns
        elif token.type == "tr_open":
            column = -1
        elif token.type in ("th_open", "td_open"):
            column += 1
            token.meta["kind"] = kinds[token.attrs.pop("style", None)]  # type: ignore[index]
            if token.type == "th_open":
                columns.append(token.meta["kind"])
        if token.type in ("th_open", "td_open", "td_close"):
            token.meta["first"] = column == 0


def _neighbours(state: StateCore) -> None:
    """Attach the punctuation after a formula to it, so that no line break separates them, and count
    the figures that stand side by side."""
    for children in (token.children or [] for token in state.tokens):
        for formula, text in pairwise(children):
            if formula.type == "math" and text.type == "text" and text.content.startswith(_CLOSING):
                formula.meta["kept"], text.content = text.content[0], text.content[1:]
        images = [token for token in children if token.type == "image"]
        for image in images:
            image.meta["several"] = len(images)


def _markdown() -> MarkdownIt:
    markdown = MarkdownIt("commonmark").enable("table")
    markdown.inline.ruler.before("escape", "mark", _mark)
    for rule in (_labels, _sections, _columns):
        markdown.core.ruler.before("inline", rule.__name__, rule)
    markdown.core.ruler.push("neighbours", _neighbours)
    return markdown


MARKDOWN = _markdown()
