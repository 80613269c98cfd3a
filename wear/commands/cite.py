"""`wear cite`: references to cite, as BibTeX.

examples:
  wear cite > derive-wear.bib     all entries, each with when to cite it
  wear cite note derive-wear      the note and this software
"""

from __future__ import annotations

from derive.command_line import Answer, Options, Parser
from wear.cite import REFERENCES, bibtex
from wear.commands import arguments


def add_arguments(parser: Parser) -> None:
    known, about = tuple(REFERENCES), f"one of {', '.join(REFERENCES)} (default: all)"
    arguments.add_choice(parser, "[KEY ...]", lambda: known, about, dest="references")


def execute(options: Options) -> Answer:
    arguments.read(options).stop_if_any()
    chosen = [REFERENCES[key] for key in options.references or REFERENCES]
    document = [entry._asdict() for entry in chosen]
    return Answer(document, lambda: "\n\n".join(map(bibtex, chosen)))
