"""Steps: judgements as lemmas with the facts that their proofs may cite, and the record.

Overview
    A proof cites premises of its lemma, and closed steps whose premises the lemma has too.  The
    record has the outcome of Coq for each statement, by its hash, for users without Coq.
Key results
    Step             a judgement with its statement and the steps that it rests on
    steps            the steps of judgements
    record           the committed record
    proved_by_coq    whether a judgement is closed
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path
from typing import Any

import sympy as sp
from sympy.core.relational import _Inequality as Inequality

from ..kernel import Judgement
from .printer import timed
from .statements import Fact, Statement, claim, key, statement

RECORD = Path(__file__).parent / "record.json"

Row = dict[str, Any]
Record = Mapping[str, Row]


@dataclass(frozen=True, eq=False)
class Step:
    """A judgement as a lemma; a closed one has a proof and can be cited."""

    key: str
    judgement: Judgement
    statement: Statement
    parents: tuple[Step, ...]
    relation: sp.Basic
    closed: bool

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
        return timed(self.statement.conclusion)

    @cached_property
    def labels(self) -> dict[str, str]:
        """Return the label of each premise."""
        return {p.proposition: p.proof for p in self.statement.premises}

    @property
    def assumed(self) -> bool:
        """Return whether the claim is one of the premises, so that no proof is needed."""
        return self.statement.conclusion in self.labels

    def usable(self, other: Step) -> bool:
        """Return whether another step's premises are all among those of this one."""
        return (other.closed or other.assumed) and all(
            p.proposition in self.labels for p in other.statement.premises
        )

    def fact(self, other: Step) -> Fact:
        """Return a usable step as a fact."""
        labels = (self.labels[p.proposition] for p in other.statement.premises)
        proof = self.labels.get(other.statement.conclusion) or " ".join((other.name, *labels))
        return Fact(proof, other.statement.conclusion, other.relation)

    @cached_property
    def given(self) -> list[Fact]:
        """Return the facts from which the claim follows: the parents that can be cited."""
        return list(dict.fromkeys(self.fact(p) for p in self.parents if self.usable(p)))

    @cached_property
    def ancestors(self) -> list[Fact]:
        """Return all facts that the claim rests on, nearest first."""
        found: dict[str, Step] = {}
        row: list[Step] = list(self.parents)
        while row:
            found |= {step.name: step for step in row if step.name not in found}
            row = list(dict.fromkeys(p for step in row for p in step.parents))
        return [self.fact(step) for step in found.values() if self.usable(step)]

    @cached_property
    def sources(self) -> list[Fact]:
        """Return the facts from which the claim follows at one time, without limits.

        They are the given ones and the equations among the hypotheses that no parent has; or all,
        where a parent cannot be cited.
        """
        cited = all(map(self.usable, self.parents))
        old = {self.labels.get(p) for parent in self.parents for p in parent.labels if cited}
        own = (h for h in self.statement.premises if h.equates and h.proof not in old)
        facts = (*(self.given if cited else self.ancestors), *own)
        now = (f for f in facts if self.timed or not f.timed)
        return [f for f in dict.fromkeys(now) if not f.relation.has(sp.Limit)]

    @property
    def limits(self) -> list[Fact]:
        """Return the given limits of known value."""
        return [f for f in self.given if isinstance(f.relation.args[0], sp.Limit)]

    def signs(self, time: str = "t", instant: str = "Ht") -> str:
        """Return the tactics that state the known signs at a time, or without one.

        They come from inequalities, and from names that are positive and equal an expression.
        """
        lines = []
        given = self.statement.premises
        positive = {p.relation.args for p in given if isinstance(p.relation, sp.Gt)}
        for fact in (f for f in (*given, *self.ancestors) if time or not f.timed):
            known = fact.at(time, instant)
            if isinstance(fact.relation, (Inequality, sp.Ne, sp.And, sp.Equivalent)):
                lines.append(f"given ({known}).")
            elif fact.equates and (fact.relation.lhs, 0) in positive:
                lines.append(f"pose proof (sign_of ({known}) ltac:(auto with real)).")
        return "\n".join(dict.fromkeys(lines))


def stated(facts: Iterable[Fact]) -> str:
    """Return the tactic that states facts at the time t, equations to be inserted."""
    return "".join(f"given ({fact.at()}); " for fact in facts)


def steps(judgements: Iterable[Judgement], rows: Record) -> dict[str, Step]:
    """Return the judgements that can be stated as steps by key, premises first.

    Judgements with the same statement and citations are one step; a record has which are closed.
    """
    known: dict[str, Step] = {}
    for judgement in judgements:
        if (name := key(judgement)) and name not in known:
            parents = tuple(known[k] for p in judgement.parents if (k := key(p)) in known)
            lemma, closed = statement(judgement), rows.get(name, {}).get("closed", False)
            known[name] = Step(name, judgement, lemma, parents, claim(judgement), closed)
    return known


@cache
def record() -> Record:
    """Return the committed record: whether a step is closed, or why not."""
    return dict(json.loads(RECORD.read_text(encoding="utf-8")))


def proved_by_coq(judgement: Judgement) -> bool:
    """Return whether Coq has closed a judgement, according to the record."""
    return bool(record().get(key(judgement), {}).get("closed"))
