"""Algebra at an instant: claims that hold wherever the premises do.

Key results
    substitute, Solve, Multiply, restrict        equations
    Identity, Insert, Logarithm                  claims that an author writes, to be proved
    Consequence                                  the same relation in another form
    discharge, forget                            hypotheses that follow from others
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import sympy as sp

from ..claims import Claim, Equality, Inequality, Limit, claim_of
from ..hypotheses import Hypothesis
from ..kernel import Conclusion, Judgement, Rule, RuleError, infer, listed, plain
from ..language import bound_in
from ..reals import holds
from ..symbols import t
from ..zero import is_zero
from .proving import everywhere, require, require_defined, smooth
from .reading import constant, equality, functions, replaced


@dataclass(frozen=True)
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
            taken = {variable} & known.relation.free_symbols - {t}
            if taken or known.lhs in bound_in(claim.relation) | {variable} - {t}:
                raise RuleError(f"missing premise: {known.lhs} may take every value")
            claim = _put(claim, known)
        return Conclusion(claim)


def _put(claim: Claim, known: Equality) -> Claim:
    result = claim.map(lambda side: replaced(side, known.lhs, known.rhs))
    if result.relation.has(sp.zoo, sp.nan):
        raise RuleError(f"{claim.relation} has no value for {known.lhs} = {known.rhs}")
    return result


substitute = Substitute()


@dataclass(frozen=True)
class Solve(Rule):
    """``a x + b = c x + d`` with ``a != c`` gives x; further premises show that ``a != c``."""

    unknown: sp.Expr
    words = "Solve {0} for {unknown}."
    premise_names = ("the equation",)

    def conclude(self, *premises: Judgement) -> Conclusion:
        given, x = equality(premises[0]), sp.Dummy(real=True)
        residual = given.lhs - given.rhs
        inner = residual.atoms(sp.Derivative, sp.Integral, sp.Limit, sp.Subs) - {self.unknown}
        residual = residual.xreplace({self.unknown: x})
        slope = sp.diff(residual, x)
        if any(part.has(self.unknown) for part in inner) or slope.has(x) or not smooth(residual, x):
            raise RuleError(f"missing premise: {given.relation} is linear in {self.unknown}")
        require(sp.Ne(slope, 0), *premises)
        value = given.rhs
        if given.lhs != self.unknown or value.has(self.unknown):
            value = -residual.xreplace({x: sp.S.Zero}) / slope
        return Conclusion(Equality(self.unknown, value))


@dataclass(frozen=True)
class Multiply(Rule):
    """``l = r`` gives ``c l = c r``."""

    factor: sp.Expr
    words = "Multiply {0} by {factor}."
    premise_names = ("the equation",)

    def conclude(self, *premises: Judgement) -> Conclusion:
        given = equality(premises[0])
        require_defined(self.factor, *premises)
        return Conclusion(given.map(lambda side: self.factor * side))


@dataclass(frozen=True)
class Restrict(Rule):
    """Where a relation holds, a piecewise expression is its branch, and ``|x| = x`` if x > 0."""

    words = "Keep the branch of {0} on which {others} holds."
    premise_names = ("the claim", "the relation")

    def conclude(self, *premises: Judgement) -> Conclusion:
        first, condition = premises
        relation = condition.relation
        if taken := bound_in(first.relation) & relation.free_symbols - {t}:
            raise RuleError(f"missing premise: {relation} for every {sp.Tuple(*taken)}")
        written = (relation, getattr(relation, "reversed", relation))
        claim = first.claim.map(
            lambda side: side.replace(
                lambda e: isinstance(e, sp.Piecewise) and e.args[0].cond in written,
                lambda e: e.args[0].expr,
            )
        )
        if isinstance(condition.claim, Inequality) and condition.claim.lesser == 0:
            positive = condition.claim.greater
            claim = claim.map(lambda side: side.xreplace({sp.Abs(positive): positive}))
        if claim == first.claim:
            raise RuleError(f"{first.relation} has no branch for {relation}")
        return Conclusion(claim)


restrict = Restrict()


def inserted(expr: sp.Expr, premises: tuple[Judgement, ...]) -> sp.Expr:
    """Insert ``left = right`` of equalities, and finite limits, in order."""
    for premise in premises:
        claim = premise.claim
        if isinstance(claim, Equality):
            expr = replaced(expr, claim.lhs, claim.rhs)
        elif isinstance(claim, Limit) and claim.value.is_finite is not False:
            expr = replaced(expr, claim.term, claim.value)
    return expr


@dataclass(frozen=True)
class Identity(Rule):
    """An equation that holds for every value of its unknowns; premises prove it defined."""

    claim: sp.Equality

    def conclude(self, *premises: Judgement) -> Conclusion:
        return Conclusion(_identical(self.claim, (), premises))

    def sentence(self, *labels: str, write: Callable[[sp.Basic], str] = plain) -> str:
        known = f"; that it is defined follows from {listed(labels)}" if labels else ""
        return f"Both sides reduce to the same expression{known}."


@dataclass(frozen=True)
class Insert(Rule):
    """An equation that becomes an identity when the premises are inserted, in order."""

    claim: sp.Equality
    words = "Both sides are equal by {all}."

    def conclude(self, *premises: Judgement) -> Conclusion:
        return Conclusion(_identical(self.claim, premises, premises))


def _identical(
    relation: sp.Equality, known: tuple[Judgement, ...], premises: tuple[Judgement, ...]
) -> Claim:
    require_defined(relation, *premises)
    if not isinstance(relation, sp.Equality):
        raise RuleError(f"missing premise: {relation} is an equality")
    left, right = relation.args
    if not is_zero(inserted(left - right, known)):
        raise RuleError(f"missing premise: {relation} is no identity")
    return Equality(left, right)


@dataclass(frozen=True)
class Logarithm(Rule):
    """``ln a = b`` from ``a = e^b``, which the premises turn into an identity."""

    claim: sp.Equality
    words = "Take logarithms of {0} and solve."

    def conclude(self, *premises: Judgement) -> Conclusion:
        left, right = self.claim.args
        inside = left.args[0] if isinstance(left, sp.log) else sp.nan
        require_defined(self.claim, *premises)
        if not is_zero(inserted(inside, premises) - sp.exp(right)):
            raise RuleError(f"missing premise: {inside} = exp({right})")
        return Conclusion(Equality(left, right))


@dataclass(frozen=True)
class Consequence(Rule):
    """A claim that becomes the first premise when the others are inserted into both."""

    claim: sp.Basic
    words = "Insert {others} into {0}."
    premise_names = ("the claim",)

    def conclude(self, *premises: Judgement) -> Conclusion:
        first, *others = premises
        claim = claim_of(self.claim)
        require_defined(claim.value if isinstance(claim, Limit) else self.claim, *premises)
        if isinstance(claim, Limit) and isinstance(first.claim, Limit):
            require_defined(claim.expr, *premises, near=[first.claim.expr])
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


@dataclass(frozen=True)
class Discharge(Rule):
    """``Gamma, H |- C`` and ``Delta |- H`` give ``Gamma, Delta |- C`` (cut)."""

    hypothesis: Hypothesis
    words = "The hypothesis of {0} is met by {others}."
    premise_names = ("the claim",)

    def conclude(self, *premises: Judgement) -> Conclusion:
        first, *known = premises
        if self.hypothesis not in first.hypotheses:
            raise RuleError(f"{first.relation} does not rest on {self.hypothesis.text}")
        if any(self.hypothesis in premise.hypotheses for premise in known):
            raise RuleError(f"missing premise: {self.hypothesis.text}, from others")
        require(self.hypothesis.relation, *known)
        if functions(self.hypothesis.relation) and not all(map(everywhere, known)):
            raise RuleError(f"missing premise: {self.hypothesis.text}, at every time")
        return Conclusion(first.claim, discharges=(self.hypothesis,))


def discharge(first: Judgement, hypothesis: Hypothesis, *known: Judgement) -> Judgement:
    """Drop a hypothesis that follows from other judgements."""
    return infer(Discharge(hypothesis), first, *known, name=first.name, remark=first.remark)


@dataclass(frozen=True)
class Forget(Rule):
    """``x = v`` is no hypothesis where x, which may have the value v, occurs nowhere else."""

    hypothesis: Hypothesis
    words = "{0} does not depend on that value."
    premise_names = ("the claim",)

    def conclude(self, *premises: Judgement) -> Conclusion:
        (first,) = premises
        relation = self.hypothesis.relation
        if not isinstance(relation, sp.Equality) or not relation.lhs.is_Symbol:
            raise RuleError(f"missing premise: {self.hypothesis.text} is the value of a symbol")
        name, value = relation.args
        others = [h.relation for h in first.hypotheses if h != self.hypothesis]
        if not constant(sp.Tuple(name, value)):
            raise RuleError(f"missing premise: {name} and {value} are constant")
        require_defined(value)
        if sp.Tuple(value, first.relation, *others).has(name):
            raise RuleError(f"missing premise: {name} occurs nowhere else")
        possible = name.is_real and (not name.is_nonnegative or holds(sp.Ge(value, 0)))
        if not possible or (name.is_positive and not holds(sp.Gt(value, 0))):
            raise RuleError(f"missing premise: {name} may be {value}")
        return Conclusion(first.claim, discharges=(self.hypothesis,))


def forget(first: Judgement, hypothesis: Hypothesis) -> Judgement:
    """Drop the value of a symbol that does not occur."""
    return infer(Forget(hypothesis), first, name=first.name, remark=first.remark)
