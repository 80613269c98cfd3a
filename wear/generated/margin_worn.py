"""Loss of contact at h = 3 sigma: smooth pin that wears.

Written by ``derive generate`` from equations (1), (3), (5), (6); not to be edited.
All functions broadcast over arrays; the constants may be arrays too.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

EQUATIONS = ("1", "3", "5", "6")
OPERATIONS = {
    "margin": 3,
    "margin_slope": 0,
    "margin_terms": 6,
    "limited_pressure": 3,
    "limited_slope": 2,
    "margin_gradient": 0,
    "parameter_gradient": 23,
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


class Constants(NamedTuple):
    """Constants of a run."""

    kappa: Array  # wear of the pin per wear of the bearing, dimensionless
    gain: Array  # closure per wear of the bearing at a fixed pin
    most_of_margin: Array  # fresh_margin less one roughness, mm
    fresh_margin: Array  # 3 sigma - h without wear and load, mm
    most_of_gain: Array  # margin_gain less one roughness growth
    margin_gain: Array  # 3 sigma - h per wear of the bearing, undeflected


def bind(data: Parameters, pin_wear_sign: float) -> Constants:
    """Return the constants of a run.

    ``pin_wear_sign`` is +1 where wear of the pin opens the gap, -1 where it closes it.
    """
    kappa = data.H_c * data.K_a / (data.H_a * data.K_c)
    gain = 1 + pin_wear_sign * kappa
    most_of_margin = 2 * data.sigma_c0 - data.h_0
    fresh_margin = most_of_margin + data.sigma_c0
    most_of_gain = 2 * data.f_c - gain
    margin_gain = data.f_c + most_of_gain
    return Constants(kappa, gain, most_of_margin, fresh_margin, most_of_gain, margin_gain)


def margin(u: Array, U_a: Array, c: Constants) -> Array:
    """3 sigma - h with an undeflected support, in mm: contact where it is not negative."""
    return U_a + c.fresh_margin + c.margin_gain * u


def margin_slope(u: Array, c: Constants) -> Array:
    """Derivative of the margin with respect to u_c; with respect to U_a it is 1."""
    return c.margin_gain


def margin_terms(u: Array, U_a: Array, c: Constants) -> Array:
    """Sum of the absolute terms of the margin, in mm, the scale of its rounding."""
    return np.abs(U_a) + np.abs(c.fresh_margin) + np.abs(c.margin_gain * u)


def limited_pressure(p: Array, margin: Array, compliance: Array, c: Constants) -> Array:
    """Contact pressure in MPa: root of the residual, or that with h at 3 sigma."""
    return np.minimum(p, np.maximum(margin / compliance, 0))


def limited_slope(
    margin_slope: Array, compliance: Array, wear_per_pressure: Array, c: Constants
) -> Array:
    """Derivative of the wear rate with respect to u_c with h at 3 sigma, in 1/s."""
    return margin_slope * wear_per_pressure / compliance


def margin_gradient(u: Array, U_a: Array, c: Constants) -> Constants:
    """Derivatives of the margin with respect to the constants; to U_a it is 1."""
    return Constants(0 * u, 0 * u, 0 * u, 1 + 0 * u, 0 * u, u)


def parameter_gradient(by: Constants, data: Parameters, pin_wear_sign: float) -> Parameters:
    """Derivatives with respect to the parameters, from those by the constants."""
    kappa = data.H_c * data.K_a / (data.H_a * data.K_c)
    total_most_of_gain = by.margin_gain + by.most_of_gain
    total_most_of_margin = by.fresh_margin + by.most_of_margin
    total_gain = by.gain - total_most_of_gain
    total_kappa = by.kappa + pin_wear_sign * total_gain
    return Parameters(
        -total_most_of_margin,
        by.fresh_margin + 2 * total_most_of_margin,
        by.margin_gain + 2 * total_most_of_gain,
        total_kappa * kappa / data.K_a,
        -total_kappa * kappa / data.K_c,
        -total_kappa * kappa / data.H_a,
        total_kappa * kappa / data.H_c,
    )
