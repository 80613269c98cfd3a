"""Generated sources in other languages: compiled, loaded and called."""

import ctypes
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from derive.codegen.sources import source
from derive.variant import Variant
from tests.derive import exact
from tests.programs import run

FLAGS = ("-O2", "-ffp-contract=off", "-Wall", "-Werror")
COMPILERS = {"c": ("gcc", "-std=c99"), "fortran": ("gfortran", "-std=f2008")}


class Numbers(ctypes.Structure):
    """What a source has by name, as numbers one after the other, with room behind them."""

    _fields_ = (("values", ctypes.c_double * 64),)


def number(value: float = 0.0) -> Any:
    return ctypes.c_double(value)


def reference(value: float) -> Any:
    return ctypes.byref(number(value))


PASSED = {"c": number, "fortran": reference}
"""How a language passes a number."""


def library(language: str, variant: Variant, folder: Path, need_tool: Callable[..., str]) -> Any:
    """Return the compiled source of a variant."""
    compiler, standard = COMPILERS[language]
    file = folder / {"c": "source.c", "fortran": "source.f90"}[language]
    file.write_text(source(exact.made(variant), language))
    options = standard, *FLAGS, "-shared", "-fPIC", file.name, "-lm", "-o", "source.so"
    run(need_tool(compiler), *options, cwd=folder)
    return ctypes.CDLL(str(folder / "source.so"))


def names_of_outputs(variant: Variant) -> tuple[list[str], list[str]]:
    """Return the functions that have one value, and root and right-hand side."""
    plain = [f.name for f in exact.made(variant).functions if len(f.results) == 1]
    return plain, ["pressure"] * variant.compliant + ["right_hand_side"]


def outputs(
    language: str,
    variant: Variant,
    rows: Sequence[exact.Point],
    folder: Path,
    need_tool: Callable[..., str],
) -> list[list[float]]:
    """Return what a source gives at points: every function, every field, root and rate."""
    if language == "javascript":
        return _from_javascript(variant, rows, folder, need_tool("node", "nodejs"))
    compiled, passed = library(language, variant, folder, need_tool), PASSED[language]
    module = f"__wear_{variant.law.name}_{variant.name}_MOD_"
    name = {"c": "wear_{}", "fortran": module + "{}"}[language]

    def call(function: str, *arguments: Any, gives: Any = ctypes.c_double) -> Any:
        found = compiled[name.format(function)]
        found.restype = gives
        return found(*arguments)

    def at_point(at: exact.Point) -> list[float]:
        data = [at.parameters[p.name] for p in exact.made(variant).parameters]
        sign = [passed(at.pin_wear_sign)] * variant.pin.wears
        if language == "c":
            given = ctypes.byref(Numbers((ctypes.c_double * 64)(*data)))
            constants = call("bind", given, *sign, gives=Numbers)
        else:
            constants = call("bind_constants", *map(passed, data), *sign, gives=Numbers)

        def value(function: str, arguments: Sequence[str], gives: Any = ctypes.c_double) -> Any:
            numbers = (passed(at.state[argument]) for argument in arguments)
            return call(function, *numbers, ctypes.byref(constants), gives=gives)

        taken = {f.name: [a.name for a in f.arguments] for f in exact.made(variant).functions}
        plain, roots = names_of_outputs(variant)
        fields = value("fields", taken["fields"], Numbers).values
        return [
            *(value(function, taken[function]) for function in plain),
            *fields[: len(exact.made(variant).fields)],
            *(value(root, ("u", "U_a")) for root in roots),
        ]

    return [at_point(at) for at in rows]


def _from_javascript(
    variant: Variant, rows: Sequence[exact.Point], folder: Path, node: str
) -> list[list[float]]:
    made, (plain, roots) = exact.made(variant), names_of_outputs(variant)
    taken = {f.name: ", ".join(a.name for a in f.arguments) for f in made.functions}
    calls = [f"m.{function}({taken[function]}, c)" for function in plain]
    calls += [f"m.fields({taken['fields']}, c).{name}" for name in made.fields]
    calls += [f"m.{root}(u, U_a, c)" for root in roots]
    parameters = ", ".join(p.name for p in made.parameters)
    (folder / "source.mjs").write_text(source(made, "javascript"))
    (folder / "driver.mjs").write_text(f"""
import * as m from './source.mjs';
import {{ readFileSync }} from 'node:fs';
for (const line of readFileSync(0, 'utf8').trim().split('\\n')) {{
  const [{parameters}, pin_wear_sign, {", ".join(rows[0].state)}] = line.split(' ').map(Number);
  const c = m.bind({{ {parameters} }}, pin_wear_sign);
  console.log([{", ".join(calls)}].join(' '));
}}
""")
    text = "\n".join(" ".join(map(repr, [*at.numbers.values(), *at.state.values()])) for at in rows)
    printed = run(node, str(folder / "driver.mjs"), input=text.replace("nan", "NaN") + "\n")
    return [[float(one) for one in line.split()] for line in printed.splitlines()]
