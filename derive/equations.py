"""Equations: the numbered statements, with their printed and typeset forms.

Overview
    ``note`` and ``results`` have the proofs; ``equations.toml`` has the texts by id: section,
    title and remark, the form that the note prints, the form that an author lays out with its
    abbreviations.  A check compares both forms with the derived claims.
Key results
    Equation    statements, their texts and status
    numbered    the equations of results by id
    written     the formulas of one, as an author writes them
    Status      definition, derived or corrected
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from functools import cached_property, partial
from pathlib import Path
from types import MappingProxyType

import sympy as sp
from sympy.core.function import AppliedUndef

from .claims import Term, claim_of, mapped
from .hypotheses import Hypothesis, Kind
from .kernel import Judgement, StepKey, chain, domain, step_key
from .language import defined_by, names
from .laws import written_out
from .parts import bound_in
from .rules.assumption import is_hypothesis
from .symbols import DATA, QUANTITIES
from .typeset.display import latex
from .typeset.present import presentable
from .written import Names, evaluated, read
from .zero import same

_SECTIONS = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
_ABBREVIATIONS = _SECTIONS.pop("abbreviations")
TEXTS: Mapping[str, Mapping[str, str]] = {
    identifier: {"section": section, "remark": "", **texts}
    for section, entries in _SECTIONS.items()
    for identifier, texts in entries.items()
}
"""Section, title, remark and formulas by id."""

_NONE: Mapping[str, str] = MappingProxyType({})

EXPANSION = (
    r"s = m + w_1 / m + w_2 / m^{2} + \dots",
    r"\mathrm{d}m / \mathrm{d}\tau = \rho \left(1 + c_1 / m + \dots\right)",
    r"\mathrm{d}s / \mathrm{d}\tau = \rho F(s) / F(\infty)",
)
"""The long-time expansion that defines its coefficients, for a law F, in LaTeX."""

_LAW = sp.Symbol("F(s)")

Proved = Judgement | tuple[Judgement, ...]
"""The proof of an equation: a judgement, or those of a system."""


def written(form: str, texts: Mapping[str, str], known: Names = _NONE) -> tuple[sp.Basic, ...]:
    """Return the formulas of a form (``printed``, ``shown``, ``where``), unevaluated.

    ``known`` are names beyond the vocabulary.

    >>> written("printed", TEXTS["7c"])
    (Eq(U_c(t), p(t)/k),)
    """
    lines = texts.get(form, "").strip().splitlines()
    return tuple(
        read(f"{line} = {_ABBREVIATIONS[line]}" if line in _ABBREVIATIONS else line, known)
        for line in lines
    )


def stated(identifier: str, known: Names = _NONE) -> tuple[sp.Basic, ...]:
    """Return the shown relations of an equation, evaluated and without abbreviations.

    They serve as the claim of a rule, which an author thus writes once.
    """
    shown, where = (written(form, TEXTS[identifier], known) for form in ("shown", "where"))
    return tuple(_in_full(evaluated(relation), where) for relation in shown)


class Status(StrEnum):
    """Whether an equation is a definition, derived as printed, or corrected."""

    DEFINITION = "definition"
    DERIVED = "derived"
    CORRECTED = "corrected"


@dataclass(frozen=True, eq=False, repr=False)
class Equation:
    """An equation of the note, or a result beyond it.

    A system has several statements.  ``texts`` are its formulas: ``printed`` is the note's form,
    transcribed apart from the derivation and only compared with it; ``shown`` the derived form laid
    out by an author, where it differs from the printed one; ``where`` its abbreviations, each a
    relation with the new name on its left.
    """

    id: str
    section: str
    title: str
    statements: tuple[Judgement, ...]
    remark: str = ""
    texts: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if not self.statements or any(type(s) is not Judgement for s in self.statements):
            raise TypeError("an equation states judgements")

    def __repr__(self) -> str:
        return f"<Equation {self.id}: {self.title}>"

    def _repr_latex_(self) -> str:
        """Return the formula that a notebook shows."""
        return f"$\\displaystyle {self.latex}$"

    @property
    def relation(self) -> sp.Basic:
        """Return the relation; a system is the conjunction of its relations."""
        return system(self.claims)

    @property
    def claims(self) -> tuple[sp.Basic, ...]:
        """Return the claims of the statements."""
        return tuple(statement.relation for statement in self.statements)

    @cached_property
    def printed(self) -> tuple[sp.Basic, ...]:
        """Return the form of the note; empty for results beyond it."""
        return self._written("printed")

    @cached_property
    def where(self) -> tuple[sp.Basic, ...]:
        """Return the abbreviations in the typeset form."""
        return self._written("where")

    @cached_property
    def shown(self) -> tuple[sp.Basic, ...]:
        """Return the typeset form: an author's, else the printed if it holds, else the claims."""
        if laid_out := self._written("shown"):
            return laid_out
        if self.printed and self.agrees:
            return self.printed
        return tuple(presentable(claim) for claim in self.claims)

    def _written(self, form: str) -> tuple[sp.Basic, ...]:
        bearers = {name: by for claim in self.claims for name, by in names(claim)}
        known = {name: by for name, by in bearers.items() if name not in QUANTITIES}
        return written(form, self.texts, known)

    @property
    def latex(self) -> str:
        """Return the equation in LaTeX, laid out as an author would write it."""
        return latex(self.shown, self.where)

    @property
    def printed_latex(self) -> str:
        """Return the note's own form in LaTeX; empty for results beyond it."""
        return latex(self.printed) if self.printed else ""

    @property
    def definitions_latex(self) -> tuple[str, ...]:
        """Return the definitions of its names in LaTeX, a formula each; for coefficients of the
        long-time expansion that expansion."""
        formulas: list[str] = []
        for relation in (h.relation for h in self.definitions):
            if _is_coefficient(relation):
                law = latex(presentable(sp.Eq(_LAW, relation.rhs.args[1], evaluate=False)))
                formulas += [*EXPANSION, law]
            else:
                formulas.append(latex(presentable(relation)))
        return tuple(dict.fromkeys(formulas))

    @property
    def steps(self) -> tuple[Judgement, ...]:
        """Return the chain of statements from the governing equations to this one, each once."""
        return tuple(self.keyed_steps.values())

    @property
    def keyed_steps(self) -> dict[StepKey, Judgement]:
        """Return the same chain by the keys of its steps."""
        return {step_key(step): step for step in chain(*self.statements)}

    @cached_property
    def conditions(self) -> tuple[Hypothesis, ...]:
        """Return the conditions that a reader needs beside the equation, in its own names.

        A setting that the equation itself states is there by name alone; what is only assumed is
        no condition of itself.
        """
        own = self.claims if self._assumed else ()
        beside = [h for h in self.hypotheses if h.is_setting or h.relation not in own]
        shown = [h for h in beside if h.shown]
        short = (h.relation if h.is_setting else self._in_own_names(h.relation) for h in shown)
        return (*map(Hypothesis, short), *self.signs)

    def _in_own_names(self, condition: sp.Basic) -> sp.Basic:
        """Return a condition in names of the equation; of those that it defines only their sign."""
        equal = (h.relation for h in self._naming if isinstance(h.relation, sp.Equality))
        names = [relation for relation in equal if relation.lhs in self.relation.free_symbols]
        short = abbreviated(condition, names)
        if short in (domain(relation.lhs) for relation in names):
            return short
        return abbreviated(condition, [n for n in names if n not in self.claims])

    @property
    def _assumed(self) -> bool:
        return all(map(is_hypothesis, self.statements))

    @property
    def signs(self) -> tuple[Hypothesis, ...]:
        """Return the signs of names that neither the vocabulary nor a definition has."""
        named = {h.relation.args[0] for h in self._naming}
        signs = dict.fromkeys(sign for statement in self.statements for sign in statement.signs)
        return tuple(sign for sign in signs if sign.relation.args[0] not in named)

    @cached_property
    def definitions(self) -> tuple[Hypothesis, ...]:
        """Return the definitions of names in the equation and its conditions, and of names in
        these definitions, except those that the equation itself states."""
        relations = [self.relation, *(h.relation for h in self.hypotheses if h.shown)]
        rest, result = self._naming, list[Hypothesis]()
        while new := [h for h in rest if defined_by(h.relation) & _names(relations)]:
            rest = [h for h in rest if h not in new]
            result += new
            relations = [h.relation for h in new]
        return tuple(h for h in result if h.relation not in self.claims)

    @property
    def _naming(self) -> list[Hypothesis]:
        """Return the hypotheses that define a name."""
        return [h for h in self.hypotheses if h.kind is Kind.DEFINITION]

    @property
    def hypotheses(self) -> tuple[Hypothesis, ...]:
        """Return the hypotheses of all statements, each once."""
        return tuple(dict.fromkeys(h for s in self.statements for h in s.hypotheses))

    @cached_property
    def agrees(self) -> bool:
        """Return whether the printed form, if there is one, equals the claims."""
        return not self.printed or _agree(self.printed, self.claims)

    @cached_property
    def typeset_agrees(self) -> bool:
        """Return whether the typeset form equals the claims and abbreviates by new names alone."""
        said = _names(self.claims) | DATA
        short = (abbreviation.lhs for abbreviation in self.where)
        new = all(
            isinstance(name, (sp.Symbol, AppliedUndef))
            and str(name.func if name.args else name) not in said
            for name in short
        )
        return new and _agree(self.shown_in_full, self.claims)

    @property
    def shown_in_full(self) -> tuple[sp.Basic, ...]:
        """Return the typeset form without abbreviations."""
        return tuple(_in_full(part, self.where) for part in self.shown)

    @property
    def status(self) -> Status:
        """Return the machine's verdict on the equation as printed."""
        if not self.agrees:
            return Status.CORRECTED
        if self._assumed:
            return Status.DEFINITION
        return Status.DERIVED


def numbered(results: Mapping[str, Proved]) -> tuple[Equation, ...]:
    """Return the equations that state these results, given by id."""
    return tuple(
        Equation(
            identifier,
            texts["section"],
            texts["title"],
            proved if isinstance(proved, tuple) else (proved,),
            texts["remark"],
            texts,
        )
        for identifier, proved in results.items()
        for texts in (TEXTS[identifier],)
    )


def _is_coefficient(relation: sp.Basic) -> bool:
    """Return whether a relation defines c_n or w_n, by this name, as a term of the expansion."""
    if not isinstance(relation, sp.Equality) or not isinstance(relation.rhs, Term):
        return False
    return relation.rhs.name in _names([relation.lhs])


def _names(relations: Iterable[sp.Basic]) -> set[str]:
    return {name for relation in relations for name, _ in names(relation)}


def _agree(written: tuple[sp.Basic, ...], claims: tuple[sp.Basic, ...]) -> bool:
    return len(written) == len(claims) and all(
        same(evaluated(left), right) for left, right in zip(written, claims, strict=True)
    )


def _in_full(relation: sp.Basic, where: tuple[sp.Basic, ...]) -> sp.Basic:
    """Return a relation with abbreviations written out."""
    relation = evaluated(relation) if where else relation
    for short in reversed(where):
        relation = mapped(relation, partial(_replaced, short=evaluated(short)))
    return relation


def _replaced(expr: sp.Expr, short: sp.Eq) -> sp.Expr:
    """Return an expression with one abbreviation written out, a function at its arguments too."""
    name = short.lhs
    if not isinstance(name, AppliedUndef):
        return expr.subs(name, short.rhs)
    return written_out(expr, sp.Lambda(name.args, short.rhs), name.func)


def abbreviated(relation: sp.Basic, names: Iterable[sp.Equality]) -> sp.Basic:
    """Return a relation with names in place of the expressions that they abbreviate."""
    bound = bound_in(relation)
    free = (name for name in names if name.rhs.args and bound.isdisjoint(name.rhs.free_symbols))
    short = {evaluated(name.rhs): name.lhs for name in free}
    if not any(relation.has(value) for value in short):
        return relation
    return claim_of(relation).map(lambda side: side.xreplace(short)).relation


def system(claims: tuple[sp.Basic, ...]) -> sp.Basic:
    """Return one relation, or the unevaluated conjunction of several."""
    return claims[0] if len(claims) == 1 else sp.And(*claims, evaluate=False)
