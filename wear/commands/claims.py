"""`wear claims`: the ledger of the note's claims, each decided by a computation of this run."""

from __future__ import annotations

import argparse
import textwrap
from collections import Counter
from collections.abc import Sequence

from derive import terminal
from derive.command_line import Command
from wear.commands import arguments

EXAMPLE = """\
  wear claims               every claim of the note, with verdict and evidence
  wear claims C24 C36       two of them
  wear claims --json        the same for another program
"""
_WIDTH = 96


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the ids of claims."""
    arguments.add_choice(
        parser, "ids", _known, metavar="ID", nargs="*", help="a claim, C1 to C41 (default: all)"
    )


def execute(options: argparse.Namespace) -> int:
    """Decide the claims and print what was found."""
    from wear.report.claims import as_json, ledger

    arguments.read(options).stop_if_any()
    with terminal.busy("deciding the claims") as tell:
        entries = ledger(lambda done, total, claim: tell(f"{done}/{total} {claim}"), options.ids)
    if options.json:
        terminal.print_json(as_json(entries))
        return terminal.DONE
    for claim, finding in entries:
        print(f"{claim.id}  {claim.where}: {claim.statement}")
        print(f"     {finding.verdict}")
        indent = " " * 5
        print(
            textwrap.fill(finding.evidence, _WIDTH, initial_indent=indent, subsequent_indent=indent)
        )
    print(f"\n{_summary([finding.verdict for _, finding in entries])}")
    return terminal.DONE


def _known() -> Sequence[str]:
    from derive.note.claims import CLAIMS

    return tuple(CLAIMS)


def _summary(verdicts: Sequence[str]) -> str:
    """
    >>> _summary(["confirmed", "refuted", "confirmed"])
    '3 claims: 2 confirmed, 1 refuted'
    """
    found = Counter(verdicts).most_common()
    parts = ", ".join(f"{number} {verdict}" for verdict, number in found)
    return f"{terminal.count(len(verdicts), 'claim')}: {parts}"


COMMAND = Command(
    "claims",
    "the claims of the published note, each decided by a computation",
    EXAMPLE,
    add_arguments,
    execute,
)
