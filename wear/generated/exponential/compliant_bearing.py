"""Exponential contact law, compliant support, smooth pin that does not wear.

Written by ``derive generate`` from equations (1), (2b), (3), (4), (5), (6), (8), (9); not to be
edited.
All functions broadcast over arrays; the constants may be arrays too.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

VARIANT = "compliant_bearing"
LAW = "exponential"
EQUATIONS = ("1", "2b", "3", "4", "5", "6", "8", "9")
OPERATIONS = {
    "residual": 11,
    "residual_slope": 13,
    "start": 6,
    "rate": 1,
    "slope": 21,
    "fields": 7,
}
PARAMETERS = (
    "h_0",
    "sigma_c0",
    "f_c",
    "K_c",
    "H_c",
    "p_max",
    "k",
    "R",
    "n",
)


class Constants(NamedTuple):
    """What does not change during a run."""

    h_0: Array  # initial closure, mm
    sigma_c0: Array  # initial roughness of the bearing, mm
    f_c: Array  # roughness slope of the bearing, d sigma_c/d u_c, dimensionless
    p_max: Array  # largest admissible contact pressure, MPa
    compliance: Array  # deflection of the support per pressure, mm/MPa
    wear_per_pressure: Array  # wear rate per contact pressure, mm/(s MPa)


def bind(
    *,
    h_0: Array,
    sigma_c0: Array,
    f_c: Array,
    K_c: Array,
    H_c: Array,
    p_max: Array,
    k: Array,
    R: Array,
    n: Array,
) -> Constants:
    """Compute the constants of a run from the physical parameters, in mm, s, MPa, rpm."""
    compliance = 1 / k
    wear_per_pressure = np.pi * K_c * R * n / (90 * H_c)
    return Constants(
        h_0=h_0,
        sigma_c0=sigma_c0,
        f_c=f_c,
        p_max=p_max,
        compliance=compliance,
        wear_per_pressure=wear_per_pressure,
    )


class Fields(NamedTuple):
    """The fields that this variant has."""

    sigma_c: Array  # roughness of the bearing, mm
    sigma: Array  # equivalent roughness, mm
    h: Array  # closure of the mean surfaces, mm
    U_c: Array  # displacement of the bearing on its support, mm
    p: Array  # contact pressure, MPa


def residual(p: Array, u: Array, U_a: Array, c: Constants) -> Array:
    """What the contact pressure p must make zero, in MPa."""
    sigma = c.sigma_c0 + c.f_c * u
    h = c.h_0 + u + c.compliance * p - U_a
    ratio = h / sigma
    share = np.exp(-ratio)
    return p - c.p_max * share


def residual_slope(p: Array, u: Array, U_a: Array, c: Constants) -> Array:
    """Derivative of the residual with respect to p."""
    sigma = c.sigma_c0 + c.f_c * u
    h = c.h_0 + u + c.compliance * p - U_a
    ratio = h / sigma
    share = np.exp(-ratio)
    return 1 + c.compliance * c.p_max * share / sigma


def start(u: Array, U_a: Array, c: Constants) -> Array:
    """Pressure from which Newton's iteration converges monotonically, in MPa."""
    h = c.h_0 + u - U_a
    return np.maximum(np.minimum(c.p_max, -h / c.compliance), 0)


def rate(p: Array, c: Constants) -> Array:
    """Wear rate of the bearing, du_c/dt, in mm/s."""
    return c.wear_per_pressure * p


def slope(p: Array, u: Array, U_a: Array, c: Constants) -> Array:
    """Derivative of the wear rate with respect to u_c at the root, in 1/s."""
    sigma = c.sigma_c0 + c.f_c * u
    h = c.h_0 + u + c.compliance * p - U_a
    ratio = h / sigma
    ratio_u = (1 - c.f_c * ratio) / sigma
    share = np.exp(-ratio)
    residual_p = 1 + c.compliance * c.p_max * share / sigma
    return -c.wear_per_pressure * c.p_max * ratio_u * share / residual_p


def fields(p: Array, u: Array, U_a: Array, c: Constants) -> Fields:
    """Every field at given wear and load, in mm and MPa."""
    sigma = c.sigma_c0 + c.f_c * u
    h = c.h_0 + u + c.compliance * p - U_a
    return Fields(
        sigma_c=sigma,
        sigma=sigma,
        h=h,
        U_c=c.compliance * p,
        p=p,
    )
