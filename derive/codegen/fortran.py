"""Fortran 2008: a variant as a module, and its wear laws as a subroutine for user routines.

Key results
    FORTRAN         the target
    source          module and subroutine of a variant
Remarks
    Fortran does not tell U_a from u_a, so that the displacements have names in words.
    Everything is elemental: scalars and arrays alike.
"""

from __future__ import annotations

import textwrap
from collections.abc import Iterable
from types import MappingProxyType

import sympy as sp

from ..program import Program, program
from ..program.function import Function
from ..variant import Variant
from .emit import Target, emit
from .increment import growth_of, increment, pressure, slip_rate, time_increment
from .layout import (
    FACTS_OF_NEWTON,
    PRESSURE,
    RIGHT_HAND_SIDE,
    body,
    computed,
    header_lines,
    remarked,
    unused_arguments,
)
from .wording import meaning_of

_IN_WORDS = {"U_a": "pin_displacement", "U_c": "bearing_displacement"}


def _spelt(name: str) -> str:
    return _IN_WORDS.get(name, name)


def _number(decimal: str) -> str:
    whole = decimal if any(mark in decimal for mark in ".e") else f"{decimal}.0"
    return f"{whole}_dp"


FORTRAN = Target(
    name="fortran",
    functions=MappingProxyType(
        {
            sp.exp: "exp",
            sp.log: "log",
            sp.sqrt: "sqrt",
            sp.Abs: "abs",
            sp.Min: "smaller",
            sp.Max: "larger",
        }
    ),
    power=lambda base, exponent: f"{base}**{exponent}",
    number=_number,
    pi="3.141592653589793_dp",
    rename=_spelt,
)

_SELECTION = """\
  !> The {0} of two numbers; unlike {1}, always not a number if one of them is none.
  pure elemental real(dp) function {0}(a, b)
    real(dp), intent(in) :: a, b
    {0} = merge(a, b, a {2} b .or. a /= a)
  end function {0}"""

_NEWTON = """\
  !> {meaning}.
{facts}
  !> Not a number if an argument is none or out of the range of the contact law.
  pure elemental real(dp) function pressure(u, pin_displacement, c)
    real(dp), intent(in) :: u, pin_displacement
    type(constants), intent(in) :: c
    real(dp) :: p, last, at, give, low, high
    integer :: count
    at = undeflected(u, pin_displacement, c)
    give = softness(u, c)
    low = lower(at, give, c)
    high = upper(at, give, c)
    p = start(at, give, c)
    do count = 1, 200
      last = merge(low, merge(high, p, p > high), p < low)
      p = newton(last, at, give, c)
      if (give * (p - last)**2 <= epsilon(p) / 4 * p) then
        pressure = {result}
        return
      end if
    end do
    pressure = ieee_value(pressure, ieee_quiet_nan)
  end function pressure"""


def source(variant: Variant) -> str:
    """Return the Fortran source of a variant."""
    made = program(variant)
    functions = [_function(function, made) for function in made.functions]
    if variant.compliant:
        functions.append(_newton(variant))
    functions.append(_right_hand_side(variant))
    procedures = "\n\n".join([_bind(made), *functions, *_selections(functions)])
    name = f"wear_{variant.law.name}_{variant.module}"
    uses = "  use, intrinsic :: iso_fortran_env, only: dp => real64\n"
    if variant.compliant:
        uses += "  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan\n"
    return f"""{_header(made, name)}
module {name}
{uses}  implicit none
  private
  public :: constants, fields_type, {_list(_public(made))}

{_type("constants", "What does not change during a run", [n.name for n, _ in made.constants])}

{_type("fields_type", "The fields that this variant has", made.fields)}

contains

{procedures}
end module {name}

{_increment(variant)}
"""


def _public(made: Program) -> list[str]:
    names = ["bind_constants", *(function.name for function in made.functions)]
    return names + ["pressure"] * made.variant.compliant + ["right_hand_side"]


def _list(names: Iterable[str]) -> str:
    """List names over as many lines as it takes."""
    return " &\n    ".join(textwrap.wrap(", ".join(names), 70))


def _header(made: Program, name: str) -> str:
    lines = "\n".join(f"! {line}".rstrip() for line in header_lines(made, "Fortran 2008"))
    return f"""{lines}
!
!   use {name}
!   type(constants) :: c
!   c = bind_constants({", ".join(f"{p.name}=..." for p in made.parameters[:2])}, ...)
!   rate = right_hand_side(u, pin_displacement, c)
!
! The subroutine wear_increment at the end stands for itself: for user routines of finite
! element codes, which find the pressure themselves."""


def _type(name: str, meaning: str, members: Iterable[str]) -> str:
    lines = "\n".join(f"    real(dp) :: {_spelt(m)} ! {meaning_of(m)}" for m in members)
    return f"  !> {meaning}.\n  type :: {name}\n{lines}\n  end type {name}"


def _bind(made: Program) -> str:
    made_here = computed(made, FORTRAN, _spelt)
    parameters = [parameter.name for parameter in made.parameters]
    lines = [f"    real(dp), intent(in) :: {name} ! {meaning_of(name)}" for name in parameters]
    lines += ["    type(constants) :: c"]
    lines += [f"    real(dp) :: {', '.join(line.name for line in made_here)}"]
    lines += [f"    {name} = {text}" for name, text, _ in made_here]
    lines += [f"    c%{name.name} = {name.name}" for name, _ in made.constants]
    return "\n".join(
        [
            "  !> Compute the constants of a run from the physical parameters.",
            f"  pure elemental function bind_constants({_list(parameters)}) result(c)",
            *lines,
            "  end function bind_constants",
        ]
    )


def _function(function: Function, made: Program) -> str:
    written = body(function, made, FORTRAN, lambda name: f"c%{name}")
    arguments = [_spelt(argument.name) for argument in function.arguments]
    is_fields = function.name == "fields"
    kind = "type(fields_type)" if is_fields else "real(dp)"
    unused = [_spelt(name) for name in unused_arguments(function)]
    texts = (*written.results, *(line.text for line in written.lines))
    unused += ["c"] * (not any("c%" in text for text in texts))
    lines = [
        f"    real(dp), intent(in) :: {', '.join(arguments)}",
        "    type(constants), intent(in) :: c",
    ]
    if written.lines:
        lines.append(f"    real(dp) :: {', '.join(line.name for line in written.lines)}")
    lines += [f"    associate (unused => {name}); end associate" for name in unused]
    for name, text, remark in written.lines:
        lines += remarked(f"    {name} = {text}", remark, "!")
    if is_fields:
        pairs = zip(made.fields, written.results, strict=True)
        lines += [f"    value%{_spelt(name)} = {result}" for name, result in pairs]
    else:
        lines.append(f"    value = {written.results[0]}")
    meaning = function.meaning[0].upper() + function.meaning[1:]
    called = f"{function.name}({', '.join([*arguments, 'c'])})"
    return "\n".join(
        [
            f"  !> {meaning}.",
            f"  pure elemental {kind} function {called} result(value)",
            *lines,
            f"  end function {function.name}",
        ]
    )


def _selections(functions: Iterable[str]) -> list[str]:
    """Define the selections that are used: an unused private function is a warning."""
    text = "\n".join(functions)
    rows = (("smaller", "min", "<"), ("larger", "max", ">"))
    return [_SELECTION.format(*row) for row in rows if f"{row[0]}(" in text]


def _newton(variant: Variant) -> str:
    return _NEWTON.format(
        meaning=PRESSURE[0].upper() + PRESSURE[1:],
        facts="\n".join(f"  !> {fact}" for fact in FACTS_OF_NEWTON),
        result="limited(p, u, pin_displacement, c)" if variant.cutoff else "p",
    )


def _right_hand_side(variant: Variant) -> str:
    value = "rate(u, pin_displacement, c)"
    if variant.compliant:
        value = "rate(pressure(u, pin_displacement, c), c)"
    elif variant.cutoff:
        value = f"merge(0.0_dp, {value}, margin(u, pin_displacement, c) < 0.0_dp)"
    return f"""  !> {RIGHT_HAND_SIDE}.
  pure elemental real(dp) function right_hand_side(u, pin_displacement, c) result(value)
    real(dp), intent(in) :: u, pin_displacement
    type(constants), intent(in) :: c
    value = {value}
  end function right_hand_side"""


def _increment(variant: Variant) -> str:
    made = increment(variant)
    known = {pressure: "contact pressure, MPa", slip_rate: "slip rate, mm/s"}
    known[time_increment] = "time increment, s"
    states = [name.name for name, _ in made.growth]
    inputs = [s.name for s in known] + [s.name for s in made.parameters]
    lines = [f"  real(dp), intent(in) :: {s.name} ! {text}" for s, text in known.items()]
    lines += [f"  real(dp), intent(in) :: {s.name} ! {meaning_of(s.name)}" for s in made.parameters]
    lines += [f"  real(dp), intent(inout) :: {name} ! {meaning_of(name)}" for name in states]
    lines.append(f"  real(dp) :: {', '.join(growth_of(name).name for name in states)}")
    lines += [f"  {growth_of(n.name)} = {emit(value, FORTRAN)}" for n, value in made.growth]
    lines += [f"  {name} = {name} + {growth_of(name)}" for name in states]
    return "\n".join(
        [
            "!> Wear and roughness at the end of a time increment, (5); exact while pressure and",
            "!> slip rate are constant. Keep the last arguments as state variables, each point its",
            "!> own; they start from no wear and the initial roughness.",
            f"pure subroutine wear_increment({_list([*inputs, *states])})",
            "  use, intrinsic :: iso_fortran_env, only: dp => real64",
            "  implicit none",
            *lines,
            "end subroutine wear_increment",
        ]
    )
