"""Verification: the checks on which equations rest, each distinct step checked once.

Overview
    Different equations rest on the same steps, which are built anew for each variant of the
    model.  A step is the same if its rule, its claim and hypotheses, and those of its parents
    are.  The work of many equations is in parts, one an equation, that may be done elsewhere.
Key results
    verify      the verdict on each equation: what ``derive verify`` prints
    verified    all of them together: what the report counts
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, partial
from typing import NamedTuple

from .catalogue import all_equations, equation
from .check import Check, checks, on_models, reasons_of
from .equations import Equation, Status
from .kernel import Judgement, identity


@dataclass(frozen=True)
class Verdict:
    """What came of the checks of one equation."""

    id: str
    status: Status
    checks: tuple[Check, ...]

    @property
    def passed(self) -> bool:
        """Whether every check passed."""
        return all(outcome.passed for outcome in self.checks)


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
    """An equation with those of its steps on which no equation before it rests; ``claimed`` are
    those that an equation states."""

    equation: Equation
    steps: Mapping[Hashable, Judgement]
    claimed: frozenset[Hashable]


class Outcome(NamedTuple):
    """The checks of a part: of its equation, and of each of its steps."""

    equation: tuple[Check, ...]
    steps: tuple[tuple[Check, ...], ...]


def parts(equations: Sequence[Equation]) -> list[Part]:
    """Return the work of checking equations, nothing twice."""
    claimed = frozenset(identity(claim) for each in equations for claim in each.statements)
    seen: set[Hashable] = set()
    found = []
    for one in equations:
        new = {key: step for step in one.steps if (key := identity(step)) not in seen}
        seen |= new.keys()
        found.append(Part(one, new, claimed & new.keys()))
    return found


def checked(part: Part) -> Outcome:
    """Check the steps of a part, and that what is typeset is what was derived; try what it claims
    on models."""
    shown = Check("typeset", part.equation.typeset_agrees, "the display form equals the claim")
    steps = (
        (*checks(step), *(on_models(step) if key in part.claimed else ()))
        for key, step in part.steps.items()
    )
    return Outcome((shown,), tuple(steps))


def checked_at(place: int) -> Outcome:
    """Check the part of the catalogue at this place, in whatever process."""
    return checked(_catalogue()[place])


@cache
def _catalogue() -> list[Part]:
    return parts(all_equations())


def _by_step(work: Sequence[Part], found: Sequence[Outcome]) -> dict[Hashable, tuple[Check, ...]]:
    return {
        key: made
        for part, outcome in zip(work, found, strict=True)
        for key, made in zip(part.steps, outcome.steps, strict=True)
    }


def _verdicts(work: Sequence[Part], found: Sequence[Outcome]) -> tuple[Verdict, ...]:
    """Return the verdicts on equations from what came of their parts."""
    known = _by_step(work, found)
    return tuple(
        Verdict(
            one.id,
            one.status,
            (*(check for s in one.steps for check in known[identity(s)]), *outcome.equation),
        )
        for (one, _, _), outcome in zip(work, found, strict=True)
    )


def verify(
    identifiers: str | Iterable[str] = (),
    progress: Callable[[int, int, str], None] | None = None,
    deep: bool = False,
) -> tuple[Verdict, ...]:
    """Re-run every check on which the named equations rest (all of them if none is named); a text
    is one identifier.

    Every step is tried on models.  ``progress`` is told how many of how many equations are done,
    and which is next.  With ``deep`` each hypothesis of an equation is dropped in turn, which
    takes minutes.
    """
    named = (identifiers,) if isinstance(identifiers, str) else identifiers
    chosen = [equation(identifier) for identifier in named] or list(all_equations())
    work = [part._replace(claimed=frozenset(part.steps)) for part in parts(chosen)]
    found = []
    for number, part in enumerate(work):
        if progress is not None:
            progress(number, len(work), part.equation.id)
        shown, steps = checked(part)
        why = (r for s in part.equation.statements for r in reasons_of(s)) if deep else ()
        found.append(Outcome((*shown, *why), steps))
    return _verdicts(work, found)


def verified(
    equations: Sequence[Equation], answers: Sequence[Callable[[], Outcome]] | None = None
) -> Verification:
    """Check every step of these equations, unless ``answers`` have what came of their parts."""
    work = parts(equations)
    fetched = [partial(checked, part) for part in work] if answers is None else answers
    found = [fetch() for fetch in reversed(fetched)][::-1]  # the last ones are not begun elsewhere
    verdicts = _verdicts(work, found)
    failures = ((v.id, check) for v in verdicts for check in v.checks if not check.passed)
    return Verification(_by_step(work, found), tuple(failures), len(equations))
