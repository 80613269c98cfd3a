"""A document as the files that a reader gets."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from derive.files import write_atomically
from wear.report import html, tex
from wear.report.document import Document
from wear.report.typeset import typeset


@dataclass(frozen=True)
class Published:
    """The files written, the warnings of TeX that matter, and a line for the user where there is no
    PDF."""

    files: tuple[Path, ...]
    warnings: tuple[str, ...]
    notice: str


def publish(document: Document, folder: Path) -> Published:
    """Write ``report.html``, ``report.tex``, ``equations.tex``, every figure as SVG and PDF, and
    ``report.pdf`` where a TeX engine is found, into a directory that exists.

    Everything is made before anything is written; each file is there whole or not at all.
    """
    sources = tex.report(document)
    for_tex: dict[str, str | bytes] = {
        "report.tex": sources.report,
        "equations.tex": sources.equations,
        **sources.figures,
    }
    drawings = {f"{label[4:]}.svg": figure.svg for label, figure in document.figures.items()}
    contents: dict[str, str | bytes] = {"report.html": html.page(document), **for_tex, **drawings}
    with TemporaryDirectory() as name:  # TeX leaves much behind
        draft = Path(name)
        for file, content in for_tex.items():
            write_atomically(draft / file, content)
        outcome = typeset(draft / "report.tex")
        if outcome.pdf is not None:
            contents["report.pdf"] = outcome.pdf.read_bytes()
    for file, content in contents.items():
        write_atomically(folder / file, content)
    return Published(tuple(folder / file for file in contents), outcome.warnings, outcome.notice)
