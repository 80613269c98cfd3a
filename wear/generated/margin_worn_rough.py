"""Loss of contact at h = 3 sigma: rough pin that wears.

Written by ``derive generate`` from equations (1), (3), (5), (6); not to be edited.
All functions broadcast over arrays; the constants may be arrays too.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

EQUATIONS = ("1", "3", "5", "6")
OPERATIONS = {
    "margin": 14,
    "margin_slope": 15,
    "margin_terms": 17,
    "limited_pressure": 3,
    "limited_slope": 2,
    "margin_gradient": 17,
    "parameter_gradient": 20,
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


class Constants(NamedTuple):
    """Constants of a run."""

    h_0: Array  # initial closure, mm
    sigma_a0: Array  # initial roughness of the pin, mm
    sigma_c0: Array  # initial roughness of the bearing, mm
    f_c: Array  # roughness growth of the bearing, d sigma_c/d u_c, dimensionless
    kappa: Array  # wear of the pin per wear of the bearing, dimensionless
    gain: Array  # closure per wear of the bearing at a fixed pin
    slope_a: Array  # roughness of the pin per wear of the bearing


def bind(data: Parameters, pin_wear_sign: float) -> Constants:
    """Return the constants of a run.

    ``pin_wear_sign`` is +1 where wear of the pin opens the gap, -1 where it closes it.
    """
    kappa = data.H_c * data.K_a / (data.H_a * data.K_c)
    gain = 1 + pin_wear_sign * kappa
    slope_a = data.f_a * kappa
    return Constants(data.h_0, data.sigma_a0, data.sigma_c0, data.f_c, kappa, gain, slope_a)


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
    """Sum of the absolute terms of the margin, in mm, the scale of its rounding."""
    sigma_a = c.sigma_a0 + c.slope_a * u
    sigma_c = c.sigma_c0 + c.f_c * u
    sigma = np.sqrt(sigma_a * sigma_a + sigma_c * sigma_c)
    return c.h_0 + np.abs(U_a) + np.abs(c.gain * u) + 3 * np.abs(sigma)


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
    sigma_a = c.sigma_a0 + c.slope_a * u
    sigma_c = c.sigma_c0 + c.f_c * u
    sigma = np.sqrt(sigma_a * sigma_a + sigma_c * sigma_c)
    margin_sigma_c = 3 * sigma_c / sigma
    margin_sigma_a = 3 * sigma_a / sigma
    return Constants(
        -1 + 0 * u,
        margin_sigma_a,
        margin_sigma_c,
        margin_sigma_c * u,
        0 * u,
        -u,
        margin_sigma_a * u,
    )


def parameter_gradient(by: Constants, data: Parameters, pin_wear_sign: float) -> Parameters:
    """Derivatives with respect to the parameters, from those by the constants."""
    kappa = data.H_c * data.K_a / (data.H_a * data.K_c)
    slope_a = data.f_a * kappa
    total_kappa = by.kappa + by.gain * pin_wear_sign + by.slope_a * slope_a / kappa
    return Parameters(
        by.h_0,
        by.sigma_a0,
        by.sigma_c0,
        by.slope_a * kappa,
        by.f_c,
        total_kappa * kappa / data.K_a,
        -total_kappa * kappa / data.K_c,
        -total_kappa * kappa / data.H_a,
        total_kappa * kappa / data.H_c,
    )
