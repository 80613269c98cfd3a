"""Tables of a scene as frozen dataclasses that are checked on every way to them.

Pydantic collects the faults of all entries; this module puts them into words: what is wrong, and
what to do about it. The same checks run for a file, for `Scene.from_dict`, for a constructor and
for `dataclasses.replace`.

Key results
    table       class decorator: a frozen dataclass whose construction raises `SceneError`
    Positive, NonNegative, Real, Count, Flag, Text     kinds of entries
    problems    all that is wrong with tables, each with its path
    all_wrong   the error for a validator to raise that finds several faults
"""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable, Collection, Iterator, Mapping
from typing import Annotated, Any, ClassVar, NamedTuple, TypeVar, dataclass_transform, get_args

from pydantic import (
    AfterValidator,
    BeforeValidator,
    ConfigDict,
    Field,
    ValidationError,
    model_validator,
)
from pydantic.dataclasses import dataclass
from pydantic_core import ArgsKwargs, InitErrorDetails, PydanticCustomError, core_schema

from wear.faults import Fault, SceneError
from wear.quantities import LARGEST, MOST_CYCLES, SMALLEST, unit_of
from wear.words import did_you_mean, kind_of, of_number, shown

MOST_UNKNOWN_KEYS = 20

# Keys of versions before the first release, each with its name of today.
RENAMED = {"roughness_slope": "roughness_growth", "cutoff": "ends_at_3_sigma"}

T = TypeVar("T")
Path = tuple[str | int, ...]
"""Where a value stands: ("bearing", "hardness_MPa"), ("load", "blocks", 0, "cycles")."""

Finding = tuple[str | Path, str, str]
"""A path, which may be dotted, the problem there, and its remedy."""


# Kinds of entries


def wrong(problem: str, remedy: str) -> PydanticCustomError:
    """Return the error for a validator to raise: what is wrong, and the remedy."""
    return PydanticCustomError("wrong", "{problem}", {"problem": problem, "remedy": remedy})


def all_wrong(*faults: Finding) -> ValidationError:
    """Return the error for a validator to raise that finds (path, problem, remedy) many times."""
    details: list[InitErrorDetails] = [
        {"type": wrong(problem, remedy), "loc": _path(path), "input": None}
        for path, problem, remedy in faults
    ]
    return ValidationError.from_exception_data("wrong", details)


def _path(path: str | Path) -> Path:
    return path if isinstance(path, tuple) else tuple(path.split(".") if path else ())


def problems(error: ValidationError, place: Path = ()) -> list[tuple[Path, str, str]]:
    """Return all that was found wrong in a table at a `place` of another, each with its path."""
    return [
        ((*place, *entry["loc"]), entry["ctx"]["problem"], entry["ctx"]["remedy"])
        for entry in error.errors(include_url=False)
    ]


def _sane(number: float) -> float:
    if number != 0.0 and not SMALLEST <= abs(number) <= LARGEST:
        raise PydanticCustomError("magnitude", "out of range")
    return number


def _whole(raw: object) -> object:
    remedy = f"give a whole number from 1 to {MOST_CYCLES:.0e}"
    if isinstance(raw, bool) or not isinstance(raw, int | float):
        raise wrong(f"is {kind_of(raw)}", remedy)
    if not 1 <= raw <= MOST_CYCLES:  # also catches nan
        raise wrong("is out of range", remedy)
    if raw != int(raw):
        raise wrong(f"{raw!r} is not a whole number", remedy)
    return int(raw)


def _printable(text: str) -> str:
    if not text.isprintable():
        raise wrong("has control characters", "use printable characters only")
    return text


def _printable_lines(text: str) -> str:
    return "\n".join(map(_printable, text.split("\n")))


def listed(raw: object) -> object:
    """Return an array as a list, anything else as it is."""
    return raw.tolist() if hasattr(raw, "tolist") else raw  # NumPy's arrays


def choice(raw: object, known: Collection[str]) -> str:
    """Return `raw` if it is one of the known names, otherwise raise what was perhaps meant."""
    if isinstance(raw, str) and raw in known:
        return raw
    remedy = f"choose one of {', '.join(known)}"
    if not isinstance(raw, str):
        raise wrong("is not a name in quotes", remedy)
    if meant := did_you_mean(raw, known):
        remedy = f"did you mean {meant}? C{remedy[1:]}"
    raise wrong(f'"{shown(raw)}" is unknown', remedy)


class OneOf(NamedTuple):
    """The names among which an entry chooses; in an annotation, after `str`."""

    names: Collection[str]

    def __get_pydantic_core_schema__(self, source: Any, handler: Any) -> Any:
        return core_schema.no_info_plain_validator_function(lambda raw: choice(raw, self.names))


_FINITE = Field(strict=True, allow_inf_nan=False)
Positive = Annotated[float, _FINITE, Field(gt=0), AfterValidator(_sane)]
NonNegative = Annotated[float, _FINITE, Field(ge=0), AfterValidator(_sane)]
Real = Annotated[float, _FINITE, AfterValidator(_sane)]
Count = Annotated[int, BeforeValidator(_whole)]
Reals = Annotated[tuple[Real, ...], BeforeValidator(listed)]
Flag = Annotated[bool, Field(strict=True)]
Prose = Annotated[str, Field(strict=True, max_length=2000), AfterValidator(_printable_lines)]
Line = Annotated[str, Field(strict=True), AfterValidator(_printable)]
Text = Annotated[Line, Field(max_length=200)]


# Tables


@dataclass(frozen=True)
class SceneTable:
    """A table of the scene file: `place` is its name, `kind` chooses among those of that name.

    `entries` are its keys with pydantic's description of each, `left_out` the values of those that
    a file may leave out, but not a constructor.
    """

    place: ClassVar[str] = ""
    kind: ClassVar[str] = ""
    left_out: ClassVar[Mapping[str, Any]] = {}
    entries: ClassVar[Mapping[str, Any]] = {}

    @classmethod
    def relations(cls, given: Mapping[str, Any]) -> Iterator[Finding]:  # noqa: ARG003
        """Yield (key, problem, remedy) for entries that do not go together; they may be wrong."""
        yield from ()

    @model_validator(mode="wrap")
    @classmethod
    def _explained(cls, raw: Any, build: Callable[[Any], Any]) -> Any:
        """Build the table, or raise every fault of its entries and relations in words."""
        known: Mapping[str, Any] = cls.entries
        if isinstance(raw, ArgsKwargs):
            known = cls.__pydantic_fields__  # type: ignore[attr-defined]
            given = dict(zip(known, raw.args, strict=False)) | (raw.kwargs or {})
            if len(given) < len(raw.args) + len(raw.kwargs or {}):
                known_here = f"known here: {', '.join(cls.entries)}"
                raise all_wrong(("", "a value has no entry of its own", known_here))
        elif isinstance(raw, Mapping):
            given = {**cls.left_out, **{str(key): value for key, value in raw.items()}}
        else:
            return _instance(cls, raw, build)
        unknown = [key for key in given if key not in known]
        shown_keys = unknown[:MOST_UNKNOWN_KEYS]
        faults: list[Finding] = [_of_unknown(cls, key, given[key]) for key in shown_keys]
        meant = {_meant_by(cls, key) for key in shown_keys} - {""}
        if len(unknown) > len(shown_keys):
            faults.append(("", "more unknown keys", f"known here: {', '.join(cls.entries)}"))
        try:
            made = build({key: value for key, value in given.items() if key in known})
        except ValidationError as error:
            entries = error.errors(include_url=False)
            faults += [
                _of_entry(cls, entry)
                for entry in entries
                if not (entry["type"] == "missing" and entry["loc"][0] in meant)
            ]
        present = {key: entry for key, entry in given.items() if entry is not None}
        faults += cls.relations(dict.fromkeys(meant, ...) | present)
        if faults:
            raise all_wrong(*faults)
        return made


TABLES: list[type[SceneTable]] = []
"""Every table of the scene file."""


@dataclass_transform(frozen_default=True, field_specifiers=(Field, dataclasses.field))
def table(place: str, kind: str = "") -> Callable[[type[T]], type[T]]:
    """Make a frozen dataclass of the table at `place`; a wrong entry raises `SceneError`."""

    def make(plain: type[T]) -> type[T]:
        made: Any = dataclass(frozen=True, config=ConfigDict(extra="forbid"))(plain)
        made.place, made.kind = place, kind
        fields = made.__pydantic_fields__
        made.entries = {name: entry for name, entry in fields.items() if not entry.exclude}
        checked_init = made.__init__

        @functools.wraps(checked_init)
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

        made.__init__ = init
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


# What is wrong, in words


def _instance(kind: type[SceneTable], raw: Any, build: Callable[[Any], Any]) -> Any:
    """Return what is a table already."""
    try:
        return build(raw)
    except ValidationError:
        remedy = f"write [{kind.place}] on a line of its own"
        raise all_wrong(("", "is not a table", remedy)) from None


def _meant_by(kind: type[SceneTable], name: str) -> str:
    """Return the known key that an unknown one seems to stand for, '' if none."""
    if RENAMED.get(name) in kind.entries:
        return RENAMED[name]
    return "" if _homes(kind, name) else did_you_mean(name, kind.entries)


def _homes(kind: type[SceneTable], name: str) -> str:
    """Return the tables to which a key belongs that stands in the wrong one."""
    homes = [
        f'kind = "{other.kind}"' if other.kind else f"[{other.place}]"
        for other in TABLES
        if other.place and name in other.entries and (kind.kind or not other.kind)
    ]
    return " or ".join(homes)


def _of_unknown(kind: type[SceneTable], name: str, raw: object) -> Finding:
    meant = _meant_by(kind, name)
    if RENAMED.get(name) == meant:
        remedy = f"renamed to {meant}"
    elif homes := _homes(kind, name):
        remedy = f"it belongs to {homes}"
    elif meant:
        remedy = f"did you mean {meant}?"
    else:
        remedy = f"known here: {', '.join(kind.entries)}"
    return (name,), f"unknown {'table' if isinstance(raw, Mapping) else 'key'}", remedy


def _of_entry(kind: type[SceneTable], entry: Any) -> Finding:
    """Return what pydantic found in an entry."""
    loc = entry["loc"]
    if entry["type"] == "wrong":
        return loc, entry["ctx"]["problem"], entry["ctx"]["remedy"]
    problem, remedy = _of_value(kind, str(loc[0]), entry)
    if len(loc) > 1:  # in a list
        problem = f"entry {int(loc[1]) + 1}: {problem}"
    return loc[:1], problem, remedy


def _of_value(kind: type[SceneTable], key: str, entry: Any) -> tuple[str, str]:
    raw, limits = entry["input"], entry.get("ctx", {})
    match entry["type"]:
        case "missing":
            return "missing", _to_add(kind, key)
        case "float_type" | "finite_number" | "greater_than" | "greater_than_equal" | "magnitude":
            return of_number(raw, domain_of(kind.entries[key]), unit_of(key))
        case "bool_type":
            return "is no flag", "write true or false"
        case "string_type":
            return f"is {kind_of(raw)}", f'give text in quotes: {key} = "..."'
        case "tuple_type":
            return f"is {kind_of(raw)}", "give a list of numbers in brackets, such as [1e-4, 2e-5]"
        case "too_long" | "string_too_long":
            things = "characters" if isinstance(raw, str) else "entries"
            return f"has {len(raw)} {things}", f"give at most {limits['max_length']}"
    return entry["msg"], "correct it"


def _to_add(kind: type[SceneTable], key: str) -> str:
    field = kind.entries[key]
    home = getattr(field.annotation, "place", None)
    if home is not None:
        return f"add a table [{key}] ({field.description})"
    unit = unit_of(key)
    return f"add {key} = ... ({field.description}{', in ' + unit if unit else ''})"


def domain_of(field: Any) -> str:
    """Return which numbers an entry takes: '> 0', '>= 0' or '' for all."""
    inner = [each for part in get_args(field.annotation) for each in get_args(part)[1:]]
    limits = [limit for each in inner for limit in getattr(each, "metadata", ())]
    for limit in [*field.metadata, *limits]:
        if getattr(limit, "gt", None) is not None:
            return f"> {limit.gt:g}"
        if getattr(limit, "ge", None) is not None:
            return f">= {limit.ge:g}"
    return ""
