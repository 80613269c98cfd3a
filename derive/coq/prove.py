"""Renewal of the record: Coq tries the steps that have a new proof.

Overview
    ``python -m derive.coq.prove`` writes ``record.json``.  What was closed by the same proof before
    is taken as proved here; ``make proof`` proves all steps.
Key results
    renewed    the record of the steps of equations
"""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Mapping
from pathlib import Path

from ..catalogue import all_equations
from ..equations import Equation
from ..files import write_atomically
from .export import HEAD, Export, compile_faults, ran
from .steps import RECORD, Record, Row, Step, record

_FOLDER = Path("build/prove")
_SETTINGS = "From Wear Require Import World.\nOpen Scope R_scope.\nSet Default Timeout 60.\n"
"""The time limit is in seconds, for one sentence of a proof."""


def renewed(equations: tuple[Equation, ...], known: Record) -> dict[str, Row]:
    """Return the record of the steps of equations, as Coq closes them.

    All steps are stated as if they were closed.  Those that fail and cite no other that fails are
    open; the rest is tried again without them.
    """
    proved = set(_proposed(Export(equations, known)).values())
    refused: set[str] = set()
    while True:
        rows = {s.key: _row(s, s.name in refused) for s in Export(equations).steps}
        export = Export(equations, rows)
        texts = _proposed(export)
        failed = _unproved(export, texts, proved)
        if not failed:
            return rows
        refused |= {n for n in failed if not failed & set(re.findall(r"step_\w+", texts[n])) - {n}}


def _row(step: Step, refused: bool) -> Row:
    row: Row = {"rule": step.rule, "closed": not refused}
    return row | ({"reason": "no tactic of the exporter closes it"} if refused else {})


def _proposed(export: Export) -> dict[str, str]:
    """Return the lemmas of the steps that should be closed, empty where no proof is proposed."""
    texts = {}
    for step in export.steps:
        if step.closed:
            try:
                texts[step.name] = export.lemma(step)
            except Exception:  # no form of a proof fits the claim
                texts[step.name] = ""
    return texts


def _unproved(export: Export, texts: Mapping[str, str], proved: set[str]) -> set[str]:
    """Return the names of lemmas that Coq does not prove; a failure ends one, not the session."""
    export.write(_FOLDER, {"World": export.world})
    if fault := compile_faults(_FOLDER, ("World.vo",)):
        sys.exit(fault)
    session = f"{HEAD}{_SETTINGS}"
    for name, text in texts.items():
        if text in proved:
            text = re.sub(r"Proof\..*Qed\.", "Admitted.", text, flags=re.DOTALL)
        session += f"{text}Abort All.\nLocate {name}.\n"
    done = ran(_FOLDER, "coqtop", "-q", "-w", "none", "-Q", ".", "Wear", said=session)
    return texts.keys() - set(re.findall(r"Constant Top\.(step_\w+)", done.stdout))


def main() -> None:
    """Write the record of all steps."""
    rows = renewed(all_equations(), record())
    lines = ",\n".join(f'"{key}": {json.dumps(rows[key])}' for key in sorted(rows))
    write_atomically(RECORD, f"{{\n{lines}\n}}\n")
    print(f"{sum(row['closed'] for row in rows.values())} of {len(rows)} steps closed")


if __name__ == "__main__":
    main()
