"""The symbols of a program: real numbers, where the statements have functions of time."""

from __future__ import annotations

import sympy as sp


def number(name: str) -> sp.Symbol:
    """Return the symbol of a real number."""
    return sp.Symbol(name, real=True)


u, load, pressure = map(number, ("u", "U_a", "p"))
"""The state u_c, the prescribed displacement, and the unknown of a compliant support."""

sigma_a, sigma_c, sigma, h, ratio = map(number, ("sigma_a", "sigma_c", "sigma", "h", "ratio"))
"""Roughnesses, closure, and closure over equivalent roughness."""

largest_rate, wear_per_pressure, gain, slope_a, compliance = map(
    number, ("largest_rate", "wear_per_pressure", "gain", "slope_a", "compliance")
)
"""Constants that are hoisted out of a run."""

most_of_margin, fresh_margin, most_of_gain, margin_gain = map(
    number, ("most_of_margin", "fresh_margin", "most_of_gain", "margin_gain")
)
"""The initial value and the growth of a margin of contact that is linear in the wear."""

pin_wear_sign = number("pin_wear_sign")
"""+1 where wear of the pin opens the gap, -1 where it closes it, as printed in (1)."""
