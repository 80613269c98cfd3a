"""The drift of wear: how the rate approaches its limit, and what that adds to the wear.

Key results
    LinearApproach      du/dt = F(h/sigma) with h/sigma = l - e/sigma gives t (du/dt - R) to O(1/t)
    FirstOrder          the same from u (h/sigma - l) - a(t) -> 0
    LogarithmicDrift    t (du/dt - R) - a(t) -> 0, a periodic, gives (u - R t)/ln t -> mean of a
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from ..symbols import t
from ..zero import is_zero
from . import RuleError, Theorem
from .limits import T, forever, in_terms_of


@dataclass(frozen=True)
class LinearApproach(Theorem):
    """How the rate approaches its limit, to first order in 1/t.

    Parents: ``du/dt = F(h/sigma)``; ``h/sigma = l - e/sigma`` exactly, with bounded e; the
    limits l of h/sigma and R of the rate.  With sigma = sigma_0 + f u:
    ``t (du/dt - R) + F'(l) e/(f R) -> 0``.
    """

    theorem = (
        "the contact law is differentiable at the limit, and sigma/t tends to f_c times the limit "
        "of du_c/dt"
    )

    def apply(self, parents: tuple[sp.Basic, ...]) -> sp.Basic:
        law, deviation, ratio, limit = parents
        y = sp.Dummy(real=True)
        function = in_terms_of(law.rhs, deviation.lhs, y)
        wear, speed = limit.lhs.args[0].expr, limit.rhs
        size = sp.denom(deviation.lhs)
        end = ratio.rhs
        load = sp.cancel((end - deviation.rhs) * size)
        if function.has(t) or load.has(wear) or not is_zero(function.subs(y, end) - speed):
            raise RuleError("the rate is no function of a ratio with that limit")
        slope = sp.cancel(sp.diff(function, y).subs(y, end) / speed)
        first_order = -slope * load / sp.diff(size, wear)
        return sp.Eq(forever(t * (limit.lhs.args[0] - speed) - first_order), 0)


@dataclass(frozen=True)
class FirstOrder(Theorem):
    """How the rate approaches its limit, from how h/sigma does.

    Parents: ``du/dt = F(h/sigma)``; ``u (h/sigma - l) - a -> 0``; the limits l and R:
    ``t (du/dt - R) - F'(l) a/R -> 0``.
    """

    theorem = (
        "the contact law is differentiable at the limit, and u_c/t tends to the limit of du_c/dt"
    )

    def apply(self, parents: tuple[sp.Basic, ...]) -> sp.Basic:
        law, deviation, ratio, limit = parents
        y = sp.Dummy(real=True)
        quantity, end = ratio.lhs.args[0], ratio.rhs
        rate, speed = limit.lhs.args[0], limit.rhs
        function = in_terms_of(law.rhs, quantity, y)
        wear = rate.expr
        first = sp.expand(wear * (quantity - end) - deviation.lhs.args[0])
        if function.has(t) or deviation.rhs != 0 or not is_zero(function.subs(y, end) - speed):
            raise RuleError("the rate is no function of a ratio with that limit")
        slope = sp.cancel(sp.diff(function, y).subs(y, end) / speed)
        return sp.Eq(forever(t * (rate - speed) - slope * first), 0)


@dataclass(frozen=True)
class LogarithmicDrift(Theorem):
    """From ``t (du/dt - R) - a(t) -> 0`` with periodic a: ``(u - R t)/ln(t/T) -> mean of a``."""

    mean: tuple[sp.Expr, sp.Expr]
    theorem = "a periodic function over t integrates to its mean times ln N and a bounded rest"

    def apply(self, parents: tuple[sp.Basic, ...]) -> sp.Basic:
        (limit,) = parents
        inside = limit.lhs.args[0]
        (rate,) = inside.atoms(sp.Derivative)
        load, average = self.mean
        speed_now, load_now = sp.Dummy(), sp.Dummy()
        flat = inside.xreplace({rate: speed_now}).xreplace({load: load_now})
        periodic = -flat.subs(t, 0)
        speed = sp.expand(speed_now - sp.diff(flat, t))
        rest = sp.expand(flat - t * (speed_now - speed) + periodic)
        linear = not sp.diff(periodic, load_now).has(load_now)
        if limit.rhs != 0 or rest != 0 or speed.has(t, speed_now) or not linear:
            raise RuleError(
                f"{limit} is not of the form t (du/dt - R) - a(t) -> 0, a linear in U_a"
            )
        drift = (rate.expr - speed * t) / sp.log(t / T)
        return sp.Eq(forever(drift), periodic.subs(load_now, average))
