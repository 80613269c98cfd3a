"""Renewal of the record: open steps are tried in a session of Coq, tactic by tactic.

Overview
    ``python -m derive.coq.prove`` writes ``record.json``.  Closed steps whose proofs have not
    changed are taken as proved here; ``make proof`` proves all of them.
Key results
    attempt    the record after one session
"""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path

from ..catalogue import all_equations
from .export import HEAD, Export, compile_faults
from .steps import RECORD, Row, Step

_FOLDER = Path("build/prove")
_SETTINGS = "From Wear Require Import World.\nOpen Scope R_scope.\nSet Default Timeout 30.\n"
"""The time limits are in seconds, for one sentence of a proof; each of several tactics has 12."""


def attempt(before: Export, candidates: set[str]) -> tuple[dict[str, Row], set[str]]:
    """Try to close steps, by their keys; return the new record and the keys to try again.

    A step is tried again if it cites a candidate that stays open: it was stated as if that were
    closed.  Candidates that cite no such step are not tried again, so that repeated attempts end.
    """
    known = before.known
    tentative: dict[str, Row] = {**known, **{h: {"closed": True} for h in candidates}}
    export = Export(before.equations, tentative)
    texts = {}
    for step in export.steps:
        row = known.get(step.key, {})
        text = _lemma(export, step, tentative.get(step.key, row))
        if "\nProof." in text and text == _lemma(before, step, row):
            text = re.sub(r"Proof\..*Qed\.", "Admitted.", text, flags=re.DOTALL)
        elif tentative.get(step.key, row).get("closed"):
            text = _lemma(export, step, {"closed": True})
        texts[step.name] = f"{text}Abort All.\nLocate {step.name}.\n"
    output = _session(export, "".join(texts.values()))
    closed = set(re.findall(r"Constant Top\.(step_\w+)", output))
    failed = {s.name for s in export.steps if s.closed} - closed
    ways = {name: int(way) for name, way in re.findall(r"WAY (step_\w+) (\d+)", output)}
    rows: dict[str, Row] = {}
    retry = set()
    for step in export.steps:
        retried = failed & (set(re.findall(r"step_\w+", texts[step.name])) - {step.name})
        new: Row = {"rule": step.rule, "closed": step.name in closed and not retried}
        if step.name in ways:
            new["way"] = ways[step.name]
        elif "Admitted." in texts[step.name] and "way" in tentative.get(step.key, {}):
            new["way"] = tentative[step.key]["way"]
        if not new["closed"]:
            new["reason"] = "no tactic of the exporter closes it"
        if retried:
            retry.add(step.key)
        rows[step.key] = new
    return rows, retry


def _lemma(export: Export, step: Step, row: Row) -> str:
    """Return the text of a lemma, an open one if no proof can be proposed."""
    try:
        return export.lemma(step, row)
    except (LookupError, RuntimeError, StopIteration, TypeError, ValueError, AttributeError):
        return export.lemma(step, {"reason": "no proof is proposed"})


def _session(export: Export, lemmas: str) -> str:
    """Return Coq's output for lemmas; a failure ends one of them, not the session."""
    export.write(_FOLDER, {"World": export.world})
    if fault := compile_faults(_FOLDER, ("World.vo",)):
        sys.exit(fault)
    done = subprocess.run(
        ["coqtop", "-q", "-w", "none", "-Q", ".", "Wear"],
        cwd=_FOLDER, input=f"{HEAD}{_SETTINGS}{lemmas}",
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    return done.stdout


def main() -> None:
    """Try the open steps until no new one can be cited, and write the record."""
    export = Export(all_equations())
    rows = dict(export.known)
    candidates = {s.key for s in export.steps if not s.closed}
    while candidates:
        rows, candidates = attempt(export, candidates)
        export = Export(export.equations, rows)
    lines = ",\n".join(f'"{key}": {json.dumps(rows[key])}' for key in sorted(rows))
    RECORD.write_text(f"{{\n{lines}\n}}\n", encoding="utf-8")
    print(f"{sum(row['closed'] for row in rows.values())} of {len(rows)} steps closed")


if __name__ == "__main__":
    main()
