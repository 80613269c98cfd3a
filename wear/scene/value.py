"""One value of a scene against its key: the value as it will be used, or what is wrong with it."""

from __future__ import annotations

import difflib
import math
from collections.abc import Iterable
from dataclasses import dataclass

from wear.scene.schema import (
    LARGEST,
    MOST_CYCLES,
    MOST_HARMONICS,
    SMALLEST,
    Domain,
    Key,
    Kind,
    Value,
)

LONGEST_TEXT = {"title": 200, "description": 2000, "file": 1000, "sha256": 64}


@dataclass(frozen=True)
class Wrong:
    """A value that cannot be used."""

    problem: str
    remedy: str


def shown(text: str, most: int = 60) -> str:
    """`text` fit for a terminal: one line, no control characters, at most so long.

    >>> shown("a\\x1b[31mb")
    'a\\\\x1b[31mb'
    """
    cut = text if len(text) <= most else text[: most - 3] + "..."
    return "".join(c if c.isprintable() else f"\\x{ord(c):02x}" for c in cut)


def did_you_mean(word: str, candidates: Iterable[str]) -> str:
    """The candidate that `word` seems to stand for, or ''.

    >>> did_you_mean("stifness", ["stiffness", "hardness"])
    'stiffness'
    """
    by_lower = {candidate.lower(): candidate for candidate in candidates}
    close = difflib.get_close_matches(word[:80].lower(), by_lower, n=1)
    return by_lower[close[0]] if close else ""


def _kind_of(raw: object) -> str:
    kinds = {bool: "true or false", str: "text", list: "a list", dict: "a table"}
    return next((words for kind, words in kinds.items() if isinstance(raw, kind)), "a date or time")


def check_number(key: Key, raw: object) -> float | Wrong:
    """`raw` as a float inside the key's domain."""
    unit = f", in {key.unit}" if key.unit else ""
    if isinstance(raw, str):
        if _reads_as_number(raw):
            return Wrong(f'"{shown(raw)}" is text, not a number', "drop the quotes")
        return Wrong(f'"{shown(raw)}" is text', f"give a number{unit}, such as 0.5 or 1e-6")
    if isinstance(raw, bool) or not isinstance(raw, int | float):
        return Wrong(f"is {_kind_of(raw)}", f"give a number{unit}")
    wanted = f"give a number {key.domain.value}{unit}"
    if key.domain is Domain.REAL:
        wanted = f"give any finite number{unit}"
    try:
        number = float(raw)
    except OverflowError:
        return Wrong("is a whole number too large for a float", wanted)
    if not math.isfinite(number):
        return Wrong(f"{number} is not a finite number", wanted)
    if number < 0.0 and key.domain is not Domain.REAL:
        return Wrong(f"{number!r} is negative", wanted)
    if number == 0.0:
        return Wrong("is zero", wanted) if key.domain is Domain.POSITIVE else 0.0
    if not SMALLEST <= abs(number) <= LARGEST:
        bounds = f"magnitudes lie from {SMALLEST:g} to {LARGEST:g}"
        return Wrong(f"{number!r} is out of range", f"{wanted}; {bounds}")
    return number


def _reads_as_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _check_count(raw: object) -> int | Wrong:
    remedy = f"give a whole number from 1 to {MOST_CYCLES:.0e}"
    if isinstance(raw, bool) or not isinstance(raw, int | float):
        return Wrong(f"is {_kind_of(raw)}", remedy)
    if not 1 <= raw <= MOST_CYCLES:  # also catches nan
        return Wrong("is out of range", remedy)
    return int(raw) if raw == int(raw) else Wrong(f"{raw!r} is not a whole number", remedy)


def _check_numbers(key: Key, raw: object) -> tuple[float, ...] | Wrong:
    if not isinstance(raw, list):
        found = "is a number" if type(raw) in (int, float) else f"is {_kind_of(raw)}"
        return Wrong(found, "give a list of numbers in brackets, such as [1e-4, 2e-5]")
    if len(raw) > MOST_HARMONICS:
        return Wrong(f"has {len(raw)} entries", f"give at most {MOST_HARMONICS} harmonics")
    numbers = []
    for place, entry in enumerate(raw, start=1):
        number = check_number(key, entry)
        if isinstance(number, Wrong):
            return Wrong(f"entry {place}: {number.problem}", number.remedy)
        numbers.append(number)
    return tuple(numbers)


def _check_text(key: Key, raw: object) -> str | Wrong:
    if not isinstance(raw, str):
        found = "a number" if type(raw) in (int, float) else _kind_of(raw)
        return Wrong(f"is {found}", f'give text in quotes: {key.name} = "..."')
    most = LONGEST_TEXT[key.name]
    if len(raw) > most:
        return Wrong(f"has {len(raw)} characters", f"give at most {most}")
    lines = raw.split("\n") if key.name == "description" else [raw]
    if not all(line.isprintable() for line in lines):
        return Wrong("has control characters", "use printable characters only")
    return raw


def _check_choice(key: Key, raw: object) -> str | Wrong:
    if isinstance(raw, str) and raw in key.choices:
        return raw
    choices = ", ".join(key.choices)
    if not isinstance(raw, str):
        return Wrong("is not a name in quotes", f"choose one of {choices}")
    meant = did_you_mean(raw, key.choices)
    remedy = (
        f"did you mean {meant}? Choose one of {choices}" if meant else f"choose one of {choices}"
    )
    return Wrong(f'"{shown(raw)}" is unknown', remedy)


def check_value(key: Key, raw: object) -> Value | Wrong:
    """`raw` as the key's kind of value."""
    match key.kind:
        case Kind.NUMBER:
            return check_number(key, raw)
        case Kind.NUMBERS:
            return _check_numbers(key, raw)
        case Kind.COUNT:
            return _check_count(raw)
        case Kind.FLAG:
            return raw if isinstance(raw, bool) else Wrong("is no flag", "write true or false")
        case Kind.CHOICE:
            return _check_choice(key, raw)
        case _:
            return _check_text(key, raw)
