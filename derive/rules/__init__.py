"""What a rule is: how a claim follows from its parents, and how that is checked.

Overview
    A rule can make a claim from the claims of its parents (``apply``) and check a statement
    that says it followed this rule (``check``).  A check has two independent routes: a proof
    by exact rewriting, and samples at 50 digits that know nothing of the rewriting.
Key results
    Rule         a move
    Given        a hypothesis of the model
    Theorem      rules that make their claim, and check it by making it again
    Pointwise    theorems about an instant, which are sampled too
    Authored     rules whose claim is written down, then proved
    sampled      a claim at points where all that it rests on holds
Contents
    algebra      at an instant: substitute, solve, rearrange, multiply, specialise, restrict
    authored     identities, inequalities, and what the parents turn into an identity
    bounds       inequalities, from one quantity to another and from rates to wear
    calculus     integrate over time, let a parameter tend to a limit
    limits       t -> oo
    drift        how limits are approached
    solutions    solutions of the differential equation, and their inverses
    data         derivatives with respect to a datum, and a result solved for a datum
    sign         expressions that are manifestly positive or negative
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import TYPE_CHECKING

import sympy as sp

from .. import sample
from ..check import Check
from ..sample import Source
from ..zero import same

if TYPE_CHECKING:
    from ..statement import Statement

SAMPLES = 5
"""Worlds that every pointwise claim is evaluated in."""


class RuleError(ValueError):
    """A move was asked for that it cannot make."""


class Rule(ABC):
    """A move: how a claim follows from its parents."""

    values: tuple[tuple[sp.Expr, sp.Expr], ...] = ()
    """Particular values that the move gives to parameters."""

    @abstractmethod
    def apply(self, parents: tuple[sp.Basic, ...]) -> sp.Basic:
        """Return the claim that this move makes from the claims of the parents."""

    @abstractmethod
    def check(self, statement: Statement) -> tuple[Check, ...]:
        """Check that the statement's claim follows."""

    def pivot_of(self, claim: sp.Basic) -> sp.Expr | None:
        """Return the unknown that samples compute from the claim, instead of from its parents."""
        return None


class Theorem(Rule):
    """Rules that make their claim, and check it by making it again.

    ``apply`` verifies the hypotheses of the theorem and raises RuleError where they fail.
    """

    theorem = ""

    def check(self, statement: Statement) -> tuple[Check, ...]:
        """Make the claim again, hypotheses and all."""
        again = self.apply(tuple(parent.claim for parent in statement.parents))
        passed = same(again, statement.claim)
        return (proof(passed, self.theorem if passed else f"the move gives {again}"),)


class Pointwise(Theorem):
    """Theorems whose claim holds at an instant wherever the parents do, and is sampled too."""

    theorem = "the move, made again, gives the claim"

    def check(self, statement: Statement) -> tuple[Check, ...]:
        """Make the claim again, and evaluate it."""
        return *super().check(statement), sampled(statement)


class Authored(Rule):
    """Rules whose claim is written down and then proved."""

    def apply(self, parents: tuple[sp.Basic, ...]) -> sp.Basic:
        """Refuse: no move makes this claim."""
        raise RuleError(f"a claim is authored, then proved from its {len(parents)} parents")


@dataclass(frozen=True)
class Given(Authored):
    """A hypothesis.  ``pivot``: the unknown that a sample computes from it."""

    source: str
    pivot: sp.Expr | None = None

    def check(self, statement: Statement) -> tuple[Check, ...]:
        return ()

    def pivot_of(self, claim: sp.Basic) -> sp.Expr | None:
        return self.pivot


def proof(passed: bool, detail: str) -> Check:
    """Return the outcome of a symbolic proof."""
    return Check("proof", passed, detail)


def sources(statement: Statement) -> dict[sp.Expr, Source]:
    """Return what a world must satisfy for all that ``statement`` rests on to hold."""
    found: dict[sp.Expr, Source] = {}
    for parent in statement.parents:
        pivot = parent.rule.pivot_of(parent.claim)
        found |= sources(parent) if pivot is None else {pivot: Source.of(parent.claim, pivot)}
    return found | {key: Source(key, value) for key, value in statement.rule.values}


def sampled(statement: Statement, count: int = SAMPLES) -> Check:
    """Evaluate a claim in worlds where its sources and conditions hold."""
    origin = sources(statement).values()
    worlds = sample.satisfying(origin, statement.claim, statement.conditions, count)
    passed = all(sample.holds(statement.claim, values) for values in worlds)
    return Check("sample", passed, f"{count} points, {sample.DIGITS} digits")


def describe(rule: Rule) -> str:
    """Return the first line of a rule's description, or where a hypothesis comes from.

    >>> from derive.rules.algebra import SolveFor
    >>> describe(SolveFor(sp.Symbol("x")))
    'Solve an equation that is linear in unknown'
    """
    if isinstance(rule, Given):
        return f"hypothesis: {rule.source}"
    words = (type(rule).__doc__ or type(rule).__name__).strip().splitlines()[0]
    return words.rstrip(".").replace("``", "")  # marks of the docstring, not words
