"""`derive code`: source code of a variant of the model, for a solver of your own.

examples:
  derive code rigid_bearing                          section 4 of the note, in NumPy
  derive code rigid_worn_rough --target c            section 3, in C
  derive code exponential/rigid_bearing              another contact law
  derive code --list                                 the variants
"""

from __future__ import annotations

import difflib
from typing import TYPE_CHECKING

from derive.command_line import Answer, Options, Parser, declare
from derive.commands import arguments
from derive.faults import UsageError

if TYPE_CHECKING:
    from derive.variant import Variant

TARGETS = ("numpy", "c", "header", "fortran", "javascript")  # here without importing SymPy


def add_arguments(parser: Parser) -> None:
    """Declare the variant and the language."""
    about = "a variant (--list names them), or LAW/VARIANT (default law: tanh)"
    declare(parser, "[VARIANT]", about, _short_names)
    about = "language, or the header of the C source (default: %(default)s)"
    declare(parser, f"--target {{{','.join(TARGETS)}}}", about, default="numpy")
    declare(parser, "--list", "list the variants and stop")
    declare(parser, "-o, --output FILE", "write to a file")


def variants() -> dict[str, Variant]:
    """Return the variants by their names, with their law."""
    from derive.variant import VARIANTS

    return {f"{variant.law.name}/{variant.name}": variant for variant in VARIANTS}


def _short_names() -> list[str]:
    """Return the names of the variants, without the default law."""
    return [name.removeprefix("tanh/") for name in variants()]


def execute(options: Options) -> Answer:
    """Print or write the source."""
    from derive.codegen.sources import source
    from derive.program import program

    known = variants()
    if options.list:
        return Answer(list(known), lambda: "\n".join(known))
    if options.variant is None:
        raise UsageError("name a variant; `derive code --list` shows them")
    name = options.variant if "/" in options.variant else f"tanh/{options.variant}"
    if name not in known:
        near = difflib.get_close_matches(name, known, n=1, cutoff=0.0)
        raise UsageError(f"{options.variant}: no such variant; did you mean {near[0]}?")
    functions = program(known[name])
    text = source(functions, options.target)
    document = {
        "variant": name,
        "target": options.target,
        "equations": list(functions.equations),
        "operations": functions.operations,
        "source": text,
    }
    return arguments.answer(options, document, text)
