"""Notebooks as pages: the stored cells and outputs, without running anything."""

from __future__ import annotations

import base64
import json
from html import escape
from typing import Any

from docutils import nodes
from myst_parser.parsers.sphinx_ import MystParser
from sphinx.application import Sphinx


class NotebookParser(MystParser):
    """Reads a notebook as the Markdown page that `markdown` makes of it."""

    supported = ("notebook",)

    def parse(self, inputstring: str, document: nodes.document) -> None:
        super().parse(markdown(json.loads(inputstring)), document)


def markdown(notebook: dict[str, Any]) -> str:
    """The cells and their outputs, one below the other."""
    return "\n\n".join(part for cell in notebook["cells"] for part in _parts(cell))


def _parts(cell: dict[str, Any]) -> list[str]:
    source = "".join(cell["source"])
    if cell["cell_type"] == "markdown":
        return [source]
    title = cell["metadata"].get("title", "")
    return [_fenced("python", source), *(_output(output, title) for output in cell["outputs"])]


def _output(output: dict[str, Any], title: str) -> str:
    if output["output_type"] == "stream":
        return _fenced("text", "".join(output["text"]))
    data = output["data"]
    if "image/svg+xml" in data:
        picture = base64.b64encode("".join(data["image/svg+xml"]).encode()).decode()
        source = f"data:image/svg+xml;base64,{picture}"
        return _fenced("{raw} html", f'<img alt="{escape(title)}" src="{source}">')
    if "text/latex" in data:
        return _fenced("{math}", "".join(data["text/latex"]).strip("$").strip())
    return _fenced("text", "".join(data["text/plain"]))


def _fenced(language: str, text: str) -> str:
    return f"```{language}\n{text.rstrip()}\n```"


def setup(app: Sphinx) -> dict[str, bool]:
    """Have `.ipynb` files read by `NotebookParser`."""
    app.add_source_parser(NotebookParser)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
