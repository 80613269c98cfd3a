"""Claims of the note that Coq refutes, from the printed forms and steps that contradict them.

Overview
    A refutation has the premises of its step, further ones with the data of the counterexample,
    and the negation of the printed relation.  The lemmas are in ``library/refutations.jinja``.
Key results
    text     the lemmas, from the steps of some equations by id
    NAMES    their names, by the claim of the note that they decide
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

import sympy as sp

from ..equations import TEXTS, written
from ..results.steady_state import closure, roughness
from ..symbols import symbols
from .steps import Step
from .theorems import template

U_a, u_c, u_inf, u_cum = symbols("U_a u_c u_inf u_cum")
f_c, h_0, sigma_c0, M, H_c = symbols("f_c h_0 sigma_c0 M H_c")

NAMES = MappingProxyType(
    {
        "C24": "bracket_is_not_zero",
        "C27": "no_affine_asymptote",
        "C32": "not_a_limit_of_validity",
        "C36": "another_wear_per_cycle",
        "contact": "contact_in_the_long_run",
    }
)
NEEDS = ("19", "18", "closure-ratio", "21")

(_EQ_16B,), (_EQ_19,), (_EQ_21,) = (written("printed", TEXTS[each]) for each in ("16b", "19", "21"))

RELATIONS = (_EQ_16B, _EQ_19, _EQ_21, sp.Gt(M, 0, evaluate=False), sp.Eq(h_0, sigma_c0))
"""Relations that contain all quantities of the refutations."""

_QUARTER = sp.Eq(f_c, sp.Rational(1, 4))
_AT_REST = (
    sp.Eq(U_a, 0, evaluate=False),
    _QUARTER,
    sp.Eq(h_0, sp.Rational(27, 25000)),
    sp.Eq(sigma_c0, sp.Rational(9, 25000)),
    sp.Gt(u_cum, 0, evaluate=False),
)
"""Section 4 with the load at rest."""

_TOTAL = sp.simplify(2 * _EQ_21.rhs / (1 + sp.tanh(4 - 2 / f_c)))
_WITH_DATA = (
    _EQ_21,
    sp.Eq(M, _TOTAL, evaluate=False),
    sp.Eq(M, 44 * sp.pi / 10**6, evaluate=False),
    _QUARTER,
    sp.Gt(H_c, 0, evaluate=False),
)
"""(21) with the data of section 4."""


def text(steps: Mapping[str, Step]) -> str:
    """Return the lemmas; ``steps`` are those of the equations in NEEDS."""
    return template("refutations").render(
        names=NAMES,
        drift=steps["19"],
        rate=steps["18"],
        ratio=steps["closure-ratio"],
        at_rest=_AT_REST,
        printed_bracket=_EQ_16B,
        bracket=_EQ_16B.atoms(sp.Limit).pop().args[0],
        line=_EQ_19,
        u_c=u_c,
        u_inf=u_inf,
        criterion=sp.Gt(sp.tanh(4 - 2 / f_c), -1),
        printed_limit=sp.Gt(f_c, sp.Rational(1, 8)),
        data=_WITH_DATA,
        quotient=closure / roughness,
    )
