"""`derive export`: the steps as lemmas for a proof assistant.

examples:
  derive export -o proof            the steps as lemmas, and the cited theorems
  derive export -o proof --check    compile them too; status 1 where Coq differs from the record
"""

from __future__ import annotations

from pathlib import Path

from derive import terminal
from derive.command_line import Answer, Options, Parser, declare
from derive.commands import arguments
from derive.faults import UsageError


def add_arguments(parser: Parser) -> None:
    """Declare target, folder and --check."""
    arguments.add_ids(parser)
    about = "proof assistant (default: %(default)s)"
    declare(parser, "--target {coq}", about, default="coq")
    declare(parser, "-o, --output DIR", "folder of the files", required=True)
    declare(parser, "--check", "compile the files and compare with the record")


def execute(options: Options) -> Answer:
    """Write the files; compile them if requested."""
    from derive.coq import export

    folder = Path(options.output)
    lemmas = export.Export(arguments.equations(options.ids))
    lemmas.write(folder)
    faults = ""
    if options.check:
        try:
            faults = lemmas.unrecorded + export.compile_faults(folder)
        except export.MissingError as fault:
            raise UsageError(str(fault)) from fault
    counts = lemmas.counts
    done = "compiled" if options.check and not faults else "written"
    text = f"{counts['closed']} of {counts['steps']} steps {done} as lemmas in {folder}\n{faults}"
    return Answer(
        {**counts, "folder": str(folder), "faults": faults.splitlines()},
        lambda: text,
        status=terminal.FAILED if faults else terminal.DONE,
    )
