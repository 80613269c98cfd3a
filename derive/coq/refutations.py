"""Claims of the note that Coq refutes, from the printed forms and steps that contradict them.

Overview
    A refutation has the premises of its step, further ones with the data of the counterexample,
    and the negation of the printed relation.  The lemmas are in ``library/refutations.jinja``.
Key results
    text     the lemmas, from the steps of some equations by id
    NEEDS    the equations that the lemmas rest on
"""

from __future__ import annotations

from collections.abc import Mapping

import sympy as sp

from ..equations import TEXTS, written
from ..results.steady_state import closure, roughness
from ..symbols import symbol
from ..written import read
from .steps import Step
from .theorems import template

NEEDS = ("19", "18", "closure-ratio", "21")

(_EQ_16B,), (_EQ_19,), (_EQ_21,) = (written("printed", TEXTS[each]) for each in ("16b", "19", "21"))

_AT_REST = ("U_a = 0", "f_c = 1/4", "h_0 = 27/25000", "sigma_c0 = 9/25000", "u_cum > 0")
"""Section 4 with the load at rest."""

_M = sp.simplify(2 * _EQ_21.rhs / (1 + sp.tanh(4 - 2 / symbol("f_c"))))
_TOTAL = sp.Eq(symbol("M"), _M, evaluate=False)
_WITH_DATA = ("M = 11 pi/250000", "f_c = 1/4", "H_c > 0")
"""The wear of a cycle at the largest pressure, and (21) with the data of section 4."""

RELATIONS = (_EQ_16B, _EQ_19, _EQ_21, _TOTAL, *map(read, _AT_REST))
"""Relations that contain all quantities of the refutations."""


def text(steps: Mapping[str, Step]) -> str:
    """Return the lemmas; ``steps`` are those of the equations in NEEDS."""
    return "From Interval Require Import Tactic.\n\n" + template("refutations").render(
        drift=steps["19"].parents[0],
        rate=steps["18"],
        ratio=steps["closure-ratio"],
        at_rest=map(read, _AT_REST),
        printed_bracket=_EQ_16B,
        bracket=_EQ_16B.atoms(sp.Limit).pop().args[0],
        line=_EQ_19,
        u_c=symbol("u_c"),
        u_inf=symbol("u_inf"),
        criterion=read("tanh(4 - 2/f_c) > -1"),
        printed_limit=read("f_c > 1/8"),
        data=(_EQ_21, _TOTAL, *map(read, _WITH_DATA)),
        quotient=closure / roughness,
    )
