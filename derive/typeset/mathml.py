"""LaTeX to MathML, by the converter math-core where it is installed."""

from __future__ import annotations

from ..faults import UsageError


def mathml(latex: str) -> str:
    """Return a displayed formula in MathML Core; UsageError without the converter."""
    try:
        from math_core import LatexToMathML
    except ImportError:
        raise UsageError(
            "MathML needs the package math-core: pip install 'derive-wear[report]'"
        ) from None
    return str(LatexToMathML().convert_with_local_state(latex, displaystyle=True))
