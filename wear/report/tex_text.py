"""Text as LaTeX: specials escaped, letters and signs outside ASCII in a form that pdfTeX sets."""

from __future__ import annotations

_FORMS = str.maketrans(
    {
        "\\": r"\textbackslash{}",
        "{": r"\{",
        "}": r"\}",
        "$": r"\$",
        "&": r"\&",
        "#": r"\#",
        "%": r"\%",
        "_": r"\_",
        "^": r"\textasciicircum{}",
        "~": r"\textasciitilde{}",
        "<": r"\textless{}",
        ">": r"\textgreater{}",
        "|": r"\textbar{}",
        '"': r"\textquotedbl{}",
        "\u2009": r"\,",
        "\u202f": r"\,",
        "\u2010": "-",
        "\u2011": r"\mbox{-}",
        "\u2212": r"\ensuremath{-}",
        "→": r"\ensuremath{\to}",
        "≤": r"\ensuremath{\le}",
        "≥": r"\ensuremath{\ge}",
        "≈": r"\ensuremath{\approx}",
        "∞": r"\ensuremath{\infty}",
    }
)
_TYPED = "\u00a0\u2013\u2014\u2018\u2019\u201c\u201d\u2026·×±°µ²³"
"""Signs that LaTeX sets as they are typed."""
_LATIN = range(0x00C0, 0x0180)


def escape(text: str) -> str:
    r"""The text for LaTeX with utf8 input and T1 fonts.

    >>> print(escape("5 % of p_max – Éric & Söhne"))
    5 \% of p\_max – Éric \& Söhne

    Raises `ValueError` for a character without a form; formulas belong between dollar signs.
    """
    for character in text:
        known = character.isascii() or character in _TYPED or ord(character) in _LATIN
        if not known and ord(character) not in _FORMS:
            raise ValueError(
                f"no LaTeX form for {character!r} (U+{ord(character):04X}) in {text!r}: "
                "write it as a formula or add it to the table in wear.report.tex_text"
            )
    return text.translate(_FORMS)


def verbatim(code: str, width: int) -> str:
    """Code for a `verbatim` environment: lines cut at `width`, the rest indented below."""
    if "\\end{verbatim}" in code:
        raise ValueError("a listing cannot hold the end of its own environment")
    lines = []
    for line in code.rstrip("\n").split("\n"):
        while len(line) > width:
            lines.append(line[:width])
            line = "    " + line[width:]
        lines.append(line)
    return "\n".join(lines)
