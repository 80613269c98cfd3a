"""Solutions of the differential equation, found by insight and proved by differentiating back.

Overview
    A closed form is proved by a machine that knows nothing of the insight.  Each rule has a
    second, independent route in numbers: quadrature, or insertion at 50 digits.
Key results
    Solution            t(u), the solution of du/dt = Q(u) under a constant load
    Inverted            u(t), the inverse of such a t(u)
    ParametricSolution  t(p), where wear and rate are functions of the pressure
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import mpmath
import sympy as sp

from .. import sample
from ..check import Check
from ..sample import Source
from ..symbols import symbol, t
from ..zero import is_zero
from . import SAMPLES, Authored, RuleError, proof
from .authored import insert

if TYPE_CHECKING:
    from ..statement import Statement


@dataclass(frozen=True)
class Solution(Authored):
    """An authored ``t = F(u)``, the solution of ``du/dt = Q(u)`` for a load that does not vary.

    The first parent gives the rate Q, further ones name the constants of the claim.  Proof: F
    vanishes at u = 0 and dF/du = 1/Q.
    """

    def check(self, statement: Statement) -> tuple[Check, ...]:
        unknown, slowness, time = self._pieces(statement)
        slope = is_zero(sp.diff(time, unknown) - slowness)
        start = is_zero(time.subs(unknown, 0))
        detail = "its derivative is the reciprocal of the rate, and it begins at 0"
        return proof(slope and start, detail), self._sample(statement)

    def _pieces(self, statement: Statement) -> tuple[sp.Symbol, sp.Expr, sp.Expr]:
        """Return u, 1/Q(u) and F(u), with the fields as plain symbols."""
        law, *definitions = statement.parents
        u, constant = sp.Symbol("u", nonnegative=True), sp.Symbol("U", real=True)
        (wear,) = (d.expr for d in law.claim.lhs.atoms(sp.Derivative))
        plain = {wear: u, symbol("U_a"): constant}
        rate = insert(law.claim.rhs, tuple(definitions)).xreplace(plain)
        claim = statement.claim
        time = insert(claim.rhs, tuple(definitions)).xreplace(plain)
        if claim.lhs != t:
            raise RuleError(f"{claim} does not give the time")
        return u, (1 / rate).rewrite(sp.exp), time

    def _sample(self, statement: Statement) -> Check:
        """Compare F with the integral of 1/Q, by quadrature."""
        unknown, slowness, time = self._pieces(statement)
        everything = sp.Tuple(slowness, time)
        worlds = sample.satisfying((), everything, statement.conditions, 3)
        passed = all(_quadrature_agrees(unknown, slowness, time, world) for world in worlds)
        return Check("sample", passed, "3 points, quadrature of 1/Q, 30 digits")


def _quadrature_agrees(
    unknown: sp.Symbol, slowness: sp.Expr, time: sp.Expr, world: sample.World
) -> bool:
    rest = {key: value for key, value in world.items() if key != unknown}
    end = sp.Float("1e-3", 60)
    claimed = sample.evaluate(time, {**rest, unknown: end})
    integrand = sp.lambdify(unknown, slowness.xreplace(rest), "mpmath")
    with mpmath.workdps(60):
        found = mpmath.quad(integrand, mpmath.linspace(0, mpmath.mpf(end), 5))
    return bool(abs(sp.Float(found, 60) - claimed) <= sp.Float(10) ** -30 * abs(claimed))


@dataclass(frozen=True)
class Inverted(Authored):
    """An authored ``u = G(t)``, the inverse of the parent's ``t = F(u)``.

    G may use Lambert's W: with ``x = w e^w`` for its argument, exponentials of W are rational.
    """

    def check(self, statement: Statement) -> tuple[Check, ...]:
        (parent,) = statement.parents
        wear, inverse = statement.claim.lhs, statement.claim.rhs
        rest = parent.claim.rhs.subs(wear, inverse) - parent.claim.lhs
        detail = "inserted into the solution, it gives back the time"
        return proof(is_zero(_resolved(rest)), detail), self._sample(rest, statement)

    def _sample(self, rest: sp.Expr, statement: Statement) -> Check:
        worlds = sample.satisfying((), rest, statement.conditions, SAMPLES)
        scales = (abs(world[t]) * sp.Float(10) ** -sample.DIGITS for world in worlds)
        rests = (abs(sample.evaluate(rest, world)) for world in worlds)
        passed = all(found <= scale for found, scale in zip(rests, scales, strict=True))
        return Check("sample", passed, f"{SAMPLES} points, {sample.DIGITS} digits")


def _resolved(expr: sp.Expr) -> sp.Expr:
    """Use e^(-W(x)) = W(x)/x, for one Lambert function on which exponentials depend linearly."""
    (lambert,) = expr.atoms(sp.LambertW)
    w = sp.Dummy(positive=True)
    expr = expr.subs(lambert, w)
    exponents = {e: sp.expand(e.exp) for e in expr.atoms(sp.exp) if e.has(w)}
    powers = {
        e: sp.exp(inside.coeff(w, 0)) * (w / lambert.args[0]) ** -inside.coeff(w, 1)
        for e, inside in exponents.items()
    }
    return expr.xreplace(powers)


@dataclass(frozen=True)
class ParametricSolution(Authored):
    """An authored ``t = F(p)``, for wear ``u = G(p)`` at the rate ``du/dt = Q(p)``.

    The parents give the rate, the wear, and names of constants.  Proof: dF/dp = (dG/dp)/Q, and
    F vanishes at p(0), where G does.
    """

    def check(self, statement: Statement) -> tuple[Check, ...]:
        pieces = _Parametric.of(statement)
        slope = is_zero(sp.diff(pieces.time, pieces.pressure) - pieces.slowness)
        start = pieces.time.subs(pieces.pressure, pieces.start).doit()
        begins = is_zero(start.subs(pieces.load, pieces.load_at_start))
        detail = "its derivative is that of the wear over the rate, and it begins at 0"
        return proof(slope and begins, detail), self._sample(pieces, statement)

    def _sample(self, pieces: _Parametric, statement: Statement) -> Check:
        """Compare F with the integral of dt/dp, by quadrature."""
        everything = sp.Tuple(pieces.slowness, pieces.load_at_start)
        worlds = sample.satisfying((), everything, statement.conditions, 3)
        passed = all(pieces.agree(world) for world in worlds)
        return Check("sample", passed, "3 points, quadrature of dt/dp, 30 digits")


@dataclass(frozen=True)
class _Parametric:
    """What a parametric solution says, with the fields as plain symbols."""

    pressure: sp.Symbol
    start: sp.Symbol
    load: sp.Symbol
    load_at_start: sp.Expr
    slowness: sp.Expr
    time: sp.Expr

    @staticmethod
    def of(statement: Statement) -> _Parametric:
        law, wear, *names = statement.parents
        pressure, load = sp.Symbol("pressure", positive=True), sp.Symbol("load", real=True)
        start, p = sp.Symbol("start", positive=True), symbol("p")
        plain = {p: pressure, p.subs(t, 0): start, symbol("U_a"): load}
        rate, worn, time = (
            insert(s.claim.rhs, tuple(names)).xreplace(plain) for s in (law, wear, statement)
        )
        begins = Source.of(sp.Eq(worn.subs(pressure, start), 0), load).value
        return _Parametric(pressure, start, load, begins, sp.diff(worn, pressure) / rate, time)

    def agree(self, world: sample.World) -> bool:
        """Return whether quadrature from the first pressure to a near one gives F."""
        known = {key: value for key, value in world.items() if key not in (self.load, self.start)}
        first = known[symbol("p_max")] * sp.Rational(1, 50)
        begins = self.load_at_start.xreplace(known).xreplace({self.start: first})
        known |= {self.start: first, self.load: begins}
        del known[self.pressure]
        with mpmath.workdps(60):
            slowness, time = (
                sp.lambdify(self.pressure, e.xreplace(known), "mpmath")
                for e in (self.slowness, self.time)
            )
            low, high = mpmath.mpf(sp.N(first, 60)), mpmath.mpf(sp.N(first, 60)) * 1.01
            found, claimed = mpmath.quad(slowness, [low, high]), time(high)
        return bool(abs(found - claimed) <= mpmath.mpf(10) ** -30 * abs(claimed))
