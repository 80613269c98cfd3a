"""Calculus: from rates to wear, and to a rigid support.

Key results
    integrate      dy/dt = c dx/dt, from the initial values
    grows          du/dt >= c and u(0) give u >= u(0) + c t
    differentiate  the rates of both sides of an equality that holds at every time
    rigid          k U_c = p becomes U_c = 0: the limit k -> oo
    change_clock   the rate of a scaled quantity in scaled time
"""

from __future__ import annotations

import sympy as sp
from sympy.core.relational import Relational

from ..claims import Equality, Inequality
from ..hypotheses import LOAD, RIGID, Hypothesis, Kind
from ..kernel import Conclusion, Judgement, RuleError
from ..note.model import SUPPORT
from ..parts import nonzero
from ..symbols import symbols, t
from .proving import coefficients, continuous, lasts, require, require_defined, smooth
from .reading import (
    clocks,
    constant,
    equality,
    field_of_rate,
    fields,
    functions,
    inequality,
    initial_value,
    require_hypothesis,
)
from .theorem import Theorem

U_c, p, k, T, tau = symbols("U_c p k T tau")

SPRINGS = Hypothesis(SUPPORT, Kind.MODEL)


class Integrate(Theorem):
    """``dy/dt = c dx/dt`` with constant c, y(0) and x(0) give ``y = y(0) + c (x - x(0))``."""

    words = "Integrate {0} over time, from {others}."
    source = "fundamental theorem of calculus"
    premise_names = ("the rate", "y(0)", "x(0)")

    def prove(self, *premises: Judgement) -> Conclusion:
        law, start_y, start_x = premises
        given = equality(law)
        y = field_of_rate(given.lhs)
        driving = list(given.rhs.atoms(sp.Derivative))
        if len(driving) != 1:
            raise RuleError(f"missing premise: {given.relation} is of the form dy/dt = c dx/dt")
        x, factor = field_of_rate(driving[0]), sp.cancel(given.rhs / driving[0])
        if not constant(factor):
            raise RuleError(f"missing premise: {factor} is constant")
        begin = initial_value(start_y, y) - factor * initial_value(start_x, x)
        return Conclusion(Equality(y, begin + factor * x))


integrate = Integrate()


class Grows(Theorem):
    """``du/dt >= c`` with constant c, and u(0), give ``u >= u(0) + c t``."""

    words = "Integrate the constant lower bound of {0}, from {others}."
    source = "mean value theorem on [0, t]"
    premise_names = ("the bound of the rate", "u(0)")

    def prove(self, *premises: Judgement) -> Conclusion:
        bound, start = premises
        found = inequality(bound)
        u, least = field_of_rate(found.greater), found.lesser
        if not constant(least):
            raise RuleError(f"missing premise: {least} is constant")
        begin = initial_value(start, u)
        return Conclusion(Inequality(sp.Ge(u, begin + least * t, evaluate=False)))


grows = Grows()


class Differentiate(Theorem):
    """An equality that holds at every time gives that of the rates of both sides.

    Wear and roughness have rates by Archard's law; other fields need a premise that they have.
    """

    words = "Differentiate {0} with respect to time."
    source = "chain rule"
    premise_names = ("the equation",)

    def prove(self, *premises: Judgement) -> Conclusion:
        given = equality(premises[0])
        if not smooth(given.lhs) or not smooth(given.rhs) or clocks(given.relation) - {t}:
            raise RuleError(f"missing premise: {given.relation} is differentiable")
        rates = sp.diff(given.lhs, t), sp.diff(given.rhs, t)
        # A field that equals the other side at every time has its rate, if that always has a value.
        single = lasts(premises[0]) and given.lhs in fields(given.lhs)
        require_defined(sp.Tuple(*rates[single:]), *premises, always=single)
        return Conclusion(Equality(*rates), gives=rates[:single])


differentiate = Differentiate()


class RigidLimit(Theorem):
    """``k U_c = p`` becomes ``U_c = 0``, and an equation its limit for k -> oo.

    The same fields belong to a support of stiffness k under the load ``U_a + p/k`` and to a rigid
    one under the load U_a.  So the equation holds for every k with that load, and as it is
    continuous in 1/k at 0, for the rigid support.  Nothing else may be said of the load or of k.
    """

    words = "Let the stiffness tend to infinity in {0}: the support is rigid."
    premise_names = ("the equation",)

    def prove(self, *premises: Judgement) -> Conclusion:
        (first,) = premises
        given, small = equality(first), sp.Dummy("1/k", positive=True)
        require_hypothesis(SPRINGS, first)
        others = [h.relation for h in first.hypotheses if h != SPRINGS]
        moved = given.relation.has(U_c.func) or given.relation.atoms(LOAD.func) - {LOAD}
        if moved or any(r.has(k) for r in others) or not all(map(_by_difference, others)):
            raise RuleError("missing premise: nothing else is said of the load, of U_c and of k")
        deeper = {k: 1 / small, LOAD: LOAD + small * p}
        changed = k, LOAD, U_c  # premises about them hold at finite stiffness only
        sides = [side.subs(deeper, simultaneous=True) for side in (given.lhs, given.rhs)]
        if not all(continuous(side, {small: sp.S.Zero}, first, but=changed) for side in sides):
            raise RuleError(f"missing premise: {given.relation} is continuous for k -> oo")
        left, right = (side.subs(small, 0) for side in sides)
        return Conclusion(Equality(left, right), adds=(RIGID,), discharges=(SPRINGS,))


def _by_difference(relation: sp.Basic) -> bool:
    """Return whether a relation has the load and the deflection in ``U_c - U_a`` alone, if at all,
    as a multiple that is added.

    The relation is read as it is: with ``U_a + U_c`` for the load, parts without a value might
    cancel.
    """
    found = {f for f in functions(relation) if f.func in (LOAD.func, U_c.func)}
    if not found <= {LOAD, U_c} or not isinstance(relation, Relational):
        return not found
    parts = [coefficients(side, LOAD, U_c) for side in relation.args]
    return all(each and constant(each[0]) and each[0] + each[1] == 0 for each in parts)


rigid = RigidLimit()


class ChangeClock(Theorem):
    """``y = c v`` with constant c, and ``t = T tau``, give ``dy/dt = (c/T) dv/dtau``."""

    words = "Measure time in periods, in {all}."
    source = "chain rule"
    premise_names = ("the scale of y", "t = T tau")

    def prove(self, *premises: Judgement) -> Conclusion:
        scaled, clock = map(equality, premises)
        moving = [f for f in scaled.rhs.atoms(sp.Function) if f.args == (tau,)]
        if (clock.lhs, clock.rhs) != (t, T * tau) or len(moving) != 1 or not lasts(premises[0]):
            raise RuleError("missing premise: t = T tau, and the scale of y at every time")
        factor = sp.cancel(scaled.rhs / moving[0])
        if not constant(factor):
            raise RuleError(f"missing premise: {factor} is constant")
        require(nonzero(factor), *premises)
        rate, scaled_rate = sp.Derivative(scaled.lhs, t), sp.Derivative(moving[0], tau)
        return Conclusion(Equality(rate, factor / T * scaled_rate), gives=(scaled_rate,))


change_clock = ChangeClock()
