"""Sections 2.6 and 3: problems (i) and (ii), and the order in which their unknowns follow.

Overview
    (7) has one more unknown than equations: either the reaction R_a of the pin is given, or its
    displacement U_a.  Each problem is a list of statements, in an order in which every
    statement determines one more field from the preceding ones.
Key results
    problem_i      given load: statements in the order in which the fields follow
    problem_ii     given motion
    undetermined   the faults of an order; neither problem has any
"""

from __future__ import annotations

from collections.abc import Iterable

import sympy as sp
from sympy.core.function import AppliedUndef

from ..hypotheses import UNSATURATED, Hypothesis
from ..kernel import Judgement
from ..results.first_integral import log_odds_of
from ..rules.algebra import Solve
from ..rules.assumption import assume
from ..rules.inequalities import Arithmetic
from ..symbols import symbols, t
from .condensed import two_solids

h, p, p_max, R_a, U_a, b, L = symbols("h p p_max R_a U_a b L")

CARRIED = Hypothesis(sp.And(R_a > 0, R_a < p_max * b * L))
"""The contact can carry the load."""

_model = two_solids()
_roughness = (_model.roughness_of_pin, _model.roughness_of_bearing, _model.roughness)
_u_a_rate, _, _u_c_rate, _ = _model.wear_laws
_pressure = Solve(p)(_model.reaction)
_unsaturated = Arithmetic(UNSATURATED.relation)(_pressure, assume(CARRIED))

problem_i = (
    _pressure,
    _u_a_rate,
    _u_c_rate,
    *_roughness,
    _model.deflection,
    Solve(h)(log_odds_of(_unsaturated)),
    Solve(U_a)(_model.closure),
)
"""The reaction R_a of the pin is given: the pressure is prescribed, and wear follows directly."""

problem_ii = (
    _model.scalar,
    _model.wear_of_pin,
    *_roughness,
    _model.pressure_from_rate,
    _model.deflection,
    _model.closure,
    Solve(R_a)(_model.reaction),
)
"""The displacement U_a of the pin is given: the condensed problem gives the wear."""


def undetermined(given: sp.Expr, order: Iterable[Judgement]) -> tuple[str, ...]:
    """Return the fields that an order of statements uses too early; empty if every field follows.

    A field may follow from its own rate, by integration in time from (6).

    >>> undetermined(R_a, problem_i), undetermined(U_a, problem_ii)
    ((), ())
    """
    known = {given}
    faults = []
    for statement in order:
        left, right = statement.claim.lhs, statement.claim.rhs
        unknown = left.expr if isinstance(left, sp.Derivative) else left
        integrated = {unknown} if isinstance(left, sp.Derivative) else set()
        needs = {f for f in right.atoms(AppliedUndef) if f.args == (t,)}
        rates = {d.expr for d in right.atoms(sp.Derivative)} - integrated
        early = sorted((needs | rates) - known - integrated, key=str)
        faults += [f"{unknown} needs {field} before it is known" for field in early]
        known.add(unknown)
    return tuple(faults)
