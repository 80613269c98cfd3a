"""The signs of numbers, by balls: in place of SymPy's, which are not always right.

Overview
    SymPy decides relations between numbers, and with them absolute values and pieces, by numerical
    values whose accuracy it takes on trust: ``log(1 + exp(-30))`` and
    ``tanh(sqrt(1 + exp(-300)) - 1)`` are 0 to it, and false claims would follow.  Importing this
    module replaces its two numerical decisions by that of a ball.  A sign that no ball decides is
    left open.
Key results
    known_ball(number, bits)    a ball that contains a number, or None
    sign_of(number)             1, -1 or None
    misjudged(number)           whether SymPy decided otherwise before
References
    Johansson, Arb: efficient arbitrary-precision midpoint-radius interval arithmetic, IEEE
    Transactions on Computers 66 (2017) 1281-1292.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, reduce
from operator import add, mul

import sympy as sp
from flint import arb, ctx, fmpq
from sympy.core import relational
from sympy.core.cache import clear_cache

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
_UNKNOWN = (sp.Integral, sp.Limit, sp.Derivative, sp.Subs, sp.Piecewise)
"""Heads that a claim may hold and that have no ball; SymPy would take a quadrature, or the like."""


def ball(number: sp.Expr, bits: int) -> arb:
    """Return a ball that contains a number; not a finite one if it is not known to be real.

    >>> ball(sp.log(1 + sp.exp(-30)), 64) > 0, ball(sp.log(-1), 64).is_finite()
    (True, False)
    """
    with ctx.workprec(bits):
        return _ball(number)


def _ball(number: sp.Expr) -> arb:
    if number.is_Rational:
        return arb(fmpq(int(number.p), int(number.q)))
    if isinstance(number, sp.Pow) and number.exp.is_Rational:
        base, exponent = _ball(number.base), fmpq(int(number.exp.p), int(number.exp.q))
        return base.sqrt() ** int(exponent.p) if exponent.q == 2 else base**exponent
    function = _FUNCTIONS.get(type(number))
    return function(*map(_ball, number.args)) if function else arb("nan")


@cache
def sign_of(number: sp.Expr) -> int | None:
    """Return 1 or -1 for a number whose sign a ball decides, None for others.

    >>> sign_of(sp.tanh(sp.sqrt(1 + sp.exp(-300)) - 1)), sign_of(sp.S.Zero)
    (1, None)
    """
    for bits in _BITS:
        value = ball(number, bits)
        if value.is_finite() and not value.contains(0):
            return 1 if value > 0 else -1
    return None


def misjudged(number: sp.Expr) -> bool:
    """Return whether SymPy keeps another sign, from before this module was imported."""
    found = sign_of(number) if number.is_number else None
    kept = {1: number.is_positive, -1: number.is_negative}
    return found is not None and (kept[found] is False or kept[-found] is True)


def _is_foreign(number: sp.Expr) -> bool:
    """Return whether a number has heads that no claim may hold; SymPy decides its sign."""
    parts = sp.preorder_traversal(number)
    others = (part for part in parts if not part.is_Rational and type(part) not in _FUNCTIONS)
    return any(others) and not number.has(*_UNKNOWN)


def _is_of_sign(number: sp.Expr, positive: bool) -> bool | None:
    """Decide ``is_positive`` or ``is_negative`` of an expression without free symbols."""
    if not number.is_number:
        return None
    if _is_foreign(number):
        return _of_sympy(number, positive)
    found = sign_of(number)
    return None if found is None else (found > 0) == positive


def _difference(a: sp.Expr, b: sp.Expr) -> sp.Expr | None:
    """Return a number with the sign of a - b, which decides relations; None to leave them open."""
    if not (a.is_number and b.is_number):
        return None
    if _is_foreign(a - b):
        return _difference_of_sympy(a, b)
    found = sign_of(a - b)
    return found and sp.Integer(found)


_of_sympy = sp.Expr._eval_is_extended_positive_negative
_difference_of_sympy = relational._n2
sp.Expr._eval_is_extended_positive_negative = _is_of_sign
relational._n2 = _difference
clear_cache()  # of decisions made before
