"""Templates of text in the folder of a package, by Jinja2, imported when the first is written.

Key results
    templates    those of a package
    LATEX        the marks of a template of LaTeX, in place of braces
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from jinja2 import Environment

LATEX = {
    "variable_start_string": "<<", "variable_end_string": ">>", "block_start_string": "<%",
    "block_end_string": "%>", "comment_start_string": "<#", "comment_end_string": "#>",
}  # fmt: skip


def templates(package: str, folder: str = "templates", **marks: Any) -> Environment:
    """Return the templates in a folder of a package; an unknown name in them is an error."""
    from jinja2 import Environment, PackageLoader, StrictUndefined

    return Environment(
        loader=PackageLoader(package, folder),
        undefined=StrictUndefined,
        autoescape=False,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        **marks,
    )
