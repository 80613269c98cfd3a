"""The catalogue: every equation of the note and every result beyond it, by id.

Key results
    equations    all of them, the note's first, in its order
    equation     one, by its id
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterator
from functools import cache
from importlib import import_module

from .equations import TEXTS, Equation, numbered
from .note import condensed, governing, stabilised
from .note.governing import Model

_BEYOND = (
    "note.problems",
    "results.pressure_root",
    "results.steady_state",
    "results.validity",
    "results.two_solids",
    "results.regimes",
    "results.cutoff",
    "results.cutoff_two_solids",
    "results.comparison",
    "results.first_integral",
    "results.static_solution",
    "results.static_scaled",
    "results.static_compliant",
    "results.expansion",
    "results.compliant",
    "results.sensitivities",
    "results.monotonicity",
    "results.dimensionless",
)
"""The modules with results beyond the note, imported when they are asked for."""


class UnknownEquationError(KeyError):
    """There is no equation of that id; the message says which are near."""

    def __str__(self) -> str:
        return str(self.args[0])


def equations() -> tuple[Equation, ...]:
    """Return the note's equations in their order, then the results beyond it."""
    return tuple(_in_order())


def _in_order() -> Iterator[Equation]:
    """Derive module after module, each once, and only as far as is asked for."""
    yield from _of_the_note()
    for module in _BEYOND:
        yield from _beyond(module)


@cache
def _of_the_note() -> tuple[Equation, ...]:
    model = Model()
    proved = governing.results(model) | condensed.results(model) | stabilised.results()
    return tuple(sorted(numbered(proved), key=_place))


@cache
def _beyond(module: str) -> tuple[Equation, ...]:
    return numbered(import_module(f".{module}", __package__).results())


def _place(found: Equation) -> tuple[int, str]:
    number = re.match(r"\d+", found.id)
    return (int(number.group()) if number else 10**6, found.id)


def equations_up_to(identifier: str) -> tuple[Equation, ...]:
    """Return the equations of the catalogue up to one of them: all that it may rest on."""
    found: list[Equation] = []
    for one in _in_order():
        found.append(one)
        if one.id == identifier:
            break
    return tuple(found)


def equation(identifier: str) -> Equation:
    """Return one equation; UnknownEquationError, with a suggestion, if there is none.

    >>> equation("7c").relation
    Eq(U_c(t), p(t)/k)
    """
    if identifier in TEXTS:
        return next(found for found in _in_order() if found.id == identifier)
    near = difflib.get_close_matches(identifier, TEXTS, n=3, cutoff=0.5)
    hint = f"; did you mean {' or '.join(near)}?" if near else "; see `derive list`"
    raise UnknownEquationError(f"{identifier}: there is no such equation{hint}")
