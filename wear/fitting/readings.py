"""Measured wear of one or several specimens, from a CSV file or from columns."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from wear.faults import MOST_FAULTS_SHOWN, Faults, UsageError
from wear.input_files import UTF_16_MARKS, find_rows, number_in, read_bytes
from wear.numerics.gauss import FloatArray
from wear.quantities import MOST_CYCLES
from wear.words import is_path, shown

MOST_BYTES = 16 * 1024 * 1024
WEAR = {"wear_mm": 1.0, "wear_um": 1e-3}  # column: mm a unit
DELIMITERS = (",", ";", "\t")  # the decimal sign may be a comma where the first is not

# The condition on the numbers of a column, and its message.
_CHECKS: dict[str, tuple[Callable[[FloatArray], NDArray[np.bool_]], str]] = {
    "cycles": (
        lambda n: (n >= 1) & (n <= MOST_CYCLES) & (n % 1 == 0),
        "must be a whole number from 1 to 1e12",
    ),
    **{name: (lambda u: (u >= 0.0) & np.isfinite(u), "must be a number >= 0") for name in WEAR},
    "standard_error_mm": (lambda e: (e > 0.0) & np.isfinite(e), "must be a number > 0"),
}


@dataclass(frozen=True)
class Specimen:
    """One worn contact: its readings, and the entries in which its scene differs.

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

    def first(self, readings: int) -> Specimen:
        """Return the specimen with its first few readings."""
        error = self.standard_error_mm
        return replace(
            self,
            cycles=self.cycles[:readings],
            wear_mm=self.wear_mm[:readings],
            standard_error_mm=None if error is None else error[:readings],
        )


Specimens = tuple[Specimen, ...]


def read_readings(path: str | os.PathLike[str], ignore: Sequence[str] = ()) -> Specimens:
    """Return the specimens of a CSV file.

    A line names the columns: `cycles`, `wear_mm` or `wear_um`, and if need be `standard_error_mm`
    and `specimen`; any other names an entry of the scene, or is dropped by `ignore`. Above it there
    may be lines as instruments write them. Columns are separated by commas, or by semicolons or
    tabs, and then the decimal sign may be a comma.

    Raises
    ------
    UsageError
        with all faults of the file.
    """
    if not is_path(path):
        raise UsageError(f"readings: {path!r} is not the name of a file")
    data = read_bytes(Path(path), MOST_BYTES)
    if isinstance(data, tuple):
        raise UsageError(f"{path}: {'; '.join(data)}")
    try:
        text = data.decode("utf-16" if data.startswith(UTF_16_MARKS) else "utf-8-sig")
    except UnicodeDecodeError:
        text = data.decode("latin-1")
    found = find_rows(text, DELIMITERS, lambda names: "cycles" in map(_name, names))
    if found is None:
        raise UsageError(
            f"{path}: there is no column cycles: name the columns in a line above the readings, "
            "cycles and wear_mm or wear_um (a time over load.period_s is a number of cycles)"
        )
    names, body = [*map(_name, found.names)], [*found.rows]
    faults = [
        f"line {number}: {len(cells)} entries, but the header has {len(names)}"
        for number, cells in body
        if len(cells) != len(names)
    ]
    if len(set(names)) < len(names):
        faults.append("a column is named twice")
    specimens: Specimens = ()
    if not faults:
        columns = {name: [cells[i] for _, cells in body] for i, name in enumerate(names)}
        commas = found.delimiter != "," and any("," in cell for _, cells in body for cell in cells)
        lines = [f"line {number}" for number, _ in body]
        specimens, faults = _specimens(columns, ignore, lines, "," if commas else ".")
    Faults(f"{path}: {fault}" for fault in faults[:MOST_FAULTS_SHOWN]).stop_if_any()
    return specimens


def readings_of(columns: Mapping[str, Iterable[Any]], ignore: Sequence[str]) -> Specimens:
    """Return the specimens of columns by their names, as `read_readings` takes them from a file."""
    try:
        entries = {str(name): [*columns[name]] for name in columns}
    except TypeError:
        raise UsageError("data: every column must be a list of numbers") from None
    most = max(map(len, entries.values()), default=0)
    if any(len(column) != most for column in entries.values()):
        raise UsageError("data: the columns are of different length")
    rows = [f"row {number}" for number in range(1, most + 1)]
    found, faults = _specimens(entries, ignore, rows)
    Faults(f"data: {fault}" for fault in faults[:MOST_FAULTS_SHOWN]).stop_if_any()
    return found


def _name(cell: str) -> str:
    """Return the name of a column, known names in lower case."""
    return cell.lower() if cell.lower() in (*_CHECKS, "specimen") else cell


def _faults_of_names(names: Sequence[str], ignore: Sequence[str]) -> Iterator[str]:
    """Yield every fault of the names of the columns."""
    if "cycles" not in names:
        yield "there is no column cycles"
    if sum(name in WEAR for name in names) != 1:
        yield f"give the wear in one column, {' or '.join(WEAR)}"
    for name in names:
        if name not in (*_CHECKS, "specimen", *ignore) and "." not in name:
            yield (f"column {shown(name)}: unknown; name an entry of the scene, as in "
                   f"load.value_mm, or drop it by --ignore {shown(name)}")  # fmt: skip
    for name in ignore:
        if name not in names:
            yield f"--ignore {name}: there is no such column"


def _specimens(
    entries: Mapping[str, Sequence[Any]],
    ignore: Sequence[str],
    rows: Sequence[str],
    decimal: str = ".",
) -> tuple[Specimens, list[str]]:
    """Return the specimens of columns of equal length, and the faults of their entries."""
    if faults := [*_faults_of_names(list(entries), ignore)]:
        return (), faults
    columns = {name: column for name, column in entries.items() if name not in ignore}
    names = [str(name) for name in columns.pop("specimen", [""] * len(rows))]
    numbers = {
        name: np.array([_number(entry, decimal) for entry in column])
        for name, column in columns.items()
    }
    hint = " (without points: the decimal sign is a comma)" if decimal == "," else ""
    faults = [
        f"{rows[i]}: {name} {rule}{hint}"
        for name, (meets, rule) in _CHECKS.items()
        if name in numbers
        for i in np.flatnonzero(~meets(numbers[name])).tolist()
    ]
    unit = next(name for name in WEAR if name in columns)
    wear, cycles = numbers.pop(unit) * WEAR[unit], numbers.pop("cycles")
    scatter = numbers.pop("standard_error_mm", None)
    if len(cycles) < 2:
        faults.append("one reading determines nothing; give two or more")
    specimens = []
    for name in dict.fromkeys(names):
        rows_of = np.array([name == other for other in names])
        of = f" of specimen {shown(name)}" if name else ""
        faults += [
            f"{rows[i]}: the cycles{of} decrease; sort the readings"
            for i in np.flatnonzero(rows_of)[1:][np.diff(cycles[rows_of]) < 0][:1]
        ]
        changes = {key: values[rows_of] for key, values in numbers.items()}
        faults += [
            f"{key}{of} must be one number"
            for key, values in changes.items()
            if not np.all(np.isfinite(values) & (values == values[0]))
        ]
        error = None if scatter is None else scatter[rows_of]
        entry = {key: float(values[0]) for key, values in changes.items()}
        specimens.append(Specimen(name, cycles[rows_of], wear[rows_of], error, entry))
    return tuple(specimens), faults


def _number(entry: Any, decimal: str) -> float:
    try:
        return number_in(entry, decimal) if isinstance(entry, str) else float(entry)
    except (TypeError, ValueError):
        return np.nan
