"""CSV files of loads: two columns by their names, bounded in size, every bad row with its line.

Key results
    TableFile, ForceFile, HistoryFile   the `[load]` tables that describe the format of a file
    read_rows                           the rows of a file
"""

from __future__ import annotations

import codecs
import hashlib
import json
import re
import stat
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Annotated, Any, ClassVar, NamedTuple

import numpy as np
from pydantic import AfterValidator, Field, PlainValidator, ValidationError

from wear.numerics.gauss import FloatArray
from wear.validation import (
    BOUNDS,
    Finding,
    Flag,
    OneOf,
    Positive,
    SceneTable,
    Text,
    Words,
    all_wrong,
    is_sane,
    table,
    wrong,
)
from wear.words import shown

MOST_BYTES = 64 * 1024 * 1024
MOST_ROWS = 1_000_000
MOST_WRONG_ROWS = 5
MOST_HEAD_LINES = 100  # before the names of the columns, as instruments write them
MISSING = "there is no such file"
UTF_16_MARKS = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
CLOSEST_ROWS = 1e-12  # of the time: nearer rows could fall on the same phase
SECONDS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "µs": 1e-6, "min": 60.0, "h": 3600.0}
MILLIMETRES = {"mm": 1.0, "um": 1e-3, "µm": 1e-3, "nm": 1e-6, "m": 1e3}
NEWTONS = {"N": 1.0, "kN": 1e3, "mN": 1e-3}


def _encoding(name: str) -> str:
    try:
        "".encode(name)
    except (LookupError, ValueError):
        remedy = "give an encoding, such as utf-8 or latin-1"
        raise wrong(f'"{shown(name)}" is unknown', remedy) from None
    return name


def _delimiter(raw: object) -> str:
    if not isinstance(raw, str) or len(raw) != 1 or raw.isalnum() or raw in '.+-"':
        raise wrong("is not a delimiter", 'give one character, such as ";" or "\\t"')
    return raw


def _pair(raw: object) -> tuple[str, ...]:
    if not isinstance(raw, list | tuple) or [type(name) for name in raw] != [str, str]:
        raise wrong("is not a pair of names", 'give both in quotes: columns = ["...", "..."]')
    if raw[0] == raw[1]:
        raise wrong("names one column twice", "name that of the times and that of the values")
    return tuple(raw)


def _file(columns: str, ending: str = "") -> Any:
    place = "beside the scene file (if given by --set: in the current folder)"
    about = f"CSV file with columns {columns}, {place}; t_s starts at 0{ending}"
    return Field(description=about)


Encoding = Annotated[Text, AfterValidator(_encoding)]
Delimiter = Annotated[str, PlainValidator(_delimiter)]
FileName = Annotated[str, Words(1000)]
Names = Annotated[tuple[str, str], PlainValidator(_pair)]


@table("")
class RowsFile(SceneTable):
    """A CSV file of rows, and its format; `units` are those of the second column."""

    units: ClassVar[Mapping[str, float]] = MILLIMETRES
    file: FileName = _file("t_s,U_a_mm")
    period_s: Positive | None = Field(default=None, description="period T")
    sha256: Text | None = Field(default=None, description="checksum that the file must have")
    columns: Names = Field(
        default=("t_s", "U_a_mm"), description="names of the columns of time and displacement"
    )
    time_unit: Annotated[str, OneOf(SECONDS)] = Field(
        default="s", description="unit of the time column"
    )
    unit: Annotated[str, OneOf(MILLIMETRES)] = Field(
        default="mm", description="unit of the displacement column"
    )
    delimiter: Delimiter = Field(default=",", description="character between the columns")
    decimal: Annotated[str, OneOf((".", ","))] = Field(
        default=".", description="decimal sign of the numbers"
    )
    encoding: Encoding = Field(default="utf-8", description="encoding of the text")

    @classmethod
    def relations(cls, given: Mapping[str, Any]) -> Iterator[Finding]:
        if given.get("decimal") == "," and given.get("delimiter", ",") == ",":
            yield "decimal", "is the delimiter too", 'give the delimiter, such as delimiter = ";"'


@table("load", kind="table")
class TableFile(RowsFile):
    """U_a by straight lines between the rows of a CSV file over one period."""

    file: FileName = _file("t_s,U_a_mm", ", the last row repeats the first U_a")
    period_s: Positive | None = Field(
        default=None,
        description="period T; left out, the last t_s. If later, a straight line back to the "
        "first row closes the period",
    )
    repeat: Flag = Field(
        default=False,
        description="true: take one period out of the record, from its first row on; a straight "
        "line to the first row closes it. The period is period_s, or the last time plus one step",
    )
    resample: Flag = Field(
        default=True,
        description="true: rows are merged as far as the requested accuracy allows",
    )


@table("load", kind="history")
class HistoryFile(RowsFile):
    """U_a by straight lines between the rows of a CSV file, not periodic."""

    period_s: Positive | None = Field(
        default=None, description="time of a cycle, only to count cycles; left out, the last t_s"
    )


@table("load", kind="force")
class ForceFile(TableFile):
    """R_a by straight lines between the rows of a CSV file over one period."""

    units: ClassVar[Mapping[str, float]] = NEWTONS
    file: FileName = _file("t_s,R_a_N", ", the last row repeats the first R_a")
    columns: Names = Field(
        default=("t_s", "R_a_N"), description="names of the columns of time and force"
    )
    unit: Annotated[str, OneOf(NEWTONS)] = Field(
        default="N", description="unit of the force column"
    )


class Rows(NamedTuple):
    """Times in s from 0, increasing; displacements in mm, or forces in N; the file's sha256."""

    times: FloatArray
    values: FloatArray
    sha256: str


def read_rows(form: RowsFile, folder: Path | None, *, from_first: bool = False) -> Rows:
    """Return the rows of a file, by its path from `folder`; with `from_first`, times count from the
    first row.

    Raises pydantic's `ValidationError` with all faults.
    """
    name = form.file
    if folder is None:
        raise wrong("there is no folder to look in", "load the scene by its path", "file")
    path = folder / name
    if _is_device(path):
        raise wrong(f"{shown(name)} is not an ordinary file", "give a CSV file", "file")
    data = read_bytes(path, MOST_BYTES)
    if isinstance(data, tuple):
        problem, remedy = data
        place = shown(str(folder.absolute()), most=1000)
        looked = "" if Path(name).is_absolute() else f" (looked for in {place})"
        raise wrong(f"{shown(name)}: {problem}{looked}", remedy, "file")
    try:
        text = data.decode("utf-8-sig" if form.encoding == "utf-8" else form.encoding)
    except UnicodeDecodeError:
        known = form.encoding.upper()
        likely = "utf-16" if data.startswith(UTF_16_MARKS) else "latin-1"
        remedy = f'save it as {known} text, or give encoding = "{likely}"'
        raise wrong(f"{shown(name)} is not {known} text", remedy, "file") from None
    times, values = _parse(text, form, from_first)
    digest = hashlib.sha256(data).hexdigest()
    if form.sha256 not in (None, digest):
        problem = f"{shown(name)} has changed: its sha256 is {digest}"
        raise wrong(problem, "restore the file, or drop this key", "sha256")
    return Rows(times * SECONDS[form.time_unit], values * form.units[form.unit], digest)


def order_faults(times: FloatArray) -> list[LineFault]:
    """Return (row, problem, remedy) for times that do not rise from 0."""
    faults = []
    if times[0] != 0.0:
        problem = f"t_s starts at {float(times[0])!r}"
        faults.append((0, problem, "subtract the first t_s from all"))
    late = np.flatnonzero(~(np.diff(times) > CLOSEST_ROWS * np.abs(times[1:])))
    for at in late[:MOST_WRONG_ROWS].tolist():
        before, time = times[at : at + 2].tolist()
        faults.append((at + 1, f"t_s = {time!r} does not come after {before!r}", "sort by time"))
    return faults


def read_bytes(path: Path, most: int) -> bytes | tuple[str, str]:
    """Return at most `most` bytes of a file, or its fault and the remedy."""
    try:
        with path.open("rb") as stream:
            data = stream.read(most + 1)
    except FileNotFoundError:
        return MISSING, "check the name and the folder"
    except IsADirectoryError:
        return "is a folder", "give a file"
    except PermissionError:
        return "may not be read", "check its permissions"
    except (OSError, ValueError) as error:
        return f"cannot be read ({getattr(error, 'strerror', None) or error})", "check the file"
    if len(data) > most:
        return f"is larger than {most // 1024} KiB", "give a smaller file"
    return data


def _is_device(file: Path) -> bool:
    """Return whether reading the file might never end."""
    try:
        mode = file.stat().st_mode
    except OSError:
        return False  # the attempt to read it reports the fault
    return not (stat.S_ISREG(mode) or stat.S_ISDIR(mode))


LineFault = tuple[int, str, str]
"""Number of a line, its fault, and the remedy."""


def _wrong_lines(form: RowsFile, *faults: LineFault) -> ValidationError:
    """Return the error for lines of a file."""
    name = shown(form.file)
    return all_wrong(*(("file", f"{name} line {n}: {text}", cure) for n, text, cure in faults))


def _parse(text: str, form: RowsFile, from_first: bool) -> FloatArray:
    """Return the two columns, or raise the faults of the first few faulty lines."""
    split = re.split("\r\n?|\n", text)
    lines = [(n, line) for n, line in enumerate(split, start=1) if line.strip()]
    heads = (_cells(line, form) for _, line in lines[:MOST_HEAD_LINES])
    head = next((n for n, cells in enumerate(heads) if set(form.columns) <= set(cells)), None)
    if head is None:
        raise _wrong_lines(form, _header_fault(lines[0] if lines else (1, ""), form))
    cells = _cells(lines[head][1], form)
    number, rows = lines[head][0], lines[head + 1 :]
    if twice := [name for name in form.columns if cells.count(name) > 1]:
        problem, remedy = f"two columns are called {shown(twice[0])}", "rename one of them"
        raise _wrong_lines(form, (number, problem, remedy))
    if not 2 <= len(rows) <= MOST_ROWS:
        problem = f"the number of rows below is {len(rows)}"
        raise _wrong_lines(form, (number, problem, f"give from 2 to {MOST_ROWS}"))
    return _columns(rows, form, cells, from_first)


def _cells(line: str, form: RowsFile) -> list[str]:
    return [cell.strip().strip('"') for cell in line.split(form.delimiter)]


def _columns(
    rows: list[tuple[int, str]], form: RowsFile, header: list[str], from_first: bool
) -> FloatArray:
    """Return both columns, or raise the faults of the first few faulty rows."""
    places = [header.index(name) for name in form.columns]
    numbers: list[int] = []
    valid: list[list[float | None]] = []
    faults: list[LineFault] = []
    for number, line in rows:
        cells = line.split(form.delimiter)
        row = [_number(cells[at], form) for at in places if len(cells) == len(header)]
        if not row:
            problem = f'"{shown(line.strip())}" has {len(cells)} cells, the header {len(header)}'
            remedy = "give one for each column; delimiter and decimal say how the file is written"
            faults.append((number, problem, remedy))
        elif None in row:
            at = places[row.index(None)]
            problem = f'{shown(header[at])} is "{shown(cells[at].strip())}"'
            remedy = f"give a number without unit, such as 0{form.decimal}5; {BOUNDS}"
            faults.append((number, problem, remedy))
        else:
            numbers.append(number)
            valid.append(row)
        if len(faults) == MOST_WRONG_ROWS:
            break
    columns = np.array(valid, dtype=float).reshape(-1, 2).T
    if valid:
        columns[0] -= columns[0, 0] if from_first else 0.0
        faults += [(numbers[at], problem, cure) for at, problem, cure in order_faults(columns[0])]
    if faults:
        raise _wrong_lines(form, *sorted(faults)[:MOST_WRONG_ROWS])
    return columns


def _header_fault(first: tuple[int, str], form: RowsFile) -> LineFault:
    line, header = first[0], first[1].strip()
    wanted = form.delimiter.join(form.columns)
    if len(_cells(header, form)) > 1 and all(
        _number(cell, form) is not None for cell in _cells(header, form)
    ):
        return line, "the columns have no names", f"put the line {wanted} above the numbers"
    names = [*_cells(header, form), "...", "..."][:2] if header else ["...", "..."]
    remedy = f"begin with {wanted}, or say columns = {json.dumps(names, ensure_ascii=False)}"
    if other := next((sign for sign in ";\t" if sign in header and sign != form.delimiter), ""):
        remedy = (
            f"begin with {wanted}, put commas between the columns and points in the numbers, or "
            f"say how the file is written: delimiter = {json.dumps(other)}, decimal = ..."
        )
    return line, f"the columns are {shown(header) or 'missing'}", remedy


def _number(cell: str, form: RowsFile) -> float | None:
    """Return the number of a cell, quoted or not; None unless it is a number of sane size."""
    try:
        number = float(cell.strip().strip('"').replace(form.decimal, "."))
    except ValueError:
        return None
    return number if is_sane(number) else None
