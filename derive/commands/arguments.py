"""Arguments that commands share: ids of equations and files to write."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from derive import files
from derive.faults import UsageError

if TYPE_CHECKING:
    from derive.equations import Equation


def add_ids(parser: argparse.ArgumentParser) -> None:
    """Declare any number of ids; none means all equations."""
    parser.add_argument("ids", metavar="ID", nargs="*", help="an equation (default: all)")


def equations(ids: list[str]) -> tuple[Equation, ...]:
    """Return the equations of these ids, or all; UsageError tells every id that is unknown."""
    from derive import catalogue

    found, faults = [], []
    for identifier in ids:
        try:
            found.append(catalogue.equation(identifier))
        except catalogue.UnknownEquationError as fault:
            faults.append(str(fault))
    if faults:
        raise UsageError("\n".join(faults))
    return tuple(found) if ids else catalogue.equations()


def print_or_write(text: str, output: str | None) -> None:
    """Print a text, or write it whole to a file."""
    if output is None:
        print(text, end="" if text.endswith("\n") else "\n")
    elif problem := files.obstacle(output):
        raise UsageError(f"--output: {problem}")
    else:
        files.write_atomically(output, text)
