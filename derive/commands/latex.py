"""`derive latex`: the equations as macros for a report."""

from __future__ import annotations

import argparse

from derive import terminal
from derive.command_line import Command
from derive.commands import arguments

EXAMPLE = r"""
  derive latex -o equations.tex      all equations; then \input{equations} and \EqWearPerCycle
  derive latex 21 22                 two of them, to the terminal
""".lstrip("\n")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare ids and the file."""
    arguments.add_ids(parser)
    parser.add_argument("-o", "--output", metavar="FILE", help="write to a file")


def execute(options: argparse.Namespace) -> int:
    """Print or write the macros."""
    from derive.typeset.macros import macro_name, macros

    found = arguments.equations(options.ids)
    if options.json:
        terminal.print_json(
            [{"id": e.id, "macro": "\\" + macro_name(e), "latex": e.latex} for e in found]
        )
        return terminal.DONE
    arguments.print_or_write(macros(found), options.output)
    return terminal.DONE


COMMAND = Command("latex", "equations as LaTeX macros", EXAMPLE, add_arguments, execute)
