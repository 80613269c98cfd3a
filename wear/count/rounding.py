"""What rounding alone may do: the floor of every estimate of error."""

import numpy as np

from wear.count.arithmetic import ROUNDOFF, TINY
from wear.count.collocation import FloatArray
from wear.load import Load
from wear.model import Model

SMALLEST = 100 * float(np.finfo(float).smallest_subnormal)  # below, digits are lost
APART = 1e-4  # of the roughness: displacements between which the rate's steepness is taken


def roundoff(model: Model, load: Load, wear: FloatArray) -> FloatArray:
    """Relative error by rounding of the rate at the peak of the load, and of where contact ends."""
    peak = np.full_like(wear, load.maximum)
    error = roundoff_of(model, peak, wear)
    if model.cutoff:
        margin, terms = model.margin(wear, peak), model.margin_terms(wear, peak)
        if model.compliant:
            # The pressure vanishes with the margin, and no steepness can be taken there.
            told = margin > 2 * APART * model.fields(wear, peak).sigma
            error = np.where(told, error, 8 * ROUNDOFF)
        error += np.minimum(ROUNDOFF * terms / (np.abs(margin) + TINY), 1e-9)
    return error


def roundoff_of(model: Model, displacement: FloatArray, wear: FloatArray) -> FloatArray:
    """Relative error of the rate by rounding: its condition with respect to the terms of the
    closure and the roughness, of which the contact law takes the quotient."""
    fields = model.fields(wear, displacement)
    sigma, fresh = fields.sigma, model.fields(np.zeros_like(wear), displacement).sigma
    cancelled = (fresh + np.abs(sigma - fresh)) / sigma  # where roughness vanishes
    terms = np.abs(fields.h) * (1 + cancelled) + np.abs(displacement) + np.abs(fields.U_c)
    apart = APART * sigma
    more, less = (model.rate(wear, displacement + sign * apart) for sign in (1.0, -1.0))
    steepness = np.abs(more - less) / (2 * apart * (np.minimum(more, less) + TINY))
    lost = SMALLEST / np.maximum(less, SMALLEST)
    result: FloatArray = ROUNDOFF * (8 + steepness * terms) + lost
    return result
