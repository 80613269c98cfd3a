"""Exponential contact law, rigid support, smooth pin that wears.

Written by ``derive generate`` from equations (1), (2b), (3), (4), (5), (6), (10); not to be
edited.
All functions broadcast over arrays; the constants may be arrays too.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

VARIANT = "rigid_worn"
LAW = "exponential"
EQUATIONS = ("1", "2b", "3", "4", "5", "6", "10")
OPERATIONS = {
    "rate": 9,
    "fields": 10,
    "rate_and_slope": 15,
    "rate_gradient": 17,
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
    largest_rate: Array  # wear rate at the largest pressure, mm/s


class Fields(NamedTuple):
    """The fields that this variant has."""

    u_a: Array  # wear depth of the pin, mm
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
    largest_rate = np.pi * data.K_c * data.R * data.n * data.p_max / (90 * data.H_c)
    return Constants(data.h_0, data.sigma_c0, data.f_c, data.p_max, kappa, gain, largest_rate)


def rate(u: Array, U_a: Array, c: Constants) -> Array:
    """Wear rate of the bearing, du_c/dt, in mm/s."""
    sigma = c.sigma_c0 + c.f_c * u
    h = c.h_0 + c.gain * u - U_a
    ratio = h / sigma
    share = np.exp(-ratio)
    return c.largest_rate * share


def fields(u: Array, U_a: Array, c: Constants) -> Fields:
    """Every field at given wear and load, in mm and MPa."""
    sigma = c.sigma_c0 + c.f_c * u
    h = c.h_0 + c.gain * u - U_a
    ratio = h / sigma
    share = np.exp(-ratio)
    return Fields(u_a=c.kappa * u, sigma_c=sigma, sigma=sigma, h=h, p=c.p_max * share)


def rate_and_slope(u: Array, U_a: Array, c: Constants) -> tuple[Array, Array]:
    """Wear rate in mm/s and its derivative with respect to u_c in 1/s."""
    sigma = c.sigma_c0 + c.f_c * u
    h = c.h_0 + c.gain * u - U_a
    ratio = h / sigma
    ratio_u = (c.gain - c.f_c * ratio) / sigma
    share = np.exp(-ratio)
    return c.largest_rate * share, -c.largest_rate * ratio_u * share


def rate_gradient(u: Array, U_a: Array, c: Constants) -> tuple[Array, Constants]:
    """Derivatives of the wear rate with respect to U_a and to the constants."""
    sigma = c.sigma_c0 + c.f_c * u
    h = c.h_0 + c.gain * u - U_a
    ratio = h / sigma
    share = np.exp(-ratio)
    rate_ratio = -c.largest_rate * share
    rate_h = rate_ratio / sigma
    rate_sigma = -rate_ratio * ratio / sigma
    return -rate_h, Constants(rate_h, rate_sigma, rate_sigma * u, 0 * u, 0 * u, rate_h * u, share)


def parameter_gradient(by: Constants, data: Parameters, pin_wear_sign: float) -> Parameters:
    """Derivatives with respect to the parameters, from those by the constants."""
    kappa = data.H_c * data.K_a / (data.H_a * data.K_c)
    largest_rate = np.pi * data.K_c * data.R * data.n * data.p_max / (90 * data.H_c)
    total_kappa = by.kappa + by.gain * pin_wear_sign
    return Parameters(
        by.h_0,
        by.sigma_c0,
        by.f_c,
        total_kappa * kappa / data.K_a,
        by.largest_rate * largest_rate / data.K_c - total_kappa * kappa / data.K_c,
        -total_kappa * kappa / data.H_a,
        total_kappa * kappa / data.H_c - by.largest_rate * largest_rate / data.H_c,
        by.p_max + by.largest_rate * largest_rate / data.p_max,
        by.largest_rate * largest_rate / data.R,
        by.largest_rate * largest_rate / data.n,
    )
