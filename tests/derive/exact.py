"""A judge of generated code: 50-digit values of a program's functions, and how far off is far.

Every value is that of the exact form, everything inserted into everything.  It comes with the sum
of its absolute terms, |f| + sum |x df/dx| over all names x on the way to it: arguments, constants
and intermediates.  That is what one unit of roundoff in each of them can make of it.
"""

from __future__ import annotations

import math
import random
import tempfile
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

import mpmath
import sympy as sp

from derive.codegen.sources import source
from derive.laws import unclamped
from derive.program import Program, program
from derive.program.function import Function
from derive.variant import VARIANTS, Variant
from tests.programs import module

UNITS = 8
ROUNDOFF = 2.0**-53
#: Where doubles lose digits to underflow, times the largest factor that a function may have.
FLOOR = 1e-290
DIGITS = 50


class Judged(NamedTuple):
    """An exact value, and the error that is one unit of roundoff."""

    value: mpmath.mpf
    unit: mpmath.mpf

    def units(self, computed: float) -> float:
        """Return the error of a computed value in units."""
        if math.isinf(computed) or math.isnan(computed):
            return math.inf
        return float(max(abs(mpmath.mpf(computed) - self.value) - FLOOR, 0) / self.unit)


class Dual(NamedTuple):
    """A value with its derivatives by name."""

    value: mpmath.mpf
    slopes: dict[str, mpmath.mpf]


@cache
def made(variant: Variant) -> Program:
    """Return the program of a variant, once."""
    return program(variant)


@cache
def composed(function: Function) -> tuple[sp.Expr, ...]:
    """Return the results of a function, every assignment inserted, exponents not held."""
    results = function.results
    for name, value in reversed(function.assignments):
        results = tuple(result.xreplace({name: unclamped(value)}) for result in results)
    return results


def exact_constants(made: Program) -> dict[sp.Symbol, sp.Expr]:
    """Return every constant of a program in terms of the parameters alone."""
    values: dict[sp.Symbol, sp.Expr] = {}
    for name, expr in made.constants:
        values[name] = expr.xreplace(values)
    return values


def variant_of(law: str, name: str) -> Variant:
    """Return the variant of a name."""
    return next(v for v in VARIANTS if v.law.name == law and v.name == name)


def judge(function: Function, values: Mapping[str, float]) -> list[Judged]:
    """Evaluate the results of a function where its arguments and constants have these values.

    Absolute terms are those of sum |x df/dx|: derivatives go back from a result, line by line.
    """
    with mpmath.workdps(DIGITS):
        known = {name: mpmath.mpf(value) for name, value in values.items()}
        lines = []
        for name, expr in function.assignments:
            line = _evaluate(unclamped(expr), known)
            known[name.name] = line.value
            lines.append((name.name, line.slopes))
        found = []
        for result in function.results:
            value, total = _evaluate(result, known)
            for name, slopes in reversed(lines):
                if name in total:
                    for inner, slope in slopes.items():
                        total[inner] = total.get(inner, mpmath.mpf(0)) + total[name] * slope
            found.append(Judged(value, _unit(value, _terms(total, known))))
        return found


def judge_expression(expr: sp.Expr, values: Mapping[str, float]) -> Judged:
    """Evaluate an expression that is computed in one line."""
    with mpmath.workdps(DIGITS):
        numbers = {name: mpmath.mpf(value) for name, value in values.items()}
        found = _evaluate(expr, numbers)
        return Judged(found.value, _unit(found.value, _terms(found.slopes, numbers)))


def _unit(value: mpmath.mpf, terms: mpmath.mpf) -> mpmath.mpf:
    return (abs(value) + terms) * ROUNDOFF + mpmath.mpf(FLOOR)


def _evaluate(expr: sp.Expr, values: Mapping[str, mpmath.mpf]) -> Dual:
    if isinstance(expr, sp.Symbol):
        return Dual(values[expr.name], {expr.name: mpmath.mpf(1)})
    if expr.is_number:
        return Dual(expr._to_mpmath(mpmath.mp.prec), {})
    parts = [_evaluate(argument, values) for argument in expr.args]
    numbers = [part.value for part in parts]
    if expr.is_Add:
        return _combined(mpmath.fsum(numbers), parts, [mpmath.mpf(1)] * len(parts))
    if expr.is_Mul:
        others = [mpmath.fprod(numbers[:i] + numbers[i + 1 :]) for i in range(len(parts))]
        return _combined(mpmath.fprod(numbers), parts, others)
    if isinstance(expr, sp.exp):
        value = mpmath.exp(numbers[0])
        return _combined(value, parts, [value])
    if isinstance(expr, sp.log):
        return _combined(mpmath.log(numbers[0]), parts, [1 / numbers[0]])
    if isinstance(expr, sp.Abs):
        return _combined(abs(numbers[0]), parts, [mpmath.sign(numbers[0])])
    if expr.is_Pow:
        base, exponent = numbers
        value = mpmath.power(base, exponent)
        return _combined(value, parts[:1], [exponent * mpmath.power(base, exponent - 1)])
    if isinstance(expr, (sp.Min, sp.Max)):
        choose = min if isinstance(expr, sp.Min) else max
        value = choose(numbers)
        names = set().union(*(part.slopes for part in parts))
        return Dual(  # an error of any of them can reach the result
            value, {n: max(abs(part.slopes.get(n, 0)) for part in parts) for n in sorted(names)}
        )
    raise TypeError(f"{type(expr).__name__} in {expr}")


def _terms(slopes: Mapping[str, mpmath.mpf], values: Mapping[str, mpmath.mpf]) -> mpmath.mpf:
    return mpmath.fsum((values[name] * slope for name, slope in slopes.items()), absolute=True)


def _combined(value: mpmath.mpf, parts: list[Dual], factors: list[mpmath.mpf]) -> Dual:
    slopes: dict[str, mpmath.mpf] = {}
    for part, factor in zip(parts, factors, strict=True):
        for name, slope in part.slopes.items():
            slopes[name] = slopes.get(name, mpmath.mpf(0)) + factor * slope
    return Dual(value, slopes)


def dual(expr: sp.Expr, values: Mapping[str, mpmath.mpf]) -> Dual:
    """Evaluate an expression and its derivatives, with digits to lose to cancellation."""
    with mpmath.workdps(3 * DIGITS):
        return _evaluate(expr, dict(values))


def exact_values(variant: Variant, at: Point) -> dict[str, mpmath.mpf]:
    """Return the constants of a run without rounding, and the state."""
    parameters = {name: mpmath.mpf(value) for name, value in at.numbers.items()}
    with mpmath.workdps(3 * DIGITS):
        constants = {
            name.name: _evaluate(expr, parameters).value
            for name, expr in exact_constants(made(variant)).items()
        }
    return constants | {name: mpmath.mpf(value) for name, value in at.state.items()}


def judge_root(residual: Function, values: Mapping[str, float]) -> Judged:
    """Evaluate the contact pressure on a compliant support; ``values['p']`` is near it.

    Its absolute terms are those of the residual, seen from the pressure.
    """
    with mpmath.workdps(DIGITS):
        numbers = {name: mpmath.mpf(value) for name, value in values.items()}
        for _ in range(8):  # from a few digits on Newton's iteration doubles them
            found = _evaluate(composed(residual)[0], numbers)
            steepness = found.slopes["p"]
            step = found.value / steepness
            numbers["p"] -= step
        assert abs(step) <= abs(numbers["p"]) * mpmath.mpf(10) ** -40
        return Judged(numbers["p"], judge(residual, numbers)[0].unit / steepness)


# Points


class Point(NamedTuple):
    """Physical parameters, the sign of pin wear, and where to evaluate: u, U_a and, with a
    compliant support, p, h/sigma without deflection and the support's deflection per pressure over
    sigma; the margin, its slope, compliance and wear rate per pressure."""

    parameters: dict[str, float]
    pin_wear_sign: float
    u: float
    U_a: float
    p: float
    undeflected: float
    softness: float
    margin: float
    margin_slope: float
    compliance: float
    wear_per_pressure: float

    @property
    def numbers(self) -> dict[str, float]:
        """All that `bind` depends on, by name."""
        return {**self.parameters, "pin_wear_sign": self.pin_wear_sign}

    @property
    def state(self) -> dict[str, float]:
        """Every argument that a generated function may have, by name."""
        given = ("parameters", "pin_wear_sign")
        return {name: value for name, value in self._asdict().items() if name not in given}


def point(
    variant: Variant,
    generator: random.Random,
    argument: float,
    vanishing: bool = False,
) -> Point:
    """Draw a point at which the argument of tanh, 4 - 2 h/sigma, is about ``argument``.

    ``vanishing``: the roughness of the bearing has nearly worn off.
    """

    def between(low: float, high: float) -> float:
        return math.exp(generator.uniform(math.log(low), math.log(high)))

    everything = {
        "h_0": between(1e-5, 1e-2),
        "sigma_a0": between(1e-7, 1e-3),
        "sigma_c0": between(1e-7, 1e-3),
        "f_a": generator.uniform(-0.05, 0.6),
        "f_c": generator.uniform(-0.05, 0.6),
        "K_c": between(1e-9, 1e-1),
        "H_a": between(10, 1e4),
        "H_c": between(10, 1e4),
        "p_max": between(1, 3e3),
        "k": between(1, 1e12),
        "R": between(0.1, 1e3),
        "n": between(0.1, 1e5),
    }
    kappa = between(1e-2, 30)
    everything["K_a"] = kappa * everything["K_c"] * everything["H_a"] / everything["H_c"]
    u = between(1e-12, 1e-2)
    if vanishing:
        everything["f_c"] = -between(1e-3, 0.5)
        u = everything["sigma_c0"] / -everything["f_c"] * (1 - between(1e-4, 1e-1))
    elif everything["f_c"] < 0:
        u = min(u, 0.9 * everything["sigma_c0"] / -everything["f_c"])
    bearing = everything["sigma_c0"] + everything["f_c"] * u
    pin = 0.0
    if variant.pin.rough:
        pin = everything["sigma_a0"] + everything["f_a"] * kappa * u * variant.pin.wears
    sign = generator.choice((1.0, -1.0))
    gain = 1.0 + kappa * sign if variant.pin.wears else 1.0
    sigma = math.hypot(bearing, pin)
    closure = (2.0 - argument / 2.0) * sigma
    pressure = everything["p_max"] * between(1e-12, 1)
    deflection = pressure / everything["k"] if variant.compliant else 0.0
    load = everything["h_0"] + gain * u + deflection - closure
    names = [parameter.name for parameter in made(variant).parameters]
    return Point(
        {name: everything[name] for name in names},
        sign,
        u,
        load,
        pressure,
        (closure - deflection) / sigma,
        1.0 / (everything["k"] * sigma),
        3.0 * sigma - closure + deflection,
        generator.uniform(-4.0, 4.0),
        1.0 / everything["k"],
        between(1e-12, 1e-3),
    )


def points(variant: Variant, count: int, seed: int = 0) -> list[Point]:
    """Draw points from everywhere, the extremes of the argument first."""
    generator = random.Random(f"{variant.law.name}/{variant.name}/{seed}")
    arguments = [-700.0, 700.0, -30.0, -1.0, 0.0, 1.0, 20.0]
    arguments += [generator.uniform(-40, 40) for _ in range(count - len(arguments))]
    return [
        point(variant, generator, argument, vanishing=index % 5 == 4)
        for index, argument in enumerate(arguments)
    ]


def inputs(function: Function, at: Point, constants: Mapping[str, float]) -> dict[str, float]:
    """Return the value of every symbol of a function at a point."""
    arguments = {a.name: at.state[a.name] for a in function.arguments}
    return {**constants, **arguments}


@cache
def module_of(variant: Variant) -> ModuleType:
    """Return the free-standing NumPy source of a variant as a module."""
    return loaded(source(made(variant), "numpy"))


def loaded(text: str) -> ModuleType:
    """Return a source that the project has written as a module."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "written.py"
        path.write_text(text)
        return module(path)


def bound(module: ModuleType, at: Point) -> Any:
    """Return the constants of a generated module at a point."""
    parameters = module.Parameters(**{n: at.parameters[n] for n in module.Parameters._fields})
    return module.bind(parameters, *[at.pin_wear_sign] * ("K_a" in module.Parameters._fields))
