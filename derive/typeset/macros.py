r"""LaTeX macros: one per equation, to \input into a report, and a table of their symbols.

Key results
    macro_name      \EqWearPerCycle for (21)
    macros          the text of a file that defines them, and the table of their symbols
    WIDTH           their greatest width
    occurring       the quantities that occur in expressions, in the order of the vocabulary
    nomenclature    a tabular with the quantities of the model in equations, their units
    unit            that of a quantity, in LaTeX
    rendered        the text of a template of LaTeX
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ..equations import Equation
from ..symbols import QUANTITIES, Quantity
from ..templates import LATEX, templates
from .breaking import broken
from .reading import in_latex

_DIGITS = ("Zero", "One", "Two", "Three", "Four", "Five", "Six", "Seven", "Eight", "Nine")

WIDTH = 29.0
"""In em: a line of ``article`` has 34.5, and the equation's number needs some."""
_NUMBER = 4.5
_POINTS = {"pt": 1.0, "mm": 72.27 / 25.4, "cm": 72.27 / 2.54, "in": 72.27}
_UNITS = {"1": "", "MPa mm^2": "N"}
"""Units with another name; a dimensionless quantity has none."""
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
    """Return the width in em of a formula beside its number, in a line of this length.

    ``size`` is that of the type in points; ValueError for a text that is no length.

    >>> round(room("246pt"), 1), round(room("86mm"), 1)
    (20.1, 20.0)
    """
    match = _LENGTH.fullmatch(length.strip())
    if match is None or (width := float(match[1]) * _POINTS[match[2]]) < 100.0:
        raise ValueError(f"{length}: give a width of 100pt or more, such as 246pt or 86mm")
    return width / size - _NUMBER


def rendered(template: str, **context: Any) -> str:
    """Return the text of a template of LaTeX."""
    known = templates(__package__, **LATEX)
    return known.get_template(f"{template}.jinja").render(broken=broken, **context)


def macros(equations: Sequence[Equation], width: float = WIDTH) -> str:
    r"""Return LaTeX that defines a macro for each equation, \EqNote and \WearNomenclature.

    \EqNote{14} is the equation of that id. Formulas wider than ``width`` em are broken. Needs
    amsmath, and booktabs for the nomenclature, the table of the quantities of the model in them. A
    second file may define some of the macros again.
    """
    return rendered(
        "macros",
        equations=equations,
        width=width,
        macro_name=macro_name,
        nomenclature=nomenclature(equations),
    )


def occurring(expressions: Iterable[sp.Basic]) -> tuple[Quantity, ...]:
    """Return the quantities that occur in expressions.

    >>> from derive.symbols import symbol
    >>> [quantity.name for quantity in occurring([symbol("p_max") / symbol("k")])]
    ['p_max', 'k']
    """
    atoms = (e.atoms(sp.Symbol, AppliedUndef) for e in expressions)
    used = {
        atom.func.__name__ if isinstance(atom, AppliedUndef) else atom.name
        for group in atoms
        for atom in group
    }
    return tuple(quantity for name, quantity in QUANTITIES.items() if name in used)


def nomenclature(equations: Iterable[Equation]) -> str:
    """Return a tabular of the quantities of the model; needs amsmath and booktabs."""
    names = occurring(part for each in equations for part in (*each.shown, *each.where))
    return rendered("nomenclature", quantities=names, in_latex=in_latex, unit=unit).rstrip()


def unit(quantity: Quantity) -> str:
    """Return the unit in LaTeX, empty for none."""
    spaced = _UNITS.get(quantity.unit, quantity.unit).replace(" ", r"\,")
    return rf"\mathrm{{{spaced}}}" if spaced else ""
