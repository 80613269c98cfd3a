"""The command `derive`: parses the line and runs one command of `derive.commands`."""

from __future__ import annotations

from collections.abc import Sequence

from derive import command_line, terminal
from derive.faults import UsageError

COMMANDS = "list_ show steps verify latex code generate export"

EXAMPLES = """\
examples:
  derive show 21
  derive verify
  derive COMMAND --help
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run `derive` with these arguments (default: those of the process); return the status."""
    return command_line.main(parser(), arguments, {UsageError: terminal.USAGE})


def parser() -> command_line.Parser:
    """Return the parser of the whole command line."""
    description = "The equations of wear under cyclic contact, derived and checked by machine."
    return command_line.parser("derive", description, EXAMPLES, COMMANDS)
