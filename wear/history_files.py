"""Histories as files: CSV and NetCDF-3, whole or not at all."""

from __future__ import annotations

import csv
import secrets
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from wear.inside import Inside

Attributes = Mapping[str, str]
"""What describes a result, each in one line and none empty."""


class Column(NamedTuple):
    """One quantity of a history: its name in files (with the unit), unit, meaning, values."""

    name: str
    unit: str
    meaning: str
    values: NDArray[Any]


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


def write_csv(
    cycles: NDArray[np.int64], columns: Sequence[Column], attributes: Attributes, path: Path
) -> None:
    """Write comments (`# key: value`), a header and a line a cycle."""
    values = (column.values.tolist() for column in columns)
    with _replacing(path) as draft, draft.open("w", encoding="utf-8", newline="") as file:
        file.writelines(f"# {key}: {value}\n" for key, value in attributes.items())
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["cycle", *(column.name for column in columns)])
        writer.writerows(zip(cycles.tolist(), *values, strict=True))


def write_netcdf(
    cycles: NDArray[np.int64], columns: Sequence[Column], attributes: Attributes, path: Path
) -> None:
    """Write variables along the dimension `cycle`, with `units` and `long_name`.

    NetCDF-3 has no 64-bit integers: cycles are doubles, exact up to 2**53.
    """
    from scipy.io import netcdf_file

    with _replacing(path) as draft, netcdf_file(draft, "w") as file:
        for key, value in attributes.items():
            setattr(file, key, value)
        file.createDimension("cycle", len(cycles))
        number = file.createVariable("cycle", "d", ("cycle",))
        number[:] = cycles
        number.units, number.long_name = "1", "number of load cycles"
        for column in columns:
            variable = file.createVariable(column.name, "d", ("cycle",))
            variable[:] = column.values
            variable.units, variable.long_name = column.unit, column.meaning


def write_inside(parts: Iterable[Inside], path: Path, attributes: Attributes) -> None:
    """Write the chunks of a history inside the cycles as they come, so that memory holds one at a
    time: to NetCDF-3, or to CSV if the name ends so."""
    with _replacing(path) as draft:
        if path.suffix == ".csv":
            _write_lines(parts, draft, attributes)
        else:
            _write_records(parts, draft, attributes)


def _write_lines(parts: Iterable[Inside], path: Path, attributes: Attributes) -> None:
    """Comments (`# key: value`), a header and a line a state."""
    with path.open("w", encoding="utf-8", newline="") as file:
        file.writelines(f"# {key}: {value}\n" for key, value in attributes.items())
        writer = csv.writer(file, lineterminator="\n")
        begun = False
        for part in parts:
            columns = columns_of(part.u, part.fields)
            if not begun:
                names = (column.name for column in columns)
                writer.writerow(["cycle", "phase", *names, "error_estimate"])
            begun, m = True, len(part.phases)
            cycles = np.repeat(part.cycles.astype(np.int64), m).tolist()
            phases = np.tile(part.phases, len(part.cycles)).tolist()
            errors = np.repeat(part.error, m).tolist()
            values = (column.values.ravel().tolist() for column in columns)
            writer.writerows(zip(cycles, phases, *values, errors, strict=True))


def _write_records(parts: Iterable[Inside], path: Path, attributes: Attributes) -> None:
    """Variables with the dimensions `cycle` and `phase`; `cycle` is the record dimension.

    SciPy writes the header and the first cycle; the records of the others follow in the same
    layout, and their number is put in its place in the end.
    """
    rows = 0
    for part in parts:
        columns = columns_of(part.u, part.fields)
        if rows == 0:
            _write_first_cycle(part, columns, attributes, path)
        records = np.column_stack([part.cycles, part.error, *(c.values for c in columns)])
        with path.open("ab") as file:
            file.write(records[1 if rows == 0 else 0 :].astype(">f8").tobytes())
        rows += len(records)
    with path.open("r+b") as file:
        file.seek(_NUMBER_OF_RECORDS)
        file.write(rows.to_bytes(4, "big"))


_NUMBER_OF_RECORDS = 4  # where it stands in a NetCDF-3 file, behind "CDF" and the version


def _write_first_cycle(
    part: Inside, columns: Sequence[Column], attributes: Attributes, path: Path
) -> None:
    from scipy.io import netcdf_file

    with netcdf_file(path, "w", version=2) as file:  # offsets of 64 bits: files of any size
        for key, value in attributes.items():
            setattr(file, key, value)
        file.createDimension("cycle", None)
        file.createDimension("phase", len(part.phases))
        phase = file.createVariable("phase", "d", ("phase",))
        phase[:] = part.phases
        phase.units, phase.long_name = "1", "time since the end of the cycle, in periods"
        cycle = file.createVariable("cycle", "d", ("cycle",))
        cycle.units, cycle.long_name = "1", "number of load cycles that lie behind"
        error = file.createVariable("error_estimate", "d", ("cycle",))
        error.units, error.long_name = "1", "estimated relative error of the bearing wear"
        cycle[0], error[0] = part.cycles[0], part.error[0]
        for column in columns:
            variable = file.createVariable(column.name, "d", ("cycle", "phase"))
            variable[0] = column.values[0]
            variable.units, variable.long_name = column.unit, column.meaning


@contextmanager
def _replacing(path: Path) -> Iterator[Path]:
    """Give a name beside `path` to write to; it takes its place if nothing goes wrong.

    An `OSError` names `path`, whatever name was written to.
    """
    draft = path.with_name(f".{path.stem}-{secrets.token_hex(4)}{path.suffix}")
    try:
        yield draft
        draft.replace(path)
    except OSError as fault:
        raise OSError(fault.errno, fault.strerror, str(path)) from fault
    finally:
        draft.unlink(missing_ok=True)
