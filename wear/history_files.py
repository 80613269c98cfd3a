"""Result files: CSV and NetCDF-3, written completely or not at all."""

from __future__ import annotations

import csv
import json
import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from derive import files
from wear.faults import UsageError
from wear.quantities import COLUMNS, unit_of
from wear.words import is_path

Attributes = Mapping[str, str]
"""The description of a result, each value in one line and none empty."""

_NUMBER_OF_RECORDS = 4  # its place in a NetCDF-3 file, after "CDF" and the version


def title_attribute(title: str) -> str:
    """Return the title of a result in ASCII, all that NetCDF-3 has.

    >>> title_attribute("Prüfstand"), title_attribute("")
    ('Pr\\\\u00fcfstand', 'untitled')
    """
    return json.dumps(title, ensure_ascii=True).strip('"') or "untitled"


class States(NamedTuple):
    """A part of a result: `columns` by name, (n,) or (n, m), along whole `cycles` (n,) and, if
    given, the `phases` (m,) of each."""

    cycles: NDArray[Any]
    columns: Mapping[str, NDArray[Any]]
    phases: NDArray[np.float64] | None = None

    def by_name(self) -> dict[str, list[Any]]:
        """Return cycle, phase and columns, with one value for each state."""
        arrays: dict[str, NDArray[Any]] = {"cycle": self.cycles.astype(np.int64)[:, None]}
        if self.phases is not None:
            arrays["phase"] = self.phases[None]
        arrays |= {
            name: values if values.ndim == 2 else values[:, None]
            for name, values in self.columns.items()
        }
        full = np.broadcast_arrays(*arrays.values())
        return {name: values.ravel().tolist() for name, values in zip(arrays, full, strict=True)}


def write(parts: Iterable[States], path: str | os.PathLike[str], attributes: Attributes) -> None:
    """Write a `.csv` or `.nc` (NetCDF-3) file, a part at a time, completely or not at all.

    Raises
    ------
    UsageError
        for any other suffix, and for a folder that does not exist.
    OSError
        if the disk is full.
    """
    writers = {".csv": _write_lines, ".nc": _write_records}
    suffix = Path(path).suffix if is_path(path) else ""
    if suffix not in writers:
        raise UsageError(f"{path}: the name of a result ends in {' or '.join(writers)}")
    if problem := files.obstacle(path):
        raise UsageError(problem)
    with files.replacing(path) as draft:
        writers[suffix](parts, draft, attributes)


def _write_lines(parts: Iterable[States], path: Path, attributes: Attributes) -> None:
    """Write comments (`# key: value`), a header and a line for each state."""
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

    SciPy writes the header with one blank record, which the records of all parts replace; their
    number is written into the header at the end. NetCDF-3 has no 64-bit integers: cycles are
    doubles, exact up to 2**53.
    """
    rows = 0
    for number, part in enumerate(parts):
        records = np.column_stack([part.cycles, *part.columns.values()])
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
    """Write the description of a result, and one record of zeros."""
    from scipy.io import netcdf_file

    with netcdf_file(path, "w", version=2) as file:  # offsets of 64 bits: files of any size
        for key, value in attributes.items():
            setattr(file, key, value)
        file.createDimension("cycle", None)
        if part.phases is not None:
            file.createDimension("phase", len(part.phases))
            phase = file.createVariable("phase", "d", ("phase",))
            phase[:] = part.phases
            phase.units, phase.long_name = "1", "time since the end of the cycle, in periods"
        for name, values in {"cycle": part.cycles, **part.columns}.items():
            variable = file.createVariable(name, "d", ("cycle", "phase")[: values.ndim])
            variable[0] = 0.0
            variable.units, variable.long_name = unit_of(name) or "1", COLUMNS[name].meaning
