"""Command lines of several commands: what one is, and the parser of all of them.

Key results
    Command    one command, declared
    Parser     gathers the faults of arguments
    parser     the parser of a program with commands
    main       parse and execute
"""

from __future__ import annotations

import argparse
import difflib
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from derive import completion, terminal

OF_THE_REPORT = ("matplotlib", "math_core", "markdown_it")
"""What only figures and reports need: the extra `report`."""


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


class Parser(argparse.ArgumentParser):
    """A parser that gathers what the types of its arguments refuse, into `options.faults`: the
    command reports them with all others."""

    def __init__(self, **about: Any) -> None:
        super().__init__(**about)
        self.faults: list[str] = []
        self.set_defaults(faults=self.faults)

    def _get_value(self, action: argparse.Action, text: str) -> Any:
        try:
            return super()._get_value(action, text)
        except argparse.ArgumentError as fault:
            name = action.option_strings[-1] if action.option_strings else action.metavar
            self.faults.append(f"{name}: {fault.message}")
            return None


def parser(
    program: str, description: str, examples: str, commands: Sequence[Command]
) -> argparse.ArgumentParser:
    """Return the parser of a whole command line."""
    whole = Parser(
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
    words = sys.argv[1:] if arguments is None else list(arguments)

    def execute() -> int:
        options = _parsed(whole, words)
        command: Command = options.command
        try:
            return command.execute(options)
        except ModuleNotFoundError as missing:
            package = (missing.name or "").partition(".")[0]
            if package not in OF_THE_REPORT:
                raise
            extra = "pip install 'derive-wear[report]'"
            whole.error(f"{command.name}: needs the package {package}: {extra}")

    return terminal.run(" ".join([whole.prog, *words[:1]]), execute, expected)


def _parsed(whole: argparse.ArgumentParser, words: Sequence[str]) -> argparse.Namespace:
    """Parse; what is mistyped is met with what was meant, by the parser of the command."""
    branches = completion.commands(whole)
    if not words:
        whole.print_help(sys.stderr)
        whole.exit(terminal.USAGE)
    known = [*branches, *_options(whole)]
    if words[0] not in known:
        hint = _meant(words[0], known) or f"; `{whole.prog} --help` lists what there is"
        whole.error(f"{words[0]}: there is no such command{hint}")
    options, left = whole.parse_known_args(words)
    if left:
        branch = branches[options.command.name]
        wrong = [word for word in left if word.startswith("-")] or left
        hints = (f"{word}: not understood{_meant(word, _options(branch))}" for word in wrong)
        branch.error("\n".join(hints))
    return options


def _options(parser: argparse.ArgumentParser) -> list[str]:
    return [option for action in parser._actions for option in action.option_strings]


def _meant(word: str, known: Iterable[str]) -> str:
    """
    >>> _meant("--cylces", ["--cycles", "--json"])
    '; did you mean --cycles?'
    """
    near = difflib.get_close_matches(word, known, n=1)
    return f"; did you mean {near[0]}?" if near else ""
