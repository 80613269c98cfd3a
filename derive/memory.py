"""Memory of results while SymPy has its standard settings.

SymPy has settings for a whole thread, such as ``exp_is_pow``, under which expressions are built
otherwise.  What is computed under another setting would be wrong under the standard one, so it is
not kept; and no judgement is made then.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import ParamSpec, TypeVar

from sympy.core.parameters import global_parameters

P = ParamSpec("P")
R = TypeVar("R")


def is_standard() -> bool:
    """Return whether SymPy evaluates, distributes numbers over sums, and writes exp as exp."""
    kept = global_parameters.evaluate and global_parameters.distribute
    return bool(kept) and not global_parameters.exp_is_pow


def cache(function: Callable[P, R]) -> Callable[P, R]:
    """Return a function that computes each result once, under the standard settings."""
    known = functools.cache(function)

    @functools.wraps(function)
    def remembered(*arguments: P.args, **named: P.kwargs) -> R:
        compute = known if is_standard() else function
        return compute(*arguments, **named)  # type: ignore[arg-type]

    return remembered
