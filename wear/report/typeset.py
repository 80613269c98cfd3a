"""From ``report.tex`` to ``report.pdf``, where a TeX engine is found."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

#: What the log of a good report does not have. Underfull boxes are harmless.
_WARNING = re.compile(
    r"^(?:LaTeX|Package|Class)\b[^\n:]*? Warning: .*|^pdfTeX warning.*"
    r"|^Overfull \\[hv]box \((\d+\.?\d*)pt.*|^! .*",
    re.MULTILINE,
)
_RERUNS = 3


@dataclass(frozen=True)
class Typeset:
    """The PDF if there is one, the warnings that matter, and a line for the user."""

    pdf: bytes | None
    warnings: tuple[str, ...]
    notice: str

    @property
    def said(self) -> tuple[str, ...]:
        """Return the line, if any, and the warnings."""
        return (self.notice, *self.warnings) if self.notice else self.warnings


def typeset(source: Path, timeout: float = 120.0) -> Typeset:
    """Run pdfTeX beside the source until its references settle.

    Never runs shell escapes. A missing engine and a failed run are a notice, not an error.
    """
    engine = shutil.which("pdflatex")
    if engine is None:
        return Typeset(
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
            return Typeset(None, (), f"TeX did not finish within {timeout:g} s")
        log = source.with_suffix(".log").read_text(encoding="utf-8", errors="replace")
        if done.returncode != 0:
            faults = [line for line in warnings(log) if line.startswith("!")]
            return Typeset(None, warnings(log), f"no report.pdf, TeX says: {' '.join(faults[:1])}")
        if "Rerun to" not in log and "Table widths have changed" not in log:
            break
    return Typeset(source.with_suffix(".pdf").read_bytes(), warnings(log), "")


def warnings(log: str) -> tuple[str, ...]:
    r"""The lines of a TeX log that matter: warnings, errors, boxes too wide by more than 1 pt.

    >>> warnings("Overfull \\hbox (0.4pt too wide) in x\nOverfull \\hbox (9.1pt too wide) in y")
    ('Overfull \\hbox (9.1pt too wide) in y',)
    """
    return tuple(
        match[0] for match in _WARNING.finditer(log) if match[1] is None or float(match[1]) > 1.0
    )
