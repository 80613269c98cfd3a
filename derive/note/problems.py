"""Section 2.6 and 3: problems (i) and (ii), and which unknowns follow from which.

Overview
    (7) has one more unknown than equations: either the reaction R_a of the pin is given, or its
    displacement U_a.  Each problem is a list of statements, in an order in which every
    statement determines one more field from those before it.
Key results
    Problem         what is given, and the order in which the fields follow
    given_load      (i): the pressure is prescribed, and wear follows directly
    given_motion    (ii): the condensed problem gives the wear, and all else follows from it
    undetermined    what is wrong with an order; nothing, for both
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp
from sympy.core.function import AppliedUndef

from ..equations import Proved
from ..hypotheses import Hypothesis, Kind
from ..kernel import Judgement
from ..results.first_integral import UNSATURATED, FirstIntegral
from ..rules.algebra import Solve, discharge
from ..rules.assumption import assume
from ..symbols import symbols, t
from .condensed import (
    Condensed,
)
from .governing import Model

h, p, p_max, R_a, U_a, b, L = symbols("h p p_max R_a U_a b L")

CARRIED = Hypothesis(
    "the contact can carry the load", sp.And(R_a > 0, R_a < p_max * b * L), kind=Kind.STATE
)


@dataclass(frozen=True)
class Problem:
    """A given field, and statements that determine the others one after the other.

    A field may follow from its own rate of change, that is by integration in time from (6).
    """

    id: str
    title: str
    given: sp.Expr
    order: tuple[Judgement, ...]

    @property
    def unknowns(self) -> tuple[sp.Expr, ...]:
        """Return the fields in the order in which they are determined."""
        return tuple(_determined(statement) for statement in self.order)


def _determined(statement: Judgement) -> sp.Expr:
    left = statement.claim.lhs
    return left.expr if isinstance(left, sp.Derivative) else left


def undetermined(problem: Problem) -> tuple[str, ...]:
    """Return what an order uses before it has it; empty when every field follows.

    >>> undetermined(given_load()), undetermined(given_motion())
    ((), ())
    """
    known = {problem.given}
    faults = []
    for statement in problem.order:
        unknown = _determined(statement)
        own = {unknown} if isinstance(statement.claim.lhs, sp.Derivative) else set()
        needs = {f for f in statement.claim.rhs.atoms(AppliedUndef) if f.args == (t,)}
        rates = {d.expr for d in statement.claim.rhs.atoms(sp.Derivative)} - own
        early = sorted((needs | rates) - known - own, key=str)
        faults += [f"{unknown} needs {field} before it is known" for field in early]
        known.add(unknown)
    return tuple(faults)


def given_load(model: Model | None = None) -> Problem:
    """Problem (i): the reaction R_a of the pin is given."""
    model = model or Model()
    carried = assume(CARRIED)
    pressure = Solve(p)(model.reaction)
    closure = Solve(h)(FirstIntegral(model.law).log_odds)
    u_a_rate, _, u_c_rate, _ = model.wear_laws
    order = (
        pressure,
        u_a_rate,
        u_c_rate,
        model.roughness_of_pin,
        model.roughness_of_bearing,
        model.roughness,
        Condensed(model).deflection,
        discharge(closure, UNSATURATED, pressure, carried),
        Solve(U_a)(model.closure),
    )
    return Problem("problem-i", "given load: the pressure is prescribed", R_a, order)


def given_motion(model: Model | None = None) -> Problem:
    """Problem (ii): the displacement U_a of the pin is given."""
    model = model or Model()
    condensed = Condensed(model)
    order = (
        condensed.scalar,
        model.wear_of_pin,
        model.roughness_of_pin,
        model.roughness_of_bearing,
        model.roughness,
        condensed.pressure_from_rate,
        condensed.deflection,
        model.closure,
        Solve(R_a)(model.reaction),
    )
    return Problem("problem-ii", "given displacement: the pressure is free", U_a, order)


def results() -> dict[str, Proved]:
    """Return both problems as systems, in the order in which the fields follow."""
    return {"problem-i": given_load().order, "problem-ii": given_motion().order}
