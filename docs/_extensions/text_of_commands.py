"""The commands as Markdown: the help that each prints."""

from __future__ import annotations

import argparse
import os

import derive.cli
import wear.cli
from derive.completion import commands

PARSERS = {"derive": derive.cli.parser, "wear": wear.cli.parser}


def reference(program: str) -> str:
    """A section a command, with its help; the program's own comes first."""
    os.environ["COLUMNS"] = "88"  # argparse wraps to the terminal's width
    whole = PARSERS[program]()
    parts = [_help(whole)]
    for name, branch in commands(whole).items():
        parts += [f"(command-{program}-{name})=\n### `{program} {name}`", _help(branch)]
    return "\n\n".join(parts)


def _help(parser: argparse.ArgumentParser) -> str:
    return f"```text\n{parser.format_help().rstrip()}\n```"
