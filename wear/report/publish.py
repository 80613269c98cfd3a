r"""The files of a document, ``report.pdf`` among them where TeX is found, and ``manifest.json``:
the data that reproduce and verify them."""

from __future__ import annotations

import hashlib
import os
import platform
import re
import shutil
import subprocess
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from derive.files import write_atomically
from wear.benchmark.machine import installed
from wear.report import html, tex
from wear.report.document import Document
from wear.scene import Scene

#: Packages whose version can change a digit or a page.
PACKAGES = (
    "derive-wear", "numpy", "scipy", "sympy", "mpmath", "python-flint", "matplotlib", "math-core",
)  # fmt: skip

#: Lines that the log of a good report does not have. Underfull boxes are harmless.
_WARNING = re.compile(
    r"^(?:LaTeX|Package|Class)\b[^\n:]*? Warning: .*|^pdfTeX warning.*"
    r"|^Overfull \\[hv]box \((\d+\.?\d*)pt.*|^! .*",
    re.MULTILINE,
)
_RERUNS = 3


@dataclass(frozen=True)
class PdfOutcome:
    """The PDF if there is one, the warnings that matter, and a line for the user."""

    pdf: bytes | None
    warnings: tuple[str, ...]
    notice: str

    @property
    def notices(self) -> tuple[str, ...]:
        """Return the line, if any, and the warnings."""
        return (self.notice, *self.warnings) if self.notice else self.warnings


def published(document: Document) -> tuple[dict[str, str | bytes], PdfOutcome]:
    """Return the files of a document by name, and the outcome of the PDF: ``report.html``,
    ``report.tex``, ``equations.tex``, every figure as SVG and PDF, and ``report.pdf`` where a TeX
    engine is found."""
    sources = tex.report(document)
    drawings = {f"{label[4:]}.svg": figure.svg for label, figure in document.figures.items()}
    contents = {"report.html": html.page(document), **sources, **drawings}
    with TemporaryDirectory() as name:  # TeX writes many auxiliary files
        for file, content in sources.items():
            write_atomically(Path(name, file), content)
        outcome = typeset(Path(name, "report.tex"))
    if outcome.pdf is not None:
        contents["report.pdf"] = outcome.pdf
    return contents, outcome


def typeset(source: Path, timeout: float = 120.0) -> PdfOutcome:
    """Run pdfTeX beside the source until its references settle.

    Never runs shell escapes. A missing engine and a failed run are a notice, not an error.
    """
    engine = shutil.which("pdflatex")
    if engine is None:
        return PdfOutcome(
            None, (), "no TeX engine on the PATH: install texlive-latex-recommended for report.pdf"
        )
    command = [engine, "-interaction=nonstopmode", "-halt-on-error", "-no-shell-escape"]
    for _ in range(_RERUNS):
        try:
            done = subprocess.run(
                [*command, source.name],
                cwd=source.parent,
                env={**os.environ, "max_print_line": "1000"},  # else the log breaks its lines
                capture_output=True,
                timeout=timeout,
            )
        except subprocess.TimeoutExpired:
            return PdfOutcome(None, (), f"TeX did not finish within {timeout:g} s")
        log = source.with_suffix(".log").read_text(encoding="utf-8", errors="replace")
        if done.returncode != 0:
            faults = [line for line in warnings(log) if line.startswith("!")]
            return PdfOutcome(
                None, warnings(log), f"no report.pdf, TeX says: {' '.join(faults[:1])}"
            )
        if "Rerun to" not in log and "Table widths have changed" not in log:
            break
    return PdfOutcome(source.with_suffix(".pdf").read_bytes(), warnings(log), "")


def warnings(log: str) -> tuple[str, ...]:
    r"""Return the lines of a TeX log that matter: warnings, errors, boxes too wide by over 1 pt.

    >>> warnings("Overfull \\hbox (0.4pt too wide) in x\nOverfull \\hbox (9.1pt too wide) in y")
    ('Overfull \\hbox (9.1pt too wide) in y',)
    """
    return tuple(
        match[0] for match in _WARNING.finditer(log) if match[1] is None or float(match[1]) > 1.0
    )


def manifest(
    contents: Mapping[str, str | bytes], scenes: Mapping[str, Scene], command: str
) -> dict[str, Any]:
    """Return versions, platform in general terms, command, scenes, and the SHA-256 of every
    file."""
    data = {name: x.encode() if isinstance(x, str) else x for name, x in contents.items()}
    return {
        "command": command,
        "versions": versions(),
        "platform": {"system": platform.system(), "machine": platform.machine()},
        "scenes": {name: scene.to_tables() for name, scene in sorted(scenes.items())},
        "sha256": {name: hashlib.sha256(data[name]).hexdigest() for name in sorted(data)},
    }


def versions() -> dict[str, str]:
    """Return the versions of Python and of the packages that are installed."""
    return {"python": platform.python_version(), **installed(PACKAGES)}
