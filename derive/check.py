"""The checks of one step: the dimensions of its claim, its rule applied again, and models.

Models are drawn by the falsifier, which shares nothing with the rules; none may break a step.
"""

from __future__ import annotations

from typing import NamedTuple

from .claims import Predicate
from .coq.steps import proved_by_coq
from .dimensions import dimension_fault
from .falsifier.verdict import counterexample_without, try_on_models
from .kernel import Judgement, replay_fault
from .rules.assumption import is_hypothesis


class Check(NamedTuple):
    """The outcome of one check: its kind, whether it passed, and the evidence or the fault."""

    kind: str
    passed: bool
    detail: str


def step_checks(judgement: Judgement) -> tuple[Check, ...]:
    """Check one step without models; its parents are steps of their own."""
    fault, refusal = dimension_fault(judgement.relation), replay_fault(judgement)
    results = [
        Check("dimensions", fault is None, fault or "both sides agree"),
        Check("proof", refusal is None, refusal or judgement.rule.source),
    ]
    if proved_by_coq(judgement):
        results.append(Check("coq", True, "closed by Coq, as its record says"))
    return tuple(results)


def model_checks(judgement: Judgement) -> tuple[Check, ...]:
    """Try a step on models, none of which may break it; a hypothesis has no such check.

    The kind is ``undecided`` if no model gives the claim a truth value.
    """
    if is_hypothesis(judgement):
        return ()
    answer = try_on_models(judgement)
    kind = "falsifier" if answer.decided else "undecided"
    return (Check(kind, answer.passed, str(answer)),)


def condition_checks(judgement: Judgement) -> tuple[Check, ...]:
    """Drop each condition of a judgement in turn; report a model that then breaks the claim."""
    relations = (h for h in judgement.conditions if not isinstance(h.relation, Predicate))
    broken = {h: counterexample_without(judgement, h) for h in relations}
    none = "no model shows that it is needed"
    return tuple(
        Check("hypothesis", True, f"{h.brief}: {f'without it false for {by}' if by else none}")
        for h, by in broken.items()
    )
