"""`derive show`: one equation, with its conditions.

examples:
  derive show 21                 for the terminal
  derive show 21 --as latex      for a report
  derive show 21 --as srepr      the SymPy relation, for another program
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from derive import terminal
from derive.command_line import Answer, Options, Parser, declare
from derive.commands import arguments

if TYPE_CHECKING:
    from derive.equations import Equation


def add_arguments(parser: Parser) -> None:
    """Declare the id and the form."""
    declare(parser, "ID", "an equation, as `derive list` names it")
    forms, about = ",".join(_WRITERS), "form (default: %(default)s)"
    declare(parser, f"--as {{{forms}}}", about, dest="form", default="text")


def document(found: Equation) -> dict[str, Any]:
    """Return all there is to say of an equation, for JSON."""
    import sympy as sp

    return {
        "id": found.id,
        "section": found.section,
        "title": found.title,
        "status": found.status.value,
        "latex": found.latex,
        "printed_latex": found.printed_latex or None,
        "srepr": sp.srepr(found.relation),
        "conditions": list(dict.fromkeys(c.stated for c in found.conditions)),
        "definitions": [{"text": h.text, "latex": h.latex} for h in found.definitions],
        "hypotheses": [
            {"kind": h.kind.value, "text": h.text, "latex": h.latex} for h in found.hypotheses
        ],
        "remark": found.remark or None,
    }


def _text(found: Equation) -> str:
    import sympy as sp

    from derive.hypotheses import sentences

    style = {"use_unicode": terminal.shows_formulas(), "wrap_line": False}
    lines = [f"({found.id})  {found.title}  [{found.status.value}]", ""]
    for claim in found.claims:
        lines += [sp.pretty(claim, **style), ""]
    lines += sentences(found.conditions)
    for definition in found.definitions:
        lines += ["", f"{definition.text}:", "", sp.pretty(definition.relation, **style)]
    if found.printed and not found.agrees:
        lines += ["", "as printed in the note (not equivalent):", ""]
        lines += [sp.pretty(claim, **style) for claim in found.printed]
    if found.remark:
        lines += ["", found.remark]
    return "\n".join(lines).rstrip()


def _mathml(found: Equation) -> str:
    from derive.typeset.mathml import display

    return display(found.latex)


_WRITERS: dict[str, Callable[[Equation], str]] = {
    "text": _text,
    "latex": lambda found: found.latex,
    "srepr": lambda found: str(document(found)["srepr"]),
    "mathml": _mathml,
    "json": lambda found: terminal.json_text(document(found)),
}


def execute(options: Options) -> Answer:
    """Return the equation."""
    (found,) = arguments.equations([options.id])
    return Answer(document(found), lambda: _WRITERS[options.form](found))
