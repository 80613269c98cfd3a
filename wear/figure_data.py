"""What the figures draw: arrays with names. No matplotlib here."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from wear.scene import Scene

FloatArray = NDArray[np.float64]
PHASES = 800  # of a cycle, besides the peaks of the load


@dataclass(frozen=True)
class Line:
    """One curve: `name` may hold mathtext, `x` and `y` are of one shape (n,).

    Lines of one `family` share colour and marker, `variant` sets them apart by dash (with the
    cutoff, say, or an asymptote).
    """

    name: str
    x: FloatArray
    y: FloatArray
    family: int = 0
    variant: int = 0

    def __post_init__(self) -> None:
        if np.shape(self.x) != np.shape(self.y) or np.ndim(self.x) != 1 or not np.size(self.x):
            raise ValueError(
                f"line {self.name!r}: x and y must be of one shape (n,) with n > 0, "
                f"got {np.shape(self.x)} and {np.shape(self.y)}"
            )

    def positive(self) -> Line:
        """The part that a logarithmic axis can show."""
        shown = self.x > 0.0
        return replace(self, x=self.x[shown], y=self.y[shown])


def spans_decades(lines: Sequence[Line]) -> bool:
    """Whether all values after the fresh state are positive and span two decades or more."""
    values = np.concatenate([line.positive().y for line in lines])
    return bool(values.min() > 0.0 and values.max() >= 100.0 * values.min())


def pressure_inside(scene: Scene, cycles: Sequence[int], rtol: float = 1e-6) -> list[Line]:
    """Contact pressure (MPa) over the phase of the cycles that begin after so many `cycles`, a line
    each, by rising numbers.

    Raises
    ------
    UsageError
        if the load does not repeat, or the scene's cycles cannot be counted.
    """
    from wear.inside import fields_inside
    from wear.model import bind

    load = scene.periodic_load
    phases = np.union1d(np.linspace(0.0, 1.0, PHASES + 1), load.peaks)
    rows = [
        row
        for part in fields_inside(bind(scene), load, np.unique(cycles), phases, rtol)
        for row in zip(part.cycles, part.fields.p, strict=True)
    ]
    return [
        Line(f"$N = {int(cycle)}$", phases, pressure, family)
        for family, (cycle, pressure) in enumerate(rows)
    ]


@dataclass(frozen=True)
class Method:
    """Time of one method against its true error or the number of cycles: arrays of shape (n,).

    `failed` marks runs that missed their tolerance, or were not made; they are drawn hollow.
    """

    name: str
    x: FloatArray
    seconds: FloatArray
    failed: NDArray[np.bool_]


@dataclass(frozen=True)
class Example:
    """A scene on the map of regimes: its f_c, and its gap at the peak of the load over the initial
    roughness; `one_solid` where only the bearing is rough and wears."""

    name: str
    slope: float
    gap: float
    one_solid: bool
