"""`derive latex`: the equations as macros for a report."""

from __future__ import annotations

import argparse

from derive import terminal
from derive.command_line import Command
from derive.commands import arguments
from derive.faults import UsageError

EXAMPLE = r"""
  derive latex -o equations.tex      all equations; then \input{equations} and \EqWearPerCycle
  derive latex 21 22                 two of them, to the terminal
  derive latex 21 --derivation       how (21) follows, as prose with equations
  derive latex 21 --width 246pt      for a column of 246 pt: \EqWearPerCycle or \EqNote{21}
""".lstrip("\n")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare ids and the file."""
    arguments.add_ids(parser)
    parser.add_argument("-o", "--output", metavar="FILE", help="write to a file")
    parser.add_argument(
        "--derivation", action="store_true", help="the chain of steps to one equation, as prose"
    )
    parser.add_argument(
        "--width",
        metavar="LENGTH",
        help="of a line, in pt, mm, cm or in (default: that of article)",
    )


def execute(options: argparse.Namespace) -> int:
    """Print or write the macros."""
    from derive.typeset.macros import WIDTH, macro_name, macros, room

    try:
        width = WIDTH if options.width is None else room(options.width)
    except ValueError as fault:
        raise UsageError(f"--width: {fault}") from None
    if options.derivation:
        return _derivation(options, width)
    found = arguments.equations(options.ids)
    if options.json:
        terminal.print_json(
            [{"id": e.id, "macro": "\\" + macro_name(e), "latex": e.latex} for e in found]
        )
        return terminal.DONE
    arguments.print_or_write(macros(found, width), options.output)
    return terminal.DONE


def _derivation(options: argparse.Namespace, width: float) -> int:
    """Print or write the derivation of one equation, told with those before it in the catalogue."""
    from derive.catalogue import equations_up_to
    from derive.typeset.derivation import prose

    if len(options.ids) != 1 or options.json:
        raise UsageError("--derivation: name one equation, without --json")
    arguments.equations(options.ids)
    arguments.print_or_write(prose(equations_up_to(options.ids[0]), width), options.output)
    return terminal.DONE


COMMAND = Command("latex", "equations as LaTeX macros", EXAMPLE, add_arguments, execute)
