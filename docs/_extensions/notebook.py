"""A notebook from a script: `python docs/_extensions/notebook.py docs/tour.py` writes tour.ipynb.

The script is what is written and reviewed; its cells are run here and their outputs stored. Cells
begin with ``# %%`` (code; what follows on the line describes the figure that it shows) or
``# %% [markdown]`` (text, commented).  A test runs the cells again and compares.
"""

from __future__ import annotations

import ast
import code
import io
import json
import re
import sys
from contextlib import redirect_stdout
from pathlib import Path
from typing import Any, NamedTuple

_CELL = re.compile(r"^# %%(.*)$", re.MULTILINE)
_COMMENT = re.compile(r"^# ?", re.MULTILINE)


class Cell(NamedTuple):
    """One cell: `kind` is "markdown" or "code"; `title` describes the figure that it shows."""

    kind: str
    title: str
    source: str


def cells(script: str) -> list[Cell]:
    """The cells of a script; what stands before the first is left out."""
    pieces = _CELL.split(script)[1:]
    pairs = zip(pieces[::2], pieces[1::2], strict=True)
    return [_cell(head.strip(), body.strip()) for head, body in pairs]


def _cell(head: str, body: str) -> Cell:
    if head == "[markdown]":
        return Cell("markdown", "", _COMMENT.sub("", body))
    return Cell("code", head, body)


class _Session(code.InteractiveInterpreter):
    """Runs cells one after the other, as a kernel does; a cell that fails stops it."""

    def showtraceback(self) -> None:
        raise  # called where the fault is being handled

    def run(self, source: str) -> list[dict[str, Any]]:
        """Run one cell; return its outputs: what it printed, and the value of its last line."""
        body = ast.parse(source).body
        last = [body.pop()] if body and isinstance(body[-1], ast.Expr) else []
        shown: list[Any] = []
        printed = io.StringIO()
        before, sys.displayhook = sys.displayhook, shown.append
        try:
            with redirect_stdout(printed):
                self.runcode(compile(ast.Module(body, []), "<cell>", "exec"))
                self.runcode(compile(ast.Interactive(last), "<cell>", "single"))
        finally:
            sys.displayhook = before
        outputs = []
        if printed.getvalue():
            outputs.append(_stream(printed.getvalue()))
        return outputs + [_result(value) for value in shown if value is not None]


def _stream(text: str) -> dict[str, Any]:
    return {"name": "stdout", "output_type": "stream", "text": _lines(text)}


def _result(value: Any) -> dict[str, Any]:
    from matplotlib.figure import Figure

    from wear import figure_style

    if isinstance(value, Figure):
        drawn = figure_style.encoded(value, ".svg").decode()
        data = {"image/svg+xml": _lines(drawn), "text/plain": ["<Figure>"]}
    elif hasattr(value, "_repr_latex_"):
        data = {"text/latex": _lines(value._repr_latex_()), "text/plain": _lines(repr(value))}
    else:
        data = {"text/plain": _lines(repr(value))}
    return {"data": data, "metadata": {}, "output_type": "display_data"}


def _lines(text: str) -> list[str]:
    return text.splitlines(keepends=True)


def notebook(script: str) -> dict[str, Any]:
    """The notebook of a script, executed, in the form of nbformat 4.5."""
    session = _Session()
    made = []
    executions = 0
    for index, cell in enumerate(cells(script), start=1):
        entry: dict[str, Any] = {
            "cell_type": cell.kind,
            "id": f"cell-{index}",
            "metadata": {"title": cell.title} if cell.title else {},
            "source": _lines(cell.source),
        }
        if cell.kind == "code":
            executions += 1
            entry |= {"execution_count": executions, "outputs": session.run(cell.source)}
        made.append(entry)
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    metadata = {"kernelspec": kernel, "language_info": {"name": "python"}}
    return {"cells": made, "metadata": metadata, "nbformat": 4, "nbformat_minor": 5}


def main(path: Path) -> None:
    """Write the notebook beside its script."""
    made = notebook(path.read_text(encoding="utf-8"))
    text = json.dumps(made, indent=1, ensure_ascii=False, sort_keys=True)
    path.with_suffix(".ipynb").write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
