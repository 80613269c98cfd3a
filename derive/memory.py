"""Memory of results while SymPy has its standard settings.

SymPy has settings for a whole thread, such as ``exp_is_pow``, under which expressions are built
otherwise.  What is computed under another setting would be wrong under the standard one, so it is
not kept; and no judgement is made then.
"""

from __future__ import annotations

import functools
import sys
from collections.abc import Callable, Hashable
from typing import ParamSpec, TypeVar

import sympy as sp
from sympy.core.function import AppliedUndef, UndefinedFunction
from sympy.core.parameters import global_parameters

P = ParamSpec("P")
R = TypeVar("R")


def is_standard() -> bool:
    """Return whether SymPy evaluates, distributes numbers over sums, and writes exp as exp."""
    kept = global_parameters.evaluate and global_parameters.distribute
    return bool(kept) and not global_parameters.exp_is_pow


def cache(function: Callable[P, R]) -> Callable[P, R]:
    """Return a function that computes each result once, under the standard settings.

    Results are kept for expressions of SymPy's own classes alone: others may equal these, and
    still have methods or signs of their own.
    """
    known: dict[Hashable, R] = {}

    @functools.wraps(function)
    def remembered(*arguments: P.args, **named: P.kwargs) -> R:
        if named or not is_standard():
            return function(*arguments, **named)
        if arguments not in known:
            result = function(*arguments, **named)
            if not all(map(_is_plain, arguments)):
                return result
            known[arguments] = result
        return known[arguments]

    return remembered


def _is_plain(argument: object) -> bool:
    """Return whether all parts of an argument are of classes that are found under their names, or
    unspecified functions without methods or signs of their own."""
    if isinstance(argument, (tuple, frozenset)):
        return all(map(_is_plain, argument))
    if not isinstance(argument, sp.Basic):
        return True
    return all(map(_is_known, {type(node) for node in sp.preorder_traversal(argument)}))


def _is_known(kind: type) -> bool:
    if isinstance(kind, UndefinedFunction):
        return is_plain(kind)
    home = sys.modules.get(kind.__module__)
    return getattr(home, kind.__qualname__, None) is kind


def is_plain(function: type) -> bool:
    """Return whether an unspecified function has no method and no sign of its own."""
    plain = vars(sp.Function(function.__name__, **function._kwargs))  # type: ignore[attr-defined]
    own = vars(function)
    signs = (name for name in own if name.startswith("is_"))
    unchanged = own.keys() <= plain.keys() and all(own[sign] == plain[sign] for sign in signs)
    return function.__bases__ == (AppliedUndef,) and unchanged
