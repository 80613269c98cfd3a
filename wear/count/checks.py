"""Where Abel's equation is checked on panels: the extrema of T_24 and T_48."""

import numpy as np

CHECKS = -np.cos(np.pi * np.array([0, 1 / 6, 3 / 8, 5 / 8, 7 / 8, 1]))
