"""Exponential contact law, compliant support, smooth pin that wears.

Written by ``derive generate`` from equations (1), (2b), (3), (4), (5), (6), (8), (9); not to be
edited.
All functions broadcast over arrays; the constants may be arrays too.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

VARIANT = "compliant_worn"
LAW = "exponential"
EQUATIONS = ("1", "2b", "3", "4", "5", "6", "8", "9")
OPERATIONS = {
    "residual": 12,
    "undeflected": 6,
    "softness": 3,
    "start": 17,
    "lower": 4,
    "upper": 3,
    "newton": 11,
    "rate": 1,
    "slope": 22,
    "fields": 9,
    "rate_gradient": 28,
    "parameter_gradient": 33,
}


class Parameters(NamedTuple):
    """The physical parameters."""

    h_0: Array  # initial closure, mm
    sigma_c0: Array  # initial roughness of the bearing, mm
    f_c: Array  # roughness growth of the bearing, d sigma_c/d u_c, dimensionless
    K_a: Array  # wear coefficient of the pin, dimensionless
    K_c: Array  # wear coefficient of the bearing, dimensionless
    H_a: Array  # hardness of the pin, MPa
    H_c: Array  # hardness of the bearing, MPa
    p_max: Array  # largest admissible contact pressure, MPa
    k: Array  # stiffness of the support per area, MPa/mm
    R: Array  # radius of the pin, mm
    n: Array  # speed of rotation, rpm


class Constants(NamedTuple):
    """Constants of a run."""

    h_0: Array  # initial closure, mm
    sigma_c0: Array  # initial roughness of the bearing, mm
    f_c: Array  # roughness growth of the bearing, d sigma_c/d u_c, dimensionless
    p_max: Array  # largest admissible contact pressure, MPa
    kappa: Array  # wear of the pin per wear of the bearing, dimensionless
    gain: Array  # closure per wear of the bearing at a fixed pin
    compliance: Array  # deflection of the support per pressure, mm/MPa
    wear_per_pressure: Array  # wear rate per contact pressure, mm/(s MPa)


class Fields(NamedTuple):
    """The fields that this variant has."""

    u_a: Array  # wear depth of the pin, mm
    sigma_c: Array  # roughness of the bearing, mm
    sigma: Array  # equivalent roughness, mm
    h: Array  # closure of the mean surfaces, mm
    U_c: Array  # displacement of the bearing on its support, mm
    p: Array  # contact pressure, MPa


def bind(data: Parameters, pin_wear_sign: float) -> Constants:
    """Return the constants of a run.

    ``pin_wear_sign`` is +1 where wear of the pin opens the gap, -1 where it closes it.
    """
    kappa = data.H_c * data.K_a / (data.H_a * data.K_c)
    gain = 1 + pin_wear_sign * kappa
    compliance = 1 / data.k
    wear_per_pressure = np.pi * data.K_c * data.R * data.n / (90 * data.H_c)
    return Constants(
        data.h_0, data.sigma_c0, data.f_c, data.p_max, kappa, gain, compliance, wear_per_pressure
    )


def residual(p: Array, u: Array, U_a: Array, c: Constants) -> Array:
    """Residual of the equation for the contact pressure p, in MPa."""
    sigma = c.sigma_c0 + c.f_c * u
    h = c.h_0 + c.compliance * p + c.gain * u - U_a
    ratio = h / sigma
    share = np.exp(-ratio)
    return p - c.p_max * share


def undeflected(u: Array, U_a: Array, c: Constants) -> Array:
    """Closure over roughness with an undeflected support."""
    sigma = c.sigma_c0 + c.f_c * u
    h = c.h_0 + c.gain * u - U_a
    return h / sigma


def softness(u: Array, c: Constants) -> Array:
    """Deflection of the support per pressure, over the roughness, in 1/MPa."""
    sigma = c.sigma_c0 + c.f_c * u
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
    """Derivative of the wear rate with respect to u_c, in 1/s."""
    sigma = c.sigma_c0 + c.f_c * u
    h = c.h_0 + c.compliance * p + c.gain * u - U_a
    ratio = h / sigma
    ratio_u = (c.gain - c.f_c * ratio) / sigma
    share = np.exp(-ratio)
    residual_p = 1 + c.compliance * c.p_max * share / sigma
    return -c.wear_per_pressure * c.p_max * ratio_u * share / residual_p


def fields(p: Array, u: Array, U_a: Array, c: Constants) -> Fields:
    """Every field at given wear and load, in mm and MPa."""
    sigma = c.sigma_c0 + c.f_c * u
    h = c.h_0 + c.compliance * p + c.gain * u - U_a
    return Fields(u_a=c.kappa * u, sigma_c=sigma, sigma=sigma, h=h, U_c=c.compliance * p, p=p)


def rate_gradient(p: Array, u: Array, U_a: Array, c: Constants) -> tuple[Array, Constants]:
    """Derivatives of the wear rate with respect to U_a and to the constants."""
    sigma = c.sigma_c0 + c.f_c * u
    h = c.h_0 + c.compliance * p + c.gain * u - U_a
    ratio = h / sigma
    share = np.exp(-ratio)
    residual_p = 1 + c.compliance * c.p_max * share / sigma
    rate_ratio = -c.wear_per_pressure * c.p_max * share / residual_p
    rate_h = rate_ratio / sigma
    rate_sigma = -rate_ratio * ratio / sigma
    return -rate_h, Constants(
        rate_h,
        rate_sigma,
        rate_sigma * u,
        c.wear_per_pressure * share / residual_p,
        0 * u,
        rate_h * u,
        p * rate_h,
        p,
    )


def parameter_gradient(by: Constants, data: Parameters, pin_wear_sign: float) -> Parameters:
    """Derivatives with respect to the parameters, from those by the constants."""
    kappa = data.H_c * data.K_a / (data.H_a * data.K_c)
    compliance = 1 / data.k
    wear_per_pressure = np.pi * data.K_c * data.R * data.n / (90 * data.H_c)
    total_kappa = by.kappa + by.gain * pin_wear_sign
    return Parameters(
        by.h_0,
        by.sigma_c0,
        by.f_c,
        total_kappa * kappa / data.K_a,
        by.wear_per_pressure * wear_per_pressure / data.K_c - total_kappa * kappa / data.K_c,
        -total_kappa * kappa / data.H_a,
        total_kappa * kappa / data.H_c - by.wear_per_pressure * wear_per_pressure / data.H_c,
        by.p_max,
        -by.compliance * compliance / data.k,
        by.wear_per_pressure * wear_per_pressure / data.R,
        by.wear_per_pressure * wear_per_pressure / data.n,
    )
