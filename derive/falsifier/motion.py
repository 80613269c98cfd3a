"""Motion: the fields that differential equations determine, by collocation.

Overview
    ``dx/dt = F(t, x)`` is integrated with polynomials through Chebyshev points, by Picard's
    iteration in each step; the width of steps follows from the last coefficients and the speed of
    convergence.  Steps end at the jumps of a load.  The polynomials of states and rates are kept,
    so that fields are known at all times, and their increments to as many digits as the rates.
    The module shares nothing with `wear` or with the rules.
Key results
    Motion            the states of one system, integrated up to the requested times
    rates_in_floats   their rates at many times at once
References
    Trefethen, Approximation Theory and Approximation Practice, chapters 2 and 4.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
import sympy as sp
from numpy.polynomial import chebyshev
from numpy.typing import NDArray
from sympy.core.function import AppliedUndef

from ..memory import cache
from ..symbols import t
from .balls import UndecidedError

Array = NDArray[np.float64]

NODES = 18
_POINTS = np.cos(np.pi * (np.arange(NODES) + 0.5) / NODES)[::-1]
_COEFFICIENTS = np.linalg.inv(chebyshev.chebvander(_POINTS, NODES - 1))
_PRIMITIVE = np.array([chebyshev.chebint(e, lbnd=-1) for e in np.eye(NODES)]) / 2
"""Coefficients of the integrals of the Chebyshev polynomials, in steps of width one."""
_INTEGRAL = chebyshev.chebvander(_POINTS, NODES) @ _PRIMITIVE.T @ _COEFFICIENTS
_GAUSS = np.polynomial.legendre.leggauss(NODES // 2)
"""Exact for the polynomials of the rates."""
_SWEEPS, _FEW = 40, 14
_SETTLED, _LEFT_OUT = 1e-14, 1e-13
MOST_STEPS = 400


class _Step(NamedTuple):
    """An interval of time, with the coefficients of states and rates, ``(NODES, states)``."""

    begin: float
    end: float
    states: Array
    rates: Array


@dataclass(eq=False)
class Motion:
    """States from time zero on; ``spacing`` is the time between jumps of the load, 0 for none."""

    rates: Callable[[Array, Array], Array]
    first: Array
    spacing: float = 0.0
    width: float = 0.25
    _steps: list[_Step] = field(default_factory=list)
    _stuck: bool = False

    @property
    def reached(self) -> float:
        """Return the time up to which the states are known."""
        return self._steps[-1].end if self._steps else 0.0

    def at(self, time: float) -> tuple[Array, Array]:
        """Return the states at a time and their rounding errors; UndecidedError if the time is
        out of reach."""
        begin, end, states, _ = self._steps[self._place(time, time)]
        place = (2 * time - begin - end) / (end - begin)
        return np.asarray(chebyshev.chebval(place, states)), 1e-15 * np.abs(states).sum(axis=0)

    def increment(self, begin: float, width: float) -> Array:
        """Return the increments of the states in a time ``width``; UndecidedError as in ``at``."""
        gain = np.zeros_like(self.first)
        for low, high, _, rates in self._steps[self._place(begin, begin + width) :]:
            first, last = max(0.0, low - begin), min(width, high - begin)
            if last <= first:
                break
            middle, half = begin + (first + last) / 2, (last - first) / 2
            places = (2 * (middle + half * _GAUSS[0]) - low - high) / (high - low)
            gain += half * chebyshev.chebval(places, rates) @ _GAUSS[1]
        return gain

    def _place(self, time: float, latest: float) -> int:
        """Return the place of the step at a time, once all times up to ``latest`` are known."""
        if self.integrate_to(latest) <= latest:
            raise UndecidedError("the fields are not known for so long")
        return bisect_right(self._steps, time, key=lambda step: step.begin) - 1

    def integrate_to(self, time: float) -> float:
        """Integrate to a time, or as far as the steps allow; return the time reached."""
        while self.reached <= time and not self._stuck:
            self._advance()
        return self.reached

    def _advance(self) -> None:
        begin, step = self.reached, self.width
        first = self._steps[-1].states.sum(axis=0) if self._steps else self.first
        while step > 1e-7 * max(1.0, begin) and len(self._steps) < MOST_STEPS:
            if self.spacing:
                left = self.spacing * (1 + np.floor(begin / self.spacing + 1e-9)) - begin
                step = left / np.ceil(left / step)
            with np.errstate(all="ignore"):
                solved, factor = self._solve(begin, step, first)
            if solved is not None:
                self.width = min(factor * step, 2 * max(1.0, begin))
                self._steps.append(solved)
                return
            step *= factor
        self._stuck = True

    def _solve(self, begin: float, width: float, first: Array) -> tuple[_Step | None, float]:
        """Return a step, None if it is too wide, and the factor to the width of the next one.

        The last two coefficients grow like the power NODES - 2 of the width, or faster.
        """
        times = begin + width * (1 + _POINTS) / 2
        states = np.repeat(first[:, None], NODES, axis=1)
        for sweep in range(_SWEEPS):
            rates = self.rates(times, states)
            new = first[:, None] + width * rates @ _INTEGRAL.T
            size = np.abs(new).max(axis=1) + 1e-30
            change, states = (np.abs(new - states).max(axis=1) / size).max(), new
            if not change < np.inf:
                break
            if change <= _SETTLED:
                series = _COEFFICIENTS @ states.T
                last = (np.abs(series[-2:]).max(axis=0) / size).max()
                factor = 0.9 * (_LEFT_OUT / (last + 1e-30)) ** (1 / (NODES - 2))
                if last > _LEFT_OUT:
                    return None, max(0.2, factor)
                solved = _Step(begin, begin + width, series, _COEFFICIENTS @ rates.T)
                return solved, min(1.6, factor) if sweep <= _FEW else min(1.0, factor)
        return None, 0.5


def rates_in_floats(
    states: Sequence[sp.Expr],
    rates: Sequence[sp.Expr],
    formulas: Mapping[sp.Expr, sp.Expr],
    value: Callable[[sp.Expr], float],
) -> Callable[[Array, Array], Array]:
    """Return the rates as a function of the times and of the states, shape ``(states, times)``.

    ``rates`` are expressions in time, states, data, of which ``value`` gives the numbers, and
    other fields and rates, whose ``formulas`` stand after those that they need.
    """
    names = {part: sp.Symbol(f"part_{number}") for number, part in enumerate(formulas)}
    parts = [(name, formulas[part].xreplace(names)) for part, name in names.items()]
    rates = [rate.xreplace(names) for rate in rates]
    whole = sp.Tuple(*rates, *(formula for _, formula in parts))
    if whole.has(sp.Derivative, sp.Integral, sp.Limit, sp.Subs, sp.zoo, sp.nan):
        raise UndecidedError(f"{whole} has no numerical value")
    fields = whole.atoms(AppliedUndef)
    if any(field.args not in ((t,), (0,)) for field in fields):
        raise UndecidedError("a rate that needs another time")
    moving = (t, *states)
    unknown = (fields | whole.atoms(sp.Symbol)) - {*moving, *names.values()}
    data = tuple(sorted(unknown, key=str))
    values = list(map(value, data))
    function = _compiled(tuple(rates), tuple(parts), (*moving, *data))

    def evaluated(times: Array, at: Array) -> Array:
        result = np.empty((len(at), len(times)))
        for row, rate in zip(result, function(times, *at, *values), strict=True):
            row[:] = rate
        return result

    return evaluated


@cache
def _compiled(
    rates: tuple[sp.Expr, ...],
    parts: tuple[tuple[sp.Symbol, sp.Expr], ...],
    names: tuple[sp.Expr, ...],
) -> Callable[..., list[Any]]:
    """Return a function that models with the same equations share; ``parts`` come first."""

    def in_order(whole: list[sp.Expr]) -> tuple[list[tuple[sp.Symbol, sp.Expr]], list[sp.Expr]]:
        shared, known = sp.numbered_symbols("shared_"), []
        for name, formula in parts:
            replaced, (rest,) = sp.cse(formula, shared)
            known += [*replaced, (name, rest)]
        replaced, rest = sp.cse(whole, shared)
        return [*known, *replaced], rest

    return sp.lambdify(names, list(rates), "numpy", cse=in_order, docstring_limit=0)
