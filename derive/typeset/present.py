"""Presentation: the order of terms and factors in a claim without a layout by an author.

SymPy sorts terms and factors by rules of its own, and prefers ``1/2 - tanh(2 h/sigma - 4)/2``.
Here positive terms precede negative ones, symbols precede sums and functions, and the contact law
has the note's form.  The value does not change: a test asserts it.
"""

from __future__ import annotations

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.core.relational import Relational

from ..symbols import t

_HALF = sp.Rational(1, 2)
#: The first factors of a product, in the order of the note.
_FIRST = (
    "f_a", "f_c", "kappa", "K_a", "K_c", "H_a", "H_c", "k", "b", "L", "V", "T", "p_max",
)  # fmt: skip


def presentable(expr: sp.Basic) -> sp.Basic:
    """Return ``expr``, unevaluated, in the order of an author.

    >>> from derive.typeset.display import latex
    >>> x = sp.Symbol("x")
    >>> latex(presentable(sp.Rational(1, 2) - sp.tanh(2 * x - 4) / 2))
    '\\\\frac{1 + \\\\tanh{\\\\left(4 - 2 x \\\\right)}}{2}'
    """
    if isinstance(expr, (AppliedUndef, sp.Derivative, sp.Integral, sp.Subs)) or not expr.args:
        return expr
    if isinstance(expr, sp.Add):
        return _sum(expr)
    if isinstance(expr, sp.Mul):
        return _product(expr)
    if isinstance(expr, sp.Piecewise):
        branches = [(presentable(e.expr), presentable(e.cond)) for e in expr.args]
        return sp.Piecewise(*branches, evaluate=False)
    arguments = [presentable(argument) for argument in expr.args]
    if isinstance(expr, (sp.Function, sp.Pow, sp.logic.boolalg.BooleanFunction, Relational)):
        return expr.func(*arguments, evaluate=False)
    return expr.func(*arguments)


def _sum(expr: sp.Add) -> sp.Basic:
    if _is_half(expr):
        return sp.Mul(_HALF, _doubled(expr), evaluate=False)
    terms = [_upright(term) for term in expr.args]
    ordered = sorted(terms, key=lambda e: (_negative(e), e.is_number == _negative(e)))
    return sp.Add(*(_term(term) for term in ordered), evaluate=False)


def _is_half(expr: sp.Expr) -> bool:
    """Return whether an expression is ``1/2 + tanh(x)/2``, to be written ``(1 + tanh(x))/2``."""
    return bool(
        expr.is_Add and len(expr.args) == 2 and expr.args[0] == _HALF and expr.args[1].has(sp.tanh)
    )


def _doubled(expr: sp.Add) -> sp.Expr:
    """Return ``1 + tanh(x)`` for ``1/2 + tanh(x)/2``, unevaluated."""
    return sp.Add(1, presentable(2 * _upright(expr.args[1])), evaluate=False)


def _upright(term: sp.Expr) -> sp.Expr:
    """Return a term in ``tanh(x)`` with ``-tanh(-x)`` where x begins with a minus, unevaluated."""
    factors = sp.Mul.make_args(term)
    inner = [f for f in factors if isinstance(f, sp.tanh)]
    if len(inner) != 1 or not inner[0].args[0].as_coeff_Add()[0].is_negative:
        return term
    turned = sp.tanh(sp.expand(-inner[0].args[0]), evaluate=False)
    rest = sp.Mul(-1, *(f for f in factors if f is not inner[0]))
    return turned if rest == 1 else sp.Mul(rest, turned, evaluate=False)


def _negative(term: sp.Expr) -> bool:
    coefficient, _ = term.as_coeff_Mul()
    return bool(coefficient.is_negative)


def _term(term: sp.Expr) -> sp.Basic:
    """Return a term with its sign in front of the whole."""
    if not _negative(term) or term.is_number:
        return presentable(term)
    coefficient, rest = term.as_coeff_Mul()
    positive = rest if coefficient == -1 else -coefficient * rest
    return sp.Mul(-1, presentable(positive), evaluate=False)


def _product(expr: sp.Mul) -> sp.Basic:
    """Return a fraction of numbers and symbols, followed by sums and functions."""
    plain, below, large = [], [], []
    for factor in expr.args:
        if _is_half(factor):
            plain.append(_HALF)
            large.append(_doubled(factor))
        elif isinstance(factor, sp.Derivative):
            large.insert(0, factor)
        elif not _structured(factor):
            plain.append(factor)
        elif factor.is_Pow and factor.exp.is_negative:
            below.append(presentable(factor))
        else:
            large.append(presentable(factor))
    symbols = sorted((f for f in sp.Mul.make_args(sp.Mul(*plain)) if f != 1), key=_place)
    if below and all(symbol.is_number for symbol in symbols):  # one fraction reads better
        return sp.Mul(*symbols, *large, *below, evaluate=False)
    front = [sp.Mul(*symbols, *below, evaluate=False)] if symbols or below else []
    return sp.Mul(*front, *large, evaluate=False) if len(front + large) > 1 else (front + large)[0]


def _place(factor: sp.Expr) -> tuple[bool, bool, int]:
    """Return the rank of a factor in a product: data, other symbols, fields, time."""
    base = factor.base if factor.is_Pow else factor
    name = getattr(base, "name", "")
    first = _FIRST.index(name) if name in _FIRST else len(_FIRST)
    return base == t, isinstance(base, AppliedUndef), -1 if factor.is_number else first


def _structured(factor: sp.Expr) -> bool:
    return (
        bool(factor.has(sp.Add, sp.Function))
        and not _is_name(factor)
        and not (factor.is_Pow and _is_name(factor.base))
    )


def _is_name(expr: sp.Expr) -> bool:
    """Return whether an expression is a symbol, or a field at time t."""
    return expr.is_Symbol or (isinstance(expr, AppliedUndef) and expr.args == (t,))
