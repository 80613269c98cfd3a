"""The types of claims.

Overview
    A claim is an equality, an inequality, two of them, an inequation, an equivalence, a limit or
    an asymptotic relation, or else a property.  ``relation`` is the SymPy form, for printing and
    for comparison.
Key results
    claim_of(relation)                  the typed claim of a SymPy relation
    part of a claim by its name         ``lhs``, ``lesser``, ``value``; a claim has no others
    mapped(relation, change)            a relation with its sides changed
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import sympy as sp
from sympy.core.relational import Relational
from sympy.logic.boolalg import Boolean
from sympy.printing.pretty.pretty import PrettyPrinter
from sympy.printing.pretty.stringpict import prettyForm

from . import repairs  # noqa: F401 - of SymPy, before it decides anything
from .symbols import t

landau_o = sp.Function("o", real=True)
"""Landau's o: ``o(order, variable, point)`` is negligible against the order towards the point."""


class ClaimError(ValueError):
    """A relation is none of the types of claims."""


class FirstZero(sp.Expr):
    """The least positive zero of an expression in a variable; ``FirstZero(expr, variable)``.

    The expression has a value between 0 and there: if it lacks one before, there is no first zero.
    """

    is_commutative = True
    is_positive = True
    is_real = True

    @property
    def free_symbols(self) -> set[sp.Basic]:
        """Return the symbols without the variable, which is bound."""
        names: set[sp.Basic] = self.args[0].free_symbols
        return names - {self.args[1]}

    def _latex(self, printer: sp.printing.printer.Printer) -> str:
        expr, variable = map(printer.doprint, self.args)
        return rf"\min\left\{{{variable} > 0 : {expr} = 0\right\}}"


class Predicate(Boolean):
    """A statement that is no relation between numbers."""

    def _latex(self, printer: sp.printing.printer.Printer) -> str:
        return rf"\text{{{self}}}"


class Continuous(Predicate):
    """A field is continuous in time; ``Continuous(field)``."""

    def _sympystr(self, printer: sp.printing.printer.Printer) -> str:
        return f"{printer.doprint(self.args[0])} is continuous"

    def _latex(self, printer: sp.printing.printer.Printer) -> str:
        return rf"{printer.doprint(self.args[0])}\;\text{{is continuous}}"


class HasValue(Predicate):
    """An expression has a value, which no relation expresses; ``HasValue(expr)``."""

    def _sympystr(self, printer: sp.printing.printer.Printer) -> str:
        return f"{printer.doprint(self.args[0])} has a value"


class SlowEquation(Predicate):
    """m is s without its oscillation, in the sense of ``Term``, and s_0 is the constant of its
    integration, which leaves powers of m and ln(m/rho) alone; ``SlowEquation(m, s_0)``."""

    def _sympystr(self, printer: sp.printing.printer.Printer) -> str:
        m, s_0 = map(printer.doprint, self.args)
        whole = f"int d{m}/(1 + c_1/{m} + ...)"
        return f"rho tau + {s_0} = {whole} = {m} - c_1 log({m}/rho) + ..."

    def _latex(self, printer: sp.printing.printer.Printer) -> str:
        m, s_0 = map(printer.doprint, self.args)
        whole = rf"\int \mathrm{{d}}{m} / \left(1 + c_1 / {m} + \dots\right)"
        return rf"\rho \tau + {s_0} = {whole} = {m} - c_1 \ln\left({m} / \rho\right) + \dots"


class Term(sp.Expr):
    """A coefficient of the averaged expansion of ``ds/dtau = rho F(s, tau)/F(oo)``.

    ``Drift(n, F, s, tau, rho)`` is c_n and ``Oscillation(n, F, s, tau, rho)`` is w_n of the formal
    solution ``s = m + w_1/m + w_2/m^2 + ...``, ``dm/dtau = rho (1 + c_1/m + c_2/m^2 + ...)``,
    where each w_n has the period 1 of F in tau and the mean zero.
    """

    is_commutative = True
    is_real = True
    letter = ""
    words = (
        "s = m + w_1/m + w_2/m^2 + ... with dm/dtau = rho (1 + c_1/m + ...) and each w_n of "
        "period 1 and mean 0 in tau, which solves ds/dtau = rho F/F(oo) for F(s) in brackets"
    )

    @property
    def name(self) -> str:
        """Return its name, ``c_1`` for the first drift."""
        return f"{self.letter}_{self.args[0]}"

    @property
    def power(self) -> int:
        """Return n for a coefficient of the dimension of roughness^n."""
        return int(self.args[0])

    @property
    def free_symbols(self) -> set[sp.Basic]:
        """Return the symbols without s, which is bound."""
        return set().union(*(part.free_symbols for part in self.args)) - {self.args[2]}

    def _latex(self, printer: sp.printing.printer.Printer) -> str:
        n, law = map(printer.doprint, (self.args[0], self._law))
        return rf"{self.letter}_{{{n}}}\left[{law}\right]"

    def _pretty(self, printer: PrettyPrinter) -> prettyForm:
        name = printer._print(sp.Symbol(f"{self.letter}_{self.args[0]}"))
        return prettyForm(*name.right(prettyForm(*printer._print(self._law).parens("[", "]"))))

    @property
    def _law(self) -> sp.Expr:
        """Return F as a function of s, whatever its variable is called, unless it has an s."""
        _, law, variable, *_ = self.args
        taken = {name.name for name in law.free_symbols - {variable}}
        return law if "s" in taken else law.xreplace({variable: sp.Symbol("s", positive=True)})


class Drift(Term):
    """c_n of the expansion: the growth of the mean at order 1/m^n, independent of tau."""

    letter = "c"


class Oscillation(Term):
    """w_n of the expansion: the oscillation at order 1/m^n, at the phase tau."""

    letter = "w"

    @property
    def power(self) -> int:
        return int(self.args[0]) + 1


class Claim(ABC):
    """The claim of a judgement."""

    @property
    @abstractmethod
    def relation(self) -> sp.Basic:
        """Return the claim as a SymPy relation."""

    def __getattr__(self, part: str) -> Any:
        """Refuse a part that claims of this type lack."""
        raise AttributeError(f"{type(self).__name__.lower()} has no {part}")

    def map(self, change: Callable[[sp.Expr], sp.Expr]) -> Claim:
        """Return the claim with ``change`` applied to its expressions."""
        return claim_of(mapped(self.relation, change))


def mapped(relation: sp.Basic, change: Callable[[sp.Expr], sp.Expr]) -> sp.Basic:
    """Return a relation with ``change`` applied to its sides, and without an attempt to decide it.

    >>> x = sp.Symbol("x")
    >>> mapped(sp.Eq(x, 1), lambda side: side.subs(x, 1))
    Eq(1, 1)
    """
    if isinstance(relation, Predicate) or not relation.args:
        return relation.func(*map(change, relation.args))
    if isinstance(relation, Relational):
        return relation.func(*map(change, relation.args), evaluate=False)
    return relation.func(*(mapped(part, change) for part in relation.args), evaluate=False)


@dataclass(frozen=True)
class Equality(Claim):
    """``lhs = rhs``, at every time."""

    lhs: sp.Expr
    rhs: sp.Expr

    @property
    def relation(self) -> sp.Basic:
        return sp.Eq(self.lhs, self.rhs, evaluate=False)


@dataclass(frozen=True)
class Inequality(Claim):
    """``a <= b``, or strictly ``a < b``, in its original orientation."""

    written: Relational

    @property
    def relation(self) -> sp.Basic:
        return self.written

    @property
    def lesser(self) -> sp.Expr:
        """Return the smaller side."""
        return self.written.lts

    @property
    def greater(self) -> sp.Expr:
        """Return the larger side."""
        return self.written.gts

    @property
    def strict(self) -> bool:
        """Return whether the inequality is strict."""
        return isinstance(self.written, (sp.StrictGreaterThan, sp.StrictLessThan))


@dataclass(frozen=True)
class Inequation(Claim):
    """``lhs != rhs``."""

    lhs: sp.Expr
    rhs: sp.Expr

    @property
    def relation(self) -> sp.Basic:
        return sp.Ne(self.lhs, self.rhs, evaluate=False)


@dataclass(frozen=True)
class Equivalence(Claim):
    """Two equivalent inequalities."""

    left: Inequality
    right: Inequality

    @property
    def relation(self) -> sp.Basic:
        return sp.Equivalent(self.left.written, self.right.written, evaluate=False)


@dataclass(frozen=True)
class Limit(Claim):
    """``expr`` tends to ``value`` as time tends to infinity."""

    expr: sp.Expr
    value: sp.Expr

    @property
    def term(self) -> sp.Limit:
        """Return the limit as an expression."""
        return sp.Limit(self.expr, t, sp.oo)

    @property
    def relation(self) -> sp.Basic:
        return sp.Eq(self.term, self.value, evaluate=False)


@dataclass(frozen=True)
class Asymptotic(Claim):
    """``lhs = rhs + o(order)`` as ``variable`` tends to ``point``."""

    lhs: sp.Expr
    rhs: sp.Expr
    variable: sp.Symbol
    point: sp.Expr
    order: sp.Expr = sp.S.One

    @property
    def relation(self) -> sp.Basic:
        rest = landau_o(self.order, self.variable, self.point)
        return sp.Eq(self.lhs, self.rhs + rest, evaluate=False)

    def map(self, change: Callable[[sp.Expr], sp.Expr]) -> Claim:
        return replace(self, lhs=change(self.lhs), rhs=change(self.rhs))


@dataclass(frozen=True)
class Conjunction(Claim):
    """Two inequalities that both hold, such as ``low <= middle <= high``."""

    first: Inequality
    second: Inequality

    @property
    def relation(self) -> sp.Basic:
        return sp.And(self.first.written, self.second.written, evaluate=False)


@dataclass(frozen=True)
class Property(Claim):
    """A predicate, such as the continuity of the load."""

    predicate: Predicate

    @property
    def relation(self) -> sp.Basic:
        return self.predicate


def claim_of(relation: sp.Basic) -> Claim:
    """Return the typed claim of a SymPy relation.

    >>> x, y = sp.symbols("x y")
    >>> claim_of(sp.Ge(x, y)).lesser
    y
    >>> claim_of(x)
    Traceback (most recent call last):
    ...
    derive.claims.ClaimError: x is no claim
    """
    if isinstance(relation, sp.Equality):
        left, right = relation.args
        if isinstance(left, sp.Limit) and not right.has(sp.Limit):
            if left.args[1:3] != (t, sp.oo):
                raise ClaimError(f"{relation} is no limit for t -> oo")
            return Limit(left.args[0], right)
        return Equality(left, right)
    if isinstance(relation, sp.Unequality):
        return Inequation(*relation.args)
    if isinstance(relation, Relational):
        return Inequality(relation)
    if isinstance(relation, Predicate):
        return Property(relation)
    if isinstance(relation, (sp.And, sp.Equivalent)) and len(relation.args) == 2:
        first, second = map(claim_of, relation.args)
        if isinstance(first, Inequality) and isinstance(second, Inequality):
            both = Equivalence if isinstance(relation, sp.Equivalent) else Conjunction
            return both(first, second)
    raise ClaimError(f"{relation} is no claim")
