"""The checks of every derivation, each distinct step checked once.

Different equations rest on the same steps, which `derive` builds anew for each variant of the
model. A step is the same if claim, rule, parents' claims and hypotheses are.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, partial
from typing import TYPE_CHECKING, NamedTuple

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


class Part(NamedTuple):
    """An equation with those of its steps on which no equation before it rests; models are asked
    of the steps that are `claimed` by an equation."""

    equation: Equation
    steps: Mapping[Hashable, Judgement]
    claimed: frozenset[Hashable]


class Outcome(NamedTuple):
    """The checks of a part: of its display form, and of each of its steps."""

    shown: Check
    steps: tuple[tuple[Check, ...], ...]


def identity(step: Judgement) -> Hashable:
    """Return what makes two steps the same."""
    parents = tuple(parent.relation for parent in step.parents)
    return (step.relation, step.rule, parents, step.hypotheses)


def parts(equations: Sequence[Equation]) -> list[Part]:
    """Return the work of checking equations, nothing twice."""
    claimed = frozenset(identity(claim) for each in equations for claim in each.statements)
    seen: set[Hashable] = set()
    found = []
    for equation in equations:
        steps = {identity(step): step for step in equation.steps}
        new = {key: step for key, step in steps.items() if key not in seen}
        seen |= new.keys()
        found.append(Part(equation, new, claimed & new.keys()))
    return found


def checked(part: Part) -> Outcome:
    """Check the steps of a part, and that what is typeset is what was derived; try what it claims
    on models."""
    from derive.check import Check, checks, on_models

    shown = Check("typeset", part.equation.typeset_agrees, "the display form equals the claim")
    steps = (
        (*checks(step), *(on_models(step) if key in part.claimed else ()))
        for key, step in part.steps.items()
    )
    return Outcome(shown, tuple(steps))


def checked_at(place: int) -> Outcome:
    """Check the part of the catalogue at this place, in whatever process."""
    return checked(_catalogue()[place])


@cache
def _catalogue() -> list[Part]:
    from derive.catalogue import equations

    return parts(equations())


def verified(
    equations: Sequence[Equation], answers: Sequence[Callable[[], Outcome]] | None = None
) -> Verification:
    """Check every step of these equations, unless `answers` have what came of their parts."""
    work = parts(equations)
    fetched = [partial(checked, part) for part in work] if answers is None else answers
    found = [fetch() for fetch in reversed(fetched)][::-1]  # the last ones are not begun elsewhere
    outcomes = {
        key: checks
        for part, outcome in zip(work, found, strict=True)
        for key, checks in zip(part.steps, outcome.steps, strict=True)
    }
    failures = [
        (equation.id, check)
        for equation, outcome in zip(equations, found, strict=True)
        for check in (outcome.shown, *(c for s in equation.steps for c in outcomes[identity(s)]))
        if not check.passed
    ]
    return Verification(outcomes, tuple(failures), len(equations))
