"""Long-time behaviour: the formulas of the regimes.

Written by ``derive generate`` from two-solids, two-solids-closure-ratio, two-solids-rate,
two-solids-log-drift, compliant-pressure, arrest-depth, arrest-depth-two-solids,
permanent-contact, logarithmic-wear, threshold; not to be edited.
All functions broadcast over arrays; lengths are in mm.
"""

from typing import Any

import numpy as np

Real = Any  # a number or an array of numbers

EQUATIONS = (
    "two-solids",
    "two-solids-closure-ratio",
    "two-solids-rate",
    "two-solids-log-drift",
    "compliant-pressure",
    "arrest-depth",
    "arrest-depth-two-solids",
    "permanent-contact",
    "logarithmic-wear",
    "threshold",
)


def pin_wear(*, K_a: Real, K_c: Real, H_a: Real, H_c: Real) -> Real:
    """Wear of the pin per wear of the bearing."""
    return H_c * K_a / (H_a * K_c)


def roughness_growth(*, f_a: Real, f_c: Real, kappa: Real) -> Real:
    """Roughness per wear at large wear, q."""
    return np.sqrt(f_a * f_a * kappa * kappa + f_c * f_c)


def closure_growth(*, kappa: Real) -> Real:
    """Growth of the closure per wear, g, Eq. (1) as printed."""
    return 1 - kappa


def closure_growth_opening(*, kappa: Real) -> Real:
    """The same with the physical sign."""
    return 1 + kappa


def cross_roughness(*, sigma_a0: Real, sigma_c0: Real, f_a: Real, f_c: Real, kappa: Real) -> Real:
    """Half the slope of sigma^2 at no wear, p_1."""
    return f_c * sigma_c0 + f_a * kappa * sigma_a0


def apart(*, sigma_a0: Real, sigma_c0: Real, f_a: Real, f_c: Real, kappa: Real) -> Real:
    """Zero if the roughnesses of the two solids keep their ratio."""
    return f_a * kappa * sigma_c0 - f_c * sigma_a0


def closure_ratio(*, q: Real, g: Real) -> Real:
    """Limit of h/sigma."""
    return g / q


def vanishing_wear(*, q: Real, p_1: Real) -> Real:
    """Wear at which the roughness vanishes."""
    return -p_1 / (q * q)


def gap_at_peak(u: Real, *, h_0: Real, U_max: Real, g: Real) -> Real:
    """Closure at the peak of the load."""
    return h_0 + g * u - U_max


def gap_opens(*, h_0: Real, U_max: Real, g: Real) -> Real:
    """Wear at which it vanishes."""
    return (U_max - h_0) / g


def tanh_argument(r: Real) -> Real:
    """Argument of tanh at h/sigma = r."""
    return 4 - 2 * r


def share_tanh(r: Real) -> Real:
    """Share p/p_max of the largest pressure at h/sigma = r."""
    return 1 / (1 + np.exp(4 * r - 8))


def steepness_tanh(r: Real) -> Real:
    """Relative slope phi'/phi at h/sigma = r."""
    return -4 / (1 + np.exp(8 - 4 * r))


def share_exponential(r: Real) -> Real:
    """Share p/p_max of the largest pressure at h/sigma = r."""
    return np.exp(-r)


def steepness_exponential(r: Real) -> Real:
    """Relative slope phi'/phi at h/sigma = r."""
    return -1


def pressure(share: Real, *, p_max: Real) -> Real:
    """Contact pressure at a share of the largest."""
    return p_max * share


def wear_per_cycle(*, T: Real, K_c: Real, H_c: Real, R: Real, n: Real, p_inf: Real) -> Real:
    """Asymptotic wear of one cycle."""
    return np.pi * K_c * R * T * n * p_inf / (90 * H_c)


def log_coefficient(
    steepness: Real, *, h_0: Real, U_mean: Real, q: Real, g: Real, p_1: Real
) -> Real:
    """Coefficient of ln N, rigid support; with U_a for its mean, that of the local rate."""
    return steepness * ((h_0 - U_mean) / q - g * p_1 / (q**3))


def log_coefficient_compliant(
    steepness: Real, *, h_0: Real, k: Real, p_inf: Real, U_mean: Real, q: Real, g: Real, p_1: Real
) -> Real:
    """The same on a compliant support."""
    return steepness * ((h_0 + p_inf / k - U_mean) / q - g * p_1 / (q**3))


def arrest_depth(*, h_0: Real, sigma_c0: Real, f_c: Real, U_max: Real) -> Real:
    """Wear at arrest, one worn solid."""
    return (U_max + 3 * sigma_c0 - h_0) / (1 - 3 * f_c)


def gap_outgrows_roughness(*, f_c: Real) -> Any:
    """The gap outgrows the roughness."""
    return f_c < 1 / 3


def gap_and_cutoff_grow_alike(*, f_c: Real) -> Any:
    """Gap and cutoff grow alike."""
    return f_c == 1 / 3


def margin_is_lost(
    u: Real, *, h_0: Real, sigma_a0: Real, sigma_c0: Real, U_max: Real, q: Real, g: Real, p_1: Real
) -> Any:
    """The margin has a zero."""
    gap = h_0 + g * u - U_max
    cross = p_1 + u * q * q
    squared = sigma_a0 * sigma_a0 + sigma_c0 * sigma_c0 + u * (cross + p_1)
    half = 9 * cross - g * gap
    product = 9 * squared - gap * gap
    discriminant = half * half + product * (g * g - 9 * q * q)
    return discriminant >= 0 and discriminant > half * np.abs(half)


def arrest_depth_two_solids(
    u: Real, *, h_0: Real, sigma_a0: Real, sigma_c0: Real, U_max: Real, q: Real, g: Real, p_1: Real
) -> Real:
    """Wear at arrest, two solids."""
    gap = h_0 + g * u - U_max
    cross = p_1 + u * q * q
    squared = sigma_a0 * sigma_a0 + sigma_c0 * sigma_c0 + u * (cross + p_1)
    half = 9 * cross - g * gap
    product = 9 * squared - gap * gap
    root = np.sqrt(half * half + product * (g * g - 9 * q * q))
    return u + product / (root - half)


def permanent_depth(*, h_0: Real, sigma_c0: Real, f_c: Real, U_min: Real) -> Real:
    """Wear beyond which contact is permanent, f_c > 1/3."""
    return (h_0 - 3 * sigma_c0 - U_min) / (3 * f_c - 1)


def tail_coefficient(*, sigma_c0: Real) -> Real:
    """Coefficient of ln N for f_c = 0."""
    return sigma_c0 / 4


def tail_offset(log_load_factor: Real, *, h_0: Real, sigma_c0: Real, M: Real) -> Real:
    """Offset of the wear for f_c = 0."""
    level = 8 + log_load_factor + np.log(M) + 2 * np.log(2) - np.log(sigma_c0) - 4 * h_0 / sigma_c0
    return level * sigma_c0 / 4


def slope_threshold(*, epsilon: Real) -> Real:
    """Least f_c of a resolution epsilon."""
    return 4 / (8 + np.log(1 / epsilon - 1))
