"""The checks of every derivation, each distinct step checked once.

Different equations rest on the same steps, which `derive` builds anew for each variant of the
model. A step is the same if claim, rule, parents' claims and hypotheses are.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from derive.check import Check
    from derive.equations import Equation
    from derive.kernel import Judgement


@dataclass(frozen=True)
class Verification:
    """What came of the checks: by step, and those that failed by equation."""

    outcomes: Mapping[Hashable, tuple[Check, ...]]
    failures: tuple[tuple[str, Check], ...]
    equations: int

    @property
    def passed(self) -> bool:
        """Whether every check of every equation passed."""
        return not self.failures

    @property
    def steps(self) -> int:
        """How many distinct steps were checked."""
        return len(self.outcomes)

    @property
    def checks(self) -> int:
        """How many checks these took."""
        return sum(map(len, self.outcomes.values()))

    def of_kind(self, kind: str) -> int:
        """How many of these are of one kind."""
        return sum(check.kind == kind for checks in self.outcomes.values() for check in checks)

    def of(self, step: Judgement) -> tuple[Check, ...]:
        """The checks of one step."""
        return self.outcomes[identity(step)]


def identity(step: Judgement) -> Hashable:
    """What makes two steps the same."""
    parents = tuple(parent.relation for parent in step.parents)
    return (step.relation, step.rule, parents, step.hypotheses)


def verified(
    equations: Sequence[Equation], progress: Callable[[str], None] = lambda _: None
) -> Verification:
    """Check every step of these equations, and that what is typeset is what was derived; try what
    they claim on models."""
    from derive.check import Check, checks, on_models

    claimed = {identity(claim) for equation in equations for claim in equation.statements}
    outcomes: dict[Hashable, tuple[Check, ...]] = {}
    failures: list[tuple[str, Check]] = []
    for equation in equations:
        progress(f"({equation.id}) {equation.title}")
        shown = Check("typeset", equation.typeset_agrees, "the display form equals the claim")
        found = [shown]
        for step in equation.steps:
            key = identity(step)
            if key not in outcomes:
                outcomes[key] = (*checks(step), *(on_models(step) if key in claimed else ()))
            found += outcomes[key]
        failures += [(equation.id, outcome) for outcome in found if not outcome.passed]
    return Verification(outcomes, tuple(failures), len(equations))
