"""A document as the files that a reader gets."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory

from derive.files import write_atomically
from wear.report import html, tex
from wear.report.document import Document
from wear.report.typeset import Typeset, typeset


def published(document: Document) -> tuple[dict[str, str | bytes], Typeset]:
    """Return the files of a document by name, and what came of the PDF: ``report.html``,
    ``report.tex``, ``equations.tex``, every figure as SVG and PDF, and ``report.pdf`` where a TeX
    engine is found."""
    sources = tex.report(document)
    drawings = {f"{label[4:]}.svg": figure.svg for label, figure in document.figures.items()}
    contents = {"report.html": html.page(document), **sources, **drawings}
    with TemporaryDirectory() as name:  # TeX leaves much behind
        for file, content in sources.items():
            write_atomically(Path(name, file), content)
        outcome = typeset(Path(name, "report.tex"))
    if outcome.pdf is not None:
        contents["report.pdf"] = outcome.pdf
    return contents, outcome
