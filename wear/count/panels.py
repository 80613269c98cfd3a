"""Two period maps: one that gives the result, and one that judges it."""

from typing import NamedTuple

import numpy as np

from wear.count.cycle import OneCycle
from wear.numerics.gauss import FloatArray

SAFETY = 3.0  # on measured discrepancies
NONE: FloatArray = np.empty(0)


class Maps(NamedTuple):
    """The one-cycle map twice: `coarse` gives the result, `fine` judges it."""

    coarse: OneCycle
    fine: OneCycle
