"""The logarithm of a number near 1: a repair of SymPy, which decides signs by numerical values.

Overview
    SymPy 1.14 takes ``log(1 + exp(-30))`` for 0, to full accuracy, as the argument is rounded to 1;
    so ``log(1 + exp(-30)) <= 0`` is true to it, and a false claim would follow.  Importing this
    module replaces the entry of the logarithm in SymPy's table of numerical functions.
Key results
    logarithm    the entry: x - 1 for log x, where x is rounded to 1
"""

from __future__ import annotations

from typing import Any

import sympy as sp
from mpmath.libmp import fzero
from sympy.core import evalf

sp.log(3).evalf(2)  # SymPy fills its table before the first value
_OF_SYMPY = evalf.evalf_table[sp.log]


def logarithm(expr: sp.Expr, prec: int, options: dict[str, Any]) -> Any:
    """Return the real and imaginary parts of a logarithm and their accuracies, in SymPy's form.

    SymPy rounds x with ten bits more than are wanted; the quadratic term of log x in x - 1 is below
    the last of these.
    """
    value = _OF_SYMPY(expr, prec, options)
    (x,) = expr.args
    if value is sp.zoo or value[0] != fzero or value[1] is not None or x == 1:
        return value
    return evalf.evalf(sp.Add(-1, x, evaluate=False), prec, options)


evalf.evalf_table[sp.log] = logarithm
