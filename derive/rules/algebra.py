"""Algebra at an instant: claims that hold wherever the premises do.

Key results
    substitute, Solve    equations
    Insert               an equation that an author writes, to be proved
    Consequence          the same relation in another form
"""

from __future__ import annotations

import sympy as sp

from ..claims import Claim, Equality, Inequality, Limit, Property, claim_of
from ..kernel import Conclusion, Judgement, Rule, RuleError
from ..parts import bound_in, nonzero
from ..symbols import t
from ..zero import is_zero
from .proving import coefficients, lasts, require
from .reading import equality, replaced
from .theorem import Theorem


class Substitute(Rule):
    """A claim and ``l = r`` give the claim with r for l."""

    words = "Insert {others} into {0}."
    premise_names = ("the claim", "an equality")

    def conclude(self, *premises: Judgement) -> Conclusion:
        first, *definitions = premises
        claim = first.claim
        for definition in definitions:
            known = equality(definition)
            if not claim.relation.has(known.lhs):
                raise RuleError(f"{known.lhs} does not occur in {claim.relation}")
            variable = getattr(claim, "variable", t)
            taken = variable != t and known.relation.has(variable)
            if taken or known.lhs in bound_in(claim.relation) | {variable} - {t}:
                raise RuleError(f"missing premise: {known.lhs} may take every value")
            claim = _put(claim, known, lasts(definition))
        return Conclusion(claim)


def _put(claim: Claim, known: Equality, always: bool) -> Claim:
    if isinstance(claim, Property) and not always:
        raise RuleError(f"missing premise: {known.lhs} = {known.rhs} at every time")
    result = claim.map(lambda side: replaced(side, known.lhs, known.rhs, always))
    if result.relation.has(sp.zoo, sp.nan):
        raise RuleError(f"{claim.relation} has no value for {known.lhs} = {known.rhs}")
    return result


substitute = Substitute()


class Solve(Theorem):
    """``a x + b = c x + d`` with ``a != c`` gives x; further premises show that ``a != c``."""

    unknown: sp.Expr
    words = "Solve {0} for {unknown}."
    premise_names = ("the equation",)

    def prove(self, *premises: Judgement) -> Conclusion:
        given = equality(premises[0])
        parts = coefficients(given.lhs - given.rhs, self.unknown)
        if parts is None:
            raise RuleError(f"missing premise: {given.relation} is linear in {self.unknown}")
        slope, rest = parts
        require(nonzero(slope), *premises)
        value = given.rhs
        if given.lhs != self.unknown or value.has(self.unknown):
            value = -rest / slope
        return Conclusion(Equality(self.unknown, value))


def inserted(expr: sp.Expr, premises: tuple[Judgement, ...]) -> sp.Expr:
    """Insert ``left = right`` of equalities, and finite limits, in order."""
    for premise in premises:
        claim = premise.claim
        if isinstance(claim, Equality):
            expr = replaced(expr, claim.lhs, claim.rhs, lasts(premise))
        elif isinstance(claim, Limit) and claim.value.is_finite is not False:
            expr = replaced(expr, claim.term, claim.value)
    return expr


class Insert(Theorem):
    """An equation that becomes an identity when the equalities and limits among the premises are
    inserted, in order; ``ln a = b`` may also become ``a = e^b``."""

    claim: sp.Equality
    words = "Both sides are equal by {all}."
    alone = "Both sides reduce to the same expression."

    def prove(self, *premises: Judgement) -> Conclusion:
        if not isinstance(self.claim, sp.Equality):
            raise RuleError(f"missing premise: {self.claim} is an equality")
        left, right = self.claim.args
        forms = [left - right]
        if isinstance(left, sp.log):
            forms.insert(0, left.args[0] - sp.exp(right))
        if not any(is_zero(inserted(form, premises)) for form in forms):
            raise RuleError(f"missing premise: {self.claim} is no identity")
        return Conclusion(Equality(*self.claim.args))


class Consequence(Theorem):
    """A claim that becomes the first premise when the others are inserted into both."""

    claim: sp.Basic
    words = "Insert {others} into {0}."
    premise_names = ("the claim",)

    def prove(self, *premises: Judgement) -> Conclusion:
        first, *others = premises
        claim = claim_of(self.claim)
        (kind, *sides), (known, *given) = _sides(claim), _sides(first.claim)
        pairs = zip(sides, given, strict=True)
        if kind != known or not all(is_zero(inserted(a - b, tuple(others))) for a, b in pairs):
            raise RuleError(f"missing premise: {first.relation} does not become {self.claim}")
        return Conclusion(claim)


def _sides(claim: Claim) -> tuple[object, sp.Expr, sp.Expr]:
    """Return the kind of a claim and its two sides."""
    if isinstance(claim, Limit):
        return Limit, claim.expr, claim.value
    if isinstance(claim, Inequality):
        return claim.strict, claim.lesser, claim.greater
    if isinstance(claim, Equality):
        return Equality, claim.lhs, claim.rhs
    raise RuleError(f"missing premise: {claim.relation} is an equality, an inequality or a limit")
