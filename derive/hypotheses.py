"""Hypotheses: what a judgement rests on, as data of a closed list of kinds.

A hypothesis gives a sentence and LaTeX for the reader, a SymPy relation where there is one, and
is a guard that can be asked with numbers.  A relation between fields holds at every time.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from enum import StrEnum

import sympy as sp
from sympy.core.function import AppliedUndef

_MODULUS = re.compile(r"Abs\((\w+)\)")
#: Characters up to which a relation is easier to read than words.
_SHORT = 30


class Kind(StrEnum):
    """The closed list of kinds of hypotheses."""

    MODEL = "model"  # an equation of the note's model, (1) to (5)
    INITIAL = "initial"  # an initial value, (6)
    SETTING = "setting"  # rigid support, smooth or unworn pin, no loss of contact
    LOAD = "load"  # bounded, constant, periodic, sine, continuous
    PARAMETER = "parameter"  # a relation between data
    STATE = "state"  # a relation that the fields satisfy: contact is active, p < p_max
    DEFINITION = "definition"  # a name for an expression
    DOMAIN = "domain"  # of a symbol, from its definition in the vocabulary


def sentences(hypotheses: Iterable[Hypothesis]) -> list[str]:
    """Return hypotheses as a reader is told them: settings in one line, each other by itself."""
    shown = [h for h in hypotheses if h.shown]
    settings = dict.fromkeys(h.text for h in shown if h.kind is Kind.SETTING)
    others = dict.fromkeys(f"if {h.text}" for h in shown if h.kind is not Kind.SETTING)
    return [*([f"setting: {', '.join(settings)}"] if settings else []), *others]


@dataclass(frozen=True)
class Hypothesis:
    """One hypothesis: in words, and as a SymPy relation where there is one (else ``true``).

    ``typeset`` is its LaTeX where there is only words and they hold a formula.
    """

    text: str
    relation: sp.Basic = sp.true
    typeset: str = ""
    kind: Kind = Kind.PARAMETER

    @property
    def names(self) -> frozenset[str]:
        """Return the quantities that the hypothesis is about."""
        return frozenset(str(getattr(s, "func", s)) if s.args else str(s) for s in self._unknowns)

    @property
    def _unknowns(self) -> set[sp.Basic]:
        fields = self.relation.atoms(AppliedUndef)
        plain = self.relation.xreplace({field: sp.Dummy() for field in fields}).free_symbols
        return fields | {symbol for symbol in plain if not isinstance(symbol, sp.Dummy)}

    def guard(self, values: Mapping[str, float]) -> bool | None:
        """Return whether the hypothesis holds for numbers, by name of the quantity.

        None where only words say it, or where a number is missing.

        >>> from derive.results.regime_map import ROUGHENING
        >>> ROUGHENING.guard({"f_c": 0.25}), ROUGHENING.guard({"f_c": -0.05}), ROUGHENING.guard({})
        (True, False, None)
        """
        if self.relation is sp.true or not self.names <= set(values):
            return None
        numbers = {u: sp.Float(values[str(u.func) if u.args else str(u)]) for u in self._unknowns}
        return bool(self.relation.xreplace(numbers))

    @property
    def shown(self) -> bool:
        """Return whether a reader needs it beside an equation: the model and names are known."""
        return self.kind in (Kind.SETTING, Kind.LOAD, Kind.PARAMETER, Kind.STATE)

    @property
    def typed(self) -> str:
        """Return the relation as one types it; the words where there is none, or a long one.

        >>> from derive.results.regime_map import ROUGHENING
        >>> from derive.results.steady_state import BOUNDED_LOAD
        >>> ROUGHENING.typed, BOUNDED_LOAD.typed
        ('f_c > 0', '|U_a| <= U')
        """
        parts = self.relation.args if isinstance(self.relation, sp.And) else (self.relation,)
        written = (f"{p.lhs} != {p.rhs}" if isinstance(p, sp.Unequality) else str(p) for p in parts)
        said = ", ".join(_MODULUS.sub(r"|\1|", part.replace("(t)", "")) for part in written)
        words = self.relation is sp.true or isinstance(self.relation, sp.Equality)
        return self.text if words or len(said) > _SHORT else said

    @property
    def latex(self) -> str:
        """Return the hypothesis in LaTeX; in words where no relation says it."""
        from .typeset.display import inline

        if self.typeset:
            return self.typeset
        return rf"\text{{{self.text}}}" if self.relation is sp.true else inline(self.relation)
