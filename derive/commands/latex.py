r"""`derive latex`: equations as LaTeX macros.

examples:
  derive latex -o equations.tex      all equations; then \input{equations} and \EqWearPerCycle
  derive latex 21 22                 two of them, to the terminal
  derive latex 21 --derivation       how (21) follows, as prose with equations
  derive latex --law 'exp(-r/2)'     the equations of a bearing with a contact law of its own
  derive latex 21 --width 246pt      for a column of 246 pt: \EqWearPerCycle or \EqNote{21}
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from derive.command_line import Answer, Options, Parser, declare
from derive.commands import arguments
from derive.faults import UsageError

if TYPE_CHECKING:
    from derive.equations import Equation


def add_arguments(parser: Parser) -> None:
    """Declare ids and the file."""
    arguments.add_ids(parser)
    declare(parser, "-o, --output FILE", "write to a file")
    declare(parser, "--derivation", "the chain of steps to one equation, as prose")
    about = "of a line, in pt, mm, cm or in (default: that of article)"
    declare(parser, "--width LENGTH", about)
    about = "instead of ids: the equations of a bearing with this contact law, phi of r = h/sigma"
    declare(parser, "--law FORMULA", about)


def execute(options: Options) -> Answer:
    """Print or write the macros."""
    from derive.typeset.macros import WIDTH, macro_name, macros, room

    try:
        width = WIDTH if options.width is None else room(options.width)
    except ValueError as fault:
        raise UsageError(f"--width: {fault}") from None
    if options.derivation:
        return _derivation(options, width)
    if options.law is not None and options.ids:
        raise UsageError("--law: its equations have no ids; leave these out")
    chosen = arguments.equations(options.ids) if options.law is None else _of_law(options.law)
    document = [{"id": e.id, "macro": "\\" + macro_name(e), "latex": e.latex} for e in chosen]
    return arguments.answer(options, document, macros(chosen, width))


def _of_law(formula: str) -> Sequence[Equation]:
    from derive.note.governing import Pin
    from derive.own_law import own_law
    from derive.variant import Variant
    from derive.variant_equations import equations_of

    law, _ = own_law(formula)
    return equations_of(Variant(law, False, Pin.ABSENT), opening=False)


def _derivation(options: Options, width: float) -> Answer:
    """Print or write the derivation of one equation from those before it in the catalogue."""
    from derive.catalogue import equations_up_to
    from derive.typeset.derivation import prose

    if len(options.ids) != 1 or options.json or options.law is not None:
        raise UsageError("--derivation: name one equation, without --json or --law")
    arguments.equations(options.ids)
    text = prose(equations_up_to(options.ids[0]), width)
    return arguments.answer(options, None, text)
