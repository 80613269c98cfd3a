"""The text of a scene: bytes to TOML tables, the line of every key, `--set` overrides.

Reading is bounded in bytes and in line length, so that no file can exhaust memory or time, and runs
nothing: TOML is data.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from wear.faults import Fault, SceneError
from wear.validation import TABLES, EntryError, Path, place_of, wrong
from wear.words import shown

MOST_BYTES = 256 * 1024
LONGEST_LINE = 4096  # tomllib's time grows with the square of a dotted key's length

FORM = "write KEY = VALUE, numbers as -0.5 or 2e-6 without unit, text in quotes"
"""How a line of a scene file is written."""

PARTS = ("bearing", "pin", "contact", "support", "motion", "load")
"""The tables of a scene."""

_HEADER = re.compile(r"\s*(\[\[?)\s*([^\[\]]+?)\s*\]\]?\s*(?:#.*)?$")
_ENTRY = re.compile(r"\s*([A-Za-z0-9_\-\"'. \t]+?)\s*=")
_INDEXED = re.compile(r"([^\[\]]+)((?:\[\d{1,9}\])+)")
_COMMA = re.compile(r"=\s*[-+]?\d+,\d+\s*(#.*)?$")
_AT_LINE = re.compile(r"\s*\(at (?:line (\d+), column \d+|end of document)\)")


@dataclass(frozen=True)
class Source:
    """The source of a scene: its name for messages, the line of each path, the overrides.

    `faults` are those of options that could not be read.
    """

    file: str
    lines: Mapping[Path, int] = field(default_factory=dict)
    overrides: Mapping[Path, str] = field(default_factory=dict)
    faults: tuple[Fault, ...] = ()

    def fault(self, path: Path, problem: str, remedy: str) -> Fault:
        """Return a fault with its place in the file, or the `--set` option that caused it."""
        table, key = place_of(path)
        prefixes = [path[:depth] for depth in range(len(path), 0, -1)]
        option = next((self.overrides[p] for p in prefixes if p in self.overrides), None)
        line = next((self.lines[p] for p in prefixes if p in self.lines), None)
        if option is None and line is None:  # a table that only an option made
            option = next((o for p, o in self.overrides.items() if p[: len(path)] == path), None)
        if option is not None:
            place = f"--set {shown(option)}"
            return Fault(place, None, table, key, problem, remedy)
        return Fault(self.file, line, table, key, problem, remedy)


def read_tables(
    data: bytes | str, file: str, overrides: Sequence[str] = ()
) -> tuple[dict[str, Any], Source]:
    """Return the TOML tables of a scene with the overrides applied, and their source.

    Raises `SceneError` if the text is not TOML.
    """
    text = _decode(data, file)
    tables = _parse(text, file)
    faults: list[Fault] = []
    options: dict[Path, str] = {}
    for option in overrides:
        try:
            path, value = _read_override(option)
            if path in options:
                key = option.partition("=")[0].strip()
                raise wrong(f"{shown(key)} is set twice", "keep one of the two")
            set_entry(tables, path, value, keep=options)
        except EntryError as error:
            faults += faults_of(error, f"--set {shown(option)}")
        else:
            options[path] = option
    return tables, Source(file, key_lines(text), options, tuple(faults))


def faults_of(error: EntryError, place: str) -> list[Fault]:
    """Return the faults of an entry that could not be set."""
    return [Fault(place, None, "", "", *words) for _, *words in error.findings]


def _refused(file: str, line: int | None, problem: str, remedy: str) -> SceneError:
    """Return the error for a text that is no scene."""
    return SceneError([Fault(file, line, "", "", problem, remedy)])


def _decode(data: bytes | str, file: str) -> str:
    if len(data) > MOST_BYTES:
        size = f"is larger than {MOST_BYTES // 1024} KiB"
        raise _refused(file, None, size, "move long data to a CSV file")
    try:
        text = data.decode("utf-8-sig") if isinstance(data, bytes) else data
    except UnicodeDecodeError as error:
        line = error.object[: error.start].count(b"\n") + 1
        raise _refused(file, line, "is not UTF-8 text", "save the file as UTF-8") from None
    for number, words in enumerate(text.split("\n"), start=1):
        if len(words) > LONGEST_LINE:
            problem = f"the line has more than {LONGEST_LINE} characters"
            raise _refused(file, number, problem, "break the line")
    if not text.strip():
        raise _refused(file, None, "is empty", "start from a built-in scene")
    return text


def _parse(text: str, file: str) -> dict[str, Any]:
    try:
        return tomllib.loads(text)
    except RecursionError:
        fault = _refused(file, None, "is nested too deeply", "a scene has flat tables")
    except ValueError as error:  # TOMLDecodeError, or an integer of more than 4300 digits
        words, lines = str(error), text.rstrip().split("\n")
        at = _AT_LINE.search(words)
        number = int(at[1] or len(lines)) if at else None
        if "integer string conversion" in words:
            words = "a whole number has too many digits"
        problem = f"is not TOML: {shown(_AT_LINE.sub('', words), most=120)}"
        if number is not None:
            problem += f': "{shown(lines[number - 1].strip())}"'
        comma = number is not None and _COMMA.search(lines[number - 1])
        fault = _refused(file, number, problem, "write 0.5, with a point" if comma else FORM)
    raise fault


def key_lines(text: str) -> dict[Path, int]:
    """Return the line, counted from 1, of each table header and `key =`, by a scan of the text.

    >>> key_lines("[bearing]\\nroughness_mm = 1.0")
    {('bearing',): 1, ('bearing', 'roughness_mm'): 2}
    """
    lines: dict[Path, int] = {}
    counts: dict[Path, int] = {}
    table: Path = ()
    in_string = ""
    for number, line in enumerate(text.split("\n"), start=1):
        was_in_string = in_string
        for mark in re.findall(r'"""|\'\'\'', line):
            in_string = "" if in_string == mark else in_string or mark
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


def _split_key(dotted: str) -> tuple[str, ...]:
    return tuple(part.strip().strip("\"'") for part in dotted.split("."))


# Overrides: TABLE.KEY=VALUE


def _read_override(option: str) -> tuple[Path, object]:
    """Return the path and the value of TABLE.KEY=VALUE, or raise an `EntryError`.

    >>> _read_override("contact.law=exponential")
    (('contact', 'law'), 'exponential')
    """
    dotted, equals, raw = option.partition("=")
    path = path_of(dotted)
    of_table = 1 <= len(path) <= 2 or isinstance(path[2], int)
    if not equals or "" in path or not of_table:
        remedy = "write --set TABLE.KEY=VALUE, such as --set bearing.hardness_MPa=200"
        raise wrong("is not TABLE.KEY=VALUE", remedy)
    owner = next((each.place for each in TABLES if each.place and path[0] in each.entries), "")
    if len(path) == 1 and owner:
        raise wrong("the table is missing", f"did you mean {owner}.{path[0]}?")
    value = _override_value(raw.strip())
    if len(path) == 1 and path[0] in PARTS and not isinstance(value, dict):
        known = next(([*each.entries] for each in TABLES if (each.place,) == path), [])
        known = ["kind"] if path == ("load",) else known
        remedy = f"set one of them, such as --set {path[0]}.{known[0]}=VALUE"
        raise wrong(f"{path[0]} is a table with several entries", remedy)
    return path, value


def _override_value(raw: str) -> object:
    """Return VALUE as read by TOML, or as a text if it is a bare word."""
    if "\n" in raw or len(raw) > LONGEST_LINE:
        return raw
    try:
        return tomllib.loads(f"value = {raw}")["value"]
    except (ValueError, RecursionError):
        return raw


def path_of(key: str) -> Path:
    """Return the path of a key of the scene file.

    >>> path_of("bearing.hardness_MPa"), path_of("load.blocks[0].period_s")
    (('bearing', 'hardness_MPa'), ('load', 'blocks', 0, 'period_s'))
    """
    path: list[str | int] = []
    for part in map(str.strip, key.split(".")):
        item = _INDEXED.fullmatch(part)
        path += [item[1], *map(int, re.findall(r"\d+", item[2]))] if item else [part]
    return tuple(path)


def set_entry(
    tables: dict[str, Any], path: Path, value: object, keep: Collection[Path | str] = ()
) -> None:
    """Set one entry, or drop it for None, and drop the entries that it replaces.

    One closure replaces the other, a kind of load the keys that the new kind does not have, a file
    of rows the period and checksum of other rows; entries in `keep`, which are set too, remain and
    are validated. Raises `EntryError` if a list has no such entry.
    """
    name, inner = str(path[0]), path[1:]
    depth = next((place for place, part in enumerate(inner) if isinstance(part, int)), len(inner))
    key, within = ".".join(map(str, inner[:depth])), inner[depth:]
    if not key:
        tables[name] = _with_entry(tables.get(name), within, value)
    elif isinstance(table := tables.setdefault(name, {}), dict):
        table[key] = _with_entry(table.get(key), within, value)
        for other in _replaced(name, key, value):
            if (name, other) not in keep and f"{name}.{other}" not in keep:
                table.pop(other, None)
        tables[name] = {each: entry for each, entry in table.items() if entry is not None}
    elif name not in PARTS:
        tables[name] = {key: value}  # which a text is not
    if tables[name] is None:
        del tables[name]


def _with_entry(old: object, path: Sequence[str | int], value: object) -> object:
    """Return an entry with a part of it replaced: an item of a list, or an entry of a table."""
    if not path:
        return value
    place, *rest = path
    if isinstance(old, dict) and isinstance(place, str):
        return {**old, place: _with_entry(old.get(place), rest, value)}
    items = list(old) if isinstance(old, (list, tuple)) else []
    if not isinstance(place, int) or not place < len(items):
        raise wrong("is no entry of a list of the scene file", "name one that is, counted from 0")
    items[place] = _with_entry(items[place], rest, value)
    return items


def _replaced(name: str, key: str, value: object) -> list[str]:
    """Return the entries that a new one replaces."""
    if name == "contact" and key in ("closure_mm", "closure_in_sigma"):
        return [other for other in ("closure_mm", "closure_in_sigma") if other != key]
    if (name, key) == ("load", "kind"):
        known = [each.entries for each in TABLES if each.kind == value]
        every = {entry for each in TABLES if each.place == "load" for entry in each.entries}
        return [other for other in every if known and other not in known[0]]
    return ["period_s", "sha256"] if (name, key) == ("load", "file") else []
