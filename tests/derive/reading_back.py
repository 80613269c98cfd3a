"""Text that the project has written, read again as SymPy's own by its syntax tree: nothing of it is
run."""

import ast
import operator
from collections.abc import Mapping
from typing import Any

import sympy as sp

OPERATIONS = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: operator.pow,
}
CLASSES = {
    name: value
    for name, value in vars(sp).items()
    if isinstance(value, type) and issubclass(value, sp.Basic)
}


def read_back(text: str, words: Mapping[str, Any] = CLASSES) -> Any:
    """The value of an expression of numbers, strings, `words`, calls and arithmetic."""
    return _value(ast.parse(text.strip(), mode="eval").body, words)


def _value(node: ast.expr, words: Mapping[str, Any]) -> Any:
    match node:
        case ast.Constant(bool() | str() as value):
            return value
        case ast.Constant(int() as value):
            return sp.Integer(value)
        case ast.Constant(float() as value):
            return sp.Float(value)
        case ast.Name(name):
            return words[name]
        case ast.UnaryOp(ast.USub(), inner):
            return -_value(inner, words)
        case ast.BinOp(left, sign, right):
            return OPERATIONS[type(sign)](_value(left, words), _value(right, words))
        case ast.Call(function, arguments, keywords):
            named = {str(keyword.arg): _value(keyword.value, words) for keyword in keywords}
            return _value(function, words)(*(_value(each, words) for each in arguments), **named)
    raise ValueError(f"not an expression of the project's own: {ast.unparse(node)}")
