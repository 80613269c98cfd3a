"""The equations beside the explorer's plots: each with the choices for which it holds.

Key results
    rows    the equations as HTML; the page hides those that do not hold for what is chosen
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from html import escape
from typing import NamedTuple

from wear.report import mathml

Choices = dict[str, tuple[str | bool, ...]]
"""Values of the controls, and of the regime, for which an equation holds; the others are free."""

_SMOOTH: Choices = {"pin": ("bearing",)}
_ROUGH: Choices = {"pin": ("rough", "worn_rough")}
_TWO_SOLIDS: Choices = {"pin": ("rough", "worn", "worn_rough")}
_RIGID: Choices = {"compliant": (False,)}
_COMPLIANT: Choices = {"compliant": (True,)}
_AS_PRINTED: Choices = {"opening": (False,)}
_OPENING: Choices = {"opening": (True,)}
_TANH: Choices = {"law": ("tanh",)}
_CUTOFF: Choices = {"cutoff": (True,)}
_NO_CUTOFF: Choices = {"cutoff": (False,)}
_STEADY: Choices = {"regime": ("steady",)}
_PARTIAL: Choices = {"regime": ("partial",)}
_ARREST: Choices = {"regime": ("arrest",)}


class _Row(NamedTuple):
    """An equation of the catalogue, under a title of this page."""

    title: str
    identifier: str
    holds: Choices


_MODEL = (
    _Row("Closure", "1", _AS_PRINTED),
    _Row("Equivalent roughness", "3", _ROUGH),
    _Row("Contact law", "7e", _TANH | _NO_CUTOFF),
    _Row("Contact law", "4", _TANH | _CUTOFF),
    _Row("Deflection of the support", "7c", _COMPLIANT),
    _Row("Wear and change of roughness", "7f", {}),
    _Row("All in one", "13", _TANH | _SMOOTH | _RIGID | _NO_CUTOFF),
    _Row("All in one", "10", _TANH | _TWO_SOLIDS | _RIGID | _AS_PRINTED | _NO_CUTOFF),
    _Row("All in one", "8", _TANH | _COMPLIANT | _AS_PRINTED | _NO_CUTOFF),
)
_LONG_RUN = (
    _Row("Wear per cycle in the end", "21", _TANH | _STEADY | _SMOOTH),
    _Row("Pressure in the end", "22", _TANH | _STEADY | _SMOOTH),
    _Row("Logarithm in the wear", "log-drift", _TANH | _STEADY | _SMOOTH | _RIGID),
    _Row("Coefficient of ln N", "log-drift-compliant", _TANH | _STEADY | _SMOOTH | _COMPLIANT),
    _Row("Growth of gap and roughness", "two-solids", _STEADY | _TWO_SOLIDS | _AS_PRINTED),
    _Row("Growth of gap and roughness", "two-solids-opening", _STEADY | _TWO_SOLIDS | _OPENING),
    _Row("Closure over roughness in the end", "two-solids-closure-ratio", _STEADY | _TWO_SOLIDS),
    _Row("Wear rate in the end", "two-solids-rate", _TANH | _STEADY | _TWO_SOLIDS),
    _Row("Logarithm in the wear", "two-solids-log-drift", _TANH | _STEADY | _TWO_SOLIDS | _RIGID),
    _Row("Wear per cycle in the end", "one-third", _TANH | _PARTIAL),
    _Row("Wear at arrest", "arrest-depth", _ARREST | _SMOOTH),
    _Row("Wear at arrest", "arrest-depth-two-solids", _ARREST | _TWO_SOLIDS),
)


def rows() -> str:
    """Return all equations, in the order of the argument."""
    from derive.laws import LAWS, TANH

    others = tuple(name for name in LAWS if name != TANH.name)
    other: Choices = {"law": others}
    limit = _Row("Pressure in the end", "general-law", other | _STEADY | _SMOOTH)
    found = (*_forms(others), *_listed((*_MODEL, limit, *_LONG_RUN)))
    return "\n".join(_html(*row) for row in found)


_Formula = tuple[str, str, str, Choices]  # title, LaTeX, number, where it holds


def _listed(listed: tuple[_Row, ...]) -> Iterator[_Formula]:
    from derive.catalogue import equation

    for title, identifier, holds in listed:
        number = f"({identifier})" if identifier[0].isdigit() else ""
        yield title, equation(identifier).latex, number, holds


def _forms(laws: tuple[str, ...]) -> Iterator[_Formula]:
    """The closure with the physical sign, and the contact laws other than the note's."""
    from derive.laws import LAWS
    from derive.note.governing import Model
    from derive.typeset.display import latex

    yield "Closure", latex(Model(opening=True).closure.claim), "", _OPENING
    for name in laws:
        model = Model(LAWS[name])
        for cutoff, statement in (False, model.pressure), (True, model.pressure_with_cutoff):
            holds: Choices = {"law": (name,), "cutoff": (cutoff,)}
            yield "Contact law", latex(statement.claim), "", holds


def _html(title: str, latex: str, number: str, holds: Choices) -> str:
    chosen = escape(json.dumps(holds))
    return (
        f'<div data-holds="{chosen}"><p>{title}</p><div class="row">'
        f'<div class="formula">{mathml.block(latex)}</div><span>{number}</span></div></div>'
    )
