"""`wear cite`: what to cite, as BibTeX."""

from __future__ import annotations

import argparse

from derive import completion, terminal
from derive.command_line import Command
from wear.cite import REFERENCES, Reference, bibtex

EXAMPLE = """\
  wear cite > derive-wear.bib     all entries
  wear cite note derive-wear      the note and this software
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    keys = parser.add_argument(
        "references",
        metavar="KEY",
        nargs="*",
        type=reference,
        default=tuple(REFERENCES.values()),
        help=f"one of {', '.join(REFERENCES)} (default: all)",
    )
    completion.suggest(keys, lambda: tuple(REFERENCES))


def reference(key: str) -> Reference:
    """Return the reference that an argument names."""
    if key not in REFERENCES:
        raise argparse.ArgumentTypeError(f"{key}: unknown; known are {', '.join(REFERENCES)}")
    return REFERENCES[key]


def execute(options: argparse.Namespace) -> int:
    chosen: tuple[Reference, ...] = options.references
    if options.json:
        terminal.print_json([entry._asdict() for entry in chosen])
    else:
        print("\n\n".join(map(bibtex, chosen)))
    return terminal.DONE


COMMAND = Command("cite", "what to cite, as BibTeX", EXAMPLE, add_arguments, execute)
