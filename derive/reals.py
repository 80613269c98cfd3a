"""Relations between reals, decided by proof.

Overview
    ``holds`` asks z3 whether the facts and the negated goal contradict each other in the reals.
    Parts that are no polynomials are opaque: a square root is known by its square, an exponential,
    a hyperbolic tangent, the contact law and its slope by their range, a constant by a ball.  A
    quotient with a vanishing denominator is any number, so that no result rests on it.
Key results
    holds(goal, facts)       whether the relation follows; False proves nothing
    sign(expr, facts)        1, -1 or None
    contradictory(facts)     whether no numbers satisfy them; False proves nothing
References
    de Moura, Bjorner, Z3: an efficient SMT solver, TACAS 2008; Jovanovic, de Moura, Solving
    nonlinear arithmetic, IJCAR 2012.
"""

from __future__ import annotations

import operator
from collections.abc import Iterator

import flint
import sympy as sp
import z3
from sympy.core.function import AppliedUndef
from sympy.core.relational import Relational

from .claims import HasValue
from .laws import GENERAL
from .memory import cache
from .parts import certain, is_slope_of_law, needs, positive
from .repairs import ball

LAW = GENERAL.phi.func
"""The unspecified contact law: positive, continuously differentiable, of negative slope."""

_DIGITS = 4000
"""Greatest binary exponent of the ends of a ball: z3 reads numbers as text, of limited length."""

EFFORT = 3_000_000
"""Number of z3's steps after which a side condition counts as not proved; independent of time."""

_RELATIONS = {
    sp.Equality: lambda a, b: a == b,
    sp.Unequality: lambda a, b: a != b,
    sp.StrictGreaterThan: lambda a, b: a > b,
    sp.GreaterThan: lambda a, b: a >= b,
    sp.StrictLessThan: lambda a, b: a < b,
    sp.LessThan: lambda a, b: a <= b,
}


@cache
def holds(goal: sp.Basic, facts: frozenset[sp.Basic] = frozenset()) -> bool:
    """Return True if the goal follows from facts; False proves nothing.

    >>> x, y = sp.symbols("x y", real=True)
    >>> holds(x + y > 0, frozenset([x > 1, sp.Abs(y) <= 1])), holds(x + y > 0)
    (True, False)
    """
    if goal in (sp.true, sp.false):
        return bool(goal)
    if goal in facts:
        return True
    forms = [goal]
    if goal.has(sp.tanh) and goal.has(sp.exp):
        forms.insert(0, goal.replace(sp.tanh, lambda x: 1 - 2 / (1 + sp.exp(2 * x))))
    return any(_refuted(known, form) for form in forms for known in (_relevant(form, facts), facts))


@cache
def contradictory(facts: frozenset[sp.Basic]) -> bool:
    """Return True if no real numbers satisfy all facts; False proves nothing.

    >>> x = sp.Symbol("x", real=True)
    >>> contradictory(frozenset([sp.Eq(2 * x, 0), x > 1])), contradictory(frozenset([x > 1]))
    (True, False)
    """
    return _refuted(facts)


def _refuted(facts: frozenset[sp.Basic], goal: sp.Basic | None = None) -> bool:
    """Return whether the facts and the negation of the goal contradict each other."""
    translator, solver = _Translator(), z3.Solver()
    solver.set("rlimit", EFFORT)
    translated = z3.BoolVal(False) if goal is None else translator.relation(goal)
    if translated is None:
        return False
    implied = facts.union(*map(_supposed, facts))
    if sp.false in implied:
        return True
    given = (translator.relation(fact) for fact in sorted(implied, key=_text))
    known = [relation for relation in given if relation is not None]
    solver.add(*known, *translator.known, z3.Not(translated))
    return bool(solver.check() == z3.unsat)


_text = cache(str)


@cache
def _supposed(fact: sp.Basic) -> frozenset[sp.Basic]:
    """Return what holds wherever a fact is defined."""
    parts = () if fact.has(HasValue) else certain(fact)
    return frozenset(relation for part in parts for relation in needs(part))


def _relevant(goal: sp.Basic, facts: frozenset[sp.Basic]) -> frozenset[sp.Basic]:
    """Return the facts without unknowns other than the goal's, which suffice for most goals."""
    atoms = _unknowns(goal)
    return frozenset(fact for fact in facts if _unknowns(fact) <= atoms)


@cache
def _unknowns(expr: sp.Basic) -> frozenset[sp.Basic]:
    return frozenset(expr.atoms(sp.Symbol, AppliedUndef))


class _Translator:
    """Translates relations for z3; ``known`` collects the properties of opaque parts."""

    def __init__(self) -> None:
        self.names: dict[sp.Basic, z3.ArithRef] = {}
        self.known: list[z3.BoolRef] = []

    def relation(self, relation: sp.Basic) -> z3.BoolRef | None:
        """Return a relation for z3, None if it is not about real numbers."""
        if isinstance(relation, (sp.And, sp.Or, sp.Not, sp.Equivalent)):
            parts = [self.relation(part) for part in relation.args]
            if None in parts:
                return None
            if isinstance(relation, sp.Equivalent):
                return parts[0] == parts[1]
            return {sp.And: z3.And, sp.Or: z3.Or, sp.Not: z3.Not}[type(relation)](*parts)
        if not isinstance(relation, Relational) or relation.has(sp.oo, sp.zoo, sp.nan, sp.I):
            return None
        return _RELATIONS[type(relation)](*map(self.number, relation.args))

    def number(self, expr: sp.Expr) -> z3.ArithRef:
        """Return an expression for z3; a constant is known by a ball, too."""
        if isinstance(expr, sp.Rational):
            return z3.RealVal(str(expr))
        value = self._composed(expr)
        if expr.is_number and (known := ball(expr)) is not None:
            self.known += _in_ball(value, known)
        return value

    def _composed(self, expr: sp.Expr) -> z3.ArithRef:
        """Return an expression with opaque parts, except in polynomials, roots and pieces."""
        if isinstance(expr, sp.Add):
            return z3.Sum(*map(self.number, expr.args))
        if isinstance(expr, sp.Mul):
            return z3.Product(*map(self.number, expr.args))
        if isinstance(expr, sp.Pow) and expr.exp.is_Integer:
            base = self.number(expr.base)
            power = z3.Product(*[base] * abs(int(expr.exp)))
            return power if expr.exp > 0 else 1 / power
        if isinstance(expr, sp.Pow) and expr.exp.is_Rational and expr.exp.q == 2:
            return self.number(sp.Pow(_Root(expr.base), expr.exp.p))
        if isinstance(expr, sp.exp):
            expr = sp.exp(sp.expand(expr.args[0]))
        if isinstance(expr, sp.Abs):
            inside = self.number(expr.args[0])
            return z3.If(inside >= 0, inside, -inside)
        if isinstance(expr, sp.Piecewise) and expr.args[-1].cond == sp.true:
            *pieces, (last, _) = expr.args
            value = self.number(last)
            for piece, condition in reversed(pieces):
                on = self.relation(condition)
                value = z3.If(z3.FreshBool() if on is None else on, self.number(piece), value)
            return value
        if expr not in self.names:
            self.names[expr] = z3.Real(f"x{len(self.names)}")
            self._opaque(expr, self.names[expr])
        return self.names[expr]

    def _opaque(self, expr: sp.Expr, name: z3.ArithRef) -> None:
        """Add the known properties of an opaque part."""
        if isinstance(expr, _Root):
            inside = self.number(expr.args[0])
            self.known.append(z3.Implies(inside >= 0, z3.And(name >= 0, name * name == inside)))
        elif isinstance(expr, sp.tanh):
            inside = self.number(expr.args[0])
            self.known += [
                name > -1,
                name < 1,
                (name > 0) == (inside > 0),
                (name < 0) == (inside < 0),
            ]
        elif isinstance(expr, (sp.sin, sp.cos)):
            self.known += [name >= -1, name <= 1]
        elif isinstance(expr, (sp.exp, LAW)):
            self.known.append(name > 0)
        elif is_slope_of_law(expr):
            self.known.append(name < 0)
        if isinstance(expr, (sp.Symbol, AppliedUndef)):
            signs = {"is_positive": name > 0, "is_negative": name < 0, "is_nonnegative": name >= 0}
            self.known += [known for given, known in signs.items() if getattr(expr, given)]


class _Root(sp.Expr):
    """The square root of its argument, as an opaque part."""


def _in_ball(value: z3.ArithRef, known: flint.arb) -> Iterator[z3.BoolRef]:
    """Yield the ends of a ball that are no giants, and its sign, as what is known of a value."""
    for order, end in ((operator.ge, known.lower()), (operator.le, known.upper())):
        man, exp = map(int, end.man_exp())
        if abs(exp) < _DIGITS:
            bound = sp.Integer(man) * sp.Integer(2) ** exp
            yield order(value, z3.Q(int(bound.p), int(bound.q)))
    if not known.contains(0):
        yield value > 0 if known > 0 else value < 0


def sign(expr: sp.Expr, facts: frozenset[sp.Basic] = frozenset()) -> int | None:
    """Return 1 or -1 for an expression that is proved to be positive or negative, else None.

    >>> y = sp.Symbol("y", real=True)
    >>> sign(1 + sp.tanh(y)), sign(sp.tanh(y) - 1), sign(y), sign(1 - y / sp.sqrt(1 + y**2))
    (1, -1, None, 1)
    """
    for found, goal in ((1, positive(expr)), (-1, positive(-expr))):
        if holds(goal, facts):
            return found
    return None
