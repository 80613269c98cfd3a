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

import re
import shutil
import subprocess
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from ..equations import Equation
from . import proofs, refutations
from .statements import key, world
from .steps import Record, Row, Step, record, steps

LIBRARY = Path(__file__).parent / "library"
THEOREMS = ("Tanh", "Limits", "Integrals", "Drift", "Tactics")
"""The files of the library, each after those that it needs."""

AXIOMS = frozenset(
    {
        "ClassicalDedekindReals.sig_forall_dec",
        "ClassicalDedekindReals.sig_not_dec",
        "FunctionalExtensionality.functional_extensionality_dep",
        "Classical_Prop.classic",
    }
)
MACHINE_INTEGERS = ("PrimInt63.", "Uint63.")
"""Coq's own 63-bit integers, with which its interval arithmetic computes."""
PACKAGES = "coq libcoq-coquelicot libcoq-interval"

HEAD = f"""From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Wear Require Import {" ".join(THEOREMS)}.
"""

MAKEFILE = """\
%.vo: %.v
\t@coqc -q -w none -Q . Wear $< > $*.log 2>&1 || (cat $*.log; exit 1)
.depend: $(wildcard *.v)
\t@coqdep -Q . Wear $^ > $@
-include .depend
"""


class MissingError(OSError):
    """Coq or a library of it is not installed; the message says how to install it."""


@dataclass(frozen=True)
class Export:
    """The files of some equations, with the proofs of what the record calls closed."""

    equations: tuple[Equation, ...]
    known: Record = field(default_factory=record)

    @cached_property
    def _stated(self) -> tuple[dict[str, Step], dict[str, str]]:
        closed = {key for key, row in self.known.items() if row["closed"]}
        return steps((step for e in self.equations for step in e.steps), closed)

    @property
    def steps(self) -> list[Step]:
        """Return the steps to prove, premises first."""
        return [step for step in self._stated[0].values() if not step.assumed]

    @property
    def refused(self) -> dict[str, str]:
        """Return the claims that Coq's library has no words for, with the reason."""
        return self._stated[1]

    @property
    def counts(self) -> dict[str, int]:
        """Return how many steps there are, how many are closed, and cannot be stated."""
        proved = sum(text.count("\nLemma ") for text in self.lemmas.values())
        return {
            "steps": len(self.steps) + len(self.refused),
            "closed": proved,
            "unstated": len(self.refused),
        }

    @property
    def unrecorded(self) -> str:
        """Return what the record does not say of these steps."""
        missing = (s for s in self.steps if s.key not in self.known)
        return "".join(f"not in the record: {s.rule} {s.relation}\n" for s in missing)

    @cached_property
    def lemmas(self) -> dict[str, str]:
        """Return the text of each step, by its name."""
        return {s.name: self.lemma(s, self.known.get(s.key, {})) for s in self.steps}

    def lemma(self, step: Step, row: Row) -> str:
        """Return a step with its proof, or as an open proposition."""
        said = f"{{w : world}} :\n  {step.statement.text}"
        title = f"(* {step.rule}: {step.judgement.name or 'no name'} *)\n"
        if not row.get("closed"):
            said = said.replace(" :\n", " : Prop :=\n", 1)
            reason = row.get("reason", "not in the record")
            return f"{title}(* open: {reason} *)\nDefinition open_{step.name} {said}.\n"
        proof = proofs.script(step, row.get("way"))
        return f"{title}Lemma {step.name} {said}.\nProof.\n{proof}\nQed.\n"

    @cached_property
    def groups(self) -> dict[str, list[str]]:
        """Return the names of steps by the section of the first equation that needs them."""
        left = {step.judgement: step.name for step in self.steps}
        groups: dict[str, list[str]] = {}
        for equation in self.equations:
            made = groups.setdefault(_file_name(equation.section), [])
            made += [left.pop(judgement) for judgement in equation.steps if judgement in left]
        return {name: made for name, made in groups.items() if made}

    @property
    def world(self) -> str:
        """Return the file that declares the quantities."""
        stated = self._stated[0].values()
        relations = [s.relation for s in stated]
        relations += [h.relation for s in stated for h in s.judgement.hypotheses]
        relations += refutations.RELATIONS
        return f"{HEAD}Open Scope R_scope.\n\n{world(relations)}"

    @cached_property
    def files(self) -> dict[str, str]:
        """Return the exported files by name, each after those that it needs."""
        home = {name: group for group, names in self.groups.items() for name in names}
        files = {"World": self.world}
        for group, names in self.groups.items():
            text = "\n".join(self.lemmas[name] for name in names)
            cited = {home[name] for name in re.findall(r"step_\w+", text)} - {group}
            files[group] = _importing(("World", *(g for g in self.groups if g in cited))) + text
        if refuting := self.refuting:
            homes = dict.fromkeys(home[step.name] for step in refuting.values())
            head = "From Interval Require Import Tactic.\n" + _importing(("World", *homes))
            files["Refutations"] = head + refutations.text(refuting)
        files["Assumptions"] = self._assumptions(files)
        return files

    @property
    def refuting(self) -> dict[str, Step]:
        """Return the steps that contradict claims of the note; none unless all are closed."""
        wanted = {e.id: key(e.statements[0]) for e in self.equations if e.id in refutations.NEEDS}
        found = {i: s for i, k in wanted.items() if (s := self._stated[0][k]).closed}
        return found if len(found) == len(refutations.NEEDS) else {}

    def _assumptions(self, files: Iterable[str]) -> str:
        """Return the file that prints what all theorems together rest on."""
        proved = [name for name, text in self.lemmas.items() if "\nLemma " in text]
        proved += refutations.NAMES.values() if self.refuting else ()
        everything = ", ".join(f"@{name}" for name in proved)
        return (
            f"From Wear Require Import {' '.join(files)}.\n"
            f"Definition everything := ({everything}).\nPrint Assumptions everything.\n"
        )

    def write(self, folder: Path, files: Mapping[str, str] | None = None) -> None:
        """Write library, files (all of them, if none are named) and a Makefile for them."""
        files = self.files if files is None else files
        folder.mkdir(parents=True, exist_ok=True)
        for name in THEOREMS:
            _update(folder / f"{name}.v", (LIBRARY / f"{name}.v").read_text(encoding="utf-8"))
        for name, text in files.items():
            _update(folder / f"{name}.v", text)
        targets = " ".join(f"{name}.vo" for name in files)
        _update(folder / "Makefile", f"all: {targets}\n{MAKEFILE}")


def _importing(files: Iterable[str]) -> str:
    """Return the first lines of a file that rests on others."""
    return f"{HEAD}From Wear Require Import {' '.join(files)}.\nOpen Scope R_scope.\n\n"


def _update(path: Path, text: str) -> None:
    """Write a file unless it is there already, compiled perhaps."""
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")


def _file_name(section: str) -> str:
    return "Section_" + re.sub(r"\W+", "_", section).strip("_")


def compiled(folder: Path, targets: Sequence[str] = (), jobs: int = 2) -> str:
    """Compile an export; return what Coq says against it, empty where all is proved.

    MissingError where Coq or a library is not installed.
    """
    if shutil.which("coqc") is None or shutil.which("make") is None:
        raise MissingError(f"coqc and make are needed: apt install make {PACKAGES}")
    done = subprocess.run(
        ["make", "-s", "-k", f"-j{jobs}", *targets],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )
    if "Cannot find a physical path" in done.stdout:
        raise MissingError(f"a library of Coq is missing: apt install {PACKAGES}")
    if done.returncode or targets:
        return done.stdout + done.stderr
    said = (folder / "Assumptions.log").read_text(encoding="utf-8")
    if "Closed under the global context" not in said and "Axioms:" not in said:
        return "Coq does not say what the theorems rest on\n"
    found = set(re.findall(r"^([\w.]+)\s*:", said.partition("Axioms:")[2], re.MULTILINE))
    other = {name for name in found - AXIOMS if not name.startswith(MACHINE_INTEGERS)}
    return "".join(f"an axiom that is not pinned: {name}\n" for name in sorted(other))
