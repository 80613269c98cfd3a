"""`derive verify`: check every step of equations again.

examples:
  derive verify             every check of every equation; status 1 if one does not hold
  derive verify 8 10 21     the checks of the steps of these equations
  derive verify --deep 13   also a counterexample without each hypothesis, where one is found
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from derive import terminal
from derive.command_line import Answer, Options, Parser, declare
from derive.commands import arguments

if TYPE_CHECKING:
    from derive.verification import EquationVerdict


def add_arguments(parser: Parser) -> None:
    """Declare ids and --deep."""
    arguments.add_ids(parser)
    declare(parser, "--deep", "also drop each hypothesis in turn (minutes)")


def execute(options: Options) -> Answer:
    """Run the checks."""
    from derive.verification import verify

    arguments.equations(options.ids)
    verdicts = verify(
        options.ids,
        lambda done, total, name: terminal.progress(f"{done}/{total} {name}"),
        options.deep,
    )
    terminal.progress("")
    document = [
        {
            "id": verdict.id,
            "status": verdict.status.value,
            "checks": [check._asdict() for check in verdict.checks],
        }
        for verdict in verdicts
    ]
    status = terminal.DONE if all(verdict.passed for verdict in verdicts) else terminal.FAILED
    return Answer(document, lambda: "\n".join(_lines(verdicts)), status=status)


def _lines(verdicts: Sequence[EquationVerdict]) -> Iterator[str]:
    """Yield a line for each equation, and the outcome of all."""
    width = max(len(verdict.id) for verdict in verdicts)
    for verdict in verdicts:
        failed = [c for c in verdict.checks if not c.passed]
        faults = "; ".join(f"{c.kind} fails: {c.detail}" for c in failed)
        number = terminal.count(len(verdict.checks), "check")
        success = f"{number} {'holds' if len(verdict.checks) == 1 else 'hold'}"
        yield f"{verdict.id.ljust(width)}  {verdict.status.value.ljust(18)}  {faults or success}"
    total = sum(len(verdict.checks) for verdict in verdicts)
    counted = terminal.count(len(verdicts), "equation"), terminal.count(total, "check")
    false = sum(not verdict.passed for verdict in verdicts)
    outcome = f"{false} of the equations fail" if false else "all hold"
    yield f"{', '.join(counted)}: {outcome}"
