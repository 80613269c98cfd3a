"""Emitting: expressions as source text, one printer for every language.

Overview
    A target is a table of the forms of functions, powers, numbers and names in a language.
    Anything outside the table is an error, never a guess.  Sums begin with their positive terms,
    products divide once.  Half-integer powers are products with a square root.  The table and
    the template of the same name in ``templates`` define a language.
Key results
    Target    the table of one language
    TARGETS   the tables
    emit      an expression in a target's language
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

import sympy as sp
from sympy.core.relational import Relational

_IDENTIFIER = re.compile(r"[A-Za-z][A-Za-z0-9_]*\Z")
_ADD, _MUL, _POW, _ATOM = range(4)


class EmitError(ValueError):
    """A part of an expression has no form in the target's language."""


@dataclass(frozen=True)
class Target:
    """The forms of expressions in a language.

    ``functions`` maps SymPy functions onto names; ``power`` writes base and integer exponent;
    ``number`` writes a floating-point literal from a decimal string; ``rename`` gives the text of
    a symbol.  ``constant`` and ``parameter`` are formats: of a constant of the run within a
    function, and of a parameter within ``bind``.  ``both`` joins two relations, and ``sign`` writes
    that of a relation, given in Python.
    """

    name: str
    language: str
    functions: Mapping[type[sp.Basic], str]
    power: Callable[[str, int], str]
    number: Callable[[str], str]
    pi: str
    rename: Callable[[str], str] = str
    constant: str = "c.{}"
    parameter: str = "{}"
    both: str = "&&"
    sign: Callable[[str], str] = str


def emit(expr: sp.Basic, target: Target) -> str:
    """Write an expression or a relation in a language; EmitError if its table lacks a form."""
    text, _ = _emit(expr, target)
    return text


def _emit(expr: sp.Basic, target: Target) -> tuple[str, int]:
    if isinstance(expr, sp.Symbol):
        if not _IDENTIFIER.match(expr.name):
            raise EmitError(f"{expr.name!r} is no identifier")
        return target.rename(expr.name), _ATOM
    if expr.is_Integer:
        return target.number(str(expr)), _ATOM if expr >= 0 else _ADD
    if expr.is_Rational:
        return f"{target.number(str(expr.p))} / {target.number(str(expr.q))}", _MUL
    if expr.is_Float:
        return target.number(repr(float(expr))), _ATOM if expr >= 0 else _ADD
    if expr is sp.pi:
        return target.pi, _ATOM
    if expr.is_Add:
        return _fraction(expr, target) or (_sum(expr, target), _ADD)
    if expr.is_Mul:
        return _product(expr, target)
    if expr.is_Pow:
        return _power(expr, target)
    if isinstance(expr, sp.And):
        return f" {target.both} ".join(emit(part, target) for part in expr.args), _ADD
    if isinstance(expr, Relational):
        sides = emit(expr.lhs, target), emit(expr.rhs, target)
        return f" {target.sign(expr.rel_op)} ".join(sides), _ADD
    if type(expr) in target.functions:
        inner = [emit(argument, target) for argument in _ordered(expr)]
        return f"{target.functions[type(expr)]}({', '.join(inner)})", _ATOM
    raise EmitError(f"{target.name} has no form for {type(expr).__name__} in {expr}")


def _ordered(expr: sp.Expr) -> tuple[sp.Basic, ...]:
    """Return the arguments of a function; a minimum or maximum has its numbers last."""
    if not isinstance(expr, (sp.Min, sp.Max)):
        return tuple(expr.args)
    if len(expr.args) != 2:
        raise EmitError(f"{expr} has more than two arguments")
    return tuple(sorted(expr.args, key=lambda a: (a.is_number, sp.default_sort_key(a))))


def _fraction(expr: sp.Add, target: Target) -> tuple[str, int] | None:
    """Return ``x + 9/2`` as ``(2 * x + 9) / 2``, None for a sum without such a number.

    In Python 9 / 2 is a float, which would limit a number of 60 digits to 16; in this form the
    quotient has the caller's type of number.
    """
    below = next((a.q for a in expr.args if a.is_Rational and not a.is_Integer), 1)
    if below == 1:
        return None
    above = sp.Add(*(below * argument for argument in expr.args))
    return f"({emit(above, target)}) / {target.number(str(below))}", _MUL


def _sum(expr: sp.Add, target: Target) -> str:
    """Write positive terms before negative ones, single symbols before products."""
    terms = sorted(expr.args, key=lambda e: (e.could_extract_minus_sign(), len(e.args), str(e)))
    text = emit(terms[0], target)
    for term in terms[1:]:
        negative = term.could_extract_minus_sign()
        body = _wrapped(-term if negative else term, target, _MUL)
        text += f" - {body}" if negative else f" + {body}"
    return text


def _product(expr: sp.Mul, target: Target) -> tuple[str, int]:
    if expr.could_extract_minus_sign():
        return f"-{_wrapped(-expr, target, _MUL)}", _ADD
    numerator, denominator = sp.fraction(expr)
    factors = [factor for factor in sp.Mul.make_args(numerator) if factor != 1]
    factors.sort(key=lambda factor: _distance(factor, target))
    text = " * ".join(_wrapped(factor, target, _MUL) for factor in factors) or target.number("1")
    if denominator != 1:
        text += f" / {_wrapped(denominator, target, _POW)}"
    return text, _MUL


def _distance(factor: sp.Expr, target: Target) -> int:
    """Return the rank of a factor: numbers, then constants (with a prefix), then the state."""
    if factor.is_number:
        return 0
    return 1 if any(target.rename(s.name) != s.name for s in factor.free_symbols) else 2


def _power(expr: sp.Pow, target: Target) -> tuple[str, int]:
    base, exponent = expr.args
    if exponent == sp.Rational(1, 2):
        return f"{target.functions[sp.sqrt]}({emit(base, target)})", _ATOM
    if exponent.is_Integer and exponent > 0:
        # a language may write a power as a product, so it has the precedence of one
        return target.power(_wrapped(base, target, _ATOM), int(exponent)), _MUL
    if exponent.is_Rational and exponent.q == 2 and exponent > 0:
        rest = sp.Pow(base, exponent - sp.Rational(1, 2))
        return f"{_wrapped(rest, target, _MUL)} * {emit(sp.sqrt(base), target)}", _MUL
    if exponent.is_Rational and exponent < 0:
        return f"{target.number('1')} / {_wrapped(1 / expr, target, _POW)}", _MUL
    raise EmitError(f"{target.name} has no form for the power {expr}")


def _wrapped(expr: sp.Expr, target: Target, least: int) -> str:
    text, precedence = _emit(expr, target)
    return text if precedence >= least else f"({text})"


_FUNCTIONS = (sp.exp, sp.log, sp.sqrt, sp.Abs, sp.Min, sp.Max)


def _named(names: str) -> Mapping[type[sp.Basic], str]:
    return MappingProxyType(dict(zip(_FUNCTIONS, names.split(), strict=True)))


def _square(base: str, exponent: int) -> str:
    return f"{base} * {base}" if exponent == 2 else f"{base}**{exponent}"


def _product_of_equals(base: str, exponent: int) -> str:
    return " * ".join([base] * exponent)


def _floating(decimal: str) -> str:
    """Write every number as a double: a quotient of integers would be truncated."""
    return decimal if any(mark in decimal for mark in ".e") else f"{decimal}.0"


_IN_WORDS = {"U_a": "pin_displacement", "U_c": "bearing_displacement"}
"""Names for Fortran, which does not distinguish U_a from u_a."""

NUMPY = Target(
    name="numpy",
    language="NumPy",
    functions=_named("np.exp np.log np.sqrt np.abs np.minimum np.maximum"),
    power=_square,
    number=str,
    pi="np.pi",
    parameter="data.{}",
    both="and",
)
C = Target(
    name="c",
    language="C99",
    functions=_named("exp log sqrt fabs wear_smaller wear_larger"),
    power=_product_of_equals,
    number=_floating,
    pi="3.141592653589793",
    constant="c->{}",
    parameter="data->{}",
)
FORTRAN = Target(
    name="fortran",
    language="Fortran 2008",
    functions=_named("exp log sqrt abs smaller larger"),
    power=lambda base, exponent: f"{base}**{exponent}",
    number=lambda decimal: f"{_floating(decimal)}_dp",
    pi="3.141592653589793_dp",
    rename=lambda name: _IN_WORDS.get(name, name),
    constant="c%{}",
    both=".and.",
    sign=lambda sign: sign.replace("!", "/"),
)
JAVASCRIPT = Target(
    name="javascript",
    language="ECMAScript module",
    functions=_named("Math.exp Math.log Math.sqrt Math.abs Math.min Math.max"),
    power=_product_of_equals,
    number=str,
    pi="Math.PI",
    sign=lambda sign: sign + "=" * (sign in ("==", "!=")),
)

TARGETS = MappingProxyType({t.name: t for t in (NUMPY, C, FORTRAN, JAVASCRIPT)})
"""The languages by name."""
