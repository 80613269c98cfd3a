"""Conditions: what a statement needs, as data.

A condition gives LaTeX for the reader, restricts the samples of the tests and, where a relation
says it, is a guard that can be asked with numbers.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

import sympy as sp
from sympy.core.function import AppliedUndef

_MODULUS = re.compile(r"Abs\((\w+)\)")
#: Characters up to which a relation is easier to read than words.
_SHORT = 30


@dataclass(frozen=True)
class Condition:
    """One hypothesis: in words, and as a SymPy relation where there is one.

    ``typeset`` is its LaTeX where there is only words and they hold a formula.
    """

    text: str
    relation: sp.Basic = sp.true
    typeset: str = ""

    @property
    def names(self) -> frozenset[str]:
        """Return the quantities that the condition is about."""
        return frozenset(str(getattr(s, "func", s)) if s.args else str(s) for s in self._unknowns)

    @property
    def _unknowns(self) -> set[sp.Basic]:
        fields = self.relation.atoms(AppliedUndef)
        plain = self.relation.xreplace({field: sp.Dummy() for field in fields}).free_symbols
        return fields | {symbol for symbol in plain if not isinstance(symbol, sp.Dummy)}

    def guard(self, values: Mapping[str, float]) -> bool | None:
        """Return whether the condition holds for numbers, by name of the quantity.

        None where only words say it, or where a number is missing.

        >>> from derive.results.steady_state import ROUGHENING
        >>> ROUGHENING.guard({"f_c": 0.25}), ROUGHENING.guard({"f_c": -0.05}), ROUGHENING.guard({})
        (True, False, None)
        """
        if self.relation is sp.true or not self.names <= set(values):
            return None
        numbers = {u: sp.Float(values[str(u.func) if u.args else str(u)]) for u in self._unknowns}
        return bool(self.relation.xreplace(numbers))

    def met_by(self, values: Mapping[sp.Expr, sp.Expr]) -> bool:
        """Return whether these values of quantities make the relation true.

        >>> from derive.results.steady_state import ROUGHENING
        >>> from derive.symbols import symbol
        >>> ROUGHENING.met_by({symbol("f_c"): sp.Integer(1)}), ROUGHENING.met_by({})
        (True, False)
        """
        return self.relation is not sp.true and self.relation.subs(values) == sp.true

    @property
    def typed(self) -> str:
        """Return the relation as one types it; the words where there is none, or a long one.

        >>> from derive.results.steady_state import BOUNDED_LOAD, ROUGHENING
        >>> ROUGHENING.typed, BOUNDED_LOAD.typed
        ('f_c > 0', '|U_a| <= U')
        """
        parts = self.relation.args if isinstance(self.relation, sp.And) else (self.relation,)
        said = ", ".join(_MODULUS.sub(r"|\1|", str(part).replace("(t)", "")) for part in parts)
        return self.text if self.relation is sp.true or len(said) > _SHORT else said

    @property
    def latex(self) -> str:
        """Return the condition in LaTeX; in words where no relation says it."""
        from .typeset.display import inline

        if self.relation is not sp.true:
            return inline(self.relation)
        return self.typeset or rf"\text{{{self.text}}}"
