"""The `[load]` table of a scene: conversion to a load, and back."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from contextlib import suppress
from typing import Any

from pydantic import ValidationError, ValidationInfo

from wear.load.csv_file import ForceFile, RowsFile, read_rows
from wear.load.piecewise_linear import ForceTable, HistoryLoad, Table, load_from_file
from wear.validation import TABLES, EntryError, SceneTable, choice, problems, wrong
from wear.words import did_you_mean, shown

PERIODIC = ("sine", "constant", "harmonics", "table")
KINDS = (*PERIODIC, "force", "history", "blocks")
ROWS = {"table": Table, "force": ForceTable, "history": HistoryLoad}
"""Loads whose rows are in the scene file itself."""
FORMAT = ("file", "columns", "delimiter", "decimal", "encoding", "repeat")
"""Entries on which it depends how a file is read: where one of them is wrong, its rows are not."""


def load_from_table(raw: object, info: ValidationInfo, kinds: Collection[str] = KINDS) -> Any:
    """Return the load of a `[load]` table of one of these kinds, or a load unchanged.

    The context's `folder` is where CSV files are looked for. Raises pydantic's `ValidationError`.
    """
    if not isinstance(raw, Mapping):
        if not all(hasattr(raw, name) for name in ("minimum", "maximum", "mean")):
            raise wrong("is not a table", "write [load] on a line of its own")
        if isinstance(raw, SceneTable):
            choice(as_table(raw)["kind"], kinds, "kind")
        return raw
    if "kind" not in raw:
        meant = did_you_mean("kind", raw)
        remedy = f"did you mean kind instead of {shown(meant)}?" if meant else "add kind = ..."
        raise wrong("missing", f"{remedy} ({', '.join(kinds)})", "kind")
    kind = choice(raw["kind"], kinds, "kind")
    entries = {key: value for key, value in raw.items() if key != "kind"}
    by_rows = ROWS if "times_s" in entries else {"force": ForceFile} if "file" in entries else {}
    table = ({each.kind: each for each in TABLES} | by_rows)[kind]
    validator = table.__pydantic_validator__  # type: ignore[attr-defined]
    folder = (info.context or {}).get("folder")
    try:
        load = validator.validate_python(entries, context=info.context)
    except ValidationError as error:
        faults = problems(error)
        bad = {str(path[0]) for path, *_ in faults if path}
        if issubclass(table, RowsFile) and not any(did_you_mean(key, FORMAT) for key in bad):
            sane = {key: entry for key, entry in entries.items() if key not in bad}
            try:
                with suppress(ValidationError):  # an entry that the wrong ones would explain
                    read_rows(validator.validate_python(sane, context=info.context), folder)
            except EntryError as bad_rows:
                faults += bad_rows.findings
        raise EntryError(*faults) from None
    return load_from_file(load, folder) if isinstance(load, RowsFile) else load


def as_table(load: Any) -> dict[str, Any]:
    """Return the `[load]` table that `load_from_table` converts to an equal load.

    >>> as_table(Table((0.0, 1.0), (0.0, 0.0)))
    {'kind': 'table', 'times_s': [0.0, 1.0], 'values_mm': [0.0, 0.0]}
    """
    table = getattr(load, "source", None) or load
    kind = table.kind or next(name for name, rows in ROWS.items() if isinstance(load, rows))
    entries = {name: getattr(table, name) for name in table.entries}
    if kind == "blocks":
        entries["blocks"] = [as_table(b.load) | {"cycles": b.cycles} for b in load.blocks]
    defaults = {name: entry.default for name, entry in table.entries.items()}
    return {"kind": kind} | {
        name: list(value) if isinstance(value, tuple) else value
        for name, value in entries.items()
        if value != defaults[name]
    }
