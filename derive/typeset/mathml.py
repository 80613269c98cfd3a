"""LaTeX to MathML, by the converter math-core of the extra ``report``."""

from __future__ import annotations


def mathml(latex: str) -> str:
    """Return a displayed formula in MathML Core."""
    from math_core import LatexToMathML

    return str(LatexToMathML().convert_with_local_state(latex, displaystyle=True))
