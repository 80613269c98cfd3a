"""The vocabulary: every quantity of the model, once.

Overview
    One table gives each quantity its name, LaTeX, unit, meaning and domain.  Symbols,
    dimension checks, nomenclature tables and the sampling of tests all come from it.
Key results
    QUANTITIES     the table
    symbol(name)   the SymPy symbol, or the function of time, of a quantity
    t              time
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from types import MappingProxyType

import sympy as sp

t = sp.Symbol("t", nonnegative=True)
"""Time."""


@dataclass(frozen=True)
class Domain:
    """Where a quantity may lie, and the range that samples are drawn from.

    ``positive`` bounds the quantity in every theorem; ``low`` and ``high`` only say which
    part of its domain is worth sampling.
    """

    low: float
    high: float
    positive: bool = False
    nonnegative: bool = False
    logarithmic: bool = False


@dataclass(frozen=True)
class Quantity:
    """One row of the vocabulary."""

    name: str
    latex: str
    unit: str
    meaning: str
    domain: Domain
    varies: bool = False  # a function of time


def _positive(low: float, high: float) -> Domain:
    return Domain(low, high, positive=True, logarithmic=True)


def _nonnegative(low: float, high: float) -> Domain:
    return Domain(low, high, nonnegative=True)


def _real(low: float, high: float) -> Domain:
    return Domain(low, high)


_LENGTH = _real(-5e-3, 5e-3)

_TABLE = (
    Quantity("t", "t", "s", "time", _nonnegative(0, 600)),
    Quantity("T", "T", "s", "period of the load", _positive(1e-3, 1)),
    # fields
    Quantity("h", "h", "mm", "closure of the mean surfaces", _real(0, 2e-3), varies=True),
    Quantity(
        "h_rigid",
        r"h_{\mathrm{rigid}}",
        "mm",
        "closure if the support did not give way",
        _real(0, 2e-3),
        varies=True,
    ),
    Quantity(
        "U_a", "U_a", "mm", "displacement of the pin (rigid translation)", _LENGTH, varies=True
    ),
    Quantity(
        "U_c",
        "U_c",
        "mm",
        "displacement of the bearing on its support",
        _real(0, 1e-4),
        varies=True,
    ),
    Quantity("u_a", "u_a", "mm", "wear depth of the pin", _real(0, 3e-3), varies=True),
    Quantity("u_c", "u_c", "mm", "wear depth of the bearing", _real(0, 3e-3), varies=True),
    Quantity(
        "sigma_a", r"\sigma_a", "mm", "roughness of the pin", _nonnegative(1e-5, 1e-3), varies=True
    ),
    Quantity(
        "sigma_c",
        r"\sigma_c",
        "mm",
        "roughness of the bearing",
        _nonnegative(1e-5, 1e-3),
        varies=True,
    ),
    Quantity("sigma", r"\bar{\sigma}", "mm", "equivalent roughness", _positive(1e-5, 1e-3), True),
    Quantity("p", "p", "MPa", "contact pressure", _positive(1e-6, 300), varies=True),
    Quantity("R_a", "R_a", "MPa mm^2", "reaction force of the pin", _real(-1e6, 1e6), varies=True),
    # data
    Quantity("h_0", "h_0", "mm", "initial closure", _nonnegative(2e-4, 2e-3)),
    Quantity(
        "sigma_a0", r"\sigma_a^0", "mm", "initial roughness of the pin", _positive(1e-5, 5e-4)
    ),
    Quantity(
        "sigma_c0", r"\sigma_c^0", "mm", "initial roughness of the bearing", _positive(1e-4, 1e-3)
    ),
    Quantity("f_a", "f_a", "1", "roughness growth of the pin, d sigma_a/d u_a", _real(-0.05, 0.6)),
    Quantity(
        "f_c", "f_c", "1", "roughness growth of the bearing, d sigma_c/d u_c", _real(-0.05, 0.6)
    ),
    Quantity("f_aa", "f_{aa}", "1", "slope of sigma_a with u_a", _real(-0.05, 0.6)),
    Quantity("f_ac", "f_{ac}", "1", "slope of sigma_a with u_c", _real(-0.05, 0.6)),
    Quantity("f_cc", "f_{cc}", "1", "slope of sigma_c with u_c", _real(-0.05, 0.6)),
    Quantity("f_ca", "f_{ca}", "1", "slope of sigma_c with u_a", _real(-0.05, 0.6)),
    Quantity("K_a", "K_a", "1", "wear coefficient of the pin", _positive(1e-8, 1e-4)),
    Quantity("K_c", "K_c", "1", "wear coefficient of the bearing", _positive(1e-8, 1e-4)),
    Quantity("H_a", "H_a", "MPa", "hardness of the pin", _positive(50, 5e3)),
    Quantity("H_c", "H_c", "MPa", "hardness of the bearing", _positive(50, 5e3)),
    Quantity(
        "p_max", r"p_{\max}", "MPa", "largest admissible contact pressure", _positive(10, 3e3)
    ),
    Quantity("k", "k", "MPa/mm", "stiffness of the support per area", _positive(1e4, 1e7)),
    Quantity("b", "b", "mm", "width of the contact", _positive(1, 100)),
    Quantity("L", "L", "mm", "length of the contact", _positive(1, 100)),
    Quantity("R", "R", "mm", "radius of the pin", _positive(1, 100)),
    Quantity("n", "n", "rpm", "speed of rotation", _positive(10, 1e4)),
    Quantity("omega", r"\omega", "1/s", "angular speed of the pin", _positive(1, 1e3)),
    Quantity("V", "V", "mm/s", "slip rate", _positive(1, 1e5)),
    Quantity("U", "U", "mm", "amplitude of a sine load", _positive(1e-5, 2e-3)),
    # derived constants
    Quantity(
        "kappa", r"\kappa", "1", "wear of the pin per wear of the bearing", _positive(0.01, 3)
    ),
    Quantity("C", "C", "mm/s", "wear rate at half the largest pressure", _positive(1e-7, 1e-1)),
    Quantity(
        "u_cum", r"u_{\mathrm{cum}}", "mm", "asymptotic wear per cycle", _positive(1e-12, 1e-2)
    ),
    Quantity("p_inf", r"p_\infty", "MPa", "asymptotic contact pressure", _positive(1e-12, 3e3)),
    Quantity("x_inf", r"x_\infty", "1", "limit of the argument of tanh", _real(-30, 4)),
    Quantity(
        "M",
        "M",
        "mm",
        "wear of one cycle under the largest pressure, K_c V T p_max/(3 H_c)",
        _positive(1e-7, 1e-1),
    ),
    Quantity("b_0", "b_0", "mm", "sigma_c0/f_c - h_0", _LENGTH),
    Quantity("beta", r"\beta", "mm", "2 (b_0 + U_a)", _LENGTH),
    Quantity("theta", r"\theta", "1", "tanh x_inf", _real(-1, 1)),
    Quantity("A", "A", "mm", "coefficient of the logarithmic drift of wear", _LENGTH),
    Quantity("p_s", "p'", "MPa", "pressure, as variable of integration", _positive(1e-6, 300)),
    # long-time expansion
    Quantity("tau", r"\tau", "1", "time in cycles, t/T", _nonnegative(0, 1e6)),
    Quantity("s_0", "s_0", "mm", "what the roughness remembers of its start", _LENGTH),
    Quantity("m", "m", "mm", "roughness without its oscillation in a cycle", _positive(1e-3, 1)),
    Quantity(
        "rho", r"\rho", "mm", "asymptotic growth of the roughness per cycle", _positive(1e-8, 1e-3)
    ),
    Quantity("c_1", "c_1", "mm", "drift at order 1/m", _LENGTH),
    Quantity("c_2", "c_2", "mm^2", "drift at order 1/m^2", _real(-1e-5, 1e-5)),
    Quantity("c_3", "c_3", "mm^3", "drift at order 1/m^3", _real(-1e-8, 1e-8)),
    Quantity("c_4", "c_4", "mm^4", "drift at order 1/m^4", _real(-1e-11, 1e-11)),
    Quantity("w_1", "w_1", "mm^2", "oscillation at order 1/m", _real(-1e-5, 1e-5)),
    Quantity("w_2", "w_2", "mm^3", "oscillation at order 1/m^2", _real(-1e-8, 1e-8)),
    # long time
    Quantity("G", "G", "1", "any field of a system", _real(-2, 2), varies=True),
    Quantity("G_inf", r"G_\infty", "1", "asymptotic response of a field", _real(-2, 2), True),
    Quantity("u_inf", r"u_{c\infty}", "mm", "asymptotic response in wear", _LENGTH, varies=True),
    Quantity("t_inf", r"t_\infty", "s", "time to stabilisation", _nonnegative(0, 600)),
    Quantity("U_mean", r"\langle U_a\rangle", "mm", "mean of the load over a period", _LENGTH),
    Quantity("U_max", r"\max U_a", "mm", "largest displacement of the pin", _real(0, 1e-3)),
    Quantity("U_min", r"\min U_a", "mm", "smallest displacement of the pin", _real(-1e-3, 0)),
    Quantity("epsilon", r"\varepsilon", "1", "resolution of p/p_max", _positive(1e-20, 0.4)),
    Quantity("u_stop", r"u_{\mathrm{stop}}", "mm", "arrest depth", _positive(1e-5, 1e-2)),
    Quantity("N", "N", "1", "number of cycles", _positive(1, 1e9)),
    Quantity(
        "u_perm", r"u_{\mathrm{perm}}", "mm", "wear beyond which contact is permanent", _LENGTH
    ),
    Quantity("d", "d", "1", "fraction of the period in contact", _positive(0.01, 1)),
    Quantity("h_star", "h^*", "mm", "gap where the roughness would vanish", _positive(1e-4, 2e-2)),
    Quantity("q", "q", "1", "roughening of both solids per wear", _positive(0.01, 1)),
    Quantity("g", "g", "1", "opening of the gap per wear", _real(-1, 3)),
    Quantity("p_1", "p_1", "mm", "half the slope of sigma^2 at the start", _real(-1e-4, 1e-4)),
)

DATA = frozenset(
    name
    for names in (
        "h_0 sigma_a0 sigma_c0 f_a f_c f_ac f_ca K_a K_c H_a H_c",
        "p_max k b L R n V U T",
    )
    for name in names.split()
)
"""Parameters that may vary each by itself: all others are made of them."""

CLOCKS = frozenset(["t", "tau", "N", "m", "z", "E", "w_1", "w_2"])
"""Symbols of what varies in time; any other symbol is a constant."""

QUANTITIES = MappingProxyType({quantity.name: quantity for quantity in _TABLE})
"""The vocabulary by name."""


@cache
def symbol(name: str) -> sp.Expr:
    """Return the symbol of a quantity, or its function of time.

    >>> symbol("p_max"), symbol("u_c")
    (p_max, u_c(t))
    """
    quantity = QUANTITIES[name]
    domain = quantity.domain
    if quantity.varies:
        return sp.Function(name, **_assumptions(domain))(t)
    return sp.Symbol(name, **_assumptions(domain))


def _assumptions(domain: Domain) -> dict[str, bool]:
    if domain.positive:
        return {"positive": True}
    if domain.nonnegative:
        return {"nonnegative": True}
    return {"real": True}


def symbols(names: str) -> tuple[sp.Expr, ...]:
    """Return several symbols at once: ``symbols("h h_0 U_a")``."""
    return tuple(symbol(name) for name in names.split())


def rate(name: str) -> sp.Derivative:
    """Return the time derivative of a quantity that varies."""
    return sp.Derivative(symbol(name), t)


def initial(name: str) -> sp.Expr:
    """Return the value at time zero of a quantity that varies."""
    return symbol(name).subs(t, 0)
