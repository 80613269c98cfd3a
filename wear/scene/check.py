"""The tables of a scene against the schema: every problem found, none raised.

`check_scene` takes the tables as TOML gives them and returns plain, complete values (defaults
filled in, numbers as floats) and the problems. A problem knows its path in the file, not its line.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from wear.scene.schema import (
    BLOCKS_LOAD,
    CYCLES,
    DESCRIPTION,
    LOADS,
    MOST_BLOCKS,
    MOST_CYCLES,
    PERIODIC_LOADS,
    RENAMED,
    TABLES,
    TITLE,
    Key,
    Kind,
    Table,
    kind_key,
)
from wear.scene.value import Wrong, check_value, did_you_mean, shown

Path = tuple[str | int, ...]
"""Where a value stands: ("bearing", "hardness_MPa"), ("load", "blocks", 0, "cycles")."""

Values = dict[str, Any]
"""The checked values of a table; `load.blocks` holds a list of such tables."""

MOST_UNKNOWN_KEYS = 20


@dataclass(frozen=True)
class Problem:
    """What is wrong at `path`, and what to do about it."""

    path: Path
    problem: str
    remedy: str


def _unknown_keys(
    raw: Mapping[str, object], known: tuple[str, ...], path: Path
) -> tuple[list[Problem], set[str]]:
    """Problems of the unknown keys, and the known keys that they seem to stand for."""
    problems, meant_keys = [], set()
    unknown = [name for name in raw if name not in known]
    for name in unknown[:MOST_UNKNOWN_KEYS]:
        remedy = _home_of(name, path)
        if RENAMED.get(name) in known:
            remedy = f"renamed to {RENAMED[name]}"
            meant_keys.add(RENAMED[name])
        if not remedy and (meant := did_you_mean(name, known)):
            remedy = f"did you mean {meant}?"
            meant_keys.add(meant)
        remedy = remedy or f"known here: {', '.join(known)}"
        what = "table" if isinstance(raw[name], Mapping) else "key"
        problems.append(Problem((*path, name), f"unknown {what}", remedy))
    if len(unknown) > MOST_UNKNOWN_KEYS:
        more = f"{len(unknown) - MOST_UNKNOWN_KEYS} more unknown keys"
        problems.append(Problem(path, more, f"known here: {', '.join(known)}"))
    return problems, meant_keys


def _home_of(name: str, path: Path) -> str:
    """Where a key that stands in the wrong table, or under the wrong kind of load, belongs."""
    homes = [f"[{table.name}]" for table in TABLES if name in table.names]
    if path[:1] == ("load",):
        homes += [f'kind = "{load.name}"' for load in LOADS if name in load.names]
    return f"it belongs to {' or '.join(homes)}" if homes else ""


def _group_problems(table: Table, present: set[str], path: Path) -> list[Problem]:
    """Faults of `one_of` and `together`, given the keys that are there."""
    problems = []
    one_of = " or ".join(table.one_of)
    given = [name for name in table.one_of if name in present]
    if table.one_of and not given:
        problems.append(Problem(path, f"{one_of} is missing", "give one of the two"))
    if len(given) > 1:
        problems.append(
            Problem(
                (*path, given[1]), f"{' and '.join(given)} are both given", "keep one of the two"
            )
        )
    given = [name for name in table.together if name in present]
    if given and len(given) < len(table.together):
        missing = next(name for name in table.together if name not in present)
        problems.append(Problem(path, f"{missing} is missing", f"give it too, or drop {given[0]}"))
    return problems


def check_table(
    table: Table, raw: object, path: Path, *more_keys: Key
) -> tuple[Values, list[Problem]]:
    """The values of one table, with the defaults of what it leaves out."""
    if not isinstance(raw, Mapping):
        name = str(path[0])
        return {}, [Problem(path, "is not a table", f"write [{name}] on a line of its own")]
    keys = (*table.keys, *more_keys)
    problems, meant = _unknown_keys(raw, tuple(key.name for key in keys), path)
    values: Values = {}
    for key in keys:
        if key.name not in raw:
            if key.required and key.name not in meant:
                hint = f" ({key.meaning})" if not key.unit else f" ({key.meaning}, in {key.unit})"
                problems.append(
                    Problem((*path, key.name), "missing", f"add {key.name} = ...{hint}")
                )
            values[key.name] = key.default
            continue
        if key.kind is Kind.BLOCKS:
            values[key.name], found = _check_blocks(raw[key.name], (*path, key.name))
            problems += found
            continue
        value = check_value(key, raw[key.name])
        if isinstance(value, Wrong):
            problems.append(Problem((*path, key.name), value.problem, value.remedy))
        else:
            values[key.name] = value
    return values, problems + _group_problems(table, {*raw, *meant}, path)


def _check_load(
    raw: object, path: Path, loads: tuple[Table, ...], *more_keys: Key
) -> tuple[Values, list[Problem]]:
    kind = kind_key(loads)
    if not isinstance(raw, Mapping):
        return check_table(loads[0], raw, path)
    if "kind" not in raw:
        meant = did_you_mean("kind", raw)
        remedy = f"did you mean kind instead of {shown(meant)}?" if meant else "add kind = ..."
        return {}, [Problem((*path, "kind"), "missing", f"{remedy} ({', '.join(kind.choices)})")]
    name = check_value(kind, raw["kind"])
    if isinstance(name, Wrong):
        return {}, [Problem((*path, "kind"), name.problem, name.remedy)]
    load = next(load for load in loads if load.name == name)
    return check_table(load, raw, path, kind, *more_keys)


def _check_blocks(raw: object, path: Path) -> tuple[list[Values], list[Problem]]:
    if not isinstance(raw, list) or not all(isinstance(block, Mapping) for block in raw):
        return [], [Problem(path, "is not a list of tables", "write [[load.blocks]] for each")]
    if not 1 <= len(raw) <= MOST_BLOCKS:
        found, remedy = f"has {len(raw)} blocks", f"give from 1 to {MOST_BLOCKS}; see repeat"
        return [], [Problem(path, found, remedy)]
    checked = [
        _check_load(block, (*path, place), PERIODIC_LOADS, CYCLES)
        for place, block in enumerate(raw)
    ]
    return [values for values, _ in checked], [p for _, problems in checked for p in problems]


def _check_load_limits(load: Values) -> list[Problem]:
    """Limits that need more than one value of a load that is sound key by key."""
    if load["kind"] != BLOCKS_LOAD.name:
        return []
    total = load["repeat"] * sum(block["cycles"] for block in load["blocks"])
    if total <= MOST_CYCLES:
        return []
    return [Problem(("load", "repeat"), f"makes {total:.3g} cycles in all",
                    f"stay below {MOST_CYCLES:.0e}")]  # fmt: skip


def _check_roughness(values: Mapping[str, Values]) -> list[Problem]:
    rough = [values[solid].get("roughness_mm") for solid in ("bearing", "pin") if solid in values]
    if any(roughness is None or roughness > 0.0 for roughness in rough):
        return []
    problem = "the roughness is zero on " + (
        "both solids" if len(rough) > 1 else "the only rough solid"
    )
    return [Problem(("bearing", "roughness_mm"), problem,
                    "give at least one solid a roughness_mm > 0")]  # fmt: skip


def check_scene(raw: Mapping[str, object]) -> tuple[dict[str, Values], list[Problem]]:
    """The values of every table that the scene has, its texts under '', and all problems."""
    tables = {table.name: table for table in TABLES}
    known = (TITLE.name, DESCRIPTION.name, *tables, "load")
    problems, meant = _unknown_keys(raw, known, ())
    values: dict[str, Values] = {"": {}}
    for key in (TITLE, DESCRIPTION):
        text = check_value(key, raw.get(key.name, ""))
        if isinstance(text, Wrong):
            problems.append(Problem((key.name,), text.problem, text.remedy))
        values[""][key.name] = text
    for name, table in tables.items():
        if name in raw:
            values[name], found = check_table(table, raw[name], (name,))
            problems += found
        elif table.required and name not in meant:
            problems.append(Problem((name,), "missing", f"add a table [{name}] ({table.meaning})"))
    if "load" in raw:
        values["load"], found = _check_load(raw["load"], ("load",), LOADS)
        problems += found or _check_load_limits(values["load"])
    elif "load" not in meant:
        problems.append(Problem(("load",), "missing", "add a table [load] (the motion U_a(t))"))
    if "bearing" in values:
        problems += _check_roughness(values)
    return values, problems
