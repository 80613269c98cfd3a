"""Dimensionless groups: the independent parameters of the wear.

Overview
    Wear, closure and load are measured in the initial roughness of the bearing, time in
    periods.  Counting dimensions alone (Buckingham) leaves more groups than the equation needs,
    because the wear law uses K_c, p_max/H_c and V T only through their product: the largest
    wear of a cycle, M.  One worn solid has four groups, two worn solids seven, and a compliant
    support adds one.
Key results
    groups_one_solid    f_c, M/sigma_c0, h_0/sigma_c0, U/sigma_c0
    groups_two_solids   and f_a, kappa, sigma_a0/sigma_c0
    groups_compliant    one solid, and p_max/(k sigma_c0)
    count               number of data and rank of their dimension matrix
"""

from __future__ import annotations

import sympy as sp

from ..dimensions import BASE, parse_unit
from ..equations import stated
from ..kernel import Judgement
from ..note import condensed
from ..note.condensed import bearing_only
from ..rules.algebra import Consequence
from ..rules.assumption import define, defined
from ..rules.calculus import change_clock
from ..rules.inequalities import Arithmetic
from ..symbols import QUANTITIES, symbols, t

U_a, u_c, p, h_0, U, k, T, V = symbols("U_a u_c p h_0 U k T V")
f_a, f_c, K_a, K_c, H_a, H_c, p_max = symbols("f_a f_c K_a K_c H_a H_c p_max")
sigma_a0, sigma_c0, kappa, tau = symbols("sigma_a0 sigma_c0 kappa tau")

v, a, q = (sp.Function(name, real=True)(tau) for name in ("v", "a", "y"))
"""Wear in initial roughnesses, load in amplitudes, pressure in largest pressures."""

mu, nu, zeta, lamda = sp.symbols("mu nu zeta lambda", positive=True)
eta = sp.Symbol("eta", nonnegative=True)
"""The groups: M, h_0, U and sigma_a0 over sigma_c0, and p_max/(k sigma_c0)."""

SCALES = tuple(
    define(sp.Eq(field, unit * value))
    for field, unit, value in ((u_c, sigma_c0, v), (U_a, U, a), (p, p_max, q))
)
CLOCK = defined(t, T * tau)

GROUPS = (
    (mu, K_c * V * p_max * T / (3 * H_c * sigma_c0)),
    (eta, h_0 / sigma_c0),
    (nu, U / sigma_c0),
    (zeta, sigma_a0 / sigma_c0),
    (kappa, K_a * H_c / (K_c * H_a)),
    (lamda, p_max / (k * sigma_c0)),
)
DEFINITIONS = {name: defined(name, value) for name, value in GROUPS}

ONE = (K_c, H_c, V, p_max, T, f_c, sigma_c0, h_0, U)
TWO = (*ONE, K_a, H_a, f_a, sigma_a0)


def count(data: tuple[sp.Symbol, ...]) -> tuple[int, int]:
    """Return the number of data and the rank of their dimension matrix.

    >>> count(ONE)
    (9, 3)
    """
    units = [parse_unit(QUANTITIES[datum.name].unit).as_powers_dict() for datum in data]
    return len(data), sp.Matrix([[unit[base] for base in BASE] for unit in units]).rank()


def _scaled(
    identifier: str, rough: Judgement, parent: Judgement, groups: tuple[sp.Symbol, ...]
) -> Judgement:
    """Return a scaled equation, whose only data are the groups."""
    fields = {field.func.__name__: field.func for field in (v, a, q)}
    names = {group.name: group for group in (mu, eta, nu, zeta, lamda)}
    claim, *_ = stated(identifier, fields | names)
    definitions = tuple(DEFINITIONS[group] for group in groups if group in DEFINITIONS)
    clock = change_clock(SCALES[0], CLOCK)
    factor, pace = (1 / p_max, ()) if claim.lhs == q else (T / sigma_c0, (clock,))
    first = Arithmetic(parent.claim.map(lambda side: factor * side).relation)(parent)
    return Consequence(claim)(first, *pace, *SCALES, *definitions, rough, name="scaled")


GROUPS_OF_ONE = (f_c, mu, eta, nu)
GROUPS_OF_TWO = (f_c, mu, eta, nu, f_a, kappa, zeta)
GROUPS_COMPLIANT = (f_c, eta, nu, lamda)


_one, _two = bearing_only(), condensed.two_solids()

groups_one_solid = (
    _scaled("groups-one-solid", _one.roughness_at_wear, _one.rigid, GROUPS_OF_ONE),
    *(DEFINITIONS[group] for group in (mu, eta, nu)),
)
"""Four groups for one worn solid."""

_squares = (zeta + f_a * (kappa * v)) ** 2 + (1 + f_c * v) ** 2
_grown = _two.roughness_at_wear
_rough = Consequence(sp.Gt(sigma_c0**2 * _squares, 0))(
    Arithmetic(sp.Gt(_grown.claim.rhs**2, 0))(_grown),
    _two.wear_of_pin,
    *(SCALES[0], DEFINITIONS[zeta], DEFINITIONS[kappa]),
)
groups_two_solids = (
    _scaled("groups-two-solids", _rough, _two.rigid, GROUPS_OF_TWO),
    *(DEFINITIONS[group] for group in (kappa, zeta)),
)
"""Seven groups for two worn, rough solids."""

groups_compliant = (
    _scaled(
        "groups-compliant",
        _one.roughness_at_wear,
        _one.pressure_of_bearing_wear,
        GROUPS_COMPLIANT,
    ),
    DEFINITIONS[lamda],
)
"""One more group for a compliant support, in the pressure."""
