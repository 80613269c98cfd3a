"""C99: a variant as a free-standing source that needs math.h alone.

Key results
    C               the target
    source          the source of a variant
"""

from __future__ import annotations

from collections.abc import Iterable
from types import MappingProxyType

import sympy as sp

from ..program import Program, program
from ..program.function import Function
from ..variant import Variant
from .emit import Target
from .layout import (
    FACTS_OF_NEWTON,
    PRESSURE,
    RIGHT_HAND_SIDE,
    WIDEST,
    body,
    computed,
    header_lines,
    remarked,
    unused_arguments,
)
from .wording import meaning_of


def _number(decimal: str) -> str:
    """Write every number as a double: an integer divided by an integer would be cut off."""
    return decimal if any(mark in decimal for mark in ".e") else f"{decimal}.0"


C = Target(
    name="c",
    functions=MappingProxyType(
        {
            sp.exp: "exp",
            sp.log: "log",
            sp.sqrt: "sqrt",
            sp.Abs: "fabs",
            sp.Min: "wear_smaller",
            sp.Max: "wear_larger",
        }
    ),
    power=lambda base, exponent: " * ".join([base] * exponent),
    number=_number,
    pi="3.141592653589793",
)

_CONSTANTS = "const struct wear_constants *c"

_SELECTION = """\
/* The {0} of two numbers; unlike {1}, not a number if one of them is none. */
static double wear_{0}(double a, double b)
{{
    return a {2} b || a != a ? a : b;
}}"""

_NEWTON = """\
/* {meaning}.
{facts} */
double wear_pressure(double u, double U_a, const struct wear_constants *c)
{{
    const double close = 0x1p-54; /* a quarter of the roundoff of 1 */
    const double at = wear_undeflected(u, U_a, c), give = wear_softness(u, c);
    const double lower = wear_lower(at, give, c), upper = wear_upper(at, give, c);
    double p = wear_start(at, give, c);
    for (int count = 0; count < 200; ++count) {{
        const double last = p < lower ? lower : p > upper ? upper : p;
        p = wear_newton(last, at, give, c);
        if (give * (p - last) * (p - last) <= close * p)
            return {result};
    }}
    return NAN; /* an argument is not a number, or out of the range of the contact law */
}}"""


def source(variant: Variant) -> str:
    """Return the C source of a variant."""
    made = program(variant)
    functions = [_function(function, made) for function in made.functions]
    parts = [_header(made), _parameters(made), _constants(made), _fields(made)]
    parts += [*_selections(functions), _bind(made), *functions]
    if variant.compliant:
        parts.append(_newton(variant))
    parts.append(_right_hand_side(variant))
    return "\n\n".join(parts) + "\n"


def _header(made: Program) -> str:
    lines = "\n".join(f" * {line}".rstrip() for line in header_lines(made, "C99"))
    return f"""/*
{lines}
 *
 *     struct wear_constants c = wear_bind(&parameters);
 *     double rate = wear_right_hand_side(u, U_a, &c);
 */

#include <math.h>"""


def _struct(name: str, meaning: str, members: Iterable[str]) -> str:
    lines = "\n".join(f"    double {member}; /* {meaning_of(member)} */" for member in members)
    return f"/* {meaning}. */\nstruct {name} {{\n{lines}\n}};"


def _parameters(made: Program) -> str:
    names = (parameter.name for parameter in made.parameters)
    return _struct("wear_parameters", "The physical parameters", names)


def _constants(made: Program) -> str:
    names = (name.name for name, _ in made.constants)
    return _struct("wear_constants", "What does not change during a run", names)


def _fields(made: Program) -> str:
    return _struct("wear_fields", "The fields that this variant has", made.fields)


def _selections(functions: Iterable[str]) -> list[str]:
    """Define the selections that are used: an unused static function is a warning."""
    text = "\n".join(functions)
    rows = (("smaller", "fmin", "<"), ("larger", "fmax", ">"))
    return [_SELECTION.format(*row) for row in rows if f"wear_{row[0]}(" in text]


def _bind(made: Program) -> str:
    plain = [name.name for name, value in made.constants if name == value]
    lines: list[str] = []
    for name, text, _ in _computed(made):
        line = f"    const double {name} = {text};"
        lines += [line] if len(line) <= WIDEST else line.replace(" = ", " =\n        ").split("\n")
    names = [name for name, _, _ in _computed(made)]
    values = [f"        .{name} = data->{name}," for name in plain]
    values += [f"        .{name} = {name}," for name in names]
    return "\n".join(
        [
            "/* Compute the constants of a run from the physical parameters. */",
            "struct wear_constants wear_bind(const struct wear_parameters *data)",
            "{",
            *lines,
            "    return (struct wear_constants){",
            *values,
            "    };",
            "}",
        ]
    )


def _computed(made: Program) -> tuple[tuple[str, str, str], ...]:
    return computed(made, C, lambda name: f"data->{name}")


def _function(function: Function, made: Program) -> str:
    written = body(function, made, C, lambda name: f"c->{name}")
    arguments = ", ".join([*(f"double {a.name}" for a in function.arguments), _CONSTANTS])
    lines = [f"    (void){name};" for name in unused_arguments(function)]
    if not any(
        "c->" in text for text in (*written.results, *(line.text for line in written.lines))
    ):
        lines.append("    (void)c;")
    for name, text, remark in written.lines:
        lines += remarked(f"    const double {name} = {text};", remark, "/*", " */")
    if function.name == "fields":
        kind = "struct wear_fields"
        pairs = zip(made.fields, written.results, strict=True)
        lines += ["    return (struct wear_fields){"]
        lines += [f"        .{name} = {result}," for name, result in pairs]
        lines += ["    };"]
    else:
        kind = "double"
        lines.append(f"    return {written.results[0]};")
    meaning = function.meaning[0].upper() + function.meaning[1:]
    return "\n".join(
        [f"/* {meaning}. */", f"{kind} wear_{function.name}({arguments})", "{", *lines, "}"]
    )


def _newton(variant: Variant) -> str:
    return _NEWTON.format(
        meaning=PRESSURE[0].upper() + PRESSURE[1:],
        facts="\n".join(f"   {fact}" for fact in FACTS_OF_NEWTON),
        result="wear_limited(p, u, U_a, c)" if variant.cutoff else "p",
    )


def _right_hand_side(variant: Variant) -> str:
    if variant.compliant:
        value = "wear_rate(wear_pressure(u, U_a, c), c)"
    elif variant.cutoff:
        value = "wear_margin(u, U_a, c) < 0.0 ? 0.0 : wear_rate(u, U_a, c)"
    else:
        value = "wear_rate(u, U_a, c)"
    return (
        f"/* {RIGHT_HAND_SIDE}. */\n"
        f"double wear_right_hand_side(double u, double U_a, {_CONSTANTS})\n"
        f"{{\n    return {value};\n}}"
    )
