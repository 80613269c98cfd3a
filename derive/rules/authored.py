"""Claims that are authored, then proved: identities and inequalities.

Key results
    Identity    an equation that holds for every value of its unknowns
    Inserted    an equation that its parents turn into an identity
    LogOdds     a logarithm, proved from its exponential
    Positive    inequalities, proved from the signs of the symbols
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import sympy as sp
from sympy.core.relational import Relational

from ..check import Check
from ..zero import is_zero
from . import Authored, proof, sampled

if TYPE_CHECKING:
    from ..statement import Statement


@dataclass(frozen=True)
class Identity(Authored):
    """An authored equation that holds for every value of its unknowns, by exact rewriting."""

    def check(self, statement: Statement) -> tuple[Check, ...]:
        claim = statement.claim
        proved = claim == sp.true or (
            isinstance(claim, sp.Equality) and is_zero(claim.lhs - claim.rhs)
        )
        return proof(proved, "left minus right reduces to 0"), sampled(statement)


def insert(expr: sp.Expr, statements: tuple[Statement, ...]) -> sp.Expr:
    """Insert ``left = right`` of each statement, in order."""
    for statement in statements:
        expr = expr.subs(statement.claim.lhs, statement.claim.rhs)
    return expr


@dataclass(frozen=True)
class Inserted(Authored):
    """An authored equation that becomes an identity when its parents are inserted, in order.

    ``pivot``: what later samples compute from this equation instead of from its parents.
    """

    pivot: sp.Expr | None = None

    def pivot_of(self, claim: sp.Basic) -> sp.Expr | None:
        return self.pivot

    def check(self, statement: Statement) -> tuple[Check, ...]:
        claim = statement.claim
        rest = insert(claim.lhs - claim.rhs, statement.parents)
        detail = "the parents, inserted, reduce left minus right to 0"
        from_parents = replace(statement, rule=Inserted())
        return proof(is_zero(rest), detail), sampled(from_parents)


@dataclass(frozen=True)
class LogOdds(Authored):
    """An authored ``ln a = b`` of reals, proved as ``a = e^b`` with the parents inserted."""

    def check(self, statement: Statement) -> tuple[Check, ...]:
        claim = statement.claim
        inside = insert(claim.lhs.args[0], statement.parents)
        proved = claim.lhs.func == sp.log and is_zero(inside - sp.exp(claim.rhs))
        return proof(proved, "its exponential is an identity"), sampled(statement)


@dataclass(frozen=True)
class Positive(Authored):
    """Authored inequalities, proved from the signs of the symbols.

    ``parametrisation`` maps symbols onto expressions in positive symbols that range over the
    whole domain (``p -> p_max y/(1 + y)`` for 0 < p < p_max), which makes signs manifest.
    """

    parametrisation: tuple[tuple[sp.Expr, sp.Expr], ...] = ()

    def check(self, statement: Statement) -> tuple[Check, ...]:
        claim = statement.claim
        parts = claim.args if isinstance(claim, sp.And) else (claim,)
        proved = all(self._proved(part) for part in parts)
        return proof(proved, "a sum of terms of one sign"), sampled(statement)

    def _proved(self, part: Relational) -> bool:
        difference = (part.gts - part.lts).subs(dict(self.parametrisation))
        strict = isinstance(part, (sp.StrictGreaterThan, sp.StrictLessThan))
        for form in _forms(difference):
            if form.is_positive or (not strict and form.is_nonnegative):
                return True
        return False


def _forms(difference: sp.Expr) -> list[sp.Expr]:
    """Return equal forms of an expression, one of which may show its sign."""
    exponential = difference.rewrite(sp.exp)
    numerator, denominator = sp.fraction(sp.together(exponential))
    quotient = sp.expand(numerator) / sp.factor(denominator)
    return [difference, exponential, quotient, sp.factor(exponential)]
