"""The load, and what may be supposed of it."""

from __future__ import annotations

import sympy as sp

from .hypotheses import Hypothesis, Kind
from .symbols import rate, symbol, t

LOAD, T = symbol("U_a"), symbol("T")

PERIODIC = Hypothesis(
    "load of period T",
    sp.Eq(LOAD.subs(t, t + T), LOAD),
    r"\text{load of period}\; T",
    Kind.LOAD,
)
CONSTANT = Hypothesis(
    "constant load",
    sp.Eq(LOAD, LOAD.subs(t, 0)),
    r"\text{constant load}",
    Kind.LOAD,
)
SINE = Hypothesis(
    "load U sin(2 pi t/T)",
    sp.Eq(LOAD, symbol("U") * sp.sin(2 * sp.pi * t / T)),
    r"U_a = U \sin{\left(2 \pi t/T\right)}",
    Kind.LOAD,
)
CONTINUOUS = Hypothesis("continuous load", kind=Kind.LOAD)
DIFFERENTIABLE = Hypothesis(
    "differentiable load",
    sp.Eq(rate("U_a"), rate("U_a"), evaluate=False),
    r"\text{differentiable load}",
    Kind.LOAD,
)
"""It says that the rate has a value."""
