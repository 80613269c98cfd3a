"""Formulas of the pages as MathML, by the converter that writes those of the report.

No script and no network are needed to read them; the math font is the report's.
A formula may end in ``\\tag{21}``: the tag is set beside it and links to the equation's entry.
"""

from __future__ import annotations

import re
from html import escape
from typing import Any

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util import logging

from derive.typeset import mathml

LIST_OF_EQUATIONS = "reference/equations"
_TAG = re.compile(r"\\tag\{([\w-]+)\}\s*$")
_LOG = logging.getLogger(__name__)


def anchor(identifier: str) -> str:
    """The id of an equation's entry on the page that lists all of them."""
    return f"eq-{identifier}"


def _inline(writer: Any, node: nodes.math) -> None:
    writer.body.append(f'<span class="formula">{_converted(node, mathml.inline)}</span>')
    raise nodes.SkipNode


def _block(writer: Any, node: nodes.math_block) -> None:
    tag = _TAG.search(node.astext())
    number = "" if tag is None else _number(writer, tag[1])
    writer.body.append(
        f'<div class="displayed"><div class="formula" tabindex="0">{_converted(node, mathml.block)}'
        f"</div>{number}</div>\n"
    )
    raise nodes.SkipNode


def _converted(node: nodes.Element, convert: Any) -> str:
    latex = _TAG.sub("", node.astext())
    try:
        return str(convert(latex))
    except ValueError as fault:
        _LOG.warning(str(fault), location=node)
        return f"<code>{escape(latex)}</code>"


def _number(writer: Any, identifier: str) -> str:
    builder = writer.builder
    page = builder.get_relative_uri(builder.current_docname, LIST_OF_EQUATIONS)
    name = f"({identifier})" if identifier[0].isdigit() else identifier
    return f'<a class="number" href="{page}#{anchor(identifier)}">{name}</a>'


def setup(app: Sphinx) -> dict[str, bool]:
    """Offer the renderer to Sphinx."""
    app.add_html_math_renderer("mathml", (_inline, None), (_block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
