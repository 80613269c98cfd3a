"""The scene file as Markdown, from the classes that validate it."""

from __future__ import annotations

import re
from functools import partial
from types import UnionType
from typing import Annotated, Any, Union, get_args, get_origin

from wear.load.blocks import Block
from wear.load.conversion import KINDS, PERIODIC, ROWS
from wear.quantities import unit_of
from wear.scene import Scene
from wear.validation import TABLES, SceneTable

_SYMBOL = re.compile(r"\b(sigma|phi|[UHKfhpRu])_(\w+)\b|\b(sigma|phi)\b|(?P<code>\{.*?\})")
_UNITS = ("_mm", "_N")  # of columns
_WORDS = {"max": r"\max"}
_TABLES = ("bearing", "pin", "contact", "support", "motion")
_KINDS = {float: "a number", int: "a whole number", bool: "true or false", str: "text"}


def reference() -> str:
    """A section a table of the file, a row a key."""
    parts = ["## Top of the file", _keys(Scene, ("title", "description"))]
    for name in _TABLES:
        table = next(each for each in TABLES if each.place == name)
        parts += [f"## `[{name}]`", _sentence(table), _keys(table)]
    parts += [
        "## `[load]`",
        "The displacement $U_a(t)$ of the pin, or its reaction $R_a(t)$. `kind` chooses among the "
        "following.",
    ]
    for kind in KINDS:
        row = f'| `kind` | `"{kind}"` | kind of load |'
        parts.append(f'### `kind = "{kind}"`')
        for table in (each for each in TABLES if each.kind == kind):
            parts += [_sentence(table), _keys(table, first=row)]
        if kind in ROWS:
            parts += ["Or the rows stand in the scene file itself:", _keys(ROWS[kind], first=row)]
    names = ", ".join(f"`{kind}`" for kind in PERIODIC)
    parts += [
        "### `[[load.blocks]]`",
        f"Each block is a periodic load ({names}) with its keys, and",
        _keys(Block, only=("cycles",)),
    ]
    return "\n\n".join(parts)


def _sentence(table: type[SceneTable]) -> str:
    """The first paragraph of the class's docstring."""
    words = " ".join((table.__doc__ or "").split("\n\n")[0].split())
    return _typeset(f"{words[0].upper()}{words[1:]}")


def _keys(table: type[SceneTable], only: tuple[str, ...] = (), first: str = "") -> str:
    rows = ["| key | value | meaning |", "| --- | --- | --- |", *([first] if first else [])]
    rows += [
        f"| `{name}` | {_value(name, field)}{_default(table, name, field)} | "
        f"{_typeset(field.description)} |"
        for name, field in table.entries.items()
        if not only or name in only
    ]
    return "\n".join(rows)


def _typeset(meaning: str) -> str:
    r"""Symbols of a plain sentence in mathematics, options and braces as code, columns as they are.

    >>> _typeset("roughness sigma_c0, columns t_s,U_a_mm, R_a = p b L, { phi = 1 }")
    'roughness $\\sigma_{c0}$, columns t_s,U_a_mm, $R_{a}$ = p b L, `{ phi = 1 }`'
    """

    def symbol(found: re.Match[str]) -> str:
        name, index, alone, code = found.groups()
        if code:
            return f"`{code}`"
        if index is not None and index.endswith(_UNITS):
            return found[0]
        letter = name or alone
        greek = rf"\{letter}" if len(letter) > 1 else letter
        return f"${greek}_{{{_WORDS.get(index, index)}}}$" if index else f"${greek}$"

    return _SYMBOL.sub(symbol, re.sub(r"(--\w+)", r"`\1`", meaning))


def _value(name: str, field: Any) -> str:
    inner = [each for part in get_args(field.annotation) for each in get_args(part)[1:]]
    kinds = [getattr(each, "func", None) for each in (*field.metadata, *inner)]
    options: dict[str, Any] = next((k.keywords for k in kinds if isinstance(k, partial)), {})
    if choices := options.get("known"):
        return ", ".join(f'`"{choice}"`' for choice in choices)
    kind, unit = _kind(field.annotation), unit_of(name)
    if domain := options.get("domain"):
        return f"{kind} {domain}{unit and ' '}{unit}"
    return f"{kind}{unit and ', '}{unit}"


def _kind(annotation: Any) -> str:
    """
    >>> _kind(float | None), _kind(tuple[float, ...])
    ('a number', 'a list of numbers')
    """
    parts, origin = get_args(annotation), get_origin(annotation)
    if origin in (UnionType, Union, Annotated):
        return _kind(parts[0])
    if origin is not tuple:
        return _KINDS[annotation]
    if parts[0] is Block:
        return "a list of tables"
    return f"a list of {_kind(parts[0]).removeprefix('a ')}s"


def _default(table: type[SceneTable], name: str, field: Any) -> str:
    if field.is_required() and name not in table.left_out:
        return ""
    default = table.left_out.get(name, field.default)
    if default in (None, (), ""):
        return "; may be left out"
    shown = str(default).lower() if isinstance(default, bool) else repr(default)
    shown = re.sub(r"^\((.*)\)$", r"[\1]", shown)
    return f"; default `{shown}`".replace("'", '"')
