"""The scene file as Markdown, from the schema that validates it."""

from __future__ import annotations

import re

from wear.scene import schema

_SYMBOL = re.compile(r"\b(sigma|phi|[UHKfhpRu])_(\w+)\b|\b(sigma|phi)\b")
_WORDS = {"max": r"\max"}


def reference() -> str:
    """A section a table of the file, a row a key."""
    parts = ["## Top of the file", _keys((schema.TITLE, schema.DESCRIPTION))]
    for table in schema.TABLES:
        parts += [f"## `[{table.name}]`", _sentence(table), _keys(table.keys)]
    parts += [
        "## `[load]`",
        "The displacement $U_a(t)$ of the pin. `kind` chooses among the following.",
    ]
    for load in schema.LOADS:
        kind = schema.Key("kind", schema.Kind.CHOICE, f'`"{load.name}"`')
        parts += [f'### `kind = "{load.name}"`', _sentence(load), _keys((kind, *load.keys))]
    names = ", ".join(f"`{load.name}`" for load in schema.PERIODIC_LOADS)
    parts += [
        "### `[[load.blocks]]`",
        f"Each block is a periodic load ({names}) with its keys, and",
        _keys((schema.CYCLES,)),
    ]
    return "\n\n".join(parts)


def _sentence(table: schema.Table) -> str:
    said = [_typeset(f"{table.meaning[0].upper()}{table.meaning[1:]}.")]
    if table.one_of:
        said.append(f"Exactly one of {_listed(table.one_of, 'and')} is given.")
    if table.together:
        said.append(f"Give both of {_listed(table.together, 'and')} or neither.")
    return " ".join(said)


def _listed(names: tuple[str, ...], word: str) -> str:
    return f" {word} ".join(f"`{name}`" for name in names)


def _keys(keys: tuple[schema.Key, ...]) -> str:
    rows = ["| key | value | meaning |", "| --- | --- | --- |"]
    rows += [
        f"| `{key.name}` | {_value(key)}{_default(key)} | {_typeset(key.meaning)} |" for key in keys
    ]
    return "\n".join(rows)


def _typeset(meaning: str) -> str:
    r"""Symbols of a plain sentence in mathematics, options as code; names of columns stay.

    >>> _typeset("roughness sigma_c0, columns t_s,U_a_mm, R_a = p b L")
    'roughness $\\sigma_{c0}$, columns t_s,U_a_mm, $R_{a}$ = p b L'
    """

    def symbol(found: re.Match[str]) -> str:
        name, index, alone = found.groups()
        if index is not None and index.endswith("_mm"):
            return found[0]
        letter = name or alone
        greek = rf"\{letter}" if len(letter) > 1 else letter
        return f"${greek}_{{{_WORDS.get(index, index)}}}$" if index else f"${greek}$"

    return _SYMBOL.sub(symbol, re.sub(r"(--\w+)", r"`\1`", meaning))


def _value(key: schema.Key) -> str:
    if key.choices:
        return ", ".join(f'`"{name}"`' for name in key.choices)
    unit = f" {key.unit}" if key.unit else ""
    if key.kind is schema.Kind.NUMBER and key.domain is not schema.Domain.REAL:
        return f"{key.kind.value} {key.domain.value}{unit}"
    return f"{key.kind.value}{unit and ','}{unit}"


def _default(key: schema.Key) -> str:
    if key.required:
        return ""
    if key.default is None or key.default == ():
        return "; may be left out"
    shown = str(key.default).lower() if isinstance(key.default, bool) else repr(key.default)
    return f"; default `{shown}`".replace("'", '"')
