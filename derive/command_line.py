"""Command lines of several commands: what one is, and the parser of all of them.

Key results
    Command    one command, declared
    parser     the parser of a program with commands
    main       parse and execute
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from derive import terminal


@dataclass(frozen=True)
class Command:
    """One command of a program.

    Attributes
    ----------
    name, summary
        What it is called and what it does, in a line.
    example
        Command lines with what they show, printed below its help.
    add_arguments
        Declares its arguments, but for `--json`, which all have.
    execute
        Does the work, prints the result and returns the exit status.
    """

    name: str
    summary: str
    example: str
    add_arguments: Callable[[argparse.ArgumentParser], None]
    execute: Callable[[argparse.Namespace], int]


def parser(
    program: str, description: str, examples: str, commands: Sequence[Command]
) -> argparse.ArgumentParser:
    """Return the parser of a whole command line."""
    whole = argparse.ArgumentParser(
        prog=program,
        description=description,
        epilog=examples,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    terminal.add_common_options(whole)
    branches = whole.add_subparsers(title="commands", metavar="COMMAND", required=True)
    for command in commands:
        branch = branches.add_parser(
            command.name,
            help=command.summary,
            description=f"{command.summary[0].upper()}{command.summary[1:]}.",
            epilog=f"examples:\n{command.example}",
            formatter_class=argparse.RawDescriptionHelpFormatter,
            allow_abbrev=False,
        )
        command.add_arguments(branch)
        branch.add_argument("--json", action="store_true", help="print one JSON document")
        branch.set_defaults(command=command)
    return whole


def main(
    whole: argparse.ArgumentParser,
    arguments: Sequence[str] | None,
    expected: Mapping[type[Exception], int],
) -> int:
    """Execute the command that the arguments name; return the exit status."""
    options = whole.parse_args(arguments)
    command: Command = options.command
    return terminal.run(f"{whole.prog} {command.name}", lambda: command.execute(options), expected)
