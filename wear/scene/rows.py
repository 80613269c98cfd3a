"""CSV files of loads: columns t_s,U_a_mm, bounded in size, every bad row told with its line."""

from __future__ import annotations

import hashlib
import stat
from pathlib import Path
from typing import NamedTuple

import numpy as np

from wear.scene.schema import LARGEST, SMALLEST
from wear.scene.text import read_bytes
from wear.scene.value import Wrong, shown

MOST_BYTES = 64 * 1024 * 1024
MOST_ROWS = 1_000_000
MOST_WRONG_ROWS = 5
COLUMNS = ["t_s", "U_a_mm"]
CLOSEST_ROWS = 1e-12  # of the time: nearer rows could fall on the same phase


class Rows(NamedTuple):
    """Times in s from 0, increasing; displacements in mm; the sha256 of the file."""

    times: list[float]
    displacements: list[float]
    sha256: str


def read_rows(name: str, folder: Path | None) -> Rows | list[Wrong]:
    """The rows of a file, by its path from `folder`, or what is wrong with it."""
    if folder is None:
        return [Wrong("there is no folder to look in", "load the scene by its path")]
    file = folder / name
    if _is_device(file):
        return [Wrong(f"{shown(name)} is no ordinary file", "give a CSV file")]
    data = read_bytes(file, MOST_BYTES)
    if isinstance(data, tuple):
        problem, remedy = data
        place = shown(str(folder.absolute()), most=1000)
        looked = "" if Path(name).is_absolute() else f" (looked for in {place})"
        return [Wrong(f"{shown(name)}: {problem}{looked}", remedy)]
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return [Wrong(f"{shown(name)} is not UTF-8 text", "save it as UTF-8")]
    times, displacements, wrong = _parse(text)
    if wrong:
        return [
            Wrong(f"{shown(name)} line {line}: {found.problem}", found.remedy)
            for line, found in wrong
        ]
    return Rows(times, displacements, hashlib.sha256(data).hexdigest())


def _is_device(file: Path) -> bool:
    """Whether reading the file might never end, or wait for ever."""
    try:
        mode = file.stat().st_mode
    except OSError:
        return False  # the attempt to read it says what is wrong
    return not (stat.S_ISREG(mode) or stat.S_ISDIR(mode))


def _parse(text: str) -> tuple[list[float], list[float], list[tuple[int, Wrong]]]:
    """The two columns, and the first few lines that are wrong."""
    lines = [(n, line) for n, line in enumerate(text.split("\n"), start=1) if line.strip()]
    header = [column.strip() for column in lines[0][1].split(",")] if lines else []
    if header != COLUMNS:
        return [], [], [(1, _header_fault(lines[0][1].strip() if lines else ""))]
    if not 2 <= len(lines) - 1 <= MOST_ROWS:
        count = f"there are {len(lines) - 1} rows"
        return [], [], [(1, Wrong(count, f"give from 2 to {MOST_ROWS}"))]
    columns = _sound_columns([line for _, line in lines[1:]])
    if columns is not None:
        return *columns, []
    times: list[float] = []
    displacements: list[float] = []
    wrong: list[tuple[int, Wrong]] = []
    for number, line in lines[1:]:
        row = _parse_row(line)
        found = row if isinstance(row, Wrong) else _order_fault(row[0], times)
        if found is not None:
            wrong.append((number, found))
        if len(wrong) == MOST_WRONG_ROWS:
            break
        if not isinstance(row, Wrong):
            times.append(row[0])
            displacements.append(row[1])
    return times, displacements, wrong


def _sound_columns(lines: list[str]) -> tuple[list[float], list[float]] | None:
    """Both columns if every row is right, at a tenth of the time that it takes to look at rows one
    by one; None if one is wrong, or written in an unusual way."""
    try:
        values = np.loadtxt(lines, delimiter=",", comments=None, ndmin=2)
    except ValueError:
        return None
    if values.shape != (len(lines), len(COLUMNS)):
        return None
    size, (times, displacements) = np.abs(values), values.T
    sane = np.all((size == 0.0) | ((size >= SMALLEST) & (size <= LARGEST)))
    rising = times[0] == 0.0 and np.all(np.diff(times) > CLOSEST_ROWS * times[1:])
    return (times.tolist(), displacements.tolist()) if sane and rising else None


def _header_fault(header: str) -> Wrong:
    wanted = ",".join(COLUMNS)
    if isinstance(_parse_row(header), tuple):
        return Wrong("the columns have no names", f"put the line {wanted} above the numbers")
    if ";" in header or "\t" in header:
        remedy = f"begin with {wanted}, put commas between the columns and points in the numbers"
    else:
        remedy = f"begin with {wanted}"
    return Wrong(f"the columns are {shown(header) or 'missing'}", remedy)


def _parse_row(line: str) -> tuple[float, float] | Wrong:
    numbers = [_number(cell) for cell in line.split(",")]
    match numbers:
        case [float(time), float(displacement)]:
            return time, displacement
    return Wrong(f'"{shown(line.strip())}" is no row', "give two finite numbers of sane size")


def _number(cell: str) -> float | None:
    try:
        number = float(cell)
    except ValueError:
        return None
    return number if number == 0.0 or SMALLEST <= abs(number) <= LARGEST else None


def _order_fault(time: float, before: list[float]) -> Wrong | None:
    if not before:
        problem = f"t_s starts at {time!r}"
        return None if time == 0.0 else Wrong(problem, "subtract the first t_s from all")
    if time - before[-1] > CLOSEST_ROWS * time:
        return None
    return Wrong(f"t_s = {time!r} does not come after {before[-1]!r}", "sort by time")
