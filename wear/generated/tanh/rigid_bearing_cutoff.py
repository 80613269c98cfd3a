"""Tanh contact law, rigid support, smooth pin that does not wear, contact for h <= 3 sigma only.

Written by ``derive generate`` from equations (1), (2b), (3), (4), (5), (6), (13); not to be
edited.
All functions broadcast over arrays; the constants may be arrays too.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

VARIANT = "rigid_bearing_cutoff"
LAW = "tanh"
EQUATIONS = ("1", "2b", "3", "4", "5", "6", "13")
OPERATIONS = {
    "rate": 12,
    "slope": 20,
    "margin": 3,
    "margin_slope": 0,
    "margin_terms": 6,
    "fields": 12,
}
PARAMETERS = (
    "h_0",
    "sigma_c0",
    "f_c",
    "K_c",
    "H_c",
    "p_max",
    "R",
    "n",
)


class Constants(NamedTuple):
    """What does not change during a run."""

    h_0: Array  # initial closure, mm
    sigma_c0: Array  # initial roughness of the bearing, mm
    f_c: Array  # roughness slope of the bearing, d sigma_c/d u_c, dimensionless
    p_max: Array  # largest admissible contact pressure, MPa
    largest_rate: Array  # wear rate at the largest pressure, mm/s
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
    R: Array,
    n: Array,
) -> Constants:
    """Compute the constants of a run from the physical parameters, in mm, s, MPa, rpm."""
    largest_rate = np.pi * K_c * R * n * p_max / (90 * H_c)
    most_of_margin = 2 * sigma_c0 - h_0
    fresh_margin = most_of_margin + sigma_c0
    most_of_gain = 2 * f_c - 1
    margin_gain = f_c + most_of_gain
    return Constants(
        h_0=h_0,
        sigma_c0=sigma_c0,
        f_c=f_c,
        p_max=p_max,
        largest_rate=largest_rate,
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
    p: Array  # contact pressure, MPa


def rate(u: Array, U_a: Array, c: Constants) -> Array:
    """Wear rate of the bearing, du_c/dt, in mm/s."""
    sigma = c.sigma_c0 + c.f_c * u
    h = c.h_0 + u - U_a
    ratio = h / sigma
    odds = np.exp(np.minimum(8 - 4 * ratio, 709))
    share = odds / (1 + odds)
    return c.largest_rate * share


def slope(u: Array, U_a: Array, c: Constants) -> Array:
    """Derivative of the wear rate with respect to u_c, in 1/s."""
    sigma = c.sigma_c0 + c.f_c * u
    h = c.h_0 + u - U_a
    ratio = h / sigma
    ratio_u = (1 - c.f_c * ratio) / sigma
    odds = np.exp(np.minimum(8 - 4 * ratio, 709))
    share = odds / (1 + odds)
    spread = share / (1 + odds)
    return -4 * c.largest_rate * ratio_u * spread


def margin(u: Array, U_a: Array, c: Constants) -> Array:
    """3 sigma - h with an undeflected support, in mm: contact where it is not negative."""
    return U_a + c.fresh_margin + c.margin_gain * u


def margin_slope(u: Array, c: Constants) -> Array:
    """Derivative of the margin with respect to u_c; with respect to U_a it is 1."""
    return c.margin_gain


def margin_terms(u: Array, U_a: Array, c: Constants) -> Array:
    """Sum of the absolute terms of the margin, in mm: it is known to as many roundoffs."""
    return np.abs(U_a) + np.abs(c.fresh_margin) + np.abs(c.margin_gain * u)


def fields(u: Array, U_a: Array, c: Constants) -> Fields:
    """Every field at given wear and load, in mm and MPa."""
    sigma = c.sigma_c0 + c.f_c * u
    h = c.h_0 + u - U_a
    ratio = h / sigma
    odds = np.exp(np.minimum(8 - 4 * ratio, 709))
    share = odds / (1 + odds)
    return Fields(
        sigma_c=sigma,
        sigma=sigma,
        h=h,
        p=c.p_max * share,
    )
