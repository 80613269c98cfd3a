"""Formulas as MathML, by the converter math-core (MathML Core, no script on the page)."""

from __future__ import annotations

from functools import lru_cache

from math_core import LatexError, LatexToMathML

from derive.typeset.breaking import broken

#: Commands of amsmath that the converter lacks.
_MACROS = {"substack": r"\begin{gathered}#1\end{gathered}"}
_CONVERTER = LatexToMathML(macros=_MACROS, fancy_error=False)


def inline(latex: str) -> str:
    """A formula inside a line. Raises `ValueError` for LaTeX outside the subset."""
    return _convert(latex, block=False)


def block(latex: str) -> str:
    """A displayed formula, broken where it is too wide (`derive.typeset.breaking`)."""
    return _convert(broken(latex), block=True)


@lru_cache(maxsize=4096)
def _convert(latex: str, *, block: bool) -> str:
    try:
        return _CONVERTER.convert_with_local_state(latex, displaystyle=block)
    except LatexError as error:
        raise ValueError(
            f"the page cannot show this formula ({error}): {latex}\n"
            "the subset that works is listed in math-core's documentation"
        ) from None
