"""What rounding alone may do: the floor of every estimate of error."""

import numpy as np

from wear.equation import APART
from wear.equation import roundoff as rate_roundoff
from wear.load import Load
from wear.model import Model
from wear.numerics.gauss import (
    FloatArray,
)
from wear.numerics.tolerances import (
    ROUNDOFF,
    TINY,
)


def roundoff(model: Model, load: Load, wear: FloatArray) -> FloatArray:
    """Return the relative error by rounding of the rate at the peak of the load, and of where
    contact ends."""
    return _of_rate(model, load, wear) + _of_contact(model, load, wear)


def roundoff_of_cycles(model: Model, load: Load, wear: FloatArray) -> FloatArray:
    """Return the relative error by rounding (k,) of the wear that cycles add, from each wear (k +
    1,) to the next.

    A cycle that all but empties the margin m of contact does not lose what is left of it: contact
    that begins with m_0 lasts for a time ~ m_0^(1/2), and its end, where m_1 is left, is known to
    ~ 1/m_1^(1/2).
    """
    rate, contact = _of_rate(model, load, wear), _of_contact(model, load, wear)
    result: FloatArray = np.maximum(rate[1:], rate[:-1])
    return result + np.sqrt(contact[1:] * contact[:-1])


def _of_rate(model: Model, load: Load, wear: FloatArray) -> FloatArray:
    """Return the part of the rate at the peak of the load, contact assumed."""
    peak = np.full_like(wear, load.maximum)
    error = rate_roundoff(model, peak, wear)
    if model.ends_at_3_sigma and model.compliant:
        # The pressure vanishes with the margin, and no steepness can be taken there.
        known = model.margin(wear, peak) > 2 * APART * model.fields(wear, peak).sigma
        error = np.where(known, error, 8 * ROUNDOFF)
    return error


def _of_contact(model: Model, load: Load, wear: FloatArray) -> FloatArray:
    """Return the part of the margin of contact at the peak of the load."""
    if not model.ends_at_3_sigma:
        return np.zeros_like(wear)
    peak = np.full_like(wear, load.maximum)
    margin, terms = model.margin(wear, peak), model.margin_terms(wear, peak)
    result: FloatArray = np.minimum(ROUNDOFF * terms / (np.abs(margin) + TINY), 1e-9)
    return result
