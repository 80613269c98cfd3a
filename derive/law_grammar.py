"""The grammar of a contact law given as text: read by Python's parser, never executed.

Numbers, r, + - * / ^ and exp, tanh, sqrt.  Scenes are read with it, so it imports no SymPy.
"""

from __future__ import annotations

import ast
from fractions import Fraction

from .faults import UsageError

LONGEST = 500  # characters
LARGEST = 10**6  # numbers in the text
HIGHEST = 20  # powers
FUNCTIONS = ("exp", "tanh", "sqrt")
GRAMMAR = "use numbers, r, + - * / ^, parentheses, exp, tanh and sqrt"


def normal(text: str) -> str:
    """Return the text of a law in one spelling.

    >>> normal("(1 - (r-2)/sqrt(1 + (r - 2)^2)) / 2")
    '(1 - (r - 2) / sqrt(1 + (r - 2) ** 2)) / 2'

    Raises
    ------
    UsageError
        naming the part outside the grammar.
    """
    if len(text) > LONGEST:
        raise UsageError(f"phi has {len(text)} characters; give at most {LONGEST}")
    try:
        tree = ast.parse(text.strip().replace("^", "**"), mode="eval").body
        _check(tree)
        return ast.unparse(tree)
    except UsageError:
        raise
    except (SyntaxError, ValueError, MemoryError, RecursionError):  # ValueError: a null character
        raise UsageError(f"phi is no formula; {GRAMMAR}") from None


def _check(node: ast.AST) -> None:
    match node:
        case ast.Constant(value=int() | float() as number) if not isinstance(number, bool):
            if not abs(number) <= LARGEST:
                raise UsageError(f"phi: {ast.unparse(node)[:40]} is too large")
        case ast.Name(id="r"):
            pass
        case ast.BinOp(left=left, op=ast.Pow(), right=right):
            _check(left)
            if abs(_half_integer(right)) > HIGHEST:
                raise UsageError(f"phi: the power {ast.unparse(right)[:40]} is beyond {HIGHEST}")
        case ast.BinOp(left=left, op=ast.Add() | ast.Sub() | ast.Mult() | ast.Div(), right=right):
            _check(left)
            _check(right)
        case ast.UnaryOp(op=ast.USub() | ast.UAdd(), operand=operand):
            _check(operand)
        case ast.Call(func=ast.Name(id=name), args=[argument], keywords=[]) if name in FUNCTIONS:
            _check(argument)
        case _:
            raise UsageError(f"phi: {ast.unparse(node)[:40]!r} is not understood; {GRAMMAR}")


def _half_integer(node: ast.expr) -> Fraction:
    """Return an exponent: a multiple of one half."""
    match node:
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return -_half_integer(operand)
        case ast.BinOp(
            left=ast.Constant(value=int(above)), op=ast.Div(), right=ast.Constant(value=2)
        ) if type(above) is not bool:
            return Fraction(above, 2)
        case ast.Constant(value=int() | float() as number) if type(number) is not bool:
            if 2 * number % 1 == 0:
                return Fraction(number)
    raise UsageError(f"phi: {ast.unparse(node)[:40]!r} is no power: give a number such as 2 or 3/2")
