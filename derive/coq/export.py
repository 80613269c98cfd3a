"""The export: files for Coq, and the record of the steps that it closed.

Overview
    Each section of the catalogue is a file, so that two of them compile at once; a step that is
    not closed is exported as a proposition without proof.  The record has for every statement,
    by its hash, whether Coq closed it and by which proof, or the reason why not.  Users without
    Coq read it; a check with Coq fails where it differs.
Key results
    Export            the files, from judgements and a record
    compile_faults    the faults that Coq finds in them
    AXIOMS            the beginnings of the axioms that theorems may rest on
"""

from __future__ import annotations

import re
import shutil
import subprocess
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from ..equations import Equation
from ..files import write_all
from ..kernel import Judgement
from ..rules.assumption import is_hypothesis
from . import proofs, refutations
from .statements import key, obstacle, world
from .steps import Record, Step, record, steps

LIBRARY = Path(__file__).parent / "library"
THEOREMS = ("Tanh", "Limits", "Integrals", "Drift", "Tactics")
"""The files of the library, each after those that it needs."""

AXIOMS = (
    *(f"ClassicalDedekindReals.sig_{each}_dec" for each in ("forall", "not")),
    "FunctionalExtensionality.functional_extensionality_dep",
    "Classical_Prop.classic",
    *("PrimInt63.", "Uint63."),
)
"""Those of the classical reals, and Coq's own 63-bit integers, of its interval arithmetic."""
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
    """Coq or one of its libraries is not installed; the message has the command to install it."""


@dataclass(frozen=True)
class Export:
    """The files of some equations, with proofs of the steps that the record has as closed."""

    equations: tuple[Equation, ...]
    known: Record = field(default_factory=record)

    @cached_property
    def stated(self) -> dict[str, Step]:
        """Return all steps that can be stated, by their keys."""
        return steps((step for e in self.equations for step in e.steps), self.known)

    @property
    def steps(self) -> list[Step]:
        """Return the steps to prove, premises first."""
        return [step for step in self.stated.values() if not is_hypothesis(step.judgement)]

    @cached_property
    def inferences(self) -> list[Judgement]:
        """Return the steps that are no hypotheses, each once; several may be one statement."""
        every = {name: step for e in self.equations for name, step in e.keyed_steps.items()}
        return [step for step in every.values() if not is_hypothesis(step)]

    @property
    def counts(self) -> dict[str, int]:
        """Return the numbers of inferences, of closed ones, and of those that cannot be stated."""
        names = list(filter(None, map(key, self.inferences)))
        closed, every = sum(self.stated[name].closed for name in names), len(self.inferences)
        return {"steps": every, "closed": closed, "unstated": every - len(names)}

    @property
    def unrecorded(self) -> str:
        """Return a line for each step that the record lacks."""
        missing = (s for s in self.steps if s.key not in self.known)
        return "".join(f"not in the record: {s.rule} {s.relation}\n" for s in missing)

    def lemma(self, step: Step) -> str:
        """Return a step with its proof, or as an open proposition."""
        title = f"(* {step.rule}: {step.judgement.name or 'no name'} *)\n"
        if step.closed:
            lemma = f"Lemma {step.name} {{w : world}} :\n  {step.statement.text}.\n"
            return f"{title}{lemma}Proof.\n{proofs.script(step)}\nQed.\n"
        reason = self.known.get(step.key, {}).get("reason", "not in the record")
        proposition = f"open_{step.name} {{w : world}} : Prop :=\n  {step.statement.text}"
        return f"{title}(* open: {reason} *)\nDefinition {proposition}.\n"

    @cached_property
    def groups(self) -> dict[str, list[Step]]:
        """Return the steps by the section of the first equation that needs them."""
        remaining = {step.judgement: step for step in self.steps}
        groups: dict[str, list[Step]] = {}
        for equation in self.equations:
            section = re.sub(r"\W+", "_", equation.section).strip("_")
            group = groups.setdefault(f"Section_{section}", [])
            group += [remaining.pop(step) for step in equation.steps if step in remaining]
        return {name: group for name, group in groups.items() if group}

    @property
    def world(self) -> str:
        """Return the file that declares the quantities."""
        relations = [s.relation for s in self.stated.values()]
        relations += [p.relation for s in self.stated.values() for p in s.statement.premises]
        return f"{HEAD}Open Scope R_scope.\n\n{world((*relations, *refutations.RELATIONS))}"

    @cached_property
    def files(self) -> dict[str, str]:
        """Return the exported files by name, each after those that it needs."""
        home = {step.name: group for group, steps in self.groups.items() for step in steps}
        files = {"World": self.world}
        groups = {g: "\n".join(map(self.lemma, steps)) for g, steps in self.groups.items()}
        if refuting := self.refuting:
            groups["Refutations"] = refutations.text(refuting)
        for group, text in groups.items():
            cited = {home[name] for name in re.findall(r"step_\w+", text)} - {group}
            needed = " ".join(("World", *(g for g in groups if g in cited)))
            head = f"{HEAD}From Wear Require Import {needed}.\n"
            files[group] = f"{head}Open Scope R_scope.\n\n{text}"
        proved = re.findall(r"^Lemma (\w+)", "".join(files.values()), re.MULTILINE)
        everything = ", ".join(f"@{name}" for name in proved) or "I"
        files["Assumptions"] = (
            f"From Wear Require Import {' '.join(files)}.\n"
            f"Definition everything := ({everything}).\nPrint Assumptions everything.\n"
        )
        unstated = ((s, obstacle(s)) for s in self.inferences if not key(s))
        listed = (f"(* {step.relation}:\n   {reason} *)\n" for step, reason in unstated)
        return files | {"Unstated": "".join(listed)}

    @property
    def refuting(self) -> dict[str, Step]:
        """Return the steps that contradict claims of the note; none unless all are closed."""
        needed = {e.id: key(e.statements[0]) for e in self.equations if e.id in refutations.NEEDS}
        found = {i: self.stated[k] for i, k in needed.items() if self.stated[k].closed}
        return found if len(found) == len(refutations.NEEDS) else {}

    def write(self, folder: Path, files: Mapping[str, str] | None = None) -> None:
        """Write library, files (default: all of them) and a Makefile for them.

        A file that has its text already stays, and is not compiled again.
        """
        files = self.files if files is None else files
        texts = {name: (LIBRARY / f"{name}.v").read_text(encoding="utf-8") for name in THEOREMS}
        texts = {f"{name}.v": text for name, text in (texts | dict(files)).items()}
        targets = " ".join(f"{name}.vo" for name in files)
        texts["Makefile"] = f"all: {targets}\n{MAKEFILE}"
        for file in [file for file in texts if (folder / file).is_file()]:
            if (folder / file).read_bytes() == texts[file].encode():
                del texts[file]
        write_all(folder, texts)


def ran(folder: Path, *argv: str, said: str = "") -> subprocess.CompletedProcess[str]:
    """Run a program in a folder, with something said to it."""
    return subprocess.run(argv, cwd=folder, input=said, capture_output=True, text=True, check=False)


def compile_faults(folder: Path, targets: Sequence[str] = (), jobs: int = 2) -> str:
    """Compile an export; return the faults that Coq reports, empty if all is proved.

    MissingError if Coq or a library is not installed.
    """
    if shutil.which("coqc") is None or shutil.which("make") is None:
        raise MissingError(f"coqc and make are needed: apt install make {PACKAGES}")
    done = ran(folder, "make", "-s", "-k", f"-j{jobs}", *targets)
    if "Cannot find a physical path" in done.stdout:
        raise MissingError(f"a library of Coq is missing: apt install {PACKAGES}")
    if done.returncode or targets:
        return done.stdout + done.stderr
    report = (folder / "Assumptions.log").read_text(encoding="utf-8")
    if "Closed under the global context" not in report and "Axioms:" not in report:
        return "Coq does not report the axioms of the theorems\n"
    axioms = set(re.findall(r"^([\w.]+)\s*:", report.partition("Axioms:")[2], re.MULTILINE))
    other = sorted(name for name in axioms if not name.startswith(AXIOMS))
    return "".join(f"an axiom that is not pinned: {name}\n" for name in other)
