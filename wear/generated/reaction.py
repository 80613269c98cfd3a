"""Forces of the pin.

Written by ``derive generate`` from 7b, problem-i; not to be edited.
All functions broadcast over arrays; lengths are in mm.
"""

from typing import Any

import numpy as np

Real = Any  # a number or an array of numbers

EQUATIONS = ("7b", "problem-i")


def reaction(p: Real, *, b: Real, L: Real) -> Real:
    """Reaction force of the pin, in N."""
    return p * L * b


def pressure(R_a: Real, *, b: Real, L: Real) -> Real:
    """Contact pressure under a given reaction, in MPa."""
    return R_a / (L * b)


def by_force(*, b: Real, L: Real) -> Real:
    """Derivative of the pressure with respect to the reaction."""
    return 1 / (L * b)


def by_width(R_a: Real, *, b: Real, L: Real) -> Real:
    """Derivative of the pressure with respect to the width."""
    return -R_a / (L * b * b)


def by_length(R_a: Real, *, b: Real, L: Real) -> Real:
    """Derivative of the pressure with respect to the length."""
    return -R_a / (b * L * L)


def sliding_distance(*, T: Real, R: Real, n: Real) -> Real:
    """Sliding distance of a cycle, in mm."""
    return np.pi * R * T * n / 30


def friction_work(p: Real, distance: Real, mu: Real) -> Real:
    """Work of friction per area under a mean pressure, in mJ/mm^2."""
    return p * distance * mu
