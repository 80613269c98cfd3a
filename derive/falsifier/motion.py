"""Motion: the fields that differential equations determine, by Taylor series.

Overview
    ``dx/dt = F(t, x)`` is integrated with power series of balls: the coefficients follow order
    by order (Picard), the step from their decay, so that the terms left out are 1e-30 of the
    field.  Steps end where a load of straight pieces or jumps has its corners.  The series of
    every step are kept: fields are known at every time in between, with their derivatives.
    Nothing is shared with `wear`, nor with the rules.
Key results
    Motion    the states of one system, integrated as far as is asked for
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import sympy as sp
from flint import arb, arb_poly, arb_series, fmpq
from sympy.core.function import AppliedUndef

from .balls import Moment, Number, Undecided, ball, compiled, head, precision

if TYPE_CHECKING:
    from .models import Model

ORDER = 30
BITS = 200
_LEFT_OUT = math.log(1e-30)
_SHORTEST = math.log(1e-6)
_TRUSTED = arb(10) ** -24
MOST_STEPS = 250


@dataclass(eq=False)
class Motion:
    """States with their rates, integrated from time zero on.

    ``corner``: the spacing of the times at which the load has corners or jumps, 0 for none.
    """

    within: Model
    rates: Mapping[str, sp.Expr]
    start: Mapping[str, sp.Expr]
    corner: sp.Expr = sp.S.Zero
    _times: list[fmpq] = field(default_factory=lambda: [fmpq(0)])
    _pieces: list[dict[str, arb_poly]] = field(default_factory=list)
    _present: dict[str, arb_series] = field(default_factory=dict)
    _stuck: str = ""

    def __post_init__(self) -> None:
        variable = self.within.variable
        self.within.motion = self
        self._rates = {name: compiled(self._inlined(e), variable) for name, e in self.rates.items()}
        with precision(BITS):
            moment = Moment(self.within)
            first = {name: ball(compiled(e, variable)(moment)) for name, e in self.start.items()}
            self._first = {name: arb(value.mid()) for name, value in first.items()}
            self._spacing = head(compiled(self.corner, variable)(moment))

    @property
    def reached(self) -> fmpq:
        """Return the time up to which the states are known."""
        return self._times[-1]

    @property
    def busy(self) -> bool:
        """Return whether a step is under way."""
        return bool(self._present)

    def field(self, name: str, at: Number, terms: int) -> Number:
        """Return a state at a time, with so many coefficients."""
        if name in self._present and at == self.reached:
            return self._present[name] if terms > 1 else self._present[name][0]
        time = _exact(at)
        while self.reached <= time:
            self._advance()
        number = bisect_right(self._times, time) - 1
        shift, step = time - self._times[number], self._times[number + 1] - self._times[number]
        there = self._pieces[number][name](arb_poly([shift, 1])).coeffs()
        there = [*there, *[arb(0)] * terms][:terms]
        errors = (_TRUSTED * (abs(c) + abs(there[0]) / step**k) for k, c in enumerate(there))
        balls = [c + arb(0, e.upper()) if c != 0 else c for c, e in zip(there, errors, strict=True)]
        return balls[0] if terms == 1 else arb_series(balls, terms)

    def _inlined(self, rate: sp.Expr) -> sp.Expr:
        """Write a rate in time and states alone, as far as may be: it is evaluated often."""
        given, explicit = self.within.data, self.within.fields
        for _ in range(8):
            known = {f: explicit[f.func.__name__] for f in rate.atoms(AppliedUndef)
                     if f.func.__name__ in set(explicit) - self.within.loops
                     and f.args[0] == self.within.variable}  # fmt: skip
            if not known or any(value.has(sp.Derivative) for value in known.values()):
                break
            rate = rate.xreplace(known)
        return rate.xreplace({s: v for s, v in given.items() if v.is_Rational})

    def with_datum(self, datum: sp.Symbol, value: sp.Expr) -> Motion:
        """Return the motion with one datum changed, from the start; itself if it has none."""
        if datum not in self.within.data:
            return self
        data = {**self.within.data, datum: value}
        return Motion(replace(self.within, data=data), self.rates, self.start, self.corner)

    def upto(self, time: fmpq) -> fmpq:
        """Integrate to a time, or as far as the steps allow; return the time reached."""
        try:
            while self.reached <= time:
                self._advance()
        except Undecided:
            pass
        return self.reached

    def _advance(self) -> None:
        if len(self._pieces) >= MOST_STEPS or self._stuck:
            raise Undecided(self._stuck or "too many steps")
        begin = self.reached
        if self._pieces:
            step = begin - self._times[-2]
            values = {n: arb(piece(arb(step)).mid()) for n, piece in self._pieces[-1].items()}
        else:
            values = dict(self._first)
        try:
            series = self._series(values, begin)
            step = self._step(series, begin)
        except (ArithmeticError, ValueError) as reason:
            self._stuck = f"the fields end at {begin}: {reason}"
            raise Undecided(self._stuck) from reason
        finally:
            self._present.clear()
            self.within.scratch.clear()
        self._pieces.append({name: arb_poly(list(s.coeffs())) for name, s in series.items()})
        self._times.append(begin + step)

    def _series(self, values: Mapping[str, arb], begin: fmpq) -> dict[str, arb_series]:
        """Return the coefficients of all states, order by order."""
        found = {name: arb_series([value], 1) for name, value in values.items()}
        for terms in range(1, ORDER + 1):
            with precision(BITS, max(terms, 2)):
                self._present.update(found)
                self.within.scratch.clear()
                there = Moment(self.within, begin, max(terms, 2))
                rates = {name: rate(there) for name, rate in self._rates.items()}
            with precision(BITS, terms + 1):
                for name, rate in rates.items():
                    if isinstance(rate, arb_series) and rate.prec < terms:
                        raise ArithmeticError("a rate that needs its own derivative")
                    slope = [rate] if not isinstance(rate, arb_series) else rate.coeffs()[:terms]
                    known = [values[name], *(arb(c) / (k + 1) for k, c in enumerate(slope))]
                    found[name] = arb_series([arb(c.mid()) for c in known], terms + 1)
        return found

    def _step(self, series: Mapping[str, arb_series], begin: fmpq) -> fmpq:
        """Return a step after which the last two terms are negligible, short of a corner."""
        longest = math.log(4 * max(1.0, float(begin)))
        for found in series.values():
            size = max(_log(found[0]), -7.0)
            for k in (ORDER - 1, ORDER):
                if not found[k].is_finite():
                    raise ArithmeticError("no finite series")
                longest = min(longest, (_LEFT_OUT + size - _log(found[k])) / k)
        if longest < _SHORTEST:
            raise ArithmeticError("steps vanish")
        step = fmpq(int(math.exp(longest) * 2**24), 2**24)
        if self._spacing:
            left = self._spacing * ((begin / self._spacing).floor() + 1) - begin
            step = min(step, left)
        return step


def _log(x: arb) -> float:
    size = arb(abs(x).mid())
    return float(arb.log(size)) if size > 0 else -math.inf


def _exact(at: Number) -> fmpq:
    value = head(at)
    if isinstance(value, fmpq):
        return value
    raise Undecided("a time that is no rational number")
