"""Regimes: what becomes of the wear of one solid for f_c = 0 and f_c < 0, without cutoff.

Overview
    f_c > 0 is the steady regime.  For f_c = 0 the argument of tanh falls with the wear without
    bound, the rate is close to its exponential tail, and wear grows like the logarithm of the
    cycles.  For f_c < 0 the roughness would vanish at the wear sigma_c0/|f_c|.  There the gap
    at the peak of the load is h* = h_0 + sigma_c0/|f_c| - max U_a.  If it is open, wear
    saturates at that depth, logarithmically slowly; if not, roughness vanishes in finite time.
Key results
    tail            the rate is below its exponential tail, by a factor that tends to 1
    logarithmic     f_c = 0: the wear of the tail, for any periodic load
    saturating      f_c < 0, h* > 0: the cycles at which the roughness is s, static load
    finite          f_c < 0, h* <= 0: the rate while the peak of the load is in contact
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import mpmath
import sympy as sp

from ..check import Check
from ..conditions import Condition
from ..equations import Equation
from ..laws import TANH
from ..note.condensed import bearing_only
from ..rules import Authored, proof
from ..rules.authored import Positive
from ..rules.bounds import Consequence, Monotone
from ..rules.limits import T
from ..statement import Statement, given
from ..symbols import rate, symbols
from ..typeset.display import as_written, minus
from ..zero import is_zero
from .static_solution import CONSTANT_LOAD
from .steady_state import closure, made, roughness, step

h_0, U_a, u_c, U, N, M, h_star = symbols("h_0 U_a u_c U N M h_star")
sigma_c0, sigma_c, f_c, p_max, K_c, H_c, V = symbols("sigma_c0 sigma_c f_c p_max K_c H_c V")

SMOOTHING = Condition("the bearing smoothens as it wears", sp.Lt(f_c, 0))
ROUGH = Condition("the roughness has not vanished", sp.Gt(roughness, 0))
SINE = Condition("the load is U sin(2 pi t/T)", typeset=r"U_a = U \sin{\left(2 \pi t/T\right)}")

_decline, _left, _overlap = sp.symbols("decline left overlap", positive=True)
_FALLING = (
    (f_c, -_decline),
    (u_c, (sigma_c0 - _left) / _decline),
    (U_a, h_0 + sigma_c0 / _decline + _overlap),
)
"""f_c < 0, a positive roughness and a load that closes the gap, in positive parameters."""

_BY_RATIO = ((U_a, h_0 + u_c - sp.Symbol("ratio", real=True) * roughness),)
"""The load in terms of the ratio h/sigma, which takes every real value."""

largest_wear = given(sp.Eq(M, K_c * V * T * p_max / (3 * H_c)), "definition", M)


@dataclass(frozen=True)
class Separated(Authored):
    """The tail of the rate for f_c = 0, ``du/dt = a e^(-4 (u - U_a)/sigma_c0)``, over N cycles.

    Along the tail d/dt e^(4 u/sigma_c0) does not depend on u; its mean over a cycle of a sine
    load is that of e^(z sin), which is I_0(z) (DLMF 10.32.1; checked by quadrature).
    """

    def check(self, statement: Statement) -> tuple[Check, ...]:
        tail, size = (parent.claim for parent in statement.parents)
        grown = sp.exp(4 * u_c / sigma_c0)
        load, wear = sp.Dummy(real=True), sp.Dummy(real=True)
        growth = (sp.diff(grown, u_c) * tail.rhs).xreplace({U_a: load, u_c: wear})
        growth = sp.powsimp(sp.expand(growth))
        base = growth.subs(load, 0)
        mean = base * sp.besseli(0, 4 * U / sigma_c0)
        separable = not growth.has(wear) and is_zero(growth / base - sp.exp(4 * load / sigma_c0))
        claimed = sp.exp(4 * statement.claim.rhs / sigma_c0).subs(size.lhs, size.rhs)
        grows = is_zero(sp.powsimp(sp.expand_log(claimed)) - (1 + N * T * mean))
        detail = "e^(4 u_c/sigma_c0) grows by the same amount in every cycle"
        return proof(bool(separable and grows), detail), _bessel_mean()


def _bessel_mean() -> Check:
    """Compare the mean of e^(z sin) with I_0(z)."""
    with mpmath.workdps(40):
        gaps = [
            abs(
                mpmath.quad(
                    lambda a, z=z: mpmath.exp(z * mpmath.sin(a)), [0, mpmath.pi, 2 * mpmath.pi]
                )
                / (2 * mpmath.pi * mpmath.besseli(0, z))
                - 1
            )
            for z in (mpmath.mpf("0.1"), mpmath.mpf(1), mpmath.mpf("5.6"), mpmath.mpf(20))
        ]
        passed = max(gaps) < mpmath.mpf(10) ** -30
    return Check("sample", bool(passed), "the mean of e^(z sin) is I_0(z): 4 points, 30 digits")


@dataclass(frozen=True)
class Asymptotic(Authored):
    """``ln N = F(s)`` as s -> 0: by L'Hopital's rule, from the rate of the parent.

    The parent gives du/dt; with ds = f du and N = t/T the exact dN/ds is compared with the
    claimed one: their quotient tends to 1.
    """

    def check(self, statement: Statement) -> tuple[Check, ...]:
        law, size = (parent.claim for parent in statement.parents)
        s, decline = sp.Dummy(positive=True), sp.Dummy(positive=True)
        depth = (sigma_c0 - s) / decline
        load = h_0 + sigma_c0 / decline - h_star
        exact_rate = law.rhs.subs({U_a: load, u_c: depth, f_c: -decline}).rewrite(sp.exp)
        claimed = sp.exp(statement.claim.rhs).subs(size.lhs, size.rhs)
        slope = sp.diff(claimed.subs({sigma_c: s, f_c: -decline}), s)
        quotient = _cancelled(-slope * decline * T * exact_rate)
        value = sp.limit(quotient, s, 0, "+")
        return (
            proof(value == 1, f"the quotient of claimed and exact dN/d sigma_c tends to {value}"),
        )


def _cancelled(expr: sp.Expr) -> sp.Expr:
    """Return a quotient of exponentials in one exponential of one argument."""
    expr = expr.replace(sp.exp, lambda argument: sp.exp(sp.expand(sp.cancel(argument))))
    expr = sp.powsimp(sp.expand(sp.together(expr)))
    return sp.factor(sp.powsimp(expr))


@dataclass(frozen=True)
class Regimes:
    """One worn solid, the law of the note, no cutoff."""

    @cached_property
    def rate(self) -> Statement:
        """Eq. (13), solved for the rate."""
        return bearing_only().rigid

    @cached_property
    def tail_rate(self) -> sp.Expr:
        """The exponential tail of the rate."""
        return K_c * V * p_max / (3 * H_c) * sp.exp(8 - 4 * closure / roughness)

    @cached_property
    def tail(self) -> Statement:
        """The rate is below its exponential tail."""
        bound = Statement(
            sp.Lt(self.rate.claim.rhs, self.tail_rate), Positive(_BY_RATIO), (), (ROUGH,)
        )
        claim = sp.Lt(rate("u_c"), self.tail_rate)
        return step(claim, Consequence(), bound, self.rate, name="tail of the rate")

    @cached_property
    def logarithmic(self) -> Statement:
        """Wear for f_c = 0 after N cycles of a sine load, in the tail: an upper bound."""
        tail = sp.Eq(rate("u_c"), self.tail_rate.subs(f_c, 0))
        source = given(tail, "the tail, whose wear bounds the wear from above", rate("u_c"))
        strength = sp.exp(8 - 4 * h_0 / sigma_c0) * sp.besseli(0, 4 * U / sigma_c0)
        claim = sp.Eq(u_c, sigma_c0 / 4 * sp.log(1 + 4 * M / sigma_c0 * strength * N))
        conditions = (SINE,)
        parents = (source, largest_wear)
        return Statement(claim, Separated(), parents, conditions, name="logarithmic wear")

    @cached_property
    def saturating(self) -> Statement:
        """The number of cycles at which the roughness has fallen to sigma_c, static load."""
        rest = sigma_c**2 / (-4 * f_c * h_star * M)
        claim = sp.Eq(sp.log(N), 4 * h_star / sigma_c - 8 + 4 / f_c + sp.log(rest))
        conditions = (SMOOTHING, CONSTANT_LOAD)
        parents = (self.rate, largest_wear)
        return Statement(claim, Asymptotic(), parents, conditions, name="saturating wear")

    @cached_property
    def finite(self) -> Statement:
        """While the load closes the gap, the rate stays above a positive constant."""
        overlap = given(sp.Eq(U_a, h_0 - sigma_c0 / f_c + U), "a load that closes the gap", U_a)
        claim = sp.Le(closure / roughness, 1 / f_c)
        ratio = Statement(claim, Positive(_FALLING), (overlap,), (SMOOTHING, ROUGH))
        y = sp.Dummy("r", real=True)
        wear_rate = sp.Lambda(y, K_c * V * p_max * TANH.ratio(y) / (3 * H_c))
        bound = made(Monotone(wear_rate), ratio)
        claim = sp.Le(bound.claim.lts, rate("u_c"))
        return step(claim, Consequence(), bound, self.rate, name="rate while the gap is closed")


def equations() -> tuple[Equation, ...]:
    """Return the regimes of one solid for f_c <= 0."""
    regimes = Regimes()
    section = "regimes"
    with as_written():
        level = sp.exp(sp.Add(8, minus(4 * h_0 / sigma_c0))) * sp.besseli(0, 4 * U / sigma_c0)
        inside = sp.Add(1, 4 * M / sigma_c0 * level * N)
        logarithmic = (sp.Eq(u_c, sigma_c0 / 4 * sp.log(inside)),)
        exponent = sp.Add(8, minus(4 * sp.Add(h_0, u_c, -U_a) / roughness))
        tail = (sp.Lt(rate("u_c"), K_c * V * p_max / (3 * H_c) * sp.exp(exponent)),)
        rest = sp.log(sigma_c**2 / (-4 * f_c * h_star * M))
        count = sp.Add(4 * h_star / sigma_c, -8, 4 / f_c, rest)
        saturating = (sp.Eq(sp.log(N), count),)
        fastest = K_c * V * p_max / (6 * H_c) * (1 + sp.tanh(sp.Add(4, minus(2 / f_c))))
        closed = (sp.Ge(rate("u_c"), fastest),)
    return (
        Equation("tail", section, "exponential tail of the rate", (regimes.tail,), (), tail),
        Equation(
            "logarithmic-wear",
            section,
            "wear along the tail after N cycles, f_c = 0",
            (regimes.logarithmic,),
            (),
            logarithmic,
        ),
        Equation(
            "saturating-wear",
            section,
            "cycles until the roughness is sigma_c, to leading order as it vanishes",
            (regimes.saturating,),
            (),
            saturating,
        ),
        Equation(
            "closed-gap",
            section,
            "least rate while U_a > h_0 - sigma_c0/f_c",
            (regimes.finite,),
            (),
            closed,
        ),
    )
