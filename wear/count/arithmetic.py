"""What double precision can tell."""

import numpy as np

ROUNDOFF = float(np.finfo(float).eps)
TINY = float(np.finfo(float).tiny)
