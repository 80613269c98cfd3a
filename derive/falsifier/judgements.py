"""Judgements tried on models: what `derive verify` asks, and the reasons of hypotheses.

Key results
    tried(judgement)              does a model break it?
    without(judgement, dropped)   what breaks it without one of its hypotheses
"""

from __future__ import annotations

from functools import cache

import sympy as sp

from ..claims import Asymptotic, Claim, Predicate, Property
from ..hypotheses import Hypothesis
from ..kernel import Judgement
from ..symbols import symbol, t
from .verdict import Answer, Counterexample, falsify

_DRAWS, _ENOUGH, _SEEDS = 12, 2, 60
_CYCLES = symbol("N")


def tried(judgement: Judgement) -> Answer:
    """Return what models say of a judgement."""
    return _answer(_relations(judgement), _claimed(judgement.claim))


@cache
def _answer(relations: tuple[sp.Basic, ...], claim: sp.Basic) -> Answer:
    return falsify(relations, claim, _DRAWS, _ENOUGH)


def _relations(judgement: Judgement) -> tuple[sp.Basic, ...]:
    """Return the hypotheses; for a relation towards an end of a field, that it tends there."""
    claim = judgement.claim
    given = (hypothesis.relation for hypothesis in judgement.hypotheses)
    found = tuple(relation for relation in given if not isinstance(relation, Predicate))
    if not isinstance(claim, Asymptotic) or isinstance(claim.variable, sp.Symbol):
        return found
    return *found, sp.Eq(sp.Limit(claim.variable, t, sp.oo), claim.point, evaluate=False)


def _claimed(claim: Claim) -> sp.Basic:
    """Return a claim as a relation that models decide: an asymptotic one as a limit in time."""
    if not isinstance(claim, Asymptotic):
        return sp.true if isinstance(claim, Property) else claim.relation
    rest = (claim.lhs - claim.rhs) / claim.order
    variable, point = claim.variable, claim.point
    if variable != t and point == sp.oo:
        rest, variable = rest.subs(_CYCLES, t / symbol("T")), t
    elif not isinstance(variable, sp.Symbol):  # a field that tends to its end
        variable, point = t, sp.oo
    return sp.Eq(sp.Limit(rest, variable, point), 0, evaluate=False)


def without(judgement: Judgement, dropped: Hypothesis) -> Counterexample | None:
    """Return a model of all other hypotheses that breaks the claim; None if none is found: the
    hypothesis is superfluous as far as models go."""
    relations, claim = _relations(judgement), _claimed(judgement.claim)
    return falsify(relations, claim, _SEEDS, _SEEDS, dropped.relation).counterexample
