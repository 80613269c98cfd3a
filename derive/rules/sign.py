"""The sign of an expression, where it is manifest."""

from __future__ import annotations

import sympy as sp

from ..laws import GENERAL

LAW = GENERAL.phi.func
"""The unspecified contact law; all that is known of it is that it is positive and decreases."""

_SLOPE_OF_LAW = sp.Dummy("slope", negative=True)


def sign(expr: sp.Expr) -> int | None:
    """Return 1 or -1 for an expression that is manifestly positive or negative, else None.

    >>> y = sp.Symbol("y", real=True)
    >>> sign(1 + sp.tanh(y)), sign(sp.tanh(y) - 1), sign(y)
    (1, -1, None)
    >>> sign(1 - y / sp.sqrt(1 + y**2))
    1
    """
    expr = expr.replace(_is_slope_of_law, lambda _: _SLOPE_OF_LAW)
    exponential = sp.powsimp(expr.rewrite(sp.exp))
    numerator, denominator = sp.fraction(sp.together(exponential))
    quotient = sp.factor_terms(sp.expand(numerator)) / sp.factor(denominator)
    for form in (expr, exponential, quotient, sp.factor(exponential)):
        if form.is_positive:
            return 1
        if form.is_negative:
            return -1
    return _of_factors(expr)


def _of_factors(expr: sp.Expr) -> int | None:
    numerator, denominator = sp.fraction(sp.together(expr))
    found = 1
    for part in (sp.factor_terms(numerator), denominator):
        for factor in sp.Mul.make_args(part):
            one = 1 if factor.is_positive else -1 if factor.is_negative else _of_terms(factor)
            if one is None:
                return None
            found *= one
    return found


def _of_terms(expr: sp.Expr) -> int | None:
    """Return the sign of a term whose square exceeds that of all others together.

    >>> y = sp.Symbol("y", real=True)
    >>> _of_terms(sp.sqrt(1 + y**2) - y)
    1
    """
    for term in sp.Add.make_args(expr):
        if sp.expand(term**2 - (expr - term) ** 2).is_positive:
            return 1 if term.is_positive else -1 if term.is_negative else None
    return None


def _is_slope_of_law(expr: sp.Expr) -> bool:
    return isinstance(expr, (sp.Derivative, sp.Subs)) and bool(expr.has(LAW))


def assume(expr: sp.Expr, positive: tuple[sp.Symbol, ...]) -> sp.Expr:
    """Return ``expr`` with symbols that a condition makes positive replaced by such."""
    return expr.subs({s: sp.Dummy(s.name, positive=True) for s in positive})
