"""What the rules of analysis have in common: theorems, and the sign of an expression.

Key results
    Authored    rules whose claim is written down and then proved
    Theorem     rules that make their claim from that of their parents, by a named theorem
    sign        1 or -1 for an expression that is manifestly positive or negative
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import sympy as sp

from .check import Check
from .laws import GENERAL
from .rules import RuleError
from .zero import same

if TYPE_CHECKING:
    from .statement import Statement

LAW = GENERAL.phi.func
"""The unspecified contact law; all that is known of it is that it is positive and decreases."""

_SLOPE_OF_LAW = sp.Dummy("slope", negative=True)


def proof(passed: bool, detail: str) -> tuple[Check, ...]:
    """Return the outcome of a symbolic proof."""
    return (Check("proof", passed, detail),)


class Authored:
    """Rules whose claim is written down and then proved."""

    def apply(self, parents: tuple[sp.Basic, ...]) -> sp.Basic:
        """Refuse: no move makes this claim."""
        raise RuleError(f"a claim is authored, then proved from its {len(parents)} parents")


class Theorem:
    """Rules that make their claim, and check it by making it again.

    ``apply`` verifies the hypotheses of the theorem and raises RuleError where they fail.
    """

    theorem = ""

    def apply(self, parents: tuple[sp.Basic, ...]) -> sp.Basic:
        """Return the conclusion of the theorem."""
        raise NotImplementedError

    def check(self, statement: Statement) -> tuple[Check, ...]:
        """Make the claim again, hypotheses and all."""
        again = self.apply(tuple(parent.claim for parent in statement.parents))
        return proof(same(again, statement.claim), self.theorem)


def sign(expr: sp.Expr) -> int | None:
    """Return 1 or -1 for an expression that is manifestly positive or negative, else None.

    >>> y = sp.Symbol("y", real=True)
    >>> sign(1 + sp.tanh(y)), sign(sp.tanh(y) - 1), sign(y)
    (1, -1, None)
    """
    expr = expr.replace(_is_slope_of_law, lambda _: _SLOPE_OF_LAW)
    exponential = sp.powsimp(expr.rewrite(sp.exp))
    numerator, denominator = sp.fraction(sp.together(exponential))
    quotient = sp.factor_terms(sp.expand(numerator)) / sp.factor(denominator)
    for form in (expr, exponential, quotient, sp.factor(exponential)):
        if form.is_positive:
            return 1
        if form.is_negative:
            return -1
    return None


def _is_slope_of_law(expr: sp.Expr) -> bool:
    return isinstance(expr, (sp.Derivative, sp.Subs)) and bool(expr.has(LAW))


def assume(expr: sp.Expr, positive: tuple[sp.Symbol, ...]) -> sp.Expr:
    """Return ``expr`` with symbols that a condition makes positive replaced by such."""
    return expr.subs({s: sp.Dummy(s.name, positive=True) for s in positive})
