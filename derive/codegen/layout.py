"""What the sources in every language share: a function as lines of text, and their headers.

Key results
    body             the lines and results of a function in a target's language
    header_lines     what the opening comment of a source says
    local_names      the names that a function defines itself
    remarked         a line of code with a comment beside or above it
"""

from __future__ import annotations

import textwrap
from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

from ..program import Program
from ..program.function import Function
from .emit import Target, emit
from .wording import remark_on, title_of

WIDTH = 96
WIDEST = 100

RIGHT_HAND_SIDE = "du_c/dt in mm/s with all that this variant has: what an integrator needs"
PRESSURE = "contact pressure in MPa: the only root of the residual, by Newton's iteration"
FACTS_OF_NEWTON = (
    "Between the bounds every step but the first goes towards the root and never beyond.",
    "The square of a step, in roughnesses, tells the next one: the iteration ends at roundoff.",
)


class Line(NamedTuple):
    """``name = text``, and what it means."""

    name: str
    text: str
    remark: str


class Body(NamedTuple):
    """A function's assignments and the texts of its results."""

    lines: tuple[Line, ...]
    results: tuple[str, ...]


def local_names(function: Function) -> frozenset[str]:
    """Return the names of a function's arguments and intermediates."""
    return frozenset(
        [argument.name for argument in function.arguments]
        + [name.name for name, _ in function.assignments]
    )


def remarked(code: str, remark: str, opening: str, closing: str = "") -> list[str]:
    """Put a comment beside a line of code, or above it where it finds no room.

    >>> remarked("    h = 1;", "closure", "//")
    ['    h = 1; // closure']
    """
    comment = f"{opening} {remark}{closing}"
    if len(code) + 1 + len(comment) <= WIDEST:
        return [f"{code} {comment}"]
    indent = " " * (len(code) - len(code.lstrip()))
    return [indent + comment, code]


def unused_arguments(function: Function) -> tuple[str, ...]:
    """Return the arguments that the function does not look at."""
    expressions = [value for _, value in function.assignments] + list(function.results)
    used = set().union(*(expression.free_symbols for expression in expressions))
    return tuple(a.name for a in function.arguments if a not in used)


def body(function: Function, made: Program, target: Target, reach: Callable[[str], str]) -> Body:
    """Write a function's expressions; ``reach`` says how a constant of the run is reached."""
    constants = {name.name for name, _ in made.constants} - local_names(function)
    within = replace(
        target, rename=lambda name: reach(name) if name in constants else target.rename(name)
    )
    lines = tuple(
        Line(target.rename(name.name), emit(value, within), remark_on(name.name))
        for name, value in function.assignments
    )
    return Body(lines, tuple(emit(result, within) for result in function.results))


def computed(made: Program, target: Target, reach: Callable[[str], str]) -> tuple[Line, ...]:
    """Write the constants that are computed; ``reach`` says how a parameter is reached."""
    parameters = {parameter.name for parameter in made.parameters}
    within = replace(
        target, rename=lambda name: reach(name) if name in parameters else target.rename(name)
    )
    return tuple(
        Line(target.rename(name.name), emit(value, within), "")
        for name, value in made.constants
        if name != value
    )


def header_lines(made: Program, language: str) -> tuple[str, ...]:
    """Return the lines that open a source: what it is, whence, its units and its cost."""
    variant = made.variant
    equations = ", ".join(f"({identifier})" for identifier in variant.equations)
    origin = (
        f"Written by derive code from equations {equations}; contact law: {variant.law.source}."
    )
    cost = ", ".join(f"{function.name} {function.operations}" for function in made.functions)
    paragraphs = (
        title_of(variant),
        origin,
        f"Free-standing {language}. Units: mm, s, MPa; the speed n in revolutions per minute.",
        "u is the wear depth u_c of the bearing, U_a the prescribed displacement of the pin.",
        f"Arithmetic operations of one call: {cost}.",
        *_remarks(made),
    )
    return tuple(line for text in paragraphs for line in (*textwrap.wrap(text, WIDTH), ""))[:-1]


def _remarks(made: Program) -> tuple[str, ...]:
    if not made.variant.cutoff:
        return ()
    if made.variant.compliant:
        return ("Contact ends at h = 3 sigma: the pressure is the smaller of root and limit.",)
    return (
        "Contact ends at h = 3 sigma. The rate, its slope and the pressure among the fields are "
        "those in contact; there is contact where the margin is not negative.",
    )
