"""The result of a run: the state of the system at the ends of the requested cycles."""

from __future__ import annotations

import html
import json
import os
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from importlib import import_module
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from wear import history_files
from wear.binding import bind
from wear.cycle_pressures import CyclePressures, cycle_pressures
from wear.faults import UsageError
from wear.generated import reaction
from wear.given_load import GivenLoad
from wear.history_files import States
from wear.load.spans import span
from wear.numerics.gauss import FloatArray
from wear.quantities import COLUMNS, columns_of, unit_of
from wear.scene import Scene

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.figure import Figure

MOST_SHOWN = 50  # rows in a notebook
ALWAYS = tuple(COLUMNS)[1:5]
"""Wear and roughness, which JSON also has for a pin that does not wear or is smooth."""


@dataclass(frozen=True, eq=False, repr=False)
class History:
    """Wear, roughness, closure and pressure at the ends of cycles, that is at times N T.

    Attributes
    ----------
    definition
        The scene.
    cycles
        Numbers of cycles in the order of the request; those reached if the run was stopped.
    u_c, u_a, sigma_c, sigma_a, h
        Wear and roughness of bearing and pin, and the closure, in mm, along `cycles`; None where
        the pin does not wear, or is smooth.
    p
        Contact pressure in MPa; zero out of contact.
    U_c
        Displacement of the bearing in mm, None with a rigid support.
    error
        Estimated relative error of `u_c`; NaN where there is no estimate.
    method, rtol, seconds
        The method, the requested relative accuracy, and the time of the run in seconds.
    cost
        `cycles_integrated` and `rhs_evaluations`, those for the error estimate included.
    notices
        Remarks on the scene and the result, in sentences.
    stopped
        Whether the run ended before its last cycle.
    """

    definition: Scene
    cycles: NDArray[np.int64]
    u_c: FloatArray
    u_a: FloatArray | None
    sigma_c: FloatArray
    sigma_a: FloatArray | None
    h: FloatArray
    p: FloatArray
    U_c: FloatArray | None
    error: FloatArray
    method: str
    rtol: float
    cost: Mapping[str, int]
    seconds: float
    notices: tuple[str, ...]
    stopped: bool = False

    @property
    def scene(self) -> str:
        """Return the title of the scene, or its name."""
        return self.definition.title or self.definition.name

    @property
    def variant(self) -> str:
        """Return the name of the generated module that ran."""
        return self.definition.variant.name

    @property
    def operations(self) -> Mapping[str, int]:
        """Return the arithmetic operations of its functions."""
        return bind(self.definition).operations

    @property
    def R_a(self) -> FloatArray | None:
        """Return the reaction force on the pin in N, None unless the scene has the contact's width
        and length."""
        return self._on_area(self.p)

    @cached_property
    def U_a(self) -> FloatArray | None:
        """Return the displacement of the pin in mm where the load is a force, else None."""
        model = bind(self.definition)
        if not isinstance(model, GivenLoad):
            return None
        force = np.full(self.u_c.shape, float(self.definition.periodic_load(0.0)))
        return np.asarray(model.displacement(self.u_c, force))

    @cached_property
    def pressures(self) -> CyclePressures:
        """Return peak, mean and contact fraction of the cycle that ends after each of the `cycles`.

        They are computed at the first use, and NaN where they are unknown: before the first cycle,
        and for a run that was stopped.
        """
        unknown = CyclePressures(*np.full((3, len(self.cycles)), np.nan))
        if self.stopped:
            return unknown
        try:
            return cycle_pressures(self.definition, self.cycles.astype(float), self.rtol)
        except (ArithmeticError, ValueError):
            return unknown

    def columns(self) -> dict[str, FloatArray]:
        """Return the quantities along `cycles` by their names in files and JSON, in that order."""
        peak, mean, fraction = self.pressures
        columns = columns_of(self) | {
            "peak_pressure_MPa": peak,
            "mean_pressure_MPa": mean,
            "contact_fraction": fraction,
            "peak_pin_reaction_N": self._on_area(peak),
            "mean_pin_reaction_N": self._on_area(mean),
        }
        if (friction := self.definition.contact.friction_coefficient) is not None:
            distance = self._sliding_distance()
            work = np.asarray(reaction.friction_work(mean, distance, friction))
            columns |= {
                "sliding_distance_mm": distance,
                "friction_work_mJ_per_mm2": work,
                "friction_work_mJ": self._on_area(work),
            }
        return {name: columns[name] for name in COLUMNS if columns.get(name) is not None}

    def _on_area(self, values: FloatArray) -> FloatArray | None:
        """Return values per area of the contact times its area, None if that is unknown."""
        contact = self.definition.contact
        if contact.width_mm is None or contact.length_mm is None:
            return None
        return np.asarray(reaction.reaction(values, b=contact.width_mm, L=contact.length_mm))

    def _sliding_distance(self) -> FloatArray:
        """Return the sliding distance in mm in the cycle that ends after each of the `cycles`."""
        motion, ended = self.definition.motion, np.maximum(self.cycles - 1, 0).tolist()
        periods = np.array([span(self.definition.load, cycle).load.period for cycle in ended])
        distance = reaction.sliding_distance(R=motion.radius_mm, T=periods, n=motion.speed_rpm)
        return np.where(self.cycles > 0, distance, np.nan)

    def to_dataframe(self) -> pandas.DataFrame:
        """Return a row for each number of cycles, with the columns of the files; needs pandas."""
        pd = _library("pandas")
        table: pandas.DataFrame = pd.DataFrame(
            self.columns(), index=pd.Index(self.cycles, name="cycle")
        )
        return table

    def to_xarray(self) -> xarray.Dataset:
        """Return the columns along `cycle`, with units and meanings; needs xarray."""
        dataset: xarray.Dataset = _library("xarray").Dataset(
            coords={"cycle": self.cycles}, attrs=dict(self._attributes())
        )
        for name, values in self.columns().items():
            about = {"units": unit_of(name) or "1", "long_name": COLUMNS[name].meaning}
            dataset[name] = ("cycle", values, about)
        return dataset

    def plot(self, *, logarithmic: bool = True) -> Figure:
        """Return a Matplotlib figure of wear, roughness and pressure over the cycles."""
        from wear.figures import plot

        return plot({"": self}, logarithmic=logarithmic)

    def __repr__(self) -> str:
        reached = "no cycle reached"
        if len(self.cycles):
            last = int(np.argmax(self.cycles))
            reached = f"u_c = {self.u_c[last]:.6g} mm after cycle {self.cycles[last]}"
        return f"<History of {self.scene!r}: {reached}; {self.method}, rtol {self.rtol:g}>"

    def _repr_html_(self) -> str:
        """Return the table for a notebook."""
        columns = self.columns()
        heads = "".join(f"<th>{name}</th>" for name in columns)
        rows = "".join(
            f"<tr><th>{cycle}</th>"
            + "".join(f"<td>{values[row]:.6g}</td>" for values in columns.values())
            + "</tr>"
            for row, cycle in enumerate(self.cycles[:MOST_SHOWN].tolist())
        )
        more = len(self.cycles) - MOST_SHOWN
        rest = f"<p>and {more} more</p>" if more > 0 else ""
        title = html.escape(self.scene)
        return f"<p>{title}</p><table><tr><th>cycle</th>{heads}</tr>{rows}</table>{rest}"

    def as_json(self) -> dict[str, Any]:
        """Return the document of `wear run --json`, in plain values; missing values are None, as
        along the cycles the wear and roughness of a pin that has none."""
        head = {
            "scene": self.scene,
            "model": {"variant": self.variant, "operations": dict(self.operations)},
            "method": self.method,
            "rtol": self.rtol,
            "cycles": self.cycles.tolist(),
        }
        lists = dict.fromkeys(ALWAYS, [None] * len(self.cycles)) | {
            name: [value if np.isfinite(value) else None for value in values.tolist()]
            for name, values in self.columns().items()
        }
        tail = {"cost": dict(self.cost), "seconds": self.seconds, "notices": list(self.notices)}
        return head | lists | tail

    def write(self, path: str | os.PathLike[str]) -> None:
        """Write a `.csv` (floats round-trip) or `.nc` (NetCDF-3) file, completely or not at all,
        with the scene and the method.

        Raises
        ------
        UsageError
            for any other suffix, and for a folder that does not exist.
        OSError
            if the disk is full.
        """
        history_files.write([States(self.cycles, self.columns())], path, self._attributes())

    def _attributes(self) -> history_files.Attributes:
        return {
            "title": history_files.title_attribute(self.scene),
            "scene": self.definition.to_json(),
            "variant": self.variant,
            "operations": json.dumps(dict(self.operations)),
            "method": self.method,
            "rtol": repr(self.rtol),
            "cost": json.dumps(dict(self.cost)),
            "seconds": repr(self.seconds),
            "notices": json.dumps(self.notices),
            "complete": json.dumps(not self.stopped),
        }


def _library(name: str) -> Any:
    """Return an optional library; UsageError with the remedy if it is not installed."""
    try:
        return import_module(name)
    except ModuleNotFoundError as fault:
        raise UsageError(f"this table needs {name}: pip install {name}") from fault
