"""Repairs of SymPy: the signs of numbers, which balls decide, and the equality of slopes.

Overview
    SymPy decides relations between numbers, and with them absolute values, pieces and roots, by
    numerical values whose accuracy it takes on trust, and by its theory of algebraic numbers:
    ``log(1 + exp(-30))`` and ``tanh(sqrt(1 + exp(-300)) - 1)`` are 0 to it, and
    ``(1 + 1/(1 + sqrt(2)))**2 - 2``, which is 0, is not.  False claims would follow.  Importing
    this module replaces these decisions by that of a ball.  A sign that no ball decides, such as
    that of a zero in disguise, is left open.  Slopes ``phi'(a)`` and ``phi'(b)`` are equal to SymPy
    if a and b print alike; here a and b must be equal.
Key results
    ball(number)        a ball that contains a number, or None
    sign_of(number)     1, -1 or None
    misjudged(number)   whether SymPy decided otherwise before
References
    Johansson, Arb: efficient arbitrary-precision midpoint-radius interval arithmetic, IEEE
    Transactions on Computers 66 (2017) 1281-1292.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import reduce
from importlib import import_module
from operator import add, mul
from typing import Any

import sympy as sp
from flint import arb, ctx, fmpq
from sympy.core import relational
from sympy.core.cache import clear_cache

from .memory import cache

_BITS = (64, 256, 1024, 4096, 16384)
_FUNCTIONS: dict[type, Callable[..., arb]] = {
    type(sp.pi): arb.pi,
    type(sp.E): arb.const_e,
    **{sp.exp: arb.exp, sp.log: arb.log, sp.tanh: arb.tanh, sp.sin: arb.sin, sp.cos: arb.cos},
    **{sp.Abs: abs, sp.Ei: arb.ei, sp.Pow: lambda base, exponent: base**exponent},
    sp.LambertW: lambda x, branch=None: x.lambertw() if branch is None else arb("nan"),
    sp.besseli: lambda order, x: x.bessel_i(order),
    sp.Add: lambda *terms: reduce(add, terms),
    sp.Mul: lambda *factors: reduce(mul, factors),
}
_FACTS: dict[str, tuple[int, ...]] = {
    **dict.fromkeys(("positive", "nonnegative"), (1,)),
    **dict.fromkeys(("negative", "nonpositive"), (-1,)),
    **{"zero": (), "nonzero": (1, -1)},
}
_FACTS |= {f"extended_{fact}": signs for fact, signs in _FACTS.items()}
"""The assumptions on signs, with the signs for which they hold."""
_UNKNOWN = (sp.Integral, sp.Limit, sp.Derivative, sp.Subs, sp.Piecewise)
"""Heads that a claim may hold and that have no ball; SymPy would take a quadrature, or the like."""


@cache
def ball(number: sp.Expr) -> arb | None:
    """Return a ball that contains a number, without 0 if its precision suffices; None if there is
    none, or the number is not known to be real.

    >>> ball(sp.tanh(sp.sqrt(1 + sp.exp(-300)) - 1)) > 0, ball(sp.log(-1))
    (True, None)
    """
    found = arb("nan")
    for bits in _BITS:
        with ctx.workprec(bits):
            found = _ball(number)
        if found.is_finite() and not found.contains(0):
            break
    return found if found.is_finite() else None


def _ball(number: sp.Expr) -> arb:
    if number.is_Rational:
        return arb(fmpq(int(number.p), int(number.q)))
    if isinstance(number, sp.Pow) and number.exp.is_Rational:
        base, exponent = _ball(number.base), fmpq(int(number.exp.p), int(number.exp.q))
        return base.sqrt() ** int(exponent.p) if exponent.q == 2 else base**exponent
    function = _FUNCTIONS.get(type(number))
    return function(*map(_ball, number.args)) if function else arb("nan")


def sign_of(number: sp.Expr) -> int | None:
    """Return 1 or -1 for a number whose sign a ball decides, None for others."""
    found = ball(number)
    if found is None or found.contains(0):
        return None
    return 1 if found > 0 else -1


def misjudged(number: sp.Expr) -> bool:
    """Return whether SymPy keeps another sign, from before this module was imported."""
    found = sign_of(number) if number.is_number else None
    if found is None:
        return False
    kept = {1: number.is_positive, -1: number.is_negative}
    return kept[found] is False or kept[-found] is True


def _is_of_claims(number: sp.Expr) -> bool:
    """Return whether an expression is a number that a claim may hold, no atom; SymPy decides the
    signs of others."""
    if not number.args or not number.is_number:
        return False
    parts = sp.preorder_traversal(number)
    others = (part for part in parts if not part.is_Rational and type(part) not in _FUNCTIONS)
    return not any(others) or number.has(*_UNKNOWN)


def _asked(fact: str, expr: sp.Expr) -> bool | None:
    """Decide an assumption about an expression, in SymPy's place."""
    if not _is_of_claims(expr):
        return _of_sympy(fact, expr)
    if fact in _FACTS:
        found = sign_of(expr)
        return None if found is None else found in _FACTS[fact]
    told = _of_sympy(fact, expr)
    for sign in _FACTS.keys() & expr._assumptions.keys():  # deduced from others, such as irrational
        del expr._assumptions[sign]
    return told


def _is_of_sign(number: sp.Expr, positive: bool) -> bool | None:
    """Decide ``is_positive`` or ``is_negative`` by a numerical value."""
    if not _is_of_claims(number):
        return _by_value(number, positive)
    found = sign_of(number)
    return None if found is None else (found > 0) == positive


def _difference(a: sp.Expr, b: sp.Expr) -> sp.Expr | None:
    """Return a number with the sign of a - b, which decides relations; None to leave them open."""
    if not (a.is_number and b.is_number) or not _is_of_claims(a - b):
        return _difference_of_sympy(a, b)
    found = sign_of(a - b)
    return found and sp.Integer(found)


def _power(self: sp.Pow, exponent: sp.Expr) -> sp.Expr | None:
    """Return a power of a power as one; None to leave it, as the sign of the base is open."""
    is_open = _is_of_claims(self.base) and sign_of(self.base) is None
    return None if is_open and not exponent.is_Integer else _power_of_sympy(self, exponent)


def _by_points(slope: sp.Subs) -> tuple[sp.Basic, ...]:
    """Return what makes two slopes equal."""
    return slope.expr.xreplace(slope.canonical_variables), slope.point


assumptions: Any = import_module("sympy.core.assumptions")  # not the function in ``sympy.core``
_of_sympy = assumptions._ask
_by_value = sp.Expr._eval_is_extended_positive_negative
_difference_of_sympy = relational._n2
_power_of_sympy = sp.Pow._eval_power
assumptions._ask = _asked
sp.Expr._eval_is_extended_positive_negative = _is_of_sign
relational._n2 = _difference
sp.Pow._eval_power = _power
sp.Subs._hashable_content = _by_points
clear_cache()  # of decisions made before
