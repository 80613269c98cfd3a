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
from typing import TYPE_CHECKING, Any, NamedTuple

import sympy as sp

from ..program import Program
from ..program.function import Function
from ..program.gradient import by_constant
from .emit import NUMPY, TARGETS, C, Target, emit
from .increment import contact, increment
from .wording import margin_title, meaning_of, remark_on, sentence, title_of

if TYPE_CHECKING:
    from jinja2 import Environment

HEADER = "header"
"""The target of the C source's declarations, with the table of C."""
TEXT_WIDTH = 96
LINE_WIDTH = 100


class Line(NamedTuple):
    """An assignment ``name = text`` with a remark on its meaning."""

    name: str
    text: str
    remark: str


class Body(NamedTuple):
    """A generated function in a language: its lines, its results, and its unused arguments."""

    name: str
    meaning: str
    arguments: tuple[str, ...]
    lines: tuple[Line, ...]
    results: tuple[str, ...]
    unused: tuple[str, ...]


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
    """Return the templates; Jinja2 is imported when the first source is written."""
    from jinja2 import Environment, PackageLoader, StrictUndefined

    environment = Environment(
        loader=PackageLoader(__package__),
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        undefined=StrictUndefined,
    )
    environment.filters |= {"remarked": remarked, "wrapped": wrapped, "bracketed": bracketed}
    environment.globals |= {"meaning_of": meaning_of, "sentence": sentence}
    return environment


def _context(program: Program, target: Target) -> dict[str, Any]:
    """Return the variables of a template."""
    variant = program.variant
    functions = _functions(program, target)
    expressions = [expression for f in functions for expression in f.expressions]
    return {
        "program": program,
        "variant": variant,
        "title": title_of(variant) if program.fields else margin_title(variant.pin),
        "header": _header(program, target),
        "rename": target.rename,
        "parameters": [parameter.name for parameter in program.parameters],
        "constants": [name.name for name, _ in program.constants],
        "computed": _computed(program, target),
        "plain": [name.name for name, value in program.constants if name == value],
        "functions": [body(function, program, target) for function in functions],
        "minimum": any(expression.has(sp.Min) for expression in expressions),
        "maximum": any(expression.has(sp.Max) for expression in expressions),
        "increment": increment(variant),
        "contact": body(contact(variant), program, target),
        "emit": partial(emit, target=target),
        "embedded": False,
    }


def _functions(program: Program, target: Target) -> tuple[Function, ...]:
    """Return the functions that are written in a language."""
    return program.array_functions if target is NUMPY else program.functions


def body(function: Function, program: Program, target: Target) -> Body:
    """Write a function's expressions in a target's language."""
    arguments = [argument.name for argument in function.arguments]
    local = {*arguments, *(name.name for name, _ in function.assignments)}
    constants = {name.name for name, _ in program.constants} - local
    within = _prefixing(target, constants, target.constant)
    if function.name == "parameter_gradient":  # like ``bind``, it has no constants of a run
        within = _within_bind(program, target)
    used = set().union(*(expression.free_symbols for expression in function.expressions))
    names = {symbol.name for symbol in used}
    unused = [name for name in arguments if name not in names]
    return Body(
        function.name,
        sentence(function.meaning),
        tuple(map(target.rename, arguments)),
        tuple(
            Line(target.rename(name.name), emit(value, within), remark_on(name.name))
            for name, value in function.assignments
        ),
        tuple(_constant(result) or emit(result, within) for result in function.results),
        (*map(target.rename, unused), *["c"] * (not names & constants)),
    )


def _constant(result: sp.Expr) -> str:
    """Write a number as an array of the shape of the wear; return nothing for other results."""
    if not result.is_number:
        return ""
    return "0 * u" if result == 0 else f"{result} + 0 * u"


def _within_bind(program: Program, target: Target) -> Target:
    """Return a target with prefixes for parameters and derivatives with respect to constants."""
    parameters = {parameter.name for parameter in program.parameters}
    derivatives = {by_constant(name.name).name: f"by.{name}" for name, _ in program.constants}
    within = _prefixing(target, parameters, target.parameter)
    return replace(within, rename=lambda name: derivatives.get(name) or within.rename(name))


def _computed(program: Program, target: Target) -> list[Line]:
    """Write the assignments of the computed constants, as ``bind`` contains them."""
    within = _within_bind(program, target)
    return [
        Line(target.rename(name.name), emit(value, within), "")
        for name, value in program.constants
        if name != value
    ]


def _prefixing(target: Target, names: set[str], form: str) -> Target:
    """Return a target that writes some names in a form such as ``c.{}``."""

    def rename(name: str) -> str:
        return form.format(name) if name in names else target.rename(name)

    return replace(target, rename=rename)


def _header(program: Program, target: Target) -> list[str]:
    """Return the opening lines of a source: title, origin, units and cost."""
    variant = program.variant
    equations = ", ".join(f"({identifier})" for identifier in variant.equations)
    cost = ", ".join(f"{f.name} {f.operations}" for f in _functions(program, target))
    paragraphs = [
        title_of(variant),
        f"Written by derive code from equations {equations}; contact law: {variant.law.source}.",
        f"Free-standing {target.language}. "
        "Units: mm, s, MPa; the speed n in revolutions per minute.",
        "u is the wear depth u_c of the bearing, U_a the prescribed displacement of the pin.",
        f"Arithmetic operations of one call: {cost}.",
    ]
    if variant.ends_at_3_sigma:
        paragraphs.append(
            "Contact ends at h = 3 sigma: the pressure is the smaller of root and limit."
            if variant.compliant
            else "Contact ends at h = 3 sigma. The rate, its slope and the pressure among the "
            "fields are those in contact; there is contact where the margin is not negative."
        )
    return [line for text in paragraphs for line in (*textwrap.wrap(text, TEXT_WIDTH), "")][:-1]


def remarked(code: str, remark: str, form: str) -> str:
    """Put a comment beside a line of code, or above it where the line would be too long.

    >>> remarked("    h = 1;", "closure", "// {}")
    '    h = 1; // closure'
    """
    comment = form.format(remark)
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
