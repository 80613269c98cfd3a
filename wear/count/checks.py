"""How Abel's equation is judged on panels, once it is solved at their nodes.

What the series misses is largest between the nodes, where the last polynomials are. What the mesh
of phase misses changes its sign as the wear grows, and any few places may be those where it
vanishes: so the rates at all nodes have a say.
"""

import numpy as np

from wear.numerics.chebyshev import (
    chebyshev_analysis,
    chebyshev_values,
)
from wear.numerics.collocation import (
    CycleSolution,
    InitialGuess,
    truncation_error,
)
from wear.numerics.gauss import (
    FloatArray,
    Mesh,
)
from wear.numerics.tolerances import (
    TINY,
)

CHECKS = -np.cos(np.pi * np.array([0, 1 / 6, 3 / 8, 5 / 8, 7 / 8, 1]))  # extrema of T_24 and T_48
MISSED = (
    1 / 12
)  # of what `truncation_error` tells: in 99 of 100 drawn scenes less than three times that


def missed_by_phase(ahead: CycleSolution, over: Mesh) -> FloatArray:
    """The relative errors by the mesh of phase of cycles `ahead` from the nodes of panels, (panels,
    m), roughly."""
    missed: FloatArray = np.sum(truncation_error(ahead.rate, over), axis=-1) / (
        ahead.increment + TINY
    )
    return MISSED * missed


def at_checks(ahead: CycleSolution, m: int) -> InitialGuess:
    """What the cycles do that start at the CHECKS, as a guess for a mesh with `m` nodes on each
    interval: interpolated between those `ahead` from the nodes of panels."""
    nodes = ahead.increment.shape[1]
    to_checks = chebyshev_values(CHECKS, nodes) @ chebyshev_analysis(nodes)
    inside, rate = (
        (to_checks @ x.reshape(*x.shape[:2], -1)).reshape(len(x), -1, *x.shape[2:])
        for x in (ahead.inside, ahead.rate)
    )
    return ahead._replace(inside=inside, rate=rate).guess(m)
