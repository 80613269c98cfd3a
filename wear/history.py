"""The result of a run: the state of the system at the ends of the requested cycles."""

from __future__ import annotations

import html
import json
import os
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from wear import history_files
from wear.history_files import Column, States, columns_of, error_column
from wear.numerics.gauss import FloatArray

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.figure import Figure

    from wear.cycle_pressures import CyclePressures
    from wear.scene import Scene

MOST_SHOWN = 50  # rows in a notebook


@dataclass(frozen=True, eq=False, repr=False)
class History:
    """Wear, roughness, closure and pressure at the ends of cycles, that is at times N T.

    Attributes
    ----------
    cycles
        Numbers of cycles in the order of the request (of a run that was stopped: those reached).
    u_c, u_a, sigma_c, sigma_a, h
        Wear and roughness of bearing and pin, and the closure, in mm, along `cycles`; None where
        the pin does not wear, or is smooth.
    p
        Contact pressure in MPa; zero out of contact.
    error
        Estimated relative error of `u_c`; NaN where there is no estimate.
    U_c
        Displacement of the bearing in mm, None with a rigid support.
    R_a
        Reaction force on the pin in N, None unless the scene has the contact's width and length.
    U_a
        Displacement of the pin in mm where the load is a force; None where it is given itself.
    scene, definition
        Its title, and the whole of it.
    variant, operations
        The generated module that ran and the arithmetic operations of its functions.
    method, rtol, seconds
        How it was solved, to what requested relative accuracy, and how long that took.
    cost
        `cycles_integrated` and `rhs_evaluations`, those for the error estimate included.
    notices
        What a reader should know, in sentences.
    stopped
        Whether the run ended before its last cycle.
    """

    cycles: NDArray[np.int64]
    u_c: FloatArray
    u_a: FloatArray | None
    sigma_c: FloatArray
    sigma_a: FloatArray | None
    h: FloatArray
    p: FloatArray
    error: FloatArray
    U_c: FloatArray | None
    R_a: FloatArray | None
    U_a: FloatArray | None
    scene: str
    definition: Scene
    variant: str
    operations: Mapping[str, int]
    method: str
    rtol: float
    cost: Mapping[str, int]
    seconds: float
    notices: tuple[str, ...]
    stopped: bool = False

    @cached_property
    def pressures(self) -> CyclePressures:
        """Peak, mean and share of contact of the cycle that ends after each of the `cycles`.

        Computed when asked for; no numbers where they could not be found: before the first cycle,
        under a load that does not repeat, of a run that was stopped.
        """
        from wear.cycle_pressures import CyclePressures, cycle_pressures

        nothing = CyclePressures(*np.full((3, len(self.cycles)), np.nan))
        if self.stopped:
            return nothing
        try:
            return cycle_pressures(self.definition, self.cycles.astype(float), self.rtol)
        except (ArithmeticError, ValueError):
            return nothing

    def columns(self) -> tuple[Column, ...]:
        """Return the quantities along `cycles`, as they are named in files and JSON."""
        peak, mean, fraction = self.pressures
        columns = [
            *columns_of(self.u_c, self),
            Column("peak_pressure_MPa", "MPa", "largest pressure in the cycle", peak),
            Column("mean_pressure_MPa", "MPa", "mean pressure over the cycle", mean),
            Column("contact_fraction", "1", "share of the cycle in contact", fraction),
        ]
        return (*columns, *self._forces(peak, mean), error_column(self.error))

    def _forces(self, peak: FloatArray, mean: FloatArray) -> list[Column]:
        from wear.states import friction_work, reaction_of, sliding_distance

        scene, columns = self.definition, []
        if self.R_a is not None:
            columns.append(Column("pin_reaction_N", "N", "reaction force on the pin", self.R_a))
            for word, pressure in (("peak", peak), ("mean", mean)):
                force = reaction_of(scene, pressure)
                assert force is not None
                name, meaning = f"{word}_pin_reaction_N", f"{word} reaction force over the cycle"
                columns.append(Column(name, "N", meaning, force))
        work = friction_work(scene, self.cycles.tolist(), mean)
        if work is not None:
            way = sliding_distance(scene, self.cycles.tolist())
            name, meaning = "friction_work_mJ_per_mm2", "work of friction per area in the cycle"
            columns.append(Column("sliding_distance_mm", "mm", "way slid in the cycle", way))
            columns.append(Column(name, "mJ/mm^2", meaning, work))
            if (of_all := reaction_of(scene, work)) is not None:
                columns.append(Column("friction_work_mJ", "mJ", "work of friction", of_all))
        return columns

    def to_dataframe(self) -> pandas.DataFrame:
        """Return a row a number of cycles, with the columns of the files; needs pandas."""
        import pandas

        columns = {column.name: column.values for column in self.columns()}
        return pandas.DataFrame(columns, index=pandas.Index(self.cycles, name="cycle"))

    def to_xarray(self) -> xarray.Dataset:
        """Return the columns along `cycle`, with units and meanings; needs xarray."""
        import xarray

        made = xarray.Dataset(coords={"cycle": self.cycles}, attrs=dict(self._attributes()))
        for column in self.columns():
            about = {"units": column.unit, "long_name": column.meaning}
            made[column.name] = ("cycle", column.values, about)
        return made

    def plot(self, *, logarithmic: bool = True) -> Figure:
        """Return a Matplotlib figure of wear, roughness and pressure over the cycles."""
        from wear.figure_data import panels_of
        from wear.figures import history

        return history(panels_of([self]), logarithmic=logarithmic)

    def __repr__(self) -> str:
        reached = "no cycle reached"
        if len(self.cycles):
            last = int(np.argmax(self.cycles))
            reached = f"u_c = {self.u_c[last]:.6g} mm after cycle {self.cycles[last]}"
        return f"<History of {self.scene!r}: {reached}; {self.method}, rtol {self.rtol:g}>"

    def _repr_html_(self) -> str:
        """Return the table that a notebook shows."""
        columns = self.columns()
        heads = "".join(f"<th>{column.name}</th>" for column in columns)
        rows = "".join(
            f"<tr><th>{cycle}</th>"
            + "".join(f"<td>{column.values[row]:.6g}</td>" for column in columns)
            + "</tr>"
            for row, cycle in enumerate(self.cycles[:MOST_SHOWN].tolist())
        )
        more = len(self.cycles) - MOST_SHOWN
        rest = f"<p>and {more} more</p>" if more > 0 else ""
        title = html.escape(self.scene)
        return f"<p>{title}</p><table><tr><th>cycle</th>{heads}</tr>{rows}</table>{rest}"

    def as_json(self) -> dict[str, Any]:
        """Return the document of `wear run --json`, in plain values; what does not exist is None,
        also along the cycles the wear and roughness of a pin that has none."""
        head = {
            "scene": self.scene,
            "model": {"variant": self.variant, "operations": dict(self.operations)},
            "method": self.method,
            "rtol": self.rtol,
            "cycles": self.cycles.tolist(),
        }
        lists = dict.fromkeys(history_files.WEAR_AND_ROUGHNESS, [None] * len(self.cycles)) | {
            column.name: _finite(column.values) for column in self.columns()
        }
        tail = {"cost": dict(self.cost), "seconds": self.seconds, "notices": list(self.notices)}
        return head | lists | tail

    def write(self, path: str | os.PathLike[str]) -> None:
        """Write a `.csv` (floats to round-trip) or `.nc` (NetCDF-3) file, whole or not at all, with
        the scene and the method.

        Raises
        ------
        UsageError
            for any other suffix.
        OSError
            if the file cannot be written.
        """
        history_files.write([States(self.cycles, self.columns())], path, self._attributes())

    def _attributes(self) -> history_files.Attributes:
        return {
            "title": json.dumps(self.scene, ensure_ascii=True).strip('"') or "untitled",
            "scene": self.definition.to_json(),
            "variant": self.variant,
            "operations": json.dumps(dict(self.operations)),
            "method": self.method,
            "rtol": repr(self.rtol),
            "cost": json.dumps(dict(self.cost)),
            "seconds": repr(self.seconds),
            "notices": json.dumps(self.notices),
        }


def _finite(values: FloatArray) -> list[float | None]:
    return [value if np.isfinite(value) else None for value in values.tolist()]
