"""The equations of a model in floats, at many times at once: its rates and its implicit field.

Overview
    Every formula is written in terms of time, states, the implicit field and data, and compiled
    by SymPy; models that differ only in data share the compiled functions.
Key results
    System    rates and root, for the integration of motions
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cache
from typing import Any

import numpy as np
import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.printing.numpy import NumPyPrinter

from ..symbols import t
from .balls import UndecidedError
from .motion import Array


class System:
    """The differential equations of a model, and the equation ``y = G(y)`` of its implicit field.

    ``moving`` are the time, the states and the implicit field, if there is one; ``rates`` are
    those of the states, ``image`` is G, all in terms of ``moving`` and data; ``value`` gives the
    data.
    """

    def __init__(
        self,
        moving: Sequence[sp.Expr],
        rates: Sequence[sp.Expr],
        image: Sequence[sp.Expr],
        value: Callable[[sp.Expr], float],
    ) -> None:
        self._near, self._moving, self._value = np.zeros(1), tuple(moving), value
        self._rates, self._image = self._compile(rates), self._compile(image)
        self._implicit = bool(image)

    def _compile(self, formulas: Sequence[sp.Expr]) -> Callable[..., list[Any]]:
        """Return a function of arrays: of the times, the states, and the implicit field."""
        whole = sp.Tuple(*formulas)
        if whole.has(sp.Integral, sp.Limit, sp.Subs, sp.zoo, sp.nan):
            raise UndecidedError(f"{whole} has no numerical value")
        fields = whole.atoms(AppliedUndef)
        if any(field.args not in ((t,), (0,)) for field in fields):
            raise UndecidedError("a rate that needs another time")
        data = tuple(sorted((fields | whole.atoms(sp.Symbol)) - set(self._moving), key=str))
        values = list(map(self._value, data))
        function = _compiled(tuple(formulas), (*self._moving, *data))
        return lambda *moving: function(*moving, *values)

    def rates(self, times: Array, states: Array) -> Array:
        """Return the rates of the states at times, shape ``(states, times)``."""
        implicit = (self.root(times, states),) if self._implicit else ()
        rates = np.empty((len(states), len(times)))
        with np.errstate(all="ignore"):
            for row, rate in zip(rates, self._rates(times, *states, *implicit), strict=True):
                row[:] = rate
        return rates

    def root(self, times: Array, states: Array) -> Array:
        """Return the root of ``y - G(y)``, an increasing function, at times with given states.

        Newton's method, or bisection if it does not converge; NaN without a root.
        """

        def residual(y: Array) -> Array:
            return np.asarray(y - self._image(times, *states, y)[0])

        y = self._near + 0.0 * times
        with np.errstate(all="ignore"):
            for _ in range(12):
                small = 1e-7 * (1 + np.abs(y))
                now = residual(y)
                step = now * small / (residual(y + small) - now)
                y = y - step
                if np.all(np.abs(step) <= 1e-14 * (1 + np.abs(y))):
                    break
            else:
                low, high = np.full_like(y, -(2.0**40)), np.full_like(y, 2.0**40)
                for _ in range(100):
                    y = (low + high) / 2
                    below = residual(y) < 0
                    low, high = np.where(below, y, low), np.where(below, high, y)
                y = np.where(np.abs(residual(y)) < 1e-6 * (1 + np.abs(y)), y, np.nan)
        self._near = y
        return y


@cache
def _compiled(
    written: tuple[sp.Expr, ...], quantities: tuple[sp.Expr, ...]
) -> Callable[..., list[Any]]:
    names = {quantity: sp.Symbol(f"q_{i}") for i, quantity in enumerate(quantities)}
    printer = _ArgumentPrinter(names)
    return sp.lambdify(list(names.values()), list(written), "numpy", printer=printer, cse=True)


class _ArgumentPrinter(NumPyPrinter):
    """NumPy's printer with arguments in place of quantities, so that no formula is rebuilt."""

    def __init__(self, names: Mapping[sp.Expr, sp.Symbol]) -> None:
        super().__init__({"fully_qualified_modules": False})
        self._names = names

    def _print_Symbol(self, expr: sp.Symbol) -> str:
        return str(self._names.get(expr, expr))

    _print_AppliedUndef = _print_Symbol
