r"""Nomenclature: what the symbols of some equations mean, as a LaTeX table.

Key results
    quantities      the quantities that occur in equations, in the order of the vocabulary
    nomenclature    a tabular with their symbols, meanings and units
"""

from __future__ import annotations

import re
from collections.abc import Iterable

import sympy as sp
from sympy.core.function import AppliedUndef

from ..equations import Equation
from ..symbols import QUANTITIES, Quantity

_DIFFERENTIALS = re.compile(r"\bd (\w+)/d (\w+)")
_NAME = re.compile(r"(?<![\\\w$])(1/)?([A-Za-z]+(?:_\w+)?)(?:\^(\d)|(/T))?(?![\w$])")


def quantities(equations: Iterable[Equation]) -> tuple[Quantity, ...]:
    """Return the quantities that occur in equations.

    >>> import derive
    >>> [quantity.name for quantity in quantities([derive.equation("7c")])]
    ['t', 'U_c', 'p', 'k']
    """
    atoms = (
        e.atoms(sp.Symbol, AppliedUndef)
        for found in equations
        for e in (*found.shown, *found.where)
    )
    used = {
        atom.func.__name__ if isinstance(atom, AppliedUndef) else atom.name
        for some in atoms
        for atom in some
    }
    return tuple(quantity for name, quantity in QUANTITIES.items() if name in used)


def nomenclature(equations: Iterable[Equation]) -> str:
    """Return a tabular of the symbols of equations; needs amsmath and booktabs."""
    rows = [
        rf"${quantity.latex}$ & {meaning(quantity)} & {_unit(quantity.unit)} \\"
        for quantity in quantities(equations)
    ]
    head = [r"\begin{tabular}{lll}", r"\toprule", r"symbol & meaning & unit \\", r"\midrule"]
    return "\n".join([*head, *rows, r"\bottomrule", r"\end{tabular}"])


def meaning(quantity: Quantity) -> str:
    r"""Return the meaning in LaTeX, names of other quantities as formulas.

    >>> print(meaning(QUANTITIES["f_c"]))
    roughness slope of the bearing, $\mathrm{d}\sigma_c/\mathrm{d}u_c$
    >>> print(meaning(QUANTITIES["c_2"]))
    drift at order $1/m^2$
    """
    text = _DIFFERENTIALS.sub(
        lambda m: rf"$\mathrm{{d}}{_latex(m[1])}/\mathrm{{d}}{_latex(m[2])}$", quantity.meaning
    )
    parts = re.split(r"(\$.*?\$)", text)
    return "".join(part if part.startswith("$") else _NAME.sub(_formula, part) for part in parts)


def _formula(found: re.Match[str]) -> str:
    """A name that can only be that of a quantity, or that stands in a quotient or power."""
    inverse, name, power, period = found.groups()
    certain = name in QUANTITIES and (len(name) > 1 or inverse or power or period)
    if not certain:
        return found[0]
    exponent = f"^{power}" if power else ""
    return f"${inverse or ''}{_latex(name)}{exponent}{period or ''}$"


def _latex(name: str) -> str:
    return QUANTITIES[name].latex if name in QUANTITIES else name


def _unit(unit: str) -> str:
    spaced = unit.replace(" ", r"\,")
    return "--" if unit == "1" else rf"$\mathrm{{{spaced}}}$"
