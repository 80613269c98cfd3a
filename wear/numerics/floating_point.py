"""The limits of double precision: unit of roundoff, smallest numbers."""

import numpy as np

ROUNDOFF = float(np.finfo(float).eps)
TINY = float(np.finfo(float).tiny)
SMALLEST = 100 * float(np.finfo(float).smallest_subnormal)  # below, digits are lost
