"""Static solution, without the exponential integral.

Written by ``derive generate`` from first-integral, static-solution, static-solution-scaled; not
to be edited.
All functions broadcast over arrays; lengths are in mm.
"""

from typing import Any

import numpy as np

Real = Any  # a number or an array of numbers

EQUATIONS = ("first-integral", "static-solution", "static-solution-scaled")


def largest_wear(*, T: Real, K_c: Real, H_c: Real, p_max: Real, R: Real, n: Real) -> Real:
    """Wear of one cycle under the largest pressure."""
    return np.pi * K_c * R * T * n * p_max / (90 * H_c)


def roughness(u: Real, *, sigma_c0: Real, f_c: Real) -> Real:
    """Roughness of the bearing."""
    return sigma_c0 + f_c * u


def exponent(u: Real, U_a: Real, *, h_0: Real, sigma_c0: Real, f_c: Real) -> Real:
    """Logarithm of p_max/p - 1 on a rigid support."""
    return (4 * h_0 + 4 * u - 4 * U_a) / (sigma_c0 + f_c * u) - 8


def offset(u: Real, U_a: Real, *, h_0: Real, sigma_c0: Real, f_c: Real) -> Real:
    """The argument z of Ei times -f_c, which stays finite for f_c -> 0."""
    return (4 * sigma_c0 + 4 * U_a * f_c - 4 * f_c * h_0) / (sigma_c0 + f_c * u)


def primitive(exponent: Real, roughness: Real, remainder: Real, *, f_c: Real) -> Real:
    """Integral of exp(exponent) over u, with remainder = 1 - z exp(-z) Ei(z)."""
    return remainder * roughness * np.exp(exponent) / f_c


def primitive_far(exponent: Real, roughness: Real, bounded: Real, offset: Real) -> Real:
    """The same for large z, with bounded = -z remainder."""
    return bounded * roughness * np.exp(exponent) / offset


def cycles(u: Real, gap: Real, *, M: Real) -> Real:
    """Cycles to the wear u, gap being that integral."""
    return (gap + u) / M
