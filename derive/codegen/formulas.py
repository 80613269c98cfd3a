"""Formulas: closed forms as functions of named numbers, in NumPy and JavaScript.

Key results
    Formula          a named expression, its arguments and its meaning
    Guard            a condition that can be asked with numbers
    formula_module   the NumPy source of a module of them
    formula_script   the JavaScript of them, to stand inside another script
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import sympy as sp

from ..hypotheses import Hypothesis
from ..symbols import QUANTITIES
from .emit import JAVASCRIPT, NUMPY, Target, emit
from .sources import rendered

Parts = tuple[tuple[sp.Symbol, sp.Expr], ...]


@dataclass(frozen=True)
class Formula:
    """A function to generate: ``arguments`` come first, all data follow by keyword.

    ``parts`` are intermediates, in order, that later ones and the value may use.
    """

    name: str
    arguments: tuple[sp.Symbol, ...]
    value: sp.Expr
    meaning: str
    parts: Parts = ()
    kind = "Real"

    @property
    def values(self) -> tuple[sp.Basic, ...]:
        """Return the expression that is returned."""
        return (self.value,)

    @property
    def data(self) -> tuple[str, ...]:
        """Return the names of the data, in the order of the vocabulary."""
        return _data(self)

    def text(self, target: Target) -> str:
        """Return the value in a language."""
        return emit(self.value, target)


@dataclass(frozen=True)
class Guard:
    """A condition to generate: a function of its data that says whether it holds."""

    name: str
    condition: Hypothesis
    parts: Parts = ()
    arguments = ()
    kind = "Any"

    @property
    def values(self) -> tuple[sp.Basic, ...]:
        """Return the relations that must all hold."""
        relation = self.condition.relation
        return tuple(relation.args) if isinstance(relation, sp.And) else (relation,)

    @property
    def data(self) -> tuple[str, ...]:
        """Return the names of the data, in the order of the vocabulary."""
        return _data(self)

    @property
    def meaning(self) -> str:
        """Return the condition in words."""
        return self.condition.text

    def text(self, target: Target) -> str:
        """Return the condition in a language."""
        strict = {"==": "===", "!=": "!=="} if target is JAVASCRIPT else {}
        return (" && " if target is JAVASCRIPT else " and ").join(
            f"{emit(each.lhs, target)} {strict.get(each.rel_op, each.rel_op)} "
            f"{emit(each.rhs, target)}"
            for each in self.values
        )


def _data(of: Formula | Guard) -> tuple[str, ...]:
    used = {s.name for e in (*of.values, *(v for _, v in of.parts)) for s in e.free_symbols}
    names = used - {a.name for a in of.arguments} - {name.name for name, _ in of.parts}
    known = [name for name in QUANTITIES if name in names]
    return (*known, *sorted(names.difference(known)))


def formula_module(title: str, origin: Sequence[str], formulas: Sequence[Formula | Guard]) -> str:
    """Return the source of a module; ``origin`` names the results that it comes from."""
    return rendered(
        "formulas.numpy",
        title=title,
        origin=origin,
        formulas=formulas,
        target=NUMPY,
        emit=emit,
        numpy=any("np." in _all_text(formula) for formula in formulas),
    )


def _all_text(formula: Formula | Guard) -> str:
    parts = (emit(value, NUMPY) for _, value in formula.parts)
    return " ".join([*parts, formula.text(NUMPY)])


def formula_script(formulas: Iterable[Formula | Guard]) -> str:
    """Return the functions of formulas as the body of a function that returns them."""
    return rendered("formulas.javascript", formulas=formulas, target=JAVASCRIPT, emit=emit)
