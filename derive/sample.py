"""Samples: points at which all that a statement rests on holds, at 50 digits.

Overview
    A rule proves a claim symbolically; sampling asks again without SymPy's rewriting.  A
    *world* gives a number to every symbol, function of time and derivative, such that all
    sources of the statement hold; the claim must then hold too.  A source is a statement that
    no pointwise algebra yields: a hypothesis of the model, an integral, a limit.  Each source
    has a pivot, the unknown that is computed from it; what is no pivot is drawn at random from
    its domain.
Key results
    sources(statement)        what a world has to satisfy
    world(sources, seed)      one point
    holds(claim, world)       does a claim hold there?
"""

from __future__ import annotations

import random
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

import mpmath
import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.core.relational import Relational

from .conditions import Condition
from .laws import GENERAL, r
from .symbols import QUANTITIES

DIGITS = 50
_WORKING_DIGITS = 160  # cancellation inside an expression must not eat the 50
World = dict[sp.Expr, sp.Expr]


class UnsatisfiableError(ValueError):
    """No sample was found that meets the conditions."""


@dataclass(frozen=True)
class Source:
    """A relation that worlds satisfy by computing ``pivot`` from it."""

    pivot: sp.Expr
    value: sp.Expr

    @staticmethod
    def of(claim: Relational, pivot: sp.Expr) -> Source:
        """Solve a claim for its pivot."""
        if claim.lhs == pivot and not claim.rhs.has(pivot):
            return Source(pivot, claim.rhs)
        dummy = sp.Dummy()
        residual = (claim.lhs - claim.rhs).xreplace({pivot: dummy})
        slope = sp.diff(residual, dummy)
        if slope.has(dummy):
            raise ValueError(f"{claim} is not linear in its pivot {pivot}")
        return Source(pivot, -residual.xreplace({dummy: sp.S.Zero}) / slope)


def atoms(expr: sp.Basic) -> set[sp.Expr]:
    """Return the independent unknowns of an expression: derivatives, functions, symbols."""
    if isinstance(expr, (sp.Derivative, sp.Symbol)):
        return {expr}
    if isinstance(expr, AppliedUndef) and expr.func.__name__ in QUANTITIES:
        return {expr}
    return set().union(*(atoms(argument) for argument in expr.args))


def world(
    sources: Iterable[Source],
    wanted: sp.Basic,
    seed: int,
    signs: Mapping[sp.Expr, int] = MappingProxyType({}),
) -> World:
    """Draw one world that satisfies ``sources`` and gives a value to every atom of ``wanted``.

    ``signs`` says of some atoms that they must be positive (1) or negative (-1).
    """
    generator = random.Random(seed)
    by_pivot = {source.pivot: source for source in sources}
    values: World = {}

    def value(atom: sp.Expr, pending: tuple[sp.Expr, ...] = ()) -> sp.Expr:
        if atom in pending:
            raise ValueError(f"sources define {atom} through itself")
        if atom not in values:
            source = by_pivot.get(atom)
            if source is None:
                values[atom] = _of_sign(atom, signs.get(atom, 0), generator)
            else:
                needed = {a: value(a, (*pending, atom)) for a in _ordered(atoms(source.value))}
                values[atom] = evaluate(source.value, needed)
        return values[atom]

    for atom in _ordered(atoms(wanted)):
        value(atom)
    return values


def _ordered(found: set[sp.Expr]) -> list[sp.Expr]:
    return sorted(found, key=str)


def _of_sign(atom: sp.Expr, sign: int, generator: random.Random) -> sp.Expr:
    """Draw a value of one atom; of a sign, if its domain holds such values at all."""
    for _ in range(100 if sign else 1):
        value = draw(atom, generator)
        if value * sign >= 0:
            break
    return value


def _signs(relations: Iterable[sp.Basic]) -> dict[sp.Expr, int]:
    """Read off the conditions which symbols must be positive or negative."""
    bare = [relation for relation in relations if getattr(relation, "rhs", None) == 0]
    kinds = ((sp.StrictGreaterThan, 1), (sp.StrictLessThan, -1))
    return {r.lhs: sign for r in bare for kind, sign in kinds if isinstance(r, kind)}


def draw(atom: sp.Expr, generator: random.Random) -> sp.Expr:
    """Draw a value of one atom from the domain in the vocabulary."""
    name = atom.func.__name__ if isinstance(atom, AppliedUndef) else str(atom)
    if name not in QUANTITIES:
        return _real(generator.uniform(0.5, 2.0), generator)
    domain = QUANTITIES[name].domain
    if domain.logarithmic:
        low, high = mpmath.log(domain.low), mpmath.log(domain.high)
        return _real(float(mpmath.exp(low + generator.random() * (high - low))), generator)
    return _real(generator.uniform(domain.low, domain.high), generator)


def _real(value: float, generator: random.Random) -> sp.Expr:
    """Return a number near ``value`` whose digits go on beyond those of a double."""
    return sp.Float(value, _WORKING_DIGITS) * (1 + sp.Float(generator.random(), 40) * 10**-17)


def evaluate(expr: sp.Basic, values: Mapping[sp.Expr, sp.Expr]) -> sp.Expr:
    """Return the number that an expression has in a world."""
    expr = concrete(expr)
    number = expr.xreplace(dict(values))
    return sp.N(number, _WORKING_DIGITS) if isinstance(number, sp.Expr) else number


def concrete(expr: sp.Basic) -> sp.Basic:
    """Put a particular law for the unspecified one, so that numbers come out."""
    phi = GENERAL.phi.func
    given = expr.replace(phi, lambda argument: (1 / (1 + sp.exp(r))).subs(r, argument))
    return given.replace(lambda e: isinstance(e, sp.Subs), lambda slope: slope.doit())


def holds(claim: sp.Basic, values: Mapping[sp.Expr, sp.Expr]) -> bool:
    """Return whether a claim holds in a world, equations to 50 digits of their largest term."""
    if isinstance(claim, sp.And):
        return all(holds(part, values) for part in claim.args)
    if isinstance(claim, sp.Equality):
        left, right = evaluate(claim.lhs, values), evaluate(claim.rhs, values)
        scale = max(abs(left), abs(right), sp.Float(10) ** -300)
        return bool(abs(left - right) <= scale * sp.Float(10) ** -DIGITS)
    return evaluate(claim, values) == sp.true


def satisfying(
    sources: Iterable[Source],
    wanted: sp.Basic,
    conditions: tuple[Condition, ...],
    count: int,
) -> list[World]:
    """Draw ``count`` worlds inside the conditions; UnsatisfiableError if they are too rare."""
    relations = [c.relation for c in conditions if c.relation is not sp.true]
    everything = sp.Tuple(concrete(wanted), *relations)
    sources = tuple(sources)
    signs, found = _signs(relations), list[World]()
    for seed in range(100 * count):
        candidate = world(sources, everything, seed, signs)
        if all(holds(relation, candidate) for relation in relations):
            found.append(candidate)
            if len(found) == count:
                return found
    raise UnsatisfiableError(f"only {len(found)} of {100 * count} samples meet {conditions}")
