"""Programs: the computation of a variant, as short lists of named assignments.

Overview
    The derived relations of a variant (closure, roughness, pressure at given wear) become
    functions of numbers.  Intermediates keep the names of the field.  Expressions that do not
    change during a run are hoisted into named constants.
Key results
    Program          functions and constants of a source
    program          the program of a variant
    margin_program   the functions that loss of contact adds to any variant with the same pin
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache

import sympy as sp

from ..laws import TANH
from ..note.governing import Pin
from ..symbols import QUANTITIES
from ..variant import Variant
from . import functions as parts
from . import gradient
from .function import Assignment, Function
from .relations import groups
from .root import root
from .symbols import pin_wear_sign


@dataclass(frozen=True)
class Program:
    """The content of one source.

    ``constants`` are computed once, by ``bind``, from ``parameters`` and, where the pin wears,
    the sign of its wear; ``fields`` names the results of the function of that name, if there is
    one.  ``joint_functions`` have several results each and are written for NumPy alone, where
    the function of rate and slope replaces that of the slope.
    """

    variant: Variant
    parameters: tuple[sp.Symbol, ...]
    constants: tuple[Assignment, ...]
    functions: tuple[Function, ...]
    fields: tuple[str, ...] = ()
    joint_functions: tuple[Function, ...] = ()

    @property
    def equations(self) -> tuple[str, ...]:
        """Return the ids of the underlying equations."""
        return self.variant.equations if self.fields else ("1", "3", "5", "6")

    @property
    def signed(self) -> bool:
        """Return whether ``bind`` takes the sign of pin wear."""
        return any(pin_wear_sign in value.free_symbols for _, value in self.constants)

    @property
    def operations(self) -> dict[str, int]:
        """Return the number of arithmetic operations of one call of each function."""
        return {function.name: function.operations for function in self.array_functions}

    @property
    def array_functions(self) -> tuple[Function, ...]:
        """Return the functions that are written in NumPy."""
        joint = {function.name for function in self.joint_functions}
        replaced = {"slope"} if "rate_and_slope" in joint else set()
        return (*(f for f in self.functions if f.name not in replaced), *self.joint_functions)


@cache
def program(variant: Variant) -> Program:
    """Return the complete program of a variant."""
    functions: tuple[Function, ...]
    joint: tuple[Function, ...] = ()
    if variant.compliant:
        functions = (*root(variant), *parts.compliant(variant))
    else:
        functions = rate, slope = parts.rigid(variant)
        joint = (parts.rate_and_slope(rate, slope),)
    hoisted = groups(variant)
    if variant.ends_at_3_sigma:
        constants, of_margin = parts.margin(variant)
        hoisted += constants
        functions += (*of_margin, *(parts.limited() if variant.compliant else ()))
    names, fields = parts.fields(variant)
    plain = _program(variant, hoisted, (*functions, fields), names)
    gradients = (
        gradient.rate_gradient(variant, [name for name, _ in plain.constants]),
        gradient.parameter_gradient(plain.constants, plain.parameters),
    )
    return replace(plain, joint_functions=(*joint, *gradients))


@cache
def margin_program(pin: Pin) -> Program:
    """Return the functions that loss of contact adds; they depend on neither law nor support."""
    variant = Variant(TANH, compliant=False, pin=pin, ends_at_3_sigma=True)
    constants, functions = parts.margin(variant)
    plain = _program(variant, (*groups(variant), *constants), (*functions, *parts.limited()))
    gradients = (
        gradient.margin_gradient(functions[0], [name for name, _ in plain.constants]),
        gradient.parameter_gradient(plain.constants, plain.parameters),
    )
    return replace(plain, joint_functions=gradients)


def _program(
    variant: Variant,
    hoisted: Sequence[Assignment],
    functions: tuple[Function, ...],
    names: tuple[str, ...] = (),
) -> Program:
    """Return a program with the constants that its functions need: parameters, then hoisted ones.

    The parameters are the symbols that these need.
    """
    used = set().union(*(function.free_symbols for function in functions))
    needed = set(used)
    for name, value in reversed(hoisted):
        if name in needed:
            needed |= value.free_symbols
    named = {name for name, _ in hoisted}
    plain = ((name, name) for name in sorted(used - named, key=_order))
    constants = (*plain, *(each for each in hoisted if each[0] in needed))
    parameters = tuple(sorted(needed - named - {pin_wear_sign}, key=_order))
    return Program(variant, parameters, constants, functions, names)


def _order(parameter: sp.Symbol) -> int:
    return list(QUANTITIES).index(parameter.name)
