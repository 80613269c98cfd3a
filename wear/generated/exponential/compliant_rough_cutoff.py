"""Exponential contact law, compliant support, rough pin that does not wear, contact for h <= 3
sigma only.

Written by ``derive generate`` from equations (1), (2b), (3), (4), (5), (6), (8), (9); not to be
edited.
All functions broadcast over arrays; the constants may be arrays too.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

VARIANT = "compliant_rough_cutoff"
LAW = "exponential"
EQUATIONS = ("1", "2b", "3", "4", "5", "6", "8", "9")
OPERATIONS = {
    "residual": 16,
    "undeflected": 10,
    "softness": 8,
    "start": 17,
    "lower": 4,
    "upper": 3,
    "newton": 11,
    "rate": 1,
    "slope": 28,
    "margin": 11,
    "margin_slope": 11,
    "margin_terms": 14,
    "limited": 14,
    "limited_slope": 13,
    "fields": 12,
}
PARAMETERS = (
    "h_0",
    "sigma_a0",
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
    sigma_a0: Array  # initial roughness of the pin, mm
    sigma_c0: Array  # initial roughness of the bearing, mm
    f_c: Array  # roughness slope of the bearing, d sigma_c/d u_c, dimensionless
    p_max: Array  # largest admissible contact pressure, MPa
    compliance: Array  # deflection of the support per pressure, mm/MPa
    wear_per_pressure: Array  # wear rate per contact pressure, mm/(s MPa)


def bind(
    *,
    h_0: Array,
    sigma_a0: Array,
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
        sigma_a0=sigma_a0,
        sigma_c0=sigma_c0,
        f_c=f_c,
        p_max=p_max,
        compliance=compliance,
        wear_per_pressure=wear_per_pressure,
    )


class Fields(NamedTuple):
    """The fields that this variant has."""

    sigma_a: Array  # roughness of the pin, mm
    sigma_c: Array  # roughness of the bearing, mm
    sigma: Array  # equivalent roughness, mm
    h: Array  # closure of the mean surfaces, mm
    U_c: Array  # displacement of the bearing on its support, mm
    p: Array  # contact pressure, MPa


def residual(p: Array, u: Array, U_a: Array, c: Constants) -> Array:
    """What the contact pressure p must make zero, in MPa."""
    sigma_c = c.sigma_c0 + c.f_c * u
    sigma = np.sqrt(c.sigma_a0 * c.sigma_a0 + sigma_c * sigma_c)
    h = c.h_0 + u + c.compliance * p - U_a
    ratio = h / sigma
    share = np.exp(-ratio)
    return p - c.p_max * share


def undeflected(u: Array, U_a: Array, c: Constants) -> Array:
    """Closure over roughness with an undeflected support."""
    sigma_c = c.sigma_c0 + c.f_c * u
    sigma = np.sqrt(c.sigma_a0 * c.sigma_a0 + sigma_c * sigma_c)
    h = c.h_0 + u - U_a
    return h / sigma


def softness(u: Array, c: Constants) -> Array:
    """Roughnesses that the support gives way per pressure, in 1/MPa."""
    sigma_c = c.sigma_c0 + c.f_c * u
    sigma = np.sqrt(c.sigma_a0 * c.sigma_a0 + sigma_c * sigma_c)
    return c.compliance / sigma


def start(undeflected: Array, softness: Array, c: Constants) -> Array:
    """Estimate of the pressure with the support, in MPa."""
    level = np.log(c.p_max * softness) - undeflected
    grown = 1 + np.exp(-np.abs(level))
    height = np.log(grown) + np.maximum(level, 0)
    return height * (1 - np.log(1 + height) / (2 + height)) / softness


def lower(undeflected: Array, softness: Array, c: Constants) -> Array:
    """A pressure below that with the support, in MPa."""
    return np.maximum(np.minimum(c.p_max, -undeflected / softness), 0)


def upper(undeflected: Array, softness: Array, c: Constants) -> Array:
    """A pressure above that with the support, in MPa."""
    return np.maximum(c.p_max, -undeflected / softness)


def newton(p: Array, undeflected: Array, softness: Array, c: Constants) -> Array:
    """The pressure after a step of Newton's iteration from p, in MPa."""
    ratio = undeflected + p * softness
    share = np.exp(-ratio)
    rise = c.p_max * softness * share
    return (p * rise + c.p_max * share) / (1 + rise)


def rate(p: Array, c: Constants) -> Array:
    """Wear rate of the bearing, du_c/dt, in mm/s."""
    return c.wear_per_pressure * p


def slope(p: Array, u: Array, U_a: Array, c: Constants) -> Array:
    """Derivative of the wear rate with respect to u_c at the root, in 1/s."""
    sigma_c = c.sigma_c0 + c.f_c * u
    sigma = np.sqrt(c.sigma_a0 * c.sigma_a0 + sigma_c * sigma_c)
    sigma_u = c.f_c * sigma_c / sigma
    h = c.h_0 + u + c.compliance * p - U_a
    ratio = h / sigma
    ratio_u = (1 - ratio * sigma_u) / sigma
    share = np.exp(-ratio)
    residual_p = 1 + c.compliance * c.p_max * share / sigma
    return -c.wear_per_pressure * c.p_max * ratio_u * share / residual_p


def margin(u: Array, U_a: Array, c: Constants) -> Array:
    """3 sigma - h with an undeflected support, in mm: contact where it is not negative."""
    sigma_c = c.sigma_c0 + c.f_c * u
    sigma = np.sqrt(c.sigma_a0 * c.sigma_a0 + sigma_c * sigma_c)
    h = c.h_0 + u - U_a
    return 3 * sigma - h


def margin_slope(u: Array, c: Constants) -> Array:
    """Derivative of the margin with respect to u_c; with respect to U_a it is 1."""
    sigma_c = c.sigma_c0 + c.f_c * u
    sigma = np.sqrt(c.sigma_a0 * c.sigma_a0 + sigma_c * sigma_c)
    sigma_u = c.f_c * sigma_c / sigma
    return 3 * sigma_u - 1


def margin_terms(u: Array, U_a: Array, c: Constants) -> Array:
    """Sum of the absolute terms of the margin, in mm: it is known to as many roundoffs."""
    sigma_c = c.sigma_c0 + c.f_c * u
    sigma = np.sqrt(c.sigma_a0 * c.sigma_a0 + sigma_c * sigma_c)
    return c.h_0 + np.abs(U_a) + np.abs(u) + 3 * np.abs(sigma)


def limited(p: Array, u: Array, U_a: Array, c: Constants) -> Array:
    """Contact pressure with cutoff, from the root of the residual, in MPa."""
    sigma_c = c.sigma_c0 + c.f_c * u
    sigma = np.sqrt(c.sigma_a0 * c.sigma_a0 + sigma_c * sigma_c)
    h = c.h_0 + u - U_a
    return np.minimum(p, np.maximum((3 * sigma - h) / c.compliance, 0))


def limited_slope(u: Array, c: Constants) -> Array:
    """Derivative of the wear rate with respect to u_c while h stays at 3 sigma, in 1/s."""
    sigma_c = c.sigma_c0 + c.f_c * u
    sigma = np.sqrt(c.sigma_a0 * c.sigma_a0 + sigma_c * sigma_c)
    sigma_u = c.f_c * sigma_c / sigma
    return c.wear_per_pressure * (3 * sigma_u - 1) / c.compliance


def fields(p: Array, u: Array, U_a: Array, c: Constants) -> Fields:
    """Every field at given wear and load, in mm and MPa."""
    sigma_a = c.sigma_a0
    sigma_c = c.sigma_c0 + c.f_c * u
    sigma = np.sqrt(c.sigma_a0 * c.sigma_a0 + sigma_c * sigma_c)
    h = c.h_0 + u + c.compliance * p - U_a
    return Fields(
        sigma_a=sigma_a,
        sigma_c=sigma_c,
        sigma=sigma,
        h=h,
        U_c=c.compliance * p,
        p=p,
    )
