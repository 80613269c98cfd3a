"""The zero test: is an expression identically zero?

Overview
    ``simplify`` is unbounded and guesses.  Here a short, fixed list of exact moves is tried:
    arguments of functions are expanded, hyperbolic functions become exponentials, exponentials
    of sums become products, and the result is brought over one denominator.
Key results
    is_zero(expr)    True only when the moves reach 0
    same(a, b)       is_zero(a - b), also for relations and systems of them
"""

from __future__ import annotations

import random

import sympy as sp
from sympy.core.function import AppliedUndef, Function
from sympy.core.relational import Relational

_NOISE = sp.Float(10) ** -12
"""What 30 digits of terms of moderate size may leave of an exact zero."""
_NOT_PLAIN = (sp.Integral, sp.Limit, sp.Subs, sp.Sum)


def is_zero(expr: sp.Expr) -> bool:
    """Return True when exact rewriting reduces ``expr`` to 0; False proves nothing."""
    if expr.is_zero:
        return True
    if _differs_from_zero(expr):
        return False
    expr = _exponentials(_normal_arguments(expr))
    if sp.expand(expr) == 0:
        return True
    numerator, _ = sp.fraction(sp.together(expr))
    numerator = sp.expand(sp.powsimp(sp.expand(numerator), deep=True))
    if numerator == 0:
        return True
    return sp.cancel(_atoms_as_symbols(_merged(numerator))) == 0


def _differs_from_zero(expr: sp.Expr) -> bool:
    """Return True when a number shows that ``expr`` is not identically zero.

    One point suffices, and is much quicker than rewriting in vain.
    """
    if expr.has(*_NOT_PLAIN):
        return False
    generator = random.Random(1)

    def value(atom: sp.Expr) -> sp.Expr:
        number = sp.Float(generator.uniform(0.3, 1.7), 40)
        return -number if atom.is_negative else number

    derivatives = sorted(expr.atoms(sp.Derivative), key=str)
    point = {atom: value(atom) for atom in derivatives}
    bare = expr.xreplace(point)
    unknown = sorted(bare.atoms(AppliedUndef) | bare.free_symbols, key=str)
    number = bare.xreplace({a: value(a) for a in unknown if isinstance(a, AppliedUndef)})
    number = number.xreplace({a: value(a) for a in unknown if isinstance(a, sp.Symbol)})
    if not isinstance(number, sp.Expr) or number.free_symbols:
        return False
    number = sp.N(number, 30)
    return bool(number.is_Float and number.is_finite and abs(number) > _NOISE)


def same(left: sp.Basic, right: sp.Basic) -> bool:
    """Return True when two expressions, relations or systems say the same, side by side."""
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


def _normal_arguments(expr: sp.Expr) -> sp.Expr:
    """Bring the arguments of functions, and what stands under roots, to one expanded form."""
    if not expr.args or isinstance(expr, (AppliedUndef, sp.Derivative)):
        return expr
    args = [_normal_arguments(a) if isinstance(a, sp.Expr) else a for a in expr.args]
    if isinstance(expr, Function):
        args = [sp.expand(sp.cancel(_roots(a))) if isinstance(a, sp.Expr) else a for a in args]
    elif isinstance(expr, sp.Pow) and not expr.exp.is_Integer:
        args = [sp.factor_terms(sp.expand(args[0])), args[1]]
    return expr.func(*args)


def _roots(expr: sp.Expr) -> sp.Expr:
    return sp.powdenest(expr)


def _exponentials(expr: sp.Expr) -> sp.Expr:
    expr = expr.rewrite([sp.tanh, sp.sinh, sp.cosh, sp.coth], sp.exp)
    return sp.expand_power_exp(sp.expand_log(expr))


def _merged(expr: sp.Expr) -> sp.Expr:
    """Write the exponentials of each term as one, its argument in lowest terms.

    Exponentials whose arguments differ by a constant would else pass for independent.
    """
    merged = []
    for term in sp.Add.make_args(expr):
        powers, rest = sp.sift(sp.Mul.make_args(term), lambda e: isinstance(e, sp.exp), binary=True)
        merged.append(sp.Mul(*rest, sp.exp(sp.cancel(sp.Add(*(e.exp for e in powers))))))
    return sp.expand_power_exp(sp.Add(*merged))


def _atoms_as_symbols(expr: sp.Expr) -> sp.Expr:
    """Replace functions and derivatives by plain symbols, so that cancel sees a polynomial."""
    atoms = expr.atoms(sp.Derivative) | expr.atoms(AppliedUndef)
    ordered = sorted(
        atoms, key=lambda a: (not isinstance(a, sp.Derivative), sp.default_sort_key(a))
    )
    return expr.xreplace({atom: sp.Dummy() for atom in ordered})
