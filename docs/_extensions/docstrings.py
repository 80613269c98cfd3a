"""Docstrings as the reference shows them: a closing example is a section of its own.

In the code an example may follow the last section of a docstring without a heading; Sphinx would
take it for a part of that section.
"""

from __future__ import annotations

from typing import Any

from sphinx.application import Sphinx


def with_heading(lines: list[str]) -> list[str]:
    """The lines with the heading "Examples" before a first example that has none."""
    starts = [i for i, line in enumerate(lines) if line.startswith(">>>")]
    if not starts or "Examples" in lines or "------" not in "".join(lines):
        return lines
    return [*lines[: starts[0]], "Examples", "--------", *lines[starts[0] :]]


def _on_docstring(
    _app: Sphinx, _what: str, _name: str, _of: Any, _opts: Any, lines: list[str]
) -> None:
    lines[:] = with_heading(lines)


def setup(app: Sphinx) -> dict[str, bool]:
    """Have every docstring pass through `with_heading`, before its sections are read."""
    app.connect("autodoc-process-docstring", _on_docstring, priority=100)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
