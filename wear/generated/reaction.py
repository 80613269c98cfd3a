"""Reaction of the pin.

Written by ``derive generate`` from 7b; not to be edited.
All functions broadcast over arrays; lengths are in mm.
"""

from typing import Any

Real = Any  # a number or an array of numbers

EQUATIONS = ("7b",)


def reaction(p: Real, *, b: Real, L: Real) -> Real:
    """Reaction force of the pin, in N."""
    return p * L * b
