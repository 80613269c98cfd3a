"""Formulas: closed forms and conditions as functions of named numbers, in NumPy and JavaScript.

Key results
    Formula          a named expression or relation, its arguments and its meaning
    formula_module   the NumPy source of a module of them
    formula_script   the JavaScript of them, for use inside another script
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import sympy as sp

from ..program.function import Assignment
from ..symbols import QUANTITIES
from .emit import JAVASCRIPT, NUMPY, Target, emit
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
    def kind(self) -> str:
        """Return the type of the function's result."""
        return "Real" if isinstance(self.value, sp.Expr) else "Any"

    @property
    def data(self) -> tuple[str, ...]:
        """Return the names of the data, in the order of the vocabulary."""
        used = {s.name for e in (self.value, *(v for _, v in self.parts)) for s in e.free_symbols}
        names = used - {a.name for a in self.arguments} - {name.name for name, _ in self.parts}
        known = [name for name in QUANTITIES if name in names]
        return (*known, *sorted(names.difference(known)))

    def text(self, target: Target) -> str:
        """Return the value in a language."""
        if isinstance(self.value, sp.Expr):
            return emit(self.value, target)
        script = target is JAVASCRIPT
        strict = {"==": "===", "!=": "!=="} if script else {}
        relations = self.value.args if isinstance(self.value, sp.And) else (self.value,)
        return (" && " if script else " and ").join(
            f"{emit(part.lhs, target)} {strict.get(part.rel_op, part.rel_op)} "
            f"{emit(part.rhs, target)}"
            for part in relations
        )


def formula_module(title: str, origin: Sequence[str], formulas: Sequence[Formula]) -> str:
    """Return the source of a module; ``origin`` has the ids of the underlying results."""
    return rendered(
        "formulas.numpy",
        title=title,
        origin=origin,
        formulas=formulas,
        target=NUMPY,
        emit=emit,
        numpy=any("np." in _all_text(formula) for formula in formulas),
    )


def _all_text(formula: Formula) -> str:
    parts = (emit(value, NUMPY) for _, value in formula.parts)
    return " ".join([*parts, formula.text(NUMPY)])


def formula_script(formulas: Iterable[Formula]) -> str:
    """Return the functions of formulas as the body of a function that returns them."""
    return rendered("formulas.javascript", formulas=formulas, target=JAVASCRIPT, emit=emit)
