"""Tables of a scene as frozen dataclasses that are checked on every way to them.

A field is an `entry` with a check, which returns the value or raises `EntryError` in words: what is
wrong, and what to do about it. The same checks run for a file, for `Scene.from_dict`, for a
constructor and for `dataclasses.replace`.

Key results
    table       class decorator: a frozen dataclass whose construction raises `SceneError`
    entry       a field that is checked: by `POSITIVE`, `NON_NEGATIVE`, `REAL`, `Text`, `OneOf`, ...
    EntryError       all that is wrong with a value or a table, each with its path
"""

from __future__ import annotations

import dataclasses
import math
import pathlib
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from numbers import Real
from typing import Any, ClassVar, NamedTuple, Self, TypeVar, dataclass_transform

from wear.faults import Fault, SceneError
from wear.quantities import LARGEST, MOST_CYCLES, SMALLEST, unit_of
from wear.words import did_you_mean, kind_of, shown

MOST_UNKNOWN_KEYS = 20

# Keys of versions before the first release, each with its name of today.
RENAMED = {"roughness_slope": "roughness_growth", "cutoff": "ends_at_3_sigma"}

T = TypeVar("T")
Path = tuple[str | int, ...]
"""Where a value stands: ("bearing", "hardness_MPa"), ("load", "blocks", 0, "cycles")."""

Finding = tuple[Path, str, str]
"""A path, the problem there, and its remedy."""


class EntryError(ValueError):
    """What is wrong with a value or a table; the paths of the `findings` begin there."""

    def __init__(self, findings: Iterable[Finding]) -> None:
        self.findings = tuple(findings)

    def at(self, *place: str | int) -> list[Finding]:
        """Return the findings with their paths from a table that has the value at a place."""
        return [((*place, *path), problem, remedy) for path, problem, remedy in self.findings]


def wrong(problem: str, remedy: str, *path: str | int) -> EntryError:
    """Return the error for a check to raise: what is wrong, and the remedy."""
    return EntryError([(path, problem, remedy)])


# Checks of entries


class Where(NamedTuple):
    """The key of an entry, and the folder where the files that it names are looked for."""

    key: str
    folder: pathlib.Path | None


Check = Callable[[Any, Where], Any]
"""Returns the value that was meant by what is given, or raises `EntryError`."""


def is_sane(number: float) -> bool:
    """Return whether a number is zero or of a magnitude that no scene exceeds."""
    return number == 0.0 or SMALLEST <= abs(number) <= LARGEST


@dataclasses.dataclass(frozen=True)
class Number:
    """A finite number of sane size, of a `domain`: '> 0', '>= 0' or '' for all."""

    domain: str = ""

    def __call__(self, raw: Any, where: Where) -> float:
        if type(raw) is float and self._fits(raw):
            return raw
        unit, domain = unit_of(where.key), self.domain
        ending = f", in {unit}" if unit else ""
        if isinstance(raw, str):
            remedy = f"give a number{ending}, without quotes"
            raise wrong(f'"{shown(raw)}" is text, not a number', remedy)
        if isinstance(raw, bool) or not isinstance(raw, Real):
            raise wrong(f"is {kind_of(raw)}", f"give a number{ending}")
        wanted = f"give a number {domain}{ending}" if domain else f"give any finite number{ending}"
        try:
            number = float(raw)
        except OverflowError:
            raise wrong("is a whole number too large for a float", wanted) from None
        if self._fits(number):
            return number
        if not math.isfinite(number):
            raise wrong(f"{number} is not a finite number", wanted)
        if number < 0.0 and domain:
            raise wrong(f"{number!r} is negative", wanted)
        if number == 0.0:
            raise wrong("is zero", wanted)
        bounds = f"magnitudes lie from {SMALLEST:g} to {LARGEST:g}"
        raise wrong(f"{number!r} is out of range", f"{wanted}; {bounds}")

    def _fits(self, number: float) -> bool:
        if number == 0.0:
            return self.domain != "> 0"
        return is_sane(number) and (number > 0.0 or not self.domain)


POSITIVE, NON_NEGATIVE, REAL = Number("> 0"), Number(">= 0"), Number()


@dataclasses.dataclass(frozen=True)
class Reals:
    """A list of at most so many numbers."""

    most: int = 1_000_000

    def __call__(self, raw: Any, where: Where) -> tuple[float, ...]:
        if hasattr(raw, "tolist"):  # NumPy's arrays
            raw = raw.tolist()
        if not isinstance(raw, list | tuple):
            remedy = "give a list of numbers in brackets, such as [1e-4, 2e-5]"
            raise wrong(f"is {kind_of(raw)}", remedy)
        if len(raw) > self.most:
            raise wrong(f"has {len(raw)} entries", f"give at most {self.most}")
        if all(type(entry) is float and is_sane(entry) for entry in raw):
            return tuple(raw)
        values, faults = list[float](), list[Finding]()
        for place, entry in enumerate(raw, start=1):
            try:
                values.append(REAL(entry, where))
            except EntryError as found:
                [(path, problem, remedy)] = found.findings
                faults.append((path, f"entry {place}: {problem}", remedy))
        if faults:
            raise EntryError(faults)
        return tuple(values)


def count(raw: Any, _: Where) -> int:
    """Return a whole number from 1 on."""
    remedy = f"give a whole number from 1 to {MOST_CYCLES:.0e}"
    if isinstance(raw, bool) or not isinstance(raw, int | float):
        raise wrong(f"is {kind_of(raw)}", remedy)
    if not 1 <= raw <= MOST_CYCLES:  # also catches nan
        raise wrong("is out of range", remedy)
    if raw != int(raw):
        raise wrong(f"{raw!r} is not a whole number", remedy)
    return int(raw)


def flag(raw: Any, _: Where) -> bool:
    """Return true or false."""
    if not isinstance(raw, bool):
        raise wrong("is no flag", "write true or false")
    return raw


@dataclasses.dataclass(frozen=True)
class Text:
    """Printable characters, at most so many, in one line or in several."""

    most: int = 200
    lines: bool = False

    def __call__(self, raw: Any, where: Where) -> str:
        if not isinstance(raw, str):
            raise wrong(f"is {kind_of(raw)}", f'give text in quotes: {where.key} = "..."')
        if len(raw) > self.most:
            raise wrong(f"has {len(raw)} characters", f"give at most {self.most}")
        if not (raw.replace("\n", "") if self.lines else raw).isprintable():
            raise wrong("has control characters", "use printable characters only")
        return raw


@dataclasses.dataclass(frozen=True)
class OneOf:
    """One of some names."""

    names: Collection[str]

    def __call__(self, raw: Any, _: Where) -> str:
        return choice(raw, self.names)


def choice(raw: object, known: Collection[str], *path: str) -> str:
    """Return `raw` if it is one of the known names, otherwise raise what was perhaps meant."""
    if isinstance(raw, str) and raw in known:
        return raw
    remedy = f"choose one of {', '.join(known)}"
    if not isinstance(raw, str):
        raise wrong("is not a name in quotes", remedy, *path)
    if meant := did_you_mean(raw, known):
        remedy = f"did you mean {meant}? C{remedy[1:]}"
    raise wrong(f'"{shown(raw)}" is unknown', remedy, *path)


# Tables


class SceneTable:
    """A table of the scene file: `place` is its name, `kind` chooses among those of that name.

    `entries` are its keys, `left_out` the values of those that a file may leave out, but not a
    constructor.
    """

    place: ClassVar[str] = ""
    kind: ClassVar[str] = ""
    left_out: ClassVar[Mapping[str, Any]] = {}
    entries: ClassVar[Mapping[str, dataclasses.Field[Any]]] = {}

    def __init__(self, /, *values: Any, **named: Any) -> None:
        fields = [each.name for each in dataclasses.fields(self)]  # type: ignore[arg-type]
        given = dict(zip(fields, values, strict=False)) | named
        plain = [name for name in fields if name in given and name not in self.entries]
        others = {name: given.pop(name) for name in plain}
        try:
            if len(given) + len(others) < len(values) + len(named):
                raise wrong("a value has no entry of its own", f"known here: {_known(self)}")
            self._keep(given, others.get("folder"))
        except EntryError as found:
            placed = found.at(self.place) if self.place else found.findings
            raise SceneError(
                [Fault("", None, *place_of(path), *why) for path, *why in placed]
            ) from None
        vars(self).update(others)

    @classmethod
    def of(cls, raw: Any, where: Where) -> Self:
        """Return the table of plain values by key, or what is such a table; raises `EntryError`."""
        if isinstance(raw, cls):
            return raw
        if not isinstance(raw, Mapping):
            raise wrong("is not a table", f"write [{cls.place}] on a line of its own")
        made = object.__new__(cls)
        made._keep({**cls.left_out, **{str(key): raw[key] for key in raw}}, where.folder)
        return made

    def _keep(self, given: Mapping[str, Any], folder: pathlib.Path | None) -> None:
        """Keep the entries that are given, and the defaults of others, or raise `EntryError`."""
        unknown = [key for key in given if key not in self.entries]
        told = [_of_unknown(self, key, given[key]) for key in unknown[:MOST_UNKNOWN_KEYS]]
        meant, faults = {key for key, _ in told} - {""}, [finding for _, finding in told]
        if len(unknown) > len(told):
            faults.append(((), "more unknown keys", f"known here: {_known(self)}"))
        values = {}
        for name, field in self.entries.items():
            raw = given.get(name, field.default)
            if raw is field.default is not dataclasses.MISSING:
                values[name] = raw
            elif raw is not dataclasses.MISSING:
                try:
                    values[name] = field.metadata["check"](raw, Where(name, folder))
                except EntryError as found:
                    faults += found.at(name)
            elif name not in meant:
                faults.append(((name,), "missing", _to_add(name, field)))
        present = {key: entry for key, entry in given.items() if entry is not None}
        faults += self.relations(dict.fromkeys(meant, ...) | present)
        if not faults:
            vars(self).update(values)
            faults += self.together()
        if faults:
            raise EntryError(faults)

    @classmethod
    def relations(cls, given: Mapping[str, Any]) -> Iterator[Finding]:  # noqa: ARG003
        """Yield what is wrong with entries that do not go together; each may be wrong itself."""
        yield from ()

    def together(self) -> Iterator[Finding]:
        """Yield what is wrong with entries that do not go together, though each is right."""
        yield from ()


def entry(check: Check, description: str = "", default: Any = dataclasses.MISSING) -> Any:
    """Return a field that a file has as an entry; the default alone need not pass the check."""
    about = {"check": check, "description": description}
    return dataclasses.field(default=default, metadata=about)


TABLES: list[type[SceneTable]] = []
"""Every table of the scene file."""


@dataclass_transform(frozen_default=True, field_specifiers=(entry, dataclasses.field))
def table(place: str, kind: str = "") -> Callable[[type[T]], type[T]]:
    """Make a frozen dataclass of the table at `place`; a wrong entry raises `SceneError`."""

    def make(plain: type[T]) -> type[T]:
        made: Any = dataclasses.dataclass(frozen=True, init=False)(plain)
        made.place, made.kind = place, kind
        made.entries = {each.name: each for each in dataclasses.fields(made) if each.metadata}
        TABLES.append(made)
        return made  # type: ignore[no-any-return]

    return make


def place_of(path: Path) -> tuple[str, str]:
    """Return table and key of a path, for messages.

    >>> place_of(("load", "blocks", 0, "cycles"))
    ('load.blocks, block 1', 'cycles')
    """
    *tables, key = path or ("",)
    if isinstance(key, int) or any(path == (each.place,) for each in TABLES):
        tables, key = [*tables, key], ""
    words = ".".join(shown(part) for part in tables if isinstance(part, str))
    block = "".join(f", block {part + 1}" for part in tables if isinstance(part, int))
    return words + block, shown(str(key))


# What is wrong with keys, in words


def _known(kind: SceneTable) -> str:
    return ", ".join(kind.entries)


def _of_unknown(kind: SceneTable, name: str, raw: object) -> tuple[str, Finding]:
    """Return the known key that an unknown one seems to stand for, '' if none, and what to say."""
    meant = RENAMED.get(name, "")
    if meant in kind.entries:
        remedy = f"renamed to {meant}"
    elif homes := [
        f'kind = "{other.kind}"' if other.kind else f"[{other.place}]"
        for other in TABLES
        if other.place and name in other.entries and (kind.kind or not other.kind)
    ]:
        meant, remedy = "", f"it belongs to {' or '.join(homes)}"
    elif meant := did_you_mean(name, kind.entries):
        remedy = f"did you mean {meant}?"
    else:
        remedy = f"known here: {_known(kind)}"
    return meant, ((name,), f"unknown {'table' if isinstance(raw, Mapping) else 'key'}", remedy)


def _to_add(key: str, field: dataclasses.Field[Any]) -> str:
    description, unit = field.metadata["description"], unit_of(key)
    if any(key == each.place for each in TABLES):
        return f"add a table [{key}] ({description})"
    return f"add {key} = ... ({description}{', in ' + unit if unit else ''})"
