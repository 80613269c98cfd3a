"""NumPy modules: one for each variant, as text.

Key results
    NUMPY           the target
    module_text     the source of a variant's module
"""

from __future__ import annotations

import textwrap
from types import MappingProxyType

import sympy as sp

from ..program import Program, program
from ..program.function import Function
from ..variant import Variant
from .emit import Target, emit
from .wording import meaning_of, title_of

FUNCTIONS = MappingProxyType(
    {
        sp.exp: "np.exp",
        sp.log: "np.log",
        sp.sqrt: "np.sqrt",
        sp.Abs: "np.abs",
        sp.Min: "np.minimum",
        sp.Max: "np.maximum",
    }
)


def _square(base: str, exponent: int) -> str:
    return f"{base} * {base}" if exponent == 2 else f"{base}**{exponent}"


def numpy_target(constants: frozenset[str] = frozenset()) -> Target:
    """Return the NumPy target; the names in ``constants`` are fields of the tuple ``c``."""
    return Target(
        name="numpy",
        functions=FUNCTIONS,
        power=_square,
        number=str,
        pi="np.pi",
        rename=lambda name: f"c.{name}" if name in constants else name,
    )


def module_text(variant: Variant) -> str:
    """Return the source of the module of a variant: formatted, and the same at every call."""
    made = program(variant)
    parts = [_header(made), _constants_class(made), _bind(made), _fields_class(made)]
    parts += [_function(function, made) for function in made.functions]
    return "\n\n\n".join(part.strip("\n") for part in parts) + "\n"


def _header(made: Program) -> str:
    variant = made.variant
    equations = ", ".join(f"({identifier})" for identifier in variant.equations)
    title = textwrap.fill(title_of(variant), 96)
    origin = textwrap.fill(
        f"Written by ``derive generate`` from equations {equations}; not to be edited.", 96
    )
    counts = ",\n".join(f'    "{f.name}": {f.operations}' for f in made.functions)
    ids = ", ".join(f'"{identifier}"' for identifier in variant.equations)
    names = "\n".join(f'    "{parameter.name}",' for parameter in made.parameters)
    return f'''"""{title}

{origin}
All functions broadcast over arrays; the constants may be arrays too.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

VARIANT = "{variant.module}"
LAW = "{variant.law.name}"
EQUATIONS = ({ids})
OPERATIONS = {{
{counts},
}}
PARAMETERS = (
{names}
)'''


def _constants_class(made: Program) -> str:
    lines = [f"    {name}: Array  # {meaning_of(name.name)}" for name, _ in made.constants]
    return (
        'class Constants(NamedTuple):\n    """What does not change during a run."""\n\n'
        + "\n".join(lines)
    )


def _bind(made: Program) -> str:
    arguments = "\n".join(f"    {parameter.name}: Array," for parameter in made.parameters)
    computed = [(name, value) for name, value in made.constants if name != value]
    target = numpy_target()
    lines = [f"    {name} = {emit(value, target)}" for name, value in computed]
    values = "\n".join(f"        {name}={name}," for name, _ in made.constants)
    body = "\n".join(lines) + ("\n" if lines else "")
    meaning = "Compute the constants of a run from the physical parameters, in mm, s, MPa, rpm."
    return (
        f"def bind(\n    *,\n{arguments}\n) -> Constants:\n"
        f'    """{meaning}"""\n'
        f"{body}    return Constants(\n{values}\n    )"
    )


def _fields_class(made: Program) -> str:
    lines = [f"    {name}: Array  # {meaning_of(name)}" for name in made.fields]
    return 'class Fields(NamedTuple):\n    """The fields that this variant has."""\n\n' + "\n".join(
        lines
    )


def _function(function: Function, made: Program) -> str:
    constants = frozenset(name.name for name, _ in made.constants)
    local = {name.name for name, _ in function.assignments} | {a.name for a in function.arguments}
    target = numpy_target(constants - local)
    arguments = ", ".join(f"{argument.name}: Array" for argument in function.arguments)
    is_fields = function.name == "fields"
    kind = "Fields" if is_fields else "Array"
    lines = [f"    {name} = {emit(value, target)}" for name, value in function.assignments]
    results = [
        f"np.full_like(u, {result})" if result.is_number else emit(result, target)
        for result in function.results
    ]
    if is_fields:
        pairs = zip(made.fields, results, strict=True)
        inner = "\n".join(f"        {name}={result}," for name, result in pairs)
        lines.append(f"    return Fields(\n{inner}\n    )")
    else:
        lines.append(f"    return {results[0]}")
    meaning = function.meaning[0].upper() + function.meaning[1:]
    return (
        f"def {function.name}({arguments}, c: Constants) -> {kind}:\n"
        f'    """{meaning}."""\n' + "\n".join(lines)
    )
