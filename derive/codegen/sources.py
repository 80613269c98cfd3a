"""Sources: a program as text in a language, by the template of that name.

Key results
    source        the source of a program in one of the languages
    definitions   the JavaScript functions of a program, for use inside another script
"""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from dataclasses import replace
from functools import cache, partial
from typing import TYPE_CHECKING, Any

import sympy as sp

from ..program import Program
from ..program.function import Function
from ..program.gradient import by_constant
from ..templates import templates
from .emit import NUMPY, TARGETS, C, Target, emit
from .increment import contact, increment
from .wording import meaning_of, remark_on, sentence, title_of

if TYPE_CHECKING:
    from jinja2 import Environment

HEADER = "header"
"""The target of the C source's declarations, with the table of C."""
LINE_WIDTH = 100


def source(program: Program, target: str) -> str:
    """Return the free-standing source of a program, formatted and deterministic.

    Raises
    ------
    ValueError
        if there is no such target.

    >>> from derive.program import program
    >>> from derive.variant import VARIANTS
    >>> source(program(VARIANTS[0]), "c").splitlines()[1]
    ' * Tanh contact law, rigid support, smooth pin that does not wear.'
    """
    tables = {**TARGETS, HEADER: C}
    if target not in tables:
        raise ValueError(f"{target!r} is no target; there are {', '.join(tables)}")
    return rendered(target, **_context(program, tables[target]))


def definitions(program: Program) -> str:
    """Return the JavaScript of a program as the body of a function that returns its functions."""
    return rendered("javascript", **_context(program, TARGETS["javascript"]) | {"embedded": True})


def rendered(template: str, **context: Any) -> str:
    """Return the text of a template."""
    return _environment().get_template(f"{template}.jinja").render(**context)


@cache
def _environment() -> Environment:
    environment = templates(__package__)
    environment.filters |= {"remarked": remarked, "wrapped": wrapped, "bracketed": bracketed}
    environment.globals |= {"meaning_of": meaning_of, "sentence": sentence}
    return environment


def _context(program: Program, target: Target) -> dict[str, Any]:
    """Return the variables of a template."""
    variant = program.variant
    functions = program.array_functions if target is NUMPY else program.functions
    expressions = [expression for f in functions for expression in f.expressions]
    return {
        "program": program,
        "variant": variant,
        "title": title_of(program),
        "language": target.language,
        "parameters": [parameter.name for parameter in program.parameters],
        "constants": [name.name for name, _ in program.constants],
        "functions": functions,
        "minimum": any(expression.has(sp.Min) for expression in expressions),
        "maximum": any(expression.has(sp.Max) for expression in expressions),
        "increment": increment(variant),
        "contact": contact(variant),
        "rename": target.rename,
        "emit": partial(emit, target=target),
        "write": partial(_write, program=program, target=target),
        "arguments_of": lambda function: [target.rename(each.name) for each in function.arguments],
        "unused": partial(_unused, program),
        "embedded": False,
    }


def _write(
    expr: sp.Expr, function: Function | None = None, *, program: Program, target: Target
) -> str:
    """Write an expression of a function; of ``bind``, if there is none.

    Constants of the run have a prefix in a function, parameters and derivatives with respect to
    constants in ``bind`` and where that is differentiated.
    """
    if function is None or function.name == "parameter_gradient":
        prefixed = {p.name: target.parameter.format(p.name) for p in program.parameters}
        prefixed |= {by_constant(c.name).name: f"by.{c}" for c, _ in program.constants}
    else:
        constants = {c for c, _ in program.constants} & function.free_symbols
        prefixed = {c.name: target.constant.format(c.name) for c in constants}
    return emit(
        expr, replace(target, rename=lambda name: prefixed.get(name) or target.rename(name))
    )


def _unused(program: Program, function: Function) -> list[str]:
    """Return the arguments that no expression has, and ``c`` if it has no constant of a run."""
    used = set().union(*(expression.free_symbols for expression in function.expressions))
    names = [argument.name for argument in function.arguments if argument not in used]
    constants = {name for name, _ in program.constants}
    return names + ["c"] * function.free_symbols.isdisjoint(constants)


def remarked(code: str, name: object, form: str) -> str:
    """Put the meaning of a name beside its line of code, or above it where that would be too long.

    >>> remarked("    h = 1;", "h", "// {}")
    '    h = 1; // closure, (1)'
    """
    comment = form.format(remark_on(str(name)))
    if len(code) + 1 + len(comment) <= LINE_WIDTH:
        return f"{code} {comment}"
    return f"{code[: len(code) - len(code.lstrip())]}{comment}\n{code}"


def wrapped(text: str, width: int, indent: str = "", end: str = "") -> str:
    """Break a text into lines, each but the first indented, each but the last with an ``end``."""
    lines = textwrap.wrap(text, width, subsequent_indent=indent, break_on_hyphens=False)
    return f"{end}\n".join(lines)


def bracketed(entries: Sequence[str], opening: str, closing: str, explode: bool = False) -> str:
    """Write a bracket with its entries in Ruff's layout: on its line, on the next, or one a line.

    ``explode`` excludes the second layout, as Ruff does for tuples and dictionaries.

    >>> print(bracketed(["a", "b"], "f(", ")"))
    f(a, b)
    """
    inside = ", ".join(entries)
    indent = " " * (len(opening) - len(opening.lstrip()))
    if len(opening) + len(inside) + len(closing) <= LINE_WIDTH:
        return f"{opening}{inside}{closing}"
    if not explode and len(indent) + 4 + len(inside) <= LINE_WIDTH:
        return f"{opening}\n{indent}    {inside}\n{indent}{closing}"
    lines = "".join(f"{indent}    {entry},\n" for entry in entries)
    return f"{opening}\n{lines}{indent}{closing}"
