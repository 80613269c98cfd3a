"""One writer for all forms of a document: a template with a macro for each type of token."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import jinja2
from jinja2.runtime import Macro
from markdown_it.renderer import RendererHTML
from markdown_it.token import Token

from wear.cite import REFERENCES
from wear.report.document import Document
from wear.report.text import MARKDOWN, line


class Writer(RendererHTML):
    """Writes tokens by the macros of a template, one for each type; other types as HTML.

    A macro takes the token. It has access to the `document`, the works to cite, `inside`, which
    writes the tokens of a line, and `of_line`, which writes a line of Markdown, such as a title.
    """

    def __init__(self, document: Document, template: jinja2.Template) -> None:
        super().__init__()
        seen = {"document": document, "references": REFERENCES, "inside": self.inside}
        blocks = template.make_module({**seen, "of_line": self.of_line})
        rules: dict[str, Any] = self.rules
        for kind, macro in vars(blocks).items():
            if isinstance(macro, Macro):
                rules[kind] = lambda tokens, i, *_, macro=macro: str(macro(tokens[i]))

    def written(self, tokens: Sequence[Token]) -> str:
        """Return the tokens of a document as text."""
        return str(self.render(tokens, MARKDOWN.options, {}))

    def inside(self, tokens: Sequence[Token] | None) -> str:
        """Return the tokens of a line as text."""
        return str(self.renderInline(tokens or (), MARKDOWN.options, {}))

    def of_line(self, text: str) -> str:
        """Return a line of Markdown, such as a title, as text."""
        return self.inside(line(text))
