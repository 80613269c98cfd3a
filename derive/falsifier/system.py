"""The equations of a model in floats, at many times all at once: its rates and its loop.

Overview
    Every formula is one function of arrays; what a rate rests on is worked out in order, each
    quantity once.
Key results
    System    what motions are integrated with
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
import sympy as sp
from flint import ctx
from sympy.core.function import AppliedUndef

from ..symbols import t
from .balls import BITS, Moment, Undecided, ball, compiled
from .motion import Array

if TYPE_CHECKING:
    from .models import Model

_Line = tuple[int, Callable[..., Any], list[int]]
"""An assignment: the place of a value, a function, and the places of what it is applied to."""


class System:
    """The differential equations of a model, and the equation of its loop."""

    def __init__(self, model: Model) -> None:
        self._model, self._loop = model, model.loop
        self._states, self._near = tuple(model.states), np.zeros(1)
        self._rates = [state.diff(t) for state in self._states]
        self._places: dict[sp.Expr | None, int] = {}
        self._values: list[Any] = []
        for known in (t, *self._states, self._loop):
            self._put(known)
        self._to_root = self._lines([model.values[self._loop]] if self._loop else [])
        self._to_rates = self._lines(self._rates)

    def _put(self, quantity: sp.Expr | None, value: Any = None) -> int:
        self._places[quantity] = place = len(self._values)
        self._values.append(value)
        return place

    def _lines(self, wanted: Iterable[sp.Expr]) -> list[_Line]:
        """Return the assignments that wanted expressions still need."""
        lines: list[_Line] = []

        def visit(quantity: sp.Expr, through: tuple[sp.Expr, ...] = ()) -> None:
            if quantity in through:
                raise Undecided(f"{quantity} rests on itself")
            if quantity in self._places:
                return
            if quantity.is_Symbol or quantity.args == (0,):
                with ctx.workprec(BITS):
                    value = ball(compiled(quantity)(Moment(self._model)))
                self._put(quantity, float(value.mid()))
                return
            function, arguments = _coded(self._formula(quantity))
            for argument in arguments:
                visit(argument, (*through, quantity))
            places = [self._places[argument] for argument in arguments]
            lines.append((self._put(quantity), function, places))

        for quantity in wanted:
            visit(quantity)
        return lines

    def _formula(self, quantity: sp.Expr) -> sp.Expr:
        """Return what a field or a rate is computed from, an expression from itself."""
        field, order = quantity, 0
        if isinstance(quantity, sp.Derivative) and set(quantity.variables) == {t}:
            field, order = quantity.expr, quantity.derivative_count
        if not isinstance(field, AppliedUndef):
            return quantity
        if field.args != (t,):
            raise Undecided("a rate that needs another time")
        return self._model.formula(field, order)

    def _run(self, lines: list[_Line]) -> None:
        values = self._values
        for place, function, places in lines:
            values[place] = function(*[values[at] for at in places])

    def rates(self, times: Array, states: Array) -> Array:
        """Return the rates of the states at times, shape ``(states, times)``."""
        found = np.empty((len(self._rates), len(times)))
        with np.errstate(all="ignore"):
            self.root(times, states)
            self._run(self._to_rates)
        for row, rate in zip(found, self._rates, strict=True):
            row[:] = self._values[self._places[rate]]
        return found

    def root(self, times: Array, states: Array) -> Array:
        """Return the root of ``y - G(y)``, which increases, at times at which states are known:
        by Newton's method, else by halves.  Without a loop it is zero."""
        self._values[: 1 + len(states)] = times, *states
        y = self._near + 0.0 * times
        if self._loop is None:
            return y
        with np.errstate(all="ignore"):
            for _ in range(12):
                small = 1e-7 * (1 + np.abs(y))
                now = self._rest(y)
                step = now * small / (self._rest(y + small) - now)
                y = y - step
                if np.all(np.abs(step) <= 1e-14 * (1 + np.abs(y))):
                    break
            else:
                low, high = np.full_like(y, -(2.0**40)), np.full_like(y, 2.0**40)
                for _ in range(100):
                    y = (low + high) / 2
                    below = self._rest(y) < 0
                    low, high = np.where(below, y, low), np.where(below, high, y)
                y = np.where(np.abs(self._rest(y)) < 1e-6 * (1 + np.abs(y)), y, np.nan)
            self._rest(y)
        self._near = y
        return y

    def _rest(self, y: Array) -> Array:
        """Return ``y - G(y)``."""
        self._values[self._places[self._loop]] = y
        self._run(self._to_root)
        return np.asarray(y - self._values[self._places[self._model.values[self._loop]]])


@cache
def _coded(expr: sp.Expr) -> tuple[Callable[..., Any], tuple[sp.Expr, ...]]:
    """Return a function of arrays that evaluates an expression, and what it is applied to."""
    if expr.has(sp.Integral, sp.Limit, sp.Subs, sp.zoo, sp.nan):
        raise Undecided(f"{expr} has no number")
    parts = (*expr.atoms(AppliedUndef, sp.Derivative), *expr.free_symbols)
    names = {part: sp.Dummy() for part in parts}
    flat = expr.xreplace(names)
    used = tuple(part for part in parts if names[part] in flat.free_symbols)
    return sp.lambdify([names[part] for part in used], flat, "numpy"), used
