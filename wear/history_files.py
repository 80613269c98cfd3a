"""Histories as files: CSV and NetCDF-3, whole or not at all."""

from __future__ import annotations

import csv
import json
import secrets
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from wear.history import History


def write_csv(history: History, path: Path) -> None:
    """Write comments (`# key: value`), a header and a line a cycle."""
    columns = history.columns()
    values = (column.values.tolist() for column in columns)
    with _replacing(path) as draft, draft.open("w", encoding="utf-8", newline="") as file:
        file.writelines(f"# {key}: {value}\n" for key, value in _attributes(history).items())
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["cycle", *(column.name for column in columns)])
        writer.writerows(zip(history.cycles.tolist(), *values, strict=True))


def write_netcdf(history: History, path: Path) -> None:
    """Write variables along the dimension `cycle`, with `units` and `long_name`.

    NetCDF-3 has no 64-bit integers: cycles are doubles, exact up to 2**53.
    """
    from scipy.io import netcdf_file

    with _replacing(path) as draft, netcdf_file(draft, "w") as file:
        for key, value in _attributes(history).items():
            setattr(file, key, value)
        file.createDimension("cycle", len(history.cycles))
        number = file.createVariable("cycle", "d", ("cycle",))
        number[:] = history.cycles
        number.units, number.long_name = "1", "number of load cycles"
        for column in history.columns():
            variable = file.createVariable(column.name, "d", ("cycle",))
            variable[:] = column.values
            variable.units, variable.long_name = column.unit, column.meaning


def _attributes(history: History) -> dict[str, str]:
    """What describes a result, each in one line and none empty."""
    return {
        "title": json.dumps(history.scene, ensure_ascii=True).strip('"') or "untitled",
        "scene": history.definition or "{}",
        "variant": history.variant,
        "operations": json.dumps(dict(history.operations)),
        "method": history.method,
        "rtol": repr(history.rtol),
        "cost": json.dumps(dict(history.cost)),
        "seconds": repr(history.seconds),
        "notices": json.dumps(history.notices),
    }


@contextmanager
def _replacing(path: Path) -> Iterator[Path]:
    """Give a name beside `path` to write to; it takes its place if nothing goes wrong."""
    draft = path.with_name(f".{path.stem}-{secrets.token_hex(4)}{path.suffix}")
    try:
        yield draft
        draft.replace(path)
    finally:
        draft.unlink(missing_ok=True)
