"""Programs: what a variant computes, as short lists of named assignments.

Overview
    The derived relations of a variant (closure, roughness, pressure at given wear) become
    functions of numbers.  Intermediates keep the names of the field.  What does not change
    during a run is hoisted into named constants.  Slopes follow by the chain rule from one
    assignment to the next, so that they share the intermediates.
Key results
    Function    arguments, assignments, results
    Program     the functions and constants of one variant
    program     the program of a variant
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cache

import sympy as sp

from .laws import r
from .note.condensed import Condensed
from .note.governing import Pin
from .stable import released, stable
from .statement import Statement, given
from .symbols import QUANTITIES, symbols
from .variant import Variant

Assignment = tuple[sp.Symbol, sp.Expr]

u, load, pressure = sp.symbols("u U_a p", real=True)
"""The state u_c, the prescribed displacement, and the unknown of a compliant support."""

ratio = sp.Symbol("ratio", real=True)
"""Closure over equivalent roughness."""

kappa, K_a, K_c, H_a, H_c, k, p_max, V = symbols("kappa K_a K_c H_a H_c k p_max V")
f_a, h_0, T = symbols("f_a h_0 T")
_FIELDS = symbols("u_a sigma_a sigma_c sigma h U_c p")


@dataclass(frozen=True)
class Function:
    """A generated function: ``results`` in terms of arguments, constants and ``assignments``."""

    name: str
    arguments: tuple[sp.Symbol, ...]
    assignments: tuple[Assignment, ...]
    results: tuple[sp.Expr, ...]
    meaning: str

    @staticmethod
    def made(
        name: str,
        arguments: tuple[sp.Symbol, ...],
        assignments: Sequence[Assignment],
        results: tuple[sp.Expr, ...],
        meaning: str,
    ) -> Function:
        """Make a function, leaving out the assignments that its results do not need."""
        needed = set().union(*(result.free_symbols for result in results))
        kept: list[Assignment] = []
        for symbol, value in reversed(assignments):
            if symbol in needed:
                kept.append((symbol, value))
                needed |= value.free_symbols
        return Function(name, arguments, tuple(reversed(kept)), results, meaning)

    @property
    def operations(self) -> int:
        """Return how many arithmetic operations one call costs, functions counted as one."""
        expressions = [value for _, value in self.assignments] + list(self.results)
        return sum(int(expr.count_ops()) for expr in expressions)

    def composed(self) -> tuple[sp.Expr, ...]:
        """Return the results with every assignment inserted, exponents not held: the exact form."""
        results = self.results
        for name, value in reversed(self.assignments):
            results = tuple(result.xreplace({name: released(value)}) for result in results)
        return results


@dataclass(frozen=True)
class Program:
    """All that is generated for one variant.

    ``constants`` are computed once, by ``bind``, from ``parameters``.
    """

    variant: Variant
    parameters: tuple[sp.Symbol, ...]
    constants: tuple[Assignment, ...]
    functions: tuple[Function, ...]
    fields: tuple[str, ...]

    @property
    def exact_constants(self) -> dict[sp.Symbol, sp.Expr]:
        """Return every constant in terms of the parameters alone."""
        values: dict[sp.Symbol, sp.Expr] = {}
        for name, expr in self.constants:
            values[name] = expr.xreplace(values)
        return values


# What is hoisted out of a run.  A hoisted expression without a name here is an error.
largest_rate, wear_per_pressure, gain, slope_a, compliance = (
    sp.Symbol(name, real=True)
    for name in ("largest_rate", "wear_per_pressure", "gain", "slope_a", "compliance")
)


def _groups(variant: Variant) -> tuple[Assignment, ...]:
    """Return the named constants of a run: each a combination of parameters."""
    model = variant.model
    archard = model.wear_laws[2].substitute(model.slip).claim.rhs / symbols("p")[0]
    sign = 1 if variant.opening else -1
    groups: list[Assignment] = []
    if variant.pin.wears:
        groups += [(kappa, _kappa().claim.rhs), (gain, 1 + sign * kappa)]
    if variant.pin is Pin.WORN_ROUGH:
        groups.append((slope_a, f_a * kappa))
    if variant.compliant:
        groups += [(compliance, 1 / k), (wear_per_pressure, archard)]
    else:
        groups.append((largest_rate, archard * p_max))
    return tuple(groups)


def _kappa() -> Statement:
    """The wear of the pin per wear of the bearing."""
    return given(sp.Eq(kappa, K_a * H_c / (K_c * H_a)), "definition of kappa", kappa)


def _plain(expr: sp.Expr) -> sp.Expr:
    """Replace functions of time by the plain symbols of the program."""
    names = {"u_c": u, "U_a": load, "p": pressure}
    fields = [f for f in expr.atoms(sp.Function) if f.func.__name__ in QUANTITIES]
    return expr.xreplace(
        {f: names.get(f.func.__name__, sp.Symbol(f.func.__name__, real=True)) for f in fields}
    )


def _hoisted(expr: sp.Expr, variant: Variant) -> sp.Expr:
    """Write an expression that is a polynomial in the state with hoisted coefficients."""
    groups = [(name, value) for name, value in _groups(variant) if name is not kappa]
    collected = sp.collect(sp.expand(expr), u)
    for name, value in groups:
        collected = collected.subs(value, name)
    return collected


@dataclass(frozen=True)
class _Derived:
    """The relations of a variant in the program's symbols."""

    variant: Variant

    @property
    def condensed(self) -> Condensed:
        return Condensed(self.variant.model)

    def wear_of_pin(self) -> Statement:
        worn = self.variant.model.wear_of_pin
        return worn.substitute(_kappa().solve_for(K_a)) if self.variant.pin.wears else worn

    def pin_wear(self) -> sp.Expr:
        return _plain(self.wear_of_pin().claim.rhs)

    def roughnesses(self) -> tuple[Assignment, ...]:
        """Assignments of sigma_a, sigma_c (where there are two) and sigma."""
        model, pin = self.variant.model, self.variant.pin
        bearing = _plain(model.roughness_of_bearing.claim.rhs)
        if not pin.rough:
            return ((_symbol("sigma"), bearing),)
        rough = model.roughness_of_pin
        if pin.wears:
            rough = rough.substitute(self.wear_of_pin())
        own = _hoisted(_plain(rough.claim.rhs), self.variant)
        parts: tuple[Assignment, ...] = ((_symbol("sigma_c"), bearing),)
        if pin.wears:
            parts = ((_symbol("sigma_a"), own), *parts)
        combined = _plain(model.roughness.claim.rhs)
        if not pin.wears:
            combined = combined.subs(_symbol("sigma_a"), own)
        return (*parts, (_symbol("sigma"), combined))

    def closure(self, deflected: bool) -> Assignment:
        """Assignment of h; the undeflected one is that of a rigid support."""
        model = self.variant.model
        deflection = self.condensed.deflection
        if not deflected:
            deflection = deflection.limit(k, sp.oo)
        closed = model.closure.substitute(self.wear_of_pin()).substitute(deflection)
        expr = _plain(closed.claim.rhs)
        return _symbol("h"), _hoisted(expr, self.variant).subs(1 / k, compliance)


def _symbol(name: str) -> sp.Symbol:
    return sp.Symbol(name, real=True)


def _slope_name(name: sp.Symbol) -> sp.Symbol:
    return sp.Symbol(f"{name}_u", real=True)


def _derivative(expr: sp.Expr, variable: sp.Symbol, slopes: dict[sp.Symbol, sp.Symbol]) -> sp.Expr:
    """Return d expr/d variable by the chain rule, given the slopes of intermediates."""
    inner = (sp.diff(expr, name) * slope for name, slope in slopes.items())
    return sp.Add(sp.diff(expr, variable), *inner)


def _with_slopes(
    assignments: Iterable[Assignment],
) -> tuple[tuple[Assignment, ...], dict[sp.Symbol, sp.Symbol]]:
    """Follow each assignment by that of its derivative with respect to u, where it has one."""
    made: list[Assignment] = []
    slopes: dict[sp.Symbol, sp.Expr] = {}
    for name, expr in assignments:
        made.append((name, expr))
        slope = _tidy(_derivative(expr, u, slopes), name, expr)
        if slope == 0:
            continue
        if slope.is_Atom:
            slopes[name] = slope
        else:
            slopes[name] = _slope_name(name)
            made.append((slopes[name], slope))
    return tuple(made), slopes


def _tidy(slope: sp.Expr, name: sp.Symbol, expr: sp.Expr) -> sp.Expr:
    """Reuse a root or a quotient that has a name already."""
    root = expr.is_Pow and expr.exp == sp.Rational(1, 2)
    quotient = expr.is_Mul and not expr.as_numer_denom()[1].is_number
    return sp.factor_terms(slope.subs(expr, name) if root or quotient else slope)


@cache
def program(variant: Variant) -> Program:
    """Return the program of a variant."""
    derived = _Derived(variant)
    functions = _compliant(derived) if variant.compliant else _rigid(derived)
    if variant.cutoff:
        functions = (*functions, *_margin(derived))
    if variant.cutoff and variant.compliant:
        functions = (*functions, *_limited(derived))
    fields = _fields(derived)
    functions = (*functions, fields)
    constants = _constants(variant, functions)
    used = set().union(*(expr.free_symbols for _, expr in constants))
    parameters = sorted(used - {name for name, _ in _groups(variant)}, key=_order)
    return Program(
        variant,
        tuple(parameters),
        constants,
        functions,
        tuple(str(f.func) for f in _FIELDS if str(f.func) in _field_names(variant)),
    )


def _order(parameter: sp.Symbol) -> int:
    return list(QUANTITIES).index(parameter.name)


def _constants(variant: Variant, functions: Sequence[Function]) -> tuple[Assignment, ...]:
    """Return the constants that the functions use: groups, and parameters as they are."""
    groups = _groups(variant)
    used: set[sp.Symbol] = set()
    for function in functions:
        local = {name for name, _ in function.assignments} | set(function.arguments)
        expressions = [value for _, value in function.assignments] + list(function.results)
        used |= set().union(*(e.free_symbols for e in expressions)) - local
    needed = {name for name, _ in groups if name in used}
    for name, value in reversed(groups):
        if name in needed:
            needed |= value.free_symbols & {kappa}
    hoisted = tuple((name, value) for name, value in groups if name in needed)
    plain = sorted(used - {name for name, _ in groups}, key=_order)
    return (*((name, name) for name in plain), *hoisted)


def _law(variant: Variant) -> tuple[tuple[Assignment, ...], sp.Expr, sp.Expr]:
    """Return the law's intermediates, value and slope at ``ratio``."""
    row = stable(variant.law)
    names = tuple((name, expr.subs(r, ratio)) for name, expr in row.names)
    return names, row.value.subs(r, ratio), row.slope.subs(r, ratio)


def _to_ratio(derived: _Derived, deflected: bool) -> tuple[Assignment, ...]:
    h, sigma = _symbol("h"), _symbol("sigma")
    return (*derived.roughnesses(), derived.closure(deflected), (ratio, h / sigma))


def _rigid(derived: _Derived) -> tuple[Function, ...]:
    names, value, slope = _law(derived.variant)
    start = _to_ratio(derived, deflected=False)
    with_slopes, slopes = _with_slopes(start)
    return (
        Function.made(
            "rate",
            (u, load),
            (*start, *names),
            (largest_rate * value,),
            "wear rate of the bearing, du_c/dt, in mm/s",
        ),
        Function.made(
            "slope",
            (u, load),
            (*with_slopes, *names),
            (largest_rate * slope * slopes[ratio],),
            "derivative of the wear rate with respect to u_c, in 1/s",
        ),
    )


def _compliant(derived: _Derived) -> tuple[Function, ...]:
    names, value, slope = _law(derived.variant)
    start = _to_ratio(derived, deflected=True)
    free = _to_ratio(derived, deflected=False)[:-1]
    with_slopes, slopes = _with_slopes(start)
    sigma, h = _symbol("sigma"), _symbol("h")
    stiffening = (_symbol("residual_p"), 1 - p_max * slope * compliance / sigma)
    # at the pressure with this h/sigma, or the nearest one in [0, p_max], the residual is
    # negative and concave from there to the root, or positive and convex
    inflection = derived.variant.law.inflection
    ratio_at_start = inflection if inflection.is_finite else sp.Integer(0)
    guess = sp.Max(0, sp.Min((ratio_at_start * sigma - h) / compliance, p_max))
    at = (pressure, u, load)
    return (
        Function.made(
            "residual",
            at,
            (*start, *names),
            (pressure - p_max * value,),
            "what the contact pressure p must make zero, in MPa",
        ),
        Function.made(
            "residual_slope",
            at,
            (*start, *names),
            (stiffening[1],),
            "derivative of the residual with respect to p",
        ),
        Function.made(
            "start",
            (u, load),
            free,
            (guess,),
            "pressure from which Newton's iteration converges monotonically, in MPa",
        ),
        Function.made(
            "rate",
            (pressure,),
            (),
            (wear_per_pressure * pressure,),
            "wear rate of the bearing, du_c/dt, in mm/s",
        ),
        Function.made(
            "slope",
            at,
            (*with_slopes, *names, stiffening),
            (wear_per_pressure * p_max * slope * slopes[ratio] / stiffening[0],),
            "derivative of the wear rate with respect to u_c at the root, in 1/s",
        ),
    )


def _margin(derived: _Derived) -> tuple[Function, ...]:
    sigma, h = _symbol("sigma"), _symbol("h")
    start = (*derived.roughnesses(), derived.closure(deflected=False))
    with_slopes, slopes = _with_slopes(start)
    cutoff = derived.variant.law.cutoff
    return (
        Function.made(
            "margin",
            (u, load),
            start,
            (cutoff * sigma - h,),
            "3 sigma - h with an undeflected support, in mm: contact where it is not negative",
        ),
        Function.made(
            "margin_slope",
            (u,),
            with_slopes,
            (cutoff * slopes.get(sigma, 0) - slopes[h],),
            "derivative of the margin with respect to u_c; with respect to U_a it is 1",
        ),
    )


def _limited(derived: _Derived) -> tuple[Function, Function]:
    """The pressure with cutoff: the support lets go no further than to h = 3 sigma."""
    sigma, h = _symbol("sigma"), _symbol("h")
    cutoff = derived.variant.law.cutoff
    start = (*derived.roughnesses(), derived.closure(deflected=False))
    with_slopes, slopes = _with_slopes(start)
    return (
        Function.made(
            "limited",
            (pressure, u, load),
            start,
            (sp.Min(pressure, sp.Max(0, (cutoff * sigma - h) / compliance)),),
            "contact pressure with cutoff, from the root of the residual, in MPa",
        ),
        Function.made(
            "limited_slope",
            (u,),
            with_slopes,
            (wear_per_pressure * (cutoff * slopes.get(sigma, 0) - slopes[h]) / compliance,),
            "derivative of the wear rate with respect to u_c while h stays at 3 sigma, in 1/s",
        ),
    )


def _field_names(variant: Variant) -> tuple[str, ...]:
    names = ["sigma_c", "sigma", "h", "p"]
    names += ["u_a"] * variant.pin.wears + ["sigma_a"] * variant.pin.rough
    return tuple(names + ["U_c"] * variant.compliant)


def _fields(derived: _Derived) -> Function:
    variant = derived.variant
    names, value, _ = _law(variant)
    assignments = list(_to_ratio(derived, deflected=variant.compliant))
    if variant.pin is Pin.ROUGH:
        assignments.insert(0, (_symbol("sigma_a"), symbols("sigma_a0")[0]))
    values: dict[str, sp.Expr] = {name: _symbol(name) for name in ("sigma_a", "sigma_c")}
    if not variant.pin.rough:
        values["sigma_c"] = _symbol("sigma")
    values |= {"sigma": _symbol("sigma"), "h": _symbol("h"), "u_a": derived.pin_wear()}
    values |= {"p": pressure if variant.compliant else p_max * value, "U_c": compliance * pressure}
    order = [str(f.func) for f in _FIELDS if str(f.func) in _field_names(variant)]
    if variant.compliant:
        arguments: tuple[sp.Symbol, ...] = (pressure, u, load)
    else:
        arguments = (u, load)
    return Function.made(
        "fields",
        arguments,
        (*assignments, *names),
        tuple(values[name] for name in order),
        "every field at given wear and load, in mm and MPa",
    )
