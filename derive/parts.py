"""Parts of expressions: bound variables, and where an expression has a value.

Key results
    bound         the variables that one node binds: of an integral, a limit, a derivative
    certain       the parts that are defined wherever the whole is
    needs         the conditions for an expression to be defined, if its arguments are
    positive, nonnegative, nonzero    the sign of an expression, as a relation to be proved
"""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp
from sympy.concrete.expr_with_limits import ExprWithLimits
from sympy.core.function import AppliedUndef
from sympy.core.relational import Relational

from .claims import FirstZero, HasValue, Term, landau_o
from .laws import GENERAL
from .memory import cache
from .note.model import WEARING
from .symbols import t

_LAW = GENERAL.phi.func
_TOTAL = (sp.exp, sp.tanh, sp.sin, sp.cos, sp.Abs, sp.besseli, sp.Piecewise)
"""Functions that have a value wherever their arguments have one."""


def bound(node: sp.Basic) -> frozenset[sp.Basic]:
    """Return the variables that a node binds."""
    if isinstance(node, (sp.Derivative, ExprWithLimits, sp.Subs, sp.Lambda)):
        return frozenset(node.variables)
    if isinstance(node, (sp.Limit, FirstZero)):
        return frozenset(node.args[1:2])
    return frozenset(node.args[2:4]) if isinstance(node, Term) else frozenset()


def bound_in(expr: sp.Basic) -> frozenset[sp.Basic]:
    """Return the variables that are bound anywhere in an expression."""
    return frozenset().union(*map(bound, sp.preorder_traversal(expr)))


def certain(expr: sp.Basic) -> Iterator[sp.Basic]:
    """Yield the parts that are defined wherever the whole is: not branches or integrands."""
    yield expr
    whole = (Relational, sp.And, sp.Add, sp.Mul, sp.Pow, sp.Function)
    if isinstance(expr, whole) and not isinstance(expr, sp.Piecewise):
        for part in expr.args:
            yield from certain(part)


@cache
def needs(expr: sp.Basic) -> tuple[sp.Basic, ...]:
    """Return the condition for an expression to be defined if its arguments are."""
    if expr in (sp.zoo, sp.nan):
        return (sp.false,)
    unknown = HasValue(expr)
    if isinstance(expr, (sp.Limit, FirstZero, Term, landau_o)):
        return (unknown,)
    if isinstance(expr, sp.Derivative):
        rated = expr.expr in WEARING and expr.variables == (t,)
        return () if rated or is_slope_of_law(expr) else (unknown,)
    if isinstance(expr, sp.Pow):
        base, exponent = expr.args
        if exponent.is_Integer:
            return (nonzero(base),) if exponent.is_negative else ()
        return (nonnegative(base) if exponent.is_positive else positive(base),)
    if isinstance(expr, sp.log):
        return (positive(expr.args[0]),)
    if isinstance(expr, sp.LambertW):
        return (nonnegative(expr.args[0] + sp.exp(-1)),)
    if isinstance(expr, sp.Ei):
        return (nonzero(expr.args[0]),)
    partial = isinstance(expr, sp.Function) and not isinstance(expr, _TOTAL)
    return (unknown,) if partial and not isinstance(expr, AppliedUndef) else ()


def positive(expr: sp.Expr) -> sp.Basic:
    """Return ``expr > 0``, which SymPy has not evaluated."""
    return sp.Gt(expr, 0, evaluate=False)


def nonnegative(expr: sp.Expr) -> sp.Basic:
    """Return ``expr >= 0``, which SymPy has not evaluated."""
    return sp.Ge(expr, 0, evaluate=False)


def nonzero(expr: sp.Expr) -> sp.Basic:
    """Return ``expr != 0``, which SymPy has not evaluated."""
    return sp.Ne(expr, 0, evaluate=False)


def is_slope_of_law(expr: sp.Basic) -> bool:
    """Return whether an expression is the first derivative of the unspecified contact law."""
    if isinstance(expr, sp.Subs):
        return is_slope_of_law(expr.expr) and expr.expr.variables == expr.variables
    return isinstance(expr, sp.Derivative) and (
        expr.derivative_count == 1 and expr.expr == _LAW(expr.variables[0])
    )
