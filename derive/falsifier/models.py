"""Models: data, and fields over time, of which every hypothesis can be asked whether it holds.

Overview
    A model gives a number to every datum and a function of time to every field: an explicit
    one, one computed from other fields, or the solution of a differential equation.  A field
    that rests on itself, as the pressure on a support does, is the root of its equation.
Key results
    Model    what balls.py evaluates in
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
import sympy as sp
from flint import arb, ctx, fmpq
from sympy.core.function import AppliedUndef

from ..symbols import t
from . import trend
from .balls import BITS, Moment, Number, Undecided, Undefined, ball, compiled, fraction
from .motion import Motion

_FACTORS = ((1, 5), (1.3, 21), (1.9, 37), (2.7, 58), (3.9, 83))
"""Times of a window: a factor, and a phase in hundredths of the period."""
_EARLY = (0, 137, 620, 1210, 2870)
"""Times at which what is claimed for all times is tried, in thousandths of the period."""
_LATE = (10**2, 3 * 10**5)
_FAR, _FARTHEST = 10**5, 10**8
"""Periods after which trends are read, and refusals confirmed."""
_TRUSTED = arb(10) ** -12
"""Relative error of a state."""

Windows = list[list[arb]]
Items = tuple[tuple[Any, sp.Expr], ...]


@dataclass(eq=False)
class Model:
    """One model.  ``data``, ``fields`` and ``rates`` may be defined in terms of one another;
    ``loops``: what ``y = G(y)`` defines; ``corner``: the spacing of the load's jumps, or 0."""

    data: Mapping[sp.Symbol, sp.Expr]
    fields: Mapping[str, sp.Expr]
    rates: Mapping[str, sp.Expr] = field(default_factory=dict)
    start: Mapping[str, sp.Expr] = field(default_factory=dict)
    loops: Mapping[str, sp.Expr] = field(default_factory=dict)
    corner: sp.Expr = sp.S.Zero
    period: fmpq = field(default_factory=lambda: fmpq(1))

    def __post_init__(self) -> None:
        self.rates = dict(sorted(self.rates.items()))
        self._known: dict[object, Number] = {}
        self._formulas: dict[tuple[str, int], sp.Expr] = {}
        self._windows: dict[tuple[sp.Limit, int], Windows] = {}

    @property
    def times(self) -> tuple[fmpq, ...]:
        """Return the times at which claims for all times are tried."""
        reached = float(self.motion.reached) if self.rates else float("inf")
        late = (self.period * (fmpq(at) + fmpq(43, 100)) for at in _LATE)
        early = (self.period * fmpq(at, 1000) for at in _EARLY)
        return (*early, *(at for at in late if float(arb(at)) < reached))

    def constant(self, symbol: sp.Symbol) -> Number:
        """Return a datum; one that others define is computed from them."""
        key = (symbol, ctx.prec)
        if key not in self._known:
            if symbol not in self.data:
                raise Undecided(f"{symbol} is not in the model")
            self._known[key] = compiled(self.data[symbol], t)(Moment(self))
        return self._known[key]

    def field(self, name: str, at: Number, order: int = 0) -> Number:
        """Return a field at a time, or its derivative of an order."""
        key = (name, order, at, ctx.prec) if isinstance(at, fmpq) else None
        if key in self._known:
            return self._known[key]
        if order == 0 and name in self.rates:
            value = self._state(name, at)
        else:
            value = self._evaluated(name, at, order)
        if key is not None:
            self._known[key] = value
        return value

    def _evaluated(self, name: str, at: Number, order: int) -> Number:
        if name in self.loops:
            return self._looped(name, float(arb(at)), order)
        try:
            return compiled(self.formula(name, order), t)(Moment(self, at))
        except Undefined as reason:
            if order == 0:
                raise
            raise Undecided(f"{name} has no slope") from reason

    def _looped(self, name: str, at: float, order: int) -> arb:
        """Return what a loop of equations defines, or its slope, by differences."""
        if order > 1:
            raise Undecided("a loop differentiated twice")
        step = float(arb(self.period)) / 1000
        times = at + step * np.array([0.0] if order == 0 else [-2.0, -1.0, 1.0, 2.0])
        states = (
            [self.motion.at(time)[0] for time in times]
            if self.rates
            else [np.zeros(0)] * len(times)
        )
        present = Present(self)
        present.time, present.states = times, np.array(states).T
        y = np.broadcast_to(present.field(name, times), times.shape)
        if not np.all(np.isfinite(y)):
            raise Undecided("a loop without a root")
        if order == 0:
            return arb(float(y[0]), 1e-11 * abs(float(y[0])) + 1e-14)
        slope = float(y[0] - 8 * y[1] + 8 * y[2] - y[3]) / (12 * step)
        return arb(slope, 1e-6 * (abs(slope) + float(np.max(np.abs(y)))))

    def _state(self, name: str, at: Number) -> Number:
        if at == 0:
            return compiled(self.start[name], t)(Moment(self))
        values, rounding = self.motion.at(float(arb(at)))
        number = list(self.rates).index(name)
        value = arb(float(values[number]))
        return value + arb(0, (abs(value) * _TRUSTED + float(rounding[number])).upper())

    def formula(self, name: str, order: int) -> sp.Expr:
        """Return what a field, or its derivative, is computed from; jumps have no slope."""
        if (name, order) not in self._formulas:
            book = self.fields if order == 0 else self.rates
            if name in book and order <= 1:
                found = book[name]
            elif order == 0:
                raise Undecided(f"{name} is not in the model")
            else:
                before = self.formula(name, order - 1)
                steps = {step: sp.Dummy() for step in before.atoms(sp.floor)}
                back = {dummy: step for step, dummy in steps.items()}
                found = sp.diff(before.xreplace(steps), t).xreplace(back)
            self._formulas[name, order] = found
        return self._formulas[name, order]

    @cached_property
    def motion(self) -> Motion:
        """The states over time: one motion for all models that agree in what they rest on."""
        waiting = [*self.rates.values(), *self.start.values(), *self.loops.values(), self.corner]
        known = (*self.data.items(), *self.fields.items())
        seen = set[object]()
        while waiting:
            for atom in _unknowns(waiting.pop()) - seen:
                seen.add(atom)
                waiting += [value for name, value in known if name == atom]
        books: tuple[Mapping[Any, sp.Expr], ...] = (
            {k: v for k, v in self.data.items() if k in seen},
            {k: v for k, v in self.fields.items() if k in seen},
            self.rates,
            self.start,
            self.loops,
        )
        parts = (tuple(sorted(book.items(), key=str)) for book in books)
        return _integrated(*parts, self.corner, self.period)

    def integrated(self) -> Motion:
        """Return the states over time, at their start."""
        with ctx.workprec(BITS):
            first = [
                float(ball(compiled(self.start[n], t)(Moment(self))).mid()) for n in self.rates
            ]
            spacing = float(ball(compiled(self.corner, t)(Moment(self))).mid())
        present = Present(self)
        present.rates(np.zeros(1), np.array(first)[:, None])  # they can be computed
        return Motion(present.rates, np.array(first), spacing, float(arb(self.period)) / 4)

    def limit(self, expr: sp.Limit) -> arb:
        """Return a limit, with the error that its trend shows."""
        return trend.limit(self._late(expr, _FARTHEST))

    def tends(self, expr: sp.Limit, value: arb) -> bool | None:
        """Return whether a limit has a value."""
        return self._confirmed(expr, lambda windows: trend.tends_to(windows, value))

    def diverges(self, expr: sp.Limit, sign: int) -> bool | None:
        """Return whether an expression exceeds (sign 1) or falls below (-1) every bound."""
        return self._confirmed(
            expr, lambda windows: trend.diverges([[sign * v for v in w] for w in windows])
        )

    def latest(self, expr: sp.Limit) -> arb:
        """Return the last value from which a limit was judged."""
        return self._late(expr, _FAR)[-1][-1]

    def _confirmed(self, expr: sp.Limit, judge: Callable[[Windows], bool | None]) -> bool | None:
        """Judge a trend; a refusal, from fields that may not have left their start, again later."""
        outcome = judge(self._late(expr, _FAR))
        if outcome is False and self.rates and expr.args[2] == sp.oo:
            return judge(self._late(expr, _FARTHEST)) or False
        return outcome

    def slope(self, name: sp.Symbol, data: tuple[sp.Symbol, ...]) -> arb:
        """Return the derivative of a constant with respect to one datum, all others held."""
        (datum,) = data[:1]
        if len(data) != 1 or not self.data.get(datum, sp.nan).is_Rational:
            raise Undecided("a derivative of a higher order")
        here, step = fraction(self.data[datum]), fmpq(1, 10**3 if self.rates else 10**6)
        step *= abs(here) if here != 0 else 1
        high, low = (
            arb(self.with_datum(datum, at).constant(name)) for at in (here + step, here - step)
        )
        found = (high - low) / (2 * step)
        return found + arb(0, (abs(found) * 1000 * arb(step) ** 2 + arb(10) ** -30).upper())

    def with_datum(self, datum: sp.Symbol, value: fmpq) -> Model:
        """Return the model with one datum changed."""
        return replace(self, data={**self.data, datum: sp.Rational(int(value.p), int(value.q))})

    def _late(self, expr: sp.Limit, far: int) -> Windows:
        """Return the values of an expression in windows towards the point of its limit."""
        key = (expr, far)
        if key not in self._windows:
            inside, variable, point, _ = expr.args
            with ctx.workprec(BITS):
                value = compiled(inside, t)
                if variable == t:
                    self._windows[key] = [
                        [ball(value(Moment(self, at))) for at in window]
                        for window in self._ladder(point, far)
                    ]
                else:
                    moved = (self.with_datum(variable, at) for at in _towards(point))
                    self._windows[key] = [[ball(value(Moment(m, self.period)))] for m in moved]
        return self._windows[key]

    def _ladder(self, point: sp.Expr, far: int) -> list[list[fmpq]]:
        """Return times in windows: towards infinity as far as the fields are known."""
        if point != sp.oo:
            return [[at] for at in _towards(point)]
        if not self.rates:
            return [self._window(10**k) for k in (8, 16, 32, 64)]
        reached = self.motion.upto(float(arb(self.period)) * far * 5)
        periods = min(reached / float(arb(self.period)), 5 * far) / 4
        if periods > far / 2:
            return [self._window(int(periods ** (0.5**k))) for k in (2, 1, 0)]
        if periods < 25 or far == _FARTHEST:
            raise Undecided("the fields are not known for long enough")
        return [self._window(int(periods / 4**k)) for k in (2, 1, 0)]

    def _window(self, periods: int) -> list[fmpq]:
        hundredths = ((int(periods * int(f * 10)) // 10) * 100 + phase for f, phase in _FACTORS)
        return [self.period * fmpq(at, 100) for at in hundredths]


def _towards(point: sp.Expr) -> list[fmpq]:
    steps = [fmpq(10) ** k for k in (6, 12, 24)]
    if point in (sp.oo, -sp.oo):
        return [step if point == sp.oo else -step for step in steps]
    return [fraction(point) + 1 / step for step in steps]


class Present:
    """A model while it is integrated: floats, at the times of one step all at once."""

    def __init__(self, model: Model) -> None:
        self.of, self.time, self.states = model, np.zeros(1), np.zeros((0, 1))
        self._constants: dict[sp.Symbol, float] = {}
        self._known: dict[tuple[str, int], Any] = {}
        self._near: dict[str, Any] = {}

    def rates(self, times: Any, states: Any) -> Any:
        """Return the rates of the states at times, shape ``(states, times)``."""
        self.time, self.states, self._known = times, states, {}
        now = Moment(self, times)
        with np.errstate(all="ignore"):
            found = [compiled(rate, t, True)(now) for rate in self.of.rates.values()]
        return np.array([np.broadcast_to(rate, times.shape) for rate in found], float)

    def constant(self, symbol: sp.Symbol) -> float:
        """Return a datum."""
        if symbol not in self._constants:
            with ctx.workprec(BITS):
                self._constants[symbol] = float(ball(self.of.constant(symbol)).mid())
        return self._constants[symbol]

    def field(self, name: str, at: Any, order: int = 0) -> Any:
        """Return a field, or its derivative, at the times of the step."""
        if isinstance(at, fmpq) and at == 0 and order == 0:
            return float(ball(self.of.field(name, at)).mid())
        if at is not self.time:
            raise Undecided("a rate that needs another time")
        if order == 0 and name in self.of.rates:
            return self.states[list(self.of.rates).index(name)]
        if (name, order) not in self._known:
            if name in self.of.loops and order == 0:
                self._known[name, 0] = self._near[name] = self._root(name)
            else:
                formula = self.of.formula(name, order)
                self._known[name, order] = compiled(formula, t, True)(Moment(self, self.time))
        return self._known[name, order]

    def _root(self, name: str) -> Any:
        """Return the root of ``y - G(y)``, which increases: by Newton's method, else by halves."""
        value, known = compiled(self.of.loops[name], t, True), dict(self._known)

        def rest(y: Any) -> Any:
            self._known = {**known, (name, 0): y}
            return y - value(Moment(self, self.time))

        y = self._near.get(name, 0.0) + 0.0 * self.time
        with np.errstate(all="ignore"):
            for _ in range(12):
                small = 1e-7 * (1 + np.abs(y))
                now = rest(y)
                step = now * small / (rest(y + small) - now)
                y = y - step
                if np.all(np.abs(step) <= 1e-14 * (1 + np.abs(y))):
                    break
            else:
                low, high = -(2.0**40) + 0 * self.time, 2.0**40 + 0 * self.time
                for _ in range(100):
                    y = (low + high) / 2
                    low, high = np.where(rest(y) < 0, y, low), np.where(rest(y) < 0, high, y)
                y = np.where(np.abs(rest(y)) < 1e-6 * (1 + np.abs(y)), y, np.nan)
        self._known = known
        return y


def _unknowns(expr: sp.Basic) -> set[object]:
    fields = {f.func.__name__ for f in expr.atoms(AppliedUndef)}
    return fields | {s for s in expr.free_symbols if s != t}


@lru_cache(maxsize=400)
def _integrated(
    data: Items,
    fields: Items,
    rates: Items,
    start: Items,
    loops: Items,
    corner: sp.Expr,
    period: fmpq,
) -> Motion:
    model = Model(dict(data), dict(fields), dict(rates), dict(start), dict(loops), corner, period)
    return model.integrated()
