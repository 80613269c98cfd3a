"""Steps: judgements as lemmas with the steps that they rest on, and the record of closed ones.

Overview
    The record has the outcome of Coq for each statement, by its hash, for users without Coq.
Key results
    Step             a judgement with its statement, its name and the steps that it rests on
    steps            the steps of judgements, and the reasons of those that cannot be stated
    record           the committed record
    proved_by_coq    whether a judgement is closed
"""

from __future__ import annotations

import json
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path
from typing import Any

import sympy as sp
from sympy.core.relational import _Inequality as Inequality
from sympy.logic.boolalg import BooleanTrue

from ..claims import Predicate
from ..kernel import Judgement
from .printer import UntranslatableError
from .statements import Statement, claim, key, statement

RECORD = Path(__file__).parent / "record.json"

Row = dict[str, Any]
Record = Mapping[str, Row]


@dataclass(frozen=True, eq=False)
class Step:
    """A judgement as a lemma."""

    key: str
    judgement: Judgement
    statement: Statement
    parents: tuple[Step, ...]
    relation: sp.Basic
    closed: bool = True
    """Whether the step has a proof and can be cited."""

    @property
    def name(self) -> str:
        """Return the name of the lemma."""
        return f"step_{self.key}"

    @property
    def rule(self) -> str:
        """Return the name of the rule."""
        return type(self.judgement.rule).__name__

    @property
    def timed(self) -> bool:
        """Return whether the claim is about every t >= 0."""
        return self.statement.conclusion.startswith("forall t, 0 <= t -> ")

    @property
    def equates(self) -> bool:
        """Return whether the claim is an equation."""
        return isinstance(self.relation, sp.Equality)

    @property
    def assumed(self) -> bool:
        """Return whether the claim is one of the premises, so that no proof is needed."""
        return any(p.proposition == self.statement.conclusion for p in self.statement.premises)

    @property
    def introduction(self) -> str:
        """Return the tactic that names the premises."""
        labels = " ".join(p.label for p in self.statement.premises)
        return f"intros {labels}." if labels else "idtac."

    @cached_property
    def labels(self) -> dict[str, str]:
        """Return the label of each premise."""
        return {p.proposition: p.label for p in self.statement.premises}

    def usable(self, other: Step) -> bool:
        """Return whether another step's premises are all among those of this one."""
        return (other.closed or other.assumed) and all(
            p.proposition in self.labels for p in other.statement.premises
        )

    def cited(self, other: Step) -> str:
        """Return the proof term of another step, from this one's premises."""
        if other.statement.conclusion in self.labels:
            return self.labels[other.statement.conclusion]
        return " ".join(
            (other.name, *(self.labels[p.proposition] for p in other.statement.premises))
        )

    def at_time(self, other: Step, time: str = "t", proof: str = "Ht") -> str:
        """Return the proof term of another step's claim at a time."""
        return f"{self.cited(other)} {time} {proof}" if other.timed else self.cited(other)

    def stated(self, steps: Iterable[Step]) -> str:
        """Return the tactic that states the claims of other steps, equations to be inserted."""
        return "".join(f"given ({self.at_time(other)}); " for other in steps)

    def signs(self, time: str = "t", proof: str = "Ht") -> list[str]:
        """Return the tactics that state the known signs at a time.

        They come from inequalities, and from names that are positive and equal an expression.
        """
        lines = []
        rests_on = [s for s in (*self.hypotheses, *self.ancestors) if not s.relation.has(sp.Limit)]
        signs = {s.relation.args: s for s in self.hypotheses if isinstance(s.relation, sp.Gt)}
        for other in rests_on:
            known = self.at_time(other, time, proof)
            if isinstance(other.relation, (Inequality, sp.Ne)):
                lines.append(f"pose proof ({known}).")
            elif isinstance(other.relation, sp.And):
                lines.append(f"given ({known}).")
            elif other.equates and (other.relation.lhs, 0) in signs:
                sign = signs[other.relation.lhs, sp.S.Zero]
                lines.append(f"pose proof (sign_of ({self.at_time(sign, time, proof)}) ({known})).")
        return list(dict.fromkeys(lines))

    @cached_property
    def frontier(self) -> list[Step]:
        """Return the usable parents, and the nearest usable ancestors of the other parents."""
        nearest: dict[str, Step] = {}

        def visit(step: Step) -> None:
            for parent in step.parents:
                if self.usable(parent):
                    nearest.setdefault(parent.name, parent)
                else:
                    visit(parent)

        visit(self)
        return list(nearest.values())

    @cached_property
    def ancestors(self) -> list[Step]:
        """Return all usable steps that this one rests on, nearest first."""
        usable: dict[str, Step] = {}
        row: list[Step] = list(self.parents)
        while row:
            for step in row:
                if self.usable(step):
                    usable.setdefault(step.name, step)
            row = list(dict.fromkeys(p for step in row for p in step.parents))
        return list(usable.values())

    @cached_property
    def hypotheses(self) -> list[Step]:
        """Return the premises with a relation, as steps to cite."""
        return [
            Step(p.label, self.judgement, Statement((p,), p.proposition), (), p.relation)
            for p in self.statement.premises
            if not isinstance(p.relation, (BooleanTrue, Predicate))
        ]

    @cached_property
    def limits(self) -> list[Step]:
        """Return the nearest usable steps whose claims are limits."""
        return [s for s in self.frontier if s.equates and s.relation.has(sp.Limit)]

    @property
    def diverging(self) -> Step:
        """Return the first of these steps with an infinite limit."""
        return next(s for s in self.limits if s.relation.rhs == sp.oo)


def steps(
    judgements: Iterable[Judgement], closed: Collection[str]
) -> tuple[dict[str, Step], dict[str, str]]:
    """Return judgements as steps by key, premises first, and the reasons of unstatable ones.

    Judgements with the same statement and citations are one step; ``closed`` are the keys of
    steps with a proof.
    """
    known: dict[str, Step] = {}
    refused: dict[str, str] = {}
    for judgement in judgements:
        try:
            stated, name = statement(judgement), key(judgement)
        except UntranslatableError as reason:
            if judgement.parents:
                refused[str(judgement.relation)] = str(reason)
        else:
            parents = [known[k] for p in judgement.parents if (k := _key(p)) in known]
            proved = name in closed
            new = Step(name, judgement, stated, tuple(parents), claim(judgement), proved)
            known.setdefault(name, new)
    return known, refused


def _key(judgement: Judgement) -> str | None:
    try:
        return key(judgement)
    except UntranslatableError:
        return None


@cache
def record() -> Record:
    """Return the committed record: whether a step is closed, by which tactic, or why not."""
    rows: Record = json.loads(RECORD.read_text(encoding="utf-8"))
    return rows


def proved_by_coq(judgement: Judgement) -> bool:
    """Return whether Coq has closed a judgement, according to the record."""
    return bool(record().get(_key(judgement) or "", {}).get("closed"))
