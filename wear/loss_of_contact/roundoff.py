"""What rounding alone may do: the floor of every estimate of error."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from wear.equation import APART
from wear.equation import roundoff as rate_roundoff
from wear.loss_of_contact.switching import Cycles
from wear.numerics.gauss import FloatArray
from wear.numerics.tolerances import ROUNDOFF, TINY


class Roundoff(NamedTuple):
    """Relative errors (k,) by rounding at some wears: of the `rate` at the peak of the load, and of
    where `contact` ends."""

    rate: FloatArray
    contact: FloatArray

    @property
    def of_cycles(self) -> FloatArray:
        """Return the relative error (k - 1,) of what cycles add from each wear to the next.

        A cycle that all but empties the margin m of contact does not lose what is left of it:
        contact that begins with m_0 lasts for a time ~ m_0^(1/2), and its end, where m_1 is left,
        is known to ~ 1/m_1^(1/2).
        """
        lost = np.sqrt(self.contact[1:] * self.contact[:-1])
        return np.asarray(np.maximum(self.rate[1:], self.rate[:-1]) + lost)


def roundoff(cycles: Cycles, wears: Sequence[FloatArray]) -> list[Roundoff]:
    """Return what rounding does at each of several sequences of wear (k,), mm; there is a cycle of
    each wear."""
    wear, ends = np.concatenate([*wears, []]), np.cumsum([len(part) for part in wears])
    errors = _of_rate(cycles, wear), _of_contact(cycles, wear)
    found = (np.split(error, ends)[:-1] for error in errors)
    return [Roundoff(*parts) for parts in zip(*found, strict=True)]


def _of_rate(cycles: Cycles, wear: FloatArray) -> FloatArray:
    """Return the part of the rate at the peak of the load, contact assumed."""
    model, peak = cycles.model, cycles.peak + np.zeros_like(wear)
    error = rate_roundoff(model, peak, wear)
    if model.compliant:
        # The pressure vanishes with the margin, and no steepness can be taken there.
        known = model.margin(wear, peak) > 2 * APART * model.fields(wear, peak).sigma
        error = np.where(known, error, 8 * ROUNDOFF)
    return error


def _of_contact(cycles: Cycles, wear: FloatArray) -> FloatArray:
    """Return the part of the margin of contact at the peak of the load."""
    peak = cycles.peak + np.zeros_like(wear)
    margin, terms = cycles.model.margin(wear, peak), cycles.model.margin_terms(wear, peak)
    result: FloatArray = np.minimum(ROUNDOFF * terms / (np.abs(margin) + TINY), 1e-9)
    return result
