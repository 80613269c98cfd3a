"""Solutions of the differential equation: variables separated, integrals by parts, inverses.

Key results
    Follows       the only root of the equation of the pressure is continuous
    Separate      c t = int g(y) dy, where rate and wear are functions of y alone
    ByParts       a part of an integral, or all of it, by a primitive
    Lambert       w e^w = x gives w = W(x)
    FirstRoot     the first zero of a function that a positive factor makes quadratic
"""

from __future__ import annotations

from collections.abc import Callable

import sympy as sp

from ..claims import Continuous, Equality, FirstZero, Property
from ..hypotheses import CONSTANT, LOAD
from ..kernel import Conclusion, Judgement, Rule, RuleError, plain
from ..note.model import WEARING
from ..parts import nonnegative, nonzero, positive
from ..reals import holds, sign
from ..symbols import symbol, t
from ..zero import is_zero
from .proving import (
    continuous,
    facts_of,
    in_words,
    lasting_facts,
    lasts,
    require,
    require_integrands,
    smooth,
    undefined,
)
from .reading import (
    constant,
    equality,
    exchanged,
    fields,
    one_integral,
    rate_law,
    replaced,
    require_hypothesis,
)
from .theorem import Theorem

PRESSURE = symbol("p")


class Follows(Theorem):
    """The only root of ``p = R(p, u, load)`` is continuous, where ``p - R`` increases in p."""

    words = "The pressure is the only root of {0}, and continuous, as all else in it is."
    source = "implicit function theorem"
    premise_names = ("the equation of the pressure",)

    def prove(self, *premises: Judgement) -> Conclusion:
        given, facts = equality(premises[0]), lasting_facts(premises)
        p = sp.Dummy("p", nonnegative=True)
        value = given.rhs.xreplace({PRESSURE: p})
        moving = {unknown: unknown for unknown in (p, *fields(value))}
        still = value.xreplace({unknown: sp.Dummy(real=True) for unknown in moving})
        known = given.lhs == PRESSURE and constant(still) and smooth(value, p)
        increases = known and sign(1 - sp.diff(value, p), facts) == 1
        only = increases and lasts(premises[0])
        if not only or not continuous(value, moving, *premises, always=True):
            raise RuleError(f"missing premise: {PRESSURE} is the only root of an equation")
        for field in fields(value) - {*WEARING}:
            if Continuous(field) not in facts:
                raise RuleError(f"missing premise: {field} is continuous")
        return Conclusion(Property(Continuous(PRESSURE)))


follows = Follows()


class Separate(Theorem):
    """``du/dt = Q(y)`` and ``u = G(y)`` give ``c t = int g(s) ds`` from y(0) to y, ``g Q = c G'``.

    Premises: the rate, then u in terms of y, unless y is u, and y(0), unless the integral begins
    with this name.  y is continuous: a wear, a roughness, or a field with a premise that it is.
    """

    claim: sp.Equality
    words = "Separate the variables of {0} and integrate from the start, with {others}."
    source = "chain rule; implicit function theorem"
    premise_names = ("the rate",)

    def prove(self, *premises: Judgement) -> Conclusion:
        law, *others = premises
        (u, rate), integral = rate_law(law), one_integral(self.claim.rhs)
        require_hypothesis(CONSTANT.relation, *premises)
        known = {e.lhs: e.rhs for e in (p.claim for p in others) if isinstance(e, Equality)}
        (s, first, y), wear = integral.limits[0], known.get(u, u)
        start, facts = y.subs(t, 0), facts_of(premises)
        moves = y.args == (t,) and {y, Continuous(y)} & {*WEARING, *facts}
        if not moves or known.get(start, start) != first:
            raise RuleError(f"missing premise: {start} = {first}, and {y} is continuous")
        require_integrands(self.claim, *premises)
        moving, load = sp.Dummy(**s.assumptions0), sp.Dummy(real=True)
        rate, wear = (e.xreplace({y: moving, LOAD: load}) for e in (rate, wear))
        pace, factor = sp.cancel(self.claim.lhs / t), sp.cancel(self.claim.rhs / integral)
        g = factor * integral.function.xreplace({s: moving, LOAD: load})
        whole = sp.Tuple(rate, wear, pace, g)
        if not constant(whole) or not all(map(smooth, whole)):
            raise RuleError(f"missing premise: {self.claim.rhs} by smooth functions of {y} alone")
        slope = sp.diff(wear, moving)
        if not any(holds(nonzero(e.xreplace({moving: y})), facts) for e in (slope, rate)):
            raise RuleError(f"missing premise: {u} moves with {y}")
        if not is_zero(g * rate - pace * slope):
            raise RuleError(f"missing premise: {law.relation} separates into {self.claim}")
        return Conclusion(Equality(*self.claim.args))


class ByParts(Rule):
    """``int g ds = F(b) - F(a) + int r ds`` from a to b, for a smooth F with ``F' = g - r``."""

    primitive: sp.Expr
    rest: sp.Expr = sp.S.Zero
    source = "fundamental theorem of calculus; integration by parts"
    premise_names = ("the integral",)

    def conclude(self, *premises: Judgement) -> Conclusion:
        given = equality(premises[0])
        integral = one_integral(given.rhs)
        (limits,) = integral.limits
        s, *ends = limits
        slope = sp.diff(self.primitive, s)
        between = (sp.Integral(part, limits) for part in (self.primitive, slope, self.rest))
        require_integrands(sp.Tuple(*between), *premises)
        if not smooth(self.primitive, s) or not is_zero(integral.function - slope - self.rest):
            raise RuleError(f"missing premise: {self.primitive} has the derivative of {given.rhs}")
        first, last = (exchanged(self.primitive, s, end) for end in ends)
        left = sp.Integral(self.rest, limits) if self.rest != 0 else self.rest
        value = replaced(given.rhs, integral, last - first + left, always=False)
        return Conclusion(Equality(given.lhs, value))

    def sentence(self, *labels: str, write: Callable[[sp.Basic], str] = plain) -> str:
        if self.rest == 0:
            return f"Integrate {labels[0]}: a primitive is {write(self.primitive)}."
        return f"Integrate {labels[0]} by parts: {write(self.primitive)} leaves the integral."


class Lambert(Theorem):
    """``w e^w = x`` with ``w >= 0`` gives ``w = W(x)``, as ``w e^w`` increases there."""

    argument: sp.Expr
    words = (
        "Lambert's function solves {0}: it has the form w e^w = x with w >= 0, so that w = W(x)."
    )
    source = "Corless et al., Adv. Comput. Math. 5 (1996) 329"
    premise_names = ("the equation",)

    def prove(self, *premises: Judgement) -> Conclusion:
        given, w = equality(premises[0]), self.argument
        require(nonnegative(w), *premises)
        if not is_zero(given.lhs - w * sp.exp(w)):
            raise RuleError(f"missing premise: {given.relation} is w e^w = x for w = {w}")
        return Conclusion(Equality(w, sp.LambertW(given.rhs)))


class FirstRoot(Theorem):
    """The first positive zero x of f, where ``f w = a_0 + 2 a_1 x + a_2 x^2`` with w > 0.

    With ``a_0 > 0``, ``D = a_1^2 - a_2 a_0 >= 0`` and ``sqrt(D) > a_1`` it exists, and is
    ``a_0/(sqrt(D) - a_1)``: the other root is negative or lies beyond.
    """

    zero: FirstZero
    factor: sp.Expr
    alone = "The first root of an equation of second degree at most."
    words = f"{alone[:-1]}, from {{all}}."
    source = "the quadratic formula, in the form without cancellation"

    def prove(self, *premises: Judgement) -> Conclusion:
        if not isinstance(self.zero, FirstZero):
            raise RuleError(f"missing premise: {self.zero} is a first zero")
        function, x = self.zero.args
        z = sp.Dummy("x", positive=True)
        product = sp.Poly(sp.expand(function * self.factor).subs(x, z), z)
        a_2, twice, a_0 = (product.coeff_monomial(z**n) for n in (2, 1, 0))
        a_1 = twice / 2
        inside = a_1**2 - a_2 * a_0
        if product.degree() > 2 or not all(e.is_real for e in (a_0, a_1, a_2)):
            raise RuleError(f"missing premise: {function} times {self.factor} is quadratic")
        y, facts = sp.Dummy(**x.assumptions0), facts_of(premises)
        whole = sp.Tuple(function, self.factor).xreplace({x: y})  # as written: nothing cancels
        for goal in undefined(whole, *premises):
            if not holds(goal, facts | {positive(y)}):
                raise RuleError(f"missing premise: {in_words(goal)}")
        require(positive(self.factor.subs(x, z)), *premises)
        for goal in (positive(a_0), nonnegative(inside), positive(inside - a_1 * sp.Abs(a_1))):
            require(goal, *premises)
        root = a_0 / (sp.sqrt(inside) - a_1)
        return Conclusion(Equality(self.zero, root), gives=(self.zero,))
