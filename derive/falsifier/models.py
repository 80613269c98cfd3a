"""Models: data, and fields over time, of which every hypothesis can be asked whether it holds.

Overview
    A model gives a number to every datum and a function of time to every field: an explicit
    one, one computed from other fields (where need be from a loop, as pressure and deflection
    of a support are), or the solution of a differential equation.
Key results
    Model    what balls.py evaluates in
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

import sympy as sp
from flint import arb, arb_series, ctx, fmpq

from ..symbols import t
from . import trend
from .balls import Moment, Number, Undecided, Undefined, Value, ball, compiled, head, precision
from .motion import Motion

_FACTORS = ((1, 5), (1.3, 21), (1.9, 37), (2.7, 58), (3.9, 83))
"""Times of a window: a factor, and a phase in hundredths of the period."""
_EARLY = (0, 137, 620, 1210, 2870)
"""Times at which what is claimed for all times is tried, in thousandths of the period."""
_LATE = (10**2, 10**4, 3 * 10**8)
_FAR, _FARTHEST = 10**8, 10**16
"""Periods after which trends are read, and refusals confirmed."""
_STEP = fmpq(1, 10**6)


Windows = list[list[arb]]


@dataclass
class Model:
    """One model.  ``data`` and ``fields`` may be defined in terms of one another."""

    data: Mapping[sp.Symbol, sp.Expr]
    fields: Mapping[str, sp.Expr]
    motion: Motion | None = None
    loops: frozenset[str] = frozenset()
    variable: sp.Symbol = t
    period: fmpq = field(default_factory=lambda: fmpq(1))

    def __post_init__(self) -> None:
        self._known: dict[object, Number] = {}
        self._trial: dict[str, Number] = {}
        self.scratch: dict[object, Number] = {}
        self._solved: dict[str, tuple[Number | None, arb_series]] = {}
        self._windows: dict[tuple[sp.Limit, int], Windows] = {}

    @property
    def times(self) -> tuple[fmpq, ...]:
        """Return the times at which claims for all times are tried."""
        reached = None if self.motion is None else self.motion.reached
        late = (at for at in _LATE if reached is None or reached > self.period * (at + 1))
        early = (self.period * fmpq(at, 1000) for at in _EARLY)
        return (*early, *(self.period * (fmpq(at) + fmpq(43, 100)) for at in late))

    def constant(self, symbol: sp.Symbol) -> Number:
        """Return a datum; one that others define is computed from them."""
        key = (symbol, ctx.prec)
        if key not in self._known:
            if symbol not in self.data:
                raise Undecided(f"{symbol} is not in the model")
            with precision(ctx.prec):
                self._known[key] = head(compiled(self.data[symbol], self.variable)(Moment(self)))
        return self._known[key]

    def field(self, name: str, at: Number, terms: int) -> Number:
        """Return a field at a time, with so many Taylor coefficients."""
        moment = Moment(self, at, terms)
        if self.motion is not None and name in self.motion.rates:
            return self.motion.field(name, at, terms)
        if name in self._trial:
            trial = self._trial[name]
            return head(trial) if terms == 1 else trial
        if name not in self.fields:
            raise Undecided(f"{name} is not in the model")
        if self._trial:
            return self._computed(name, moment)
        busy = self.motion is not None and self.motion.busy
        book = self.scratch if busy else self._known
        key = (name, str(at), terms, ctx.prec)
        if key not in book:
            book[key] = self._computed(name, moment)
        return book[key]

    def _computed(self, name: str, moment: Moment) -> Number:
        value = compiled(self.fields[name], self.variable)
        return self._looped(name, value, moment) if name in self.loops else value(moment)

    def _looped(self, name: str, value: Value, moment: Moment) -> Number:
        """Solve ``y = G(y)``: its root by secants, its series by Newton's method."""

        def rest(y: Number, terms: int) -> Number:
            self._trial[name] = y
            try:
                return y - value(replace(moment, terms=terms))
            finally:
                del self._trial[name]

        at, before = self._solved.get(name, (None, arb_series([1], 1)))
        y = root(lambda guess: ball(rest(guess, 1)), before[0])
        if moment.terms == 1:
            self._solved[name] = (moment.time, arb_series([y], 1))
            return y
        small = arb(2) ** -80
        slope = ((ball(rest(y + small, 1)) - ball(rest(y - small, 1))) / (2 * small)).mid()
        known = before.coeffs()[1:] if at == moment.time else []
        series = arb_series([y, *known[: moment.terms - 1]], moment.terms)
        for _ in range(max(1, moment.terms - len(known))):
            series = series - rest(series, moment.terms) / slope
            series = arb_series([arb(c.mid()) for c in series.coeffs()], moment.terms)
        self._solved[name] = (moment.time, series)
        return series

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

    def _confirmed(self, expr: sp.Limit, judge: Callable[[Windows], bool | None]) -> bool | None:
        """Judge a trend; a refusal, from fields that may not have left their start, again later."""
        outcome = judge(self._late(expr, _FAR))
        if outcome is False and self.motion is not None and expr.args[2] == sp.oo:
            return judge(self._late(expr, _FARTHEST))
        return outcome

    def slope(self, name: sp.Symbol, data: tuple[sp.Symbol, ...]) -> arb:
        """Return the derivative of a constant with respect to one datum, all others held."""
        if len(data) != 1 or data[0] not in self.data or not self.data[data[0]].is_Number:
            raise Undecided("a derivative of a higher order")
        (datum,) = data
        here = self.constant(datum)
        step = _STEP * (abs(here) if here != 0 else 1)
        ends = []
        for at in (here - step, here + step):
            moved = self.with_datum(datum, sp.Rational(int(at.p), int(at.q)))
            ends.append(arb(moved.constant(name)))
        found = (ends[1] - ends[0]) / (2 * step)
        return found + arb(0, (abs(found) * arb(10) ** -9 + arb(10) ** -30).upper())

    def with_datum(self, datum: sp.Symbol, value: sp.Expr) -> Model:
        """Return the model with one datum changed."""
        data = {**self.data, datum: value}
        motion = None if self.motion is None else self.motion.with_datum(datum, value)
        return replace(self, data=data, motion=motion)

    def derived_by_limit(self, relation: sp.Basic) -> bool:
        """Return whether a relation is about a slope in data, or a datum known by a limit."""
        slopes = relation.atoms(sp.Derivative)
        named = (self.data[s] for s in relation.free_symbols if s in self.data)
        return any(slope.variables != (self.variable,) for slope in slopes) or any(
            value.has(sp.Limit) for value in named
        )

    def _late(self, expr: sp.Limit, far: int) -> Windows:
        """Return the values of an expression in windows towards the point of its limit."""
        key = (expr, far)
        if key not in self._windows:
            inside, variable, point, _ = expr.args
            with precision():
                if variable != self.variable:
                    self._windows[key] = [
                        [self._elsewhere(inside, variable, at)] for at in _towards(point)
                    ]
                else:
                    value = compiled(inside, self.variable)
                    self._windows[key] = [
                        [ball(value(Moment(self, at))) for at in window]
                        for window in self._ladder(point, far)
                    ]
        return self._windows[key]

    def _elsewhere(self, inside: sp.Expr, variable: sp.Symbol, at: sp.Expr) -> arb:
        moved = self.with_datum(variable, at)
        return ball(compiled(inside, self.variable)(Moment(moved, self.period)))

    def _ladder(self, point: sp.Expr, far: int) -> list[list[fmpq]]:
        """Return times in windows: towards infinity as far as the fields are known."""
        if point != sp.oo:
            at = [head(compiled(e, self.variable)(Moment(self))) for e in _towards(point)]
            return [[a] for a in at]
        if self.motion is None:
            return [self._window(10**k) for k in (8, 16, 32, 64)]
        reached = self.motion.upto(self.period * (far * 5))
        periods = float(reached / self.period) / 4
        if periods > far / 2:
            return [self._window(int(periods ** (0.5**k))) for k in (2, 1, 0)]
        if periods < 25 or far == _FARTHEST:
            raise Undecided("the fields are not known for long enough")
        return [self._window(int(periods / 4**k)) for k in (2, 1, 0)]

    def _window(self, periods: int) -> list[fmpq]:
        hundredths = ((int(periods * int(f * 10)) // 10) * 100 + phase for f, phase in _FACTORS)
        return [self.period * fmpq(at, 100) for at in hundredths]


def _towards(point: sp.Expr) -> list[sp.Expr]:
    steps = [sp.Integer(10) ** k for k in (6, 12, 24)]
    if point in (sp.oo, -sp.oo):
        return [step if point == sp.oo else -step for step in steps]
    return [point + 1 / step for step in steps]


def root(f: Callable[[arb], arb], near: arb) -> arb:
    """Return the root of an increasing function to the working precision: by secants from
    ``near``, by bisection first where these do not get there."""
    found = _secants(f, near, near + (abs(near) + 1) / 2**20)
    if found is not None:
        return found
    low, high = arb(-1), arb(1)
    for _ in range(200):
        if f(low) < 0 < f(high):
            break
        low, high = 2 * low - high, 2 * high - low
    else:
        raise Undefined("no root")
    for _ in range(40):
        middle = ((low + high) / 2).mid()
        low, high = (middle, high) if f(middle) < 0 else (low, middle)
    found = _secants(f, low.mid(), high.mid())
    if found is None:
        raise Undecided("a loop of equations that does not converge")
    return found


def _secants(f: Callable[[arb], arb], a: arb, b: arb) -> arb | None:
    fa, fb = f(a), f(b)
    for _ in range(16):
        if (fb - fa).contains(0) or fb.contains(0):
            return b
        a, b, fa = b, (b - fb * (b - a) / (fb - fa)).mid(), fb
        fb = f(b)
    return None
