"""The command `wear`: parses the line and runs one command of `wear.commands`."""

from __future__ import annotations

from collections.abc import Sequence

from derive import command_line, terminal
from wear.faults import AccuracyError, Interrupted, SceneError, UsageError, WorkersLost

# In the order in which a newcomer needs them.
COMMANDS = """
    scenes run asymptote figure sensitivity fit study explore report reproduce claims bench cite
"""

EXAMPLES = """\
examples:
  wear scenes
  wear run section4 --cycles 1,9000,1e8
  wear run --help
"""

EXPECTED = {
    UsageError: terminal.USAGE,
    SceneError: terminal.USAGE,
    AccuracyError: terminal.INACCURATE,
    Interrupted: terminal.INTERRUPTED,
    WorkersLost: terminal.INTERRUPTED,
}


def main(arguments: Sequence[str] | None = None) -> int:
    """Run `wear` with these arguments (default: those of the process); return the exit status."""
    return command_line.main(parser(), arguments, EXPECTED)


def parser() -> command_line.Parser:
    """Return the parser of the whole command line."""
    description = "Wear of bearings under cyclic contact, for any number of cycles."
    return command_line.parser("wear", description, EXAMPLES, COMMANDS)
