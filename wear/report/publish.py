"""A document as the files that a reader gets."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory

from derive.files import write_atomically
from wear.report import html, tex
from wear.report.document import Document
from wear.report.typeset import Typeset, typeset


def publish(document: Document, folder: Path) -> Typeset:
    """Write ``report.html``, ``report.tex``, ``equations.tex``, every figure as SVG and PDF, and
    ``report.pdf`` where a TeX engine is found, into a directory that exists; return what came of
    the PDF.

    Everything is made before anything is written; each file is there whole or not at all.
    """
    sources = tex.report(document)
    drawings = {f"{label[4:]}.svg": figure.svg for label, figure in document.figures.items()}
    contents = {"report.html": html.page(document), **sources, **drawings}
    with TemporaryDirectory() as name:  # TeX leaves much behind
        draft = Path(name)
        for file, content in sources.items():
            write_atomically(draft / file, content)
        outcome = typeset(draft / "report.tex")
    if outcome.pdf is not None:
        contents["report.pdf"] = outcome.pdf
    for file, content in contents.items():
        write_atomically(folder / file, content)
    return outcome
