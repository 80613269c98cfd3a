"""Results as files: CSV and NetCDF-3, whole or not at all."""

from __future__ import annotations

import csv
import os
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from derive import files
from wear.checked import is_path
from wear.faults import UsageError

if TYPE_CHECKING:
    from wear.inside import Inside

Attributes = Mapping[str, str]
"""What describes a result, each in one line and none empty."""

_NUMBER_OF_RECORDS = 4  # where it stands in a NetCDF-3 file, behind "CDF" and the version


class Column(NamedTuple):
    """One quantity of a result: its name in files (with the unit), unit, meaning, and values: one
    a cycle (n,), or at phases of each (n, m)."""

    name: str
    unit: str
    meaning: str
    values: NDArray[Any]


class States(NamedTuple):
    """A part of a result: columns along whole `cycles` (n,) and, if any, `phases` (m,) of each."""

    cycles: NDArray[Any]
    columns: Sequence[Column]
    phases: NDArray[np.float64] | None = None

    def by_name(self) -> dict[str, list[Any]]:
        """Return cycle, phase and columns, a value a state."""
        found: dict[str, NDArray[Any]] = {"cycle": self.cycles.astype(np.int64)[:, None]}
        if self.phases is not None:
            found["phase"] = self.phases[None]
        found |= {
            each.name: each.values if each.values.ndim == 2 else each.values[:, None]
            for each in self.columns
        }
        whole = np.broadcast_arrays(*found.values())
        return {name: values.ravel().tolist() for name, values in zip(found, whole, strict=True)}


_FIELDS = (  # symbol, name in files, unit, meaning
    ("u_a", "pin_wear_mm", "mm", "wear of the pin"),
    ("sigma_c", "bearing_roughness_mm", "mm", "roughness of the bearing"),
    ("sigma_a", "pin_roughness_mm", "mm", "roughness of the pin"),
    ("h", "closure_mm", "mm", "closure of the mean surfaces"),
    ("p", "pressure_at_start_MPa", "MPa", "contact pressure"),
    ("U_c", "bearing_displacement_mm", "mm", "displacement of the bearing"),
    ("U_a", "pin_displacement_mm", "mm", "displacement of the pin"),
)
WEAR_AND_ROUGHNESS = (
    "bearing_wear_mm", "pin_wear_mm", "bearing_roughness_mm", "pin_roughness_mm",
)  # fmt: skip
"""Keys that JSON has in this order also of a pin that does not wear, or is smooth."""


def columns_of(wear: NDArray[Any], fields: object) -> tuple[Column, ...]:
    """Return the wear (mm) of the bearing and the fields that there are, by symbol."""
    return (
        Column("bearing_wear_mm", "mm", "wear of the bearing", wear),
        *(
            Column(name, unit, meaning, getattr(fields, symbol))
            for symbol, name, unit, meaning in _FIELDS
            if getattr(fields, symbol, None) is not None
        ),
    )


def error_column(error: NDArray[Any]) -> Column:
    """Return the estimated relative error (n,) of the wear."""
    return Column("error_estimate", "1", "estimated relative error of the bearing wear", error)


def write_inside(
    parts: Iterable[Inside], path: str | os.PathLike[str], attributes: Attributes
) -> None:
    """Write the chunks of a history inside the cycles as they come, so that memory holds one at a
    time, as `write` does."""

    def states(part: Inside) -> States:
        columns = *columns_of(part.u, part.fields), error_column(part.error)
        return States(part.cycles, columns, part.phases)

    write(map(states, parts), path, attributes)


def write(parts: Iterable[States], path: str | os.PathLike[str], attributes: Attributes) -> None:
    """Write a `.csv` or `.nc` (NetCDF-3) file, a part at a time, whole or not at all.

    Raises
    ------
    UsageError
        for any other suffix.
    OSError
        if the file cannot be written.
    """
    writers = {".csv": _write_lines, ".nc": _write_records}
    suffix = Path(path).suffix if is_path(path) else ""
    if suffix not in writers:
        raise UsageError(f"{path}: the name of a result ends in {' or '.join(writers)}")
    with files.replacing(path) as draft:
        writers[suffix](parts, draft, attributes)


def _write_lines(parts: Iterable[States], path: Path, attributes: Attributes) -> None:
    """Write comments (`# key: value`), a header and a line a state."""
    with path.open("w", encoding="utf-8", newline="") as file:
        file.writelines(f"# {key}: {value}\n" for key, value in attributes.items())
        writer = csv.writer(file, lineterminator="\n")
        for number, part in enumerate(parts):
            columns = part.by_name()
            if number == 0:
                writer.writerow(columns)
            writer.writerows(zip(*columns.values(), strict=True))


def _write_records(parts: Iterable[States], path: Path, attributes: Attributes) -> None:
    """Write variables with the record dimension `cycle` and, if there is one, `phase`.

    SciPy writes the header with one blank record, which those of all parts take the place of; how
    many they are is put in its place in the end. NetCDF-3 has no 64-bit integers: cycles are
    doubles, exact up to 2**53.
    """
    rows = 0
    for number, part in enumerate(parts):
        records = np.column_stack([part.cycles, *(each.values for each in part.columns)])
        if number == 0:
            _write_header(part, path, attributes)
            os.truncate(path, path.stat().st_size - 8 * records.shape[1])
        with path.open("ab") as file:
            file.write(records.astype(">f8").data)
        rows += len(records)
    with path.open("r+b") as file:
        file.seek(_NUMBER_OF_RECORDS)
        file.write(rows.to_bytes(4, "big"))


def _write_header(part: States, path: Path, attributes: Attributes) -> None:
    """Write what describes a result, and one record of zeros."""
    from scipy.io import netcdf_file

    cycles = Column("cycle", "1", "number of load cycles that lie behind", part.cycles)
    with netcdf_file(path, "w", version=2) as file:  # offsets of 64 bits: files of any size
        for key, value in attributes.items():
            setattr(file, key, value)
        file.createDimension("cycle", None)
        if part.phases is not None:
            file.createDimension("phase", len(part.phases))
            phase = file.createVariable("phase", "d", ("phase",))
            phase[:] = part.phases
            phase.units, phase.long_name = "1", "time since the end of the cycle, in periods"
        for name, unit, meaning, values in (cycles, *part.columns):
            variable = file.createVariable(name, "d", ("cycle", "phase")[: values.ndim])
            variable[0] = 0.0
            variable.units, variable.long_name = unit, meaning
