"""Measured wear of one or several specimens, from a CSV file or from arrays."""

from __future__ import annotations

import csv
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from wear.faults import UsageError

FloatArray = NDArray[np.float64]
MOST_BYTES = 16 * 1024 * 1024
_WEAR = {"wear_mm": 1.0, "wear_um": 1e-3}  # column: mm a unit
_OWN = ("cycles", *_WEAR, "standard_error_mm", "specimen")


@dataclass(frozen=True)
class Specimen:
    """One worn contact: what was read, and how its scene differs from the others'.

    Attributes
    ----------
    name
        Its name in the data, empty if there is one only.
    cycles, wear_mm, standard_error_mm
        Readings (n,), cycles ascending; the last is None where the scatter is unknown.
    changes
        Entries of its scene, such as `load.value_mm`.
    """

    name: str
    cycles: FloatArray
    wear_mm: FloatArray
    standard_error_mm: FloatArray | None
    changes: Mapping[str, float]


def read_readings(path: str | Path, ignore: Sequence[str] = ()) -> tuple[Specimen, ...]:
    """Return the specimens of a CSV file with a header.

    Columns are `cycles`, `wear_mm` or `wear_um`, and if need be `standard_error_mm` and `specimen`;
    any other names an entry of the scene, or is dropped by `ignore`.

    Raises
    ------
    UsageError
        with everything that is wrong with the file.
    """
    path = Path(path)
    try:
        if path.stat().st_size > MOST_BYTES:
            raise UsageError(f"{path}: is larger than {MOST_BYTES // 2**20} MiB")
        with path.open(encoding="utf-8-sig", newline="") as stream:
            header, *rows = [row for row in csv.reader(stream) if row] or [[]]
    except (OSError, UnicodeDecodeError, csv.Error) as fault:
        raise UsageError(f"{path}: cannot be read ({fault})") from fault
    names = [name.strip() for name in header]
    faults = [f"{path}: {fault}" for fault in _faults_of_header(names, ignore)]
    faults += [
        f"{path}: row {place}: has {len(row)} entries, the header has {len(names)}"
        for place, row in enumerate(rows, start=2)
        if len(row) != len(names)
    ][:10]
    if faults:
        raise UsageError("\n".join(faults))
    columns = {name: [row[i].strip() for row in rows] for i, name in enumerate(names)}
    return specimens({k: v for k, v in columns.items() if k not in ignore}, str(path))


def _faults_of_header(names: Sequence[str], ignore: Sequence[str]) -> Iterator[str]:
    if "cycles" not in names:
        yield "there is no column cycles"
    if sum(name in _WEAR for name in names) != 1:
        yield f"give the wear in one column, {' or '.join(_WEAR)}"
    if len(set(names)) < len(names):
        yield "a column is named twice"
    for name in names:
        if name not in _OWN and name not in ignore and "." not in name:
            yield (f"column {name}: unknown; name an entry of the scene, as in load.value_mm, "
                   f"or drop it by --ignore {name}")  # fmt: skip
    for name in ignore:
        if name not in names:
            yield f"--ignore {name}: there is no such column"


def specimens(
    columns: Mapping[str, Sequence[object]], source: str = "data"
) -> tuple[Specimen, ...]:
    """Return the specimens of columns of equal length, named as in a file."""
    faults: list[str] = []
    numbers = {
        name: np.array([_number(entry) for entry in column])
        for name, column in columns.items()
        if name != "specimen"
    }
    unit = next(name for name in _WEAR if name in columns)
    wear = numbers.pop(unit) * _WEAR[unit]
    cycles = numbers.pop("cycles")
    scatter = numbers.pop("standard_error_mm", None)
    names = [str(name) for name in columns.get("specimen", [""] * len(cycles))]
    for row in np.flatnonzero(~(wear >= 0.0) | ~np.isfinite(wear)).tolist():
        faults.append(f"{source}: row {row + 2}: the wear is no number that is not negative")
    for row in np.flatnonzero(~((cycles >= 1) & (cycles <= 1e12) & (cycles % 1 == 0))).tolist():
        faults.append(f"{source}: row {row + 2}: cycles are whole numbers from 1 to 1e12")
    if scatter is not None and not np.all(scatter > 0.0):
        faults.append(f"{source}: every standard_error_mm must be positive")
    if len(cycles) < 2:
        faults.append(f"{source}: one reading determines nothing; give at least two")
    made = []
    for name in dict.fromkeys(names):
        rows = np.array([name == other for other in names])
        if np.any(np.diff(cycles[rows]) < 0):
            faults.append(f"{source}: specimen {name or '(the only one)'}: cycles must ascend")
        changes = {}
        for key, values in numbers.items():
            if len(set(values[rows].tolist())) > 1 or not np.all(np.isfinite(values[rows])):
                faults.append(f"{source}: {key}: must be one number for each specimen ({name})")
            changes[key] = float(values[rows][0])
        error = None if scatter is None else scatter[rows]
        made.append(Specimen(name, cycles[rows], wear[rows], error, changes))
    if faults:
        raise UsageError("\n".join(faults[:50]))
    return tuple(made)


def _number(entry: object) -> float:
    try:
        return float(entry)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        return math.nan
