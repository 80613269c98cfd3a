r"""The document as LaTeX: ``report.tex``, which inputs ``equations.tex``, and its figures.

Overview
    `report` writes all files. ``equations.tex`` holds one macro for each equation that the text
    shows, so that other reports may ``\input`` the same file. Equations carry their numbers as
    tags; sections, figures and tables are numbered by LaTeX itself, and a test compares the outcome
    with `wear.report.document`. The frame is ``templates/report.tex``; ``templates/blocks.tex`` has
    the macros of the tokens.
"""

from __future__ import annotations

import re
import unicodedata
from functools import partial

from derive.templates import LATEX, templates
from derive.typeset.breaking import broken
from wear.cite import listed
from wear.report.document import Document
from wear.report.writer import Writer

#: Characters of ``\footnotesize\ttfamily`` in a line of text.
_LISTING_WIDTH = 96

_FORMS = str.maketrans({
    "\\": r"\textbackslash{}", "{": r"\{", "}": r"\}", "$": r"\$", "&": r"\&", "#": r"\#",
    "%": r"\%", "_": r"\_", "^": r"\textasciicircum{}", "~": r"\textasciitilde{}",
    "<": r"\textless{}", ">": r"\textgreater{}", "|": r"\textbar{}", '"': r"\textquotedbl{}",
    "\u2009": r"\,", "\u202f": r"\,", "\u2010": "-", "\u2011": r"\mbox{-}",
    "\u2212": r"\ensuremath{-}", "→": r"\ensuremath{\to}", "≤": r"\ensuremath{\le}",
    "≥": r"\ensuremath{\ge}", "≈": r"\ensuremath{\approx}", "∞": r"\ensuremath{\infty}",
    "λ": r"\ensuremath{\lambda}", "Λ": r"\ensuremath{\Lambda}",
})  # fmt: skip
for _letter in "αβγδεζηθικμνξπρστυφχψωΓΔΘΞΠΣΥΦΨΩ":
    _name = unicodedata.name(_letter).split()[-1]
    _macro = _name.lower() if _letter.islower() else _name.capitalize()
    _FORMS[ord(_letter)] = rf"\ensuremath{{\{_macro}}}"
_TYPED = "\u00a0\u2013\u2014\u2018\u2019\u201c\u201d\u2026·×±°µ²³"
"""Signs that LaTeX sets as they are typed."""
_LATIN = range(0x00C0, 0x0180)


def report(document: Document) -> dict[str, str | bytes]:
    """Return all files of the report, by name.

    Raises
    ------
    ValueError
        for references that lead nowhere.
    """
    body = Writer(document, _TEMPLATES.get_template("blocks.tex")).written(document.tokens)
    title = re.sub(
        r"[^A-Za-z0-9À-ÖØ-öø-ÿ ,.:()\-]", "", document.title
    )  # an entry of the PDF, not typeset
    source = _TEMPLATES.get_template("report.tex").render(title=title, body=body)
    figures = {f"{label[4:]}.pdf": figure.pdf for label, figure in document.figures.items()}
    return {"report.tex": source, "equations.tex": equations(document), **figures}


def equations(document: Document) -> str:
    """Return one macro for each equation: the formula alone, to be set in any display."""
    writer = Writer(document, _TEMPLATES.get_template("blocks.tex"))
    lines = ["% Formulas of the report, one macro each. Needs amsmath and amssymb."]
    for shown in document.shown:
        if not (shown.macro.isascii() and shown.macro.isalpha()):
            raise ValueError(f"{shown.id}: a macro's name has letters only, not {shown.macro!r}")
        title = writer.of_line(shown.title)
        lines.append(f"% ({document.marks[f'eq:{shown.id}'].number}) {title}")
        lines.append(f"\\providecommand{{\\{shown.macro}}}{{{broken(shown.latex)}}}")
    return "\n".join(lines) + "\n"


def escape(text: str) -> str:
    r"""Return the text for LaTeX with utf8 input and T1 fonts; a character without a form by its
    number.

    >>> print(escape("5 % of p_max – Éric & Söhne, 中"))
    5 \% of p\_max – Éric \& Söhne, [U+4E2D]
    """
    return "".join(c if ord(c) in _FORMS else _typed(c) for c in text).translate(_FORMS)


def _typed(character: str) -> str:
    known = character.isascii() or character in _TYPED or ord(character) in _LATIN
    return character if known else f"[U+{ord(character):04X}]"


def verbatim(code: str, width: int) -> str:
    """Return code for a `verbatim` environment, which it cannot end: lines cut at `width`, the rest
    indented below, a character that cannot be typed by its number."""
    lines = []
    for line in code.rstrip("\n").replace("\\end{verbatim}", "\\end {verbatim}").split("\n"):
        line = "".join(map(_typed, line))
        while len(line) > width:
            lines.append(line[:width])
            line = "    " + line[width:]
        lines.append(line)
    return "\n".join(lines)


def _code(text: str) -> str:
    """Return code, which may be broken after the signs that join its parts."""
    return "".join(escape(c) + (r"\allowbreak{}" if c in "/._-=" else "") for c in text)


_TEMPLATES = templates("wear.report", **LATEX)
_TEMPLATES.filters |= {
    "tex": escape,
    "code": _code,
    "url": lambda text: re.sub("[%#&]", r"\\\g<0>", text),
    "words": lambda text: text.replace("-", " "),
    "broken": broken,
    "verbatim": partial(verbatim, width=_LISTING_WIDTH),
    "listed": listed,
}
