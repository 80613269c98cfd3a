r"""LaTeX macros: one per equation, to \input into a report.

Key results
    macro_name    \EqWearPerCycle for (21)
    macros        the text of a file that defines them, and the table of their symbols
    WIDTH         how wide they are at most
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from ..equations import Equation
from .breaking import broken
from .nomenclature import nomenclature

_DIGITS = ("Zero", "One", "Two", "Three", "Four", "Five", "Six", "Seven", "Eight", "Nine")

WIDTH = 29.0
"""In em: a line of ``article`` has 34.5, of which a number takes some."""
_NUMBER = 4.5
_POINTS = {"pt": 1.0, "mm": 72.27 / 25.4, "cm": 72.27 / 2.54, "in": 72.27}
_LENGTH = re.compile(r"(\d+(?:\.\d+)?)\s*(pt|mm|cm|in)")


def macro_name(equation: Equation) -> str:
    """Return the name of an equation's macro, letters only.

    >>> import derive
    >>> [macro_name(derive.equation(id)) for id in ("21", "7c", "static-solution")]
    ['EqWearPerCycle', 'EqSevenC', 'EqStaticSolution']
    """
    if name := equation.texts.get("macro"):
        return f"Eq{name}"
    parts = re.findall(r"[a-z]+|\d", equation.id)
    return "Eq" + "".join(_DIGITS[int(p)] if p.isdigit() else p.capitalize() for p in parts)


def room(length: str, size: float = 10.0) -> float:
    """Return the em that a formula has beside its number in a line of this length.

    ``size`` is that of the type in points; ValueError for what is no length.

    >>> round(room("246pt"), 1), round(room("86mm"), 1)
    (20.1, 20.0)
    """
    found = _LENGTH.fullmatch(length.strip())
    if found is None or (width := float(found[1]) * _POINTS[found[2]]) < 100.0:
        raise ValueError(f"{length}: give a width of 100pt or more, such as 246pt or 86mm")
    return width / size - _NUMBER


def macros(equations: Sequence[Equation], width: float = WIDTH) -> str:
    r"""Return LaTeX that defines a macro for each equation, \EqNote and \WearNomenclature.

    \EqNote{14} is the equation of that id. Formulas wider than ``width`` em are broken. Needs
    amsmath, and booktabs for the nomenclature: what the symbols of these equations mean. A second
    file may define some of them again.
    """
    lines = [
        "% Equations of wear under cyclic contact, derived and checked by machine.",
        r"% Needs amsmath. Use: \begin{equation} \EqWearPerCycle \end{equation}, or \EqNote{21}.",
        r"% \WearNomenclature is a table of their symbols and needs booktabs.",
        r"\providecommand{\EqNote}[1]{\csname EqNote@#1\endcsname}",
    ]
    for equation in equations:
        name = macro_name(equation)
        lines += [
            f"% ({equation.id}) {equation.title}: {equation.status.value}",
            rf"\def\{name}{{{broken(equation.latex, width)}}}",
            rf"\expandafter\def\csname EqNote@{equation.id}\endcsname{{\{name}}}",
        ]
    lines.append(rf"\def\WearNomenclature{{{nomenclature(equations)}}}")
    return "\n".join(lines) + "\n"
