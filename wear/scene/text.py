"""The text of a scene: bytes to TOML tables, the line of every key, `--set` overrides.

Reading is bounded in bytes and in line length, so that no file can exhaust memory or time, and runs
nothing: TOML is data.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path as FilePath
from typing import Any

from wear.faults import Fault, SceneError
from wear.scene.check import Path, Problem
from wear.scene.schema import CONTACT, LOADS, TABLES
from wear.scene.value import shown

MOST_BYTES = 256 * 1024
LONGEST_LINE = 4096  # tomllib's time grows with the square of a dotted key's length

_HEADER = re.compile(r"\s*(\[\[?)\s*([^\[\]]+?)\s*\]\]?\s*(?:#.*)?$")
_ENTRY = re.compile(r"\s*([A-Za-z0-9_\-\"'. \t]+?)\s*=")
_TABLE_PATHS = {(table.name,) for table in TABLES} | {("load",)}
_AT_LINE = re.compile(r"\s*\(at line (\d+), column (\d+)\)")


@dataclass(frozen=True)
class Source:
    """Where a scene came from: its name for messages, the line of each path, the overrides.

    `faults` are those of options that could not be read.
    """

    file: str
    lines: Mapping[Path, int] = field(default_factory=dict)
    overrides: Mapping[Path, str] = field(default_factory=dict)
    faults: tuple[Fault, ...] = ()

    def fault(self, problem: Problem) -> Fault:
        """`problem` with its place in the file, or the `--set` option that caused it."""
        path = problem.path
        table, key = _table_and_key(path)
        prefixes = [path[:depth] for depth in range(len(path), 0, -1)]
        option = next((self.overrides[p] for p in prefixes if p in self.overrides), None)
        line = next((self.lines[p] for p in prefixes if p in self.lines), None)
        if option is None and line is None:  # a table that only an option made
            option = next((o for p, o in self.overrides.items() if p[: len(path)] == path), None)
        if option is not None:
            place = f"--set {shown(option)}"
            return Fault(place, None, table, key, problem.problem, problem.remedy)
        return Fault(self.file, line, table, key, problem.problem, problem.remedy)


def _table_and_key(path: Path) -> tuple[str, str]:
    """
    >>> _table_and_key(("load", "blocks", 0, "cycles"))
    ('load.blocks, block 1', 'cycles')
    """
    *tables, key = path or ("",)
    if isinstance(key, int) or path in _TABLE_PATHS:
        tables, key = [*tables, key], ""
    words = ".".join(shown(part) for part in tables if isinstance(part, str))
    block = "".join(f", block {part + 1}" for part in tables if isinstance(part, int))
    return words + block, shown(str(key))


def read_bytes(path: FilePath, most: int) -> bytes | tuple[str, str]:
    """At most `most` bytes of a file, or what is wrong with it and the remedy."""
    try:
        with path.open("rb") as stream:
            data = stream.read(most + 1)
    except FileNotFoundError:
        return "there is no such file", "check the name and the folder"
    except IsADirectoryError:
        return "is a folder", "give a file"
    except PermissionError:
        return "may not be read", "check its permissions"
    except (OSError, ValueError) as error:
        return f"cannot be read ({getattr(error, 'strerror', None) or error})", "check the file"
    if len(data) > most:
        return f"is larger than {most // 1024} KiB", "give a smaller file"
    return data


def read_tables(
    data: bytes | str, file: str, overrides: Sequence[str] = ()
) -> tuple[dict[str, Any], Source]:
    """The TOML tables of a scene with the overrides applied.

    Raises `SceneError` when the text is no TOML at all.
    """
    text = _decode(data, file)
    tables = _parse(text, file)
    faults: list[Fault] = []
    options: dict[Path, str] = {}
    for option in overrides:
        entry = _read_override(option)
        if isinstance(entry, Fault):
            faults.append(entry)
            continue
        path, value = entry
        _set_entry(tables, path, value, keep=options)
        options[path] = option
    return tables, Source(file, key_lines(text), options, tuple(faults))


def _decode(data: bytes | str, file: str) -> str:
    def refuse(line: int | None, problem: str, remedy: str) -> SceneError:
        return SceneError([Fault(file, line, "", "", problem, remedy)])

    if len(data) > MOST_BYTES:
        size = f"is larger than {MOST_BYTES // 1024} KiB"
        raise refuse(None, size, "move long data to a CSV file")
    try:
        text = data.decode("utf-8-sig") if isinstance(data, bytes) else data
    except UnicodeDecodeError as error:
        line = error.object[: error.start].count(b"\n") + 1
        raise refuse(line, "is not UTF-8 text", "save the file as UTF-8") from None
    for number, words in enumerate(text.split("\n"), start=1):
        if len(words) > LONGEST_LINE:
            problem = f"the line has more than {LONGEST_LINE} characters"
            raise refuse(number, problem, "break the line")
    if not text.strip():
        raise refuse(None, "is empty", "start from a built-in scene")
    return text


def _parse(text: str, file: str) -> dict[str, Any]:
    try:
        return tomllib.loads(text)
    except RecursionError:
        fault = Fault(file, None, "", "", "is nested too deeply", "a scene has flat tables")
    except ValueError as error:  # TOMLDecodeError, or an integer of more than 4300 digits
        words = str(error)
        at = _AT_LINE.search(words)
        line = int(at[1]) if at else None
        if "end of document" in words:
            line = text.count("\n", 0, len(text.rstrip())) + 1
        if "integer string conversion" in words:
            words = "a whole number has too many digits"
        problem = f"is not TOML: {shown(_AT_LINE.sub('', words), most=120)}"
        fault = Fault(file, line, "", "", problem, "correct the line; see https://toml.io")
    raise SceneError([fault])


def key_lines(text: str) -> dict[Path, int]:
    """The line, counted from 1, of each table header and `key =` found by a scan of the text.

    >>> key_lines("[bearing]\\nroughness_mm = 1.0")
    {('bearing',): 1, ('bearing', 'roughness_mm'): 2}
    """
    lines: dict[Path, int] = {}
    counts: dict[Path, int] = {}
    table: Path = ()
    in_string = ""
    for number, line in enumerate(text.split("\n"), start=1):
        was_in_string, in_string = in_string, _open_string(line, in_string)
        if was_in_string:
            continue
        if header := _HEADER.match(line):
            table = _split_key(header[2])
            if header[1] == "[[":
                counts[table] = counts.get(table, -1) + 1
                lines.setdefault(table, number)
                table = (*table, counts[table])
            lines.setdefault(table, number)
        elif entry := _ENTRY.match(line):
            lines.setdefault((*table, *_split_key(entry[1])), number)
    return lines


def _open_string(line: str, quotes: str) -> str:
    """The triple quotes that are still open after `line`."""
    for found in re.findall(r'"""|\'\'\'', line):
        quotes = "" if quotes == found else quotes or found
    return quotes


def _split_key(dotted: str) -> tuple[str, ...]:
    return tuple(part.strip().strip("\"'") for part in dotted.split("."))


# Overrides: TABLE.KEY=VALUE


def _read_override(option: str) -> tuple[Path, object] | Fault:
    """The path and the value of TABLE.KEY=VALUE.

    >>> _read_override("contact.law=exponential")
    (('contact', 'law'), 'exponential')
    """
    dotted, equals, raw = option.partition("=")
    path = tuple(part.strip() for part in dotted.split("."))
    if not equals or not all(path) or not 1 <= len(path) <= 2:
        remedy = "write --set TABLE.KEY=VALUE, such as --set bearing.hardness_MPa=200"
        return Fault(f"--set {shown(option)}", None, "", "", "is no TABLE.KEY=VALUE", remedy)
    value = _override_value(raw.strip())
    if path in _TABLE_PATHS and not isinstance(value, dict):
        known = next((table.names for table in TABLES if table.name == path[0]), ("kind",))
        problem = f"{path[0]} is a table with several entries"
        remedy = f"set one of them, such as --set {path[0]}.{known[0]}=VALUE"
        return Fault(f"--set {shown(option)}", None, "", "", problem, remedy)
    return path, value


def _override_value(raw: str) -> object:
    """VALUE as TOML; what is no TOML value is a bare word and stands for itself."""
    if "\n" in raw or len(raw) > LONGEST_LINE:
        return raw
    try:
        return tomllib.loads(f"value = {raw}")["value"]
    except (ValueError, RecursionError):
        return raw


def _set_entry(tables: dict[str, Any], path: Path, value: object, keep: Mapping[Path, str]) -> None:
    """Sets one entry, and drops from the file what the entry takes the place of.

    One closure takes the place of the other, a kind of load that of the keys which the new kind
    does not have, a file of rows that of the period and checksum of other rows; entries in `keep`,
    set by an option too, stay and are validated.
    """
    if len(path) == 1:
        tables[str(path[0])] = value
        return
    name, key = str(path[0]), str(path[1])
    table = tables.setdefault(name, {})
    if not isinstance(table, dict):
        return  # the validation says that it is no table
    table[key] = value
    replaced: list[str] = []
    if name == CONTACT.name and key in CONTACT.one_of:
        replaced = [other for other in CONTACT.one_of if other != key]
    if (name, key) == ("load", "kind"):
        known = {load.name: load.names for load in LOADS}
        every = {entry for names in known.values() for entry in names}
        replaced = sorted(every - set(known.get(str(value), every)))
    if (name, key) == ("load", "file"):
        replaced = ["period_s", "sha256"]
    for other in replaced:
        if (name, other) not in keep:
            table.pop(other, None)
