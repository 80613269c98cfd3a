"""The catalogue: every equation of the note and every result beyond it, by id.

Key results
    equations    all of them, the note's first, in its order
    equation     one, by its id
"""

from __future__ import annotations

import difflib
import re
from functools import cache
from importlib import import_module

from .equations import TEXTS, Equation, numbered
from .note import condensed, governing, stabilised

_BEYOND = {
    "note.problems": "problem-i problem-ii",
    "results.pressure_root": "pressure-root pressure-iteration rigid-limit-error",
    "results.any_law": "deviation growth general-rate closure-ratio general-law approach",
    "results.validity": "share criterion share-slope threshold one-eighth",
    "results.two_solids": "two-solids two-solids-opening two-solids-roughness "
    "two-solids-closure-ratio two-solids-rate two-solids-log-drift",
    "results.regimes": "tail logarithmic-wear saturating-wear closed-gap",
    "results.cutoff": "contact-condition arrest-depth no-contact rate-in-contact sliding-rate "
    "margin-rate margin one-third permanent-contact always-contact edge-of-contact",
    "results.cutoff_two_solids": "margin-curvature arrest-depth-two-solids",
    "results.comparison": "compliant-load strip",
    "results.first_integral": "closure-line first-integral first-integral-compliant",
    "results.static_solution": "static-solution static-solution-smooth static-wear-smooth "
    "static-solution-scaled",
    "results.static_compliant": "static-solution-compliant static-solution-compliant-smooth",
    "results.expansion": "log-drift expansion-drift expansion-oscillation expansion",
    "results.compliant": "compliant-pressure compliant-wear-per-cycle log-drift-any-law "
    "log-drift-compliant",
    "results.sensitivities": "elasticities sensitivity-slope elasticity-slope without-effect "
    "sensitivity-pressure slope-from-wear coefficient-from-wear slope-from-pressure",
    "results.monotonicity": "wear-increases wear-increases-apart wear-decreases",
    "results.dimensionless": "groups-one-solid groups-two-solids groups-compliant",
}
"""The results beyond the note by the module that derives them when it is imported.

A result is the value of that name, ``arrest_depth`` for arrest-depth.
"""

_MODULES = {identifier: module for module, ids in _BEYOND.items() for identifier in ids.split()}


class UnknownEquationError(KeyError):
    """There is no equation of that id; the message suggests similar ids."""

    def __str__(self) -> str:
        return str(self.args[0])


def all_equations() -> tuple[Equation, ...]:
    """Return the note's equations in their order, then the results beyond it."""
    return (*_of_the_note().values(), *map(_beyond, _MODULES))


@cache
def _of_the_note() -> dict[str, Equation]:
    model = condensed.two_solids()
    proved = governing.results(model) | condensed.results(model) | dict(stabilised.EQUATIONS)
    return {entry.id: entry for entry in sorted(numbered(proved), key=_place)}


@cache
def _beyond(identifier: str) -> Equation:
    module = import_module(f".{_MODULES[identifier]}", __package__)
    return numbered({identifier: getattr(module, identifier.replace("-", "_"))})[0]


def _place(entry: Equation) -> tuple[int, str]:
    number = re.match(r"\d+", entry.id)
    return (int(number.group()) if number else 10**6, entry.id)


def equations_up_to(identifier: str) -> tuple[Equation, ...]:
    """Return the equations of the catalogue up to one of them: all that it may rest on."""
    ids = [*_of_the_note(), *_MODULES]
    return tuple(map(equation, ids[: ids.index(identifier) + 1]))


def equation(identifier: str) -> Equation:
    """Return one equation; UnknownEquationError, with a suggestion, if there is none.

    >>> equation("7c").relation
    Eq(U_c(t), p(t)/k)
    """
    identifier = str(identifier)  # 21 is "21"
    if identifier in TEXTS:
        return _beyond(identifier) if identifier in _MODULES else _of_the_note()[identifier]
    near = difflib.get_close_matches(identifier, TEXTS, n=3, cutoff=0.5)
    hint = f"; did you mean {' or '.join(near)}?" if near else "; see `derive list`"
    raise UnknownEquationError(f"{identifier}: there is no such equation{hint}")
