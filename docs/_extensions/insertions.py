"""Text that pages take from the code, so that nothing is written twice.

A line ``<!-- insert: KIND ARGUMENT ... -->`` of a page is replaced by Markdown:

- ``equation ID ...``: equations, each with its number, as they were derived;
- ``equations``: all of them, with status, conditions and where they come from;
- ``conditions``: what fails without each condition of an equation;
- ``commands PROGRAM``: the help of a program and of each of its commands;
- ``symbols``: the vocabulary, with meanings and units;
- ``scene``: the tables and keys of a scene file;
- ``gallery``: the pictures of the gallery, linked to their pages.
"""

from __future__ import annotations

import re
from collections.abc import Callable

import text_of_commands
import text_of_equations
import text_of_gallery
import text_of_scene
from sphinx.application import Sphinx

_LINE = re.compile(r"^<!-- insert: (\w+) ?(.*?) -->$", re.MULTILINE)

KINDS: dict[str, Callable[..., str]] = {
    "equation": text_of_equations.displayed,
    "equations": text_of_equations.catalogue,
    "conditions": text_of_equations.conditions,
    "commands": text_of_commands.reference,
    "symbols": text_of_equations.symbols,
    "scene": text_of_scene.reference,
    "gallery": text_of_gallery.pictures,
}


def inserted(page: str) -> str:
    """The Markdown of a page with every line that asks for text replaced by it."""
    return _LINE.sub(lambda line: KINDS[line[1]](*line[2].split()), page)


def _on_read(_app: Sphinx, _name: str, content: list[str]) -> None:
    content[0] = inserted(content[0])


def setup(app: Sphinx) -> dict[str, bool]:
    """Have every page read through `inserted`."""
    app.connect("source-read", _on_read)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
