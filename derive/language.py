"""The language of claims: which expressions may stand in one, and what they bind.

Overview
    The kernel trusts SymPy's own heads, real numbers, and names with the domain that the
    vocabulary gives them.  A head of somebody's own may lie about its sign, a second f_c may be
    positive, a number of limited precision may absorb another: none is of the language.
Key results
    fault(expr)    why an expression is not of the language, or None
    names(expr)    the names in an expression, each with what bears it
    bound(expr)    the variables that one node binds: of an integral, a limit, a derivative
    certain(expr)  the parts that have a value wherever the whole has one
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

import sympy as sp
from sympy.concrete.expr_with_limits import ExprWithLimits
from sympy.core.function import UndefinedFunction
from sympy.core.relational import Relational

from .claims import FirstZero, Term
from .symbols import QUANTITIES, symbol

_OURS = f"{__package__}.claims"
_NO_REALS = (sp.Float, type(sp.I), type(sp.nan), type(sp.zoo))
_DOMAINS = [
    sp.Dummy(**{domain: True}).assumptions0 for domain in ("real", "positive", "nonnegative")
]


@cache
def fault(expr: sp.Basic) -> str | None:
    """Return why an expression is not of the language, None if it is.

    >>> fault(symbol("f_c") + 1), fault(sp.Symbol("f_c", positive=True))
    (None, 'f_c is not the f_c of the vocabulary')
    """
    return next(filter(None, map(_fault, _nodes(expr))), None)


def _nodes(expr: sp.Basic) -> Iterator[sp.Basic]:
    yield expr
    for part in expr.args[:3] if isinstance(expr, sp.Limit) else expr.args:
        yield from _nodes(part)


def _fault(node: sp.Basic) -> str | None:
    name = _name(node)
    if name in QUANTITIES:
        known = symbol(name)
        same = node.func == known.func if node.args else node == known
        return None if same else f"{name} is not the {name} of the vocabulary"
    if name:
        # Of a function only the domain counts.
        fits = node.assumptions0 in _DOMAINS if node.is_Symbol else node.is_real
        return None if fits and not node.is_zero else f"{name} is no real quantity"
    home = type(node).__module__
    if not (home.startswith("sympy.") or home == _OURS) or isinstance(node, _NO_REALS):
        return f"{node} is of no kind that a claim may hold"
    if isinstance(node, sp.Limit) and node != sp.Limit(*node.args[:3]):
        return f"{node} is no limit from above"
    return None


def _name(node: sp.Basic) -> str:
    if isinstance(node, sp.Symbol):
        return str(node.name)
    return str(node.func.__name__) if isinstance(type(node), UndefinedFunction) else ""


@cache
def names(expr: sp.Basic) -> frozenset[tuple[str, object]]:
    """Return the names in an expression, each with the symbol or function that bears it."""
    found = ((_name(n), n.func if n.args else n) for n in _nodes(expr))
    return frozenset(
        (name, bearer) for name, bearer in found if name and not isinstance(bearer, sp.Dummy)
    )


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
    """Return the parts that have a value wherever the whole has one: no branch, no integrand."""
    yield expr
    whole = (Relational, sp.And, sp.Add, sp.Mul, sp.Pow, sp.Function)
    if isinstance(expr, whole) and not isinstance(expr, sp.Piecewise):
        for part in expr.args:
            yield from certain(part)
