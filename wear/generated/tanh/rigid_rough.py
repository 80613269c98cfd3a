"""Tanh contact law, rigid support, rough pin that does not wear.

Written by ``derive generate`` from equations (1), (2b), (3), (4), (5), (6), (10); not to be
edited.
All functions broadcast over arrays; the constants may be arrays too.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

VARIANT = "rigid_rough"
LAW = "tanh"
EQUATIONS = ("1", "2b", "3", "4", "5", "6", "10")
OPERATIONS = {
    "rate": 17,
    "fields": 17,
    "rate_and_slope": 28,
    "rate_gradient": 31,
    "parameter_gradient": 18,
}


class Parameters(NamedTuple):
    """The physical parameters."""

    h_0: Array  # initial closure, mm
    sigma_a0: Array  # initial roughness of the pin, mm
    sigma_c0: Array  # initial roughness of the bearing, mm
    f_c: Array  # roughness growth of the bearing, d sigma_c/d u_c, dimensionless
    K_c: Array  # wear coefficient of the bearing, dimensionless
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
    largest_rate: Array  # wear rate at the largest pressure, mm/s


class Fields(NamedTuple):
    """The fields that this variant has."""

    sigma_a: Array  # roughness of the pin, mm
    sigma_c: Array  # roughness of the bearing, mm
    sigma: Array  # equivalent roughness, mm
    h: Array  # closure of the mean surfaces, mm
    p: Array  # contact pressure, MPa


def bind(data: Parameters) -> Constants:
    """Return the constants of a run."""
    largest_rate = np.pi * data.K_c * data.R * data.n * data.p_max / (90 * data.H_c)
    return Constants(data.h_0, data.sigma_a0, data.sigma_c0, data.f_c, data.p_max, largest_rate)


def rate(u: Array, U_a: Array, c: Constants) -> Array:
    """Wear rate of the bearing, du_c/dt, in mm/s."""
    sigma_c = c.sigma_c0 + c.f_c * u
    sigma = np.sqrt(c.sigma_a0 * c.sigma_a0 + sigma_c * sigma_c)
    h = c.h_0 + u - U_a
    ratio = h / sigma
    odds = np.exp(np.minimum(8 - 4 * ratio, 709))
    share = odds / (1 + odds)
    return c.largest_rate * share


def fields(u: Array, U_a: Array, c: Constants) -> Fields:
    """Every field at given wear and load, in mm and MPa."""
    sigma_a = c.sigma_a0
    sigma_c = c.sigma_c0 + c.f_c * u
    sigma = np.sqrt(c.sigma_a0 * c.sigma_a0 + sigma_c * sigma_c)
    h = c.h_0 + u - U_a
    ratio = h / sigma
    odds = np.exp(np.minimum(8 - 4 * ratio, 709))
    share = odds / (1 + odds)
    return Fields(sigma_a=sigma_a, sigma_c=sigma_c, sigma=sigma, h=h, p=c.p_max * share)


def rate_and_slope(u: Array, U_a: Array, c: Constants) -> tuple[Array, Array]:
    """Wear rate in mm/s and its derivative with respect to u_c in 1/s."""
    sigma_c = c.sigma_c0 + c.f_c * u
    sigma = np.sqrt(c.sigma_a0 * c.sigma_a0 + sigma_c * sigma_c)
    sigma_u = c.f_c * sigma_c / sigma
    h = c.h_0 + u - U_a
    ratio = h / sigma
    ratio_u = (1 - ratio * sigma_u) / sigma
    odds = np.exp(np.minimum(8 - 4 * ratio, 709))
    share = odds / (1 + odds)
    spread = share / (1 + odds)
    return c.largest_rate * share, -4 * c.largest_rate * ratio_u * spread


def rate_gradient(u: Array, U_a: Array, c: Constants) -> tuple[Array, Constants]:
    """Derivatives of the wear rate with respect to U_a and to the constants."""
    sigma_c = c.sigma_c0 + c.f_c * u
    sigma = np.sqrt(c.sigma_a0 * c.sigma_a0 + sigma_c * sigma_c)
    h = c.h_0 + u - U_a
    ratio = h / sigma
    odds = np.exp(np.minimum(8 - 4 * ratio, 709))
    share = odds / (1 + odds)
    spread = share / (1 + odds)
    rate_ratio = -4 * c.largest_rate * spread
    rate_h = rate_ratio / sigma
    rate_sigma = -rate_ratio * ratio / sigma
    rate_sigma_c = rate_sigma * sigma_c / sigma
    return -rate_h, Constants(
        rate_h, c.sigma_a0 * rate_sigma / sigma, rate_sigma_c, rate_sigma_c * u, 0 * u, share
    )


def parameter_gradient(by: Constants, data: Parameters) -> Parameters:
    """Derivatives with respect to the parameters, from those by the constants."""
    largest_rate = np.pi * data.K_c * data.R * data.n * data.p_max / (90 * data.H_c)
    return Parameters(
        by.h_0,
        by.sigma_a0,
        by.sigma_c0,
        by.f_c,
        by.largest_rate * largest_rate / data.K_c,
        -by.largest_rate * largest_rate / data.H_c,
        by.p_max + by.largest_rate * largest_rate / data.p_max,
        by.largest_rate * largest_rate / data.R,
        by.largest_rate * largest_rate / data.n,
    )
