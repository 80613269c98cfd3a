"""Files that users give: their bytes, and the rows of a CSV file as instruments write it."""

from __future__ import annotations

import codecs
import csv
import math
import re
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

MISSING = "there is no such file"
UTF_16_MARKS = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
MOST_HEAD_LINES = 100  # before the names of the columns, as instruments write them


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


class CsvRows(NamedTuple):
    """The rows below the line with the names of the columns, each with the number of its line."""

    delimiter: str
    line: int
    names: list[str]
    rows: Iterator[tuple[int, list[str]]]


def find_rows(
    text: str, delimiters: Iterable[str], is_header: Callable[[list[str]], bool]
) -> CsvRows | None:
    """Return the rows of a CSV text below its header, without blank ones; None without header."""
    lines = re.split("\r\n?|\n", text)
    for number, line in enumerate(lines[:MOST_HEAD_LINES], start=1):
        for delimiter in delimiters:
            if is_header(names := cells_of(line, delimiter)):
                below = enumerate((cells_of(row, delimiter) for row in lines[number:]), number + 1)
                return CsvRows(delimiter, number, names, (row for row in below if any(row[1])))
    return None


def cells_of(line: str, delimiter: str) -> list[str]:
    """Return the cells of a line without quotes and outer blanks."""
    cells = line.split(delimiter)
    if '"' in line:
        with suppress(csv.Error):  # a cell of more than 128 KiB
            [cells] = csv.reader([line], delimiter=delimiter)
    return [cell.strip() for cell in cells]


def number_in(cell: str, decimal: str) -> float:
    """Return the number of a cell, NaN if there is none. A point beside decimal commas is none: it
    may separate thousands; nor is an underscore, which Python would overlook."""
    if "_" in cell or (decimal == "," and "." in cell):
        return math.nan
    try:
        return float(cell.replace(decimal, "."))
    except ValueError:
        return math.nan
