"""Modules of formulas: closed forms as NumPy functions of named numbers.

Key results
    Formula          a named expression, its arguments and its meaning
    Guard            a condition that can be asked with numbers
    formula_module   the source of a module of them
"""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from dataclasses import dataclass

import sympy as sp

from ..conditions import Condition
from ..symbols import QUANTITIES
from .emit import emit
from .numpy_module import numpy_target

Parts = tuple[tuple[sp.Symbol, sp.Expr], ...]


def _data(
    values: Sequence[sp.Basic], parts: Parts, arguments: tuple[sp.Symbol, ...] = ()
) -> tuple[str, ...]:
    """Return the names of the data of some values, in the order of the vocabulary."""
    used = {s.name for e in (*values, *(value for _, value in parts)) for s in e.free_symbols}
    names = used - {a.name for a in arguments} - {name.name for name, _ in parts}
    known = [name for name in QUANTITIES if name in names]
    return (*known, *sorted(names.difference(known)))


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

    @property
    def data(self) -> tuple[str, ...]:
        """Return the names of the data, in the order of the vocabulary."""
        return _data((self.value,), self.parts, self.arguments)

    @property
    def source(self) -> str:
        """Return the function as text."""
        data = [f"{name}: Real" for name in self.data]
        parts = [f"{a.name}: Real" for a in self.arguments] + (["*", *data] if data else [])
        head = f"def {self.name}({', '.join(parts)}) -> Real:"
        if len(head) > 100:
            listed = "".join(f"    {part},\n" for part in parts)
            head = f"def {self.name}(\n{listed}) -> Real:"
        meaning = self.meaning[0].upper() + self.meaning[1:]
        target = numpy_target()
        lines = [f"    {name.name} = {emit(value, target)}" for name, value in self.parts]
        lines.append(f"    return {emit(self.value, target)}")
        return "\n".join([head, f'    """{meaning}."""', *lines])


@dataclass(frozen=True)
class Guard:
    """A condition to generate: a function of its data that says whether it holds."""

    name: str
    condition: Condition
    parts: Parts = ()

    @property
    def relations(self) -> tuple[sp.Basic, ...]:
        """Return the relations that must all hold."""
        relation = self.condition.relation
        return tuple(relation.args) if isinstance(relation, sp.And) else (relation,)

    @property
    def data(self) -> tuple[str, ...]:
        """Return the names of the data, in the order of the vocabulary."""
        return _data(self.relations, self.parts)

    @property
    def source(self) -> str:
        """Return the function as text."""
        data = self.data
        head = f"def {self.name}(*, {', '.join(f'{name}: Real' for name in data)}) -> Any:"
        if len(head) > 100:
            listed = "".join(f"    {name}: Real,\n" for name in data)
            head = f"def {self.name}(\n    *,\n{listed}) -> Any:"
        target = numpy_target()
        lines = [f"    {name.name} = {emit(part, target)}" for name, part in self.parts]
        text = " and ".join(
            f"{emit(piece.lhs, target)} {piece.rel_op} {emit(piece.rhs, target)}"
            for piece in self.relations
        )
        words = self.condition.text[0].upper() + self.condition.text[1:]
        return "\n".join([head, f'    """{words}."""', *lines, f"    return {text}"])


def formula_module(title: str, origin: Sequence[str], formulas: Sequence[Formula | Guard]) -> str:
    """Return the source of a module; ``origin`` names the results that it comes from."""
    results = ", ".join(origin)
    written = textwrap.fill(
        f"Written by ``derive generate`` from {results}; not to be edited.",
        96,
        break_on_hyphens=False,
    )
    body = "\n\n\n".join(formula.source for formula in formulas)
    imports = "\nimport numpy as np\n" if "np." in body else ""
    ids = "".join(f'    "{identifier}",\n' for identifier in origin)
    listed = f'"{origin[0]}",' if len(origin) == 1 else f"\n{ids}"
    return f'''"""{title}

{written}
All functions broadcast over arrays; lengths are in mm.
"""

from typing import Any
{imports}
Real = Any  # a number or an array of numbers

EQUATIONS = ({listed})


{body}
'''
