"""SymPy expressions and relations as Coq terms, structure for structure.

Overview
    Nothing is evaluated: ``tanh(-x)`` stays what it is.  A quantity that varies is a function
    on R, a claim about an instant holds for every t >= 0, a limit for t -> oo is Coquelicot's.
Key results
    term          an expression as a term of type R
    proposition   a relation between expressions as a Prop
    always        the same, for every t >= 0 where it speaks of t
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import sympy as sp
from sympy.core.function import AppliedUndef

from ..symbols import QUANTITIES, symbol, t

tau = symbol("tau")

_TAKEN = frozenset("RCISONEtl") | {"fun", "forall", "exists", "let", "in", "if", "then", "else"}
_FUNCTIONS = {
    sp.tanh: "tanh", sp.exp: "exp", sp.log: "ln", sp.Abs: "Rabs", sp.cos: "cos", sp.sin: "sin",
    sp.Min: "Rmin", sp.Max: "Rmax",
}  # fmt: skip
_RELATIONS = {
    sp.Equality: "{} = {}", sp.Unequality: "{} <> {}", sp.LessThan: "{} <= {}",
    sp.StrictLessThan: "{} < {}", sp.GreaterThan: "{1} <= {0}", sp.StrictGreaterThan: "{1} < {0}",
}  # fmt: skip


class UntranslatableError(ValueError):
    """The library has no counterpart of an expression; the message names it."""


def name(text: str) -> str:
    """Return a name that Coq accepts and that hides nothing of its library.

    >>> name("u_c"), name("R"), name("lambda")
    ('u_c', 'R_', 'lambda')
    """
    plain = "".join(c if c.isalnum() or c == "_" else "_" for c in text).strip("_") or "dummy"
    return f"{plain}_" if plain in _TAKEN else plain


def field(expr: AppliedUndef) -> str:
    """Return the name of a function; what the vocabulary has not, may be a symbol's name too."""
    text = expr.func.__name__
    return name(text) if text in QUANTITIES or text == "phi" else f"{name(text)}_of"


def binder(variable: sp.Symbol) -> str:
    """Return the name of a bound variable."""
    return "t" if variable == t else name(str(variable))


def term(expr: sp.Expr) -> str:
    """Return an expression as a Coq term.

    >>> term(2 - sp.tanh(sp.Symbol("x")) / sp.Symbol("y", positive=True))
    '2 - tanh x / y'
    """
    for kind, write in _WRITERS.items():
        if isinstance(expr, kind):
            return write(expr)
    raise UntranslatableError(f"Coq's library has no {type(expr).__name__}")


def _inner(expr: sp.Expr) -> str:
    """Return a term that may stand as an argument."""
    text = term(expr)
    return text if text.replace("_", "").isalnum() or (expr.is_Number and expr < 0) else f"({text})"


def _number(value: sp.Rational) -> str:
    if value < 0:
        return f"(- {_number(-value)})"
    return str(value) if value.q == 1 else f"{value.p} / {value.q}"


def _sum(expr: sp.Add) -> str:
    text = ""
    for part in expr.as_ordered_terms():
        negative = part.could_extract_minus_sign() and not isinstance(part, sp.Add)
        size = _factor(-part if negative else part)
        text += f" - {size}" if negative and text else f"- {size}" if negative else f" + {size}"
    return text.removeprefix(" + ")


def _product(expr: sp.Mul) -> str:
    """Return numerator over denominator; a sign stands in front."""
    coefficient, factors = expr.as_coeff_Mul()
    above: list[sp.Expr] = []
    below: list[sp.Expr] = []
    for factor in factors.as_ordered_factors() if factors != 1 else ():
        power = factor.as_base_exp()[1] if isinstance(factor, sp.Pow) else sp.S.One
        (below if power.is_Rational and power < 0 else above).append(factor)
    numerator = [_factor(f) for f in above]
    denominator = [_divisor(1 / f) for f in below]
    if abs(coefficient.p) != 1 or not numerator:
        numerator.insert(0, str(abs(coefficient.p)))
    if coefficient.q != 1:
        denominator.insert(0, str(coefficient.q))
    text = " * ".join(numerator)
    if denominator:
        joined = " * ".join(denominator)
        text += f" / ({joined})" if len(denominator) > 1 else f" / {joined}"
    return f"- ({text})" if coefficient < 0 else text


def _factor(expr: sp.Expr) -> str:
    """Return a term that may stand in a sum, or over a denominator."""
    text = term(expr)
    bare = not isinstance(expr, (sp.Add, sp.Piecewise)) and not text.startswith(("-", "/"))
    return text if bare else f"({text})"


def _divisor(expr: sp.Expr) -> str:
    """Return a term that may stand under a fraction."""
    return f"({term(expr)})" if isinstance(expr, (sp.Add, sp.Mul, sp.Rational)) else _factor(expr)


def _power(expr: sp.Pow) -> str:
    base, exponent = expr.args
    if exponent.is_Integer and exponent > 0:
        return f"{_inner(base)} ^ {exponent}"
    if exponent.is_Integer:
        return f"/ {_inner(base)}" if exponent == -1 else f"/ ({_inner(base)} ^ {-exponent})"
    if exponent == sp.Rational(1, 2):
        return f"sqrt {_inner(base)}"
    if exponent.is_Rational and exponent.q == 2:
        root, size = f"sqrt {_inner(base)}", abs(exponent.p)
        power = root if size == 1 else f"({root}) ^ {size}"
        return power if exponent > 0 else f"/ ({power})"
    return f"Rpower {_inner(base)} {_inner(exponent)}"


def _call(expr: sp.Function) -> str:
    if tau in expr.args:
        raise UntranslatableError("a claim in scaled time")
    head = _FUNCTIONS.get(expr.func)
    if head is None and isinstance(expr, AppliedUndef):
        head = field(expr)
    if head is None:
        raise UntranslatableError(f"Coq's library has no {expr.func.__name__}")
    text = _inner(expr.args[-1])
    for argument in reversed(expr.args[:-1]):
        text = (
            f"{_inner(argument)} {text if text.startswith('(') or ' ' not in text else f'({text})'}"
        )
    return f"{head} {text}"


def _derivative(expr: sp.Derivative) -> str:
    inner, (variable, count) = expr.args
    if count != 1:
        raise UntranslatableError("a derivative of higher order")
    bare = isinstance(inner, AppliedUndef) and inner.args == (variable,)
    function = term(inner).split(" ")[0] if bare else f"(fun {binder(variable)} => {term(inner)})"
    return f"Derive {function} {binder(variable)}"


def _at(expr: sp.Subs) -> str:
    """Return a derivative at a point: phi' there."""
    inner, variables, points = expr.args
    if not isinstance(inner, sp.Derivative) or inner.args[0].args != tuple(variables):
        raise UntranslatableError("a substitution")
    head = term(inner.args[0]).split(" ")[0]
    return f"Derive {head} {_inner(points[0])}"


def _piecewise(expr: sp.Piecewise) -> str:
    (first, condition), (second, otherwise) = expr.args
    if otherwise != sp.true or not isinstance(condition, sp.LessThan):
        raise UntranslatableError("a function of several pieces")
    less = f"Rle_dec {_inner(condition.lhs)} {_inner(condition.rhs)}"
    return f"(if {less} then {term(first)} else {term(second)})"


def _integral(expr: sp.Integral) -> str:
    inner, (variable, low, high) = expr.args
    return f"RInt (fun {binder(variable)} => {term(inner)}) {_inner(low)} {_inner(high)}"


_WRITERS: dict[type, Callable[[sp.Expr], str]] = {
    sp.Rational: _number,
    sp.Symbol: lambda e: "t" if e == t else name(str(e)),
    sp.Add: _sum,
    sp.Mul: _product,
    sp.Pow: _power,
    sp.Derivative: _derivative,
    sp.Subs: _at,
    sp.Piecewise: _piecewise,
    sp.Integral: _integral,
    sp.Function: _call,
    type(sp.pi): lambda _: "PI",
    type(sp.E): lambda _: "exp 1",
}  # Piecewise, Subs and Integral come before the heads that contain them


def proposition(relation: sp.Basic) -> str:
    """Return a relation as a proposition about the instant t.

    A quantity that is given as a limit is one: the equation says that the limit exists.
    """
    if relation is sp.true:
        return "True"
    if isinstance(relation, sp.And):
        return " /\\ ".join(f"({proposition(part)})" for part in relation.args)
    if isinstance(relation, sp.Equivalent):
        return " <-> ".join(f"({proposition(part)})" for part in relation.args)
    if isinstance(relation, sp.Equality):
        return _equation(*relation.args)
    return _RELATIONS[relation.func].format(*map(term, relation.args))


def _equation(left: sp.Expr, right: sp.Expr) -> str:
    if isinstance(left, sp.Limit) and isinstance(right, sp.Limit):
        return f"exists l, {limit(left, 'l')} /\\ {limit(right, 'l')}"
    for one, other in ((left, right), (right, left)):
        if isinstance(one, sp.Limit):
            return limit(one, _inner(other) if other != sp.oo else None)
    product = left.as_independent(sp.Limit) if left.has(sp.Limit) else None
    if product is not None and isinstance(product[1], sp.Limit) and right == 0:
        return f"exists l, {limit(product[1], 'l')} /\\ {_factor(product[0])} * l = 0"
    return f"{term(left)} = {term(right)}"


def limit(expr: sp.Limit, value: str | None) -> str:
    """Return that a limit exists and is what the term ``value`` says; None: it is infinite."""
    inner, variable, point, _ = expr.args
    if point != sp.oo:
        raise UntranslatableError(f"a limit at {point}")
    function = f"(fun {binder(variable)} => {term(inner)})"
    return f"diverges {function}" if value is None else f"tends {function} {value}"


@cache
def always(relation: sp.Basic) -> str:
    """Return a relation for every t >= 0; one that does not speak of t as it is."""
    if t not in relation.free_symbols or _bound(relation):
        return proposition(relation)
    return f"forall t, 0 <= t -> {proposition(relation)}"


def _bound(relation: sp.Basic) -> bool:
    """Return whether t occurs under a limit only."""
    return t not in relation.replace(sp.Limit, lambda *_: sp.Integer(0)).free_symbols
