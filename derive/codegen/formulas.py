"""Formulas: closed forms and conditions as functions of named numbers, in NumPy and JavaScript.

Key results
    Formula          a named expression or relation, its arguments and its meaning
    formula_module   the NumPy source of a module of them
    formula_script   the JavaScript of them, for use inside another script
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import partial

import sympy as sp

from ..program.function import Assignment
from ..symbols import QUANTITIES
from .emit import JAVASCRIPT, NUMPY, emit
from .sources import rendered


@dataclass(frozen=True)
class Formula:
    """A function to generate: ``arguments`` come first, all data follow by keyword.

    ``parts`` are intermediates, in order, that later ones and the value may use.  The function of
    one or several relations returns whether they hold.
    """

    name: str
    arguments: tuple[sp.Symbol, ...]
    value: sp.Basic
    meaning: str
    parts: tuple[Assignment, ...] = ()

    @property
    def expressions(self) -> tuple[sp.Basic, ...]:
        """Return the parts' expressions and the value."""
        return (*(value for _, value in self.parts), self.value)

    @property
    def data(self) -> tuple[str, ...]:
        """Return the names of the data, in the order of the vocabulary."""
        used = {symbol.name for each in self.expressions for symbol in each.free_symbols}
        names = used - {a.name for a in self.arguments} - {name.name for name, _ in self.parts}
        known = [name for name in QUANTITIES if name in names]
        return (*known, *sorted(names.difference(known)))


def formula_module(title: str, origin: Sequence[str], formulas: Sequence[Formula]) -> str:
    """Return the source of a module; ``origin`` has the ids of the underlying results."""
    text = " ".join(emit(each, NUMPY) for formula in formulas for each in formula.expressions)
    return rendered(
        "formulas.numpy",
        title=title,
        origin=origin,
        formulas=formulas,
        emit=partial(emit, target=NUMPY),
        numpy="np." in text,
    )


def formula_script(formulas: Iterable[Formula]) -> str:
    """Return the functions of formulas as the body of a function that returns them."""
    return rendered("formulas.javascript", formulas=formulas, emit=partial(emit, target=JAVASCRIPT))
