"""JavaScript: a variant as a module without imports.

Key results
    JAVASCRIPT      the target
    source          the module of a variant
    definitions     its functions alone, to stand inside another script
    formula_function   a closed form as a function
"""

from __future__ import annotations

import textwrap
from types import MappingProxyType
from typing import NamedTuple

import sympy as sp

from ..program import Program, program
from ..program.function import Function
from ..variant import Variant
from .emit import Target, emit
from .formula_module import Formula, Guard
from .layout import (
    FACTS_OF_NEWTON,
    PRESSURE,
    RIGHT_HAND_SIDE,
    body,
    computed,
    header_lines,
    remarked,
)
from .wording import meaning_of

JAVASCRIPT = Target(
    name="javascript",
    functions=MappingProxyType(
        {
            sp.exp: "Math.exp",
            sp.log: "Math.log",
            sp.sqrt: "Math.sqrt",
            sp.Abs: "Math.abs",
            sp.Min: "Math.min",
            sp.Max: "Math.max",
        }
    ),
    power=lambda base, exponent: " * ".join([base] * exponent),
    number=str,
    pi="Math.PI",
)

_NEWTON = """\
/** {meaning}.
{facts} */
function pressure(u, U_a, c) {{
  const at = undeflected(u, U_a, c);
  const give = softness(u, c);
  const low = lower(at, give, c);
  const high = upper(at, give, c);
  let p = start(at, give, c);
  for (let count = 0; count < 200; count += 1) {{
    const last = Math.min(Math.max(p, low), high);
    p = newton(last, at, give, c);
    if (give * (p - last) * (p - last) <= (Number.EPSILON / 4) * p) return {result};
  }}
  return NaN; // an argument is not a number, or out of the range of the contact law
}}"""


class Definitions(NamedTuple):
    """Functions as text, and their names."""

    text: str
    names: tuple[str, ...]


def source(variant: Variant) -> str:
    """Return the module of a variant."""
    made = program(variant)
    text, names = definitions(variant)
    lines = "\n".join(f" * {line}".rstrip() for line in header_lines(made, "ECMAScript module"))
    example = (
        " * const c = bind({"
        + ", ".join(parameter.name for parameter in made.parameters)
        + "}); right_hand_side(u, U_a, c);"
    )
    wrapped = textwrap.fill(example, 96, subsequent_indent=" *     ")
    exported = ",\n".join(f"  {name}" for name in names)
    return f"/*\n{lines}\n *\n{wrapped}\n */\n\n{text}\n\nexport {{\n{exported},\n}};\n"


def definitions(variant: Variant) -> Definitions:
    """Return the functions of a variant."""
    made = program(variant)
    parts = [_bind(made), *(_function(function, made) for function in made.functions)]
    names = ["bind", *(function.name for function in made.functions)]
    if variant.compliant:
        parts.append(_newton(variant))
        names.append("pressure")
    parts.append(_right_hand_side(variant))
    return Definitions("\n\n".join(parts), (*names, "right_hand_side"))


def formula_function(formula: Formula) -> str:
    """Return a formula as a function of its arguments and an object with its data."""
    arguments = [a.name for a in formula.arguments]
    if formula.data:
        arguments.append(f"{{ {', '.join(formula.data)} }}")
    lines = [f"  const {name.name} = {emit(value, JAVASCRIPT)};" for name, value in formula.parts]
    lines.append(f"  return {emit(formula.value, JAVASCRIPT)};")
    opening = f"function {formula.name}({', '.join(arguments)}) {{"
    meaning = formula.meaning[0].upper() + formula.meaning[1:]
    return "\n".join([f"/** {meaning}. */", opening, *lines, "}"])


def guard_function(guard: Guard) -> str:
    """Return a condition as a function of an object with its data."""
    lines = [f"  const {name.name} = {emit(value, JAVASCRIPT)};" for name, value in guard.parts]
    text = " && ".join(
        f"{emit(piece.lhs, JAVASCRIPT)} {_STRICT.get(piece.rel_op, piece.rel_op)} "
        f"{emit(piece.rhs, JAVASCRIPT)}"
        for piece in guard.relations
    )
    opening = f"function {guard.name}({{ {', '.join(guard.data)} }}) {{"
    words = guard.condition.text[0].upper() + guard.condition.text[1:]
    return "\n".join([f"/** {words}. */", opening, *lines, f"  return {text};", "}"])


_STRICT = {"==": "===", "!=": "!=="}


def _bind(made: Program) -> str:
    parameters = [parameter.name for parameter in made.parameters]
    documented = "\n".join(f" * {name}: {meaning_of(name)}" for name in parameters)
    kept = "\n".join(f" * {name.name}: {meaning_of(name.name)}" for name, _ in made.constants)
    lines = [f"  const {name} = {text};" for name, text, _ in computed(made, JAVASCRIPT, str)]
    values = "\n".join(f"    {name.name}," for name, _ in made.constants)
    unpacked = textwrap.fill(
        f"function bind({{ {', '.join(parameters)} }}) {{", 96, subsequent_indent="  "
    )
    return "\n".join(
        [
            "/** Compute the constants of a run from the physical parameters:",
            documented,
            " * The constants:",
            kept,
            " */",
            unpacked,
            *lines,
            f"  return {{\n{values}\n  }};\n}}",
        ]
    )


def _function(function: Function, made: Program) -> str:
    written = body(function, made, JAVASCRIPT, lambda name: f"c.{name}")
    arguments = ", ".join([*(a.name for a in function.arguments), "c"])
    lines: list[str] = []
    for name, text, remark in written.lines:
        lines += remarked(f"  const {name} = {text};", remark, "//")
    if function.name == "fields":
        pairs = zip(made.fields, written.results, strict=True)
        values = "\n".join(f"    {name}: {result}," for name, result in pairs)
        lines.append(f"  return {{\n{values}\n  }};")
    else:
        lines.append(f"  return {written.results[0]};")
    meaning = function.meaning[0].upper() + function.meaning[1:]
    return "\n".join(
        [f"/** {meaning}. */", f"function {function.name}({arguments}) {{", *lines, "}"]
    )


def _newton(variant: Variant) -> str:
    return _NEWTON.format(
        meaning=PRESSURE[0].upper() + PRESSURE[1:],
        facts="\n".join(f" * {fact}" for fact in FACTS_OF_NEWTON),
        result="limited(p, u, U_a, c)" if variant.cutoff else "p",
    )


def _right_hand_side(variant: Variant) -> str:
    if variant.compliant:
        value = "rate(pressure(u, U_a, c), c)"
    elif variant.cutoff:
        value = "margin(u, U_a, c) < 0 ? 0 : rate(u, U_a, c)"
    else:
        value = "rate(u, U_a, c)"
    return (
        f"/** {RIGHT_HAND_SIDE}. */\nfunction right_hand_side(u, U_a, c) {{\n  return {value};\n}}"
    )
