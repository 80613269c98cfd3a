"""Comparison: what rigorous bounds of the wear rest on.

Overview
    A larger load never gives less wear (``monotonicity``), so the least and the largest load
    bound the wear from both sides.  A compliant support acts like the load
    U_a - p/k, which lies between U_a - p_max/k and U_a.  Means over a cycle are taken at
    equidistant phases; the error is bounded by the size of the rate at complex loads.
Key results
    compliant    the load that a compliant support leaves
    strip        |1 + e^(a + i b)| > 1 while cos b > 0
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import sympy as sp

from ..equations import Proved, stated
from ..hypotheses import Hypothesis
from ..kernel import Judgement
from ..rules.assumption import assume
from ..rules.inequalities import Arithmetic
from .first_integral import UNSATURATED

_a, _cosine = sp.symbols("a c", real=True)

SAME_SIDE = Hypothesis("b is less than a quarter turn", sp.Gt(_cosine, 0))

STRIP = sp.pi / 8
"""Largest |Im h/sigma| at which |phi| <= 1: there |Im(4 h/sigma)| is a quarter turn."""


@dataclass(frozen=True)
class Comparison:
    """Bounds of the load and of the law at complex closures."""

    @cached_property
    def compliant(self) -> Judgement:
        """The load that a compliant support leaves lies between two rigid ones."""
        (claim,) = stated("compliant-load")
        return Arithmetic(claim)(assume(UNSATURATED), name="load and support")

    @cached_property
    def strip(self) -> Judgement:
        """1/(1 + e^z) is less than 1 in modulus while the cosine of Im z is positive."""
        claim = sp.Gt(1 + 2 * sp.exp(_a) * _cosine + sp.exp(2 * _a), 1)
        remark = "the left side is |1 + e^(a + i b)|^2 with c = cos b"
        return Arithmetic(claim)(assume(SAME_SIDE), name="strip of analyticity", remark=remark)


def results() -> dict[str, Proved]:
    """Return what rigorous bounds rest on."""
    comparison = Comparison()
    return {"compliant-load": comparison.compliant, "strip": comparison.strip}
