"""SymPy expressions and relations as Coq terms, structure for structure.

Overview
    Nothing is evaluated: ``tanh(-x)`` stays unchanged.  A quantity that varies is a function
    on R, a claim about an instant holds for every t >= 0, a limit for t -> oo is Coquelicot's.
Key results
    term          an expression as a term of type R
    proposition   a relation between expressions as a Prop
    always        the same for every t >= 0, if it contains t
"""

from __future__ import annotations

from functools import cache

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.printing.str import StrPrinter

from ..claims import Continuous, landau_o
from ..symbols import CLOCKS, QUANTITIES, t

_FUNCTIONS = {
    sp.tanh: "tanh", sp.exp: "exp", sp.log: "ln", sp.Abs: "Rabs", sp.cos: "cos", sp.sin: "sin",
}  # fmt: skip
_WORDS = (
    "phi PI Rpower sqrt Rle_dec tends diverges continuous continuous_in_time ex_derive Derive RInt "
    "fun forall exists let in if then else"
)
_TAKEN = frozenset((*"RCISONEtl", *_FUNCTIONS.values(), *_WORDS.split()))
_RELATIONS = {
    sp.Equality: "{} = {}", sp.Unequality: "{} <> {}", sp.LessThan: "{} <= {}",
    sp.StrictLessThan: "{} < {}", sp.GreaterThan: "{1} <= {0}", sp.StrictGreaterThan: "{1} < {0}",
}  # fmt: skip
_ALWAYS = "forall t, 0 <= t -> "
_CONNECTIVES = {sp.And: " /\\ ", sp.Equivalent: " <-> "}


class UntranslatableError(ValueError):
    """The library has no counterpart of an expression; the message names it."""


def name(text: str) -> str:
    """Return a name that Coq accepts and that shadows nothing in its library.

    >>> name("u_c"), name("R"), name("lambda")
    ('u_c', 'R_', 'lambda')
    """
    plain = "".join(c if c.isalnum() or c == "_" else "_" for c in text).strip("_") or "dummy"
    return f"{plain}_" if plain in _TAKEN else plain


def quantity(atom: sp.Expr) -> str:
    """Return the name of a symbol or of a function.

    A function outside the vocabulary may share a symbol's name.
    """
    text = atom.func.__name__ if atom.args else str(atom)
    if atom == t or (atom.args and text == "phi"):
        return text
    return name(text) if not atom.args or text in QUANTITIES else f"{name(text)}_of"


def term(expr: sp.Expr) -> str:
    """Return an expression as a Coq term.

    >>> term(2 - sp.tanh(sp.Symbol("x")) / sp.Symbol("y", positive=True))
    '2 - (tanh x/y)'
    """
    return _CoqPrinter().doprint(expr)


def _inner(expr: sp.Expr) -> str:
    """Return a term in brackets unless it is a name, for use as an argument."""
    text = term(expr)
    return text if text.replace("_", "").isalnum() else f"({text})"


class _CoqPrinter(StrPrinter):
    """SymPy's text printer with Coq's forms of functions, powers and bound variables."""

    def _print(self, expr: sp.Expr, **_: object) -> str:
        if not isinstance(expr, _HEADS):
            raise UntranslatableError(f"Coq's library has no {type(expr).__name__}")
        return str(super()._print(expr))

    def _print_Symbol(self, expr: sp.Symbol) -> str:
        if expr != t and expr.name in CLOCKS and not isinstance(expr, sp.Dummy):
            raise UntranslatableError(f"a claim in {expr}, which varies in time")
        return quantity(expr)

    _print_Dummy = _print_Symbol

    def _print_Pi(self, _: sp.Expr) -> str:
        return "PI"

    def _print_Mul(self, expr: sp.Mul) -> str:
        negative = expr.as_coeff_Mul()[0] < 0
        return f"-({self._print(-expr)})" if negative else str(super()._print_Mul(expr))

    def _print_Pow(self, expr: sp.Pow, rational: bool = False) -> str:
        base, exponent = expr.args
        if not (2 * exponent).is_Integer:  # Rpower is 1 at 0
            raise UntranslatableError(f"a power with the exponent {exponent}")
        if exponent < 0:
            return f"(/ {_inner(1 / expr)})"
        if exponent.is_Integer:
            return f"{_inner(base)}^{exponent}"
        root = f"sqrt {_inner(base)}"
        return root if 2 * exponent == 1 else f"({root})^{2 * exponent}"

    def _print_Function(self, expr: sp.Function) -> str:
        if expr.func == landau_o:
            raise UntranslatableError("an asymptotic relation")
        if expr.func not in _FUNCTIONS and not isinstance(expr, AppliedUndef):
            raise UntranslatableError(f"Coq's library has no {expr.func.__name__}")
        head = _FUNCTIONS.get(expr.func) or quantity(expr)
        return " ".join((head, *map(_inner, expr.args)))

    def _print_Derivative(self, expr: sp.Derivative) -> str:
        inner, (variable, count) = expr.args
        if count != 1:
            raise UntranslatableError("a derivative of higher order")
        bare = isinstance(inner, AppliedUndef) and inner.args == (variable,)
        function = quantity(inner) if bare else f"(fun {quantity(variable)} => {term(inner)})"
        return f"Derive {function} {quantity(variable)}"

    def _print_Subs(self, expr: sp.Subs) -> str:
        inner, variables, (point,) = expr.args
        if not isinstance(inner, sp.Derivative) or inner.args[0].args != tuple(variables):
            raise UntranslatableError("a substitution")
        return f"Derive {quantity(inner.args[0])} {_inner(point)}"

    def _print_Piecewise(self, expr: sp.Piecewise) -> str:
        (first, condition), (second, otherwise) = expr.args
        if otherwise != sp.true or not isinstance(condition, sp.LessThan):
            raise UntranslatableError("a function of several pieces")
        less = f"Rle_dec {_inner(condition.lhs)} {_inner(condition.rhs)}"
        return f"(if {less} then {term(first)} else {term(second)})"

    def _print_Integral(self, expr: sp.Integral) -> str:
        inner, (variable, low, high) = expr.args
        return f"RInt (fun {quantity(variable)} => {term(inner)}) {_inner(low)} {_inner(high)}"


_HEADS = (
    *(sp.Rational, sp.Symbol, sp.Add, sp.Mul, sp.Pow, sp.Function, sp.Derivative, sp.Subs),
    *(sp.Integral, type(sp.pi)),
)
"""The classes of expressions that the printer supports; a Piecewise is a Function."""


def proposition(relation: sp.Basic) -> str:
    """Return a relation as a proposition about the instant t.

    An equation between a quantity and a limit asserts that the limit exists.
    """
    if isinstance(relation, Continuous) and relation.args[0].args == (t,):
        return f"continuous_in_time {quantity(relation.args[0])}"
    if relation.func in _CONNECTIVES:
        return _CONNECTIVES[relation.func].join(f"({proposition(part)})" for part in relation.args)
    if isinstance(relation, sp.Equality):
        return _equation(*relation.args)
    if relation.func not in _RELATIONS:
        raise UntranslatableError(f"no relation states that {relation}")
    return _RELATIONS[relation.func].format(*map(term, relation.args))


def _equation(left: sp.Expr, right: sp.Expr) -> str:
    left, right = sorted((left, right), key=lambda side: not isinstance(side, sp.Limit))
    if isinstance(right, sp.Limit):
        return f"exists l, {_limit(left, 'l')} /\\ {_limit(right, 'l')}"
    if isinstance(left, sp.Limit):
        return _limit(left, _inner(right) if right != sp.oo else None)
    factor, limit = left.as_independent(sp.Limit, as_Add=False)
    if isinstance(limit, sp.Limit) and right == 0:
        return f"exists l, {_limit(limit, 'l')} /\\ {_inner(factor)} * l = 0"
    return f"{term(left)} = {term(right)}"


def _limit(expr: sp.Limit, value: str | None) -> str:
    """Return that a limit exists and equals the term ``value``; None: it is infinite."""
    inner, variable, point, _ = expr.args
    if point != sp.oo:
        raise UntranslatableError(f"a limit at {point}")
    function = f"(fun {quantity(variable)} => {term(inner)})"
    return f"diverges {function}" if value is None else f"tends {function} {value}"


@cache
def always(relation: sp.Basic) -> str:
    """Return a relation for every t >= 0; without a quantifier if t is free in limits at most."""
    outside = relation.replace(sp.Limit, lambda *_: sp.S.Zero)
    if isinstance(relation, Continuous) or t not in outside.free_symbols:
        return proposition(relation)
    return f"{_ALWAYS}{proposition(relation)}"


def timed(text: str) -> bool:
    """Return whether a proposition holds for every t >= 0."""
    return text.startswith(_ALWAYS)
