"""The vocabulary: every quantity of the model, once.

Overview
    One table gives each quantity its name, LaTeX, unit, meaning and domain: the source of
    symbols, dimension checks and nomenclature tables.
Key results
    QUANTITIES     the table
    symbol(name)   the SymPy symbol, or the function of time, of a quantity
    t              time
"""

from __future__ import annotations

from functools import cache
from types import MappingProxyType
from typing import NamedTuple

import sympy as sp

t = sp.Symbol("t", nonnegative=True)
"""Time."""


REAL, NONNEGATIVE, POSITIVE = "real", "nonnegative", "positive"
"""Domains of quantities, assumed in every theorem."""


class Quantity(NamedTuple):
    """One row of the vocabulary."""

    name: str
    latex: str
    unit: str
    meaning: str
    domain: str
    varies: bool = False  # a function of time
    clock: str = "t"  # or of scaled time


_TABLE = (
    Quantity("t", "t", "s", "time", NONNEGATIVE),
    Quantity("T", "T", "s", "period of the load", POSITIVE),
    # fields
    Quantity("h", "h", "mm", "closure of the mean surfaces", REAL, True),
    Quantity(
        "h_rigid",
        r"h_{\mathrm{rigid}}",
        "mm",
        "closure on a rigid support",
        REAL,
        True,
    ),
    Quantity("U_a", "U_a", "mm", "displacement of the pin (rigid translation)", REAL, True),
    Quantity("U_c", "U_c", "mm", "displacement of the bearing on its support", REAL, True),
    Quantity("u_a", "u_a", "mm", "wear depth of the pin", REAL, True),
    Quantity("u_c", "u_c", "mm", "wear depth of the bearing", REAL, True),
    Quantity("sigma_a", r"\sigma_a", "mm", "roughness of the pin", NONNEGATIVE, True),
    Quantity("sigma_c", r"\sigma_c", "mm", "roughness of the bearing", NONNEGATIVE, True),
    Quantity("sigma", r"\bar{\sigma}", "mm", "equivalent roughness", POSITIVE, True),
    Quantity("p", "p", "MPa", "contact pressure", NONNEGATIVE, True),
    Quantity("R_a", "R_a", "MPa mm^2", "reaction force of the pin", REAL, True),
    # data
    Quantity("h_0", "h_0", "mm", "initial closure", NONNEGATIVE),
    Quantity("sigma_a0", r"\sigma_a^0", "mm", "initial roughness of the pin", POSITIVE),
    Quantity("sigma_c0", r"\sigma_c^0", "mm", "initial roughness of the bearing", POSITIVE),
    Quantity("f_a", "f_a", "1", "roughness growth of the pin, d sigma_a/d u_a", REAL),
    Quantity("f_c", "f_c", "1", "roughness growth of the bearing, d sigma_c/d u_c", REAL),
    Quantity("f_aa", "f_{aa}", "1", "slope of sigma_a with u_a", REAL),
    Quantity("f_ac", "f_{ac}", "1", "slope of sigma_a with u_c", REAL),
    Quantity("f_cc", "f_{cc}", "1", "slope of sigma_c with u_c", REAL),
    Quantity("f_ca", "f_{ca}", "1", "slope of sigma_c with u_a", REAL),
    Quantity("K_a", "K_a", "1", "wear coefficient of the pin", POSITIVE),
    Quantity("K_c", "K_c", "1", "wear coefficient of the bearing", POSITIVE),
    Quantity("H_a", "H_a", "MPa", "hardness of the pin", POSITIVE),
    Quantity("H_c", "H_c", "MPa", "hardness of the bearing", POSITIVE),
    Quantity("p_max", r"p_{\max}", "MPa", "largest admissible contact pressure", POSITIVE),
    Quantity("k", "k", "MPa/mm", "stiffness of the support per area", POSITIVE),
    Quantity("b", "b", "mm", "width of the contact", POSITIVE),
    Quantity("L", "L", "mm", "length of the contact", POSITIVE),
    Quantity("R", "R", "mm", "radius of the pin", POSITIVE),
    Quantity("n", "n", "rpm", "speed of rotation", POSITIVE),
    Quantity("omega", r"\omega", "1/s", "angular speed of the pin", POSITIVE),
    Quantity("V", "V", "mm/s", "slip rate", POSITIVE),
    Quantity("U", "U", "mm", "amplitude of a sine load", POSITIVE),
    # derived constants
    Quantity("kappa", r"\kappa", "1", "wear of the pin per wear of the bearing", POSITIVE),
    Quantity("C", "C", "mm/s", "wear rate at half the largest pressure", POSITIVE),
    Quantity("u_cum", r"u_{\mathrm{cum}}", "mm", "asymptotic wear per cycle", POSITIVE),
    Quantity("p_inf", r"p_\infty", "MPa", "asymptotic contact pressure", POSITIVE),
    Quantity("x_inf", r"x_\infty", "1", "limit of the argument of tanh", REAL),
    Quantity(
        "M",
        "M",
        "mm",
        "wear of one cycle under the largest pressure, K_c V T p_max/(3 H_c)",
        POSITIVE,
    ),
    Quantity("b_0", "b_0", "mm", "sigma_c0/f_c - h_0", REAL),
    Quantity("beta", r"\beta", "mm", "2 (b_0 + U_a)", REAL),
    Quantity("theta", r"\theta", "1", "tanh x_inf", REAL),
    Quantity("A", "A", "mm", "coefficient of the logarithmic drift of wear", REAL),
    Quantity("ell", r"\ell", "mm", "sigma_c0/8 exp(4 (h_0 - U_a)/sigma_c0 - 8)", POSITIVE),
    Quantity("p_s", "p'", "MPa", "pressure, as variable of integration", NONNEGATIVE),
    Quantity("u_s", "u'", "mm", "wear, as variable of integration", REAL),
    Quantity("sigma_s", r"\sigma'", "mm", "roughness, as variable of integration", NONNEGATIVE),
    # long-time expansion
    Quantity("tau", r"\tau", "1", "time in cycles, t/T", NONNEGATIVE),
    Quantity("s_0", "s_0", "mm", "constant of integration of the averaged roughness", REAL),
    Quantity("m", "m", "mm", "roughness without its oscillation in a cycle", POSITIVE),
    Quantity("rho", r"\rho", "mm", "asymptotic growth of the roughness per cycle", POSITIVE),
    Quantity("c_1", "c_1", "mm", "drift at order 1/m", REAL),
    Quantity("c_2", "c_2", "mm^2", "drift at order 1/m^2", REAL),
    Quantity("c_3", "c_3", "mm^3", "drift at order 1/m^3", REAL),
    Quantity("c_4", "c_4", "mm^4", "drift at order 1/m^4", REAL),
    Quantity("w_1", "w_1", "mm^2", "oscillation at order 1/m", REAL, True, "tau"),
    Quantity("w_2", "w_2", "mm^3", "oscillation at order 1/m^2", REAL, True, "tau"),
    Quantity("w_3", "w_3", "mm^4", "oscillation at order 1/m^3", REAL, True, "tau"),
    Quantity("w_4", "w_4", "mm^5", "oscillation at order 1/m^4", REAL, True, "tau"),
    # long time
    Quantity("G", "G", "1", "any field of a system", REAL, True),
    Quantity("G_inf", r"G_\infty", "1", "asymptotic response of a field", REAL, True),
    Quantity("u_inf", r"u_{c\infty}", "mm", "asymptotic response in wear", REAL, True),
    Quantity("t_inf", r"t_\infty", "s", "time to stabilisation", NONNEGATIVE),
    Quantity("U_mean", r"\langle U_a\rangle", "mm", "mean of the load over a period", REAL),
    Quantity("U_max", r"\max U_a", "mm", "largest displacement of the pin", REAL),
    Quantity("U_min", r"\min U_a", "mm", "smallest displacement of the pin", REAL),
    Quantity("epsilon", r"\varepsilon", "1", "resolution of p/p_max", POSITIVE),
    Quantity("u_stop", r"u_{\mathrm{stop}}", "mm", "arrest depth", POSITIVE),
    Quantity("N", "N", "1", "number of cycles", NONNEGATIVE),
    Quantity("u_perm", r"u_{\mathrm{perm}}", "mm", "wear beyond which contact is permanent", REAL),
    Quantity("d", "d", "1", "fraction of the period in contact", POSITIVE),
    Quantity("h_star", "h^*", "mm", "gap where the roughness would vanish", POSITIVE),
    Quantity("q", "q", "1", "roughening of both solids per wear", POSITIVE),
    Quantity("g", "g", "1", "opening of the gap per wear", REAL),
    Quantity("p_1", "p_1", "mm", "half the slope of sigma^2 at the start", REAL),
)

DATA = frozenset(
    name
    for names in (
        "h_0 sigma_a0 sigma_c0 f_a f_c f_ac f_ca K_a K_c H_a H_c",
        "p_max k b L R n V U T",
    )
    for name in names.split()
)
"""The independent parameters; all others are functions of them."""

EXTREMES = frozenset(["U_max", "U_min"])
"""The largest and the smallest load, which no definition may fix."""

CLOCKS = frozenset(["t", "tau", "N", "m", "z", "xi"])
"""Symbols that vary in time; any other symbol is a constant."""

QUANTITIES = MappingProxyType({quantity.name: quantity for quantity in _TABLE})
"""The vocabulary by name."""


@cache
def symbol(name: str) -> sp.Expr:
    """Return the symbol of a quantity, or its function of time.

    >>> symbol("p_max"), symbol("u_c")
    (p_max, u_c(t))
    """
    quantity = QUANTITIES[name]
    domain = {quantity.domain: True}
    if not quantity.varies:
        return sp.Symbol(name, **domain)
    return sp.Function(name, **domain)(t if quantity.clock == "t" else symbol(quantity.clock))


def symbols(names: str) -> tuple[sp.Expr, ...]:
    """Return several symbols at once: ``symbols("h h_0 U_a")``."""
    return tuple(symbol(name) for name in names.split())


def rate(name: str) -> sp.Derivative:
    """Return the time derivative of a quantity that varies, and is the integral of it: the rate
    may jump, so that it is known at almost every time."""
    return sp.Derivative(symbol(name), t)


def initial(name: str) -> sp.Expr:
    """Return the value at time zero of a quantity that varies."""
    return symbol(name).subs(t, 0)
