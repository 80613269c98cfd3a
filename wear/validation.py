"""Tables of a scene as frozen dataclasses that are checked wherever they are made.

Pydantic collects the faults of all entries; the kind of an entry has the words for the problem and
its remedy.
The same checks run for a file, for `Scene.from_dict`, for a constructor and for
`dataclasses.replace`.

Key results
    table       class decorator: a frozen dataclass whose construction raises `SceneError`
    Positive, NonNegative, Real, Count, Flag, Text     kinds of entries, with their words
    problems    the faults of tables, each with its path
    EntryError  the error for a validator to raise, with one fault or several
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Set, Sized
from functools import partial, wraps
from itertools import islice
from typing import Annotated, Any, ClassVar, TypeVar, dataclass_transform

from pydantic import (
    ConfigDict,
    Field,
    PlainValidator,
    ValidationError,
    ValidationInfo,
    model_validator,
)
from pydantic.dataclasses import dataclass
from pydantic_core import ArgsKwargs

from wear.faults import Fault, SceneError
from wear.quantities import LARGEST, MOST_CYCLES, SMALLEST, unit_of
from wear.words import did_you_mean, kind_of, shown

MOST_UNKNOWN_KEYS = 20
BOUNDS = f"magnitudes lie from {SMALLEST:g} to {LARGEST:g}"

# Keys of versions before the first release, each with its name of today.
RENAMED = {"roughness_slope": "roughness_growth", "cutoff": "ends_at_3_sigma"}

T = TypeVar("T")
Path = tuple[str | int, ...]
"""The place of a value: ("bearing", "hardness_MPa"), ("load", "blocks", 0, "cycles")."""

Finding = tuple[Path, str, str]
"""A path, the problem there, and its remedy."""


# Kinds of entries


class EntryError(ValueError):
    """The faults of an entry or a table, for a validator to raise: pydantic adds the place."""

    def __init__(self, *findings: Finding) -> None:
        super().__init__(*findings)
        self.findings = findings


def wrong(problem: str, remedy: str, path: str = "") -> EntryError:
    """Return the error for a validator to raise: the problem at a dotted path, and its remedy."""
    return EntryError((tuple(filter(None, path.split("."))), problem, remedy))


def problems(error: ValidationError, place: Path = ()) -> list[Finding]:
    """Return the faults of a table at a `place` of another, each with its path."""
    return [
        ((*place, *entry["loc"], *path), problem, remedy)
        for entry in error.errors(include_url=False)
        for path, problem, remedy in entry["ctx"]["error"].findings
    ]


def number(raw: Any, info: ValidationInfo, domain: str = "") -> float:
    """Return a finite number of sane size, of a `domain`: '> 0', '>= 0' or '' for all."""
    if type(raw) is float and _fits(raw, domain):
        return raw
    unit = unit_of(str(info.field_name))
    ending = f", in {unit}" if unit else ""
    if isinstance(raw, str):
        remedy = f"give a number{ending}: no quotes, no unit, a point before the decimals"
        raise wrong(f'"{shown(raw)}" is text, not a number', remedy)
    if hasattr(raw, "tolist"):  # NumPy's scalars
        raw = raw.tolist()
    if isinstance(raw, bool) or not hasattr(raw, "__float__"):
        raise wrong(f"is {kind_of(raw)}", f"give a number{ending}")
    wanted = f"give a number {domain}{ending}" if domain else f"give any finite number{ending}"
    try:
        value = float(raw)
    except OverflowError:
        raise wrong("is a whole number too large for a float", wanted) from None
    except (TypeError, ValueError):  # of a symbol, or of a number without a value
        raise wrong(f"is {kind_of(raw)}", wanted) from None
    if _fits(value, domain):
        return value
    if not math.isfinite(value):
        raise wrong(f"{value} is not a finite number", wanted)
    if value < 0.0 and domain:
        raise wrong(f"{value!r} is negative", wanted)
    if value == 0.0:
        raise wrong("is zero", wanted)
    raise wrong(f"{value!r} is out of range", f"{wanted}; {BOUNDS}")


def _fits(value: float, domain: str) -> bool:
    if value == 0.0:
        return domain != "> 0"
    return is_sane(value) and (value > 0.0 or not domain)


def is_sane(number: float) -> bool:
    """Return whether a number is zero or of a magnitude that scenes may have."""
    return number == 0.0 or SMALLEST <= abs(number) <= LARGEST


def numbers(raw: Any, info: ValidationInfo, most: int = 1_000_000) -> tuple[float, ...]:
    """Return a list of at most `most` numbers."""
    if hasattr(raw, "tolist"):  # NumPy's arrays
        raw = raw.tolist()
    if not isinstance(raw, Iterable) or isinstance(raw, str | bytes | Mapping | Set):
        remedy = "give a list of numbers in brackets, such as [1e-4, 2e-5]"
        raise wrong(f"is {kind_of(raw)}", remedy)
    given: tuple[Any, ...] = tuple(islice(raw, most + 1))
    if len(given) > most:
        size = len(raw) if isinstance(raw, Sized) else "too many"
        raise wrong(f"has {size} entries", f"give at most {most}")
    if all(type(entry) is float and is_sane(entry) for entry in given):
        return given
    values, faults = list[float](), list[Finding]()
    for place, entry in enumerate(given, start=1):
        try:
            values.append(number(entry, info))
        except EntryError as error:
            [(path, problem, remedy)] = error.findings
            faults.append((path, f"entry {place}: {problem}", remedy))
    if faults:
        raise EntryError(*faults)
    return tuple(values)


def words(raw: Any, info: ValidationInfo, most: int = 200, lines: bool = False) -> str:
    """Return a text of at most `most` printable characters, in one line or in several."""
    if not isinstance(raw, str):
        raise wrong(f"is {kind_of(raw)}", f'give text in quotes: {info.field_name} = "..."')
    if len(raw) > most:
        raise wrong(f"has {len(raw)} characters", f"give at most {most}")
    if not (raw.replace("\n", "") if lines else raw).isprintable():
        raise wrong("has control characters", "use printable characters only")
    return raw


def choice(raw: object, known: Collection[str], path: str = "") -> str:
    """Return `raw` if it is one of the known names, otherwise raise with the nearest of them."""
    if isinstance(raw, str) and raw in known:
        return raw
    remedy = f"choose one of {', '.join(known)}"
    if not isinstance(raw, str):
        raise wrong("is not a name in quotes", remedy, path)
    if meant := did_you_mean(raw, known):
        remedy = f"did you mean {meant}? C{remedy[1:]}"
    raise wrong(f'"{shown(raw)}" is unknown', remedy, path)


def one_of(names: Collection[str]) -> PlainValidator:
    """Return the kind of an entry that is one of some names."""
    return PlainValidator(partial(choice, known=names))


def _whole(raw: object) -> int:
    remedy = f"give a whole number from 1 to {MOST_CYCLES:.0e}"
    if isinstance(raw, bool) or not isinstance(raw, int | float):
        raise wrong(f"is {kind_of(raw)}", remedy)
    if not 1 <= raw <= MOST_CYCLES:  # also catches nan
        raise wrong("is out of range", remedy)
    if raw != int(raw):
        raise wrong(f"{raw!r} is not a whole number", remedy)
    return int(raw)


def _true_or_false(raw: object) -> bool:
    if not isinstance(raw, bool):
        raise wrong(f"is {kind_of(raw)}", "write true or false without quotes")
    return raw


Positive = Annotated[float, PlainValidator(partial(number, domain="> 0"))]
NonNegative = Annotated[float, PlainValidator(partial(number, domain=">= 0"))]
Real = Annotated[float, PlainValidator(number)]
Reals = Annotated[tuple[float, ...], PlainValidator(numbers)]
Count = Annotated[int, PlainValidator(_whole)]
Flag = Annotated[bool, PlainValidator(_true_or_false)]
Text = Annotated[str, PlainValidator(words)]
Prose = Annotated[str, PlainValidator(partial(words, most=2000, lines=True))]


# Tables


@dataclass(frozen=True)
class SceneTable:
    """A table of the scene file: `place` is its name, `kind` distinguishes tables of the same name.

    `entries` are its keys with pydantic's description of each, `left_out` the defaults of those
    that are optional in a file, but not in a constructor.
    """

    place: ClassVar[str] = ""
    kind: ClassVar[str] = ""
    left_out: ClassVar[Mapping[str, Any]] = {}
    entries: ClassVar[Mapping[str, Any]] = {}

    @classmethod
    def relations(cls, given: Mapping[str, Any]) -> Iterator[Finding]:  # noqa: ARG003
        """Yield (path, problem, remedy) for inconsistent entries, which are not yet validated."""
        yield from ()

    @model_validator(mode="wrap")
    @classmethod
    def _validated(cls, raw: Any, build: Callable[[Any], Any]) -> Any:
        """Build the table, or raise every fault of its entries and relations in words."""
        known: Mapping[str, Any] = cls.entries
        if isinstance(raw, ArgsKwargs):
            known = cls.__pydantic_fields__  # type: ignore[attr-defined]
            given = dict(zip(known, raw.args, strict=False)) | (raw.kwargs or {})
            if len(given) < len(raw.args) + len(raw.kwargs or {}):
                known_here = f"known here: {', '.join(cls.entries)}"
                raise wrong("a value has no entry of its own", known_here)
        elif isinstance(raw, Mapping):
            given = {**cls.left_out, **{str(key): value for key, value in raw.items()}}
        else:
            try:
                return build(raw)  # a table already
            except ValidationError:
                line = f"write [{cls.place}] on a line of its own"
                remedy = line if cls.place else "give a mapping of tables by their names"
                raise wrong("is not a table", remedy) from None
        unknown = [key for key in given if key not in known]
        reported = [_unknown_key(cls, key, given[key]) for key in unknown[:MOST_UNKNOWN_KEYS]]
        meant = {key for key, _ in reported} - {""}
        faults = [finding for _, finding in reported]
        if len(unknown) > len(reported):
            faults.append(((), "more unknown keys", f"known here: {', '.join(cls.entries)}"))
        try:
            instance = build({key: value for key, value in given.items() if key in known})
        except ValidationError as error:
            for entry in error.errors(include_url=False):
                where = entry["loc"]
                if entry["type"] == "value_error":
                    for path, problem, remedy in entry["ctx"]["error"].findings:
                        faults.append(((*where, *path), problem, remedy))
                elif where[0] not in cls.entries:
                    faults.append((where, entry["msg"], "give the name of a scene and its folder"))
                elif where[0] not in meant:
                    faults.append((where, "missing", _remedy_if_missing(cls, str(where[0]))))
        present = {key: entry for key, entry in given.items() if entry is not None}
        faults += cls.relations(dict.fromkeys(meant, ...) | present)
        if faults:
            raise EntryError(*faults)
        return instance


TABLES: list[type[SceneTable]] = []
"""Every table of the scene file."""


@dataclass_transform(frozen_default=True, field_specifiers=(Field, dataclasses.field))
def table(place: str, kind: str = "") -> Callable[[type[T]], type[T]]:
    """Make a frozen dataclass of the table at `place`; a wrong entry raises `SceneError`."""

    def make(plain: type[T]) -> type[T]:
        checked: Any = dataclass(frozen=True, config=ConfigDict(extra="forbid"))(plain)
        checked.place, checked.kind = place, kind
        fields = checked.__pydantic_fields__
        checked.entries = {name: entry for name, entry in fields.items() if not entry.exclude}
        checked_init = checked.__init__

        @wraps(checked_init)
        def init(self: T, *args: Any, **entries: Any) -> None:
            try:
                checked_init(self, *args, **entries)
            except ValidationError as error:
                raise SceneError(
                    [
                        Fault("", None, *place_of(path), problem, remedy)
                        for path, problem, remedy in problems(error, (place,) if place else ())
                    ]
                ) from None

        checked.__init__ = init
        TABLES.append(checked)
        return checked  # type: ignore[no-any-return]

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


# Faults in words


def _unknown_key(kind: type[SceneTable], name: str, raw: object) -> tuple[str, Finding]:
    """Return the known key that an unknown one seems to mean, '' if none, and the finding."""
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
        remedy = f"known here: {', '.join(kind.entries)}"
    return meant, ((name,), f"unknown {'table' if isinstance(raw, Mapping) else 'key'}", remedy)


def _remedy_if_missing(kind: type[SceneTable], key: str) -> str:
    field = kind.entries[key]
    if any(key == each.place for each in TABLES):
        return f"add a table [{key}] ({field.description})"
    unit = unit_of(key)
    return f"add {key} = ... ({field.description}{', in ' + unit if unit else ''})"
