"""`derive generate`: write the generated modules of wear.

examples:
  derive generate            bring wear/generated up to date
  derive generate --check    write nothing; status 1 if it is out of date
"""

from __future__ import annotations

from pathlib import Path

from derive import terminal
from derive.command_line import Answer, Options, Parser, declare


def add_arguments(parser: Parser) -> None:
    """Declare --check."""
    declare(parser, "--check", "write nothing; status 1 if out of date")


def folder() -> Path:
    """Return the folder of generated modules, beside this package."""
    return Path(__file__).resolve().parents[2] / "wear" / "generated"


def execute(options: Options) -> Answer:
    """Write the files, or list those that are out of date."""
    from derive import generate

    changed = generate.outdated(folder()) if options.check else generate.write(folder())
    current = generate.sources()
    done = {name: "written" if name in current else "removed" for name in changed}
    lines = [f"{'out of date' if options.check else done[name]}: {name}" for name in changed]
    return Answer(
        {"changed": list(changed), "written": not options.check},
        lambda: "\n".join(lines) or "up to date",
        status=terminal.FAILED if options.check and changed else terminal.DONE,
    )
