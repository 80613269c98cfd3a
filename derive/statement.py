"""Statements: what is claimed, why, and from what.

Overview
    A derivation is a graph of frozen statements.  Each has a claim (a SymPy relation), the
    rule by which it holds, the statements it follows from and the conditions it needs.  A rule
    proves the claim anew whenever it is checked; nothing is believed because it was built.
Key results
    Statement    one node, with the moves that make the next one
    chain        a statement and all it rests on, parents first
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import sympy as sp

from .check import Check
from .conditions import Condition
from .dimensions import homogeneous
from .rules import Given, Rule
from .rules.algebra import Multiply, Rearrange, Restrict, SolveFor, Specialise, Substitute
from .rules.calculus import Integrate, TakeLimit


@dataclass(frozen=True, eq=False)
class Statement:
    """One step of a derivation.

    ``remark`` tells the reader what the formula does not: where the note drops a condition,
    switches a sign or rounds.
    """

    claim: sp.Basic
    rule: Rule
    parents: tuple[Statement, ...] = ()
    conditions: tuple[Condition, ...] = ()
    remark: str = ""
    name: str = field(default="")

    @cached_property
    def checks(self) -> tuple[Check, ...]:
        """Dimensions, the rule's proof, and samples at 50 digits; what cannot change is checked
        once."""
        fault = homogeneous(self.claim)
        dimensions = Check("dimensions", fault is None, fault or "both sides agree")
        return (dimensions, *self.rule.check(self))

    def substitute(self, *definitions: Statement, remark: str = "") -> Statement:
        """Insert ``left = right`` of each definition, in order."""
        return _step(Substitute(), (self, *definitions), remark)

    def solve_for(self, unknown: sp.Expr, remark: str = "") -> Statement:
        """Solve this equation, linear in ``unknown``, for it."""
        return _step(SolveFor(unknown), (self,), remark)

    def rearrange(self, claim: sp.Equality, remark: str = "") -> Statement:
        """Write the same equation with its terms moved between the sides."""
        return _step(Rearrange(claim), (self,), remark)

    def times(self, factor: sp.Expr, remark: str = "") -> Statement:
        """Multiply both sides by a factor that cannot vanish."""
        return _step(Multiply(factor), (self,), remark)

    def integrate(self, *initial: Statement, remark: str = "") -> Statement:
        """Integrate ``dy/dt = c dx/dt`` from time zero, given the initial values."""
        return _step(Integrate(), (self, *initial), remark)

    def limit(self, variable: sp.Symbol, point: sp.Expr, remark: str = "") -> Statement:
        """Let a parameter tend to a limit, on both sides."""
        return _step(TakeLimit(variable, point), (self,), remark)

    def specialise(self, values: Mapping[sp.Expr, sp.Expr | int], remark: str = "") -> Statement:
        """Give parameters particular values; a condition that these meet is none any more."""
        pairs = tuple(
            (key, sp.Integer(value) if isinstance(value, int) else value)
            for key, value in values.items()
        )
        made = _step(Specialise(pairs), (self,), remark)
        needed = (c for c in made.conditions if not c.met_by(dict(pairs)))
        return replace(made, conditions=tuple(needed))

    def restrict(self, condition: Condition, remark: str = "") -> Statement:
        """Keep the branch of a piecewise claim, or of a modulus, on which ``condition`` holds."""
        made = _step(Restrict(condition.relation), (self,), remark)
        return replace(made, conditions=(*made.conditions, condition))

    def named(self, name: str) -> Statement:
        """Give the statement a name to be shown by."""
        return replace(self, name=name)


def _step(rule: Rule, parents: tuple[Statement, ...], remark: str) -> Statement:
    claim = rule.apply(tuple(parent.claim for parent in parents))
    return Statement(claim, rule, parents, inherited(parents), remark)


def inherited(parents: tuple[Statement, ...]) -> tuple[Condition, ...]:
    """Return the conditions of all parents, each once, in order."""
    return tuple(dict.fromkeys(c for parent in parents for c in parent.conditions))


def given(
    claim: sp.Basic, source: str, pivot: sp.Expr | None = None, remark: str = "", name: str = ""
) -> Statement:
    """State a hypothesis of the model; ``pivot`` is the unknown that samples compute from it."""
    return Statement(claim, Given(source, pivot), remark=remark, name=name)


def chain(*statements: Statement) -> tuple[Statement, ...]:
    """Return the statements and all that they rest on, each once, parents first."""
    seen: dict[int, Statement] = {}

    def visit(statement: Statement) -> None:
        if id(statement) in seen:
            return
        for parent in statement.parents:
            visit(parent)
        seen[id(statement)] = statement

    for statement in statements:
        visit(statement)
    return tuple(seen.values())
