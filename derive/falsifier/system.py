"""The equations of a model in floats, at many times all at once: its rates and its loop.

Overview
    Every formula is written in terms of time, states, the loop and data, and compiled by SymPy;
    models that differ in data alone share what is compiled.
Key results
    System    what motions are integrated with
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
from .balls import Undecided
from .motion import Array


class System:
    """The differential equations of a model, and the equation ``y = G(y)`` of its loop.

    ``moving`` are the time, the states and the loop, if there is one; ``rates`` are those of the
    states, ``image`` is G, all in terms of what is moving and of data, which have a ``value``.
    """

    def __init__(
        self,
        moving: Sequence[sp.Expr],
        rates: Sequence[sp.Expr],
        image: Sequence[sp.Expr],
        value: Callable[[sp.Expr], float],
    ) -> None:
        self._near, self._moving, self._value = np.zeros(1), tuple(moving), value
        self._rates, self._image = self._coded(rates), self._coded(image)
        self._loops = bool(image)

    def _coded(self, formulas: Sequence[sp.Expr]) -> Callable[..., list[Any]]:
        """Return a function of arrays: of the times, the states, and the loop."""
        whole = sp.Tuple(*formulas)
        if whole.has(sp.Integral, sp.Limit, sp.Subs, sp.zoo, sp.nan):
            raise Undecided(f"{whole} has no number")
        fields = whole.atoms(AppliedUndef)
        if any(field.args not in ((t,), (0,)) for field in fields):
            raise Undecided("a rate that needs another time")
        data = tuple(sorted((fields | whole.atoms(sp.Symbol)) - set(self._moving), key=str))
        values = list(map(self._value, data))
        function = _compiled(tuple(formulas), (*self._moving, *data))
        return lambda *moving: function(*moving, *values)

    def rates(self, times: Array, states: Array) -> Array:
        """Return the rates of the states at times, shape ``(states, times)``."""
        loop = (self.root(times, states),) if self._loops else ()
        found = np.empty((len(states), len(times)))
        with np.errstate(all="ignore"):
            for row, rate in zip(found, self._rates(times, *states, *loop), strict=True):
                row[:] = rate
        return found

    def root(self, times: Array, states: Array) -> Array:
        """Return the root of ``y - G(y)``, which increases, at times at which states are known:
        by Newton's method, else by halves."""

        def rest(y: Array) -> Array:
            return np.asarray(y - self._image(times, *states, y)[0])

        y = self._near + 0.0 * times
        with np.errstate(all="ignore"):
            for _ in range(12):
                small = 1e-7 * (1 + np.abs(y))
                now = rest(y)
                step = now * small / (rest(y + small) - now)
                y = y - step
                if np.all(np.abs(step) <= 1e-14 * (1 + np.abs(y))):
                    break
            else:
                low, high = np.full_like(y, -(2.0**40)), np.full_like(y, 2.0**40)
                for _ in range(100):
                    y = (low + high) / 2
                    below = rest(y) < 0
                    low, high = np.where(below, y, low), np.where(below, high, y)
                y = np.where(np.abs(rest(y)) < 1e-6 * (1 + np.abs(y)), y, np.nan)
        self._near = y
        return y


@cache
def _compiled(
    written: tuple[sp.Expr, ...], quantities: tuple[sp.Expr, ...]
) -> Callable[..., list[Any]]:
    names = {quantity: sp.Symbol(f"q_{i}") for i, quantity in enumerate(quantities)}
    printer = _Printer(names)
    return sp.lambdify(list(names.values()), list(written), "numpy", printer=printer, cse=True)


class _Printer(NumPyPrinter):
    """Quantities by the names of arguments, so that no formula is built anew with these."""

    def __init__(self, names: Mapping[sp.Expr, sp.Symbol]) -> None:
        super().__init__({"fully_qualified_modules": False})
        self._names = names

    def _print_Symbol(self, expr: sp.Symbol) -> str:
        return str(self._names.get(expr, expr))

    _print_AppliedUndef = _print_Symbol
