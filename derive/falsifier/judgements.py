"""Trials of judgements on models, for `derive verify` and the reasons of hypotheses.

Key results
    try_on_models(judgement)                     a model that breaks it, or the number of trials
    counterexample_without(judgement, dropped)   a model that breaks it without one hypothesis
"""

from __future__ import annotations

from functools import cache

import sympy as sp

from ..claims import Asymptotic, Claim, Predicate, Property, SlowEquation
from ..hypotheses import Hypothesis
from ..kernel import Judgement
from ..symbols import symbol, t
from .verdict import Counterexample, TrialResult, falsify

_DRAWS, _ENOUGH, _SEEDS = 12, 2, 60
_CYCLES = symbol("N")


def try_on_models(judgement: Judgement) -> TrialResult:
    """Return the result of trying a judgement on models; none is known of an averaged expansion."""
    if any(isinstance(hypothesis.relation, SlowEquation) for hypothesis in judgement.hypotheses):
        return TrialResult(None, models=0, decided=0, doubtful=1)
    return _result(_relations(judgement), _decidable(judgement.claim))


@cache
def _result(relations: tuple[sp.Basic, ...], claim: sp.Basic) -> TrialResult:
    return falsify(relations, claim, _DRAWS, _ENOUGH)


def _relations(judgement: Judgement) -> tuple[sp.Basic, ...]:
    """Return the hypotheses, and for an asymptotic claim in a field the limit of that field."""
    claim = judgement.claim
    given = (hypothesis.relation for hypothesis in judgement.hypotheses)
    relations = tuple(relation for relation in given if not isinstance(relation, Predicate))
    if not isinstance(claim, Asymptotic) or isinstance(claim.variable, sp.Symbol):
        return relations
    return *relations, sp.Eq(sp.Limit(claim.variable, t, sp.oo), claim.point, evaluate=False)


def _decidable(claim: Claim) -> sp.Basic:
    """Return a claim as a relation that models decide: an asymptotic one as a limit in time."""
    if not isinstance(claim, Asymptotic):
        return sp.true if isinstance(claim, Property) else claim.relation
    rest = (claim.lhs - claim.rhs) / claim.order
    variable, point = claim.variable, claim.point
    if variable != t and point == sp.oo:
        rest, variable = rest.subs(_CYCLES, t / symbol("T")), t
    elif not isinstance(variable, sp.Symbol):  # a field, which tends to the point
        variable, point = t, sp.oo
    return sp.Eq(sp.Limit(rest, variable, point), 0, evaluate=False)


def counterexample_without(judgement: Judgement, dropped: Hypothesis) -> Counterexample | None:
    """Return a model of all other hypotheses that breaks the claim, None if none is found.

    None is no proof that the hypothesis is superfluous.
    """
    relations, claim = _relations(judgement), _decidable(judgement.claim)
    return falsify(relations, claim, _SEEDS, _SEEDS, dropped.relation).counterexample
