"""CSV files of loads: two columns by their names, bounded in size, every bad row with its line.

Key results
    TableFile, ForceFile, HistoryFile   the `[load]` tables that describe the format of a file
    read_rows                           the rows of a file
"""

from __future__ import annotations

import hashlib
import json
import re
import unicodedata
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Annotated, Any, ClassVar, NamedTuple

import numpy as np
from pydantic import AfterValidator, Field, PlainValidator

from wear.input_files import UTF_16_MARKS, cells_of, find_rows, number_in, read_bytes
from wear.numerics.gauss import FloatArray
from wear.validation import (
    BOUNDS,
    EntryError,
    Finding,
    Flag,
    Positive,
    SceneTable,
    Text,
    is_sane,
    one_of,
    table,
    words,
    wrong,
)
from wear.words import are_texts, shown

MOST_BYTES = 64 * 1024 * 1024
MOST_ROWS = 1_000_000
MOST_WRONG_ROWS = 5
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
FileName = Annotated[str, PlainValidator(partial(words, most=1000))]
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
    time_unit: Annotated[str, one_of(SECONDS)] = Field(
        default="s", description="unit of the time column"
    )
    unit: Annotated[str, one_of(MILLIMETRES)] = Field(
        default="mm", description="unit of the displacement column"
    )
    delimiter: Delimiter = Field(default=",", description="character between the columns")
    decimal: Annotated[str, one_of((".", ","))] = Field(
        default=".", description="decimal sign of the numbers"
    )
    encoding: Encoding = Field(default="utf-8", description="encoding of the text")

    @classmethod
    def relations(cls, given: Mapping[str, Any]) -> Iterator[Finding]:
        if given.get("decimal") == "," and given.get("delimiter", ",") == ",":
            yield (
                ("decimal",),
                "is the delimiter too",
                'give the delimiter, such as delimiter = ";"',
            )
        if are_texts(columns := given.get("columns", ())):
            yield from cls.units_against(columns, given)

    @classmethod
    def units_against(cls, columns: Sequence[str], given: Mapping[str, Any]) -> Iterator[Finding]:
        """Yield the `given` units that contradict the names of the columns."""
        units = {"time_unit": SECONDS, "unit": cls.units}
        for (key, known), column in zip(units.items(), columns, strict=False):
            unit, named = given.get(key, cls.entries[key].default), _unit_named(column, known)
            if named and known.get(str(unit), known[named]) != known[named]:
                problem = f'is "{unit}", but the column "{shown(column)}" is named in {named}'
                yield (key,), problem, f'give {key} = "{named}", or rename the column'


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
    unit: Annotated[str, one_of(NEWTONS)] = Field(
        default="N", description="unit of the force column"
    )


def _unit_named(column: str, units: Mapping[str, float]) -> str:
    """Return the unit that the name of a column ends in, '' if none.

    >>> _unit_named("U_a_um", MILLIMETRES), _unit_named("Zeit [ms]", SECONDS)
    ('um', 'ms')
    """
    known = {unicodedata.normalize("NFKC", unit): unit for unit in units}
    words = re.findall(r"[^\W_]+", unicodedata.normalize("NFKC", column))
    return known.get(words[-1], "") if len(words) > 1 else ""


class Rows(NamedTuple):
    """Times in s from 0, increasing; displacements in mm, or forces in N; the file's sha256."""

    times: FloatArray
    values: FloatArray
    sha256: str


def read_rows(form: RowsFile, folder: Path | None) -> Rows:
    """Return the rows of a file, by its path from `folder`; times of a record that repeats count
    from the first row.

    Raises `EntryError` with all faults.
    """
    name = form.file
    if folder is None:
        raise wrong("there is no folder to look in", "load the scene by its path", "file")
    data = read_bytes(folder / name, MOST_BYTES)
    if isinstance(data, tuple):
        problem, remedy = data
        place = shown(str(folder.absolute()), most=1000)
        looked = "" if Path(name).is_absolute() else f" (looked for in {place})"
        raise wrong(f"{shown(name)}: {problem}{looked}", remedy, "file")
    try:
        text = data.decode("utf-8-sig" if form.encoding == "utf-8" else form.encoding)
    except UnicodeError:
        known = form.encoding.upper()
        likely = "utf-16" if data.startswith(UTF_16_MARKS) else "latin-1"
        remedy = f'save it as {known} text, or give encoding = "{likely}"'
        raise wrong(f"{shown(name)} is not {known} text", remedy, "file") from None
    times, values = _parse(text, form)
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
        remedy = "keep one of the two rows" if time == before else "sort by time"
        faults.append((at + 1, f"t_s = {time!r} does not come after {before!r}", remedy))
    return faults


LineFault = tuple[int, str, str]
"""Number of a line, its fault, and the remedy."""


def _wrong_lines(form: RowsFile, *faults: LineFault) -> EntryError:
    """Return the error for lines of a file."""
    name = shown(form.file)
    return EntryError(*((("file",), f"{name} line {n}: {text}", cure) for n, text, cure in faults))


def _parse(text: str, form: RowsFile) -> FloatArray:
    """Return the two columns, or raise the faults of the first few faulty lines."""
    found = find_rows(text, form.delimiter, lambda names: set(form.columns) <= {*names})
    if found is None:
        raise _wrong_lines(form, _header_fault(text, form))
    units = {"time_unit": form.time_unit, "unit": form.unit}
    if against := [*form.units_against(form.columns, units)]:
        raise EntryError(*against)
    if twice := [name for name in form.columns if found.names.count(name) > 1]:
        problem, remedy = f"two columns are called {shown(twice[0])}", "rename one of them"
        raise _wrong_lines(form, (found.line, problem, remedy))
    places = [found.names.index(name) for name in form.columns]
    numbers: list[int] = []
    valid: list[list[float]] = []
    faults: list[LineFault] = []
    for number, cells in found.rows:
        complete = len(cells) == len(found.names)
        row = [number_in(cells[at], form.decimal) for at in places if complete]
        if complete and all(map(is_sane, row)):
            numbers.append(number)
            valid.append(row)
            continue
        if complete:
            at = next(at for at, value in zip(places, row, strict=True) if not is_sane(value))
            problem = f'{shown(found.names[at])} is "{shown(cells[at])}"'
            remedy = f"give a number without unit, such as 0{form.decimal}5; {BOUNDS}"
        elif cells[0].startswith("#"):
            problem, remedy = "is a comment below the header", "delete it, or put it above"
        else:
            line, many = shown(form.delimiter.join(cells)), "s" * (len(cells) > 1)
            problem = f'"{line}" has {len(cells)} cell{many}, the header {len(found.names)}'
            remedy = "give one for each column; delimiter and decimal say how the file is written"
        faults.append((number, problem, remedy))
        if len(faults) == MOST_WRONG_ROWS:
            break
    columns = np.array(valid, dtype=float).reshape(-1, 2).T
    if valid:
        from_first = isinstance(form, TableFile) and form.repeat
        columns[0] -= columns[0, 0] if from_first else 0.0
        starts = not faults or numbers[0] < faults[0][0]  # else the first row is faulty itself
        faults += [
            (numbers[at], problem, cure)
            for at, problem, cure in order_faults(columns[0])
            if at > 0 or starts
        ]
    if not faults and not 2 <= len(valid) <= MOST_ROWS:
        wrong = "few" if len(valid) < 2 else "many"
        problem = f"too {wrong} rows stand below: {len(valid)}"
        faults.append((found.line, problem, f"give from 2 to {MOST_ROWS}"))
    if faults:
        raise _wrong_lines(form, *sorted(faults)[:MOST_WRONG_ROWS])
    return columns


def _header_fault(text: str, form: RowsFile) -> LineFault:
    lines = enumerate(map(str.strip, text.splitlines()), start=1)
    line, header = next((each for each in lines if each[1]), (1, ""))
    wanted = form.delimiter.join(form.columns)
    cells = cells_of(header, form.delimiter)
    if len(cells) > 1 and all(is_sane(number_in(cell, form.decimal)) for cell in cells):
        return line, "the columns have no names", f"put the line {wanted} above the numbers"
    names = [*cells, "...", "..."][:2] if header else ["...", "..."]
    remedy = f"begin with {wanted}, or say columns = {json.dumps(names, ensure_ascii=False)}"
    units = {"time_unit": SECONDS, "unit": form.units}
    for name, (key, known) in zip(names, units.items(), strict=True):
        unit = _unit_named(name, known)
        if unit and known[unit] != known[form.entries[key].default]:
            remedy += f', {key} = "{unit}"'
    if other := next((sign for sign in ";\t" if sign in header and sign != form.delimiter), ""):
        remedy = (
            f"begin with {wanted}, put commas between the columns and points in the numbers, or "
            f"say how the file is written: delimiter = {json.dumps(other)}, "
            f'decimal = "{"," if "," in text else "."}"'
        )
    return line, f"the columns are {shown(header) or 'missing'}", remedy
