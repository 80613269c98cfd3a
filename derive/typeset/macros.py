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

NAMES = {
    "1": "Closure",
    "2a": "PinEquilibrium",
    "2b": "BearingEquilibrium",
    "3": "EquivalentRoughness",
    "4": "ContactLaw",
    "5": "WearLaws",
    "6": "InitialConditions",
    "8": "CondensedProblem",
    "9": "ImplicitProblem",
    "10": "RigidProblem",
    "13": "BearingOnly",
    "18": "WearRate",
    "21": "WearPerCycle",
    "22": "AsymptoticPressure",
}
"""Names of the note's equations that are quoted most; others are named by their number."""


def macro_name(equation: Equation) -> str:
    """Return the name of an equation's macro, letters only.

    >>> import derive
    >>> [macro_name(derive.equation(id)) for id in ("21", "7c", "static-solution")]
    ['EqWearPerCycle', 'EqSevenC', 'EqStaticSolution']
    """
    if equation.id in NAMES:
        return "Eq" + NAMES[equation.id]
    parts = re.findall(r"[a-z]+|\d", equation.id)
    return "Eq" + "".join(_DIGITS[int(p)] if p.isdigit() else p.capitalize() for p in parts)


def macros(equations: Sequence[Equation]) -> str:
    r"""Return LaTeX that defines a macro for each equation, and \WearNomenclature.

    Formulas wider than `WIDTH` are broken. Needs amsmath, and booktabs for the nomenclature: what
    the symbols of these equations mean.
    """
    lines = [
        "% Equations of wear under cyclic contact, derived and checked by machine.",
        r"% Needs amsmath. Use: \begin{equation} \EqWearPerCycle \end{equation}",
        r"% \WearNomenclature is a table of their symbols and needs booktabs.",
    ]
    for equation in equations:
        lines += [
            f"% ({equation.id}) {equation.title}: {equation.status.value}",
            rf"\newcommand{{\{macro_name(equation)}}}{{{broken(equation.latex, WIDTH)}}}",
        ]
    lines.append(rf"\newcommand{{\WearNomenclature}}{{{nomenclature(equations)}}}")
    return "\n".join(lines) + "\n"
