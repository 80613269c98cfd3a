"""Motion: the fields that differential equations determine, by collocation.

Overview
    ``dx/dt = F(t, x)`` is integrated with polynomials through Chebyshev points, by Picard's
    iteration in each step; the width of steps follows from the last coefficients and the speed of
    convergence.  Steps end at the jumps of a load.  The polynomials of states and rates are kept,
    so that fields are known at all times, and their increments to as many digits as the rates.
    The module shares nothing with `wear` or with the rules.
Key results
    Motion    the states of one system, integrated up to the requested times
References
    Trefethen, Approximation Theory and Approximation Practice, chapters 2 and 4.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

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
_SWEEPS, _FEW, _HUGE = 40, 14, 1e200
_SETTLED, _LEFT_OUT = 1e-14, 1e-13
_FIRST, MOST_STEPS = 80, 400


@dataclass(eq=False)
class Motion:
    """States from time zero on; ``spacing`` is the time between jumps of the load, 0 for none."""

    rates: Callable[[Array, Array], Array]
    first: Array
    spacing: float = 0.0
    width: float = 0.25
    _times: list[float] = field(default_factory=lambda: [0.0])
    _pieces: list[tuple[Array, Array]] = field(default_factory=list)
    _stuck: bool = False

    @property
    def reached(self) -> float:
        """Return the time up to which the states are known."""
        return self._times[-1]

    def at(self, time: float) -> tuple[Array, Array]:
        """Return the states at a time and their rounding errors; UndecidedError if the time is
        out of reach."""
        if self.integrate_to(time) <= time:
            raise UndecidedError("the fields are not known for so long")
        number = bisect_right(self._times, time) - 1
        begin, end = self._times[number : number + 2]
        place = (2 * time - begin - end) / (end - begin)
        piece = self._pieces[number][0]
        return np.asarray(chebyshev.chebval(place, piece)), 1e-15 * np.abs(piece).sum(axis=0)

    def increment(self, begin: float, width: float) -> Array:
        """Return the increments of the states in a time ``width``; UndecidedError as in ``at``."""
        if self.integrate_to(begin + width) <= begin + width:
            raise UndecidedError("the fields are not known for so long")
        gain = np.zeros_like(self.first)
        for number in range(bisect_right(self._times, begin) - 1, len(self._pieces)):
            low, high = self._times[number : number + 2]
            first, last = max(0.0, low - begin), min(width, high - begin)
            if last <= first:
                break
            middle, half = begin + (first + last) / 2, (last - first) / 2
            places = (2 * (middle + half * _GAUSS[0]) - low - high) / (high - low)
            gain += half * chebyshev.chebval(places, self._pieces[number][1]) @ _GAUSS[1]
        return gain

    def integrate_to(self, time: float) -> float:
        """Integrate to a time, or as far as the steps allow; return the time reached."""
        while self.reached <= time and not self._stuck:
            self._advance()
        return self.reached

    def may_reach(self, time: float) -> bool:
        """Return whether the first steps are wide enough to expect that a time is reached."""
        while self.reached <= time and len(self._pieces) < _FIRST and not self._stuck:
            self._advance()
        return self.reached > time * _FIRST / MOST_STEPS * 1e-3

    def _advance(self) -> None:
        begin, step = self.reached, self.width
        first = self.first if not self._pieces else self._pieces[-1][0].sum(axis=0)
        while step > 1e-7 * max(1.0, begin) and len(self._pieces) < MOST_STEPS:
            if self.spacing:
                step = min(step, self.spacing * (begin // self.spacing + 1) - begin)
            piece, sweeps = self._solve_step(begin, step, first)
            if piece is not None:
                grown = 1.6 * step if sweeps <= _FEW else step
                self.width = min(grown, 2 * max(1.0, begin))
                self._pieces.append(piece)
                self._times.append(begin + step)
                return
            step /= 2
        self._stuck = True

    def _solve_step(
        self, begin: float, step: float, first: Array
    ) -> tuple[tuple[Array, Array] | None, int]:
        """Return the coefficients of states and rates in a step, each of shape
        ``(NODES, states)``, and the number of sweeps; None without convergence."""
        times = begin + step * (1 + _POINTS) / 2
        states = np.repeat(first[:, None], NODES, axis=1)
        for sweep in range(_SWEEPS):
            rates = self.rates(times, states)
            if not (np.abs(rates) < _HUGE).all():
                break
            new = first[:, None] + step * rates @ _INTEGRAL.T
            size = np.abs(new).max(axis=1) + 1e-30
            change, states = (np.abs(new - states).max(axis=1) / size).max(), new
            if change <= _SETTLED:
                piece = _COEFFICIENTS @ states.T
                rest = np.abs(piece[-2:]).max(axis=0) / size
                resolved = rest.max() <= _LEFT_OUT
                return ((piece, _COEFFICIENTS @ rates.T) if resolved else None), sweep
        return None, _SWEEPS
