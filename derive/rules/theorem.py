"""Theorems: rules whose conclusions have a value.

All rules are theorems in this sense, except those that assume a hypothesis, repeat a claim or put
equals for equals: what they conclude has a value since the premises have one.
"""

from __future__ import annotations

from abc import abstractmethod

import sympy as sp

from ..claims import Asymptotic, Claim, Limit
from ..kernel import Conclusion, Judgement, Rule
from .proving import require_defined


class Theorem(Rule):
    """A rule of which every conclusion is checked: do all its parts have a value?

    They need it by the premises, or by the theorem itself, which names them.  Expressions with a
    limit, and both sides of an asymptotic relation, need one near the end alone; of t -> oo, limits
    among the premises tell where they have one.
    """

    def conclude(self, *premises: Judgement) -> Conclusion:
        made = self.prove(*premises)
        now, at_the_end = _sides(made.claim)
        late = isinstance(made.claim, Limit) or getattr(made.claim, "point", None) is sp.oo
        limits = (p.claim.expr for p in premises if late and isinstance(p.claim, Limit))
        require_defined(now, *premises, near=made.gives)
        require_defined(at_the_end, *premises, near=(*made.gives, *limits))
        return made

    @abstractmethod
    def prove(self, *premises: Judgement) -> Conclusion:
        """Return the conclusion; RuleError names a missing premise or side condition."""


def _sides(claim: Claim) -> tuple[sp.Basic, sp.Basic]:
    """Return what needs a value under the premises, and what needs one near the end of a limit."""
    if isinstance(claim, Limit):
        return claim.value, claim.expr
    if isinstance(claim, Asymptotic):
        return sp.Tuple(), sp.Tuple(claim.lhs, claim.rhs)
    return claim.relation, sp.Tuple()
