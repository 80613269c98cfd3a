"""Limits in time: rules that pass from bounds to limits, and from limits to limits.

Overview
    A claim ``Limit(e, t, oo) = value`` is about the fields as functions of time.  Each rule is
    one textbook theorem whose hypotheses are checked by the machine.  Where a limit follows
    from the wear growing without bound, it is sampled too: at a wear of 1e20, 1e30 and 1e40 mm
    the distance of the two sides has to fall accordingly.
Key results
    forever, later   the limit for t -> oo; an expression one period later
    Diverges         u >= c t gives a + f u -> oo for f > 0
    Unbounded        du/dt = F(u, load) with F > 0 gives u -> oo
    AtInfinity       what a function of u and the load tends to as u -> oo
    Vanishes         |e| <= B/s and s -> oo give e -> 0
    Passes           limits pass through continuous functions and through t -> t + T
    Accumulates      du/dt -> R gives u(t + T) - u(t) -> R T
    Named            a name for a limit
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import sympy as sp
from sympy.core.function import AppliedUndef

from ..check import Check
from ..sample import DIGITS, Source, evaluate, satisfying
from ..symbols import symbol, t
from ..zero import is_zero
from . import Authored, RuleError, Theorem, proof, sources
from .sign import LAW, assume, sign

if TYPE_CHECKING:
    from ..statement import Statement

T = symbol("T")
_LOAD = symbol("U_a").func
_WEAR = symbol("u_c")
_DEPTHS = (20, 30, 40)


def forever(expr: sp.Expr) -> sp.Limit:
    """Return the limit of ``expr`` for t -> oo, unevaluated."""
    return sp.Limit(expr, t, sp.oo)


def later(expr: sp.Expr) -> sp.Expr:
    """Return ``expr`` one period later.

    >>> from derive.symbols import symbol
    >>> later(symbol("u_c")) == symbol("u_c").subs(t, t + T)
    True
    """
    fields = {f: f.subs(t, t + T) for f in expr.atoms(AppliedUndef) if f.has(t)}
    return expr.xreplace(fields)


@dataclass(frozen=True)
class Diverges(Theorem):
    """From ``u >= c t`` with c > 0: a polynomial in u that increases without bound diverges."""

    expr: sp.Expr
    positive: tuple[sp.Symbol, ...] = ()
    theorem = "it increases with u_c, and already its value at the lower bound of u_c diverges"

    def apply(self, parents: tuple[sp.Basic, ...]) -> sp.Basic:
        (growth,) = parents
        u, y = growth.gts, sp.Dummy(positive=True)
        at_bound = assume(self.expr.subs(u, y), self.positive)
        if sign(sp.diff(at_bound, y)) != 1 or sp.limit(at_bound, y, sp.oo) != sp.oo:
            raise RuleError(f"{self.expr} does not increase with {u} beyond all bounds")
        return sp.Eq(forever(self.expr), sp.oo)


@dataclass(frozen=True)
class Unbounded(Theorem):
    """From ``du/dt = F(u, load)`` with F positive and continuous, and a bounded load: u -> oo.

    ``positive`` are expressions that a condition makes positive (a roughness, say).
    """

    positive: tuple[sp.Expr, ...] = ()
    theorem = (
        "were u_c bounded, the rate would have a positive minimum, and u_c would exceed any bound"
    )

    def apply(self, parents: tuple[sp.Basic, ...]) -> sp.Basic:
        (law,) = parents
        rate, function = law.lhs, law.rhs
        for expr in self.positive:
            function = function.subs(expr, sp.Dummy(positive=True))
        if not isinstance(rate, sp.Derivative) or function.atoms(sp.Derivative):
            raise RuleError(f"{law} does not give the rate")
        if sign(function) != 1:
            raise RuleError(f"{function} is not manifestly positive")
        return sp.Eq(forever(rate.expr), sp.oo)


@dataclass(frozen=True)
class AtInfinity(Authored):
    """An authored limit of a function of u and a bounded load, where the parent says u -> oo.

    The function is written in z = 1/u; continuity at z = 0 makes the limit uniform in the load.
    """

    def check(self, statement: Statement) -> tuple[Check, ...]:
        divergence, *_ = (parent.claim for parent in statement.parents)
        claim, wear = statement.claim, divergence.lhs.args[0]
        inside, y = claim.lhs.args[0], sp.Dummy(positive=True)
        plain = {f: sp.Dummy(real=True) for f in inside.atoms(AppliedUndef) if f != wear}
        flat = inside.xreplace({wear: y}).xreplace(plain)
        value = sp.limit(flat, y, sp.oo).xreplace({d: f for f, d in plain.items()})
        proved = divergence.rhs == sp.oo and is_zero(value - claim.rhs)
        return proof(proved, f"SymPy's limit is {value}"), approached(statement)


@dataclass(frozen=True)
class Vanishes(Theorem):
    """From ``-B/s <= e <= B/s`` with constant B, and ``s -> oo``: ``e -> 0``."""

    theorem = "squeezed between two bounds that tend to 0"

    def apply(self, parents: tuple[sp.Basic, ...]) -> sp.Basic:
        squeeze, divergence = parents
        size = divergence.lhs.args[0]
        above = {part.lts for part in squeeze.args if _shrinks(part.gts, size)}
        below = {part.gts for part in squeeze.args if _shrinks(part.lts, size)}
        if divergence.rhs != sp.oo or above != below or len(above) != 1:
            raise RuleError(f"{squeeze} does not squeeze one expression like 1/({size})")
        return sp.Eq(forever(above.pop()), 0)


def _shrinks(side: sp.Expr, size: sp.Expr) -> bool:
    """Return whether ``side`` is a constant over ``size``."""
    constant = sp.cancel(side * size)
    return not constant.has(t) and not constant.atoms(AppliedUndef)


@dataclass(frozen=True)
class Passes(Authored):
    """Limits pass through a function that is continuous where they end.

    The parents give the limits of some expressions; the authored claim is the limit of a
    combination of those expressions, now or one period later.
    """

    def check(self, statement: Statement) -> tuple[Check, ...]:
        claim = statement.claim
        left = self._value(claim.lhs, statement)
        right = self._value(claim.rhs, statement)
        detail = "continuous function of quantities whose limits are known"
        proved = left is not None and right is not None and is_zero(left - right)
        return proof(proved, detail), approached(statement)

    def _value(self, side: sp.Expr, statement: Statement) -> sp.Expr | None:
        """Return the value of ``side`` with its limits taken; None where one is not known."""
        for limit in side.atoms(sp.Limit):
            value = self._limit(limit.args[0], statement)
            if value is None:
                return None
            side = side.subs(limit, value)
        return side

    @staticmethod
    def _limit(expr: sp.Expr, statement: Statement) -> sp.Expr | None:
        values: dict[sp.Expr, sp.Expr] = {}
        for parent in statement.parents:
            known, value = parent.claim.lhs, parent.claim.rhs
            if not isinstance(known, sp.Limit):
                expr = expr.subs(known, value)
                continue
            for quantity in (known.args[0], later(known.args[0])):
                stand_in = sp.Dummy(real=True)
                expr = in_terms_of(expr, quantity, stand_in)
                values[stand_in] = value
        if _varies(expr) or not continuous(expr):
            return None
        infinite = {s: v for s, v in values.items() if v.is_infinite}
        for stand_in, value in infinite.items():
            expr = sp.limit(expr, stand_in, value)
        return expr.subs(values)


def _varies(expr: sp.Expr) -> bool:
    """Return whether an expression depends on time."""
    return bool(expr.has(t)) or bool(expr.atoms(AppliedUndef) - expr.atoms(LAW))


def continuous(expr: sp.Expr) -> bool:
    """Return whether an expression is built of functions that are continuous everywhere.

    Denominators are allowed; a value that makes one vanish is not finite and shows itself.
    """
    allowed = (sp.Add, sp.Mul, sp.Pow, sp.exp, sp.tanh, LAW, sp.Symbol, sp.Number)
    return all(isinstance(e, allowed) or e.is_number for e in sp.preorder_traversal(expr))


def in_terms_of(expr: sp.Expr, quantity: sp.Expr, name: sp.Symbol) -> sp.Expr:
    """Write ``expr`` with ``name`` for ``quantity``, by eliminating the load or a field."""
    expr = expr.subs(quantity, name)
    fields = [f for f in quantity.atoms(AppliedUndef) if f.has(t) and expr.has(f)]
    for field in sorted(fields, key=lambda f: (f.func != _LOAD, str(f))):
        if not sp.diff(quantity, field).has(field):
            solved = Source.of(sp.Eq(quantity, name), field).value
            return _cancelled(expr.subs(field, solved))
    return expr


def _cancelled(expr: sp.Expr) -> sp.Expr:
    """Cancel common factors, inside the arguments of functions too."""
    if not expr.args or (isinstance(expr, (AppliedUndef, sp.Derivative)) and not expr.has(LAW)):
        return expr
    inner = expr.func(*map(_cancelled, expr.args))
    return inner if isinstance(inner, sp.Function) else sp.cancel(inner)


@dataclass(frozen=True)
class Accumulates(Theorem):
    """From ``du/dt -> R``: the wear of one period tends to R T."""

    theorem = "mean value theorem on [t, t + T]"

    def apply(self, parents: tuple[sp.Basic, ...]) -> sp.Basic:
        (limit,) = parents
        u = limit.lhs.args[0].expr
        return sp.Eq(forever(u.subs(t, t + T) - u), limit.rhs * T)


@dataclass(frozen=True)
class Named(Theorem):
    """A name for a limit: the first parent defines the name, the second gives the limit."""

    theorem = "the limit, inserted into the definition"

    def apply(self, parents: tuple[sp.Basic, ...]) -> sp.Basic:
        definition, limit = parents
        return definition.subs(limit.lhs, limit.rhs)


def approached(statement: Statement) -> Check:
    """Evaluate the limits of a claim at ever deeper wear; the sides must come together."""
    gaps = [_gap(statement, exponent) for exponent in _DEPTHS]
    passed = all(gap < 10.0 ** (15 - depth) for gap, depth in zip(gaps, _DEPTHS, strict=True))
    shown = ", ".join(f"{gap:.0e}" for gap in gaps)
    depths = ", ".join(f"1e{depth}" for depth in _DEPTHS)
    detail = f"at u_c = {depths} mm the sides differ by {shown} (relative if above 1)"
    return Check("sample", passed, detail)


def _gap(statement: Statement, exponent: int) -> float:
    """Return the relative distance of the sides of a claim at a wear of 10^exponent mm."""
    claim = statement.claim
    inside = claim.replace(sp.Limit, lambda expr, *_: expr)
    depth = sp.Float(10, 2 * DIGITS) ** exponent
    found = {**sources(statement), _WEAR: Source(_WEAR, depth)}
    found |= {later(pivot): Source(later(pivot), later(s.value)) for pivot, s in found.items()}
    found[later(_WEAR)] = Source(later(_WEAR), depth + 1)
    (world,) = satisfying(found.values(), inside, statement.conditions, 1)
    left, right = evaluate(inside.lhs, world), evaluate(inside.rhs, world)
    return float(abs(left - right) / max(abs(left), abs(right), 1))
