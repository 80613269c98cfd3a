"""Algebra at an instant: moves whose claim holds wherever the parents do.

Key results
    Substitute, SolveFor, Rearrange, Multiply    equations
    Specialise, Restrict                         particular cases
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp
from sympy.core.relational import Relational

from ..sample import Source
from ..zero import is_zero
from . import Pointwise, RuleError


@dataclass(frozen=True)
class Substitute(Pointwise):
    """Insert ``left = right`` of each further parent into the first, in order."""

    def apply(self, parents: tuple[sp.Basic, ...]) -> sp.Basic:
        claim, *definitions = parents
        for definition in definitions:
            if not claim.has(definition.lhs):
                raise RuleError(f"{definition.lhs} does not occur in {claim}")
            claim = claim.subs(definition.lhs, definition.rhs)
        return claim


@dataclass(frozen=True)
class SolveFor(Pointwise):
    """Solve an equation that is linear in ``unknown``."""

    unknown: sp.Expr

    def apply(self, parents: tuple[sp.Basic, ...]) -> sp.Basic:
        (claim,) = parents
        return sp.Eq(self.unknown, Source.of(claim, self.unknown).value)


@dataclass(frozen=True)
class Rearrange(Pointwise):
    """Move terms between the sides of an equation: left minus right stays what it was."""

    claim: sp.Equality

    def apply(self, parents: tuple[sp.Basic, ...]) -> sp.Basic:
        (parent,) = parents
        if not is_zero((parent.lhs - parent.rhs) - (self.claim.lhs - self.claim.rhs)):
            raise RuleError(f"{self.claim} is not {parent} rearranged")
        return self.claim


@dataclass(frozen=True)
class Multiply(Pointwise):
    """Multiply both sides by a factor that cannot vanish."""

    factor: sp.Expr

    def apply(self, parents: tuple[sp.Basic, ...]) -> sp.Basic:
        (claim,) = parents
        if not self.factor.is_nonzero:
            raise RuleError(f"{self.factor} may vanish")
        return sp.Eq(self.factor * claim.lhs, self.factor * claim.rhs)


@dataclass(frozen=True)
class Specialise(Pointwise):
    """Give parameters particular values."""

    values: tuple[tuple[sp.Expr, sp.Expr], ...]

    def apply(self, parents: tuple[sp.Basic, ...]) -> sp.Basic:
        (claim,) = parents
        return claim.subs(dict(self.values)).doit()


@dataclass(frozen=True)
class Restrict(Pointwise):
    """Keep the branch of a piecewise claim, or of a modulus, on which ``condition`` holds."""

    condition: Relational

    def apply(self, parents: tuple[sp.Basic, ...]) -> sp.Basic:
        (claim,) = parents
        branch = claim.replace(
            lambda e: isinstance(e, sp.Piecewise) and e.args[0].cond == self.condition,
            lambda e: e.args[0].expr,
        )
        if self.condition.gts != 0 and self.condition.lts == 0:
            branch = branch.xreplace({sp.Abs(self.condition.gts): self.condition.gts})
        return branch
