"""Tanh contact law, compliant support, smooth pin that does not wear, contact for h <= 3 sigma
only.

Written by ``derive generate`` from equations (1), (2b), (3), (4), (5), (6), (8), (9); not to be
edited.
All functions broadcast over arrays; the constants may be arrays too.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

VARIANT = "compliant_bearing_cutoff"
LAW = "tanh"
EQUATIONS = ("1", "2b", "3", "4", "5", "6", "8", "9")
OPERATIONS = {
    "residual": 15,
    "undeflected": 5,
    "softness": 3,
    "start": 21,
    "lower": 5,
    "upper": 4,
    "newton": 18,
    "rate": 1,
    "slope": 29,
    "margin": 3,
    "margin_slope": 0,
    "margin_terms": 6,
    "limited": 6,
    "limited_slope": 2,
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
    most_of_margin: Array  # fresh_margin less one roughness, mm
    fresh_margin: Array  # 3 sigma - h before any wear or load, mm
    most_of_gain: Array  # margin_gain less one roughness slope
    margin_gain: Array  # 3 sigma - h per wear of the bearing, undeflected


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
    most_of_margin = 2 * sigma_c0 - h_0
    fresh_margin = most_of_margin + sigma_c0
    most_of_gain = 2 * f_c - 1
    margin_gain = f_c + most_of_gain
    return Constants(
        h_0=h_0,
        sigma_c0=sigma_c0,
        f_c=f_c,
        p_max=p_max,
        compliance=compliance,
        wear_per_pressure=wear_per_pressure,
        most_of_margin=most_of_margin,
        fresh_margin=fresh_margin,
        most_of_gain=most_of_gain,
        margin_gain=margin_gain,
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
    odds = np.exp(np.minimum(8 - 4 * ratio, 709))
    share = odds / (1 + odds)
    return p - c.p_max * share


def undeflected(u: Array, U_a: Array, c: Constants) -> Array:
    """Closure over roughness with an undeflected support."""
    sigma = c.sigma_c0 + c.f_c * u
    h = c.h_0 + u - U_a
    return h / sigma


def softness(u: Array, c: Constants) -> Array:
    """Roughnesses that the support gives way per pressure, in 1/MPa."""
    sigma = c.sigma_c0 + c.f_c * u
    return c.compliance / sigma


def start(undeflected: Array, softness: Array, c: Constants) -> Array:
    """Estimate of the pressure with the support, in MPa."""
    level = 8 + np.log(4 * c.p_max * softness) - 4 * undeflected
    grown = 1 + np.exp(-np.abs(level))
    height = np.log(grown) + np.maximum(level, 0)
    return height * (1 - np.log(1 + height) / (2 + height)) / (4 * softness)


def lower(undeflected: Array, softness: Array, c: Constants) -> Array:
    """A pressure below that with the support, in MPa."""
    return np.maximum(np.minimum(c.p_max / 2, (2 - undeflected) / softness), 0)


def upper(undeflected: Array, softness: Array, c: Constants) -> Array:
    """A pressure above that with the support, in MPa."""
    return np.maximum(c.p_max / 2, (2 - undeflected) / softness)


def newton(p: Array, undeflected: Array, softness: Array, c: Constants) -> Array:
    """The pressure after a step of Newton's iteration from p, in MPa."""
    ratio = undeflected + p * softness
    odds = np.exp(np.minimum(8 - 4 * ratio, 709))
    share = odds / (1 + odds)
    spread = share / (1 + odds)
    rise = 4 * c.p_max * softness * spread
    return (p * rise + c.p_max * share) / (1 + rise)


def rate(p: Array, c: Constants) -> Array:
    """Wear rate of the bearing, du_c/dt, in mm/s."""
    return c.wear_per_pressure * p


def slope(p: Array, u: Array, U_a: Array, c: Constants) -> Array:
    """Derivative of the wear rate with respect to u_c at the root, in 1/s."""
    sigma = c.sigma_c0 + c.f_c * u
    h = c.h_0 + u + c.compliance * p - U_a
    ratio = h / sigma
    ratio_u = (1 - c.f_c * ratio) / sigma
    odds = np.exp(np.minimum(8 - 4 * ratio, 709))
    share = odds / (1 + odds)
    spread = share / (1 + odds)
    residual_p = 1 + 4 * c.compliance * c.p_max * spread / sigma
    return -4 * c.wear_per_pressure * c.p_max * ratio_u * spread / residual_p


def margin(u: Array, U_a: Array, c: Constants) -> Array:
    """3 sigma - h with an undeflected support, in mm: contact where it is not negative."""
    return U_a + c.fresh_margin + c.margin_gain * u


def margin_slope(u: Array, c: Constants) -> Array:
    """Derivative of the margin with respect to u_c; with respect to U_a it is 1."""
    return c.margin_gain


def margin_terms(u: Array, U_a: Array, c: Constants) -> Array:
    """Sum of the absolute terms of the margin, in mm: it is known to as many roundoffs."""
    return np.abs(U_a) + np.abs(c.fresh_margin) + np.abs(c.margin_gain * u)


def limited(p: Array, u: Array, U_a: Array, c: Constants) -> Array:
    """Contact pressure with cutoff, from the root of the residual, in MPa."""
    return np.minimum(p, np.maximum((U_a + c.fresh_margin + c.margin_gain * u) / c.compliance, 0))


def limited_slope(u: Array, c: Constants) -> Array:
    """Derivative of the wear rate with respect to u_c while h stays at 3 sigma, in 1/s."""
    return c.margin_gain * c.wear_per_pressure / c.compliance


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
