"""Models: data, and fields over time, in which hypotheses and claims are evaluated.

Overview
    A model has values of quantities: of a datum a, a field f(t), a rate df/dt or an initial value
    f(0).  A field with a given rate is a state, the solution of its differential equation.
Key results
    Model          the values of data and fields, for ``values.py``
    dependencies   the quantities on which expressions rest
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
import sympy as sp
from flint import arb, ctx, fmpq
from sympy.core.function import AppliedUndef

from ..memory import cache
from ..symbols import symbol, t
from . import trend
from .balls import BITS, ZERO, NoValueError, Number, UndecidedError, UndefinedError, ball, fraction
from .motion import Motion, rates_in_floats
from .values import Moment, compiled, field_of

_FACTORS = ((1, 5), (1.3, 21), (1.9, 37), (2.7, 58), (3.9, 83))
"""Times of a window: a factor, and a phase in hundredths of the period."""
_EARLY = (0, 137, 620, 1210, 2870)
"""Times at which claims about all times are tried, in thousandths of the period."""
_LATE = (10**2, 3 * 10**5)
_NEAR, _FAR, _FARTHEST = 10**3, 10**5, 10**8
"""Numbers of periods after which trends are read: before rounding hides them; by default; to
confirm a refusal."""
_APART, _CLOSE, _FIRST, _LAST = (0, 2, 4), (1, 2, 3, 4), (0,), (4,)
"""Windows, of five, for the verdict on a limit, for its value, and the first and last of them."""

_V = symbol("V")

_DEEP = 40
"""Bound of the nesting of formulas in a model."""

_TRUSTED = arb(10) ** -12
"""Relative error of a state."""

_SMALL = arb(10) ** -5
"""Size of a sum, relative to its terms, below which it has no clear trend."""

_UNSEEN = arb(10) ** -9
"""Change of a state over all the time known, relative to it, below which no trend is read."""

_UNMOVED = arb(10) ** -6
"""Relative width of a constant up to which a datum is known to have no influence on it."""


@cache
def quantities(expr: sp.Basic) -> frozenset[sp.Expr]:
    """Return the data and the fields in an expression, the fields at time t."""
    fields = map(field_of, expr.atoms(AppliedUndef))
    return frozenset((*fields, *(s for s in expr.free_symbols if s != t)))


def dependencies(
    expressions: Iterable[sp.Basic], values: Mapping[sp.Basic, sp.Expr], states: bool = True
) -> set[sp.Expr]:
    """Return the quantities on which expressions rest, directly or by the values of others.

    With ``states`` rates and initial values count too.
    """
    waiting, seen = list(expressions), set[sp.Expr]()
    while waiting:
        for quantity in quantities(waiting.pop()) - seen:
            seen.add(quantity)
            keys = forms_of(quantity) if states else (quantity,)
            waiting += [values[key] for key in keys if key in values]
    return seen


@cache
def forms_of(quantity: sp.Expr) -> tuple[sp.Expr, ...]:
    """Return the forms of a quantity in a model: itself; for a field also its rate and start."""
    if quantity.args != (t,):
        return (quantity,)
    return quantity, quantity.diff(t), quantity.subs(t, 0)


@dataclass(eq=False)
class Model:
    """Values of quantities, in terms of one another."""

    values: dict[sp.Expr, sp.Expr]

    def __post_init__(self) -> None:
        self._known: dict[object, Number] = {}
        self._formulas: dict[tuple[sp.Expr, int], sp.Expr] = {}
        self._windows: dict[tuple[sp.Limit, int, int], list[arb]] = {}

    @cached_property
    def states(self) -> dict[sp.Expr, int]:
        """Return the fields that follow from their rates, with their places."""
        fields = (field_of(key.expr) for key in self.values if isinstance(key, sp.Derivative))
        return {state: place for place, state in enumerate(sorted(fields, key=str))}

    @cached_property
    def period(self) -> fmpq:
        """Return the period if it is a positive number, else 1."""
        period = self.values.get(symbol("T"), sp.S.One)
        return fraction(period) if period.is_Rational and period > 0 else fmpq(1)

    @property
    def times(self) -> tuple[fmpq, ...]:
        """Return the times at which claims for all times are tried."""
        late = (self.period * (fmpq(at) + fmpq(43, 100)) for at in _LATE)
        early = (self.period * fmpq(at, 1000) for at in _EARLY)
        return (
            *early,
            *(at for at in late if not self.states or float(arb(at)) < self.motion.reached),
        )

    def constant(self, symbol: sp.Symbol) -> Number:
        """Return the value of a datum, which may rest on other data."""
        key = (symbol, ctx.prec)
        if key not in self._known:
            if symbol not in self.values:
                raise UndecidedError(f"{symbol} is not in the model")
            self._known[key] = self._evaluate(self.values[symbol])
        return self._known[key]

    def field(self, field: sp.Expr, at: Number, order: int = 0) -> Number:
        """Return the value of a field at a time, or of its derivative of an order."""
        key = (field, order, int(at.p), int(at.q), ctx.prec) if isinstance(at, fmpq) else None
        if key in self._known:
            return self._known[key]
        value = self._field_value(field, at, order)
        if key is not None:
            self._known[key] = value
        return value

    def _field_value(self, field: sp.Expr, at: Number, order: int) -> Number:
        if order == 0 and field in self.states:
            return self._state(field, at)
        return self._evaluate(self.formula(field, order), at)

    def _state(self, field: sp.Expr, at: Number) -> Number:
        if at == 0:
            return self._evaluate(self.values[field.subs(t, 0)])
        values, rounding = self.motion.at(float(arb(at)))
        place = self.states[field]
        value = arb(float(values[place]))
        return value + arb(0, (abs(value) * _TRUSTED + float(rounding[place])).upper())

    def increment(self, field: sp.Expr, begin: Number, end: Number) -> Number:
        """Return the increment of a field between two times."""
        first, width = float(arb(begin)), float(arb(end - begin))
        if field not in self.states or width <= 0:
            return self.field(field, end) - self.field(field, begin)
        increment = float(self.motion.increment(first, width)[self.states[field]])
        return arb(increment, (abs(increment) * _TRUSTED).upper())

    def _evaluate(self, expr: sp.Expr, at: Number = ZERO) -> Number:
        """Return the value of a quantity; NoValueError, which refutes no claim, if it has none."""
        try:
            return compiled(expr)(Moment(self, at))
        except UndefinedError as reason:
            raise NoValueError(f"the model has no value for {expr}") from reason

    def formula(self, field: sp.Expr, order: int) -> sp.Expr:
        """Return the expression of a field, or of its derivative without jumps."""
        key = (field, order)
        if key not in self._formulas:
            self._formulas[key] = self._formula(field, order)
        return self._formulas[key]

    def _formula(self, field: sp.Expr, order: int) -> sp.Expr:
        given = forms_of(field)[order] if order < 2 else None
        if given in self.values:
            return self.values[given]
        if order == 0:
            raise UndecidedError(f"{field} is not in the model")
        return slope_between_jumps(self.formula(field, order - 1))

    def inlined(self, expr: sp.Expr, about: sp.Expr | None = None) -> sp.Expr:
        """Return an expression in time, states, data and initial values.

        Only fields and rates that rest on ``about``, if given, are written out.
        """
        for _ in range(_DEEP):
            parts = moving_parts(expr) - self.states.keys()
            if about is not None:
                parts = frozenset(p for p in parts if self._rests(p, about))
            if not parts:
                return expr
            expr = expr.xreplace({part: self._formula_of(part) for part in parts})
        raise UndecidedError(f"{expr} rests on itself")

    def _rests(self, part: sp.Expr, quantity: sp.Expr) -> bool:
        return quantity in dependencies((part,), self.values, states=False)

    def _formula_of(self, part: sp.Expr) -> sp.Expr:
        rate = isinstance(part, sp.Derivative)
        return self.formula(part.expr, part.derivative_count) if rate else self.formula(part, 0)

    def formulas(self, expressions: Iterable[sp.Expr]) -> dict[sp.Expr, sp.Expr]:
        """Return the fields and rates on which expressions rest, beside states, with their
        formulas, each after those that it needs."""
        found: dict[sp.Expr, sp.Expr] = {}

        def visit(expr: sp.Expr, depth: int) -> None:
            if depth > _DEEP:
                raise UndecidedError(f"{expr} rests on itself")
            for part in sorted(moving_parts(expr) - self.states.keys() - found.keys(), key=str):
                formula = self._formula_of(part)
                visit(formula, depth + 1)
                found[part] = formula

        for expr in expressions:
            visit(expr, 0)
        return found

    @cached_property
    def motion(self) -> Motion:
        """Return the states over time, shared by models with the same values for them."""
        needed = dependencies(self.states, self.values)
        used = {key: self.values[key] for q in needed for key in forms_of(q) if key in self.values}
        return _integrated(frozenset(used.items()))

    def in_floats(self, quantity: sp.Expr, order: int = 0) -> float:
        """Return the value of a datum or of a field, or a derivative of it, at the start."""
        with ctx.workprec(BITS):
            if quantity.args == (t,):
                value = ball(self.field(quantity, ZERO, order))
            else:
                value = ball(compiled(quantity)(Moment(self)))
        if value.rad() > _TRUSTED * abs(value):
            raise UndecidedError(f"too few digits of {quantity}")
        return float(value.mid())

    def limit(self, expr: sp.Limit) -> arb:
        """Return a limit with an error from its trend, at the latest times that resolve it."""
        try:
            return trend.limit(self._trend_values(expr, _FARTHEST, _CLOSE))
        except UndecidedError:
            return trend.limit(self._trend_values(expr, _FAR, _CLOSE))

    def latest(self, expr: sp.Limit) -> arb:
        """Return the last value of the trend of a limit."""
        return self._trend_values(expr, _FAR, _LAST)[-1][-1]

    def tends(self, expr: sp.Limit, end: arb) -> bool | None:
        """Return whether a limit has a value; None if its trend is not clear.

        A refusal is confirmed at later times, or for faster wear if a load that goes on to vary
        puts these out of reach; an open case is tried again at earlier times.  At early times
        fields may not have left their start, at late ones rounding may hide them.
        """
        values = self._trend_values(expr, _FAR, _APART)
        outcome = trend.tends_to(values, end, apart=not self.states)
        if outcome or not self.states or expr.args[2] != sp.oo:
            return outcome
        try:
            values = self._trend_values(expr, _NEAR if outcome is None else _FARTHEST, _APART)
        except UndecidedError:
            if outcome is None or not self.values.get(_V, sp.nan).is_Rational:
                raise
            faster = self.with_datum(_V, 1000 * fraction(self.values[_V]))
            values = faster._trend_values(expr, _FAR, _APART)
        outcome = trend.tends_to(values, end) or outcome
        return None if outcome is False and self._cancels(expr) else outcome

    def _cancels(self, expr: sp.Limit) -> bool:
        """Return whether an expression is so small against its terms that its trend is not clear.

        A change of slow fields seems to last for as long as they are known.
        """
        parts = sp.Add.make_args(expr.args[0])
        terms = (sp.Limit(part, *expr.args[1:3]) for part in parts if len(parts) > 1)
        least = abs(self.latest(expr)) / _SMALL
        return any(abs(self._trend_values(term, _FAR, _FIRST)[0][0]) > least for term in terms)

    def slope(self, name: sp.Symbol, data: tuple[sp.Symbol, ...]) -> Number:
        """Return the derivative of a constant with respect to one datum, all others held.

        It is 0 if an increase of the datum by one half has no effect.
        """
        (datum,) = data
        if not self.values.get(datum, sp.nan).is_Rational:
            raise UndecidedError("a datum that rests on others")
        value, part = fraction(self.values[datum]), fmpq(1, 2500 if self.states else 10**6)
        size = abs(value) if value != 0 else fmpq(1)

        def changed(by: fmpq) -> arb:
            return arb(self.with_datum(datum, value + by * size).constant(name))

        slope = (changed(part) - changed(-part)) / (2 * part * size)
        if slope.contains(0):
            far = changed(fmpq(1, 2))
            change = far - arb(self.constant(name))
            if change.contains(0) and change.rad() < _UNMOVED * abs(far):
                return ZERO
        return slope + arb(0, (abs(slope) * 1000 * arb(part) ** 2 + arb(10) ** -30).upper())

    def with_datum(self, datum: sp.Symbol, value: fmpq) -> Model:
        """Return the model with one datum changed."""
        return Model({**self.values, datum: sp.Rational(int(value.p), int(value.q))})

    def _trend_values(self, expr: sp.Limit, far: int, places: Sequence[int]) -> list[list[arb]]:
        """Return the values of an expression in windows towards the point of its limit."""
        for place in places:
            key = (expr, far, place)
            if key not in self._windows:
                with ctx.workprec(BITS):
                    self._windows[key] = self._window_values(expr, far, place)
        return [self._windows[expr, far, place] for place in places]

    def _window_values(self, expr: sp.Limit, far: int, place: int) -> list[arb]:
        inside, variable, point, _ = expr.args
        value = compiled(inside)
        if variable == t:
            return [ball(value(Moment(self, at))) for at in self._ladder(point, far)[place]]
        moved = self.with_datum(variable, _towards(point)[place])
        return [ball(value(Moment(moved, self.period)))]

    def _ladder(self, point: sp.Expr, far: int) -> list[list[fmpq]]:
        """Return windows of times; towards infinity they end where the fields are known."""
        if point != sp.oo:
            return [[at] for at in _towards(point)]
        if not self.states:
            return [self._window(10**k) for k in (4, 8, 16, 32, 64)]
        period = float(arb(self.period))
        periods = min(self.motion.integrate_to(period * far * 5) / period, 5 * far) / 4
        if periods > far / 2:  # the logarithms of the times form a geometric sequence
            powers = [0.5 ** (k / 2) for k in (4, 3, 2, 1, 0)]
            ladder = [self._window(int(periods**power), power) for power in powers]
        elif periods < 30 or far == _FARTHEST:
            raise UndecidedError("the fields are not known for long enough")
        else:
            ladder = [self._window(int(periods / 2**k)) for k in (4, 3, 2, 1, 0)]
        if any(self._creeps(state, ladder[0][-1], ladder[-1][-1]) for state in self.states):
            raise UndecidedError("the fields are not known for long enough")
        return ladder

    def _creeps(self, state: sp.Expr, early: fmpq, late: fmpq) -> bool:
        """Return whether a state still moves, but too slowly to be seen in all the time known."""
        before, gain = (abs(arb(at * self.field(state, at, 1))) for at in (early, late))
        return bool(gain > before and gain < _UNSEEN * abs(self.field(state, late)))

    def _window(self, periods: int, power: float = 1.0) -> list[fmpq]:
        factors = ((int(periods * f**power), phase) for f, phase in _FACTORS)
        return [self.period * fmpq(whole * 100 + phase, 100) for whole, phase in factors]


def _towards(point: sp.Expr) -> list[fmpq]:
    steps = [fmpq(10) ** k for k in (3, 6, 9, 12, 24)]
    if point in (sp.oo, -sp.oo):
        return [step if point == sp.oo else -step for step in steps]
    return [fraction(point) + 1 / step for step in steps]


@cache
def moving_parts(expr: sp.Expr) -> frozenset[sp.Expr]:
    """Return the fields at time t and the rates in an expression."""
    found, nodes = set(), sp.preorder_traversal(expr)
    for node in nodes:
        if isinstance(node, sp.Derivative):
            found.add(node)
            nodes.skip()
        elif isinstance(node, AppliedUndef) and node.args == (t,):
            found.add(node)
    return frozenset(found)


@cache
def slope_between_jumps(expr: sp.Expr) -> sp.Expr:
    """Return the derivative in time between jumps."""
    steps = {step: sp.Dummy() for step in expr.atoms(sp.floor)}
    return sp.diff(expr.xreplace(steps), t).xreplace({dummy: s for s, dummy in steps.items()})


@lru_cache(maxsize=2000)
def _integrated(values: frozenset[tuple[sp.Expr, sp.Expr]]) -> Motion:
    """Return the motion of a model with no more values than its states rest on."""
    model = Model(dict(values))
    first, slopes = (
        np.array([model.in_floats(f, order) for f in model.states]) for order in (0, 1)
    )
    slopes_of_states = [model.formula(state, 1) for state in model.states]
    known = model.formulas(slopes_of_states)
    rates = rates_in_floats(tuple(model.states), slopes_of_states, known, model.in_floats)
    if not np.allclose(rates(np.zeros(1), first[:, None])[:, 0], slopes, rtol=1e-9, atol=0):
        raise UndecidedError("rates below their rounding error")
    spacing = min(_spacings(model), default=0.0)
    return Motion(rates, first, spacing, float(arb(model.period)) / 4)


def _spacings(model: Model) -> Iterator[float]:
    """Yield the times between jumps of the fields of a model."""
    for jump in frozenset().union(*map(_jumps, model.values.values())):
        yield 1 / float(ball(compiled(sp.diff(jump.args[0], t))(Moment(model))).mid())


@cache
def _jumps(expr: sp.Expr) -> frozenset[sp.Expr]:
    return frozenset(expr.atoms(sp.floor))
