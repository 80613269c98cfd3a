"""Judgements tried on models: what `derive verify --deep` asks, and the table of reasons.

Key results
    tried(judgement)     does a model break it?
    reasons(judgement)   each hypothesis that a reader sees, with what happens without it
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import sympy as sp

from ..claims import Asymptotic, Claim
from ..hypotheses import Hypothesis
from ..kernel import Judgement
from ..symbols import symbol, t
from .verdict import Answer, falsify, needed

_DRAWS, _ENOUGH = 12, 2
_CYCLES = symbol("N")


def tried(judgement: Judgement) -> Answer:
    """Return what models say of a judgement."""
    return falsify(_relations(judgement), _claimed(judgement.claim), _DRAWS, _ENOUGH)


def _relations(judgement: Judgement) -> tuple[sp.Basic, ...]:
    return tuple(h.relation for h in judgement.hypotheses if h.relation is not sp.true)


def _claimed(claim: Claim) -> sp.Basic:
    """Return a claim as a relation that models decide: an asymptotic one as a limit in time."""
    if not isinstance(claim, Asymptotic):
        return claim.relation
    rest = (claim.lhs - claim.rhs) / claim.order
    variable, point = claim.variable, claim.point
    if variable != t and point == sp.oo:
        rest, variable = rest.subs(_CYCLES, t / symbol("T")), t
    elif not isinstance(variable, sp.Symbol):  # a field that tends to its end
        variable, point = t, sp.oo
    return sp.Eq(sp.Limit(rest, variable, point), 0, evaluate=False)


@dataclass(frozen=True)
class Reason:
    """Why a hypothesis is there: a model of all others that breaks the claim, or ''."""

    hypothesis: Hypothesis
    counterexample: str


def reasons(judgement: Judgement) -> Iterator[Reason]:
    """Drop each hypothesis that stands beside the claim, in turn."""
    seen = {h.relation: h for h in judgement.hypotheses if h.relation is not sp.true and h.shown}
    for row in needed(_relations(judgement), _claimed(judgement.claim), chosen=tuple(seen)):
        yield Reason(seen[row.hypothesis], str(row.counterexample or ""))
