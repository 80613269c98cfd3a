"""The few moves of a derivation, each of which proves its own result.

Overview
    A rule can make a claim from the claims of its parents (``apply``) and check a statement
    that says it followed this rule (``check``).  A check has two independent routes: a proof
    by exact rewriting, and samples at 50 digits that know nothing of the rewriting.
Key results
    Given                                hypotheses of the model
    Substitute, SolveFor, Multiply       algebra at an instant
    Specialise, Restrict                 particular cases
    Integrate, TakeLimit                 calculus
    Positive, Identity                   claims that are authored, then proved
"""

from __future__ import annotations

import random
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import mpmath
import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.core.relational import Relational

from . import sample
from .check import Check
from .sample import Source
from .symbols import t
from .zero import is_zero, same

if TYPE_CHECKING:
    from .statement import Statement

SAMPLES = 5
"""Worlds that every pointwise claim is evaluated in."""


class Rule(Protocol):
    """A move: how a claim follows from its parents."""

    def apply(self, parents: tuple[sp.Basic, ...]) -> sp.Basic:
        """Return the claim that this move makes from the claims of the parents."""

    def check(self, statement: Statement) -> tuple[Check, ...]:
        """Check that the statement's claim follows."""


class RuleError(ValueError):
    """A move was asked for that it cannot make."""


def sources(statement: Statement) -> dict[sp.Expr, Source]:
    """Return what a world must satisfy for all that ``statement`` rests on to hold."""
    found: dict[sp.Expr, Source] = {}
    for parent in statement.parents:
        found |= _own_sources(parent) or sources(parent)
    if isinstance(statement.rule, Specialise):
        found |= {key: Source(key, value) for key, value in statement.rule.values}
    return found


def _own_sources(statement: Statement) -> dict[sp.Expr, Source]:
    """Return the source that a statement is by itself, if it brings in something new."""
    pivot = getattr(statement.rule, "pivot", None)
    if callable(pivot):
        pivot = pivot(statement.claim)
    if pivot is None:
        return {}
    return {pivot: Source.of(statement.claim, pivot)}


def sampled(statement: Statement, count: int = SAMPLES) -> Check:
    """Evaluate a claim in worlds where its sources and conditions hold."""
    origin = sources(statement).values()
    worlds = sample.satisfying(origin, statement.claim, statement.conditions, count)
    passed = all(sample.holds(statement.claim, values) for values in worlds)
    return Check("sample", passed, f"{count} points, {sample.DIGITS} digits")


@dataclass(frozen=True)
class Given:
    """A hypothesis.  ``pivot``: the unknown that a sample computes from it."""

    source: str
    pivot: sp.Expr | None = None

    def apply(self, parents: tuple[sp.Basic, ...]) -> sp.Basic:
        raise RuleError("a hypothesis follows from nothing")

    def check(self, statement: Statement) -> tuple[Check, ...]:
        return ()


class _Pointwise:
    """Moves whose claim holds at an instant, wherever the parents do."""

    def apply(self, parents: tuple[sp.Basic, ...]) -> sp.Basic:
        raise NotImplementedError

    def check(self, statement: Statement) -> tuple[Check, ...]:
        again = self.apply(tuple(parent.claim for parent in statement.parents))
        proved = same(again, statement.claim)
        detail = "the move, made again, gives the claim" if proved else f"the move gives {again}"
        return Check("proof", proved, detail), sampled(statement)


@dataclass(frozen=True)
class Substitute(_Pointwise):
    """Insert ``left = right`` of each further parent into the first, in order."""

    def apply(self, parents: tuple[sp.Basic, ...]) -> sp.Basic:
        claim, *definitions = parents
        for definition in definitions:
            if not claim.has(definition.lhs):
                raise RuleError(f"{definition.lhs} does not occur in {claim}")
            claim = claim.subs(definition.lhs, definition.rhs)
        return claim


@dataclass(frozen=True)
class SolveFor(_Pointwise):
    """Solve an equation that is linear in ``unknown``."""

    unknown: sp.Expr

    def apply(self, parents: tuple[sp.Basic, ...]) -> sp.Basic:
        (claim,) = parents
        return sp.Eq(self.unknown, Source.of(claim, self.unknown).value)


@dataclass(frozen=True)
class Rearrange(_Pointwise):
    """Move terms between the sides of an equation: left minus right stays what it was."""

    claim: sp.Equality

    def apply(self, parents: tuple[sp.Basic, ...]) -> sp.Basic:
        (parent,) = parents
        if not is_zero((parent.lhs - parent.rhs) - (self.claim.lhs - self.claim.rhs)):
            raise RuleError(f"{self.claim} is not {parent} rearranged")
        return self.claim


@dataclass(frozen=True)
class Multiply(_Pointwise):
    """Multiply both sides by a factor that cannot vanish."""

    factor: sp.Expr

    def apply(self, parents: tuple[sp.Basic, ...]) -> sp.Basic:
        (claim,) = parents
        if not self.factor.is_nonzero:
            raise RuleError(f"{self.factor} may vanish")
        return sp.Eq(self.factor * claim.lhs, self.factor * claim.rhs)


@dataclass(frozen=True)
class Specialise(_Pointwise):
    """Give parameters particular values."""

    values: tuple[tuple[sp.Expr, sp.Expr], ...]

    def apply(self, parents: tuple[sp.Basic, ...]) -> sp.Basic:
        (claim,) = parents
        return claim.subs(dict(self.values)).doit()


@dataclass(frozen=True)
class Restrict(_Pointwise):
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


@dataclass(frozen=True)
class Integrate:
    """From ``dy/dt = c dx/dt`` with constant c, and y(0), x(0): y = y(0) + c (x - x(0))."""

    def pivot(self, claim: sp.Equality) -> sp.Expr:
        return claim.lhs

    def apply(self, parents: tuple[sp.Basic, ...]) -> sp.Basic:
        rate, *initial = parents
        y, x, factor = _proportional_rates(rate)
        start = {value.lhs: value.rhs for value in initial}
        return sp.Eq(y, (y - factor * x).subs(t, 0).subs(start) + factor * x)

    def check(self, statement: Statement) -> tuple[Check, ...]:
        return self._proof(statement), self._sample(statement)

    def _proof(self, statement: Statement) -> Check:
        """Differentiate the claim back, and look at time zero."""
        rate, *initial = (parent.claim for parent in statement.parents)
        y, x, factor = _proportional_rates(rate)
        start = {value.lhs: value.rhs for value in initial}
        claim = statement.claim
        slope = is_zero(sp.diff(claim.rhs, t) - factor * sp.diff(x, t)) and claim.lhs == y
        begin = is_zero((claim.lhs - claim.rhs).subs(t, 0).subs(start))
        return Check("proof", slope and begin, "its derivative and its value at t = 0 agree")

    def _sample(self, statement: Statement) -> Check:
        """Integrate the parent's rate by quadrature along a random path x(t)."""
        rate, *initial = (parent.claim for parent in statement.parents)
        y, x, factor = _proportional_rates(rate)
        generator = random.Random(0)
        constants = {a: sample.draw(a, generator) for a in sorted(_constants(statement), key=str)}
        start = {v.lhs: sample.evaluate(v.rhs, constants) for v in initial}
        growth = [generator.random() for _ in range(3)]
        with mpmath.workdps(sample.DIGITS + 15):
            c = mpmath.mpf(sample.evaluate(factor, constants))
            speed = lambda s: sum(a * s**i for i, a in enumerate(growth))  # noqa: E731
            wear = mpmath.quad(speed, [0, 1])
            x_end = mpmath.mpf(start.get(x.subs(t, 0), sp.Float(0))) + wear
            y_end = mpmath.mpf(start[y.subs(t, 0)]) + c * wear
            values = {**constants, x: sp.Float(x_end, 65), y: sp.Float(y_end, 65)}
        passed = sample.holds(statement.claim, values)
        return Check("sample", passed, f"quadrature along a path, {sample.DIGITS} digits")


def _constants(statement: Statement) -> set[sp.Expr]:
    everything = sp.Tuple(statement.claim, *(parent.claim for parent in statement.parents))
    return {a for a in sample.atoms(everything) if isinstance(a, sp.Symbol) and a != t}


def _proportional_rates(claim: sp.Equality) -> tuple[sp.Expr, sp.Expr, sp.Expr]:
    """Read ``dy/dt = c dx/dt`` as (y, x, c)."""
    driving = list(claim.rhs.atoms(sp.Derivative))
    if not isinstance(claim.lhs, sp.Derivative) or len(driving) != 1:
        raise RuleError(f"{claim} is not of the form dy/dt = c dx/dt")
    factor = sp.cancel(claim.rhs / driving[0])
    if factor.atoms(AppliedUndef) or factor.has(t):
        raise RuleError(f"the factor {factor} is not constant")
    return claim.lhs.expr, driving[0].expr, factor


@dataclass(frozen=True)
class TakeLimit:
    """Let a parameter tend to a point, all else at an instant held fixed."""

    variable: sp.Symbol
    point: sp.Expr

    def pivot(self, claim: sp.Basic) -> sp.Expr | None:
        """A limit is a source of its own: its parents hold before it only."""
        if not isinstance(claim, sp.Equality):
            return None
        derivatives = claim.lhs.atoms(sp.Derivative) or claim.lhs.atoms(AppliedUndef)
        return next(iter(derivatives), None)

    def apply(self, parents: tuple[sp.Basic, ...]) -> sp.Basic:
        (claim,) = parents
        return claim.func(*(self._limit(side) for side in claim.args))

    def _limit(self, side: sp.Expr) -> sp.Expr:
        """Insert the point where the side is continuous there; else ask for SymPy's limit."""
        small = sp.Dummy("epsilon", positive=True)
        shifted = side.subs(self.variable, 1 / small if self.point == sp.oo else self.point + small)
        inserted = shifted.subs(small, 0)
        if not inserted.has(sp.oo, sp.zoo, sp.nan) and _continuous(inserted):
            return inserted
        return sp.limit(shifted, small, 0, "+")

    def check(self, statement: Statement) -> tuple[Check, ...]:
        again = self.apply(tuple(parent.claim for parent in statement.parents))
        return (
            Check("proof", same(again, statement.claim), f"the limit, taken again, is {again}"),
            self._sample(statement),
        )

    def _sample(self, statement: Statement) -> Check:
        """Go towards the point in steps of 1e10; each must bring the sides as much nearer."""
        (parent,) = (p.claim for p in statement.parents)
        claim = statement.claim
        values = sample.world((), sp.Tuple(parent, claim), seed=1)
        distances = []
        for exponent in (20, 30, 40):
            near = sp.Float(10) ** (exponent if self.point == sp.oo else -exponent)
            at = near if self.point == sp.oo else self.point + near
            there = {**values, self.variable: at}
            gaps = [
                abs(sample.evaluate(a, there) - sample.evaluate(b, values))
                / max(abs(sample.evaluate(b, values)), sp.Float(10) ** -300)
                for a, b in zip(parent.args, claim.args, strict=True)
            ]
            distances.append(max(gaps))
        passed = all(
            gap < sp.Float(10) ** (-e + 15) for gap, e in zip(distances, (20, 30, 40), strict=True)
        )
        shown = ", ".join(f"{float(gap):.0e}" for gap in distances)
        return Check("sample", passed, f"distance at 1e20, 1e30, 1e40: {shown}")


def _continuous(expr: sp.Expr) -> bool:
    """Return whether an expression is made of functions continuous where they are evaluated."""
    roots = (e for e in expr.atoms(sp.Pow) if not e.exp.is_Integer)
    known = all(
        isinstance(f, (sp.tanh, sp.exp, AppliedUndef))
        for f in expr.atoms(sp.Function, AppliedUndef)
    )
    return known and all(e.base.is_nonnegative for e in roots)


@dataclass(frozen=True)
class Identity:
    """An authored equation that holds for every value of its unknowns, by exact rewriting."""

    def apply(self, parents: tuple[sp.Basic, ...]) -> sp.Basic:
        raise RuleError("an identity is authored, then proved")

    def check(self, statement: Statement) -> tuple[Check, ...]:
        claim = statement.claim
        proved = claim == sp.true or (
            isinstance(claim, sp.Equality) and is_zero(claim.lhs - claim.rhs)
        )
        return Check("proof", proved, "left minus right reduces to 0"), sampled(statement)


@dataclass(frozen=True)
class Positive:
    """Authored inequalities, proved from the signs of the symbols.

    ``parametrisation`` maps symbols onto expressions in positive symbols that range over the
    whole domain (``p -> p_max y/(1 + y)`` for 0 < p < p_max), which makes signs manifest.
    """

    parametrisation: tuple[tuple[sp.Expr, sp.Expr], ...] = ()

    def apply(self, parents: tuple[sp.Basic, ...]) -> sp.Basic:
        raise RuleError("an inequality is authored, then proved")

    def check(self, statement: Statement) -> tuple[Check, ...]:
        claim = statement.claim
        parts = claim.args if isinstance(claim, sp.And) else (claim,)
        proved = all(self._proved(part) for part in parts)
        return Check("proof", proved, "a sum of terms of one sign"), sampled(statement)

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


def describe(rule: Rule) -> str:
    """Return the first line of a rule's description, or where a hypothesis comes from.

    >>> describe(SolveFor(sp.Symbol("x")))
    'Solve an equation that is linear in unknown'
    """
    if isinstance(rule, Given):
        return f"hypothesis: {rule.source}"
    words = (type(rule).__doc__ or type(rule).__name__).strip().splitlines()[0]
    return words.rstrip(".").replace("``", "")  # marks of the docstring, not words
