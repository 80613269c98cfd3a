"""Equations as an author writes them: text, read into expressions in which nothing is moved.

Overview
    SymPy sorts terms and moves signs.  Formulas in an author's order, and those that the note
    prints, are therefore text, ``K_c V p_max/(6 H_c) (1 + tanh(4 - 2/f_c))``: a blank between
    factors multiplies, ``^`` is a power, ``du_c/dt`` a rate, ``u_c(t + T)`` a field at another
    time, ``phi'(r)`` the slope of a law, ``lim(x)`` a limit for t -> oo, and ``a < b < c`` two
    relations.  Python's own parser reads it; nothing is executed.
Key results
    read       a relation or an expression
    evaluated  the same, evaluated: terms sorted, signs moved
"""

from __future__ import annotations

import ast
import itertools
import operator
import re
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

import sympy as sp
from sympy.core.function import UndefinedFunction
from sympy.core.relational import Relational

from .claims import landau_o
from .laws import r
from .memory import cache
from .rules.limits import forever, later
from .symbols import QUANTITIES, symbol, t

Names = Mapping[str, Any]
"""The meaning of names outside the vocabulary: symbols, or functions of scaled time."""

_IN_PYTHON = (
    (r"(?<=[\w)]) (?=[\w(])", "*"),
    (r"\^", "**"),
    (" = ", " == "),
    (r"\bd(\w+)/d(t|tau)\b", r"rate(\1, \2)"),
    (r"(\w+)'\(", r"slope(\1, "),
    (r"\blambda\b", "lambda_"),
)

_OPERATIONS: Mapping[type, Any] = {
    ast.Mult: operator.mul, ast.Pow: operator.pow, ast.USub: operator.neg, ast.UAdd: operator.pos,
    ast.Eq: sp.Eq, ast.Lt: sp.Lt, ast.LtE: sp.Le, ast.Gt: sp.Gt, ast.GtE: sp.Ge,
}  # fmt: skip

_FUNCTIONS: Mapping[str, Any] = {
    "abs": sp.Abs, "cos": sp.cos, "exp": sp.exp, "ln": sp.log, "sin": sp.sin, "sqrt": sp.sqrt,
    "tanh": sp.tanh, "Ei": sp.Ei, "I_0": lambda x: sp.besseli(0, x), "W": sp.LambertW,
    "o": landau_o, "lim": forever, "later": later, "rate": sp.Derivative,
}  # fmt: skip


def read(text: str, names: Names = MappingProxyType({})) -> sp.Basic:
    """Return the relation or expression of a text.

    A name that is neither in ``names`` nor in the vocabulary is a real number.

    >>> read("h = h_0 + u_c(t + T) - 2 U_a/f_c")
    Eq(h(t), h_0 + u_c(T + t) - 2*U_a(t)/f_c)
    """
    for mark, python in _IN_PYTHON:
        text = re.sub(mark, python, text)
    reader = _Reader(names)
    with sp.evaluate(False):
        sides = [
            reader.visit(ast.parse(side.strip(), mode="eval").body) for side in text.split("<=>")
        ]
        return sides[0] if len(sides) == 1 else sp.Equivalent(*sides)


@cache
def evaluated(expr: sp.Basic) -> sp.Basic:
    """Return the evaluated form of an expression that was built unevaluated."""
    if not expr.args or isinstance(expr, sp.Derivative):
        return expr
    arguments = map(evaluated, expr.args)
    if isinstance(expr, Relational):  # stays one, without an attempt to decide it
        return expr.func(*arguments, evaluate=False)
    return expr.func(*arguments)


class _Reader(ast.NodeVisitor):
    """Translates Python's syntax tree of a formula; refuses nodes outside the grammar."""

    def __init__(self, names: Names) -> None:
        self._names = {"t": t, "pi": sp.pi, "oo": sp.oo, **names}

    def generic_visit(self, node: ast.AST) -> sp.Basic:
        raise ValueError(f"{ast.unparse(node)} is not understood")

    def visit_Constant(self, node: ast.Constant) -> sp.Basic:
        if not isinstance(node.value, int | float):
            return self.generic_visit(node)
        return sp.Rational(ast.unparse(node))

    def visit_Name(self, node: ast.Name) -> sp.Basic:
        name = node.id.rstrip("_")
        if name not in self._names:
            return symbol(name) if name in QUANTITIES else sp.Symbol(name, real=True)
        bearer = self._names[name]
        return bearer(symbol("tau")) if isinstance(bearer, UndefinedFunction) else bearer

    def visit_UnaryOp(self, node: ast.UnaryOp) -> sp.Basic:
        return _OPERATIONS[type(node.op)](self.visit(node.operand))

    def visit_BinOp(self, node: ast.BinOp) -> sp.Basic:
        if isinstance(node.op, (ast.Add, ast.Sub)):
            return sp.Add(*self._terms(node))
        left, right = self.visit(node.left), self.visit(node.right)
        if isinstance(node.op, ast.Div):
            return sp.Mul(left, sp.Pow(right, -1))
        return _OPERATIONS[type(node.op)](left, right)

    def _terms(self, node: ast.expr) -> tuple[sp.Expr, ...]:
        """Return the terms of a sum, in order."""
        if not (isinstance(node, ast.BinOp) and isinstance(node.op, (ast.Add, ast.Sub))):
            return (self.visit(node),)
        last = self.visit(node.right)
        return *self._terms(node.left), last if isinstance(node.op, ast.Add) else -last

    def visit_Compare(self, node: ast.Compare) -> sp.Basic:
        sides = [self.visit(side) for side in (node.left, *node.comparators)]
        relations = [
            _OPERATIONS[type(op)](*pair)
            for op, pair in zip(node.ops, itertools.pairwise(sides), strict=True)
        ]
        return relations[0] if len(relations) == 1 else sp.And(*relations)

    def visit_Call(self, node: ast.Call) -> sp.Basic:
        name = ast.unparse(node.func)
        if name == "slope":
            law, point = self._function(ast.unparse(node.args[0])), self.visit(node.args[1])
            return sp.Subs(sp.Derivative(law(r), r), r, point)
        arguments = [self.visit(argument) for argument in node.args]
        if name == "integral":
            with sp.evaluate(True):  # unevaluated, SymPy would put a factor 1 into the integrand
                return sp.Integral(arguments[0], tuple(arguments[1:]))
        return (_FUNCTIONS.get(name) or self._function(name))(*arguments)

    def _function(self, name: str) -> Any:
        if name in QUANTITIES:
            return symbol(name).func
        return self._names.get(name) or sp.Function(name)
