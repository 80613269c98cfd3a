"""The checks of one step: the dimensions of its claim, and its rule applied again.

A judgement is also tried against models by the falsifier, which shares nothing with the rules.
"""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

from .coq.record import proved_by_coq
from .dimensions import homogeneous
from .falsifier.judgements import tried
from .kernel import Judgement, replayed
from .rules.assumption import Assume


class Check(NamedTuple):
    """What was checked (``kind``), whether it holds, and how that was found out."""

    kind: str
    passed: bool
    detail: str


@cache
def checks(judgement: Judgement) -> tuple[Check, ...]:
    """Return what comes of checking one step; its parents are steps of their own."""
    fault, refusal = homogeneous(judgement.relation), replayed(judgement)
    found = (
        Check("dimensions", fault is None, fault or "both sides agree"),
        Check("proof", refusal is None, refusal or judgement.rule.source),
    )
    closed = Check("coq", True, "closed by Coq, as its record says")
    return (*found, closed) if proved_by_coq(judgement) else found


def on_models(judgement: Judgement) -> tuple[Check, ...]:
    """Return what models say of a step that is no hypothesis: none may break it."""
    if isinstance(judgement.rule, Assume):
        return ()
    answer = tried(judgement)
    return (Check("falsifier", answer.passed, str(answer)),)
