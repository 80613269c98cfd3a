r"""Nomenclature: what the symbols of some equations mean, as a LaTeX table.

Key results
    occurring       the quantities that occur in expressions, in the order of the vocabulary
    quantities      those of equations as they are typeset
    nomenclature    a tabular with their symbols, meanings and units
    meaning, unit   of one quantity, in LaTeX
"""

from __future__ import annotations

from collections.abc import Iterable

import sympy as sp
from sympy.core.function import AppliedUndef

from ..equations import Equation
from ..symbols import QUANTITIES, Quantity
from .reading import typed

#: Units that have a name.
_UNITS = {"1": "", "MPa mm^2": "N"}


def quantities(equations: Iterable[Equation]) -> tuple[Quantity, ...]:
    """Return the quantities that occur in equations.

    >>> import derive
    >>> [quantity.name for quantity in quantities([derive.equation("7c")])]
    ['t', 'U_c', 'p', 'k']
    """
    return occurring(e for found in equations for e in (*found.shown, *found.where))


def occurring(expressions: Iterable[sp.Basic]) -> tuple[Quantity, ...]:
    """Return the quantities that occur in expressions.

    >>> from derive.symbols import symbol
    >>> [quantity.name for quantity in occurring([symbol("p_max") / symbol("k")])]
    ['p_max', 'k']
    """
    atoms = (e.atoms(sp.Symbol, AppliedUndef) for e in expressions)
    used = {
        atom.func.__name__ if isinstance(atom, AppliedUndef) else atom.name
        for some in atoms
        for atom in some
    }
    return tuple(quantity for name, quantity in QUANTITIES.items() if name in used)


def nomenclature(equations: Iterable[Equation]) -> str:
    """Return a tabular of the symbols of equations; needs amsmath and booktabs."""
    rows = [
        rf"${quantity.latex}$ & {meaning(quantity)} & {_cell(unit(quantity))} \\"
        for quantity in quantities(equations)
    ]
    head = [
        r"\begin{tabular}{lp{0.62\linewidth}l}",
        r"\toprule",
        r"symbol & meaning & unit \\",
        r"\midrule",
    ]
    return "\n".join([*head, *rows, r"\bottomrule", r"\end{tabular}"])


def _cell(formula: str) -> str:
    return f"${formula}$" if formula else "--"


def meaning(quantity: Quantity) -> str:
    r"""Return the meaning in LaTeX, names of other quantities as formulas.

    >>> print(meaning(QUANTITIES["f_c"]))
    roughness growth of the bearing, $\mathrm{d}\sigma_c/\mathrm{d}u_c$
    >>> print(meaning(QUANTITIES["c_2"]))
    drift at order $1/m^2$
    """
    return typed(quantity.meaning)


def unit(quantity: Quantity) -> str:
    """Return the unit in LaTeX, empty for none."""
    spaced = _UNITS.get(quantity.unit, quantity.unit).replace(" ", r"\,")
    return rf"\mathrm{{{spaced}}}" if spaced else ""
