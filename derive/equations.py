"""Equations: the statements a reader knows by number, with their printed and typeset forms.

Key results
    Equation    id, section, title, statements, printed form, display form
    beyond      an equation beyond the note
    Status      definition, derived, derived-numerically, corrected, refuted
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum
from functools import cached_property

import sympy as sp
from sympy.core.function import AppliedUndef

from .hypotheses import Hypothesis, Kind
from .kernel import Judgement, chain, domain
from .rules.assumption import Assume
from .rules.proving import holds
from .symbols import CLOCKS, t
from .typeset.display import evaluated, latex
from .typeset.present import presentable
from .zero import same


class Status(StrEnum):
    """What the machine says of an equation as printed."""

    DEFINITION = "definition"
    DERIVED = "derived"
    NUMERIC = "derived-numerically"
    CORRECTED = "corrected"
    REFUTED = "refuted"


@dataclass(frozen=True, repr=False)
class Equation:
    """An equation of the note, or a result beyond it.

    A system is a tuple of statements.  ``printed`` is the note's form, transcribed apart from
    the derivation and only compared with it; ``display`` is the derived form laid out by an
    author (built with ``as_written``), where it differs from the printed one.  Where the
    printed form is false, ``refutation`` is the statement that contradicts it.  ``where`` are
    the abbreviations that the display form uses, each a relation with the new name on its left.
    """

    id: str
    section: str
    title: str
    statements: tuple[Judgement, ...]
    printed: tuple[sp.Basic, ...] = ()
    display: tuple[sp.Basic, ...] = ()
    refutation: Judgement | None = None
    remark: str = ""
    where: tuple[sp.Eq, ...] = ()

    def __repr__(self) -> str:
        return f"<Equation {self.id}: {self.title}>"

    def _repr_latex_(self) -> str:
        """Return what a notebook shows."""
        return f"$\\displaystyle {self.latex}$"

    @property
    def relation(self) -> sp.Basic:
        """Return the relation; a system is the conjunction of its relations."""
        return system(self.claims)

    @property
    def claims(self) -> tuple[sp.Basic, ...]:
        """Return the claims of the statements."""
        return tuple(statement.relation for statement in self.statements)

    @property
    def shown(self) -> tuple[sp.Basic, ...]:
        """Return what is typeset: the display form, the printed form if it holds, the claims."""
        if self.display:
            return self.display
        if self.printed and self.agrees:
            return self.printed
        return tuple(presentable(claim) for claim in self.claims)

    @property
    def latex(self) -> str:
        """Return the equation in LaTeX, laid out as an author would write it."""
        return latex(self.shown, self.where)

    @property
    def printed_latex(self) -> str:
        """Return the note's own form in LaTeX; empty for results that it does not have."""
        return latex(self.printed) if self.printed else ""

    @property
    def steps(self) -> tuple[Judgement, ...]:
        """Return the chain of statements from the governing equations to this one."""
        extra = () if self.refutation is None else (self.refutation,)
        return chain(*self.statements, *extra)

    @cached_property
    def conditions(self) -> tuple[Hypothesis, ...]:
        """Return what a reader needs to know beside the equation of when it holds.

        A name may be positive by the vocabulary: what it is defined as then has to be.
        """
        shown = tuple(h for h in self.hypotheses if h.shown)
        names = (h.relation for h in self.hypotheses if h.kind is Kind.DEFINITION)
        signs = dict.fromkeys(s for n in names if n not in self.claims and (s := _sign(n)))
        return (*shown, *(sign for sign in signs if not self._follows(sign)))

    def _follows(self, sign: Hypothesis) -> bool:
        """Return whether the sign of a name follows from what is derived of it, and else holds."""
        name, given = sign.relation.args[0], set(self.hypotheses)
        derived = (s.relation for s in self.steps if given.issuperset(s.hypotheses))
        values = (r for r in derived if isinstance(r, sp.Equality) and r.lhs == name)
        said = (r for r in (*values, *(h.relation for h in given)) if not r.has(t))
        known = frozenset(r.xreplace({name: _ANY}) for r in said)
        return holds(sign.relation.func(_ANY, 0), known)

    @property
    def hypotheses(self) -> tuple[Hypothesis, ...]:
        """Return all that the equation rests on, each once."""
        return tuple(dict.fromkeys(h for s in self.statements for h in s.hypotheses))

    @cached_property
    def agrees(self) -> bool:
        """Return whether the printed form, if there is one, is what was derived."""
        return not self.printed or _agree(self.printed, self.claims)

    @cached_property
    def typeset_agrees(self) -> bool:
        """Return whether what is typeset is what was derived."""
        return _agree(self.shown_in_full, self.claims)

    @property
    def shown_in_full(self) -> tuple[sp.Basic, ...]:
        """Return what is typeset, without abbreviations."""
        return tuple(self._in_full(part) for part in self.shown)

    def _in_full(self, written: sp.Basic) -> sp.Basic:
        """Return a relation of the display form without its abbreviations."""
        for short in reversed(self.where):
            written = _replaced(written, evaluated(short))
        return written

    @property
    def status(self) -> Status:
        """Return what the machine says of the equation as printed."""
        if self.refutation is not None:
            return Status.REFUTED
        if not self.agrees:
            return Status.CORRECTED
        if all(isinstance(s.rule, Assume) for s in self.statements):
            return Status.DEFINITION
        return Status.DERIVED


_ANY = sp.Symbol("value", real=True)


def _sign(definition: sp.Basic) -> Hypothesis | None:
    """Return the sign that the vocabulary gives to a name which does not vary."""
    name = definition.args[0] if definition.args else t
    sign = domain(name) if name.is_Symbol and name.name not in CLOCKS else None
    return sign and replace(sign, kind=Kind.PARAMETER)


def beyond(
    section: str,
    identifier: str,
    title: str,
    statements: Judgement | tuple[Judgement, ...],
    display: sp.Basic | tuple[sp.Basic, ...] = (),
    where: tuple[sp.Eq, ...] = (),
    remark: str = "",
) -> Equation:
    """Return a result beyond the note, which has no printed form of it; one or several each."""
    stated = (statements,) if isinstance(statements, Judgement) else statements
    shown = display if isinstance(display, tuple) else (display,)
    return Equation(identifier, section, title, stated, (), shown, remark=remark, where=where)


def _agree(written: tuple[sp.Basic, ...], claims: tuple[sp.Basic, ...]) -> bool:
    return len(written) == len(claims) and all(
        same(evaluated(left), right) for left, right in zip(written, claims, strict=True)
    )


def _replaced(expr: sp.Basic, short: sp.Eq) -> sp.Basic:
    """Return an expression with one abbreviation written out, a function at its arguments too."""
    name = short.lhs
    if not isinstance(name, AppliedUndef):
        return evaluated(expr).subs(name, short.rhs)
    written = evaluated(expr).replace(name.func, sp.Lambda(name.args, short.rhs))
    return written.replace(sp.Subs, lambda *args: sp.Subs(*args).doit())  # slopes of the function


def system(claims: tuple[sp.Basic, ...]) -> sp.Basic:
    """Return one relation, or the conjunction of several as they stand."""
    return claims[0] if len(claims) == 1 else sp.And(*claims, evaluate=False)
