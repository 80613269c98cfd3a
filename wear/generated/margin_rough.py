"""Loss of contact at h = 3 sigma: rough pin that does not wear.

Written by ``derive generate`` from equations (1), (3), (5), (6); not to be edited.
All functions broadcast over arrays; the constants may be arrays too.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

EQUATIONS = ("1", "3", "5", "6")
OPERATIONS = {
    "margin": 11,
    "margin_slope": 11,
    "margin_terms": 14,
    "limited_pressure": 3,
    "limited_slope": 2,
    "margin_gradient": 13,
    "parameter_gradient": 0,
}


class Parameters(NamedTuple):
    """The physical parameters."""

    h_0: Array  # initial closure, mm
    sigma_a0: Array  # initial roughness of the pin, mm
    sigma_c0: Array  # initial roughness of the bearing, mm
    f_c: Array  # roughness growth of the bearing, d sigma_c/d u_c, dimensionless


class Constants(NamedTuple):
    """Constants of a run."""

    h_0: Array  # initial closure, mm
    sigma_a0: Array  # initial roughness of the pin, mm
    sigma_c0: Array  # initial roughness of the bearing, mm
    f_c: Array  # roughness growth of the bearing, d sigma_c/d u_c, dimensionless


def bind(data: Parameters) -> Constants:
    """Return the constants of a run."""
    return Constants(data.h_0, data.sigma_a0, data.sigma_c0, data.f_c)


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
    """Sum of the absolute terms of the margin, in mm, the scale of its rounding."""
    sigma_c = c.sigma_c0 + c.f_c * u
    sigma = np.sqrt(c.sigma_a0 * c.sigma_a0 + sigma_c * sigma_c)
    return c.h_0 + np.abs(U_a) + np.abs(u) + 3 * np.abs(sigma)


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
    sigma_c = c.sigma_c0 + c.f_c * u
    sigma = np.sqrt(c.sigma_a0 * c.sigma_a0 + sigma_c * sigma_c)
    margin_sigma_c = 3 * sigma_c / sigma
    return Constants(-1 + 0 * u, 3 * c.sigma_a0 / sigma, margin_sigma_c, margin_sigma_c * u)


def parameter_gradient(by: Constants, data: Parameters) -> Parameters:
    """Derivatives with respect to the parameters, from those by the constants."""
    return Parameters(by.h_0, by.sigma_a0, by.sigma_c0, by.f_c)
