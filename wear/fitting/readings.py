"""Measured wear of one or several specimens, from a CSV file or from columns."""

from __future__ import annotations

import csv
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from wear.checked import MOST_CYCLES, shown
from wear.faults import MOST_FAULTS_SHOWN, UsageError
from wear.load.rows import read_bytes

FloatArray = NDArray[np.float64]
MOST_BYTES = 16 * 1024 * 1024
WEAR = {"wear_mm": 1.0, "wear_um": 1e-3}  # column: mm a unit
DELIMITERS = (",", ";", "\t")  # the decimal sign may be a comma where the first is not
MOST_HEAD_LINES = 100  # before the names of the columns, as instruments write them

# What the numbers of a column must be, and how to say so.
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

    def first(self, readings: int) -> Specimen:
        """Return the specimen with its first few readings."""
        error = self.standard_error_mm
        return replace(
            self,
            cycles=self.cycles[:readings],
            wear_mm=self.wear_mm[:readings],
            standard_error_mm=None if error is None else error[:readings],
        )


def read_readings(path: str | Path, ignore: Sequence[str] = ()) -> tuple[Specimen, ...]:
    """Return the specimens of a CSV file.

    A line names the columns: `cycles`, `wear_mm` or `wear_um`, and if need be `standard_error_mm`
    and `specimen`; any other names an entry of the scene, or is dropped by `ignore`. Above it there
    may be lines as instruments write them. Columns are separated by commas, or by semicolons or
    tabs, and then the decimal sign may be a comma.

    Raises
    ------
    UsageError
        with everything that is wrong with the file.
    """
    data = read_bytes(Path(path), MOST_BYTES)
    if isinstance(data, tuple):
        raise UsageError(f"{path}: {'; '.join(data)}")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = data.decode("latin-1")
    delimiter, lines = _from_header(text.splitlines())
    rows = [(number, cells) for number, line in lines if any(cells := _cells(line, delimiter))]
    names = rows[0][1] if rows else []
    faults = [*_faults_of_header(names, ignore)] + [
        f"line {number}: {len(row)} entries, but the header has {len(names)}"
        for number, row in rows[1:]
        if len(row) != len(names)
    ]
    if not faults:
        columns = {name: [row[i] for _, row in rows[1:]] for i, name in enumerate(names)}
        kept = {name: column for name, column in columns.items() if name not in ignore}
        found, faults = _specimens(kept, [number for number, _ in rows[1:]], delimiter)
    if faults:
        raise UsageError("\n".join(f"{path}: {fault}" for fault in faults[:MOST_FAULTS_SHOWN]))
    return found


def _from_header(lines: Sequence[str]) -> tuple[str, list[tuple[int, str]]]:
    """Return the delimiter, and the lines with their numbers from that which names the columns on;
    where none has a column `cycles`, all of them."""
    numbered = list(enumerate(lines, start=1))
    for place, line in enumerate(lines[:MOST_HEAD_LINES]):
        for delimiter in DELIMITERS:
            if "cycles" in _cells(line, delimiter):
                return delimiter, numbered[place:]
    return DELIMITERS[0], numbered


def _cells(line: str, delimiter: str) -> list[str]:
    return [cell.strip() for cell in next(csv.reader([line], delimiter=delimiter), [])]


def _faults_of_header(names: Sequence[str], ignore: Sequence[str]) -> Iterator[str]:
    """Yield what is wrong with the names of the columns."""
    if "cycles" not in names:
        yield "there is no column cycles"
    if sum(name in WEAR for name in names) != 1:
        yield f"give the wear in one column, {' or '.join(WEAR)}"
    if len(set(names)) < len(names):
        yield "a column is named twice"
    for name in names:
        if name not in (*_CHECKS, "specimen", *ignore) and "." not in name:
            yield (f"column {shown(name)}: unknown; name an entry of the scene, as in "
                   f"load.value_mm, or drop it by --ignore {shown(name)}")  # fmt: skip
    for name in ignore:
        if name not in names:
            yield f"--ignore {name}: there is no such column"


def _specimens(
    columns: Mapping[str, Sequence[str]], lines: Sequence[int], delimiter: str
) -> tuple[tuple[Specimen, ...], list[str]]:
    """Return the specimens of columns of equal length, and what is wrong with their entries."""
    comma = "," if delimiter != "," else "."
    numbers = {
        name: np.array([_number(entry.replace(comma, ".")) for entry in column], dtype=float)
        for name, column in columns.items()
        if name != "specimen"
    }
    faults = [
        f"line {lines[i]}: {name} {rule}"
        for name, (meets, rule) in _CHECKS.items()
        if name in numbers
        for i in np.flatnonzero(~meets(numbers[name])).tolist()
    ]
    unit = next(name for name in WEAR if name in columns)
    wear, cycles = numbers.pop(unit) * WEAR[unit], numbers.pop("cycles")
    scatter = numbers.pop("standard_error_mm", None)
    names = columns.get("specimen", [""] * len(cycles))
    if len(cycles) < 2:
        faults.append("one reading determines nothing; give two or more")
    made = []
    for name in dict.fromkeys(names):
        rows = np.array([name == other for other in names])
        of = f" of specimen {shown(name)}" if name else ""
        if np.any(np.diff(cycles[rows]) < 0):
            faults.append(f"the cycles{of} must ascend")
        changes = {key: values[rows] for key, values in numbers.items()}
        faults += [
            f"{key}{of} must be one number"
            for key, values in changes.items()
            if not np.all(np.isfinite(values) & (values == values[0]))
        ]
        error = None if scatter is None else scatter[rows]
        own = {key: float(values[0]) for key, values in changes.items()}
        made.append(Specimen(name, cycles[rows], wear[rows], error, own))
    return tuple(made), faults


def _number(entry: str) -> float:
    try:
        return float(entry)
    except ValueError:
        return np.nan
