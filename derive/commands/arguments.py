"""Arguments that commands share: ids of equations and files to write."""

from __future__ import annotations

from typing import TYPE_CHECKING

from derive import files
from derive.command_line import Answer, Options, Parser, declare
from derive.faults import UsageError

if TYPE_CHECKING:
    from derive.equations import Equation


def add_ids(parser: Parser) -> None:
    """Declare any number of ids; none means all equations."""
    declare(parser, "[ID ...]", "an equation (default: all)", dest="ids")


def equations(ids: list[str]) -> tuple[Equation, ...]:
    """Return the equations of these ids, or all; UsageError names every unknown id."""
    from derive import catalogue

    chosen, faults = [], []
    for identifier in ids:
        try:
            chosen.append(catalogue.equation(identifier))
        except catalogue.UnknownEquationError as fault:
            faults.append(str(fault))
    if faults:
        raise UsageError("\n".join(faults))
    return tuple(chosen) if ids else catalogue.all_equations()


def answer(options: Options, document: object, text: str) -> Answer:
    """Return an answer whose text is printed, or written to the file of `--output`."""
    if options.json or options.output is None:
        return Answer(document, lambda: text)
    if problem := files.obstacle(options.output):
        raise UsageError(f"--output: {problem}")
    files.write_atomically(options.output, text)
    return Answer(document)
