"""`wear claims`: the claims of the published note, each decided by a computation.

examples:
  wear claims               every claim of the note, with verdict and evidence
  wear claims C24 C36       two of them
  wear claims --json        the same for another program
"""

from __future__ import annotations

import textwrap
from collections import Counter
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from derive import terminal
from derive.command_line import Answer, Options, Parser
from wear.commands import arguments

if TYPE_CHECKING:
    from wear.report.claims import Entry

_WIDTH, _INDENT = 96, " " * 5


def add_arguments(parser: Parser) -> None:
    """Declare the ids of claims."""
    about = "a claim, C1 to C41 (default: all)"
    arguments.add_choice(parser, "[ID ...]", _known, about, dest="ids")


def execute(options: Options) -> Answer:
    """Decide the claims."""
    from wear.report.claims import as_json, decided

    arguments.read(options).stop_if_any()
    entries: list[Entry] = []
    with terminal.busy("deciding the claims") as tell:
        for number, claim in enumerate(chosen := options.ids or _known()):
            tell(f"{number}/{len(chosen)} {claim}")
            entries.append(decided(claim))
    return Answer(as_json(entries), lambda: "\n".join(_lines(entries)))


def _lines(entries: Sequence[Entry]) -> Iterator[str]:
    """Yield every claim with its verdict and the evidence."""
    for claim, finding in entries:
        yield f"{claim.id}  {claim.where}: {claim.statement}"
        yield f"{_INDENT}{finding.verdict}"
        yield textwrap.fill(
            finding.evidence, _WIDTH, initial_indent=_INDENT, subsequent_indent=_INDENT
        )
    found = Counter(finding.verdict for _, finding in entries).most_common()
    parts = ", ".join(f"{number} {verdict}" for verdict, number in found)
    yield f"\n{terminal.count(len(entries), 'claim')}: {parts}"


def _known() -> Sequence[str]:
    from derive.note.claims import CLAIMS

    return tuple(CLAIMS)
