"""Dimensionless groups: on how few numbers the wear really depends.

Overview
    Wear, closure and load are measured in the initial roughness of the bearing, time in
    periods.  Counting dimensions alone (Buckingham) leaves more groups than the equation needs,
    because the wear law uses K_c, p_max/H_c and V T only through their product: the largest
    wear of a cycle, M.  One worn solid has four groups, two worn solids seven, and a compliant
    support adds one.
Key results
    one_solid     f_c, M/sigma_c0, h_0/sigma_c0, U/sigma_c0
    two_solids    and f_a, kappa, sigma_a0/sigma_c0
    compliant     one solid, and p_max/(k sigma_c0)
    count         number of data and rank of their dimension matrix
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from .. import sample
from ..check import Check
from ..dimensions import dimension
from ..equations import Equation
from ..note import condensed
from ..note.condensed import bearing_only
from ..rules import SAMPLES, Authored, proof
from ..rules.authored import insert
from ..statement import Statement, given
from ..symbols import symbols
from ..typeset.display import as_written, over
from ..zero import is_zero

U_a, u_c, p, h_0, U, k, T, V = symbols("U_a u_c p h_0 U k T V")
f_a, f_c, K_a, K_c, H_a, H_c, p_max = symbols("f_a f_c K_a K_c H_a H_c p_max")
sigma_a0, sigma_c0, kappa, tau = symbols("sigma_a0 sigma_c0 kappa tau")

v, a, q = (sp.Function(name, real=True)(tau) for name in ("v", "a", "y"))
"""Wear in initial roughnesses, load in amplitudes, pressure in largest pressures."""

mu, eta, nu, zeta, lamda = sp.symbols("mu eta nu zeta lambda", positive=True)
"""The groups: M, h_0, U and sigma_a0 over sigma_c0, and p_max/(k sigma_c0)."""

SCALES = {u_c: sigma_c0 * v, U_a: U * a, p: p_max * q}

GROUPS = (
    (mu, K_c * V * p_max * T / (3 * H_c * sigma_c0)),
    (eta, h_0 / sigma_c0),
    (nu, U / sigma_c0),
    (zeta, sigma_a0 / sigma_c0),
    (kappa, K_a * H_c / (K_c * H_a)),
    (lamda, p_max / (k * sigma_c0)),
)
DEFINITIONS = {name: given(sp.Eq(name, value), "definition", name) for name, value in GROUPS}

ONE = (K_c, H_c, V, p_max, T, f_c, sigma_c0, h_0, U)
TWO = (*ONE, K_a, H_a, f_a, sigma_a0)


@dataclass(frozen=True)
class Nondimensional(Authored):
    """An authored equation between dimensionless quantities: the parent, scaled.

    Proof: the parent's right side, with scaled fields and times ``factor``, is that of the
    claim, in which no datum is left but the groups.
    """

    factor: sp.Expr
    groups: tuple[sp.Symbol, ...]
    data: tuple[sp.Symbol, ...]

    def check(self, statement: Statement) -> tuple[Check, ...]:
        parent, *definitions = statement.parents
        claim = statement.claim
        scaled = self.factor * parent.claim.rhs.subs(SCALES)
        rest = insert(claim.rhs, tuple(definitions)) - scaled
        left = claim.rhs.free_symbols - {tau}
        proved = is_zero(rest) and left == set(self.groups)
        found, rank = count(self.data)
        detail = (
            f"scaling gives the claim: {found} data, rank {rank}, hence at most "
            f"{found - rank} groups, of which {len(self.groups)} occur"
        )
        return proof(proved, detail), self._sample(rest)

    def _sample(self, rest: sp.Expr) -> Check:
        rest = rest.subs({field: sp.Symbol(field.func.__name__) for field in (v, a, q)})
        worlds = sample.satisfying((), rest, (), SAMPLES)
        passed = all(abs(sample.evaluate(rest, w)) < 10**-sample.DIGITS for w in worlds)
        return Check("sample", passed, f"{SAMPLES} points, {sample.DIGITS} digits")


def count(data: tuple[sp.Symbol, ...]) -> tuple[int, int]:
    """Return how many data there are, and the rank of their dimension matrix.

    >>> count(ONE)
    (9, 3)
    """
    rows = [list(dimension(datum) or ()) for datum in data]
    return len(data), sp.Matrix([[sp.Rational(str(x)) for x in row] for row in rows]).rank()


def _statement(
    parent: Statement,
    claim: sp.Basic,
    factor: sp.Expr,
    groups: tuple[sp.Symbol, ...],
    data: tuple[sp.Symbol, ...],
) -> Statement:
    definitions = tuple(DEFINITIONS[group] for group in groups if group in DEFINITIONS)
    rule = Nondimensional(factor, groups, data)
    return Statement(claim, rule, (parent, *definitions), parent.conditions, name="scaled")


def _rate(closure: sp.Expr, roughness: sp.Expr) -> sp.Basic:
    argument = sp.Add(4, -(2 * closure / roughness))
    return sp.Eq(sp.Derivative(v, tau), mu / 2 * (1 + sp.tanh(argument)))


def _one() -> sp.Basic:
    return _rate(sp.Add(eta, v, -(nu * a)), 1 + f_c * v)


def _two() -> sp.Basic:
    roughness = sp.sqrt((zeta + f_a * (kappa * v)) ** 2 + (1 + f_c * v) ** 2)
    return _rate(sp.Add(eta, (1 - kappa) * v, -(nu * a)), roughness)


def _compliant() -> sp.Basic:
    closure = sp.Add(eta, v, -(nu * a), lamda * q)
    argument = sp.Add(4, -(2 * closure / (1 + f_c * v)))
    return sp.Eq(q, over(2) * (1 + sp.tanh(argument)))


def one_solid() -> Statement:
    """Four groups for one worn solid."""
    parent = bearing_only().rigid
    return _statement(parent, _one(), T / sigma_c0, (f_c, mu, eta, nu), ONE)


def two_solids() -> Statement:
    """Seven groups for two worn, rough solids."""
    parent = condensed.two_solids().rigid
    groups = (f_c, mu, eta, nu, f_a, kappa, zeta)
    return _statement(parent, _two(), T / sigma_c0, groups, TWO)


def compliant() -> Statement:
    """One more group for a compliant support, in the pressure."""
    parent = bearing_only().pressure_of_bearing_wear
    groups = (f_c, eta, nu, lamda)
    return _statement(parent, _compliant(), 1 / p_max, groups, (*ONE, k))


def equations() -> tuple[Equation, ...]:
    """Return the dimensionless problems."""
    section = "dimensionless groups"
    with as_written():
        one, two, soft = _one(), _two(), _compliant()
    return tuple(
        Equation(name, section, title, (found, *more), display=(law, *(s.claim for s in more)))
        for name, title, found, law, more in (
            ("groups-one-solid", "four groups", one_solid(), one, _defined(mu, eta, nu)),
            ("groups-two-solids", "seven groups", two_solids(), two, _defined(kappa, zeta)),
            ("groups-compliant", "pressure, one more group", compliant(), soft, _defined(lamda)),
        )
    )


def _defined(*groups: sp.Symbol) -> tuple[Statement, ...]:
    return tuple(DEFINITIONS[group] for group in groups)
