"""Tanh contact law, rigid support, rough pin that wears.

Written by ``derive generate`` from equations (1), (2b), (3), (4), (5), (6), (10); not to be
edited.
All functions broadcast over arrays; the constants may be arrays too.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

VARIANT = "rigid_worn_rough"
LAW = "tanh"
EQUATIONS = ("1", "2b", "3", "4", "5", "6", "10")
OPERATIONS = {
    "rate": 20,
    "fields": 21,
    "rate_and_slope": 33,
    "rate_gradient": 36,
    "parameter_gradient": 38,
}


class Parameters(NamedTuple):
    """The physical parameters."""

    h_0: Array  # initial closure, mm
    sigma_a0: Array  # initial roughness of the pin, mm
    sigma_c0: Array  # initial roughness of the bearing, mm
    f_a: Array  # roughness growth of the pin, d sigma_a/d u_a, dimensionless
    f_c: Array  # roughness growth of the bearing, d sigma_c/d u_c, dimensionless
    K_a: Array  # wear coefficient of the pin, dimensionless
    K_c: Array  # wear coefficient of the bearing, dimensionless
    H_a: Array  # hardness of the pin, MPa
    H_c: Array  # hardness of the bearing, MPa
    p_max: Array  # largest admissible contact pressure, MPa
    R: Array  # radius of the pin, mm
    n: Array  # speed of rotation, rpm


class Constants(NamedTuple):
    """Constants of a run."""

    h_0: Array  # initial closure, mm
    sigma_a0: Array  # initial roughness of the pin, mm
    sigma_c0: Array  # initial roughness of the bearing, mm
    f_c: Array  # roughness growth of the bearing, d sigma_c/d u_c, dimensionless
    p_max: Array  # largest admissible contact pressure, MPa
    kappa: Array  # wear of the pin per wear of the bearing, dimensionless
    gain: Array  # closure per wear of the bearing at a fixed pin
    slope_a: Array  # roughness of the pin per wear of the bearing
    largest_rate: Array  # wear rate at the largest pressure, mm/s


class Fields(NamedTuple):
    """The fields that this variant has."""

    u_a: Array  # wear depth of the pin, mm
    sigma_a: Array  # roughness of the pin, mm
    sigma_c: Array  # roughness of the bearing, mm
    sigma: Array  # equivalent roughness, mm
    h: Array  # closure of the mean surfaces, mm
    p: Array  # contact pressure, MPa


def bind(data: Parameters, pin_wear_sign: float) -> Constants:
    """Return the constants of a run.

    ``pin_wear_sign`` is +1 where wear of the pin opens the gap, -1 where it closes it.
    """
    kappa = data.H_c * data.K_a / (data.H_a * data.K_c)
    gain = 1 + pin_wear_sign * kappa
    slope_a = data.f_a * kappa
    largest_rate = np.pi * data.K_c * data.R * data.n * data.p_max / (90 * data.H_c)
    return Constants(
        data.h_0,
        data.sigma_a0,
        data.sigma_c0,
        data.f_c,
        data.p_max,
        kappa,
        gain,
        slope_a,
        largest_rate,
    )


def rate(u: Array, U_a: Array, c: Constants) -> Array:
    """Wear rate of the bearing, du_c/dt, in mm/s."""
    sigma_a = c.sigma_a0 + c.slope_a * u
    sigma_c = c.sigma_c0 + c.f_c * u
    sigma = np.sqrt(sigma_a * sigma_a + sigma_c * sigma_c)
    h = c.h_0 + c.gain * u - U_a
    ratio = h / sigma
    odds = np.exp(np.minimum(8 - 4 * ratio, 709))
    share = odds / (1 + odds)
    return c.largest_rate * share


def fields(u: Array, U_a: Array, c: Constants) -> Fields:
    """Every field at given wear and load, in mm and MPa."""
    sigma_a = c.sigma_a0 + c.slope_a * u
    sigma_c = c.sigma_c0 + c.f_c * u
    sigma = np.sqrt(sigma_a * sigma_a + sigma_c * sigma_c)
    h = c.h_0 + c.gain * u - U_a
    ratio = h / sigma
    odds = np.exp(np.minimum(8 - 4 * ratio, 709))
    share = odds / (1 + odds)
    return Fields(
        u_a=c.kappa * u, sigma_a=sigma_a, sigma_c=sigma_c, sigma=sigma, h=h, p=c.p_max * share
    )


def rate_and_slope(u: Array, U_a: Array, c: Constants) -> tuple[Array, Array]:
    """Wear rate in mm/s and its derivative with respect to u_c in 1/s."""
    sigma_a = c.sigma_a0 + c.slope_a * u
    sigma_c = c.sigma_c0 + c.f_c * u
    sigma = np.sqrt(sigma_a * sigma_a + sigma_c * sigma_c)
    sigma_u = (c.f_c * sigma_c + c.slope_a * sigma_a) / sigma
    h = c.h_0 + c.gain * u - U_a
    ratio = h / sigma
    ratio_u = (c.gain - ratio * sigma_u) / sigma
    odds = np.exp(np.minimum(8 - 4 * ratio, 709))
    share = odds / (1 + odds)
    spread = share / (1 + odds)
    return c.largest_rate * share, -4 * c.largest_rate * ratio_u * spread


def rate_gradient(u: Array, U_a: Array, c: Constants) -> tuple[Array, Constants]:
    """Derivatives of the wear rate with respect to U_a and to the constants."""
    sigma_a = c.sigma_a0 + c.slope_a * u
    sigma_c = c.sigma_c0 + c.f_c * u
    sigma = np.sqrt(sigma_a * sigma_a + sigma_c * sigma_c)
    h = c.h_0 + c.gain * u - U_a
    ratio = h / sigma
    odds = np.exp(np.minimum(8 - 4 * ratio, 709))
    share = odds / (1 + odds)
    spread = share / (1 + odds)
    rate_ratio = -4 * c.largest_rate * spread
    rate_h = rate_ratio / sigma
    rate_sigma = -rate_ratio * ratio / sigma
    rate_sigma_c = rate_sigma * sigma_c / sigma
    rate_sigma_a = rate_sigma * sigma_a / sigma
    return -rate_h, Constants(
        rate_h,
        rate_sigma_a,
        rate_sigma_c,
        rate_sigma_c * u,
        0 * u,
        0 * u,
        rate_h * u,
        rate_sigma_a * u,
        share,
    )


def parameter_gradient(by: Constants, data: Parameters, pin_wear_sign: float) -> Parameters:
    """Derivatives with respect to the parameters, from those by the constants."""
    kappa = data.H_c * data.K_a / (data.H_a * data.K_c)
    slope_a = data.f_a * kappa
    largest_rate = np.pi * data.K_c * data.R * data.n * data.p_max / (90 * data.H_c)
    total_kappa = by.kappa + by.gain * pin_wear_sign + by.slope_a * slope_a / kappa
    return Parameters(
        by.h_0,
        by.sigma_a0,
        by.sigma_c0,
        by.slope_a * kappa,
        by.f_c,
        total_kappa * kappa / data.K_a,
        by.largest_rate * largest_rate / data.K_c - total_kappa * kappa / data.K_c,
        -total_kappa * kappa / data.H_a,
        total_kappa * kappa / data.H_c - by.largest_rate * largest_rate / data.H_c,
        by.p_max + by.largest_rate * largest_rate / data.p_max,
        by.largest_rate * largest_rate / data.R,
        by.largest_rate * largest_rate / data.n,
    )
