"""Figures of one's own runs: `wear.plot`, `wear.plot_pressure`."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from wear.scene import Scene, as_scene

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from wear.history import History


def plot(histories: Mapping[str, History], *, logarithmic: bool = True) -> Figure:
    """Return a Matplotlib figure of named runs over the cycles.

    Wear, roughness, pressure and, where contact is lost, the fraction of the period in contact
    stand one above the other; each run has its colour.
    """
    from wear.figure_data import panels_of
    from wear.figures import history

    panels = panels_of(tuple(histories.values()), tuple(histories))
    return history(panels, logarithmic=logarithmic)


def plot_pressure(scene: Scene | str | os.PathLike[str], cycles: Sequence[int]) -> Figure:
    """Return a Matplotlib figure of the contact pressure (MPa) over the phase of some cycles.

    `cycles` are the numbers of cycles after which those shown begin: 0 for the first.

    Raises
    ------
    UsageError
        if the load does not repeat, or the scene's cycles cannot be counted.
    """
    from wear.figure_data import pressure_inside
    from wear.figures import pressure_in_cycles

    return pressure_in_cycles(pressure_inside(as_scene(scene), cycles))
