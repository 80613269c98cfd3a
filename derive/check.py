"""The checks of one step: the dimensions of its claim, its rule applied again, and models.

Models are drawn by the falsifier, which shares nothing with the rules; none may break a step.
"""

from __future__ import annotations

from typing import NamedTuple

from .claims import Predicate
from .coq.steps import proved_by_coq
from .dimensions import homogeneous
from .falsifier.judgements import tried, without
from .kernel import Judgement, replayed
from .rules.assumption import Assume


class Check(NamedTuple):
    """What was checked (``kind``), whether it holds, and how that was found out."""

    kind: str
    passed: bool
    detail: str


def checks(judgement: Judgement) -> tuple[Check, ...]:
    """Return what comes of checking one step; its parents are steps of their own."""
    fault, refusal = homogeneous(judgement.relation), replayed(judgement)
    found = [
        Check("dimensions", fault is None, fault or "both sides agree"),
        Check("proof", refusal is None, refusal or judgement.rule.source),
    ]
    if proved_by_coq(judgement):
        found.append(Check("coq", True, "closed by Coq, as its record says"))
    return tuple(found)


def on_models(judgement: Judgement) -> tuple[Check, ...]:
    """Return what models say of a step that is no hypothesis: none may break it."""
    if isinstance(judgement.rule, Assume):
        return ()
    answer = tried(judgement)
    return (Check("falsifier", answer.passed, str(answer)),)


def reasons_of(judgement: Judgement) -> tuple[Check, ...]:
    """Return what models say of a judgement without each of its conditions in turn."""
    asked = (h for h in judgement.conditions if not isinstance(h.relation, Predicate))
    found = {h: without(judgement, h) for h in asked}
    none = "no model shows that it is needed"
    return tuple(
        Check("hypothesis", True, f"{h.typed}: {f'without it false for {why}' if why else none}")
        for h, why in found.items()
    )
