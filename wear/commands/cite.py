"""`wear cite`: what to cite, as BibTeX."""

from __future__ import annotations

import argparse

from derive import terminal
from derive.command_line import Command
from wear.cite import REFERENCES, bibtex
from wear.commands import arguments

EXAMPLE = """\
  wear cite > derive-wear.bib     all entries, each with when to cite it
  wear cite note derive-wear      the note and this software
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    arguments.add_choice(
        parser,
        "references",
        lambda: tuple(REFERENCES),
        metavar="KEY",
        nargs="*",
        help=f"one of {', '.join(REFERENCES)} (default: all)",
    )


def execute(options: argparse.Namespace) -> int:
    arguments.read(options).stop_if_any()
    chosen = [REFERENCES[key] for key in options.references or REFERENCES]
    if options.json:
        terminal.print_json([entry._asdict() for entry in chosen])
    else:
        print("\n\n".join(map(bibtex, chosen)))
    return terminal.DONE


COMMAND = Command("cite", "what to cite, as BibTeX", EXAMPLE, add_arguments, execute)
