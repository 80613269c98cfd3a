"""`derive verify`: run every check again."""

from __future__ import annotations

import argparse

from derive import terminal
from derive.command_line import Command
from derive.commands import arguments

EXAMPLE = """\
  derive verify             every check of every equation; status 1 if one does not hold
  derive verify 8 10 21     those on which these equations rest
  derive verify --deep 13   what fails without each hypothesis, as models show
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare ids, and whether hypotheses are dropped."""
    arguments.add_ids(parser)
    parser.add_argument(
        "--deep", action="store_true", help="drop each hypothesis in turn, too (minutes)"
    )


def execute(options: argparse.Namespace) -> int:
    """Run the checks and say what came of them."""
    from derive import catalogue

    arguments.equations(options.ids)
    verdicts = catalogue.verify(
        options.ids,
        lambda done, total, name: terminal.progress(f"{done}/{total} {name}"),
        options.deep,
    )
    terminal.progress("")
    failed = [verdict for verdict in verdicts if not verdict.passed]
    if options.json:
        terminal.print_json(
            [
                {
                    "id": verdict.id,
                    "status": verdict.status.value,
                    "checks": [
                        {"kind": c.kind, "passed": c.passed, "detail": c.detail}
                        for c in verdict.checks
                    ],
                }
                for verdict in verdicts
            ]
        )
    else:
        width = max(len(verdict.id) for verdict in verdicts)
        for verdict in verdicts:
            bad = [c for c in verdict.checks if not c.passed]
            said = "; ".join(f"{c.kind} fails: {c.detail}" for c in bad)
            held = terminal.count(len(verdict.checks), "check")
            good = f"{held} {'holds' if len(verdict.checks) == 1 else 'hold'}"
            print(f"{verdict.id.ljust(width)}  {verdict.status.value.ljust(18)}  {said or good}")
        total = sum(len(verdict.checks) for verdict in verdicts)
        counted = terminal.count(len(verdicts), "equation"), terminal.count(total, "check")
        outcome = f"{len(failed)} of the equations fail" if failed else "all hold"
        print(f"{', '.join(counted)}: {outcome}")
    return terminal.FAILED if failed else terminal.DONE


COMMAND = Command("verify", "check every step of equations again", EXAMPLE, add_arguments, execute)
