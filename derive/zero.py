"""The zero test: is an expression identically zero?

Overview
    ``simplify`` is unbounded and heuristic.  This test applies a short, fixed list of exact
    transformations: arguments of functions are expanded, hyperbolic functions become exponentials,
    exponentials of sums become products, and the result is brought over one denominator.
Key results
    is_zero(expr)    True only if the transformations reach 0
    same(a, b)       is_zero(a - b), also for relations and systems of them
"""

from __future__ import annotations

import random

import sympy as sp
from sympy.core.function import AppliedUndef, Function
from sympy.core.relational import Relational

_NOISE = sp.Float(10) ** -12
"""Bound of the rounding error of an exact zero, in 30 digits, with terms of moderate size."""
_NOT_PLAIN = (sp.Integral, sp.Limit, sp.Subs, sp.Sum)


def is_zero(expr: sp.Expr) -> bool:
    """Return True when exact rewriting reduces ``expr`` to 0; False proves nothing."""
    if expr == 0 or _expand(expr) == 0:  # most often it is the same, written otherwise
        return True
    if not expr.has(*_NOT_PLAIN):
        expr = _fields_as_symbols(expr)
        if _differs_from_zero(expr):
            return False
    expr = _exponentials(_normal_arguments(expr, {}))
    numerator, _ = sp.fraction(sp.together(expr))
    numerator = _expand(sp.powsimp(_expand(numerator), deep=True))
    if numerator == 0:
        return True
    return sp.cancel(_merged(numerator)) == 0


def _fields_as_symbols(expr: sp.Expr) -> sp.Expr:
    """Replace fields and derivatives by symbols of the same sign, which SymPy handles faster."""
    atoms = expr.atoms(sp.Derivative, AppliedUndef)
    outermost_first = sorted(atoms, key=lambda a: (not isinstance(a, sp.Derivative), str(a)))
    return expr.xreplace({atom: sp.Dummy(**_signs(atom)) for atom in outermost_first})


def _signs(atom: sp.Expr) -> dict[str, bool]:
    signs = ("real", "nonnegative", "nonpositive", "nonzero")
    return {sign: True for sign in signs if getattr(atom, f"is_{sign}")}


def _expand(expr: sp.Expr) -> sp.Expr:
    return sp.expand(expr, log=False, power_base=False)


def _differs_from_zero(expr: sp.Expr) -> bool:
    """Return True if the value at a random point shows that ``expr`` is not identically zero.

    One point suffices, and is much faster than rewriting in vain.
    """
    generator = random.Random(1)
    point = {}
    for symbol in sorted(expr.free_symbols, key=sp.default_sort_key):
        size = sp.Float(generator.uniform(0.3, 1.7), 40)
        point[symbol] = -size if symbol.is_negative else size
    number = sp.N(expr.xreplace(point), 30)
    return bool(number.is_Float and number.is_finite and abs(number) > _NOISE)


def same(left: sp.Basic, right: sp.Basic) -> bool:
    """Return True if two expressions, relations or systems are equal, side by side."""
    if left == right:
        return True
    if isinstance(left, Relational) and isinstance(right, Relational):
        right = right if left.func == right.func else right.reversed
        return left.func == right.func and same(left.lhs, right.lhs) and same(left.rhs, right.rhs)
    if isinstance(left, sp.logic.boolalg.BooleanFunction):
        return left.func == right.func and all(
            any(same(a, b) for b in right.args) for a in left.args
        )
    if isinstance(left, sp.Expr) and isinstance(right, sp.Expr):
        return is_zero(left - right)
    return False


def _normal_arguments(expr: sp.Expr, known: dict[sp.Expr, sp.Expr]) -> sp.Expr:
    """Bring the arguments of functions and the radicands of roots to one expanded form."""
    if not expr.args or isinstance(expr, (AppliedUndef, sp.Derivative, sp.Piecewise)):
        return expr
    if expr not in known:
        args = [_normal_arguments(a, known) for a in expr.args]
        if isinstance(expr, Function):
            args = [sp.expand(sp.cancel(sp.powdenest(a))) for a in args]
        elif isinstance(expr, sp.Pow) and not expr.exp.is_Integer:
            args = [sp.factor_terms(sp.expand(args[0])), args[1]]
        known[expr] = expr.func(*args)
    return known[expr]


def _exponentials(expr: sp.Expr) -> sp.Expr:
    expr = expr.rewrite([sp.tanh, sp.sinh, sp.cosh, sp.coth], sp.exp)
    return sp.expand_power_exp(sp.expand_log(expr) if expr.has(sp.log) else expr)


def _merged(expr: sp.Expr) -> sp.Expr:
    """Write the exponentials of each term as one, its argument in lowest terms.

    Otherwise exponentials whose arguments differ by a constant would seem independent.
    """
    merged = []
    for term in sp.Add.make_args(expr):
        powers, rest = sp.sift(sp.Mul.make_args(term), lambda e: isinstance(e, sp.exp), binary=True)
        merged.append(sp.Mul(*rest, sp.exp(sp.cancel(sp.Add(*(e.exp for e in powers))))))
    return sp.expand_power_exp(sp.Add(*merged))
