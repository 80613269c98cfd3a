"""The offset of steady wear, its memory of the first cycles.

Overview
    In the steady regime ``u_c(N T) = R N + A ln N + B + o(1)``.  R and A follow from the data; B
    depends on the whole history.  All three follow from the solution of Abel's equation at
    infinity (`wear.orbit.steady_state`); its difference to the derived A is the basis of
    the error estimate of B.
Key results
    offset        B of a scene, with an error estimate
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from wear.binding import bind
from wear.cycles import orbit_of_scene
from wear.loss_of_contact.arrest import TabulatedIterates
from wear.numerics.rows import take
from wear.orbit.iterates import Iterates, count_table
from wear.orbit.steady_state import SteadyState, steady_state
from wear.quantities import MOST_CYCLES
from wear.scene import Scene

DEEPEST = 1e10  # roughnesses of wear up to which cycles are counted
RTOL = 1e-13  # of the count
LARGEST_ERROR = 1e-6  # relative; B with a larger one is unknown
ERROR_RATIO = 100.0  # bound of the error of B over that of A, which is usually about ten


class Offset(NamedTuple):
    """B in mm and its estimated absolute error, with the steady state that gives R and A too."""

    value: float
    error: float
    steady_state: SteadyState


def offset(scene: Scene, rate: float, drift: float) -> Offset | None:
    """Return B of a scene in mm from the derived `rate` R (mm per cycle) and `drift` A (mm); None
    if its wear does not become steady within 1e12 cycles.

    Where contact may be lost, contact in the steady state has to last throughout the cycle.
    """
    if rate * MOST_CYCLES < scene.initial_roughness:
        return None
    cycles = min(DEEPEST * scene.initial_roughness / rate, MOST_CYCLES)
    segment = orbit_of_scene(bind(scene), scene.periodic_load, cycles, RTOL).orbit.last(0)
    iterates = segment.iterates
    if isinstance(iterates, TabulatedIterates) and iterates.coordinate.shift > 0.0:
        iterates = iterates.in_z
    if not isinstance(iterates, Iterates) or (table := iterates.table) is None:
        return None
    assert iterates.density is not None
    panel = take(iterates.density, slice(-1, None))
    model, start = bind(scene), float(panel.grid.starts[0])
    least = scene.periodic_load.minimum
    if model.ends_at_3_sigma and not model.margin(start, least) > model.held_margin:
        return None  # contact does not last throughout the cycle
    size = len(table.u) // len(iterates.density.series)  # cells of a panel
    # The count may begin within the panel.
    within = float(count_table(panel).cycles_at(table.u[[-size]])[0])
    before = float(segment.begins[0]) + float(table.cycles[-size]) - within
    uncertain = float(segment.count_uncertainty[0]) + float(iterates.count_error[0][-size - 1])
    with np.errstate(all="ignore"):  # a panel that ends before the steady state does
        steady = steady_state(panel, before)
    error = rate * uncertain + ERROR_RATIO * abs(steady.drift - drift)
    known = np.isfinite(steady.offset) and error <= LARGEST_ERROR * abs(steady.offset)
    return Offset(steady.offset, error, steady) if known else None
