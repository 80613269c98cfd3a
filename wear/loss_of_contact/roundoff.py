"""Rounding errors of a count: the floor of every error estimate."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from wear.equation import HALF_DIFFERENCE
from wear.equation import roundoff as rate_roundoff
from wear.loss_of_contact.switching import Cycles
from wear.numerics.floating_point import ROUNDOFF, TINY
from wear.numerics.gauss import FloatArray
from wear.orbit.general import CONDITION

LARGEST = 1e-9  # relative error of a margin in use: a smaller margin is not resolved


class Roundoff(NamedTuple):
    """Relative rounding errors (k,) at some wears: of the `rate` at the peak of the load, and of
    the end of `contact`."""

    rate: FloatArray
    contact: FloatArray

    @property
    def of_cycles(self) -> FloatArray:
        """Return the relative errors (k - 1,) of the increments from each wear to the next.

        A cycle that nearly exhausts the margin m of contact does not lose all accuracy: contact
        that begins at a margin m_0 lasts for a time ~ m_0^(1/2), and its end, at a margin m_1, is
        known to ~ 1/m_1^(1/2).
        """
        of_contact = np.sqrt(self.contact[1:] * self.contact[:-1])
        return np.asarray(np.maximum(self.rate[1:], self.rate[:-1]) + of_contact)


def roundoff(cycles: Cycles, wears: Sequence[FloatArray]) -> list[Roundoff]:
    """Return the rounding errors at each of several sequences of wear (k,), mm; `cycles` has one
    cycle of each wear."""
    wear, ends = np.concatenate([*wears, []]), np.cumsum([len(part) for part in wears])
    errors = _of_rate(cycles, wear), _of_contact(cycles, wear)
    found = (np.split(error, ends)[:-1] for error in errors)
    return [Roundoff(*parts) for parts in zip(*found, strict=True)]


def _of_rate(cycles: Cycles, wear: FloatArray) -> FloatArray:
    """Return the relative error of the rate at the peak of the load, contact assumed."""
    model, peak = cycles.model, cycles.peak + np.zeros_like(wear)
    error = rate_roundoff(model, peak, wear)
    if model.compliant:
        # The pressure vanishes with the margin: its steepness is unknown there.
        known = model.margin(wear, peak) > 2 * HALF_DIFFERENCE * model.fields(wear, peak).sigma
        error = np.where(known, error, CONDITION * ROUNDOFF)
    return error


def _of_contact(cycles: Cycles, wear: FloatArray) -> FloatArray:
    """Return the relative error of the margin of contact at the peak of the load."""
    peak = cycles.peak + np.zeros_like(wear)
    margin, terms = cycles.model.margin(wear, peak), cycles.model.margin_terms(wear, peak)
    return np.asarray(np.minimum(ROUNDOFF * terms / (np.abs(margin) + TINY), LARGEST))
