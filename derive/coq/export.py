"""The export: files that Coq compiles, and the record of what it closed.

Overview
    A file a section of the catalogue, so that two of them compile at once; what is not closed
    is exported as a proposition without proof.  The record says of every statement, by its
    hash, whether Coq closed it and how, or why not; users without Coq read it, and a check with
    Coq fails where it differs.
Key results
    Export      the files, from judgements and a record
    compile     what Coq says of them
    AXIOMS      what theorems may rest on: the classical axioms of the reals
"""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cache, cached_property
from pathlib import Path
from typing import Any

from ..equations import Equation
from ..kernel import Judgement
from . import printer, proofs, refutations
from .statements import statement, world
from .steps import Step, steps

LIBRARY = Path(__file__).parent / "library"
THEOREMS = ("Tanh", "Limits", "Drift", "Bounds", "Tactics")
"""The files of the library, each after those that it needs."""
RECORD = Path(__file__).parent / "record.json"

AXIOMS = frozenset(
    {
        "ClassicalDedekindReals.sig_forall_dec",
        "ClassicalDedekindReals.sig_not_dec",
        "FunctionalExtensionality.functional_extensionality_dep",
        "Classical_Prop.classic",
    }
)
PACKAGES = "coq libcoq-coquelicot libcoq-interval"

_HEAD = f"""From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Wear Require Import {" ".join(THEOREMS)}.
"""

Record = Mapping[str, Mapping[str, Any]]


class MissingError(OSError):
    """Coq or a library of it is not installed; the message says how to install it."""


@cache
def record() -> Record:
    """Return the committed record: by the hash of a statement, closed or why not."""
    return json.loads(RECORD.read_text(encoding="utf-8")) if RECORD.exists() else {}


def closed(judgement: Judgement) -> bool:
    """Return whether Coq has closed a judgement, as the record has it."""
    try:
        return bool(record().get(statement(judgement).hash, {}).get("closed"))
    except printer.UntranslatableError:
        return False


@dataclass(frozen=True)
class Export:
    """The files of some equations; ``known`` says which way closes a step, None tries all."""

    equations: tuple[Equation, ...]
    known: Record | None = field(default_factory=record)

    @cached_property
    def _stated(self) -> tuple[list[Step], dict[str, str]]:
        return steps(step for equation in self.equations for step in equation.steps)

    @property
    def steps(self) -> list[Step]:
        """Return the steps to prove, premises first."""
        return [step for step in self._stated[0] if not step.assumed]

    @property
    def refused(self) -> dict[str, str]:
        """Return the claims that Coq's library has no words for, with the reason."""
        return self._stated[1]

    @cached_property
    def groups(self) -> dict[str, list[Step]]:
        """Return the steps by the section of the first equation that needs them."""
        known = {step.statement.hash: step for step in self.steps}
        groups: dict[str, list[Step]] = {}
        for equation in self.equations:
            made = groups.setdefault(_file(equation.section), [])
            for judgement in equation.steps:
                try:
                    found = known.pop(statement(judgement).hash, None)
                except printer.UntranslatableError:
                    continue
                made += [found] if found else []
        return {name: made for name, made in groups.items() if made}

    @cached_property
    def files(self) -> dict[str, str]:
        """Return the exported files by name."""
        said = [h.relation for step in self._stated[0] for h in step.judgement.hypotheses]
        texts = {"World": f"{_HEAD}Open Scope R_scope.\n\n{world([*said, *(s.relation for s in self._stated[0])])}"}
        earlier = ["World"]
        for name, group in self.groups.items():
            lemmas = "\n".join(map(self._lemma, group))
            texts[name] = f"{_HEAD}From Wear Require Import {' '.join(earlier)}.\nOpen Scope R_scope.\n\n{lemmas}"
            earlier.append(name)
        return texts

    def _lemma(self, step: Step) -> str:
        row = {} if self.known is None else self.known.get(step.statement.hash, {})
        text = f"(* {step.rule}: {step.judgement.name or step.statement.hash} *)\n"
        if self.known is not None and not row.get("closed"):
            return f"{text}Definition open_{step.name} {{w : world}} : Prop :=\n  {step.statement.text}.\n"
        proof = proofs.script(step, row.get("way"))
        return f"{text}Lemma {step.name} {{w : world}} :\n  {step.statement.text}.\nProof.\n{proof}\nQed.\n"
