"""`wear reproduce`: derive, solve and check everything, and write the report.

examples:
  wear reproduce               writes report/report.html with its files
  wear reproduce -o elsewhere  into another folder
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable
from importlib import import_module
from typing import TYPE_CHECKING

from derive import files, terminal
from derive.command_line import OF_THE_REPORT, Answer, Options, Parser
from wear import processes
from wear.commands import arguments

if TYPE_CHECKING:
    from derive.verification import Verification
    from wear.report.claims import Entry
    from wear.report.publish import PdfOutcome


def add_arguments(parser: Parser) -> None:
    """Declare the folder."""
    arguments.add_folder(parser, "folder (default: %(default)s)", "report")


def execute(options: Options) -> Answer:
    """Derive, verify, solve, decide the claims, and write the report."""
    arguments.read(options).stop_if_any()
    for package in OF_THE_REPORT:  # before a derivation of seconds, not after it
        import_module(package)
    folder, start = options.output, time.monotonic()
    command = f"wear reproduce -o {folder.name}"
    with terminal.busy("deriving the equations") as progress:
        contents, verification, ledger, typeset = _reproduce(command, progress)
        files.write_all(folder, contents)
    failures = [f"({i}) {check.kind}: {check.detail}" for i, check in verification.failures]
    verdicts = dict(Counter(str(entry.finding.verdict) for entry in ledger))
    summary = {
        "folder": str(folder),
        "files": sorted(contents),
        "equations": verification.equations,
        "steps": verification.steps,
        "checks": verification.checks,
        "failures": failures,
        "verdicts": verdicts,
        "notice": typeset.notice,
        "seconds": time.monotonic() - start,
    }
    outcome = f"{len(failures)} FAILED" if failures else "all passed"
    lines = (
        f"{verification.equations} equations, {verification.steps} steps, "
        f"{verification.checks} checks: {outcome}",
        f"claims: {', '.join(f'{number} {verdict}' for verdict, number in verdicts.items())}",
        f"report: {folder / 'report.html'}",
    )
    status = terminal.DONE if verification.passed else terminal.FAILED
    notices = (*typeset.notices, *(failure.replace(":", " fails:", 1) for failure in failures))
    return Answer(summary, lambda: "\n".join(lines), notices, status)


def _reproduce(
    command: str, progress: Callable[[str], None]
) -> tuple[dict[str, str | bytes], Verification, tuple[Entry, ...], PdfOutcome]:
    """Return the files by name, the checks, the ledger, and the outcome of the PDF; the
    manifest has the command."""
    from derive.catalogue import all_equations
    from derive.note.claim_checks import SYMBOLIC
    from derive.note.claims import CLAIMS
    from derive.verification import perform_at, verification_of
    from wear.report.claims import SIMULATED, as_json, decided
    from wear.report.paper import drawings, paper
    from wear.report.publish import manifest, published
    from wear.report.runs import run

    with processes.assistant() as ask:
        pending = {claim: ask(decided, claim) for claim in SYMBOLIC}
        catalogue = all_equations()
        outcomes = [ask(perform_at, place) for place in range(len(catalogue))]
        runs = run(lambda scene: progress(f"solving: {scene}"))
        solved = {}
        for claim in SIMULATED:
            progress(f"judging claim {claim}")
            solved[claim] = decided(claim)
        progress("drawing")
        figures = drawings(runs)
        progress("verifying the equations")
        verification = verification_of(catalogue, outcomes)
        entries = tuple(solved.get(claim) or pending[claim]() for claim in CLAIMS)
        progress("writing")
        contents, typeset = published(paper(catalogue, verification, runs, entries, figures))
        contents["claims.json"] = terminal.json_text(as_json(entries))
        scenes = {name: history.definition for name, history in runs.histories.items()}
        contents["manifest.json"] = terminal.json_text(manifest(contents, scenes, command))
    return contents, verification, entries, typeset
