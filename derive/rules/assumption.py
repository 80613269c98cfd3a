"""Assumption: a hypothesis is a judgement that rests on itself."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import sympy as sp

from ..claims import Property, claim_of
from ..hypotheses import Hypothesis, Kind
from ..kernel import Conclusion, Judgement, Rule, RuleError, infer, plain


@dataclass(frozen=True)
class Assume(Rule):
    """``H |- H``."""

    hypothesis: Hypothesis

    def conclude(self, *premises: Judgement) -> Conclusion:
        relation = self.hypothesis.relation
        if premises or relation == sp.false:
            raise RuleError(f"{self.hypothesis.text}: cannot be assumed")
        named = self.hypothesis.kind is Kind.DEFINITION
        true = relation is sp.true
        claim = Property(self.hypothesis.text) if true else claim_of(relation, named)
        return Conclusion(claim, adds=(self.hypothesis,))

    def sentence(self, *labels: str, write: Callable[[sp.Basic], str] = plain) -> str:
        return f"Hypothesis: {self.hypothesis.text}."


def assume(hypothesis: Hypothesis, name: str = "", remark: str = "") -> Judgement:
    """Return the judgement of a hypothesis."""
    return infer(Assume(hypothesis), name=name, remark=remark)


def defined(symbol: sp.Expr, value: sp.Expr, text: str = "") -> Judgement:
    """Return the definition of a name."""
    relation = sp.Eq(symbol, value, evaluate=False)
    return assume(Hypothesis(text or f"{symbol} by definition", relation, kind=Kind.DEFINITION))
