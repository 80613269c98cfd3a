"""Tanh contact law, rigid support, rough pin that wears, contact for h <= 3 sigma only.

Written by ``derive generate`` from equations (1), (2b), (3), (4), (5), (6), (10); not to be
edited.
All functions broadcast over arrays; the constants may be arrays too.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

VARIANT = "rigid_worn_rough_cutoff"
LAW = "tanh"
EQUATIONS = ("1", "2b", "3", "4", "5", "6", "10")
OPERATIONS = {
    "rate": 20,
    "slope": 32,
    "margin": 14,
    "margin_slope": 15,
    "margin_terms": 17,
    "fields": 21,
}
PARAMETERS = (
    "h_0",
    "sigma_a0",
    "sigma_c0",
    "f_a",
    "f_c",
    "K_a",
    "K_c",
    "H_a",
    "H_c",
    "p_max",
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
    kappa: Array  # wear of the pin per wear of the bearing, dimensionless
    gain: Array  # closure per wear of the bearing at a fixed pin
    slope_a: Array  # roughness of the pin per wear of the bearing
    largest_rate: Array  # wear rate at the largest pressure, mm/s


def bind(
    *,
    h_0: Array,
    sigma_a0: Array,
    sigma_c0: Array,
    f_a: Array,
    f_c: Array,
    K_a: Array,
    K_c: Array,
    H_a: Array,
    H_c: Array,
    p_max: Array,
    R: Array,
    n: Array,
) -> Constants:
    """Compute the constants of a run from the physical parameters, in mm, s, MPa, rpm."""
    kappa = H_c * K_a / (H_a * K_c)
    gain = 1 - kappa
    slope_a = f_a * kappa
    largest_rate = np.pi * K_c * R * n * p_max / (90 * H_c)
    return Constants(
        h_0=h_0,
        sigma_a0=sigma_a0,
        sigma_c0=sigma_c0,
        f_c=f_c,
        p_max=p_max,
        kappa=kappa,
        gain=gain,
        slope_a=slope_a,
        largest_rate=largest_rate,
    )


class Fields(NamedTuple):
    """The fields that this variant has."""

    u_a: Array  # wear depth of the pin, mm
    sigma_a: Array  # roughness of the pin, mm
    sigma_c: Array  # roughness of the bearing, mm
    sigma: Array  # equivalent roughness, mm
    h: Array  # closure of the mean surfaces, mm
    p: Array  # contact pressure, MPa


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


def slope(u: Array, U_a: Array, c: Constants) -> Array:
    """Derivative of the wear rate with respect to u_c, in 1/s."""
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
    return -4 * c.largest_rate * ratio_u * spread


def margin(u: Array, U_a: Array, c: Constants) -> Array:
    """3 sigma - h with an undeflected support, in mm: contact where it is not negative."""
    sigma_a = c.sigma_a0 + c.slope_a * u
    sigma_c = c.sigma_c0 + c.f_c * u
    sigma = np.sqrt(sigma_a * sigma_a + sigma_c * sigma_c)
    h = c.h_0 + c.gain * u - U_a
    return 3 * sigma - h


def margin_slope(u: Array, c: Constants) -> Array:
    """Derivative of the margin with respect to u_c; with respect to U_a it is 1."""
    sigma_a = c.sigma_a0 + c.slope_a * u
    sigma_c = c.sigma_c0 + c.f_c * u
    sigma = np.sqrt(sigma_a * sigma_a + sigma_c * sigma_c)
    sigma_u = (c.f_c * sigma_c + c.slope_a * sigma_a) / sigma
    return 3 * sigma_u - c.gain


def margin_terms(u: Array, U_a: Array, c: Constants) -> Array:
    """Sum of the absolute terms of the margin, in mm: it is known to as many roundoffs."""
    sigma_a = c.sigma_a0 + c.slope_a * u
    sigma_c = c.sigma_c0 + c.f_c * u
    sigma = np.sqrt(sigma_a * sigma_a + sigma_c * sigma_c)
    return c.h_0 + np.abs(U_a) + np.abs(c.gain * u) + 3 * np.abs(sigma)


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
        u_a=c.kappa * u,
        sigma_a=sigma_a,
        sigma_c=sigma_c,
        sigma=sigma,
        h=h,
        p=c.p_max * share,
    )
