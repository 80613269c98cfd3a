"""Verification: the checks on which equations rest, each distinct step checked once.

Overview
    Different equations rest on the same steps, which are built again for each variant of the
    model.  Two steps are the same if their rules, claims, hypotheses and those of their parents
    are.  Each equation is a task, which may be done in another process.
Key results
    verify            the verdict on each equation, as ``derive verify`` prints it
    verification_of   the outcome of all checks together, for the report
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, partial
from typing import NamedTuple

from .catalogue import all_equations, equation
from .check import Check, condition_checks, model_checks, step_checks
from .equations import Equation, Status
from .kernel import Judgement, StepKey, step_key
from .rules.assumption import Assume


@dataclass(frozen=True)
class EquationVerdict:
    """The outcome of the checks of one equation."""

    id: str
    status: Status
    checks: tuple[Check, ...]

    @property
    def passed(self) -> bool:
        """Return whether every check passed."""
        return all(outcome.passed for outcome in self.checks)


@dataclass(frozen=True)
class Verification:
    """The outcome of the checks of many equations: by step, and the failures by equation."""

    outcomes: Mapping[StepKey, tuple[Check, ...]]
    failures: tuple[tuple[str, Check], ...]
    equations: int

    @property
    def passed(self) -> bool:
        """Return whether every check of every equation passed."""
        return not self.failures

    @property
    def steps(self) -> int:
        """Return the number of distinct steps that were checked."""
        return len(self.outcomes)

    @property
    def inferences(self) -> int:
        """Return the number of steps that are no hypotheses: only these are tried on models."""
        return sum(not isinstance(rule, Assume) for rule, *_ in self.outcomes)

    @property
    def checks(self) -> int:
        """Return the number of checks of steps."""
        return sum(map(len, self.outcomes.values()))

    def of_kind(self, kind: str) -> int:
        """Return the number of checks of steps that are of one kind."""
        return sum(check.kind == kind for checks in self.outcomes.values() for check in checks)


class Task(NamedTuple):
    """An equation, the keys of all its steps, and the steps that are in no earlier task.

    ``stated`` are the steps that an equation states; models are drawn for them.
    """

    equation: Equation
    keys: tuple[StepKey, ...]
    steps: Mapping[StepKey, Judgement]
    stated: frozenset[StepKey]


class Outcome(NamedTuple):
    """The checks of a task: of its equation, and of each of its steps."""

    equation: tuple[Check, ...]
    steps: tuple[tuple[Check, ...], ...]


def tasks(equations: Sequence[Equation]) -> list[Task]:
    """Return a task for each equation; every step is in one of them alone."""
    stated = frozenset(step_key(s) for entry in equations for s in entry.statements)
    seen: set[StepKey] = set()
    result = []
    for entry in equations:
        keyed = entry.keyed_steps
        new = {key: step for key, step in keyed.items() if key not in seen}
        seen |= new.keys()
        result.append(Task(entry, tuple(keyed), new, stated & new.keys()))
    return result


def perform(task: Task) -> Outcome:
    """Check the steps of a task, its stated ones on models too, and the typeset form."""
    shown = Check("typeset", task.equation.typeset_agrees, "the display form equals the claim")
    steps = (
        (*step_checks(step), *(model_checks(step) if key in task.stated else ()))
        for key, step in task.steps.items()
    )
    return Outcome((shown,), tuple(steps))


def perform_at(place: int) -> Outcome:
    """Perform the task at this place of the catalogue; a worker process builds its own tasks."""
    return perform(_catalogue()[place])


@cache
def _catalogue() -> list[Task]:
    return tasks(all_equations())


def _by_step(work: Sequence[Task], done: Sequence[Outcome]) -> dict[StepKey, tuple[Check, ...]]:
    return {
        key: checks
        for task, outcome in zip(work, done, strict=True)
        for key, checks in zip(task.steps, outcome.steps, strict=True)
    }


def _verdicts(work: Sequence[Task], done: Sequence[Outcome]) -> tuple[EquationVerdict, ...]:
    """Return the verdicts on equations from the outcomes of all tasks."""
    known = _by_step(work, done)
    return tuple(
        EquationVerdict(
            task.equation.id,
            task.equation.status,
            (*(check for key in task.keys for check in known[key]), *outcome.equation),
        )
        for task, outcome in zip(work, done, strict=True)
    )


def verify(
    identifiers: str | Iterable[str] = (),
    progress: Callable[[int, int, str], None] | None = None,
    deep: bool = False,
) -> tuple[EquationVerdict, ...]:
    """Re-run every check on which the named equations rest (all of them if none is named).

    A text is one identifier.  Every step is tried on models.  ``progress`` receives the number of
    equations done, that of all, and the id of the next.  With ``deep`` each hypothesis of an
    equation is dropped in turn, which takes minutes.
    """
    named = (identifiers,) if isinstance(identifiers, str) else identifiers
    chosen = [equation(identifier) for identifier in named] or list(all_equations())
    work = [task._replace(stated=frozenset(task.steps)) for task in tasks(chosen)]
    done = []
    for number, task in enumerate(work):
        if progress is not None:
            progress(number, len(work), task.equation.id)
        shown, steps = perform(task)
        needed = (c for s in task.equation.statements for c in condition_checks(s)) if deep else ()
        done.append(Outcome((*shown, *needed), steps))
    return _verdicts(work, done)


def verification_of(
    equations: Sequence[Equation], outcomes: Sequence[Callable[[], Outcome]] | None = None
) -> Verification:
    """Check every step of these equations; ``outcomes``, if given, fetch those of their tasks."""
    work = tasks(equations)
    fetches = [partial(perform, task) for task in work] if outcomes is None else outcomes
    done = [fetch() for fetch in reversed(fetches)][::-1]  # no other process has begun the last
    verdicts = _verdicts(work, done)
    failures = ((v.id, check) for v in verdicts for check in v.checks if not check.passed)
    return Verification(_by_step(work, done), tuple(failures), len(equations))
