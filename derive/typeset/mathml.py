"""LaTeX as MathML Core, by the converter math-core of the extra ``report``; pages need no script.

Each function raises `ValueError` for LaTeX outside the subset of the converter.
"""

from __future__ import annotations

from functools import cache

from .breaking import broken

#: Commands of amsmath that the converter lacks.
_MACROS = {"substack": r"\begin{gathered}#1\end{gathered}"}


def inline(latex: str) -> str:
    """Return a formula inside a line."""
    return _converted(latex, block=False)


def display(latex: str) -> str:
    """Return a displayed formula."""
    return _converted(latex, block=True)


def block(latex: str) -> str:
    """Return a displayed formula, broken if it is too wide for a page."""
    return display(broken(latex))


@cache
def _converted(latex: str, *, block: bool) -> str:
    from math_core import LatexError, LatexToMathML

    converter = LatexToMathML(macros=_MACROS, fancy_error=False)
    try:
        return str(converter.convert_with_local_state(latex, displaystyle=block))
    except LatexError as error:
        raise ValueError(
            f"the page cannot show this formula ({error}): {latex}\n"
            "the subset that works is listed in math-core's documentation"
        ) from None
