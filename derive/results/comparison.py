"""Comparison: the foundations of rigorous bounds of the wear.

Overview
    A larger load never gives less wear (``monotonicity``), so the least and the largest load
    bound the wear from both sides.  A compliant support reduces the load to U_a - p/k, which
    lies between U_a - p_max/k and U_a.  Means over a cycle are taken at equidistant phases;
    the error is bounded by the size of the rate at complex loads.
Key results
    compliant_load   the effective load on a compliant support
    strip            |1 + e^(a + i b)| > 1 while cos b > 0
"""

from __future__ import annotations

import sympy as sp

from ..equations import stated
from ..hypotheses import UNSATURATED, Hypothesis
from ..rules.assumption import assume
from ..rules.inequalities import Arithmetic

_a, _cosine = sp.symbols("a c", real=True)

SAME_SIDE = Hypothesis(sp.Gt(_cosine, 0))

STRIP = sp.pi / 8
"""Largest |Im h/sigma| at which |phi| <= 1: there |Im(4 h/sigma)| is a quarter turn."""

compliant_load = Arithmetic(*stated("compliant-load"))(assume(UNSATURATED), name="load and support")
"""The effective load on a compliant support lies between two loads on a rigid one."""

strip = Arithmetic(sp.Gt(1 + 2 * sp.exp(_a) * _cosine + sp.exp(2 * _a), 1))(
    assume(SAME_SIDE),
    name="strip of analyticity",
    remark="the left side is |1 + e^(a + i b)|^2 with c = cos b",
)
"""1/(1 + e^z) is less than 1 in modulus while the cosine of Im z is positive."""
